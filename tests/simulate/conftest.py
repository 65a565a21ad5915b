"""Manoeuvres in closed form: a drifting ship on a circle, and the first-order model of Nomoto in a zig-zag."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import brentq

from towtank.core.ship import Ship
from towtank.simulate.events import COLUMNS, Events
from towtank.simulate.trajectory import Trajectory

HULL = Ship("closed form", L=100.0, B=16.0, T=6.0)


@pytest.fixture(scope="session")
def hull() -> Ship:
    """A ship of 100 m."""
    return HULL


@dataclass(frozen=True)
class Circle:
    """A turn that is steady from execute on: radius m, speed m/s, drift angle rad, side, current m/s.

    With heading ``h`` turned since execute the course through the water is ``h - beta``: the advance is ``R (cos
    beta + sin beta)``, the transfer ``R (cos beta - sin beta)`` and the tactical diameter ``2 R cos beta``.
    """

    radius: float = 200.0
    speed: float = 5.0
    beta: float = math.radians(12.0)
    side: float = 1.0
    current: tuple[float, float] = (0.0, 0.0)
    heading: float = 0.0

    @property
    def rate(self) -> float:
        """Yaw rate in rad/s, without its sign."""
        return self.speed / self.radius

    def columns(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """States at times since execute in s."""
        turned = self.rate * time
        course = turned - self.beta
        ahead = self.radius * (np.sin(course) + math.sin(self.beta))
        aside = self.side * self.radius * (math.cos(self.beta) - np.cos(course))
        c, s = math.cos(self.heading), math.sin(self.heading)
        one = np.ones_like(time)
        return {
            "time": time,
            "x": ahead * c - aside * s + self.current[0] * time,
            "y": ahead * s + aside * c + self.current[1] * time,
            "psi": self.heading + self.side * turned,
            "u": self.speed * math.cos(self.beta) * one,
            "v": -self.side * self.speed * math.sin(self.beta) * one,
            "r": self.side * self.rate * one,
        }

    def trajectory(self, turned: float = 720.0, step: float = 1.0, manoeuvre: str = "turning") -> Trajectory:
        """Samples from execute, at time 0, until `turned` degrees."""
        time = np.arange(0.0, math.radians(turned) / self.rate + step, step)
        return Trajectory.from_columns(self.columns(time), HULL, manoeuvre)

    def events(self, names: dict[str, float]) -> Events:
        """Exact events at the headings in degrees that are turned by then."""
        rows = {}
        for name, turned in names.items():
            columns = self.columns(np.array([math.radians(turned) / self.rate]))
            rows[name] = np.array([columns[key][0] if key in columns else np.nan for key in COLUMNS])
        return Events(rows)


@pytest.fixture(scope="session")
def circle() -> type[Circle]:
    """Steady turns in closed form."""
    return Circle


TURN_NAMES = {
    "execute": 0.0, "heading 10": 10.0, "heading 20": 20.0, "heading 30": 30.0, "heading 60": 60.0,
    **{f"heading {angle}": float(angle) for angle in range(90, 721, 90)}, "end": 720.0,
}  # fmt: skip


@pytest.fixture(scope="session")
def turn_names() -> dict[str, float]:
    """Headings of the events of a turn of 720 degrees, but for the extremes of the track."""
    return TURN_NAMES


@dataclass(frozen=True)
class FirstOrderZigzag:
    """Nomoto's first-order model in a zig-zag with a rudder that moves at once: exact switching times and extremes."""

    K: float = 0.05
    T: float = 20.0
    rudder: float = math.radians(10.0)
    switch: float = math.radians(10.0)
    side: float = 1.0
    execute: float = 20.0
    reversals: int = 5

    def __post_init__(self) -> None:
        moments, extremes, states = [self.execute], [], [(0.0, 0.0)]
        sign = self.side
        for _ in range(self.reversals):
            psi, r = states[-1]
            moment = self._reach(psi, r, sign)
            states.append(self._state(psi, r, sign, moment))
            moments.append(moments[-1] + moment)
            sign = -sign
            psi, r = states[-1]
            peak = self.T * math.log(1.0 - r / (self.K * sign * self.rudder))
            extremes.append((moments[-1] + peak, self._state(psi, r, sign, peak)[0]))
        object.__setattr__(self, "moments", moments)
        object.__setattr__(self, "extremes", extremes)
        object.__setattr__(self, "states", states)

    def _state(self, psi: float, r: float, sign: float, after: float) -> tuple[float, float]:
        steady = self.K * sign * self.rudder
        decay = math.exp(-after / self.T)
        return psi + steady * after + self.T * (r - steady) * (1.0 - decay), steady + (r - steady) * decay

    def _reach(self, psi: float, r: float, sign: float) -> float:
        def short(after: float) -> float:
            return sign * self._state(psi, r, sign, after)[0] - self.switch

        return float(brentq(short, 1e-6, 100.0 * self.T, xtol=1e-13))

    def overshoot(self, number: int) -> float:
        """Exact overshoot in rad."""
        return abs(self.extremes[number - 1][1]) - self.switch  # type: ignore[attr-defined]

    def trajectory(self, step: float = 0.5, noise: float = 0.0, seed: int = 1, after: float = 60.0) -> Trajectory:
        """Samples from 0; noise in rad on the heading, twice as much on the rudder."""
        moments, states = self.moments, self.states  # type: ignore[attr-defined]
        time = np.arange(0.0, moments[-1] + after, step)
        psi, r, delta = np.zeros_like(time), np.zeros_like(time), np.zeros_like(time)
        sign = self.side
        for number, begin in enumerate(moments):
            for row in np.flatnonzero(time > begin):
                psi[row], r[row] = self._state(*states[number], sign, float(time[row]) - begin)
                delta[row] = sign * self.rudder
            sign = -sign
        random = np.random.default_rng(seed)
        columns = {
            "time": time,
            "psi": psi + noise * random.standard_normal(len(time)),
            "delta": delta + 2.0 * noise * random.standard_normal(len(time)),
        }
        if noise == 0.0:
            columns["r"] = r
        angles = f"{self.side * math.degrees(self.rudder):+g}/{math.degrees(self.switch):g}"
        return Trajectory.from_columns(columns, HULL, f"zigzag {angles}")


@pytest.fixture(scope="session")
def zigzag() -> type[FirstOrderZigzag]:
    """First-order zig-zags in closed form."""
    return FirstOrderZigzag


Rows = Callable[..., Events]


@pytest.fixture(scope="session")
def rows() -> Rows:
    """``rows(execute={"psi": 0.0, ...}, ...)``: events of one draw, columns that are not named are NaN."""

    def build(**states: dict[str, float]) -> Events:
        return Events(
            {
                name.replace("_", " "): np.array([state.get(key, np.nan) for key in COLUMNS])
                for name, state in states.items()
            }
        )

    return build
