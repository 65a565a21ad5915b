"""Tables of results against a reference, and rankings."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.datasets import load_set
from towtank.report.table_comparison import (
    compare_curves,
    compare_values,
    rank_sets,
    rank_values,
    ranking_text,
    values_text,
)


def table(rows):
    return pd.DataFrame(rows, columns=["quantity", "value", "uncertainty", "unit"])


REFERENCE = table([("X", 10.0, 0.6, "N"), ("N", 0.0, 0.1, ""), ("only A", 1.0, 0.1, "")])


def test_values_are_scored_with_their_uncertainties():
    comparison = compare_values(
        REFERENCE, table([("X", 11.0, 0.8, "N"), ("N", 0.1, math.nan, "N m"), ("B", 1.0, 0.1, "")])
    )
    rows = comparison.set_index("name")
    assert rows.loc["X", "z"] == pytest.approx(1.0 / 0.5)
    assert rows.loc["X", "s_minus_d"] == pytest.approx(10.0)
    assert comparison.attrs == {"Q": pytest.approx(0.1), "BS": -1, "n": 1}
    text = values_text(comparison, "tank.csv", "cfd.csv")
    assert "A: tank.csv" in text
    assert "only in B" in text
    assert "only in A" in text
    assert "A is zero; z without the unknown uncertainty of B" in text
    assert "Q = 0.100" in text


def test_units_and_names_must_agree():
    with pytest.raises(TowtankError, match="quantity X: one table in 'N', the other in 'kN'"):
        compare_values(REFERENCE, table([("X", 11.0, 0.8, "kN")]))
    with pytest.raises(TowtankError, match="share no quantity: X, N, only A against Y"):
        compare_values(REFERENCE, table([("Y", 11.0, 0.8, "N")]))


def test_a_ranking_is_by_relative_error():
    ranking = rank_values(
        {"X": 10.0, "N": 0.1, "zero": 0.0}, {"far": {"X": 10.0, "N": 0.2}, "near": {"X": 12.0, "N": 0.1}}
    )
    assert ranking["code"].tolist() == ["near", "far"]
    assert ranking["Q"].tolist() == pytest.approx([math.sqrt(0.02), math.sqrt(0.5)])
    assert ranking_text(ranking).splitlines()[1].split()[:2] == ["1", "near"]


def test_sets_are_ranked_in_one_convention():
    reference = load_set("dtmb5512-efd")
    near = replace(reference, name="near", values=1.02 * reference.values).to("prime")
    far = replace(reference, name="far", values=0.9 * reference.values)
    ranking = rank_sets(reference, [far, near, near])
    assert ranking["code"].tolist() == ["near", "near (3)", "far"]
    np.testing.assert_allclose(ranking["Q"], [0.02, 0.02, 0.1], rtol=1e-9)


def test_curves_are_scored_at_the_measured_points_and_pooled():
    measured = pd.DataFrame({"beta": [0.0, 5.0, 10.0], "Y": [1.0, 2.0, 4.0]})
    codes = {
        "a.csv": pd.DataFrame({"beta": [0.0, 10.0], "Y": [1.1, 4.4]}),
        "b.csv": pd.DataFrame({"beta": [0.0, 5.0], "Y": [1.0, 2.2]}),
    }
    scores, pooled = compare_curves(measured, codes, "beta")
    assert scores["n"].tolist() == [3, 2]
    assert scores["Q"].iloc[1] == pytest.approx(math.sqrt(0.005))
    assert pooled["n"].tolist() == [5]
    with pytest.raises(TowtankError, match="no column 'speed'"):
        compare_curves(measured, codes, "speed")
