"""Polynomial chaos by regression and by projection."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import FitError, TowtankError
from towtank.verify import fit_chaos, latin_hypercube, project_chaos, quadrature
from towtank.verify.input_distribution import UncertainInput

HEIGHT = UncertainInput("height", "normal", (62.35, 0.64))
PERIOD = UncertainInput("period", "normal", (1.38, 0.01))
WAVE = (HEIGHT, PERIOD)
# MASHCON 2019, DTC in head waves, Tables 4 and 5
RUNS = np.array(
    [
        [61.305, 1.377, 0.1765],
        [62.204, 1.374, 0.1761],
        [63.584, 1.389, 0.1907],
        [62.380, 1.395, 0.1898],
        [62.880, 1.369, 0.1729],
        [61.752, 1.380, 0.1799],
    ]
)
MIXED = (
    UncertainInput("a", "uniform", (0.0, 2.0)),
    UncertainInput("b", "gamma", (2.0, 0.5)),
    UncertainInput("c", "beta", (2.0, 3.0, -1.0, 4.0)),
)


def response(x):
    """A polynomial of order 2 with two outputs."""
    a, b, c = np.asarray(x).T
    return np.column_stack([1.0 + 2.0 * a - b * c + 0.5 * c**2, a * b])


def test_heave_of_the_paper():
    fit = fit_chaos(WAVE, RUNS[:, :2], RUNS[:, 2], 1)
    assert fit.mean[0] == pytest.approx(0.1805127, abs=1e-7)
    assert fit.sd[0] == pytest.approx(0.0071707, abs=1e-7)
    assert fit.coefficients[1:, 0] == pytest.approx([0.00140123, 0.00703243], abs=1e-8)
    assert fit.r2[0] == pytest.approx(0.983, abs=5e-4)
    assert fit.oversampling == 2.0
    assert fit.notes == ()


@pytest.mark.parametrize("grid", ["tensor", "sparse"])
def test_projection_of_a_polynomial_is_exact(grid):
    fit = project_chaos(MIXED, 2, response, grid=grid)
    nodes, weights = quadrature(MIXED, 6)
    values = response(nodes)
    np.testing.assert_allclose(fit.mean, weights @ values, rtol=1e-11)
    np.testing.assert_allclose(fit.variance, weights @ values**2 - (weights @ values) ** 2, rtol=1e-10)
    x = latin_hypercube(MIXED, 5, seed=1).to_numpy()
    np.testing.assert_allclose(fit.predict(x), response(x), rtol=1e-10)


def test_regression_of_a_polynomial_is_exact_and_equals_projection():
    samples = latin_hypercube(MIXED, 20, seed=4)
    fit = fit_chaos(MIXED, samples, pd.DataFrame(response(samples.to_numpy()), columns=["y", "z"]), 2)
    projected = project_chaos(MIXED, 2, response)
    np.testing.assert_allclose(fit.coefficients, projected.coefficients, rtol=1e-9, atol=1e-10)
    assert fit.outputs == ("y", "z")
    np.testing.assert_allclose(fit.r2, 1.0, atol=1e-12)
    np.testing.assert_allclose(fit.leave_one_out, 0.0, atol=1e-12)


def test_values_at_the_nodes_may_be_given_instead_of_a_function():
    nodes, _ = quadrature(MIXED, 3)
    given = project_chaos(MIXED, 2, response(nodes))
    np.testing.assert_array_equal(given.coefficients, project_chaos(MIXED, 2, response).coefficients)
    with pytest.raises(FitError, match="26 values for the 27 nodes"):
        project_chaos(MIXED, 2, response(nodes)[:-1])


def test_columns_of_a_frame_are_found_by_name():
    frame = pd.DataFrame({"period": RUNS[:, 1], "height": RUNS[:, 0]})
    fit = fit_chaos(WAVE, frame, RUNS[:, 2], 1)
    np.testing.assert_allclose(fit.coefficients, fit_chaos(WAVE, RUNS[:, :2], RUNS[:, 2], 1).coefficients)
    with pytest.raises(FitError, match="no column 'height'"):
        fit_chaos(WAVE, frame.drop(columns="height"), RUNS[:, 2], 1)


def test_leave_one_out_is_what_refitting_without_each_run_gives():
    fit = fit_chaos(WAVE, RUNS[:, :2], RUNS[:, 2], 1)
    y = RUNS[:, 2]
    squares = []
    for out in range(len(y)):
        kept = np.arange(len(y)) != out
        squares.append(
            (fit_chaos(WAVE, RUNS[kept, :2], y[kept], 1).predict(RUNS[out : out + 1, :2])[0, 0] - y[out]) ** 2
        )
    assert fit.leave_one_out[0] == pytest.approx(sum(squares) / np.sum((y - y.mean()) ** 2), rel=1e-9)


def test_standard_errors_of_coefficients_are_those_of_least_squares():
    import statsmodels.api as sm

    fit = fit_chaos(WAVE, RUNS[:, :2], RUNS[:, 2], 1)
    germs = fit.basis.germs(RUNS[:, :2])
    ols = sm.OLS(RUNS[:, 2], sm.add_constant(germs)).fit()
    np.testing.assert_allclose(fit.coefficients[:, 0], ols.params, rtol=1e-10)
    np.testing.assert_allclose(fit.coefficient_sd[:, 0], ols.bse, rtol=1e-9)


def test_as_many_runs_as_coefficients_is_said():
    fit = fit_chaos(WAVE, RUNS[:, :2], RUNS[:, 2], 2)
    assert "the fit passes through all" in fit.notes[0]
    assert np.isnan(fit.coefficient_sd).all()
    assert np.isnan(fit.leave_one_out).all()
    few = fit_chaos(WAVE, RUNS[:5, :2], RUNS[:5, 2], 1)
    assert "2 are recommended" in few.notes[0]


def test_correlated_samples_are_said():
    samples = RUNS[:, :2].copy()
    samples[:, 1] = 1.38 + 0.01 * (samples[:, 0] - 62.35) / 0.64 + [0, 1e-3, 0, -1e-3, 0, 1e-3]
    fit = fit_chaos(WAVE, samples, RUNS[:, 2], 1)
    assert "samples of height and period are correlated (+0.99" in fit.notes[0] or "(+1.00" in fit.notes[0]


def test_a_constant_response_has_no_variance():
    fit = fit_chaos(WAVE, RUNS[:, :2], np.full(6, 3.0), 1)
    assert fit.mean[0] == pytest.approx(3.0)
    assert fit.sd[0] == 0.0
    assert fit.coefficient_frame()["share"].isna().all()
    assert np.isnan(fit.r2[0])


def test_what_cannot_be_fitted_is_named():
    x, y = RUNS[:, :2], RUNS[:, 2]
    with pytest.raises(
        FitError, match=r"6 samples are too few for order 3 in 2 input\(s\): 10 coefficients.*run 20"
    ):
        fit_chaos(WAVE, x, y, 3)
    with pytest.raises(FitError, match="y of sample 3 is no number"):
        fit_chaos(WAVE, x, np.where(np.arange(6) == 2, np.nan, y), 1)
    with pytest.raises(FitError, match="do not separate the 3 coefficients"):
        fit_chaos(WAVE, np.column_stack([x[:, 0], np.full(6, 1.38)]), y, 1)
    with pytest.raises(FitError, match="6 samples of the inputs but 5"):
        fit_chaos(WAVE, x, y[:5], 1)
    with pytest.raises(TowtankError, match="height = nan"):
        fit_chaos(WAVE, np.where(x == x[0, 0], np.nan, x), y, 1)


def test_a_level_that_is_too_low_is_said():
    assert "cannot resolve order 2" in project_chaos(MIXED, 2, response, level=2).notes[0]


def test_draws_have_the_moments_of_the_expansion():
    fit = project_chaos(MIXED, 2, response)
    draws = fit.sample(40_000, seed=1)
    np.testing.assert_allclose(draws.mean(axis=0), fit.mean, rtol=0.02)
    np.testing.assert_allclose(draws.std(axis=0), fit.sd, rtol=0.05)


def test_the_coefficient_table_shares_out_the_variance():
    frame = project_chaos(MIXED, 2, response).coefficient_frame()
    assert frame.groupby("output")["share"].sum().tolist() == pytest.approx([1.0, 1.0])
    assert {"order of a", "order of b", "order of c", "norm", "coefficient"} <= set(frame.columns)
