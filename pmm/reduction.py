"""From the record of a run to means and harmonics of the hydrodynamic force: each step visible and switchable.

The order of the steps is that of the towing-tank practice (ITTC 7.5-02-06-02; IIHR's PMM data reduction): zero
level, filter, window, reference point, motion, inertia, non-dimensional form, mean and harmonics.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import FitError, ReadError, TowtankError
from ..core.findings import Finding
from ..core.record import Record
from ..core.scales import force_unit
from ..core.ship import Ship
from ..core.terms import Factor, Term
from ..identify.autocorrelation import mean_with_error
from ..identify.harmonics import HarmonicProjector, find_frequency, fit_harmonics, whole_cycle_window
from ..identify.steady_window import steady_window
from .campaign_file import Reduction
from .planar_motion import PlanarMotion, measured_motion, prescribed_motion
from .reduced_run import FORCES, ReducedRun, Window, motion_ranges, term_columns
from .rigid_body import RigidBody
from .run_types import Run
from .time_rows import HARMONICS, TimeRows
from .window_motion import WindowMotion

_PORT_UP = ("Y", "N", "y", "psi", "v", "r", "vdot", "rdot")


@dataclass(frozen=True)
class ReductionPlan:
    """Everything that the reduction of a run needs to know.

    Attributes
    ----------
    settings : Reduction
    ship : Ship
    conventions : Conventions
        Axes and force sign of the records.
    inertia : RigidBody or None
        What hangs on the balance; None when its inertia is not in the forces.
    tare : mapping of str to mapping
        Zero levels in N by name of the zero run.
    terms : tuple of Term
        Terms whose columns are wanted right away.
    keep_series : frozenset of str
        Names of the runs whose series the report shows.
    time_domain : bool
        Keep every sample, condensed, for a fit in the time domain.
    """

    settings: Reduction
    ship: Ship
    conventions: Conventions
    inertia: RigidBody | None = None
    tare: Mapping[str, Mapping[str, float]] | None = None
    terms: tuple[Term, ...] = ()
    keep_series: frozenset[str] = frozenset()
    time_domain: bool = False


def reduce_run(record: Record, run: Run, plan: ReductionPlan, findings: tuple[Finding, ...] = ()) -> ReducedRun:
    """Reduce one run.

    Parameters
    ----------
    record : Record
        Channels in SI, as the laboratory's axes and signs have them.
    run : Run
    plan : ReductionPlan
    findings : tuple of Finding
        What the audit said about the record.

    Returns
    -------
    ReducedRun

    Raises
    ------
    FitError, ReadError
        With the run's name, when the window is too short or a channel is missing.
    """
    try:
        return _reduce(record, run, plan, findings)
    except TowtankError as error:
        raise type(error)(
            error.cause,
            cure=error.cure,
            file=error.file or record.source or None,
            place=error.place or f"run '{run.name}'",
        ) from None


def _reduce(record: Record, run: Run, plan: ReductionPlan, findings: tuple[Finding, ...]) -> ReducedRun:
    settings = plan.settings
    ship = plan.ship if run.depth is None else replace(plan.ship, depth=run.depth)
    record = home_axes(record, plan.conventions)
    record, zero_sd = _without_zero_level(record, run, plan)
    record = _low_passed(record, settings.lowpass)
    omega = run.frequency
    if run.harmonic and settings.frequency == "found":
        omega, record = _found_frequency(record, run)
        run = replace(run, frequency=omega)
    rows, note = _window(record, run, settings)
    record = record.cut(rows, f"window: {note}")
    if len(record) < 3:
        raise FitError(f"{len(record)} samples are left in the window", cure="widen the window")
    window = Window(float(record.time[0]), _mean_step(record), len(record), note)
    names = [name for name in FORCES if name in record]
    if not names:
        raise ReadError("no force channel", cure="map X, Y or N in [channels]")
    forces = {name: record[name] for name in names}
    if settings.moment_x and "N" in forces:
        if "Y" not in forces:
            raise ReadError("moving the moment to midship needs Y", cure="map Y in [channels]")
        forces["N"] = forces["N"] + settings.moment_x * forces["Y"]
        record = record.with_channels(f"N: moved from x = {settings.moment_x:g} m to midship")
    motion, step = _motion(record, run, settings)
    record = record.with_channels(step)
    order = settings.harmonics if run.harmonic else 0
    projector = HarmonicProjector(window.times, omega, order) if run.harmonic else None
    over = WindowMotion(motion, window.times, projector)
    if plan.inertia is not None:
        for name, reaction in over.samples(plan.inertia.forces).items():
            if name in forces:
                forces[name] = forces[name] + reaction
        record = record.with_channels(f"inertia: {plan.inertia.describe()} added back")
    scale = settings.nondimensional_speed
    # A model in air has no speed to scale forces with; 1 m/s keeps them finite.
    square = np.ones(1) if run.dry else over.samples(_square_of_speed(motion, scale))["U2"]
    scaled = {name: values / (force_unit(name, "LT", ship, 1.0) * square) for name, values in forces.items()}
    result = (
        _harmonics(projector, window.times, forces, scaled) if projector is not None else _means(forces, scaled)
    )
    for name, error in zero_sd.items():
        unit = force_unit(name, "LT", ship, float(np.sqrt(np.mean(square))))
        result.scaled_sd[name][0] = math.hypot(result.scaled_sd[name][0], error / unit)

    def columns_at(at: Mapping[str, np.ndarray]) -> dict[tuple[Factor, ...], np.ndarray]:
        return term_columns(at, plan.terms, ship, scale, motion.speed)

    columns, samples = {}, None
    if plan.terms and not run.dry:
        columns = over.projections(columns_at)
        if plan.time_domain:
            samples = _time_rows(window, omega, order, columns_at(over.at), scaled, result)
    return ReducedRun(
        run=run,
        ship=ship,
        motion=motion,
        window=window,
        order=order,
        forces=result.forces,
        scaled=result.scaled,
        scaled_sd=result.scaled_sd,
        noise_dof=result.dof,
        residual_sd=result.residual_sd,
        velocity_scale=settings.nondimensional_speed,
        steps=(*record.steps, result.note),
        findings=findings,
        sha256=record.sha256,
        series=forces if run.name in plan.keep_series else {},
        samples=samples,
        columns=columns,
        ranges={} if run.dry else motion_ranges(over.in_short, ship, scale, motion.speed),
    )


def home_axes(record: Record, conventions: Conventions) -> Record:
    """Record with axes and force signs of home: x forward, y to starboard, z down, forces on the ship."""
    changed: dict[str, np.ndarray] = {}
    if conventions.axes == "forward-port-up":
        changed = {name: -record[name] for name in _PORT_UP if name in record}
    if conventions.force_sign == "by-ship":
        for name in FORCES:
            if name in record:
                changed[name] = -changed.get(name, record[name])
    if conventions.rudder_sign == "port" and "rudder_angle" in record:
        changed["rudder_angle"] = -record["rudder_angle"]
    if not changed:
        return record
    return record.with_channels(f"signs turned to home: {', '.join(sorted(changed))}", **changed)


def zero_level(record: Record, plan: ReductionPlan) -> dict[str, float]:
    """Mean of each force channel of a zero run, in N, home axes."""
    record = home_axes(record, plan.conventions)
    return {name: float(np.mean(record[name])) for name in FORCES if name in record}


def _without_zero_level(record: Record, run: Run, plan: ReductionPlan) -> tuple[Record, dict[str, float]]:
    """Record less its zero, and the standard error in N of a zero that belongs to this run alone."""
    if run.tare:
        levels = (plan.tare or {})[run.tare]
        changed = {name: record[name] - level for name, level in levels.items() if name in record}
        return record.with_channels(f"zero level of '{run.tare}' subtracted", **changed), {}
    if plan.settings.tare_window is None:
        return record, {}
    start, stop = plan.settings.tare_window
    rows = slice(*np.searchsorted(record.time, (start, stop)))
    if rows.stop - rows.start < 2:
        raise FitError(
            f"no sample lies in the tare window {start:g} to {stop:g} s", cure="mend reduction.tare_window"
        )
    zeros = {name: mean_with_error(record[name][rows]) for name in FORCES if name in record}
    changed = {name: record[name] - zero.mean for name, zero in zeros.items()}
    errors = {name: float(zero.se) for name, zero in zeros.items()}
    return record.with_channels(f"zero level of {start:g}-{stop:g} s subtracted", **changed), errors


def _low_passed(record: Record, cutoff: float) -> Record:
    if cutoff <= 0:
        return record
    from scipy import signal

    rate = 1.0 / record.time_step
    if cutoff >= rate / 2:
        raise FitError(
            f"the low-pass at {cutoff:g} Hz is above half the sampling rate {rate:g} Hz", cure="lower it"
        )
    sections = signal.butter(4, cutoff, fs=rate, output="sos")
    changed = {name: signal.sosfiltfilt(sections, record[name]) for name in FORCES if name in record}
    return record.with_channels(f"zero-phase Butterworth low-pass, order 4, {cutoff:g} Hz", **changed)


def _found_frequency(record: Record, run: Run) -> tuple[float, Record]:
    name = "y" if "y" in record and run.sway_amplitude else "psi" if "psi" in record else "Y"
    found = find_frequency(record.time, record[name], 3)
    return found.omega, record.with_channels(f"frequency found from {name}: {found.omega:.6g} rad/s")


def _window(record: Record, run: Run, settings: Reduction) -> tuple[slice, str]:
    time = record.time
    if run.harmonic:
        skip = settings.skip_cycles
        rows = whole_cycle_window(time, run.frequency, skip_cycles=skip, start=settings.start, stop=settings.stop)
        if settings.max_cycles is not None:
            stop = float(time[rows.start]) + settings.max_cycles * run.period
            rows = whole_cycle_window(
                time, run.frequency, start=float(time[rows.start]), stop=min(stop, float(time[rows.stop - 1]))
            )
        cycles = round((rows.stop - rows.start) * _mean_step(record) / run.period)
        return rows, f"{cycles} whole cycle(s) after {skip} dropped"
    forces = np.column_stack([record[name] for name in FORCES if name in record])
    choice = steady_window(
        time,
        forces,
        rule=settings.window,
        fraction=settings.fraction,
        start=settings.start,
        stop=settings.stop,
        speed=record["speed"] if "speed" in record else None,
    )
    return choice.slice, choice.note


def _mean_step(record: Record) -> float:
    time = record.time
    return float(time[-1] - time[0]) / (len(record) - 1)


def _motion(record: Record, run: Run, settings: Reduction) -> tuple[PlanarMotion, str]:
    if "speed" in record:
        measured = float(np.mean(record["speed"]))
        run = replace(run, speed=measured)
    if settings.motion == "prescribed" or not run.harmonic:
        source = "measured carriage speed" if "speed" in record else "prescribed"
        return prescribed_motion(run, settings.position_x), f"motion: {source}, exact kinematics"
    if "y" not in record or "psi" not in record:
        raise ReadError(
            "measured motion needs the channels y and psi", cure="map them or use motion = 'prescribed'"
        )
    motion = measured_motion(
        run,
        record.time,
        record["x"] if "x" in record else None,
        record["y"],
        record["psi"],
        settings.motion_harmonics,
        settings.position_x,
    )
    return motion, f"motion: measured, {settings.motion_harmonics} harmonics of y and psi, exact kinematics"


def _square_of_speed(
    motion: PlanarMotion, scale: str
) -> Callable[[Mapping[str, np.ndarray]], dict[str, np.ndarray]]:
    """Square of the speed that scales the forces, as a function of the motion."""

    def square(at: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        if scale == "approach":
            return {"U2": np.full(np.shape(at["surge"]), motion.speed**2)}
        return {"U2": at["surge"] ** 2 + at["v"] ** 2}

    return square


@dataclass(frozen=True)
class _Coefficients:
    forces: dict[str, np.ndarray]
    scaled: dict[str, np.ndarray]
    scaled_sd: dict[str, np.ndarray]
    dof: dict[str, np.ndarray]
    residual_sd: dict[str, float]
    note: str


def _harmonics(
    projector: HarmonicProjector,
    times: np.ndarray,
    forces: Mapping[str, np.ndarray],
    scaled: Mapping[str, np.ndarray],
) -> _Coefficients:
    names = list(forces)
    omega, order = projector.omega, projector.order
    responses = np.column_stack([scaled[name] for name in names])
    fit = fit_harmonics(times, responses, omega=omega, order=order, projector=projector)
    dimensional = projector.project(np.column_stack([forces[name] for name in names]))
    # Residuals in N: those of the scaled force times the mean of its unit, which varies by a few per cent.
    unit = [
        float(np.mean(forces[name] * scaled[name]) / max(np.mean(scaled[name] ** 2), 1e-300)) for name in names
    ]
    sd = np.sqrt(np.diagonal(fit.cov, axis1=1, axis2=2)).T
    return _Coefficients(
        forces={name: dimensional[:, i] for i, name in enumerate(names)},
        scaled={name: fit.coefficients[:, i] for i, name in enumerate(names)},
        scaled_sd={name: sd[:, i] for i, name in enumerate(names)},
        dof={name: fit.dof[:, i] for i, name in enumerate(names)},
        residual_sd={
            name: float(np.atleast_1d(fit.residual_std)[i]) * abs(unit[i]) for i, name in enumerate(names)
        },
        note=f"mean and {order} harmonics by least squares at {omega:.6g} rad/s",
    )


def _means(forces: Mapping[str, np.ndarray], scaled: Mapping[str, np.ndarray]) -> _Coefficients:
    names = list(forces)
    estimate = mean_with_error(np.column_stack([scaled[name] for name in names]))
    mean, se, dof = (np.atleast_1d(value) for value in (estimate.mean, estimate.se, estimate.dof))
    return _Coefficients(
        forces={name: np.array([forces[name].mean()]) for name in names},
        scaled={name: mean[i : i + 1] for i, name in enumerate(names)},
        scaled_sd={name: se[i : i + 1] for i, name in enumerate(names)},
        dof={name: dof[i : i + 1] for i, name in enumerate(names)},
        residual_sd={name: float(forces[name].std()) for name in names},
        note=f"mean of {len(forces[names[0]])} samples",
    )


def _time_rows(
    window: Window,
    omega: float,
    order: int,
    columns: Mapping[tuple[Factor, ...], np.ndarray],
    scaled: Mapping[str, np.ndarray],
    result: _Coefficients,
) -> TimeRows:
    """Samples of a window condensed, with the noise density at the mean and at each harmonic."""
    columns = {factors: values for factors, values in columns.items() if factors}
    # Variances are S/n of a mean, 2 S/n of a cosine or sine.
    if not order:
        density = {name: window.count * sd[:1] ** 2 for name, sd in result.scaled_sd.items()}
        return TimeRows.condensed(columns, scaled, density)
    fine = max(order, min(HARMONICS, int(0.4 * 2.0 * math.pi / (omega * window.step))))
    projector = HarmonicProjector(window.times, omega, fine)
    responses = np.column_stack(list(scaled.values()))
    fit = fit_harmonics(window.times, responses, omega=omega, order=fine, projector=projector)
    variance = window.count * np.diagonal(fit.cov, axis1=1, axis2=2)
    # The mean also has the error of the run's own zero, which the fit of harmonics does not know.
    zero = np.array([window.count * sd[0] ** 2 for sd in result.scaled_sd.values()])
    lines = (variance[:, 1::2] + variance[:, 2::2]) / 4.0
    density = {name: np.concatenate([zero[i : i + 1], lines[i]]) for i, name in enumerate(scaled)}
    return TimeRows.condensed(columns, scaled, density, projector)


def point_run(
    run: Run,
    ship: Ship,
    scaled: Mapping[str, float],
    sd: Mapping[str, float],
    velocity_scale: str = "instantaneous",
) -> ReducedRun:
    """A run of which only reduced means are known (published points).

    Parameters
    ----------
    run : Run
    ship : Ship
    scaled : mapping of str to float
        Force over ``0.5 rho L T U**2`` about midship, home axes.
    sd : mapping of str to float
        Its standard uncertainty; NaN where unknown.
    velocity_scale : {"instantaneous", "approach"}
    """
    motion = prescribed_motion(run)
    at = motion.at(np.zeros(1))
    speed = math.sqrt(float(_square_of_speed(motion, velocity_scale)(at)["U2"][0]))
    forces = {name: np.array([value * force_unit(name, "LT", ship, speed)]) for name, value in scaled.items()}
    return ReducedRun(
        run=run,
        ship=ship if run.depth is None else replace(ship, depth=run.depth),
        motion=motion,
        window=Window(0.0, 1.0, 1, "already reduced"),
        order=0,
        forces=forces,
        scaled={name: np.array([value]) for name, value in scaled.items()},
        scaled_sd={name: np.array([sd.get(name, math.nan)]) for name in scaled},
        noise_dof={name: np.array([math.inf]) for name in scaled},
        velocity_scale=velocity_scale,
        steps=("already reduced",),
    )
