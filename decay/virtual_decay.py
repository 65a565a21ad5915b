"""Virtual decay records: simulated, with the noise, drift and handling of a towing tank, and labelled as virtual.

A record starts with the model at rest, goes on with pushes by hand near its own frequency until the wanted angle is
reached, and decays freely from there; or the model is held at the angle and let go. White and first-order
autoregressive noise, a rest position and its drift are added.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.ship import Ship
from .damping_models import MOTION_UNITS, TERMS
from .decay_input import MOTION_CHANNELS
from .decay_record import DecayRecord
from .equation import simulate_decay
from .excited_roll import Excitation, simulate_excited_roll
from .fluid_memory import simulate_memory_decay
from .term_values import term_values
from .transfer_function import TransferFunction

if TYPE_CHECKING:
    import pandas as pd

LABEL = "virtual: simulated, not measured"

_TRIES = 12


@dataclass(frozen=True)
class VirtualDecay:
    """What a virtual decay is made of. SI; angles in rad (heave: m).

    Attributes
    ----------
    coefficients : mapping of str to float
        Some of b1, b2, b3, c1, c3, c5 per unit inertia.
    amplitude : float
        Angle at the release.
    cycles : float
        Length of the free part in natural periods.
    samples_a_cycle : float
        Sampling of a natural period.
    pushes : int
        Half cycles in which a hand pushes the model before the release; 0 for a model that is held and let go.
    rest_cycles : float
        Natural periods at rest (or held) before.
    white, ar1 : float
        Standard deviations of white and of first-order autoregressive noise.
    correlation_time : float
        s, in which the autocorrelation of the latter falls to 1/e.
    offset, drift : float
        Rest position, and its change over the whole record.
    seed : int
    motion : {"roll", "pitch", "heave"}
    name : str
    speed, scale : float
    ship : Ship, optional
    memory : TransferFunction, optional
        Radiation beside the coefficients; needs `inertia` and no pushes.
    inertia : float
        I + A_inf for the memory.
    """

    coefficients: Mapping[str, float]
    amplitude: float
    cycles: float = 12.0
    samples_a_cycle: float = 100.0
    pushes: int = 0
    rest_cycles: float = 0.0
    white: float = 0.0
    ar1: float = 0.0
    correlation_time: float = 0.1
    offset: float = 0.0
    drift: float = 0.0
    seed: int = 0
    motion: str = "roll"
    name: str = "virtual decay"
    speed: float = 0.0
    scale: float = 1.0
    ship: Ship | None = None
    memory: TransferFunction | None = field(default=None, compare=False)
    inertia: float = 0.0

    def __post_init__(self) -> None:
        if not term_values(self.coefficients)[TERMS.index("c1")] > 0.0:
            raise FitError("a virtual decay needs c1 > 0", cure="c1 = (2 pi / natural period)^2")
        if not (self.amplitude != 0.0 and self.cycles > 0.0 and self.samples_a_cycle >= 8.0):
            raise FitError(
                "a virtual decay needs an amplitude, a length and at least eight samples a cycle",
                cure="give amplitude, cycles and samples_a_cycle",
            )
        if min(self.white, self.ar1, self.pushes, self.rest_cycles) < 0.0 or not self.correlation_time > 0.0:
            raise FitError("a size of noise, pushes or rest is negative", cure="give zero or more")
        if self.motion not in MOTION_UNITS:
            raise FitError(f"motion '{self.motion}' is unknown", cure=f"use one of {', '.join(MOTION_UNITS)}")
        if self.memory is not None and (self.pushes or not self.inertia > 0.0):
            raise FitError(
                "a virtual decay with memory is held and let go, and needs its inertia",
                cure="give inertia, no pushes",
            )

    @property
    def natural_period(self) -> float:
        """``2 pi / sqrt(c1)`` in s."""
        return 2.0 * math.pi / math.sqrt(self.coefficients["c1"])


@dataclass(frozen=True, eq=False)
class VirtualRecord:
    """A virtual record with what is true about it.

    Attributes
    ----------
    record : DecayRecord
        The whole of it, named and sourced as virtual.
    clean : ndarray, shape (n,)
        Coordinate without noise, offset and drift.
    release : float
        Time in s at which the hand left the model.
    truth : dict of str to float
        All six coefficients.
    """

    record: DecayRecord
    clean: np.ndarray
    release: float
    truth: dict[str, float]

    def to_frame(self) -> pd.DataFrame:
        """Columns as a laboratory would write them: ``time [s]`` and ``phi [deg]`` (``theta [deg]``, ``heave [m]``)."""
        import pandas as pd

        motion = self.record.motion
        unit = "m" if motion == "heave" else "deg"
        value = self.record.value if motion == "heave" else np.degrees(self.record.value)
        return pd.DataFrame({"time [s]": self.record.time, f"{MOTION_CHANNELS[motion]} [{unit}]": value})


def virtual_decay(plan: VirtualDecay) -> VirtualRecord:
    """Make the record of a plan.

    Raises
    ------
    FitError
        When the ship capsizes, or no pushes reach the amplitude.
    """
    step = plan.natural_period / plan.samples_a_cycle
    values = term_values(plan.coefficients)
    truth = dict(zip(TERMS, values.tolist()))
    rest = np.zeros(round(plan.rest_cycles * plan.samples_a_cycle))
    if plan.pushes:
        pushed, state = _pushed(plan, step)
    else:
        rest = rest + plan.amplitude
        pushed, state = np.zeros(0), (plan.amplitude, 0.0)
    time = step * np.arange(round(plan.cycles * plan.samples_a_cycle) + 1)
    if plan.memory is not None:
        free = simulate_memory_decay(time, state, truth, plan.memory, plan.inertia)[:, 0]
    else:
        free = simulate_decay(time, state, values)[:, 0]
    clean = np.concatenate([rest, pushed, free])
    if not np.isfinite(clean).all():
        raise FitError("the virtual ship capsizes", cure="lower the amplitude, or check c3 and c5")
    instants = step * np.arange(clean.size)
    value = clean + _noise(plan, clean.size, step) + plan.offset + plan.drift * np.linspace(0.0, 1.0, clean.size)
    record = DecayRecord(
        time=instants,
        value=value,
        motion=plan.motion,
        name=plan.name,
        speed=plan.speed,
        scale=plan.scale,
        ship=None if plan.ship is None else plan.ship.at_scale(plan.scale),
        unit=MOTION_UNITS[plan.motion],
        source=f"virtual decay, seed {plan.seed}",
        steps=(LABEL,),
    )
    return VirtualRecord(record, clean, float(instants[rest.size + pushed.size]), truth)


def demo_plan() -> VirtualDecay:
    """Roll decay of a tanker model 1:68 without bilge keels: pushed by hand, noisy, drifting a little."""
    ship = Ship("virtual tanker", 320.0, 58.0, 20.8, volume=312600.0, rho=1000.0, KG=18.6, GM=5.73, kxx=23.2)
    return VirtualDecay(
        coefficients={"b1": 0.0042, "b2": 0.11, "c1": 6.06},
        amplitude=math.radians(13.0),
        cycles=30.0,
        pushes=8,
        rest_cycles=3.0,
        white=math.radians(0.03),
        ar1=math.radians(0.05),
        correlation_time=0.3,
        offset=math.radians(0.25),
        drift=math.radians(0.1),
        seed=68,
        name="virtual tanker 1:68",
        scale=68.0,
        ship=ship,
    )


def _pushed(plan: VirtualDecay, step: float) -> tuple[np.ndarray, tuple[float, float]]:
    """Record of the pushes, and the state at the release; the pushes are sized so that the next peak is as wanted."""
    samples = round(0.5 * plan.pushes * plan.samples_a_cycle)
    time = step * np.arange(samples + 1)
    after = step * np.arange(round(plan.samples_a_cycle) + 1)
    rate = math.sqrt(plan.coefficients["c1"])
    wanted = abs(plan.amplitude)
    push = 2.0 * wanted * rate**2 / (math.pi * plan.pushes)
    for _ in range(_TRIES):
        path = simulate_excited_roll(time, (0.0, 0.0), plan.coefficients, Excitation(push, rate))
        state = (float(path[-1, 0]), float(path[-1, 1]))
        if not np.isfinite(path[-1]).all():
            push *= 0.5
            continue
        peak = float(np.abs(simulate_excited_roll(after, state, plan.coefficients)[:, 0]).max())
        if abs(peak / wanted - 1.0) < 1e-3:
            sign = math.copysign(1.0, plan.amplitude)
            return sign * path[:-1, 0], (sign * state[0], sign * state[1])
        push *= wanted / peak
    raise FitError(
        f"{plan.pushes} pushes do not reach {math.degrees(wanted):.3g} deg",
        cure="give more pushes, or fewer degrees",
    )


def _noise(plan: VirtualDecay, size: int, step: float) -> np.ndarray:
    """White noise plus a stationary first-order autoregression."""
    from scipy.signal import lfilter

    rng = np.random.default_rng(plan.seed)
    white = plan.white * rng.standard_normal(size)
    keep = math.exp(-step / plan.correlation_time)
    kicks = rng.standard_normal(size) * math.sqrt(1.0 - keep**2)
    kicks[0] /= math.sqrt(1.0 - keep**2)
    return white + plan.ar1 * lfilter([1.0], [1.0, -keep], kicks)
