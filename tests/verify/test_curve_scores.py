"""Scores of curves, rankings of codes, totals over cases."""

import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.datasets import load_table
from towtank.verify.curve_scores import SCORE_COLUMNS, pooled_scores, score_codes, score_curves


def test_computation_is_interpolated_and_never_extrapolated():
    measured = pd.DataFrame({"speed": [0.5, 1.0, 1.5, 2.5], "bow": [1.0, 2.0, 3.0, 5.0]})
    computed = pd.DataFrame({"speed": [2.0, 1.0, 0.0], "bow": [4.4, 2.2, 0.0]})
    (row,) = score_curves(measured, computed, units={"bow": "m"}, case="A1").to_dict("records")
    assert tuple(row) == SCORE_COLUMNS
    assert (row["case"], row["quantity"], row["n"], row["BS"], row["unit"]) == ("A1", "bow", 3, -3, "m")
    assert row["Q"] == pytest.approx(0.1)
    assert row["max_abs"] == pytest.approx(0.3)
    assert row["bias"] == pytest.approx(0.2)
    assert row["normalised_rms"] == pytest.approx(0.1)
    assert row["mean_absolute_percent"] == pytest.approx(10.0)
    assert row["note"] == "1 measured point(s) outside the computation"


def test_quality_of_the_defining_example():
    measured = pd.DataFrame({"speed": [1.0, 2.0], "bow": [1.0, 2.0]})
    computed = pd.DataFrame({"speed": [1.0, 2.0], "bow": [1.1, 1.8]})
    row = score_curves(measured, computed).iloc[0]
    assert (row["Q"], row["BS"], row["n"]) == (pytest.approx(0.100), 0, 2)


def test_relative_score_near_zero_is_guarded_and_said():
    measured = pd.DataFrame({"speed": [1.0, 2.0], "trim": [0.001, 0.5]})
    computed = pd.DataFrame({"speed": [1.0, 2.0], "trim": [0.1, 0.45]})
    row = score_curves(measured, computed, near_zero={"trim": 0.01}).iloc[0]
    assert row["n"] == 1
    assert row["Q"] == pytest.approx(0.1)
    assert "near zero" in row["note"]
    assert row["max_abs"] == pytest.approx(0.099)


@pytest.mark.parametrize(
    ("measured", "computed", "message"),
    [
        ({"v": [1.0], "bow": [1.0]}, {"speed": [1.0], "bow": [1.0]}, "measurement has no column 'speed'"),
        ({"speed": [1.0], "bow": [1.0]}, {"speed": [1.0], "stern": [1.0]}, "share no quantity"),
        (
            {"speed": [1.0], "bow": [1.0]},
            {"speed": [2.0, 3.0], "bow": [1.0, 2.0]},
            "reaches no measured speed of bow",
        ),
    ],
)
def test_what_cannot_be_scored_is_named(measured, computed, message):
    with pytest.raises(TowtankError, match=message):
        score_curves(pd.DataFrame(measured), pd.DataFrame(computed))


def test_codes_are_ranked_and_say_what_they_leave_out():
    measured = {"C1 bow": 1.0, "C1 stern": 2.0}
    codes = {
        "poor": {"C1 bow": 2.0, "C1 stern": 3.0},
        "short": {"C1 bow": 1.1},
        "good": {"C1 bow": 1.0, "C1 stern": 2.05},
    }
    table = score_codes(measured, codes)
    assert table["code"].tolist() == ["good", "short", "poor"]
    assert table["rank"].tolist() == [1, 2, 3]
    assert table["note"].tolist() == ["", "1 of 2 points", ""]
    assert table["rms"].tolist() == pytest.approx([0.05 / math.sqrt(2), 0.1, 1.0])
    with pytest.raises(TowtankError, match="none: has no point"):
        score_codes(measured, {"none": {"C9 bow": 1.0}})


def test_pooled_quality_is_the_quality_of_all_points_together():
    rng = np.random.default_rng(4)
    tables, all_errors = [], []
    for case, n in (("A", 3), ("B", 7)):
        speed = np.arange(1.0, n + 1.0)
        data = speed**2
        simulation = data * (1.0 + 0.1 * rng.standard_normal(n))
        all_errors.extend((data - simulation) / data)
        frames = (pd.DataFrame({"speed": speed, "bow": x}) for x in (data, simulation))
        tables.append(score_curves(*frames, case=case))
    (total,) = pooled_scores(pd.concat(tables)).to_dict("records")
    assert total["n"] == 10
    assert total["Q"] == pytest.approx(np.sqrt(np.mean(np.square(all_errors))))
    assert total["BS"] == int(np.sign(all_errors).sum())


def test_pooled_quality_and_bias_of_the_nine_cases():
    frame = load_table("baw-squat-scores").frame.query("case != 'sum'")
    long = pd.concat(
        pd.DataFrame(
            {"case": frame["case"], "quantity": q, "n": frame["n"], "Q": frame[f"Q_{q}"], "BS": frame[f"BS_{q}"]}
        )
        for q in ("bow", "stern", "cog", "trim")
    )
    total = pooled_scores(long).set_index("quantity")
    assert total["BS"].to_dict() == {"bow": -42, "stern": 57, "cog": 21, "trim": -69}
    assert set(total["n"]) == {69}
    assert total["Q"].to_dict() == pytest.approx(
        {"bow": 0.153, "stern": 0.208, "cog": 0.128, "trim": 1.11}, abs=6e-3
    )
