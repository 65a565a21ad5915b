"""What is checked in a decay record before anything is fitted, and how its time is mended."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding, Severity
from ..core.ship import Ship
from ..core.variables import GRAVITY
from ..identify.low_pass import is_uniform
from .dominant_frequency import dominant_frequency

FEWEST_SAMPLES = 20
# A step longer than this many median steps is a gap.
GAP_STEPS = 5.0
# A ship that is let go from more than 60 degrees is a record in degrees.
LARGEST_ANGLE = math.radians(60.0)
# A decay that never exceeds this declared angle in degrees is a record in radians.
SMALLEST_DEGREES = 0.6
# Ratio of the measured to the expected roll period that model or full scale, or a wrong unit of time, explains.
PERIOD_RATIO = 1.8


def audit_decay(
    time: np.ndarray, value: np.ndarray, *, motion: str, unit: str, ship: Ship | None = None, file: str = ""
) -> list[Finding]:
    """Findings about a decay record.

    Parameters
    ----------
    time, value : ndarray, shape (n,)
        Time in s; coordinate in rad or m, converted from `unit`.
    motion : {"roll", "pitch", "heave"}
    unit : str
        As declared.
    ship : Ship, optional
        At the scale of the record; its GM and roll gyradius give the expected period.
    file : str

    Returns
    -------
    list of Finding
        Rules ``too-short``, ``not-finite``, ``time-not-rising``, ``gap``, ``constant``, ``angle-in-degrees``,
        ``angle-in-radians``, ``uneven-sampling``, ``period-against-ship``.
    """
    found: list[Finding] = []

    def say(rule: str, severity: Severity, message: str, cure: str = "", place: str = "") -> None:
        found.append(Finding(rule, severity, message, file, place, cure))

    if time.size < FEWEST_SAMPLES:
        say("too-short", "error", f"a record of {time.size} sample(s) holds no decay", "give the whole record")
        return found
    bad = np.flatnonzero(~(np.isfinite(time) & np.isfinite(value)))
    if bad.size:
        say(
            "not-finite",
            "error",
            f"{bad.size} sample(s) hold no number, the first at sample {bad[0] + 1}",
            "cut them off, or fill them before",
            f"sample {bad[0] + 1}",
        )
        return found
    steps = np.diff(time)
    back = np.flatnonzero(steps <= 0.0)
    if back.size:
        say(
            "time-not-rising",
            "error",
            f"time does not rise at {back.size} sample(s), the first at t = {time[back[0] + 1]:.6g} s",
            "sort and remove doubles; check the time column",
            f"sample {back[0] + 2}",
        )
        return found
    middle = float(np.median(steps))
    wide = np.flatnonzero(steps > GAP_STEPS * middle)
    if wide.size:
        say(
            "gap",
            "error",
            f"{wide.size} gap(s), the first of {steps[wide[0]]:.4g} s at t = {time[wide[0]]:.6g} s",
            "use the part before or behind it",
            f"sample {wide[0] + 1}",
        )
    elif not is_uniform(time):
        say(
            "uneven-sampling",
            "warning",
            f"steps run from {steps.min():.4g} to {steps.max():.4g} s: interpolated to {middle:.4g} s",
        )
    spread = float(np.ptp(value))
    if spread <= 1e-12 * max(float(np.abs(value).max()), 1e-300):
        say("constant", "error", f"the {motion} does not move", "check the channel")
        return found
    if motion != "heave":
        _say_unit(say, value, unit)
    if motion == "roll" and ship is not None and not wide.size:
        _say_period(say, time, value, ship)
    return found


def _say_unit(say: Callable[..., None], value: np.ndarray, unit: str) -> None:
    largest = float(np.abs(value - np.median(value)).max())
    if largest > LARGEST_ANGLE:
        say(
            "angle-in-degrees",
            "error",
            f"the largest angle is {math.degrees(largest):.4g} deg when read in {unit}",
            "declare unit = 'deg' if these are degrees: the quadratic damping differs by 57.3",
        )
    elif unit.strip().lower().startswith("deg") and math.degrees(largest) < SMALLEST_DEGREES:
        say(
            "angle-in-radians",
            "error",
            f"the largest angle is {math.degrees(largest):.4g} deg, a usual decay in radians",
            "declare unit = 'rad' if these are radians: the quadratic damping differs by 57.3",
        )


def _say_period(say: Callable[..., None], time: np.ndarray, value: np.ndarray, ship: Ship) -> None:
    if ship.GM is None or not ship.GM > 0.0:
        return
    gyradius = ship.kxx if ship.kxx is not None else 0.35 * ship.B
    # Roll inertia of the water: about a quarter of the ship's own.
    expected = 2.0 * math.pi * gyradius * math.sqrt(1.25) / math.sqrt(GRAVITY * ship.GM)
    uniform = np.linspace(time[0], time[-1], time.size)
    measured = 1.0 / dominant_frequency(uniform, np.interp(uniform, time, value))
    ratio = measured / expected
    if not 1.0 / PERIOD_RATIO < ratio < PERIOD_RATIO:
        say(
            "period-against-ship",
            "warning",
            f"the period is {measured:.4g} s, that of '{ship.name}' at scale {ship.scale:g} about {expected:.4g} s",
            "check the scale of the record, the unit of time, and GM",
        )


def repaired_time(
    time: np.ndarray, series: Mapping[str, np.ndarray]
) -> tuple[np.ndarray, dict[str, np.ndarray], tuple[str, ...]]:
    """Uniform samples of the series, interpolated by cubic splines where the steps differ; and what was done.

    Raises
    ------
    ReadError
        If a series differs in length from the time.
    """
    for name, one in series.items():
        if one.shape != time.shape:
            raise ReadError(f"time and {name} differ in length", cure="give one value for each time")
    if is_uniform(time):
        return time, dict(series), ()
    from scipy.interpolate import CubicSpline

    step = float(np.median(np.diff(time)))
    uniform = time[0] + step * np.arange(int((time[-1] - time[0]) / step) + 1)
    mended = {name: np.asarray(CubicSpline(time, one)(uniform)) for name, one in series.items()}
    return uniform, mended, (f"interpolated to uniform steps of {step:.6g} s",)
