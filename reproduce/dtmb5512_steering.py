"""DTMB 5512 in a turn: the printed derivatives diverge, and the divergence is said."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..core.errors import SimulationError
from ..simulate.manoeuvres import turning
from ..simulate.sailing import sail
from ..simulate.ships import named_ship
from .case import Case

_AFTER = re.compile(r"after ([0-9.]+) s")


def steering_cases(key: str) -> Iterator[Case]:
    """Equations 32 to 34 with Tables 16, 17 and 18, 35 deg of rudder at 0.04 rad/s."""
    vessel = named_ship("dtmb5512")
    for rudder in (35.0, -35.0):
        lengths = _diverges_after(rudder) * vessel.speed / vessel.ship.L
        yield Case(
            key,
            f"turn with {rudder:+g} deg",
            "ship lengths sailed when the motion diverges (recomputed reference)",
            2.4,
            lengths,
            0.3,
            note="the bare hull is directionally unstable, Nvrr feeds the turn and no thrust recovers the speed; "
            "the paper prints its circle as a figure only",
        )


def _diverges_after(rudder: float) -> float:
    """Seconds until the simulator reports the divergence; infinity when it does not."""
    try:
        sail(named_ship("dtmb5512"), turning(rudder))
    except SimulationError as error:
        match = _AFTER.search(str(error))
        if "diverges" in str(error) and match:
            return float(match[1])
        raise
    return float("inf")
