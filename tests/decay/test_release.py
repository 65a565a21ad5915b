import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.release import find_free_part


def held_record(
    make_decay, literature, samples: int, noise: float, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    free = make_decay(literature).value
    value = np.concatenate([np.full(samples, free[0]), free]) + 0.02
    value = value + noise * np.random.default_rng(seed).standard_normal(value.size)
    return 0.1 * np.arange(value.size), value


@pytest.mark.parametrize("samples", [50, 200])
@pytest.mark.parametrize("noise", [0.0, 0.002, 0.008])
def test_release_from_a_held_angle(make_decay, literature, samples, noise):
    part = find_free_part(*held_record(make_decay, literature, samples, noise))
    assert part.held
    assert part.start == pytest.approx(0.1 * samples, abs=0.3)
    assert part.extremes.value.size == 12


def test_pushes_before_the_free_decay_are_left_out(make_decay, literature):
    time = np.arange(0.0, 60.0, 0.1)
    push = np.where(time < 21.0, 0.012 * np.sin(0.6 * time), 0.0)
    rate, angle = 0.0, 0.0
    value = np.empty(time.size)
    for k, moment in enumerate(push):
        value[k] = angle
        rate += 0.1 * (moment * 1.5 - 0.04 * rate - 0.36 * angle)
        angle += 0.1 * rate
    part = find_free_part(time, value)
    assert 21.0 < part.start < 32.0
    assert len(part.pushes) >= 2
    assert "pushed" in part.reason
    assert (np.diff(part.extremes.half_swing) < 0.0).all()


def test_a_second_push_ends_the_decay(make_decay, literature):
    first = make_decay(literature, duration=37.0).value
    second = make_decay(literature, degrees=12.0, duration=30.0).value
    value = np.concatenate([first, second])
    part = find_free_part(0.1 * np.arange(value.size), value)
    assert part.start == 0.0
    assert part.end < 37.5
    assert part.extremes.half_swing[-1] > np.radians(7.0)


def test_noise_floor_ends_the_decay(make_decay):
    record = make_decay((0.2, 0.3, 0.0, 0.36, 0.0, 0.0), duration=150.0, noise=0.3, correlation=0.0)
    part = find_free_part(record.time, record.value)
    assert part.end < 50.0
    assert part.start < 1.0
    assert part.extremes.half_swing[-1] > np.radians(0.3)


def test_amplitudes_and_skipped_half_cycles(make_decay, literature):
    record = make_decay(literature)
    whole = find_free_part(record.time, record.value)
    skipped = find_free_part(record.time, record.value, skip=2)
    assert skipped.start == pytest.approx(whole.extremes.time[2], abs=0.06)
    low = find_free_part(record.time, record.value, last_amplitude=np.radians(9.0))
    assert low.extremes.half_swing[-1] > np.radians(9.0)
    with pytest.raises(FitError, match="are left"):
        find_free_part(record.time, record.value, skip=10)


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        (lambda t: np.full(t.size, 0.1), "does not move"),
        (lambda t: 0.3 * np.exp(-t / 5.0), "oscillat"),
        (lambda t: 0.01 * np.exp(0.03 * t) * np.cos(0.6 * t), "do not decay"),
        (lambda t: 0.2 * np.cos(0.6 * t), "do not decay"),
        (lambda t: np.random.default_rng(1).standard_normal(t.size), r"oscillat|do not decay"),
    ],
)
def test_what_is_no_decay_is_named(shape, message):
    time = np.arange(0.0, 60.0, 0.1)
    with pytest.raises(FitError, match=message):
        find_free_part(time, shape(time))
