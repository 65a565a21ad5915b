"""Statistics of the indices."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.simulate.ensemble_table import COLUMNS, index_statistics


def test_statistics_are_of_the_draws_that_have_a_value():
    values = np.append(np.arange(1.0, 102.0), [np.nan] * 9)
    found = index_statistics({"turning +35": {"advance": values}}, {"turning +35": {"advance": 50.0}})
    assert tuple(found.columns) == COLUMNS
    assert COLUMNS[:7] == ("manoeuvre", "index", "value", "unit", "sd", "p05", "p95")
    row = found.iloc[0]
    assert (row["manoeuvre"], row["index"], row["value"], row["unit"]) == ("turning +35", "advance", 50.0, "L")
    assert (row["mean"], row["p05"], row["p50"], row["p95"], row["draws"]) == (51.0, 6.0, 51.0, 96.0, 101)
    assert row["sd"] == pytest.approx(np.std(np.arange(101), ddof=1))


def test_indices_that_nobody_has_are_left_out():
    nothing = np.full(5, np.nan)
    found = index_statistics(
        {
            "zigzag +10/10": {
                "period": nothing,
                "overshoot 1": nothing,
                "overshoot 2": np.array([3.0] + [np.nan] * 4),
            }
        },
        {"zigzag +10/10": {"period": np.nan, "overshoot 1": 5.0, "overshoot 2": np.nan}},
    )
    assert found["index"].tolist() == ["overshoot 1", "overshoot 2"]
    assert found["draws"].tolist() == [0, 1]
    assert found[["sd", "mean", "p95"]].isna().to_numpy().tolist() == [[True] * 3, [True, False, False]]
    assert np.isnan(found["value"][1])
