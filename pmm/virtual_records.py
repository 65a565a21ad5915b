"""Records of captive runs computed from a derivative set: exact kinematics, forces, inertia, zero, noise, signs.

What an estimator is to find again is known here. A balance feels the whole hydrodynamic force, so the set is first
brought into the form that a fit to measured forces returns: :func:`as_measured`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, ConventionError
from ..core.motion import origin_position, scaled_state
from ..core.record import Record
from ..core.ship import Ship
from ..core.terms import Factor, Term
from .laboratory import STANDARD_LABORATORY, Laboratory
from .noise import SILENT, Noise, reference_forces
from .planar_motion import Oscillation, prescribed_motion
from .reduction import home_axes
from .run_types import Run
from .start_up import GrowingOscillation, carriage_profile

UNITS = {
    "time": "s",
    "X": "N",
    "Y": "N",
    "N": "N m",
    "K": "N m",
    "speed": "m/s",
    "x": "m",
    "y": "m",
    "psi": "rad",
    "u": "m/s",
    "v": "m/s",
    "r": "rad/s",
    "udot": "m/s2",
    "vdot": "m/s2",
    "rdot": "rad/s2",
}
"""Channels of a virtual record in their order, with the SI unit of each."""

EXCITED = 1e-12
"""Largest value of a scaled term column over all runs that counts as no excitation."""

MotionAndForces = tuple[dict[str, np.ndarray], dict[str, np.ndarray]]

ZERO_RUN = "zero"
"""Name of the run at rest that gives the zero level of the balance."""


@dataclass(frozen=True, eq=False)
class VirtualRun:
    """One run before noise.

    Attributes
    ----------
    name : str
    ship : Ship
    laboratory : Laboratory
    time : ndarray, shape (n,)
    motion : mapping of str to ndarray, shape (n,)
        Motion of midship in SI and home axes, as :meth:`PlanarMotion.at` gives it, and ``speed`` of the carriage
        where it changes.
    forces : mapping of str to ndarray, shape (n,)
        What a perfect balance reads in N and Nm, home axes, moment about the laboratory's point.
    """

    name: str
    ship: Ship
    laboratory: Laboratory
    time: np.ndarray
    motion: Mapping[str, np.ndarray]
    forces: Mapping[str, np.ndarray]

    def record(self, noise: Noise, reference: Mapping[str, float]) -> Record:
        """What the laboratory records: SI, in its axes and signs, velocities at its origin.

        Parameters
        ----------
        noise : Noise
        reference : mapping of str to float
            Reference force of each channel in N or Nm.
        """
        motion, conventions = self.motion, self.laboratory.conventions
        lever = origin_position(conventions, self.ship) * self.ship.L
        known = {
            "time": self.time,
            **motion,
            **noise.readings(self.forces, reference, self.name, self.laboratory.balance_zero),
            "u": motion["surge"],
            "v": motion["v"] + lever * motion["r"],
            "vdot": motion["vdot"] + lever * motion["rdot"],
        }
        channels = {name: np.asarray(known[name]) for name in UNITS if name in known}
        record = Record(channels, {name: UNITS[name] for name in channels}, f"virtual run '{self.name}'")
        # The change of signs is its own inverse.
        return replace(record, channels=home_axes(record, conventions).channels)


@dataclass(frozen=True, eq=False)
class VirtualCampaign:
    """Runs before noise, from which any number of noisy campaigns are drawn.

    Attributes
    ----------
    runs : tuple of Run
    clean : tuple of VirtualRun
        One a run.
    reference : mapping of str to float
        Reference force of each channel in N or Nm, which the sizes of noise are shares of.
    """

    runs: tuple[Run, ...]
    clean: tuple[VirtualRun, ...]
    reference: Mapping[str, float]

    def records(self, noise: Noise) -> list[tuple[Run, Record]]:
        """Every run with its record in this noise."""
        return [(run, item.record(noise, self.reference)) for run, item in zip(self.runs, self.clean, strict=True)]


def as_measured(derivatives: DerivativeSet) -> DerivativeSet:
    """The set as a captive test sees it: added-mass Coriolis terms inside, the ship's own inertia outside.

    Raises
    ------
    ConventionError
        When the set lacks what the conversion needs.
    """
    try:
        return derivatives.to(derivatives.conventions, added_mass_coriolis="inside", rigid_body_inertia="outside")
    except ConventionError as error:
        raise ConventionError(
            f"the forces that a balance feels do not follow from set '{derivatives.name}': {error.cause}",
            cure=error.cure or "give the set with added-mass Coriolis terms inside and rigid-body inertia outside",
        ) from None


def sets_by_depth(derivatives: DerivativeSet | Mapping[float, DerivativeSet]) -> dict[float | None, DerivativeSet]:
    """Sets as measured, by water depth in m; one set for all depths has the key None.

    Raises
    ------
    CampaignError
        When there is no set.
    """
    if not isinstance(derivatives, Mapping):
        return {None: as_measured(derivatives)}
    if not derivatives:
        raise CampaignError("there is no derivative set", cure="give one for each depth")
    return {depth: as_measured(one) for depth, one in derivatives.items()}


def virtual_campaign(
    derivatives: DerivativeSet | Mapping[float, DerivativeSet],
    runs: Sequence[Run],
    laboratory: Laboratory = STANDARD_LABORATORY,
    *,
    reference: Mapping[str, float] | None = None,
) -> VirtualCampaign:
    """Exact kinematics and forces of `runs`, kept in memory.

    Parameters
    ----------
    derivatives : DerivativeSet, or mapping of float to DerivativeSet
        The set, or one set for each water depth in m (``inf`` for deep water).
    runs : sequence of Run
    laboratory : Laboratory
    reference : mapping of str to float, optional
        Reference forces of the noise in N and Nm; the largest force of each channel in the campaign when not
        given.

    Raises
    ------
    CampaignError
        For two runs of one name, a depth without a set, or a run in air without inertia.
    TermError, ConventionError
        When the set cannot be evaluated on the motion.
    """
    sets = sets_by_depth(derivatives)
    require_names(runs)
    clean = tuple(virtual_run(sets, run, laboratory) for run in runs)
    if reference is None:
        wet = [item.forces for run, item in zip(runs, clean, strict=True) if not run.dry]
        reference = reference_forces(wet or [item.forces for item in clean])
    return VirtualCampaign(tuple(runs), clean, reference)


def synthesize_records(
    derivatives: DerivativeSet | Mapping[float, DerivativeSet],
    runs: Sequence[Run],
    laboratory: Laboratory = STANDARD_LABORATORY,
    *,
    noise: Noise = SILENT,
    reference: Mapping[str, float] | None = None,
) -> list[tuple[Run, Record]]:
    """Records of a virtual campaign in memory; arguments as in :func:`virtual_campaign`.

    Returns
    -------
    list of (Run, Record)
        Records in SI, in the axes and signs of the laboratory, as a reader returns them.
    """
    return virtual_campaign(derivatives, runs, laboratory, reference=reference).records(noise)


def require_names(runs: Sequence[Run]) -> None:
    """Raise :class:`CampaignError` unless there are runs and each has a name of its own."""
    if not runs:
        raise CampaignError("there is no run to compute", cure="give a test matrix")
    counts = Counter(run.name for run in runs)
    twice = next((name for name, count in counts.items() if count > 1), None)
    if twice is not None:
        raise CampaignError(f"two runs are called '{twice}'", cure="name each run once")


def virtual_run(
    sets: Mapping[float | None, DerivativeSet], run: Run, laboratory: Laboratory = STANDARD_LABORATORY
) -> VirtualRun:
    """Exact kinematics and forces of one run.

    Parameters
    ----------
    sets : mapping
        Of :func:`sets_by_depth`.
    run : Run
    laboratory : Laboratory
    """
    derivatives = set_for(run, sets)
    make = _oscillating if run.harmonic else _steady
    motion, hydrodynamic = make(derivatives, run, laboratory)
    forces = _readings(hydrodynamic, motion, run, laboratory, derivatives.ship)
    return VirtualRun(run.name, derivatives.ship, laboratory, laboratory.times(run), motion, forces)


def excited_terms(
    sets: Mapping[float | None, DerivativeSet], runs: Sequence[Run], laboratory: Laboratory = STANDARD_LABORATORY
) -> tuple[Term, ...]:
    """Terms of the sets that some run excites, each once, in their order.

    Parameters
    ----------
    sets : mapping
        Of :func:`sets_by_depth`.
    runs : sequence of Run
    laboratory : Laboratory
    """
    largest: dict[tuple[str, tuple[Factor, ...]], float] = {}
    unique = {(term.component, term.factors): term for one in sets.values() for term in one.terms}
    for run in runs:
        if run.dry:
            continue
        one = set_for(run, sets)
        time = np.linspace(0.0, run.period, 32, endpoint=False) if run.harmonic else np.zeros(1)
        motion = prescribed_motion(run, laboratory.path_point(one.ship)).at(time)
        state, _ = scaled_state(motion, one.ship, one.conventions.but(force_scaling="LT"), run.speed)
        for term in one.terms:
            key = (term.component, term.factors)
            largest[key] = max(largest.get(key, 0.0), float(np.abs(term.column(state)).max()))
    return tuple(term for key, term in unique.items() if largest.get(key, 0.0) > EXCITED)


def zero_run(ship: Ship, laboratory: Laboratory, channels: Iterable[str]) -> VirtualRun:
    """The model at rest: what the balance reads is its zero."""
    time = laboratory.times()
    still = np.zeros(len(time))
    names = ["x", "y", "psi", "surge", "v", "r", "udot", "vdot", "rdot"]
    if laboratory.ramp:
        names.append("speed")
    return VirtualRun(
        ZERO_RUN, ship, laboratory, time, dict.fromkeys(names, still), dict.fromkeys(channels, still)
    )


def set_for(run: Run, sets: Mapping[float | None, DerivativeSet]) -> DerivativeSet:
    """The set of a run's water depth.

    Raises
    ------
    CampaignError
        When there is none.
    """
    if None in sets:
        return sets[None]
    depth = next(iter(sets.values())).ship.depth if run.depth is None else run.depth
    for known, chosen in sets.items():
        if known is not None and (known == depth or math.isclose(known, depth, rel_tol=1e-6)):
            return chosen
    raise CampaignError(
        f"there is no derivative set for a depth of {depth:g} m",
        cure=f"give one; there are sets for {', '.join(f'{known:g}' for known in sets)} m",
        place=f"run '{run.name}'",
    )


def _readings(
    hydrodynamic: Mapping[str, np.ndarray],
    motion: Mapping[str, np.ndarray],
    run: Run,
    laboratory: Laboratory,
    ship: Ship,
) -> dict[str, np.ndarray]:
    """What the balance loses to the body's inertia, and the moment about the laboratory's point."""
    forces = dict(hydrodynamic)
    if run.dry:
        if laboratory.inertia is None:
            raise CampaignError(
                "a run in air needs something on the balance",
                cure="give the inertia of model and mount",
                place=f"run '{run.name}'",
            )
        forces = {name: np.zeros(np.shape(motion["surge"])) for name in ("X", "Y", "N")}
    if laboratory.inertia is not None:
        reaction = laboratory.inertia.forces(motion)
        forces = {name: value - reaction[name] if name in reaction else value for name, value in forces.items()}
    lever = laboratory.moment_point(ship)
    if lever and "N" in forces:
        if "Y" not in forces:
            raise ConventionError(
                "moving the yaw moment from midship needs Y", cure="give a set with Y, or moment_x = 0"
            )
        forces["N"] = forces["N"] - lever * forces["Y"]
    return forces


def _growing(wave: Oscillation, rise: float) -> Oscillation:
    return GrowingOscillation(wave.constant, wave.cosine, wave.sine, rise)


def _oscillating(derivatives: DerivativeSet, run: Run, laboratory: Laboratory) -> MotionAndForces:
    path = prescribed_motion(run, laboratory.path_point(derivatives.ship))
    if laboratory.startup_cycles:
        rise = laboratory.startup_cycles * run.period
        path = replace(
            path,
            surge=_growing(path.surge, rise),
            sway=_growing(path.sway, rise),
            heading=_growing(path.heading, rise),
        )
    time = laboratory.times(run)
    motion = path.at(time)
    hydrodynamic = {} if run.dry else derivatives.forces(motion, approach_speed=run.speed)
    if laboratory.ramp:
        motion["speed"] = np.full(len(time), run.speed)
    return motion, hydrodynamic


def _steady(derivatives: DerivativeSet, run: Run, laboratory: Laboratory) -> MotionAndForces:
    time = laboratory.times(run)
    share, share_rate, travelled = carriage_profile(time, laboratory)
    constant = prescribed_motion(run, laboratory.path_point(derivatives.ship)).at(np.zeros(1))
    motion = {name: np.broadcast_to(value, len(time)) for name, value in constant.items()}
    for name, rate in (("surge", "udot"), ("v", "vdot"), ("r", "rdot")):
        motion[rate] = constant[name] * share_rate
        motion[name] = constant[name] * share
    turned = run.yaw_rate * travelled
    motion["psi"] = run.drift_angle + turned
    if run.yaw_rate:
        radius = run.speed / run.yaw_rate
        motion["x"], motion["y"] = radius * np.sin(turned), radius * (1.0 - np.cos(turned))
    else:
        motion["x"], motion["y"] = run.speed * travelled, np.zeros(len(time))
    level = derivatives.forces(constant, approach_speed=run.speed)
    hydrodynamic = {name: value * share**2 for name, value in level.items()}
    if laboratory.ramp:
        motion["speed"] = run.speed * share
        # Acceleration terms are linear and do not depend on the speed, so they are found at full speed.
        rates = {name: motion[name] for name in ("udot", "vdot", "rdot")}
        moving = derivatives.forces({**constant, **rates}, approach_speed=run.speed)
        hydrodynamic = {name: value + moving[name] - level[name] for name, value in hydrodynamic.items()}
    return motion, hydrodynamic
