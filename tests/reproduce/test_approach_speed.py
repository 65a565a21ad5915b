"""Steady speed at a propeller rate: the inverse of the self-propulsion point."""

import pytest

from towtank.core.errors import SimulationError
from towtank.reproduce.approach_speed import steady_speed
from towtank.simulate.packing import pack
from towtank.simulate.self_propulsion import self_propulsion_rates
from towtank.simulate.ships import named_ship


def test_inverse_of_the_self_propulsion_point():
    vessel = named_ship("kvlcc2")
    rate = float(self_propulsion_rates(pack(vessel), 1.0)[0])
    assert steady_speed(vessel.but(rate=rate)) == pytest.approx(1.0, rel=1e-8)


def test_a_vessel_without_rate_or_without_speed_is_refused():
    with pytest.raises(SimulationError, match="no propeller rate"):
        steady_speed(named_ship("kvlcc2"))
    with pytest.raises(SimulationError, match="no steady speed"):
        steady_speed(named_ship("kvlcc2").but(rate=1e4))
