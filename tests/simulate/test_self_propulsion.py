"""Self-propulsion point."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.simulate.packing import pack
from towtank.simulate.self_propulsion import self_propulsion_rates
from towtank.simulate.ships import named_ship


def test_rate_balances_thrust_and_resistance_in_closed_form():
    vessel = named_ship("kvlcc2")
    ship, p, speed = vessel.ship, vessel.propeller, vessel.speed
    resistance = 0.5 * ship.rho * ship.L * ship.T * speed**2 * vessel.hull["R0"]
    flow = speed * (1.0 - p.wP0)
    # (1-t) rho D^2 (k0 (nD)^2 + k1 nD uA + k2 uA^2) = R
    k0, k1, k2 = p.KT
    right = resistance / ((1.0 - p.tP) * ship.rho * p.D**2)
    tip = (-k1 * flow + math.sqrt((k1 * flow) ** 2 - 4.0 * k0 * (k2 * flow**2 - right))) / (2.0 * k0)
    assert self_propulsion_rates(pack(vessel), speed)[0] == pytest.approx(tip / p.D, rel=1e-12)


def test_kcs_turns_115_rpm_as_printed():
    rate = self_propulsion_rates(pack(named_ship("kcs")), named_ship("kcs").speed)[0]
    assert 60.0 * rate == pytest.approx(115.5, abs=0.2)


def test_draws_are_balanced_one_by_one_and_impossible_ones_are_nan():
    vessel = named_ship("kvlcc2")
    values = np.repeat(vessel.hull.values[None], 3, axis=0)
    values[1, vessel.hull.names.index("R0")] *= 1.2
    values[2, vessel.hull.names.index("R0")] = -0.05
    rates = self_propulsion_rates(pack(vessel, values), vessel.speed)
    assert rates[1] > rates[0]
    assert math.isnan(rates[2])
