"""Records of captive runs computed from a derivative set: exact kinematics, forces, inertia, zero, noise, signs.

What an estimator is to find again is known here. A balance feels the whole hydrodynamic force, so the set is first
brought into the form that a fit to measured forces returns: :func:`as_measured`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..core.conventions import HOME, Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, ConventionError
from ..core.motion import origin_position
from ..core.record import Record
from ..core.ship import Ship
from .noise import Noise, reference_forces
from .planar_motion import Oscillation, PlanarMotion, prescribed_motion
from .reduction import home_axes
from .rigid_body import RigidBody
from .run_types import Run

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

ZERO_RUN = "zero"
"""Name of the run at rest that gives the zero level of the balance."""


@dataclass(frozen=True)
class Laboratory:
    """How a virtual laboratory runs its carriage and what its channels mean.

    Attributes
    ----------
    conventions : Conventions
        Axes, origin of velocities and moments, force sign, and the signs and angle unit of the test matrix.
    moment_x : float, optional
        Point that the yaw moment is about, m forward of midship; the origin of `conventions` when not given.
    position_x : float, optional
        Point that follows the prescribed path, m forward of midship; the origin when not given.
    inertia : RigidBody, optional
        Model and mount, when their inertia is in the forces.
    balance_zero : mapping of str to float
        Reading of each channel at rest in N or Nm (home axes), the same in every run; a zero run is added.
    sampling_rate : float
        Samples a second.
    duration : float
        Length in s of the part of a steady run at constant speed.
    cycles : int
        Cycles of an oscillating run at full amplitude.
    rest, ramp : float
        Length in s of the rest and of the acceleration before a steady run, and of braking and rest after it.
    startup_cycles : int
        Cycles in which an oscillation grows to its full amplitude.
    """

    conventions: Conventions = HOME
    moment_x: float | None = None
    position_x: float | None = None
    inertia: RigidBody | None = None
    balance_zero: Mapping[str, float] = field(default_factory=dict)
    sampling_rate: float = 20.0
    duration: float = 30.0
    cycles: int = 5
    rest: float = 0.0
    ramp: float = 0.0
    startup_cycles: int = 0

    def __post_init__(self) -> None:
        for name in ("sampling_rate", "duration", "cycles"):
            if not getattr(self, name) > 0:
                raise CampaignError(f"{name} = {getattr(self, name)} is not positive", place=f"laboratory.{name}")
        for name in ("rest", "ramp", "startup_cycles"):
            if getattr(self, name) < 0:
                raise CampaignError(f"{name} = {getattr(self, name)} is negative", place=f"laboratory.{name}")
        if self.rest and not self.ramp:
            raise CampaignError(
                "a carriage at rest needs time to accelerate", cure="give ramp in s", place="laboratory.ramp"
            )

    def moment_point(self, ship: Ship) -> float:
        """Point that the yaw moment is about, m forward of midship."""
        return origin_position(self.conventions, ship) * ship.L if self.moment_x is None else self.moment_x

    def path_point(self, ship: Ship) -> float:
        """Point that follows the prescribed path, m forward of midship."""
        return origin_position(self.conventions, ship) * ship.L if self.position_x is None else self.position_x

    def times(self, run: Run | None = None) -> np.ndarray:
        """Time in s of the samples of a run, or of the zero run."""
        length = self.duration
        if run is not None and run.harmonic:
            length = (self.startup_cycles + self.cycles) * run.period
        elif run is not None:
            length += 2.0 * (self.rest + self.ramp)
        return np.arange(max(math.ceil(length * self.sampling_rate - 1e-9), 2)) / self.sampling_rate


@dataclass(frozen=True, eq=False)
class VirtualRun:
    """One run before noise, in SI and home axes.

    Attributes
    ----------
    run : Run
    time : ndarray, shape (n,)
    motion : mapping of str to ndarray, shape (n,)
        Motion of midship, as :meth:`PlanarMotion.at` gives it, and ``speed`` of the carriage where it changes.
    forces : mapping of str to ndarray, shape (n,)
        What a perfect balance reads, moment about the laboratory's point.
    """

    run: Run
    time: np.ndarray
    motion: Mapping[str, np.ndarray]
    forces: Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class VirtualCampaign:
    """Runs before noise, from which noisy campaigns are drawn.

    Attributes
    ----------
    laboratory : Laboratory
    ship : Ship
    runs : tuple of VirtualRun
    reference : mapping of str to float
        Reference force of each channel in N or Nm, which the sizes of noise are shares of.
    """

    laboratory: Laboratory
    ship: Ship
    runs: tuple[VirtualRun, ...]
    reference: Mapping[str, float]

    def records(self, noise: Noise) -> list[tuple[Run, Record]]:
        """Every run with its record: SI, in the axes and signs of the laboratory."""
        result = []
        for item in self.runs:
            forces = noise.readings(item.forces, self.reference, item.run.name, self.laboratory.balance_zero)
            result.append((item.run, self._record(item.run.name, item.time, forces, item.motion)))
        return result

    def zero_record(self, noise: Noise) -> Record:
        """The record of the zero run: the model at rest."""
        time = self.laboratory.times()
        still = np.zeros(len(time))
        forces = dict.fromkeys(self.reference, still)
        readings = noise.readings(forces, self.reference, ZERO_RUN, self.laboratory.balance_zero)
        names = ("x", "y", "psi", "surge", "v", "r", "udot", "vdot", "rdot")
        motion = dict.fromkeys((*names, "speed") if self.laboratory.ramp else names, still)
        return self._record(ZERO_RUN, time, readings, motion)

    def _record(
        self, name: str, time: np.ndarray, forces: Mapping[str, np.ndarray], motion: Mapping[str, np.ndarray]
    ) -> Record:
        lever = origin_position(self.laboratory.conventions, self.ship) * self.ship.L
        known = {
            "time": time,
            **motion,
            **forces,
            "u": motion["surge"],
            "v": motion["v"] + lever * motion["r"],
            "vdot": motion["vdot"] + lever * motion["rdot"],
        }
        channels = {channel: known[channel] for channel in UNITS if channel in known}
        record = Record(
            channels, units={channel: UNITS[channel] for channel in channels}, source=f"virtual {name}"
        )
        # The change of signs is its own inverse.
        return replace(record, channels=home_axes(record, self.laboratory.conventions).channels)


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


def virtual_campaign(
    derivatives: DerivativeSet | Mapping[float, DerivativeSet],
    runs: Sequence[Run],
    laboratory: Laboratory = Laboratory(),
    *,
    reference: Mapping[str, float] | None = None,
) -> VirtualCampaign:
    """Exact kinematics and forces of `runs`, to draw any number of noisy campaigns from.

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
    if not runs:
        raise CampaignError("there is no run to compute", cure="give a test matrix")
    names = [run.name for run in runs]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise CampaignError(f"two runs are called '{twice}'", cure="name each run once")
    computed = []
    if isinstance(derivatives, Mapping):
        ship = next(iter(derivatives.values())).ship
        derivatives = {depth: as_measured(one) for depth, one in derivatives.items()}
    else:
        ship, derivatives = derivatives.ship, as_measured(derivatives)
    for run in runs:
        chosen = _set_for(run, derivatives, ship)
        make = _oscillating if run.harmonic else _steady
        computed.append(make(chosen, run, laboratory))
    if reference is None:
        wet = [item.forces for item in computed if not item.run.dry]
        reference = reference_forces(wet or [item.forces for item in computed])
    return VirtualCampaign(laboratory, ship, tuple(computed), reference)


def synthesize_records(
    derivatives: DerivativeSet | Mapping[float, DerivativeSet],
    runs: Sequence[Run],
    laboratory: Laboratory = Laboratory(),
    *,
    noise: Noise = Noise(),
    reference: Mapping[str, float] | None = None,
) -> list[tuple[Run, Record]]:
    """Records of a virtual campaign in memory; arguments as in :func:`virtual_campaign`.

    Returns
    -------
    list of (Run, Record)
        Records in SI, in the axes and signs of the laboratory, as a reader returns them.
    """
    return virtual_campaign(derivatives, runs, laboratory, reference=reference).records(noise)


def _set_for(run: Run, derivatives: DerivativeSet | Mapping[float, DerivativeSet], ship: Ship) -> DerivativeSet:
    if not isinstance(derivatives, Mapping):
        return derivatives
    depth = ship.depth if run.depth is None else run.depth
    for known, chosen in derivatives.items():
        if known == depth or math.isclose(known, depth, rel_tol=1e-6):
            return chosen
    raise CampaignError(
        f"there is no derivative set for a depth of {depth:g} m",
        cure=f"give one; there are sets for {', '.join(f'{known:g}' for known in derivatives)} m",
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


@dataclass(frozen=True)
class GrowingOscillation(Oscillation):
    """An oscillation that grows from rest to its full amplitude in the first `rise` seconds.

    The amplitude follows the polynomial of degree 7 that has three continuous derivatives, so that yaw
    accelerations along the path stay continuous.
    """

    rise: float = 1.0

    def derivative(self, t: np.ndarray, omega: float, order: int) -> np.ndarray:
        """Time derivative of the given order at `t`, by the product rule."""
        s = np.clip(np.asarray(t, dtype=float) / self.rise, 0.0, 1.0)
        growth = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20])
        moving = replace(self, constant=0.0)
        value = np.full(np.shape(t), self.constant if order == 0 else 0.0)
        for k in range(order + 1):
            envelope = growth.deriv(k)(s) / self.rise**k if k else growth(s)
            value += math.comb(order, k) * envelope * Oscillation.derivative(moving, t, omega, order - k)
        return value


def _growing(wave: Oscillation, rise: float) -> Oscillation:
    return GrowingOscillation(wave.constant, wave.cosine, wave.sine, rise)


def _oscillating(derivatives: DerivativeSet, run: Run, laboratory: Laboratory) -> VirtualRun:
    ship = derivatives.ship
    path: PlanarMotion = prescribed_motion(run, laboratory.path_point(ship))
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
    return VirtualRun(run, time, motion, _readings(hydrodynamic, motion, run, laboratory, ship))


def _steady(derivatives: DerivativeSet, run: Run, laboratory: Laboratory) -> VirtualRun:
    ship = derivatives.ship
    point = laboratory.path_point(ship)
    time = laboratory.times(run)
    share, share_rate, travelled = carriage_profile(time, laboratory)
    constant = prescribed_motion(run, point).at(np.zeros(1))
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
    return VirtualRun(run, time, motion, _readings(hydrodynamic, motion, run, laboratory, ship))


def carriage_profile(time: np.ndarray, laboratory: Laboratory) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Speed of the carriage in a steady run, as a share of its full speed.

    Forces follow the square of the speed while the carriage accelerates and brakes: the angles stay, and the
    change of the coefficients with speed is neglected there.

    Parameters
    ----------
    time : ndarray, shape (n,)
    laboratory : Laboratory

    Returns
    -------
    share, rate, travelled : ndarray, shape (n,)
        Share of the full speed, its time derivative in 1/s, and its integral in s.
    """
    if not laboratory.ramp:
        return np.ones(len(time)), np.zeros(len(time)), time.copy()
    ramp = laboratory.ramp
    rising = np.clip((time - laboratory.rest) / ramp, 0.0, 1.0)
    braking = time - laboratory.rest - ramp - laboratory.duration
    falling = np.clip(braking / ramp, 0.0, 1.0)
    step = np.polynomial.Polynomial([0, 0, 3, -2])
    share = step(rising) - step(falling)
    rate = (step.deriv()(rising) - step.deriv()(falling)) / ramp
    # What lies beyond each ramp is travelled at full speed by the one and taken back by the other.
    travelled = ramp * (step.integ()(rising) - step.integ()(falling))
    travelled += np.maximum(time - laboratory.rest - ramp, 0.0) - np.maximum(braking - ramp, 0.0)
    return share, rate, travelled
