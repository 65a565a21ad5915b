"""Linear derivatives straight from run summaries, without a fit: what the audit of a campaign judges."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.ship import Ship
from .run_types import Run

_LARGEST_DRIFT = math.radians(12.5)
_SMALLEST_DRIFT = math.radians(1.0)
_CORRELATED = 0.7


@dataclass(frozen=True)
class RunSummary:
    """What the audit of a campaign needs to know of a reduced run, in home axes about midship.

    Attributes
    ----------
    run : Run
    mean_force : mapping of str to float
        Mean X, Y, N (K) in N and N m.
    first_harmonic : mapping of str to (float, float)
        First harmonics in N and N m, in phase with velocity and with acceleration of the run's main motion: sway
        velocity of sway runs, yaw rate of yaw runs. Empty for steady runs.
    velocity_amplitude, acceleration_amplitude : float
        Amplitudes of that motion in m/s and m/s2, or rad/s and rad/s2.
    """

    run: Run
    mean_force: Mapping[str, float]
    first_harmonic: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    velocity_amplitude: float = 0.0
    acceleration_amplitude: float = 0.0


@dataclass(frozen=True)
class LinearSlopes:
    """Slopes of the forces, scaled with ``0.5 rho L T U^2``; None where the campaign does not show them.

    Attributes
    ----------
    Yv, Nv : float or None
        From static drift up to 12 degrees.
    X0 : float or None
        Mean X of towing without propeller and nearly without drift.
    lever : float or None
        Change of N over change of Y in static drift, in lengths: where the drift force attacks, forward of the
        reference of N.
    sway_damping, sway_added_mass : float or None
        Yv and Yvdot from pure sway.
    yaw_damping, yaw_added_inertia : float or None
        Nr and Nrdot from yaw oscillation.
    """

    Yv: float | None = None
    Nv: float | None = None
    X0: float | None = None
    lever: float | None = None
    sway_damping: float | None = None
    sway_added_mass: float | None = None
    yaw_damping: float | None = None
    yaw_added_inertia: float | None = None


def linear_slopes(summaries: Sequence[RunSummary], ship: Ship) -> LinearSlopes:
    """Slopes of one campaign, or of its runs at one depth and speed."""
    drift = drift_runs(summaries)
    small = [one for one in drift if abs(one.run.drift_angle) <= _LARGEST_DRIFT]
    if _spread(small) < _SMALLEST_DRIFT:
        small = drift
    sway = np.array([-math.sin(one.run.drift_angle) for one in small])
    scaled = {name: _scaled(name, small, ship) for name in ("Y", "N")}
    Yv = _slope(sway, scaled["Y"])
    Nv = _slope(sway, scaled["N"])
    return LinearSlopes(
        Yv=Yv,
        Nv=Nv,
        X0=_resistance(drift, ship),
        lever=None if Yv is None or Nv is None or abs(Yv) < 0.01 else Nv / Yv,
        **_oscillation(summaries, ship),
    )


def drift_runs(summaries: Sequence[RunSummary]) -> list[RunSummary]:
    """Static drift without rudder, heel and bank."""
    return [
        one
        for one in summaries
        if one.run.kind == "static_drift" and not (one.run.rudder_angle or one.run.heel or one.run.bank_position)
    ]


def scaled_force(name: str, one: RunSummary, ship: Ship) -> float:
    """Mean force of a run over ``0.5 rho L T U^2`` (moment with another L); NaN where it is not measured."""
    unit = 0.5 * ship.rho * ship.L * ship.T * one.run.speed**2 * (ship.L if name in ("N", "K") else 1.0)
    return one.mean_force.get(name, math.nan) / unit


def _scaled(name: str, runs: Sequence[RunSummary], ship: Ship) -> np.ndarray:
    return np.array([scaled_force(name, one, ship) for one in runs])


def _spread(runs: Sequence[RunSummary]) -> float:
    angles = [one.run.drift_angle for one in runs]
    return max(angles) - min(angles) if angles else 0.0


def _slope(motion: np.ndarray, force: np.ndarray) -> float | None:
    """Slope about the mean, so that a zero error does not matter; None when there is no clear one."""
    if len(motion) < 2 or not np.isfinite(force).all():
        return None
    v, f = motion - motion.mean(), force - force.mean()
    size, strength = float(v @ v), float(f @ f)
    if size < math.sin(_SMALLEST_DRIFT) ** 2 / 2 or strength == 0.0:
        return None
    if abs(float(v @ f)) < _CORRELATED * math.sqrt(size * strength):
        return None
    return float(v @ f) / size


def _resistance(runs: Sequence[RunSummary], ship: Ship) -> float | None:
    towed = [
        scaled_force("X", one, ship)
        for one in runs
        if not one.run.propeller_rate and abs(one.run.drift_angle) < math.radians(8.0)
    ]
    known = [value for value in towed if math.isfinite(value)]
    return float(np.mean(known)) if known else None


def _oscillation(summaries: Sequence[RunSummary], ship: Ship) -> dict[str, float | None]:
    area = 0.5 * ship.rho * ship.L * ship.T
    sway = [one for one in summaries if one.run.kind == "pure_sway"]
    yaw = [one for one in summaries if one.run.kind in ("pure_yaw", "yaw_drift")]
    # Y = Yv v + Yvdot vdot, N = Nr r + Nrdot rdot, each slope in its unit of force over motion
    return {
        "sway_damping": _harmonic_slope(sway, "Y", 0, [area * one.run.speed for one in sway]),
        "sway_added_mass": _harmonic_slope(sway, "Y", 1, [area * ship.L] * len(sway)),
        "yaw_damping": _harmonic_slope(yaw, "N", 0, [area * one.run.speed * ship.L**2 for one in yaw]),
        "yaw_added_inertia": _harmonic_slope(yaw, "N", 1, [area * ship.L**3] * len(yaw)),
    }


def _harmonic_slope(runs: Sequence[RunSummary], name: str, phase: int, units: Sequence[float]) -> float | None:
    product = square = 0.0
    for one, unit in zip(runs, units, strict=True):
        if name not in one.first_harmonic:
            continue
        amplitude = one.acceleration_amplitude if phase else one.velocity_amplitude
        product += one.first_harmonic[name][phase] * amplitude / unit
        square += amplitude**2
    return float(product / square) if square > 0.0 else None
