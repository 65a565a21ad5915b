"""Squat records made by the program: a carriage that starts, runs and brakes, and a hull that sinks as the truth says.

Sinkage at bow and stern follows ``c Fh^2 / sqrt(1 - Fh^2)`` with a time constant behind the carriage; the sensors add
noise with a memory, and every run a shift of its own, as ballast and waiting time do in a tank.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..core.ship import Ship
from ..core.variables import GRAVITY

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

KNOT = 1852.0 / 3600.0


@dataclass(frozen=True)
class VirtualWave:
    """Regular waves met by the model.

    Attributes
    ----------
    omega : float
        Frequency of encounter in rad/s.
    bow, stern : (float, float)
        Amplitude in m and phase in rad of the motion at each end.
    """

    omega: float
    bow: tuple[float, float]
    stern: tuple[float, float]


@dataclass(frozen=True)
class VirtualSquat:
    """A plan of virtual runs.

    Attributes
    ----------
    ship : Ship
        At the scale of the model.
    depth : float
        Water depth in m.
    bow, stern : float
        True c in m of each end.
    rate, rest, ramp, run : float
        Samples a second; seconds at rest, of each ramp, at speed.
    settling : float
        Time constant of the sinkage behind the carriage in s.
    noise, memory : float
        Standard deviation of the sensors in m and the time constant of their noise in s.
    between_runs : float
        Standard deviation in m of the shift of a run.
    seed : int
    """

    ship: Ship
    depth: float
    bow: float
    stern: float
    rate: float = 20.0
    rest: float = 6.0
    ramp: float = 4.0
    run: float = 50.0
    settling: float = 2.0
    noise: float = 1.5e-4
    memory: float = 0.4
    between_runs: float = 4e-5
    seed: int = 12

    @property
    def truth(self) -> Mapping[str, float]:
        """True c by quantity: m, and for the trim m/m."""
        half = 0.5 * self.ship.L
        middle, slope = 0.5 * (self.bow + self.stern), (self.bow - self.stern) / (2.0 * half)
        return {
            "sinkage_bow": self.bow,
            "sinkage_stern": self.stern,
            "sinkage_midship": middle,
            "sinkage_cog": middle + slope * self.ship.xG,
            "trim": slope,
        }

    def sinkage(self, speed: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """True sinkage in m at bow and stern at speeds in m/s."""
        square = np.asarray(speed, dtype=float) ** 2 / (GRAVITY * self.depth)
        factor = square / np.sqrt(1.0 - square)
        return self.bow * factor, self.stern * factor

    def make(self, speed: float, number: int, wave: VirtualWave | None = None) -> pd.DataFrame:
        """Record of one run, units in its headings.

        Parameters
        ----------
        speed : float
            m/s.
        number : int
            Of the run: its noise and its shift depend on it.
        wave : VirtualWave, optional
        """
        import pandas as pd

        random = np.random.default_rng([self.seed, number])
        length = self.rest + 2.0 * self.ramp + self.run
        time = np.arange(1, round(length * self.rate) + 1) / self.rate
        start, stop = self.rest, length - self.ramp
        carriage = speed * np.interp(time, [start, start + self.ramp, stop, length], [0.0, 1.0, 1.0, 0.0])
        ends = []
        for place, target in enumerate(self.sinkage(carriage)):
            value = _lagged(target, self.settling * self.rate)
            if wave is not None:
                amplitude, phase = (wave.bow, wave.stern)[place]
                value = value + amplitude * (carriage / speed) * np.cos(wave.omega * time + phase)
            value = value + self.between_runs * random.standard_normal()
            ends.append(value + self.noise * _remembering(random, time.size, self.memory * self.rate))
        noisy = carriage + 2e-4 * speed * random.standard_normal(time.size)
        return pd.DataFrame(
            {"time [s]": time, "speed [m/s]": noisy, "bow [mm]": 1e3 * ends[0], "stern [mm]": 1e3 * ends[1]}
        )


def _lagged(target: np.ndarray, samples: float) -> np.ndarray:
    """First-order lag with a time constant in samples."""
    from scipy.signal import lfilter

    keep = float(np.exp(-1.0 / samples))
    return np.asarray(lfilter([1.0 - keep], [1.0, -keep], target))


def _remembering(random: np.random.Generator, n: int, samples: float) -> np.ndarray:
    """Noise of unit variance whose correlation falls by 1/e in some samples."""
    from scipy.signal import lfilter

    keep = float(np.exp(-1.0 / samples))
    drive = random.standard_normal(n + round(10 * samples))
    return np.asarray(lfilter([np.sqrt(1.0 - keep**2)], [1.0, -keep], drive))[-n:]


def demo_squat() -> VirtualSquat:
    """The shipped plan: a container ship 1:80 at h/T = 1.5."""
    ship = Ship("virtual container ship", L=230.0, B=32.2, T=10.8, volume=52030.0, xG=-3.4, rho=1000.0)
    return VirtualSquat(ship.at_scale(80.0), depth=0.2025, bow=0.0190, stern=0.0145)


@dataclass(frozen=True)
class VirtualCode:
    """A made-up computation: the truth times a factor that grows with the speed, and a wrong trim.

    Attributes
    ----------
    factor : float
        Of the sinkage at the lowest speed.
    growth : float
        Added to the factor from the lowest to the highest speed.
    bow_share : float
        Part of the midship sinkage that goes to the bow and is taken from the stern.
    """

    factor: float
    growth: float = 0.0
    bow_share: float = 0.0
    columns: tuple[str, ...] = field(default=("sinkage_bow", "sinkage_stern", "sinkage_midship", "trim"))

    def table(self, plan: VirtualSquat, speed: np.ndarray) -> pd.DataFrame:
        """Curves of the computation at speeds in m/s, units in the headings."""
        import pandas as pd

        bow, stern = plan.sinkage(speed)
        middle = 0.5 * (bow + stern)
        along = (speed - speed.min()) / np.ptp(speed)
        factor = self.factor + self.growth * along
        bow, stern = factor * (bow + self.bow_share * middle), factor * (stern - self.bow_share * middle)
        values = {
            "sinkage_bow": bow,
            "sinkage_stern": stern,
            "sinkage_midship": 0.5 * (bow + stern),
            "trim": (bow - stern) / plan.ship.L,
        }
        units = {"trim": "m/m"}
        return pd.DataFrame(
            {"speed [m/s]": speed} | {f"{name} [{units.get(name, 'm')}]": values[name] for name in self.columns}
        )


DEMO_CODES = {
    "virtual-rans": VirtualCode(1.03, 0.03, 0.02),
    "virtual-panel": VirtualCode(0.93, -0.10, 0.04),
    "virtual-strip": VirtualCode(1.12, -0.02, -0.08, ("sinkage_bow", "sinkage_stern")),
}
