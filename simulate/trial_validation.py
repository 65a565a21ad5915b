"""A measured manoeuvre against the simulated one and its band: errors, z-scores, coverage."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import SimulationError
from .current import CurrentEstimate, estimate_current, remove_current
from .found_events import with_events
from .found_states import order_time
from .manoeuvre_indices import event_indices, indices
from .manoeuvre_names import KINDS
from .manoeuvring_results import percentages
from .named_programmes import named_programme
from .parameter_scatter import ParameterScatter, scatter_of, vessel_of_draw
from .programme import Programme
from .sailing import sail
from .trajectory import Trajectory
from .trial_alignment import approach_speed, from_order, replayed, require_approach, require_scale, require_side
from .vessel import Vessel

if TYPE_CHECKING:
    import pandas as pd

FloatArray = np.ndarray
Progress = Callable[[str, int, int], None]

CHANNELS = {"x": "m", "y": "m", "psi": "deg", "u": "m/s", "v": "m/s", "r": "deg/s", "phi": "deg"}
"""Channels that are compared, with the unit of the table."""

BAND = (0.05, 0.95)
"""Quantiles at the edges of the band."""


@dataclass(frozen=True, eq=False)
class TrialValidation:
    """What a measured manoeuvre says about a simulated one.

    Attributes
    ----------
    measured : Trajectory
        From the first order on: time and place count from there, heading from the course of the approach; without
        the current where it was removed.
    simulated : Trajectory
        Of the unperturbed vessel, at the times of the measured one.
    draws : mapping of str to ndarray, shape (k, n)
        Channels of the draws at the same times, NaN after the end of a manoeuvre; empty without draws.
    failed : int
        Draws that did not complete the manoeuvre.
    indices : DataFrame
        Columns manoeuvre, index, unit, measured, simulated, error (simulated less measured), error_pct (of the
        measured), sd, p05, p95, z (error over sd), covered (True, False or None).
    channels : DataFrame
        Columns channel, unit, samples, rmse, largest, correlation, coverage_pct (share of the samples inside the
        band; NaN without draws).
    current : CurrentEstimate or None
        What was removed.
    scatter : str
        What was drawn from.
    """

    measured: Trajectory
    simulated: Trajectory
    draws: Mapping[str, FloatArray]
    failed: int
    indices: pd.DataFrame
    channels: pd.DataFrame
    current: CurrentEstimate | None
    scatter: str

    def band(self, channel: str) -> tuple[FloatArray, FloatArray] | None:
        """Quantiles of a channel over the draws, two arrays of shape (n,); None without draws."""
        return None if channel not in self.draws else _band(self.draws[channel])


def validate_trial(
    vessel: Vessel,
    trial: Trajectory,
    *,
    speed: float | None = None,
    replay: bool = False,
    without_current: bool = False,
    over_ground: bool = False,
    execute: float | None = None,
    draws: int = 0,
    percent: float | None = None,
    seed: int = 0,
    progress: Progress | None = None,
) -> TrialValidation:
    """Sail the manoeuvre of a trial and compare.

    Parameters
    ----------
    vessel : Vessel
        At the scale of the trial; it approaches with the speed of the trial.
    trial : Trajectory
        Measured; its `manoeuvre` names what was ordered, e.g. ``"turning 35"``. It may be empty with `replay`, which
        then compares channels alone.
    speed : float, optional
        Approach speed in m/s; default that of the trial at the first order.
    replay : bool
        Sail the rudder angles that were measured (and propeller rates, where known) in place of the orders.
    without_current : bool
        Estimate a uniform current from the steady turn of the trial and remove it.
    over_ground : bool
        The velocities of the trial are over the ground; they are corrected for the current too.
    execute : float, optional
        Time of the first order in s; default where the rudder (the propeller, for a crash stop)
        begins to move.
    draws, percent, seed
        Of the band; see :func:`~towtank.simulate.manoeuvring_results.sail_manoeuvres`.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    ReadError, AuditError
        For missing channels and what the checks of the trial find.
    SimulationError
        When the manoeuvre cannot be sailed.
    FitError
        When the trial holds no steady turn to estimate a current from.
    """
    named = bool(trial.manoeuvre)
    if not named and not replay:
        raise SimulationError(
            "what was sailed is not known", cure="name the manoeuvre, or replay the trial's rudder"
        )
    if named:
        trial = replace(trial, manoeuvre=named_programme(trial.manoeuvre, 1.0).name)
    current = None
    if without_current:
        current = estimate_current(trial)
        trial = remove_current(trial, current, execute=execute, over_ground=over_ground)
    if draws == 0 and percent is not None:
        raise SimulationError("a scatter in per cent needs draws", cure="give a number of draws, e.g. 200")
    begin = order_time(trial, execute, "n" if trial.manoeuvre == "crash stop" else "delta")
    if speed is None:
        speed = approach_speed(trial, begin)
        require_scale(trial, speed, vessel)
    vessel = vessel.but(speed=speed)
    tick = vessel.ship.L / vessel.speed
    programme = replayed(trial, begin) if replay else named_programme(trial.manoeuvre, tick)
    measured = from_order(trial, begin)
    if named:
        require_approach(measured)
        require_side(measured)
    simulated = sail(vessel, programme, interval=0.02 * tick)
    if named:
        simulated = replace(simulated, manoeuvre=trial.manoeuvre, events=None if replay else simulated.events)
    scatter: ParameterScatter | None = None
    tracks: dict[str, FloatArray] = {}
    values: dict[str, FloatArray] = {}
    failed = 0
    if draws != 0:
        if draws < 2:
            raise SimulationError(f"an ensemble of {draws} draws has no spread", cure="take 200 or more")
        scatter = scatter_of(
            vessel,
            covariance=True if vessel.hull.covariance is not None else None,
            percent=percentages(vessel, percent),
        )
        tracks, values, failed = _sail_draws(vessel, scatter, programme, measured, draws, seed, progress)
    at_samples = _at(simulated, measured["time"])
    return TrialValidation(
        measured=measured,
        simulated=simulated,
        draws=tracks,
        failed=failed,
        indices=_index_table(measured, simulated, values, vessel.speed),
        channels=_channel_table(measured, at_samples, tracks),
        current=current,
        scatter="" if scatter is None else f"{draws} draws, seed {seed}: {scatter.source}",
    )


def _at(trajectory: Trajectory, time: FloatArray) -> dict[str, FloatArray]:
    """Channels of a simulated trajectory at some times, NaN after its end."""
    return {
        name: np.interp(time, trajectory["time"], trajectory[name], right=np.nan)
        for name in CHANNELS
        if name in trajectory
    }


def _sail_draws(
    vessel: Vessel,
    scatter: ParameterScatter,
    programme: Programme,
    measured: Trajectory,
    draws: int,
    seed: int,
    progress: Progress | None,
) -> tuple[dict[str, FloatArray], dict[str, FloatArray], int]:
    """Channels and indices of the draws that completed the manoeuvre, and the number of the others."""
    tracks: list[dict[str, FloatArray]] = []
    values: list[dict[str, float]] = []
    gap = max(float(np.median(np.diff(measured["time"]))), 0.02 * vessel.ship.L / vessel.speed)
    for number, row in enumerate(scatter.draws(draws, seed)):
        if progress:
            progress("draws", number, draws)
        try:
            one = sail(vessel_of_draw(vessel, scatter.names, row), programme, interval=gap, tolerance=1e-5)
        except SimulationError:
            continue
        tracks.append(_at(one, measured["time"]))
        if measured.manoeuvre and _indexed(measured):
            one = replace(
                one, manoeuvre=measured.manoeuvre, events=one.events if programme.schedule is None else None
            )
            values.append(_values(one, vessel.speed))
    if progress:
        progress("draws", draws, draws)
    if len(tracks) < 2:
        raise SimulationError(
            f"{draws - len(tracks)} of {draws} draws did not complete {programme.name}", cure="narrow the scatter"
        )
    names = {name for one in values for name in one}
    return (
        {name: np.array([one[name] for one in tracks]) for name in tracks[0]},
        {name: np.array([one.get(name, np.nan) for one in values]) for name in names},
        draws - len(tracks),
    )


def _values(trajectory: Trajectory, speed: float) -> dict[str, float]:
    known = with_events(trajectory)
    assert known.events is not None
    found = event_indices(known.manoeuvre, known.events, known.ship, speed)
    return {name: float(value[0]) for name, value in found.items()}


def _indexed(trajectory: Trajectory) -> bool:
    return trajectory.manoeuvre.startswith(KINDS)


_INDEX_COLUMNS = (
    *("manoeuvre", "index", "unit", "measured", "simulated", "error", "error_pct"),
    *("sd", "p05", "p95", "z", "covered"),
)


def _index_table(
    measured: Trajectory, simulated: Trajectory, values: Mapping[str, FloatArray], speed: float
) -> pd.DataFrame:
    import pandas as pd

    if not _indexed(measured):
        return pd.DataFrame(columns=list(_INDEX_COLUMNS))
    # a pull-out is executed in the turn that its first order began
    real = indices(measured, execute=None if measured.manoeuvre.startswith("pull-out") else 0.0)
    model = indices(simulated, approach_speed=speed).set_index("index")["value"]
    rows = []
    for row in real.to_dict("records"):
        name, truth = row["index"], row["value"]
        if name not in model:
            continue
        error = float(model[name]) - truth
        spread = values.get(name, np.array([]))
        spread = spread[np.isfinite(spread)]
        sd, low, high = math.nan, math.nan, math.nan
        if len(spread) > 1:
            sd = float(np.std(spread, ddof=1))
            low, high = (float(edge) for edge in np.quantile(spread, BAND))
        rows.append(
            (
                row["manoeuvre"],
                name,
                row["unit"],
                truth,
                float(model[name]),
                error,
                100.0 * error / abs(truth) if truth else math.nan,
                sd,
                low,
                high,
                error / sd if sd > 0.0 else math.nan,
                bool(low <= truth <= high) if math.isfinite(sd) else None,
            )
        )
    return pd.DataFrame(rows, columns=list(_INDEX_COLUMNS))


def _channel_table(
    measured: Trajectory, model: Mapping[str, FloatArray], tracks: Mapping[str, FloatArray]
) -> pd.DataFrame:
    import pandas as pd

    rows = []
    for name, unit in CHANNELS.items():
        if name not in measured or name not in model:
            continue
        factor = math.degrees(1.0) if unit.startswith("deg") else 1.0
        real, ours = factor * measured[name], factor * model[name]
        both = np.isfinite(real) & np.isfinite(ours)
        if both.sum() < 2:
            continue
        error = (ours - real)[both]
        moving = np.ptp(real[both]) > 0.0 and np.ptp(ours[both]) > 0.0
        coverage = math.nan
        if name in tracks:
            low, high = _band(tracks[name])
            known = np.isfinite(low) & np.isfinite(real)
            # at the first order all tracks are in one place: rounding must not put the trial outside
            rounding = 1e-6 * float(np.nanmax(np.abs(measured[name])))
            inside = (measured[name] >= low - rounding) & (measured[name] <= high + rounding)
            coverage = 100.0 * float(np.mean(inside[known])) if known.any() else math.nan
        rows.append(
            (
                name,
                unit,
                int(both.sum()),
                float(np.sqrt(np.mean(error**2))),
                float(np.abs(error).max()),
                float(np.corrcoef(real[both], ours[both])[0, 1]) if moving else math.nan,
                coverage,
            )
        )
    columns = ["channel", "unit", "samples", "rmse", "largest", "correlation", "coverage_pct"]
    return pd.DataFrame(rows, columns=columns)


def _band(tracks: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Quantiles where at least nine of ten draws have not ended."""
    sailing = np.isfinite(tracks).mean(axis=0) >= 0.9
    low, high = np.full((2, tracks.shape[1]), np.nan)
    if sailing.any():
        low[sailing], high[sailing] = np.nanquantile(tracks[:, sailing], BAND, axis=0)
    return low, high
