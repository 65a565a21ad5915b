"""Programmes by the names that people write: ``turning 35``, ``zigzag 20/20``, ``crash stop``, ..."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from difflib import get_close_matches

from ..core.errors import SimulationError, TowtankError
from . import manoeuvres
from .manoeuvre_names import KINDS, WORDS, NamedManoeuvre, read_manoeuvre_name
from .programme import Programme

IMO_SET = (
    "turning 35",
    "turning -35",
    "zigzag 10/10",
    "zigzag -10/10",
    "zigzag 20/20",
    "zigzag -20/20",
    "initial turning 10",
    "initial turning -10",
)
"""Manoeuvres of IMO resolution MSC.137(76), both sides, without the stopping test."""

SPIRAL_YAW_RATES = (0.15, 0.1, 0.075, 0.05, 0.025, 0.0, -0.025, -0.05, -0.075, -0.1, -0.15)
"""Yaw rates of the reverse spiral in U0/L: the part about the straight course that decides on stability."""

SPIRAL_GAINS = (1.0, 0.5)
"""Gains of the reverse spiral: rudder over yaw rate error in L/U0, and over its integral."""

_NUMBERS = r"[+-]?\d+(\.\d+)?(\s*/\s*\d+(\.\d+)?)?(\s*deg)?"


def named_programme(name: str, tick: float) -> Programme:
    """A standard manoeuvre by its name.

    Parameters
    ----------
    name : str
        Kind and angles in degrees, positive to starboard: ``turning 35``, ``zigzag -20/20`` (rudder / heading),
        ``initial turning 10``, ``pull-out 20``, ``spiral``, ``reverse spiral``, ``crash stop``, ``williamson 35``.
        Angles that are left out are those of the builders in :mod:`towtank.simulate.manoeuvres`.
    tick : float
        L/U0 in s: time scale of the yaw rates and gains of a reverse spiral.

    Raises
    ------
    SimulationError
        For an unknown manoeuvre, with those nearest to it; for numbers that it does not have.
    """
    wanted = _read(name)
    if wanted.heading is not None and wanted.kind not in ("zigzag", "initial turning"):
        raise SimulationError(
            f"'{name}': a {wanted.kind} has no second angle", cure=f"write e.g. '{_EXAMPLES[wanted.kind]}'"
        )
    if wanted.rudder is not None and wanted.kind in ("spiral", "reverse spiral", "crash stop"):
        raise SimulationError(f"'{name}': a {wanted.kind} has no angle", cure=f"write '{wanted.kind}'")
    return _BUILDERS[wanted.kind](wanted, tick)


def _read(name: str) -> NamedManoeuvre:
    try:
        found = read_manoeuvre_name(name)
    except TowtankError as error:
        close = get_close_matches(name.strip().lower().rstrip("0123456789/+-. "), KINDS, n=3, cutoff=0.5)
        cure = f"did you mean {', '.join(close)}" if close else error.cure
        raise SimulationError(error.cause, cure=cure) from None
    if not re.fullmatch(rf"({dict(WORDS)[found.kind]})[ _]*({_NUMBERS})?", name.strip().lower()):
        raise SimulationError(
            f"'{name}' cannot be read: {found.kind}", cure=f"write e.g. '{_EXAMPLES[found.kind]}'"
        )
    return found


def _zigzag(wanted: NamedManoeuvre, tick: float) -> Programme:
    if wanted.rudder is None:
        raise SimulationError("a zig-zag needs its rudder angle", cure="write e.g. 'zigzag 20/20'")
    return manoeuvres.zigzag(wanted.rudder, wanted.heading)


def _initial_turning(wanted: NamedManoeuvre, tick: float) -> Programme:
    rudder = 10.0 if wanted.rudder is None else wanted.rudder
    if wanted.heading not in (None, 10.0):
        raise SimulationError(
            f"the initial turning test ends at a heading change of 10 deg, not {wanted.heading:g}",
            cure="write e.g. 'initial turning 10'",
        )
    return manoeuvres.initial_turning(rudder)


def _reverse_spiral(wanted: NamedManoeuvre, tick: float) -> Programme:
    gain, integral = SPIRAL_GAINS
    rates = [math.degrees(rate / tick) for rate in SPIRAL_YAW_RATES]
    return manoeuvres.reverse_spiral(rates, gain * tick, integral)


def _with_rudder(
    build: Callable[[float], Programme], usual: float
) -> Callable[[NamedManoeuvre, float], Programme]:
    return lambda wanted, tick: build(usual if wanted.rudder is None else wanted.rudder)


_BUILDERS: dict[str, Callable[[NamedManoeuvre, float], Programme]] = {
    "turning": _with_rudder(manoeuvres.turning, 35.0),
    "zigzag": _zigzag,
    "initial turning": _initial_turning,
    "pull-out": _with_rudder(manoeuvres.pull_out, 20.0),
    "spiral": lambda wanted, tick: manoeuvres.spiral(),
    "reverse spiral": _reverse_spiral,
    "crash stop": lambda wanted, tick: manoeuvres.crash_stop(),
    "williamson": _with_rudder(manoeuvres.williamson, 35.0),
}

_EXAMPLES = {
    "turning": "turning 35",
    "zigzag": "zigzag 20/20",
    "initial turning": "initial turning 10",
    "pull-out": "pull-out 20",
    "spiral": "spiral",
    "reverse spiral": "reverse spiral",
    "crash stop": "crash stop",
    "williamson": "williamson 35",
}
