"""Which runs are repeats, and what pooling gives."""

import numpy as np
import pytest

from towtank.identify.autocorrelation import MeanEstimate
from towtank.identify.steady_window import WindowChoice
from towtank.squat.repeated_runs import REPEAT_COLUMNS, pool_repeats
from towtank.squat.steady_squat import SteadySquat


def run(name, speed, bow, depth=0.3):
    window = WindowChoice(slice(0, 10), "key-times", 0.0, 1.0, "", np.arange(10.0), np.zeros((10, 1)))
    one = {"sinkage_bow": MeanEstimate(bow, 1e-5, 30.0, 2.0, 20.0, False)}
    if speed is not None:
        one["speed"] = MeanEstimate(speed, 1e-4, 30.0, 2.0, 20.0, False)
    return SteadySquat(name, one, dict.fromkeys(one, "m"), window, depth)


def test_speed_and_depth_make_repeats():
    runs = [run("a", 0.5, 1e-3), run("b", 0.501, 1.2e-3), run("c", 0.52, 2e-3), run("d", 0.5, 3e-3, depth=0.4)]
    (pooled,) = pool_repeats(runs, [""] * 4)
    assert [one.run for one in pooled.runs] == ["a", "b"]
    assert pooled.condition == "0.5 m/s, depth 0.3 m"
    assert pooled.pooled["sinkage_bow"].mean == pytest.approx(1.1e-3)


def test_names_go_before_speeds():
    runs = [run("a", 0.5, 1e-3), run("b", 0.5, 1.2e-3), run("c", 0.9, 2e-3)]
    (pooled,) = pool_repeats(runs, ["light", "", "light"])
    assert (pooled.condition, [one.run for one in pooled.runs]) == ("light", ["a", "c"])


def test_without_speed_only_names_make_repeats():
    runs = [run("a", None, 1e-3), run("b", None, 1.2e-3)]
    assert pool_repeats(runs, ["", ""]) == []
    (pooled,) = pool_repeats(runs, ["x", "x"])
    assert tuple(pooled.frame.columns) == REPEAT_COLUMNS
    row = pooled.frame.iloc[0]
    assert row["n"] == 2
    # t(1, 0.975) = 12.706
    assert row["upper95"] - row["mean"] == pytest.approx(12.706 * 1e-4, rel=1e-4)
