"""Noise filters by name."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.noise_filter import FILTERS, default_cutoff, filter_record
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord, read_sinkage
from towtank.squat.steady_squat import reduce_steady

LENGTH = 4.0
LAYOUT = SinkageLayout(LENGTH, points={"bow": (2.0, 0.0), "stern": (-2.0, 0.0)})
TIME = np.arange(0.0, 60.0, 0.02)


def record(values, time=TIME, heel=None):
    return SinkageRecord(time, values, 0.1 * values, LAYOUT, heel, name="run.dat")


SLOW = 0.005 + 0.002 * np.sin(2.0 * np.pi * 0.5 * TIME)


@pytest.mark.parametrize("name", ["butterworth", "moving-mean", "median"])
def test_noise_goes_and_nothing_is_delayed(name):
    noise = 3e-4 * np.random.default_rng(4).standard_normal(TIME.size)
    found = filter_record(record(SLOW + noise), name, cutoff=3.0).midship
    assert np.std(found - SLOW) < 0.6 * np.std(noise)
    shifts = [np.sum(found[100:-100] * np.roll(SLOW, shift)[100:-100]) for shift in range(-5, 6)]
    assert int(np.argmax(shifts)) == 5


@pytest.mark.parametrize("name", ["butterworth", "moving-mean"])
def test_half_the_power_passes_at_the_cutoff_of_one_pass(name):
    wave = np.sin(2.0 * np.pi * 3.0 * TIME)
    passed = filter_record(record(wave), name, cutoff=3.0).midship[500:-500]
    amplitude = np.sqrt(2.0) * np.std(passed)
    # forward and backward squares the gain of the Butterworth filter
    assert amplitude == pytest.approx(0.5 if name == "butterworth" else np.sqrt(0.5), abs=0.04)


def test_only_the_median_ignores_a_spike():
    spiked = SLOW.copy()
    spiked[1500] += 0.1
    worst = {
        name: np.abs(filter_record(record(spiked), name, cutoff=3.0).midship - SLOW).max() for name in FILTERS
    }
    assert worst["median"] < 4e-4 < 5e-3 < worst["moving-mean"]
    assert worst["none"] == pytest.approx(0.1)


def test_the_default_is_said_and_scales_with_the_ship():
    assert default_cutoff(4.0) == pytest.approx(4.70, abs=0.01)
    assert default_cutoff(400.0) == pytest.approx(0.1 * default_cutoff(4.0))
    assert filter_record(record(SLOW)).history == ("butterworth filter, 4.697 Hz",)
    assert filter_record(record(SLOW), "none").history == ("not filtered",)
    assert filter_record(record(SLOW, heel=SLOW)).heel is not None


def test_steady_means_of_the_benchmark_do_not_change(benchmark_run):
    layout = SinkageLayout(3.984, points={"z_VF": (1.992, 0.0), "z_VA": (-1.992, 0.0)}, speed="u")
    raw = read_sinkage(benchmark_run("C2"), layout)
    window = {"rule": "key-times", "start": 60.0, "stop": 90.0}
    means = [reduce_steady(of, **window).means["sinkage_bow"].mean for of in (raw, filter_record(raw))]
    assert means[1] == pytest.approx(means[0], rel=2e-3)


GAP = np.concatenate([TIME[:1000], TIME[1000:] + 5.0])
HOLE = np.where(np.arange(TIME.size) == 7, np.nan, SLOW)


@pytest.mark.parametrize(
    ("given", "options", "said"),
    [
        (
            record(SLOW),
            {"name": "kalman"},
            "no filter 'kalman' -> use one of butterworth, moving-mean, median, none",
        ),
        (record(SLOW), {"cutoff": 0.0}, "a cut-off of 0 Hz is impossible"),
        (record(SLOW[:2], TIME[:2]), {}, "run.dat: 2 samples are too few"),
        (record(SLOW, GAP), {}, "run.dat, time: the steps of time differ"),
        (record(HOLE), {}, "run.dat, midship: 1 of 3000 values are missing"),
        (record(np.full(TIME.size, np.nan)), {}, "3000 of 3000 values are missing"),
    ],
)
def test_what_cannot_be_filtered_is_named(given, options, said):
    with pytest.raises(FitError, match=said):
        filter_record(given, **options)


def test_a_constant_stays_constant():
    for name in FILTERS:
        np.testing.assert_allclose(filter_record(record(np.full(TIME.size, 0.004)), name).midship, 0.004)
