import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.extremes import extreme_influences, find_extremes


def test_turning_points_between_samples():
    time = np.arange(0.0, 60.0, 0.23)
    value = 0.3 * np.exp(-0.02 * time) * np.cos(0.6 * time + 0.4)
    found = find_extremes(time, value)
    exact = (np.arctan2(-0.02, 0.6) - 0.4 + np.pi * np.arange(1, found.time.size + 1)) / 0.6
    np.testing.assert_allclose(found.time, exact, atol=2e-3)
    np.testing.assert_allclose(found.value, 0.3 * np.exp(-0.02 * exact) * np.cos(0.6 * exact + 0.4), atol=1e-5)
    assert found.period == pytest.approx(2.0 * np.pi / 0.6, rel=0.01)


def test_first_sample_at_rest_is_a_turning_point(make_decay, literature):
    record = make_decay(literature)
    assert record.extremes.time[0] == 0.0
    assert np.degrees(record.extremes.value[0]) == pytest.approx(25.0, abs=1e-3)
    moving = find_extremes(record.time[20:], record.value[20:])
    assert moving.time[0] > 5.0


def test_noise_makes_no_turning_points(make_decay, literature):
    clean = make_decay(literature).extremes
    noisy = make_decay(literature, noise=0.5).extremes
    assert noisy.value.size == clean.value.size
    np.testing.assert_allclose(noisy.value, clean.value, atol=np.radians(1.5))


def test_a_strong_decay_is_no_offset(make_decay):
    strong = make_decay((0.12, 0.3, 0.0, 0.36, 0.0, 0.0), offset=0.01)
    assert strong.extremes.rest_line()(0.0) == pytest.approx(0.01, abs=5e-4)
    line = strong.extremes.rest_line(drift=True)
    assert line.coef[1] == pytest.approx(0.0, abs=1e-4)


def test_influences_are_the_gradient(make_decay, literature):
    record = make_decay(literature, step=0.2)
    found = record.extremes
    times, heights = extreme_influences(record.time, found)
    rng = np.random.default_rng(2)
    small = 1e-5 * np.convolve(rng.standard_normal(record.time.size), np.ones(9) / 3.0, "same")
    moved = find_extremes(record.time, record.value + small, frequency=1.0 / found.period)
    np.testing.assert_allclose(moved.value - found.value, heights @ small, atol=3e-7)
    np.testing.assert_allclose((moved.time - found.time)[1:], (times @ small)[1:], rtol=0.1, atol=5e-5)


def test_too_coarse_a_record():
    time = np.arange(0.0, 60.0, 2.0)
    with pytest.raises(FitError, match="samples a period"):
        find_extremes(time, np.cos(0.6 * time))
