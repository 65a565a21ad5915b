"""Uniform current from the track of a steady turn, and the track without it.

Over the ground a steady turn in a current is a drifting circle; in the water it is a circle. After a method for sea
trials in shallow water (trials of the MELLUM; Jansch and Boettner, 5th MASHCON, 2019): the current is the velocity that
makes the path, from where the rate of turn is constant, most nearly a circle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..core.errors import FitError
from .events import FloatArray
from .found_events import with_events
from .sampled_channels import SampledChannels
from .trajectory import Trajectory
from .trajectory_checks import check_samples

STEADY_CHANGE = 0.03
"""A turn is steady from the quarter turn after which the mean yaw rate changes by no more than this."""

LEAST_TURN = math.radians(270.0)
"""Heading change of the steady turn below which circle and current cannot be told apart."""

_QUARTER = 0.5 * math.pi


@dataclass(frozen=True)
class CurrentEstimate:
    """A uniform current and the circle that remains without it.

    Attributes
    ----------
    along, across : float
        Velocity of the water in the earth axes of the trajectory in m/s (x and y).
    along_error, across_error : float
        Standard errors in m/s, for independent position errors.
    radius : float
        Radius of the track through the water in m.
    roundness : float
        Standard deviation of the distances from the centre in m.
    window : tuple of float
        Times in s between which the turn was taken for steady.
    turns : float
        Full turns in the window.
    """

    along: float
    across: float
    along_error: float
    across_error: float
    radius: float
    roundness: float
    window: tuple[float, float]
    turns: float

    @property
    def speed(self) -> float:
        """Speed of the current in m/s."""
        return math.hypot(self.along, self.across)

    @property
    def direction(self) -> float:
        """Direction that the current flows to, in radians from the x axis towards y, 0 to 2 pi."""
        return math.atan2(self.across, self.along) % (2.0 * math.pi)


def estimate_current(trajectory: Trajectory, window: tuple[float, float] | None = None) -> CurrentEstimate:
    """Current that makes the steady part of a turning circle most nearly a circle.

    Parameters
    ----------
    trajectory : Trajectory
        With ``time, x, y, psi``; ``x, y`` over the ground.
    window : tuple of float, optional
        Times in s of the steady turn; default from the quarter turn after which the mean yaw rate stays within 3 per
        cent.

    Returns
    -------
    CurrentEstimate

    Raises
    ------
    FitError
        When the steady turn is less than three quarters of a circle, or the circle cannot be fitted.
    ReadError
        For missing channels or values, and gaps.
    """
    check_samples(trajectory, ("x", "y", "psi"))
    time, psi = trajectory["time"], trajectory["psi"]
    begin, end = steady_turn(trajectory) if window is None else window
    rows = (time >= begin) & (time <= end)
    turned = float(np.ptp(psi[rows])) if rows.sum() > 8 else 0.0
    if turned < LEAST_TURN:
        raise FitError(
            f"the steady turn from {begin:.4g} to {end:.4g} s covers {math.degrees(turned):.0f} deg; a current needs "
            f"{math.degrees(LEAST_TURN):.0f}",
            cure="turn on (540 deg of heading change in all), or give window=(from, to) in s",
            place=trajectory.manoeuvre,
        )
    clock = time[rows] - begin
    return _fit_drifting_circle(clock, trajectory["x"][rows], trajectory["y"][rows], psi[rows], (begin, end))


def steady_turn(trajectory: Trajectory) -> tuple[float, float]:
    """Times in s from which and to which the rate of turn is constant.

    Compares the mean yaw rates of quarter turns with that of all that follows.

    Raises
    ------
    FitError
        When the heading changes by less than a full turn.
    """
    channels = SampledChannels(trajectory)
    psi = channels.channels["psi"]
    side = math.copysign(1.0, psi[-1] - psi[0])
    channels.add("turned", side * (psi - psi[0]))
    most = float(channels.channels["turned"].max())
    quarters = np.arange(_QUARTER, most, _QUARTER)
    end = float(channels.time[-1])
    if len(quarters) < 4:
        raise FitError(
            f"the heading changes by {math.degrees(most):.0f} deg only: the turn has no steady part",
            cure="give a turning circle of 540 deg, or the window of the steady turn",
            place=trajectory.manoeuvre,
        )
    first = float(channels.time[0])
    passed = np.array([channels.crossing("turned", angle, first, end) for angle in quarters])
    rates = _QUARTER / np.diff(passed)
    for number in range(len(rates)):
        later = _QUARTER * len(rates[number:]) / (passed[-1] - passed[number])
        if abs(rates[number] / later - 1.0) <= STEADY_CHANGE:
            return float(passed[number]), end
    return float(passed[-1]), end


def _fit_drifting_circle(
    clock: FloatArray, x: FloatArray, y: FloatArray, psi: FloatArray, window: tuple[float, float]
) -> CurrentEstimate:
    """Centre, radius and drift of the circle with the least scatter of distances from its centre."""
    from scipy.optimize import least_squares

    # The heading tells the place on the circle: that makes a first estimate linear.
    basis = np.column_stack([np.ones_like(clock), clock, np.cos(psi), np.sin(psi)])
    columns, *_ = np.linalg.lstsq(basis, np.column_stack([x, y]), rcond=None)
    radius = float(np.linalg.norm(columns[2:]) / math.sqrt(2.0))

    def distances(parameters: FloatArray) -> FloatArray:
        along, across, centre_x, centre_y, _ = parameters
        return np.hypot(x - along * clock - centre_x, y - across * clock - centre_y)

    first = np.array([columns[1, 0], columns[1, 1], columns[0, 0], columns[0, 1], radius])
    # Positions in radii, velocities in radii a window: numbers of one size.
    duration = float(clock[-1])
    scale = np.array([radius / duration, radius / duration, radius, radius, radius])

    def residuals(parameters: FloatArray) -> FloatArray:
        return distances(parameters) - parameters[4]

    fit = least_squares(residuals, first, x_scale=scale, xtol=1e-14, ftol=1e-14, gtol=1e-14)
    along, across, _, _, radius = (float(value) for value in fit.x)
    if not fit.success or not np.isfinite(fit.x).all():
        raise FitError("no circle fits the steady turn", cure="choose the steady part with window=(from, to) in s")
    scatter = float(np.sqrt(2.0 * fit.cost / max(len(x) - 5, 1)))
    factor = np.linalg.pinv(np.asarray(fit.jac, dtype=float))
    errors = scatter * np.sqrt(np.diag(factor @ factor.T))
    return CurrentEstimate(
        along=along,
        across=across,
        along_error=float(errors[0]),
        across_error=float(errors[1]),
        radius=abs(radius),
        roundness=float(np.std(distances(fit.x))),
        window=window,
        turns=float(np.ptp(psi)) / (2.0 * math.pi),
    )


def remove_current(
    trajectory: Trajectory,
    current: CurrentEstimate | tuple[float, float],
    *,
    execute: float | None = None,
    over_ground: bool = False,
) -> Trajectory:
    """The trajectory in water at rest.

    Parameters
    ----------
    trajectory : Trajectory
        Track over the ground.
    current : CurrentEstimate or (along, across)
        Velocity of the water along x and y in m/s.
    execute : float, optional
        Time in s at which both tracks coincide; default the first order, or the first sample of a trajectory
        without a known manoeuvre.
    over_ground : bool
        ``u`` and ``v`` of the trajectory are over the ground and are corrected too; otherwise they are through the
        water already, and stay.

    Returns
    -------
    Trajectory
        Its events are not yet found; the choice is noted in the provenance.
    """
    along, across = (
        (current.along, current.across) if isinstance(current, CurrentEstimate) else map(float, current)
    )
    start = _coincide(trajectory) if execute is None else execute
    clock = trajectory["time"] - start
    columns = {"x": trajectory["x"] - along * clock, "y": trajectory["y"] - across * clock}
    if over_ground and "u" in trajectory and "v" in trajectory:
        psi = trajectory["psi"]
        columns["u"] = trajectory["u"] - along * np.cos(psi) - across * np.sin(psi)
        columns["v"] = trajectory["v"] + along * np.sin(psi) - across * np.cos(psi)
    step = f"current of {along:.4g} m/s along x and {across:.4g} m/s along y removed from {start:.6g} s"
    return trajectory.with_columns(step, **columns)


def _coincide(trajectory: Trajectory) -> float:
    """Time of the first order; of the first sample where there is none."""
    if not trajectory.manoeuvre:
        return float(trajectory["time"][0])
    known = with_events(replace(trajectory, events=None))
    name = "execute" if known.events is not None and "execute" in known.events else "execute 1"
    return float(known.events.at(name, "time")[0]) if known.events is not None else float(trajectory["time"][0])
