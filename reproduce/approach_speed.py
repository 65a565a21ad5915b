"""Speed at which a propeller at a given rate keeps a ship on a straight course."""

from __future__ import annotations

from ..core.errors import SimulationError
from ..simulate.packing import pack
from ..simulate.self_propulsion import self_propulsion_rates
from ..simulate.vessel import Vessel


def steady_speed(vessel: Vessel) -> float:
    """Speed in m/s whose self-propulsion rate is the rate of the vessel.

    Raises
    ------
    SimulationError
        When the vessel has no rate, or no speed up to four times its own goes with it.
    """
    from scipy.optimize import brentq

    if vessel.rate is None:
        raise SimulationError(f"vessel '{vessel.name}' has no propeller rate", cure="give the rate in 1/s")
    wanted = vessel.rate
    packed = pack(vessel)

    def excess(speed: float) -> float:
        return float(self_propulsion_rates(packed, speed)[0]) - wanted

    low, high = 0.05 * vessel.speed, 4.0 * vessel.speed
    if not excess(low) * excess(high) < 0.0:
        raise SimulationError(
            f"'{vessel.name}' has no steady speed at {60.0 * wanted:.4g} rpm",
            cure="check resistance and propeller",
        )
    return float(brentq(excess, low, high, xtol=1e-10))
