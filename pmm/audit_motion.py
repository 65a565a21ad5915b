"""Audit of an oscillating run against the motion that the test matrix prescribes."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..core.findings import Finding, Severity
from ..core.ship import Ship
from .audit_factors import NEAR, compare_sign, compare_size, compare_speed, explain_angle, explain_length
from .audit_rules import finding
from .expected_harmonics import ExpectedMotion, expected_motion
from .recorded_harmonics import RecordedHarmonics, recorded_harmonics, strongest_line
from .run_types import Run

_PHASE_WARNING, _PHASE_ERROR = 0.05, 0.35
_SLIP = 0.1
"""Phase in rad that a slightly wrong frequency may lose towards the ends of the window."""

_UNITS_OF_FREQUENCY = (
    (2 * math.pi, "the matrix gives Hz as rad/s"),
    (1 / (2 * math.pi), "the matrix gives rad/s as Hz"),
    (1e-3, "time is in milliseconds"),
    (1e3, "time was taken for milliseconds"),
)


def audit_oscillation(
    channels: Mapping[str, np.ndarray], time: np.ndarray, run: Run, ship: Ship, reference: float
) -> list[Finding]:
    """Findings about the motion and the forces of an oscillating run.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
        In SI, home axes, without missing values.
    time : ndarray, shape (n,)
        Not decreasing, in s.
    run : Run
    ship : Ship
    reference : float
        Point that follows the prescribed path, m forward of midship.
    """
    seen = recorded_harmonics(channels, time, run)
    want = expected_motion(run, reference)
    if seen is None:
        return audit_frequency(channels, time, run)
    found = _swapped_forces(seen, run)
    if not found:
        found = _frequency(seen, want, channels, time, run)
        if any(item.severity == "error" for item in found):
            return found
    explained: set[str] = set()
    for check in (_tank_velocities, _signs_of_rates, _length_behind_rates):
        new, about = check(seen, want, run, ship, explained)
        found += new
        explained |= about
    found += _phase(seen, want)
    found += _amplitudes(seen, want, explained)
    for name, expected in (("speed", run.speed), ("u", want.surge)):
        if name in seen and run.speed and name not in explained:
            found += compare_speed(name, seen.mean[name], expected, ship)
    return found


def _swapped_forces(seen: RecordedHarmonics, run: Run) -> list[Finding]:
    """X follows the squares of sway and yaw, so it oscillates twice a cycle; Y once."""
    if run.kind not in ("pure_sway", "pure_yaw", "dry_sway") or "X" not in seen or "Y" not in seen:
        return []
    x, y = abs(seen.first["X"]), abs(seen.first["Y"])
    if x <= 5.0 * y or x <= 2.0 * seen.second("X") or seen.fit_quality("X")[0] < 0.5:
        return []
    text = f"X oscillates at the frequency of the motion ({x:.4g} N) and Y hardly does ({y:.4g} N)"
    return [finding("swapped-channels", text, place="channels X, Y")]


def _frequency(
    seen: RecordedHarmonics,
    want: ExpectedMotion,
    channels: Mapping[str, np.ndarray],
    time: np.ndarray,
    run: Run,
) -> list[Finding]:
    """The channel that tells most about the motion must oscillate at the frequency of the matrix."""
    name = next((name for name in want.telling if name in seen), None)
    if name is None:
        return []
    explained, slip = seen.fit_quality(name)
    if explained > 0.9:
        if abs(slip) * seen.length / 2 <= _SLIP or abs(slip) <= 0.003 * run.frequency:
            return []
        said = f"the test matrix says {run.frequency:.5g} rad/s"
        text = f"{name} oscillates at {run.frequency + slip:.5g} rad/s, {said}"
        severe = abs(slip) > 0.02 * run.frequency
        return [
            finding("frequency-mismatch", text, severity="error" if severe else "warning", place=f"channel {name}")
        ]
    return audit_frequency(channels, time, run)


def audit_frequency(channels: Mapping[str, np.ndarray], time: np.ndarray, run: Run) -> list[Finding]:
    """Finding when the channel that shows the motion best has its strongest line at another frequency.

    It costs a Fourier transform, so it is asked only of records that the frequency of the matrix does not describe.
    """
    name = next((name for name in expected_motion(run).telling if name in channels), None)
    if name is None:
        return []
    values = _without_trend(channels[name], time) if name == "x" else channels[name]
    peak, share = strongest_line(values, time)
    hertz = 1.0 / run.period
    resolution = 1.0 / float(time[-1] - time[0])
    too_few = peak < 2.5 * resolution
    if share < 0.4 or too_few or abs(peak - hertz) <= max(0.2 * resolution, 0.02 * hertz):
        return []
    width = 0.03 + 0.2 * resolution / peak
    hints = [text for ratio, text in _UNITS_OF_FREQUENCY if abs(peak / hertz / ratio - 1.0) < width]
    text = (
        f"{name} oscillates at about {2 * math.pi * peak:.4g} rad/s ({peak:.4g} Hz), the test matrix says "
        f"{run.frequency:.4g} rad/s ({hertz:.4g} Hz)"
    )
    return [finding("frequency-mismatch", "; ".join([text, *hints[:1]]), place=f"channel {name}")]


def _tank_velocities(
    seen: RecordedHarmonics, want: ExpectedMotion, run: Run, ship: Ship, explained: set[str]
) -> tuple[list[Finding], set[str]]:
    """Velocities along and across the tank in place of those of the ship."""
    if "v" not in seen:
        return [], set()
    mean, amplitude = seen.mean["v"], abs(seen.first["v"])
    across = abs(want.first["y"]) * run.frequency
    # v may be that of midship or of the point on the path
    ship_fixed = [abs(want.sway_at(0.0)), abs(want.sway_at(want.reference))]
    apart = min(math.hypot(want.sway, across - one) for one in ship_fixed)
    off_tank = math.hypot(mean, amplitude - across)
    off_ship = min(math.hypot(mean - want.sway, amplitude - one) for one in ship_fixed)
    if apart <= 0.02 * run.speed or off_tank >= 0.35 * apart or off_ship <= 0.65 * apart:
        return [], set()
    text = (
        f"v oscillates by {amplitude:.4g} m/s about {mean:.4g} m/s like the velocity across the tank; "
        f"{ship_fixed[0]:.4g} m/s about {want.sway:.4g} m/s is expected across the ship"
    )
    return [finding("earth-fixed-velocities", text, place="channels u, v")], {"u", "v", "udot", "vdot"}


def _signs_of_rates(
    seen: RecordedHarmonics, want: ExpectedMotion, run: Run, ship: Ship, explained: set[str]
) -> tuple[list[Finding], set[str]]:
    """A rate that is minus the derivative of its own position has the wrong sign, whatever the phase is."""
    found: list[Finding] = []
    pairs = [("r", "psi")]
    if run.kind in ("pure_sway", "dry_sway"):
        pairs.append(("v", "y"))
    for rate, position in pairs:
        if rate not in seen or position not in seen or rate in explained or not want.moves(rate):
            continue
        derivative = 1j * run.frequency * seen.first[position]
        if derivative and (seen.first[rate] / derivative).real < -0.5 * abs(seen.first[rate] / derivative):
            text = f"{rate} is opposite to the rate of change of {position}: one of them has the wrong sign"
            found.append(finding("drift-sign", text, place=f"channels {rate}, {position}"))
    if "v" in seen and "v" not in explained and abs(want.sway) > 0.02 * run.speed:
        found += compare_sign("v", seen.mean["v"], want.sway, "m/s", run)
    return found, set()


def _length_behind_rates(
    seen: RecordedHarmonics, want: ExpectedMotion, run: Run, ship: Ship, explained: set[str]
) -> tuple[list[Finding], set[str]]:
    """Acceleration over velocity must be the frequency: rdot'/r' = omega L/U when both were made with one L."""
    for rate, acceleration, explain in (("r", "rdot", explain_angle), ("v", "vdot", explain_length)):
        if rate not in seen or acceleration not in seen or rate in explained or not want.moves(rate):
            continue
        size = abs(seen.first[rate]) / abs(want.first[rate])
        if size < 0.01 or not seen.first[acceleration]:
            continue
        ratio = abs(seen.first[acceleration]) / abs(seen.first[rate]) / run.frequency
        if abs(math.log(ratio)) <= NEAR or explain(ratio) or explain(size) or explain(size * ratio):
            continue
        text = (
            f"{acceleration} over {rate} is {ratio:.4g} times the frequency of the motion: non-dimensional rates were "
            f"made with L = {ship.L * ratio:.4g} m if they were converted with L = {ship.L:.4g} m"
        )
        return [finding("wrong-length", text, place=f"channels {rate}, {acceleration}")], {rate, acceleration}
    return [], set()


def _phase(seen: RecordedHarmonics, want: ExpectedMotion) -> list[Finding]:
    name = next((name for name in ("y", "psi", "v", "r", "x", "u") if name in seen and want.moves(name)), None)
    if name is None or abs(seen.first[name]) < 1e-3 * abs(want.first[name]):
        return []
    ratio = seen.first[name] / want.first[name]
    ahead = math.atan2(ratio.imag, ratio.real)
    if abs(ahead) <= _PHASE_WARNING:
        return []
    text = (
        f"{name} is {math.degrees(abs(ahead)):.3g} deg {'ahead of' if ahead > 0 else 'behind'} the motion of the "
        "test matrix, which starts at time 0"
    )
    severity: Severity = "error" if abs(ahead) > _PHASE_ERROR else "warning"
    return [finding("phase-mismatch", text, severity=severity, place=f"channel {name}")]


def _amplitudes(seen: RecordedHarmonics, want: ExpectedMotion, explained: set[str]) -> list[Finding]:
    found = []
    for name, first in want.first.items():
        if name not in seen or name in explained or not want.moves(name):
            continue
        measured, expected = abs(seen.first[name]), abs(first)
        if not measured:
            continue  # a dead channel has a finding of its own
        if name in ("v", "vdot"):
            # v may be that of midship or of the point on the path
            there = expected * abs(want.sway_at(want.reference)) / abs(want.first["v"])
            expected = min(expected, there, key=lambda one: abs(measured - one))
        if expected <= want.smallest[name]:
            continue
        found += compare_size(name, measured / expected, f"an amplitude of {measured:.4g}", f"{expected:.4g}")
    return found


def _without_trend(values: np.ndarray, time: np.ndarray) -> np.ndarray:
    since = time - time.mean()
    return values - since * float(since @ values) / float(since @ since)
