"""What scatters: covariances, percentages, both; and draws as vessels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.simulate.manoeuvres import turning
from towtank.simulate.parameter_scatter import (
    HULL,
    MMG_COEFFICIENTS,
    scatter_of,
    semidefinite_root,
    split_draws,
    value_of,
    vessel_of_draw,
)
from towtank.simulate.sailing import sail, sail_events
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")
NAMES = KVLCC2.hull.names


def correlated(share=0.03):
    """Covariance of the hull derivatives of KVLCC2 with neighbours correlated."""
    sd = share * np.abs(KVLCC2.hull.values)
    size = np.arange(len(sd))
    return np.outer(sd, sd) * 0.8 ** np.abs(size[:, None] - size)


def test_percentages_of_the_hull_and_of_named_coefficients():
    scatter = scatter_of(KVLCC2, percent=5, names=(HULL, *MMG_COEFFICIENTS))
    assert scatter.names == NAMES + MMG_COEFFICIENTS
    assert len(scatter.names) == 31
    np.testing.assert_allclose(scatter.sd, 0.05 * np.abs(scatter.center), rtol=1e-12)
    assert scatter.independent
    assert scatter.source == "independent 5 % of 31 numbers"
    assert scatter.center[scatter.names.index("rudder.eps")] == KVLCC2.rudder.eps


def test_percentages_by_name():
    scatter = scatter_of(KVLCC2, percent={HULL: 5, "Yv": 2, "rudder.kappa": 10, "R0": 0})
    sd = dict(zip(scatter.names, scatter.sd / np.abs(scatter.center), strict=True))
    assert (sd["Yv"], sd["Nv"], sd["rudder.kappa"]) == pytest.approx((0.02, 0.05, 0.10))
    assert "R0" not in sd


def test_covariance_of_the_set_is_the_default_and_exact_values_stay():
    matrix = correlated()
    matrix[NAMES.index("Xudot")] = matrix[:, NAMES.index("Xudot")] = 0.0
    vessel = KVLCC2.with_hull(replace(KVLCC2.hull, covariance=matrix))
    scatter = scatter_of(vessel)
    assert scatter.names == tuple(name for name in NAMES if name != "Xudot")
    assert not scatter.independent
    drawn = scatter.draws(20_000, seed=4)
    keep = [NAMES.index(name) for name in scatter.names]
    size = np.sqrt(np.diag(scatter.covariance))
    np.testing.assert_allclose(
        np.cov(drawn.T) / np.outer(size, size), matrix[np.ix_(keep, keep)] / np.outer(size, size), atol=0.04
    )
    assert np.abs((drawn.mean(axis=0) - scatter.center) / size).max() < 0.04


def test_covariance_and_percentages_together():
    scatter = scatter_of(KVLCC2, covariance=correlated(), percent=5)
    assert scatter.names == NAMES + MMG_COEFFICIENTS
    assert scatter.source == "covariance that was given; independent 5 % of 11 numbers"
    beside = len(NAMES)
    assert not np.any(scatter.covariance[:beside, beside:])
    np.testing.assert_array_equal(scatter.covariance[:beside, :beside], correlated())
    with pytest.raises(SimulationError, match=r"Yv would scatter by the covariance and by a percentage"):
        scatter_of(KVLCC2, covariance=correlated(), percent={"Yv": 5})


def test_numbers_that_follow_from_others_follow_in_every_draw():
    matrix = np.array([[4.0, 2.0, 6.0], [2.0, 5.0, 7.0], [6.0, 7.0, 13.0]])  # the third is the sum of the others
    root = semidefinite_root(matrix, "abc")
    np.testing.assert_allclose(root @ root.T, matrix, atol=1e-12)
    np.testing.assert_allclose(root[2], root[0] + root[1], atol=1e-12)
    assert not np.any(root[:, 2])
    np.testing.assert_array_equal(root, np.tril(root))


def test_a_draw_is_the_same_among_few_and_many():
    scatter = scatter_of(KVLCC2, covariance=correlated())
    np.testing.assert_array_equal(scatter.draws(5, seed=1), scatter.draws(400, seed=1)[:5])


def test_draws_for_the_kernel_are_those_of_the_vessels():
    scatter = scatter_of(KVLCC2, percent=4, names=("Nv", "rudder.eps", "propeller.wP0", "Yvdot"))
    rows = scatter.draws(3, seed=2)
    hull, beside = split_draws(KVLCC2, scatter.names, rows)
    together = sail_events(KVLCC2, turning(35), hull, beside, tolerance=1e-7).events
    for number, row in enumerate(rows):
        vessel = vessel_of_draw(KVLCC2, scatter.names, row)
        assert value_of(vessel, "Nv") == row[0]
        assert value_of(vessel, "rudder.eps") == row[1]
        alone = sail(vessel, turning(35)).events
        np.testing.assert_array_equal(alone["heading 180"][0], together["heading 180"][number])


FAULTS = {
    "no covariance": ({}, "has no covariance to draw from -> give percent=5"),
    "no covariance, asked for": ({"covariance": True}, "has no covariance to draw from"),
    "wrong size": ({"covariance": np.eye(3)}, r"shape \(3, 3\) for the 20 derivatives"),
    "not symmetric": ({"covariance": np.triu(np.ones((20, 20)))}, "not symmetric"),
    "not a number": ({"covariance": np.diag([np.nan] + [1.0] * 19)}, "covariance of R0 is not a number"),
    "unknown name": ({"percent": 5, "names": ("Yvvvv",)}, r"no number 'Yvvvv' -> it has R0, Xvv"),
    "of zero": ({"percent": 5, "names": ("rudder.cRr",)}, "cRr is 0, of which a percentage is no scatter"),
    "negative": ({"percent": -5}, "no standard deviation"),
    "nothing": ({"percent": 0}, "nothing of the vessel scatters"),
    "names twice": ({"percent": {"Yv": 5}, "names": ("Yv",)}, "by name need no further names"),
}


@pytest.mark.parametrize(("given", "message"), FAULTS.values(), ids=FAULTS)
def test_what_cannot_scatter_is_an_error(given, message):
    with pytest.raises(SimulationError, match=message):
        scatter_of(KVLCC2, **given)


def test_a_matrix_that_is_no_covariance_is_named_where_it_shows():
    matrix = np.diag(np.square(0.05 * KVLCC2.hull.values))
    i, j = NAMES.index("Yv"), NAMES.index("Nr")
    matrix[i, j] = matrix[j, i] = 1.5 * np.sqrt(matrix[i, i] * matrix[j, j])
    with pytest.raises(SimulationError, match=r"not positive semi-definite \(seen at Nr\)"):
        scatter_of(KVLCC2, covariance=matrix).draws(10)
