"""Manoeuvrability criteria of IMO resolution MSC.137(76): limits, margins and verdicts, for one ship or many draws."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import TowtankError
from ..core.ship import Ship
from .events import FloatArray
from .manoeuvre_names import read_manoeuvre_name

if TYPE_CHECKING:
    import pandas as pd

APPLIES_FROM = 100.0
"""Length in m from which the standards apply (and to chemical tankers and gas carriers of any length)."""

DEEP_WATER = 4.0
"""Depth over draught above which water counts as deep and unrestricted."""


@dataclass(frozen=True)
class Criterion:
    """One criterion.

    Attributes
    ----------
    name, clause : str
        What it is called, and where MSC.137(76) has it.
    kind : str
        Manoeuvre: a kind of :mod:`~towtank.simulate.manoeuvre_names`.
    rudder, heading : float or None
        Rudder angle in degrees (None: the largest that was sailed, of at most 35 or the maximum), switching heading.
    index, unit : str
        What is judged.
    limit : callable
        Largest value allowed, from L/V in s at full scale.
    """

    name: str
    clause: str
    kind: str
    rudder: float | None
    heading: float | None
    index: str
    unit: str
    limit: Callable[[float], float]


def first_overshoot_limit(ratio: float) -> float:
    """Limit of the first overshoot of the 10/10 zig-zag in degrees, from L/V in s: 10 below 10 s, 20 from 30 s."""
    return min(max(5.0 + 0.5 * ratio, 10.0), 20.0)


def second_overshoot_limit(ratio: float) -> float:
    """Limit of the second overshoot of the 10/10 zig-zag in degrees, from L/V in s: 25 below 10 s, 40 from 30 s."""
    return min(max(17.5 + 0.75 * ratio, 25.0), 40.0)


CRITERIA = (
    Criterion("turning: advance", "5.3.1", "turning", None, None, "advance", "L", lambda _: 4.5),
    Criterion(
        "turning: tactical diameter", "5.3.1", "turning", None, None, "tactical diameter", "L", lambda _: 5.0
    ),
    Criterion(
        "initial turning", "5.3.2", "initial turning", 10.0, None, "initial turning track", "L", lambda _: 2.5
    ),
    Criterion(
        "10/10 zig-zag: first overshoot",
        "5.3.3.1",
        "zigzag",
        10.0,
        10.0,
        "overshoot 1",
        "deg",
        first_overshoot_limit,
    ),
    Criterion(
        "10/10 zig-zag: second overshoot",
        "5.3.3.2",
        "zigzag",
        10.0,
        10.0,
        "overshoot 2",
        "deg",
        second_overshoot_limit,
    ),
    Criterion(
        "20/20 zig-zag: first overshoot", "5.3.3.3", "zigzag", 20.0, 20.0, "overshoot 1", "deg", lambda _: 25.0
    ),
    Criterion("stopping: track reach", "5.3.4", "crash stop", None, None, "track reach", "L", lambda _: 15.0),
)
"""All criteria of section 5.3."""


def length_over_speed(ship: Ship, speed: float) -> float:
    """L/V in s at full scale; the speed is that at the scale of `ship` (Froude similarity).

    Raises
    ------
    TowtankError
        For a speed that is not positive.
    """
    if not speed > 0.0:
        raise TowtankError(f"the test speed {speed} m/s is not positive", cure="give the approach speed in m/s")
    return ship.L / speed * math.sqrt(ship.scale)


def judged(criterion: Criterion, manoeuvre: str) -> bool:
    """Whether a manoeuvre is that of a criterion; a turning circle counts with 30 degrees of rudder or more."""
    named = read_manoeuvre_name(manoeuvre)
    if named.kind != criterion.kind:
        return False
    if criterion.kind == "turning":
        return named.rudder is None or abs(named.rudder) >= 30.0
    if criterion.rudder is not None and (named.rudder is None or abs(named.rudder) != criterion.rudder):
        return False
    return criterion.heading is None or named.heading == criterion.heading


def margins(
    results: Mapping[str, Mapping[str, ArrayLike]], ship: Ship, speed: float
) -> dict[str, tuple[Criterion, FloatArray]]:
    """Value of each criterion that was tested, the worst of the sides, for many draws.

    Parameters
    ----------
    results : mapping of str to mapping
        Manoeuvre -> index -> values of shape (draws,), as `event_indices` gives them. Of a turn to port and one to
        starboard the worse counts, draw by draw.
    ship : Ship
    speed : float
        Test speed in m/s at the scale of `ship`: at least 90 per cent of that at 85 per cent of the engine power.

    Returns
    -------
    dict
        Name of the criterion -> the criterion and the values, shape (draws,); NaN where the manoeuvre did not get
        that far.
    """
    length_over_speed(ship, speed)
    found: dict[str, tuple[Criterion, FloatArray]] = {}
    for criterion in CRITERIA:
        sides = [
            np.atleast_1d(np.asarray(values[criterion.index], dtype=float))
            for manoeuvre, values in results.items()
            if criterion.index in values and judged(criterion, manoeuvre)
        ]
        if sides:
            # NaN stays: a side that did not get that far is not passed by the other.
            found[criterion.name] = (criterion, np.maximum.reduce(sides))
    return found


def pass_probability(results: Mapping[str, Mapping[str, ArrayLike]], ship: Ship, speed: float) -> dict[str, float]:
    """Share of the draws that pass each criterion that was tested; a draw without a value does not pass."""
    ratio = length_over_speed(ship, speed)
    with np.errstate(invalid="ignore"):
        return {
            name: float(np.mean(values <= criterion.limit(ratio)))
            for name, (criterion, values) in margins(results, ship, speed).items()
        }


def imo_criteria(results: Mapping[str, Mapping[str, ArrayLike]], ship: Ship, speed: float) -> pd.DataFrame:
    """Verdicts of IMO resolution MSC.137(76), one row a criterion.

    Parameters
    ----------
    results : mapping of str to mapping
        Manoeuvre -> index -> value, of one run each.
    ship : Ship
    speed : float
        Test speed in m/s at the scale of `ship`.

    Returns
    -------
    DataFrame
        Columns criterion, clause, value, limit, unit, margin (limit less value), margin_pct (of the limit), verdict
        (``pass``, ``fail``, ``not tested``, ``not reached``: the manoeuvre ended before). ``attrs["notes"]`` says what
        the standards ask for and this test was not.
    """
    import pandas as pd

    ratio = length_over_speed(ship, speed)
    tested = margins(results, ship, speed)
    rows = []
    for criterion in CRITERIA:
        limit = criterion.limit(ratio)
        value, verdict = math.nan, "not tested"
        if criterion.name in tested:
            values = tested[criterion.name][1]
            if len(values) != 1:
                raise TowtankError(
                    f"'{criterion.name}' has {len(values)} values; verdicts are of one run",
                    cure="use pass_probability for many draws",
                )
            value = float(values[0])
            verdict = "not reached" if math.isnan(value) else "pass" if value <= limit else "fail"
        margin = limit - value
        rows.append(
            (
                criterion.name,
                criterion.clause,
                value,
                limit,
                criterion.unit,
                margin,
                100.0 * margin / limit,
                verdict,
            )
        )
    names = ["criterion", "clause", "value", "limit", "unit", "margin", "margin_pct", "verdict"]
    table = pd.DataFrame(rows, columns=names)
    table.attrs["notes"] = applicability_notes(ship, ratio)
    return table


def applicability_notes(ship: Ship, ratio: float) -> list[str]:
    """What the standards presuppose and this ship or test does not meet, a sentence each."""
    notes = [f"limits of the 10/10 zig-zag for L/V = {ratio:.1f} s at full scale"]
    length = ship.L * ship.scale
    if length < APPLIES_FROM:
        notes.append(f"the standards apply to ships of 100 m and more; this one has {length:.1f} m")
    if ship.depth_ratio < DEEP_WATER:
        notes.append(f"the standards are for deep water; here h/T = {ship.depth_ratio:.2f}")
    if ship.scale != 1.0:
        notes.append(f"model scale 1:{ship.scale:g}; overshoots of models are not free of scale effects")
    return notes
