"""Measured damping beside the Ikeda components."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.ikeda import IkedaHull, ikeda_damping
from towtank.decay.ikeda_comparison import beside_ikeda
from towtank.decay.integration_fit import fit_integration
from towtank.decay.virtual_decay import demo_plan, virtual_decay


@pytest.fixture(scope="module")
def fitted():
    plan = replace(demo_plan(), pushes=0, rest_cycles=0.0, white=0.0, ar1=0.0, drift=0.0, offset=0.0)
    return fit_integration(virtual_decay(plan).record)


def test_table_has_both_at_the_same_amplitudes(fitted):
    hull = IkedaHull.of_ship(fitted.ship, 0.99)
    amplitude = np.radians([3.0, 6.0, 10.0])
    found = beside_ikeda(fitted, hull, amplitude)
    table = found.table
    assert table["amplitude_deg"].to_numpy() == pytest.approx([3.0, 6.0, 10.0])
    ship = fitted.ship
    inertia = ship.displacement_mass * 9.80665 * ship.GM / 6.06
    alpha = 0.0021 + 4.0 / (3.0 * math.pi) * math.sqrt(6.06) * amplitude * 0.11
    unit = hull.damping_unit(ship.rho)
    assert table["measured"].to_numpy() == pytest.approx(2.0 * alpha * inertia / unit, rel=1e-4)
    assert table["predicted"].to_numpy() == pytest.approx(
        ikeda_damping(hull, amplitude, math.sqrt(6.06)).total, rel=1e-4
    )
    assert table["ratio"].to_numpy() == pytest.approx((table["predicted"] / table["measured"]).to_numpy())
    assert found.findings == ()


def test_particulars_outside_the_regressions_are_passed_on(fitted):
    found = beside_ikeda(fitted, IkedaHull.of_ship(fitted.ship, 0.998))
    assert [finding.place for finding in found.findings] == ["CM"]


def test_scales_must_agree(fitted):
    hull = IkedaHull.of_ship(fitted.ship.at_scale(1.0), 0.99)
    with pytest.raises(FitError, match="one scale"):
        beside_ikeda(fitted, hull)
