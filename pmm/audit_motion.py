"""Audit of the recorded motion against the motion that the test matrix prescribes."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..core.findings import Finding
from ..core.ship import Ship
from .audit_factors import DEGREES, explain_angle, explain_length, explain_speed, percent
from .audit_rules import finding
from .expected_harmonics import ExpectedMotion, expected_motion
from .recorded_harmonics import RecordedHarmonics, recorded_harmonics
from .run_types import Run

_NEAR = 0.05
_FAR = 0.30
_PHASE_WARNING, _PHASE_ERROR = 0.05, 0.35
_LENGTHS = ("x", "y", "v", "vdot")
_ANGLES = ("psi", "r", "rdot")


def audit_oscillation(
    channels: Mapping[str, np.ndarray], time: np.ndarray, run: Run, ship: Ship, reference: float
) -> list[Finding]:
    """Findings about the motion and the forces of an oscillating run.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
        In SI, home axes.
    time : ndarray, shape (n,)
        Increasing, in s.
    run : Run
    ship : Ship
    reference : float
        Point that follows the prescribed path, m forward of midship.
    """
    seen = recorded_harmonics(channels, time, run)
    if seen is None:
        return []
    want = expected_motion(run, reference)
    swapped = _swapped_forces(seen, run)
    wrong_frequency = [] if swapped else _frequency(seen, want, channels, time, run)
    found = swapped + wrong_frequency
    if any(item.severity == "error" for item in wrong_frequency):
        return found
    velocities, explained = _velocities(seen, want, run, reference)
    found += velocities
    lengths, known = _length_behind_rates(seen, want, run, ship, explained)
    found += lengths
    explained |= known
    found += _phase(seen, want)
    found += _amplitudes(seen, want, explained)
    if "u" not in explained:
        found += _mean_speed(seen, run, want, ship)
    return found


def _swapped_forces(seen: RecordedHarmonics, run: Run) -> list[Finding]:
    """X follows the square of sway and yaw, so it oscillates twice a cycle; Y once."""
    if run.kind not in ("pure_sway", "pure_yaw", "dry_sway") or "X" not in seen or "Y" not in seen:
        return []
    once_x, once_y = abs(seen.first["X"]), abs(seen.first["Y"])
    if once_x <= 5.0 * once_y or once_x <= 2.0 * abs(seen.second["X"]):
        return []
    return [
        finding(
            "swapped-channels",
            f"X oscillates at the frequency of the motion ({once_x:.4g} N) and Y hardly does ({once_y:.4g} N): X and "
            "Y are exchanged",
            place="channels X, Y",
        )
    ]


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
    hertz = run.frequency / (2 * math.pi)
    if seen.explained(name) > 0.9:
        slip = seen.frequency_error(name)
        if abs(slip) * seen.length / 2 <= 0.1 or abs(slip) <= 0.003 * run.frequency:
            return []
        found = run.frequency + slip
        severe = abs(slip) > 0.02 * run.frequency
        return [
            finding(
                "frequency-mismatch",
                f"{name} oscillates at {found:.5g} rad/s, the test matrix says {run.frequency:.5g} rad/s",
                severity="error" if severe else "warning",
                place=f"channel {name}",
            )
        ]
    peak, share = seen.strongest_line(channels[name], time)
    resolution = 1.0 / float(time[-1] - time[0])
    if share < 0.4 or abs(peak - hertz) <= max(0.75 * resolution, 0.03 * hertz):
        return []
    hint = ""
    for ratio, text in (
        (2 * math.pi, "; the matrix gives Hz as rad/s"),
        (1 / (2 * math.pi), "; the matrix gives rad/s as Hz"),
        (1e-3, "; time is in ms"),
        (1e3, "; time is in ms and was divided twice"),
    ):
        if abs(peak / hertz / ratio - 1.0) < 0.06 + resolution / peak:
            hint = text
    return [
        finding(
            "frequency-mismatch",
            f"{name} oscillates at about {2 * math.pi * peak:.4g} rad/s ({peak:.4g} Hz), the test matrix says "
            f"{run.frequency:.4g} rad/s ({hertz:.4g} Hz){hint}",
            place=f"channel {name}",
        )
    ]


def _velocities(
    seen: RecordedHarmonics, want: ExpectedMotion, run: Run, reference: float
) -> tuple[list[Finding], set[str]]:
    """Velocities of the ship against those of the carriage, and their sign against the positions."""
    found: list[Finding] = []
    explained: set[str] = set()
    if "v" in seen:
        measured = np.array([seen.mean["v"], abs(seen.first["v"])])
        tank = np.array([0.0, abs(want.first["y"]) * run.frequency])
        points = [want.velocity_at(0.0), want.velocity_at(reference)]
        ship_fixed = [np.array([mean, abs(first)]) for mean, first in points]
        apart = min(float(np.hypot(*(tank - one))) for one in ship_fixed)
        off_tank = float(np.hypot(*(measured - tank)))
        off_ship = min(float(np.hypot(*(measured - one))) for one in ship_fixed)
        if apart > 0.02 * run.speed and off_tank < 0.35 * apart and off_ship > 0.65 * apart:
            found.append(
                finding(
                    "earth-fixed-velocities",
                    f"v oscillates by {measured[1]:.4g} m/s about {measured[0]:.4g} m/s like the velocity across the "
                    f"tank; across the ship {ship_fixed[0][1]:.4g} about {ship_fixed[0][0]:.4g} m/s are expected",
                    place="channels u, v",
                )
            )
            explained |= {"u", "v"}
    # A rate that is the negative derivative of its own position has the wrong sign, whatever the phase is.
    pairs = [("r", "psi")] + ([("v", "y")] if not run.yaw_amplitude and run.kind.endswith("sway") else [])
    for rate, position in pairs:
        if rate not in seen or position not in seen or rate in explained or not want.moves(rate):
            continue
        derivative = 1j * run.frequency * seen.first[position]
        turned = seen.first[rate] / derivative if derivative else 0.0
        if np.real(turned) < -0.5 * abs(turned):
            found.append(
                finding(
                    "drift-sign",
                    f"{rate} is opposite to the rate of change of {position}: one of them has the wrong sign",
                    place=f"channels {rate}, {position}",
                )
            )
    mean = want.velocity_at(0.0)[0]
    if "v" in seen and "v" not in explained and abs(mean) > 0.02 * run.speed:
        found += opposite("v", seen.mean["v"], mean, "m/s", run)
    return found, explained


def opposite(name: str, measured: float, expected: float, unit: str, run: Run) -> list[Finding]:
    """Finding when a level is the negative of what it should be."""
    if abs(measured + expected) >= 0.25 * abs(expected):
        return []
    return [
        finding(
            "drift-sign",
            f"{name} is {measured:.4g} {unit}, {expected:.4g} {unit} is expected at a drift angle of "
            f"{math.degrees(run.drift_angle):.4g} deg",
            place=f"channel {name}",
        )
    ]


def _length_behind_rates(
    seen: RecordedHarmonics, want: ExpectedMotion, run: Run, ship: Ship, explained: set[str]
) -> tuple[list[Finding], set[str]]:
    """Acceleration over velocity must be the frequency: rdot'/r' = omega L/U when both were made with one L."""
    for rate, acceleration in (("r", "rdot"), ("v", "vdot")):
        if rate not in seen or acceleration not in seen or not want.moves(rate) or rate in explained:
            continue
        if abs(seen.first[rate]) < 0.1 * abs(want.first[rate]):
            continue
        ratio = abs(seen.first[acceleration]) / abs(seen.first[rate]) / run.frequency
        if abs(math.log(max(ratio, 1e-12))) <= _NEAR:
            continue
        explain = explain_angle if rate == "r" else explain_length
        if explain(ratio) or explain(abs(seen.first[rate]) / abs(want.first[rate])):
            continue
        return [
            finding(
                "wrong-length",
                f"{acceleration} over {rate} is {ratio:.4g} times the frequency: non-dimensional rates were "
                f"converted with a length that is {percent(1 / ratio)} of the one behind them "
                f"(here L = {ship.L:.5g} m, then {ship.L * ratio:.5g} m)",
                place=f"channels {rate}, {acceleration}",
            )
        ], {rate, acceleration}
    return [], set()


def _phase(seen: RecordedHarmonics, want: ExpectedMotion) -> list[Finding]:
    name = next((name for name in ("y", "psi", "v", "r", "u") if name in seen and want.moves(name)), None)
    if name is None or abs(seen.first[name]) < 1e-3 * abs(want.first[name]):
        return []
    ahead = float(np.angle(seen.first[name] / want.first[name]))
    if abs(ahead) <= _PHASE_WARNING:
        return []
    return [
        finding(
            "phase-mismatch",
            f"{name} is {math.degrees(abs(ahead)):.3g} deg {'ahead of' if ahead > 0 else 'behind'} the motion of the "
            "test matrix, whose phase counts from time 0",
            severity="error" if abs(ahead) > _PHASE_ERROR else "warning",
            place=f"channel {name}",
        )
    ]


def _amplitudes(seen: RecordedHarmonics, want: ExpectedMotion, explained: set[str]) -> list[Finding]:
    found = []
    for name in ("x", "y", "psi", "u", "v", "r", "udot", "vdot", "rdot"):
        if name not in seen or name in explained or not want.moves(name):
            continue
        measured, expected = abs(seen.first[name]), abs(want.first[name])
        if not measured:
            continue  # a dead channel has a finding of its own
        found += compare_size(name, measured / expected, f"amplitude {measured:.4g}", f"{expected:.4g}")
    return found


def compare_size(name: str, ratio: float, measured: str, expected: str) -> list[Finding]:
    """Finding for a motion that is `ratio` times what the matrix says."""
    if abs(ratio - 1.0) <= _NEAR:
        return []
    text = f"{name} has {measured} where the test matrix gives {expected}: {ratio:.4g} times as much"
    if name in _ANGLES and (why := explain_angle(ratio)):
        return [finding("angle-in-degrees", f"{text}; {why}", place=f"channel {name}")]
    if name in _LENGTHS and (why := explain_length(ratio)):
        return [finding("length-in-millimetres", f"{text}; {why}", place=f"channel {name}")]
    severity = "error" if abs(ratio - 1.0) > _FAR else "warning"
    return [finding("amplitude-mismatch", text, severity=severity, place=f"channel {name}")]


def _mean_speed(seen: RecordedHarmonics, run: Run, want: ExpectedMotion, ship: Ship) -> list[Finding]:
    found = []
    for name, expected in (("speed", run.speed), ("u", want.surge)):
        if name in seen and run.speed:
            found += compare_speed(name, seen.mean[name], expected, ship)
    return found


def compare_speed(name: str, measured: float, expected: float, ship: Ship) -> list[Finding]:
    """Finding for a speed that is not the prescribed one, with the likely reason."""
    ratio = measured / expected
    if abs(ratio - 1.0) <= 0.03:
        return []
    why = explain_speed(ratio, ship.scale)
    severity = "error" if why or abs(ratio - 1.0) > 0.2 else "warning"
    return [
        finding(
            "speed-mismatch",
            f"{name} is {measured:.4g} m/s, {expected:.4g} m/s is expected: {ratio:.4g} times as much"
            + (f"; {why}" if why else ""),
            severity=severity,
            place=f"channel {name}",
        )
    ]


def audit_steady_motion(
    channels: Mapping[str, np.ndarray], rows: slice, run: Run, ship: Ship, reference: float
) -> list[Finding]:
    """Findings about the motion of a steady run, from the means over `rows`."""
    step = max(1, (rows.stop - rows.start) // 256)
    sample = slice(rows.start, rows.stop, step)
    wanted = ("speed", "u", "v", "r", "psi", "drift_angle")
    mean = {name: float(channels[name][sample].mean()) for name in wanted if name in channels}
    surge = run.speed * math.cos(run.drift_angle)
    sway = -run.speed * math.sin(run.drift_angle)
    # v may be that of midship or of the point on the prescribed path
    sways = (sway, sway - reference * run.yaw_rate)
    found: list[Finding] = []
    explained: set[str] = set()
    if "u" in mean and "v" in mean:
        found, explained = _steady_velocities(mean["u"], mean["v"], surge, sways, run)
    elif "v" in mean and abs(sway) > 0.01 * run.speed:
        found = opposite("v", mean["v"], sway, "m/s", run)
    if "speed" in mean:
        found += compare_speed("speed", mean["speed"], run.speed, ship)
    if "u" in mean and "u" not in explained:
        found += compare_speed("u", mean["u"], surge, ship)
    for name in ("psi", "drift_angle"):
        if name in mean and not run.yaw_rate and abs(run.drift_angle) > math.radians(0.5):
            found += compare_angle(name, mean[name], run.drift_angle, "drift-sign")
    if "r" in mean and run.yaw_rate:
        if opposed := mean["r"] * run.yaw_rate < 0 and abs(mean["r"] / run.yaw_rate + 1.0) < 0.25:
            found += [
                finding(
                    "drift-sign",
                    f"r is {mean['r']:.4g} rad/s, {run.yaw_rate:.4g} rad/s is expected",
                    place="channel r",
                )
            ]
        if not opposed:
            found += compare_size(
                "r", mean["r"] / run.yaw_rate, f"mean {mean['r']:.4g} rad/s", f"{run.yaw_rate:.4g} rad/s"
            )
    return found


def _steady_velocities(
    u: float, v: float, surge: float, sways: tuple[float, float], run: Run
) -> tuple[list[Finding], set[str]]:
    speed = run.speed
    apart = math.hypot(surge - speed, sways[0])
    if abs(u - sways[0]) < 0.1 * speed and abs(v - surge) < 0.1 * speed and apart < 0.6 * speed:
        text = f"u is {u:.4g} and v is {v:.4g} m/s, {surge:.4g} and {sways[0]:.4g} m/s are expected"
        return [finding("swapped-channels", text, place="channels u, v")], {"u", "v"}
    off_ship = min(math.hypot(u - surge, v - sway) for sway in sways)
    off_tank = math.hypot(u - speed, v)
    if apart > 0.02 * speed and off_tank < 0.35 * apart and off_ship > 0.65 * apart:
        text = (
            f"u = {u:.4g} and v = {v:.4g} m/s are velocities along and across the tank; {surge:.4g} and "
            f"{sways[0]:.4g} m/s are expected along and across the ship"
        )
        return [finding("earth-fixed-velocities", text, place="channels u, v")], {"u", "v"}
    if abs(sways[0]) > 0.01 * speed:
        return opposite("v", v, sways[0], "m/s", run), set()
    return [], set()


def audit_rudder(channels: Mapping[str, np.ndarray], rows: slice, run: Run) -> list[Finding]:
    """Findings about the rudder and heel angle, which stay constant in every captive run."""
    step = max(1, (rows.stop - rows.start) // 64)
    found = []
    for name, expected, rule in (("rudder_angle", run.rudder_angle, "rudder-sign"), ("phi", run.heel, "")):
        if name in channels and abs(expected) > math.radians(0.5):
            mean = float(channels[name][rows.start : rows.stop : step].mean())
            found += compare_angle(name, mean, expected, rule)
    return found


def compare_angle(name: str, measured: float, expected: float, sign_rule: str) -> list[Finding]:
    """Finding for a constant angle that is in degrees or has the wrong sign."""
    ratio = measured / expected
    text = f"{name} is {measured:.4g} rad ({math.degrees(measured):.4g} deg), {expected:.4g} rad is expected"
    if why := explain_angle(abs(ratio)):
        return [finding("angle-in-degrees", f"{text}; {why}", place=f"channel {name}")]
    if sign_rule and abs(ratio + 1.0) < 0.25:
        return [finding(sign_rule, text, place=f"channel {name}")]
    return []


__all__ = ["DEGREES", "audit_oscillation", "audit_rudder", "audit_steady_motion"]
