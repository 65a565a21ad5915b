from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.model_selection import compare_models, left_out_runs, range_sensitivity
from towtank.identify.regression import fit_linear

RNG = np.random.default_rng(0)
G = 15
run_of_row = np.repeat(np.arange(G), 4)
V = np.repeat(np.linspace(-0.35, 0.35, G), 4)
COLUMNS = {"Y0": np.ones(V.size), "Yv": V, "Yvvv": V**3, "Yvav": V * np.abs(V), "Yvv": V**2}
NAMES = tuple(COLUMNS)
X = np.column_stack(list(COLUMNS.values()))
Y = -0.3 * V - 2.5 * V**3 + 0.005 * RNG.standard_normal(V.size)
MODELS = {"cubic": ["Yv", "Yvvv"], "modulus": ["Yv", "Yvav"], "linear": ["Yv"], "all": list(NAMES)}


def test_true_model_comes_first() -> None:
    table = compare_models(X, Y, NAMES, MODELS, groups=run_of_row)
    assert table.index[0] == "cubic"
    assert table["delta"].iloc[0] == 0.0
    assert table["weight"].sum() == pytest.approx(1.0)
    assert table["cv_rmse"].idxmin() == "cubic"
    assert table.loc["linear", "cv_rmse"] > 2.0 * table.loc["cubic", "cv_rmse"]
    assert table.loc["all", "terms"] == 5


def test_aicc_is_the_fits_own_and_shrinks_with_effective_rows() -> None:
    fit = fit_linear(X[:, [1, 2]], Y, ["Yv", "Yvvv"])
    assert compare_models(X, Y, NAMES, MODELS).loc["cubic", "aicc"] == pytest.approx(fit.aicc, rel=1e-12)
    full = compare_models(X, Y, NAMES, MODELS).loc["modulus", "delta"]
    fewer = compare_models(X, Y, NAMES, MODELS, n_eff=15).loc["modulus", "delta"]
    assert 0.0 < fewer < 0.5 * full


def test_left_out_runs_equal_refits() -> None:
    fit = fit_linear(X[:, 1:3], Y, NAMES[1:3], groups=run_of_row)
    score = left_out_runs(fit)
    errors = []
    for g in range(G):
        kept = run_of_row != g
        params = np.linalg.lstsq(X[kept, 1:3], Y[kept], rcond=None)[0]
        errors.append(Y[~kept] - X[~kept, 1:3] @ params)
        assert score.group_rmse[g] == pytest.approx(np.sqrt(np.mean(errors[-1] ** 2)), rel=1e-9)
    press = np.sum(np.square(errors))
    assert score.rmse == pytest.approx(np.sqrt(press / V.size), rel=1e-10)
    assert score.q2 == pytest.approx(1.0 - press / np.sum(Y**2), rel=1e-10)
    assert score.undetermined == []


def test_run_that_alone_supports_a_term_cannot_be_left_out() -> None:
    design = np.column_stack([V, np.where(run_of_row == 5, RNG.standard_normal(V.size), 0.0)])
    score = left_out_runs(fit_linear(design, Y, ["Yv", "Yx"], groups=run_of_row))
    assert score.undetermined == [5]
    assert score.rmse == np.inf


def test_range_sensitivity_refits_on_the_rows_within_each_limit() -> None:
    table = range_sensitivity(X[:, 1:3], Y, NAMES[1:3], V, [0.2, 0.35])
    kept = np.abs(V) <= 0.2 + 1e-12
    fit = fit_linear(X[kept, 1:3], Y[kept], NAMES[1:3])
    row = table[(table["limit"] == 0.2) & (table["name"] == "Yvvv")].iloc[0]
    assert row["rows"] == kept.sum()
    assert row["value"] == pytest.approx(fit["Yvvv"])
    assert row["upper"] == pytest.approx(fit.conf_int()[1, 1])
    assert len(table) == 4


def test_limit_without_rows_says_nothing() -> None:
    table = range_sensitivity(X[:, 1:3], Y, NAMES[1:3], V, [0.01, 0.35])
    assert table.loc[table["limit"] == 0.01, "value"].isna().all()
    with pytest.raises(FitError, match="no limit leaves"):
        range_sensitivity(X[:, 1:3], Y, NAMES[1:3], V, [0.0])
    with pytest.raises(FitError, match="3 values"):
        range_sensitivity(X[:, 1:3], Y, NAMES[1:3], V[:3], [0.1])


def test_unknown_terms_and_empty_lists_are_refused() -> None:
    with pytest.raises(FitError, match="no column for Yr"):
        compare_models(X, Y, NAMES, {"m": ["Yv", "Yr"]})
    with pytest.raises(FitError, match="no model"):
        compare_models(X, Y, NAMES, {})
