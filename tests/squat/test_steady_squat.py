"""Steady squat of the benchmark runs and of synthetic ones."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord, read_sinkage
from towtank.squat.steady_squat import SQUAT_COLUMNS, reduce_steady

LENGTH = 3.984
LAYOUT = SinkageLayout(
    length=LENGTH,
    points={"z_VF": (LENGTH / 2, 0.0), "z_VA": (-LENGTH / 2, 0.0)},
    speed="u",
    extra=("X",),
    xG=-0.052,
)


@pytest.mark.parametrize("rule", ["fraction", "plateau"])
@pytest.mark.parametrize(
    ("run", "speed", "bow", "stern"), [("C1", 0.327, 0.88e-3, 0.58e-3), ("C2", 0.872, 8.34e-3, 5.01e-3)]
)
def test_published_sinkage_of_the_benchmark(benchmark_run, run, speed, bow, stern, rule):
    steady = reduce_steady(read_sinkage(benchmark_run(run), LAYOUT), depth=0.326, rule=rule)
    means = {name: of.mean for name, of in steady.means.items()}
    assert means["sinkage_bow"] == pytest.approx(bow, rel=0.02)
    assert means["sinkage_stern"] == pytest.approx(stern, rel=0.02)
    assert means["speed"] == pytest.approx(speed, rel=5e-4)
    assert steady.depth_froude_number == pytest.approx(speed / np.sqrt(9.80665 * 0.326), rel=5e-4)


def test_resistance_and_trim_of_the_fast_run(benchmark_run):
    steady = reduce_steady(read_sinkage(benchmark_run("C2"), LAYOUT))
    # 0.0477 deg is printed for this run, with the bow 8.3 mm and the stern 5.0 mm down.
    assert steady.trim_degrees == pytest.approx(0.0477, abs=1e-3)
    assert steady.units["X"] == "N"
    assert steady.means["X"].mean == pytest.approx(-5.82, rel=0.05)
    assert steady.window.is_stationary


def test_sensors_and_heave_with_trim_give_the_same_squat(benchmark_run):
    other = SinkageLayout(length=LENGTH, heave="heave", trim="trim", trim_positive="bow-up", speed="u")
    ours = [reduce_steady(read_sinkage(benchmark_run("C2"), layout)) for layout in (LAYOUT, other)]
    for quantity in ("sinkage_bow", "sinkage_stern", "trim"):
        a, b = (steady.means[quantity].mean for steady in ours)
        assert a == pytest.approx(b, rel=2e-3)


def _record(n=4000, seed=5):
    rng = np.random.default_rng(seed)
    time = 0.05 * np.arange(n)
    noise = np.zeros((2, n))
    for row in range(1, n):
        noise[:, row] = 0.9 * noise[:, row - 1] + rng.standard_normal(2)
    start = np.exp(-time / 5.0)
    return SinkageRecord(
        time,
        0.006 * (1.0 - start) + 1e-5 * noise[0],
        0.0008 * (1.0 - start) + 1e-6 * noise[1],
        LAYOUT,
        name="synthetic",
    )


def test_table_holds_means_at_any_place_with_honest_errors():
    steady = reduce_steady(_record(), places={"quarter": 1.0}, run="S1")
    frame = steady.frame
    assert tuple(frame.columns) == SQUAT_COLUMNS
    assert frame["quantity"].tolist() == ["sinkage_quarter", "trim"]
    row = frame.iloc[0]
    assert row["mean"] == pytest.approx(0.0068, abs=4 * row["se"])
    # Neighbours of correlation 0.9 say the same 19 times over.
    samples = 20 * (row["window_end"] - row["window_start"])
    assert samples / row["n_eff"] == pytest.approx(19.0, rel=0.4)
    assert (row["run"], row["unit"]) == ("S1", "m")


def test_standard_error_is_that_of_many_runs():
    window = {"rule": "key-times", "start": 60.0, "stop": 120.0}
    runs = [reduce_steady(_record(2500, seed), places={"midship": 0.0}, **window) for seed in range(60)]
    means = np.array([run.means["sinkage_midship"].mean for run in runs])
    said = np.mean([run.means["sinkage_midship"].se for run in runs])
    assert means.std(ddof=1) == pytest.approx(said, rel=0.3)


def test_what_cannot_be_reduced_is_named():
    record = _record(400)
    with pytest.raises(FitError, match=r"synthetic: a water depth of -0\.3 m is impossible"):
        reduce_steady(record, depth=-0.3)
    with pytest.raises(FitError, match="synthetic: 1 samples between start and stop are too few"):
        reduce_steady(record, rule="key-times", start=1.0, stop=1.04)
    with pytest.raises(FitError, match="plateau rule needs the carriage speed"):
        reduce_steady(record, rule="plateau")
    with pytest.raises(FitError, match="needs speed and depth"):
        reduce_steady(record).depth_froude_number  # noqa: B018
