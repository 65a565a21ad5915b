"""Audit of the motion of a steady run, and of the angles that stay constant in every run."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..core.findings import Finding
from ..core.ship import Ship
from .audit_factors import compare_angle, compare_sign, compare_size, compare_speed, explain_length, is_opposite
from .audit_rules import finding
from .run_types import Run

_AT_SPEED = 0.95


def rows_at_speed(channels: Mapping[str, np.ndarray], count: int) -> slice:
    """Samples at which the carriage runs at speed; all samples when no channel tells.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
    count : int
        Number of samples n.
    """
    name = next((name for name in ("speed", "u") if name in channels), None)
    if name is None:
        return slice(0, count)
    step = max(1, count // 512)
    size = np.abs(channels[name][::step])
    fast = np.flatnonzero(size > _AT_SPEED * size.max())
    if fast.size < 0.1 * size.size:
        return slice(0, count)
    return slice(int(fast[0]) * step, min(int(fast[-1]) * step + 1, count))


def audit_steady_motion(
    channels: Mapping[str, np.ndarray], time: np.ndarray, rows: slice, run: Run, ship: Ship, reference: float
) -> list[Finding]:
    """Findings about the motion of a steady run, from means over 30-95 % of its time at speed.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
        In SI, home axes, without missing values.
    time : ndarray, shape (n,)
        In s.
    rows : slice
        Samples at speed.
    run : Run
    ship : Ship
    reference : float
        Point that follows the prescribed path, m forward of midship.
    """
    length = rows.stop - rows.start
    first, last = rows.start + int(0.30 * length), rows.start + int(0.95 * length)
    sample = slice(first, last, max(1, length // 256))
    count = len(range(*sample.indices(rows.stop)))
    wanted = ("speed", "u", "v", "r", "psi", "drift_angle")
    mean = {name: float(np.add.reduce(channels[name][sample])) / count for name in wanted if name in channels}
    surge = run.speed * math.cos(run.drift_angle)
    sway = -run.speed * math.sin(run.drift_angle)
    found: list[Finding] = []
    explained = False
    if "u" in mean and "v" in mean:
        found = _exchanged(mean["u"], mean["v"], surge, sway, run)
        if not found:
            found = _tank_velocities(mean["u"], mean["v"], surge, sway, run, reference)
        explained = bool(found)
    if "v" in mean and not explained and abs(sway) > 0.01 * run.speed:
        found += compare_sign("v", mean["v"], sway, "m/s", run)
    if "speed" in mean:
        found += compare_speed("speed", mean["speed"], run.speed, ship)
    if "u" in mean and not explained and abs(surge) > 0.1 * run.speed:
        found += compare_speed("u", mean["u"], surge, ship)
    if "x" in channels and not run.yaw_rate:
        found += _advance(channels["x"], time, first, last, run, ship)
    for name in ("psi", "drift_angle"):
        if name in mean and not run.yaw_rate and abs(run.drift_angle) > math.radians(0.5):
            found += compare_angle(name, mean[name], run.drift_angle, "drift-sign")
    if "r" in mean and run.yaw_rate:
        found += _yaw_rate(mean["r"], run)
    return found


def _exchanged(u: float, v: float, surge: float, sway: float, run: Run) -> list[Finding]:
    tolerance = 0.1 * run.speed
    if abs(u - sway) > tolerance or abs(v - surge) > tolerance or abs(surge - sway) < 4 * tolerance:
        return []
    text = f"u is {u:.4g} and v is {v:.4g} m/s, {surge:.4g} and {sway:.4g} m/s are expected"
    return [finding("swapped-channels", text, place="channels u, v")]


def _tank_velocities(u: float, v: float, surge: float, sway: float, run: Run, reference: float) -> list[Finding]:
    apart = math.hypot(surge - run.speed, sway)
    off_tank = math.hypot(u - run.speed, v)
    # v may be that of midship or of the point on the path
    off_ship = min(math.hypot(u - surge, v - sway + x * run.yaw_rate) for x in (0.0, reference))
    if apart <= 0.02 * run.speed or off_tank >= 0.35 * apart or off_ship <= 0.65 * apart:
        return []
    text = (
        f"u = {u:.4g} and v = {v:.4g} m/s are velocities along and across the tank; {surge:.4g} and {sway:.4g} "
        "m/s are expected along and across the ship"
    )
    return [finding("earth-fixed-velocities", text, place="channels u, v")]


def _advance(x: np.ndarray, time: np.ndarray, first: int, last: int, run: Run, ship: Ship) -> list[Finding]:
    """Speed from the position along the tank; a frame that moves with the ship shows none."""
    duration = float(time[last - 1] - time[first])
    speed = float(x[last - 1] - x[first]) / duration if duration > 0 else 0.0
    ratio = speed / run.speed
    if ratio < 5e-4 or (ratio < 0.05 and not explain_length(ratio)):
        return []
    if why := explain_length(ratio):
        text = f"x advances by {speed:.4g} m/s at a speed of {run.speed:.4g} m/s: {ratio:.4g} times as much; {why}"
        return [finding("length-in-millimetres", text, place="channel x")]
    return compare_speed("x advances, its rate", speed, run.speed, ship)


def _yaw_rate(rate: float, run: Run) -> list[Finding]:
    if is_opposite(rate, run.yaw_rate):
        return compare_sign("r", rate, run.yaw_rate, "rad/s", run)
    return compare_size("r", rate / run.yaw_rate, f"a mean of {rate:.4g} rad/s", f"{run.yaw_rate:.4g} rad/s")


def audit_constant_angles(channels: Mapping[str, np.ndarray], rows: slice, run: Run) -> list[Finding]:
    """Findings about rudder and heel angle, which stay constant in a captive run."""
    step = max(1, (rows.stop - rows.start) // 64)
    found = []
    for name, expected, rule in (
        ("rudder_angle", run.rudder_angle, "rudder-sign"),
        ("phi", run.heel, "drift-sign"),
    ):
        if name in channels and abs(expected) > math.radians(0.5):
            mean = float(channels[name][rows.start : rows.stop : step].mean())
            found += compare_angle(name, mean, expected, rule)
    return found
