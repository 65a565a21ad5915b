"""Elasticities: known exponents, shares of the variance, what has none."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.simulate.elasticities import COLUMNS, elasticity_table, regress, relative_changes
from towtank.simulate.parameter_scatter import ParameterScatter

CENTER = np.array([2.0, -0.5, 3.0])
SD = 0.05 * np.abs(CENTER)
POWERS = (2.0, -1.5, 0.0)


def drawn(correlation=0.0, n=500, sd=SD):
    matrix = np.outer(sd, sd) * (np.eye(3) + correlation * (1.0 - np.eye(3)))
    scatter = ParameterScatter(("a", "b", "c"), CENTER, matrix)
    return scatter, scatter.draws(n, seed=1)


def law(parameters):
    a, b, c = parameters.T
    return 7.0 * a ** POWERS[0] * np.abs(b) ** POWERS[1] * c ** POWERS[2]


def table(scatter, parameters, values, reference):
    first = {"turning": {"advance": np.full(len(scatter.names), 9.0)}}
    return elasticity_table(
        {"turning": {"advance": values}}, {"turning": {"advance": reference}}, scatter, parameters, first
    )


@pytest.mark.parametrize("correlation", [0.0, 0.7, -0.4])
def test_exponents_of_a_power_law_are_found_exactly(correlation):
    scatter, parameters = drawn(correlation)
    found = table(scatter, parameters, law(parameters), float(law(CENTER[None])[0]))
    assert tuple(found.columns) == COLUMNS
    np.testing.assert_allclose(found["elasticity"], POWERS, atol=1e-10)
    assert found["share"].sum() == pytest.approx(1.0, abs=1e-10)
    assert found["first_order"].tolist() == [9.0] * 3


def test_shares_of_independent_parameters_are_those_of_their_variances():
    scatter, parameters = drawn(n=20_000)
    share = table(scatter, parameters, law(parameters), float(law(CENTER[None])[0]))["share"]
    whole = POWERS[0] ** 2 + POWERS[1] ** 2
    np.testing.assert_allclose(share, [POWERS[0] ** 2 / whole, POWERS[1] ** 2 / whole, 0.0], atol=0.02)


def test_standard_errors_are_those_of_the_noise():
    scatter, parameters = drawn(n=2000)
    noise = np.exp(0.02 * np.random.default_rng(2).standard_normal(2000))
    found = table(scatter, parameters, noise * law(parameters), float(law(CENTER[None])[0]))
    np.testing.assert_allclose(found["standard_error"], 0.02 / 0.05 / np.sqrt(2000), rtol=0.1)
    assert (np.abs(found["elasticity"] - np.array(POWERS)) < 4.0 * found["standard_error"]).all()


def test_draws_without_the_index_are_left_out():
    scatter, parameters = drawn()
    values = law(parameters)
    values[::3] = np.nan
    found = table(scatter, parameters, values, float(law(CENTER[None])[0]))
    np.testing.assert_allclose(found["elasticity"], POWERS, atol=1e-10)


def test_changes_across_zero_have_the_slope_of_small_ones():
    np.testing.assert_allclose(relative_changes(np.array([1.0, 4.0]), 2.0), np.log([0.5, 2.0]))
    np.testing.assert_allclose(relative_changes(np.array([-1.0, 4.0]), 2.0), [-1.5, 1.0])
    np.testing.assert_allclose(relative_changes(np.array([-1.0, -4.0]), -2.0), np.log([0.5, 2.0]))


def test_a_parameter_that_is_zero_has_a_share_but_no_elasticity():
    scatter = ParameterScatter(("a", "b"), np.array([2.0, 0.0]), np.diag([0.01, 0.04]))
    parameters = scatter.draws(400, seed=3)
    values = np.exp(parameters[:, 1])
    found = table(scatter, parameters, values, 1.0)
    assert np.isnan(found["elasticity"][1])
    assert np.isnan(found["first_order"][1])
    assert found["share"][1] == pytest.approx(1.0, abs=1e-9)
    assert found["elasticity"][0] == pytest.approx(0.0, abs=1e-9)


def test_indices_that_are_zero_or_unknown_are_left_out():
    scatter, parameters = drawn()
    assert table(scatter, parameters, law(parameters), 0.0).empty
    assert table(scatter, parameters, law(parameters), np.nan).empty


@pytest.mark.parametrize("kind", ["too few draws", "dependent columns", "constant column"])
def test_slopes_that_the_draws_cannot_tell_are_unknown(kind):
    changes = np.random.default_rng(1).standard_normal((4 if kind == "too few draws" else 50, 3))
    if kind == "dependent columns":
        changes[:, 2] = changes[:, 0] - 2.0 * changes[:, 1]
    if kind == "constant column":
        changes[:, 2] = 1.0
    for found in regress(changes, changes[:, :1]):
        assert found.shape == (3, 1)
        assert np.all(np.isnan(found))
