"""First-order propagation: sensitivities, laws of scale, correlated spread, agreement with small draws."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.simulate.ensembles import ensemble
from towtank.simulate.first_order import propagate
from towtank.simulate.manoeuvre_indices import event_indices
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.parameter_scatter import scatter_of
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")
PROGRAMMES = (turning(35, 180), zigzag(10, overshoots=2))
TURN, ZIGZAG = "turning +35", "zigzag +10/10"
NAMES = ("Nv", "Nr", "rudder.eps")


def index_of(vessel, programme, index):
    trajectory = sail(vessel, programme, tolerance=1e-9)
    return float(event_indices(programme.name, trajectory.events, vessel.ship, vessel.speed)[index][0])


def test_sensitivity_is_the_slope_between_two_runs():
    found = propagate(KVLCC2, PROGRAMMES, scatter_of(KVLCC2, percent=5, names=NAMES))
    for programme, index in ((PROGRAMMES[0], "tactical diameter"), (PROGRAMMES[1], "overshoot 2")):
        step = 0.002 * KVLCC2.hull["Nv"]
        high, low = (
            index_of(KVLCC2.with_hull(KVLCC2.hull.with_values(Nv=KVLCC2.hull["Nv"] + d)), programme, index)
            for d in (step, -step)
        )
        assert found.values[programme.name][index] == pytest.approx(index_of(KVLCC2, programme, index), rel=1e-6)
        slope = found.sensitivities[programme.name][index][0]
        assert slope == pytest.approx((high - low) / (2.0 * step), rel=5e-3)


def test_factors_of_one_product_have_the_same_elasticity():
    scatter = scatter_of(KVLCC2, percent=5, names=("rudder.area", "rudder.f_alpha"))
    for indices in propagate(KVLCC2, PROGRAMMES, scatter).elasticities.values():
        for index, (area, slope) in indices.items():
            assert area == pytest.approx(slope, abs=1e-5, nan_ok=True), index


def test_spread_of_correlated_numbers():
    both = [KVLCC2.hull.names.index(name) for name in ("Nv", "Nr")]
    sd = 0.05 * np.abs(KVLCC2.hull.values[both])
    spread = {}
    for correlation in (-0.9, 0.0, 0.9):
        matrix = np.zeros((len(KVLCC2.hull),) * 2)
        matrix[np.ix_(both, both)] = np.outer(sd, sd) * [[1.0, correlation], [correlation, 1.0]]
        found = propagate(KVLCC2, PROGRAMMES[1:], scatter_of(KVLCC2, covariance=matrix))
        slope = found.sensitivities[ZIGZAG]["overshoot 2"] * sd
        expected = np.sqrt(slope @ slope + 2.0 * correlation * slope[0] * slope[1])
        assert found.sd(ZIGZAG, "overshoot 2") == pytest.approx(expected, rel=1e-12)
        spread[correlation] = expected
    # a stronger Nv raises the overshoot, a stronger Nr (both negative) lowers it: together they cancel
    assert spread[0.9] < 0.7 * spread[0.0] < 0.7 * spread[-0.9]


def test_table_has_normal_quantiles():
    found = propagate(KVLCC2, PROGRAMMES[:1], scatter_of(KVLCC2, percent=5, names=NAMES))
    row = found.table().set_index("index").loc["tactical diameter"]
    assert row["value"] == pytest.approx(3.108, abs=2e-3)
    assert row["p95"] - row["value"] == pytest.approx(1.6448536 * row["sd"], rel=1e-6)
    assert row["value"] - row["p05"] == pytest.approx(row["p95"] - row["value"], rel=1e-9)


def test_small_draws_have_the_spread_of_the_first_order():
    found = ensemble(KVLCC2, PROGRAMMES, n=1500, percent=0.5, names=NAMES, sampling="antithetic", tolerance=1e-7)
    table = found.comparison.set_index(["manoeuvre", "index"])
    for place in (
        (TURN, "advance"),
        (TURN, "tactical diameter"),
        (ZIGZAG, "overshoot 1"),
        (ZIGZAG, "overshoot 2"),
    ):
        assert abs(table.loc[place, "difference_pct"]) < 8.0, place  # four standard errors of the spread
        assert abs(table.loc[place, "mean_shift"]) < 0.02 * table.loc[place, "sd"]
