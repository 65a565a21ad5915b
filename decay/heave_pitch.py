"""Damping ratio and natural frequency of heave, roll and pitch for a simulator in six degrees of freedom.

The procedure of Taimuri et al. (2020): the ship is released from an offset in one motion, peaks of the same sign are
read, ``zeta = ln(R_n / R_(n+1)) / (2 pi)``. That is the limit of light damping; exactly, with delta the logarithmic
decrement of a full cycle, ``zeta = delta / sqrt(4 pi^2 + delta^2)``: 0.5 % less at zeta = 0.1, 2 % at 0.2. Both are
given, the exact one is used. The simulator's damping force is ``-2 zeta omega_n x' (m + added mass)``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .decay_record import DecayRecord
from .extremes import find_extremes
from .logarithmic_decrement import damping_ratio

if TYPE_CHECKING:
    import pandas as pd

FEWEST_TURNING_POINTS = 3
AMPLITUDE_TREND = 0.3
"""Spread of the ratio of damping over the record, relative, above which damping is said to depend on amplitude."""


def logarithmic_decrement_of(zeta: np.ndarray | float) -> np.ndarray | float:
    """``2 pi zeta / sqrt(1 - zeta^2)``: decrement of a full cycle of a linear decay below critical damping."""
    return 2.0 * math.pi * zeta / np.sqrt(1.0 - np.square(zeta))


def step_response_peak(zeta: float) -> float:
    """Largest response to a suddenly applied constant force over the static one: 2 without damping.

    ``1 + exp(-pi zeta / sqrt(1 - zeta^2))``: a check of the simulator that the ratio is used in.
    """
    if not 0.0 <= zeta < 1.0:
        raise FitError(
            f"the damping ratio {zeta:g} is not between 0 and 1", cure="a motion beyond does not oscillate"
        )
    return 1.0 + math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2))


@dataclass(frozen=True, eq=False)
class DecayRatio:
    """Damping ratio and natural frequency of one motion.

    Attributes
    ----------
    motion : str
    amplitude : ndarray, shape (m,)
        Mean amplitude of each full cycle, rad or m, from both sides in turn.
    zeta_of_cycle : ndarray, shape (m,)
        Exact ratio of each.
    zeta, zeta_sd : float
        Exact ratio of the whole record, weighted by amplitude squared, and its standard error from the cycles.
    zeta_light : float
        The same in the light-damping form of the paper.
    omega_d, omega_n : float
        Damped and natural circular frequency, rad/s.
    omega_n_sd : float
        Standard error from the scatter of the periods.
    scale : float
        Scale of the record; :meth:`at_scale` converts.
    findings : tuple of Finding
    """

    motion: str
    amplitude: np.ndarray
    zeta_of_cycle: np.ndarray
    zeta: float
    zeta_sd: float
    zeta_light: float
    omega_d: float
    omega_n: float
    omega_n_sd: float
    scale: float
    findings: tuple[Finding, ...]

    def at_scale(self, scale: float) -> DecayRatio:
        """The ratio at another scale by Froude's law; the ratio of damping stays.

        Raises
        ------
        FitError
            If the scale is not positive.
        """
        from dataclasses import replace

        if not scale > 0.0:
            raise FitError(f"the scale {scale} is not positive", cure="give 1 for full scale")
        rate = math.sqrt(scale / self.scale)
        length = self.scale / scale if self.motion == "heave" else 1.0
        return replace(
            self,
            amplitude=self.amplitude * length,
            omega_d=self.omega_d * rate,
            omega_n=self.omega_n * rate,
            omega_n_sd=self.omega_n_sd * rate,
            scale=scale,
        )

    def to_frame(self) -> pd.DataFrame:
        """One row a cycle: amplitude (rad or m), zeta exact and light."""
        import pandas as pd

        decrement = logarithmic_decrement_of(self.zeta_of_cycle)
        columns = {
            "amplitude": self.amplitude,
            "zeta": self.zeta_of_cycle,
            "zeta_light": damping_ratio(decrement, "light"),
        }
        return pd.DataFrame(columns)


def decay_ratio(record: DecayRecord) -> DecayRatio:
    """Damping ratio and natural frequency of a free decay in heave, roll or pitch.

    Parameters
    ----------
    record : DecayRecord
        Its free part. Maxima and minima are read separately, each against the next of its kind, about the rest position
        from which three turning points in a row lie in one ratio.

    Raises
    ------
    FitError
        With fewer than two turning points of a kind, or peaks on one side of the rest position.
    """
    points = find_extremes(record.time, record.value, frequency=_rough_frequency(record))
    if points.value.size < FEWEST_TURNING_POINTS:
        raise FitError(
            f"{points.value.size} turning points hold no full cycle",
            cure="take a longer record",
            file=record.source or None,
            place=record.name,
        )
    cycles = [
        (t, r, math.log(r[0] / r[1]))
        for t, r in _cycles(points.time, points.value - _rest_position(points.value))
        if r[1] > 3.0 * points.noise and r[0] > r[1]
    ]
    if not cycles:
        raise FitError(
            "no peak is followed by a smaller one of its side above the noise",
            cure="cut the record to its free part, or take a longer one",
            file=record.source or None,
            place=record.name,
        )
    amplitude = np.array([0.5 * (r[0] + r[1]) for _, r, _ in cycles])
    decrement = np.array([d for _, _, d in cycles])
    # A peak is read to a fixed error, so that its logarithm is worth the square of its height.
    weight = amplitude**2 / np.sum(amplitude**2)
    mean = float(weight @ decrement)
    spread = float(weight @ (decrement - mean) ** 2)
    effective = 1.0 / float(weight @ weight)
    error = math.sqrt(spread / max(effective - 1.0, 1.0)) if decrement.size > 1 else math.nan
    zeta = float(damping_ratio(mean))
    periods = np.array([t[1] - t[0] for t, _, _ in cycles])
    damped = 2.0 * math.pi / float(periods.mean())
    natural = damped / math.sqrt(1.0 - zeta**2)
    scatter = float(periods.std(ddof=1)) / math.sqrt(periods.size) if periods.size > 1 else math.nan
    of_cycle = damping_ratio(decrement)
    return DecayRatio(
        motion=record.motion,
        amplitude=amplitude,
        zeta_of_cycle=of_cycle,
        zeta=zeta,
        # d zeta / d delta is nearly 1/(2 pi) for every damping that oscillates.
        zeta_sd=error * zeta / mean if mean > 0.0 else math.nan,
        zeta_light=float(damping_ratio(mean, "light")),
        omega_d=damped,
        omega_n=natural,
        omega_n_sd=natural * scatter * damped / (2.0 * math.pi),
        scale=record.scale,
        findings=tuple(_doubts(amplitude, of_cycle, zeta)),
    )


def _rough_frequency(record: DecayRecord) -> float:
    """Frequency in Hz from the first swings to the other side: of a heavily damped motion the spectrum tells little."""
    x = record.value - np.median(record.value[-max(record.value.size // 4, 1) :])
    side = np.sign(x) * (np.abs(x) > 0.1 * np.abs(x).max())
    told = np.flatnonzero(side)
    turns = record.time[told[1:][side[told[1:]] != side[told[:-1]]]]
    if turns.size < 2:
        raise FitError(
            "the record does not swing to both sides of its rest position",
            cure="the motion is damped above critical, or the record is cut too short",
            file=record.source or None,
            place=record.name,
        )
    return 0.5 / float(np.diff(turns[:4]).mean())


def _rest_position(value: np.ndarray) -> float:
    """Position m about which turning points alternate in one ratio: (e1 - m)(e3 - m) = (e2 - m)^2."""
    e1, e2, e3 = value[:-2], value[1:-1], value[2:]
    width = e1 + e3 - 2.0 * e2
    return float(np.sum((e1 * e3 - e2**2) * width) / np.sum(width**2))


def _cycles(time: np.ndarray, value: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Times and heights of each peak and the next of its side, in order of time."""
    for i in range(time.size - 2):
        pair = value[[i, i + 2]]
        if pair[0] * pair[1] > 0.0:
            yield time[[i, i + 2]], np.abs(pair)


def _doubts(amplitude: np.ndarray, zeta: np.ndarray, mean: float) -> Iterator[Finding]:
    if zeta.size >= 4:
        line = np.polynomial.Polynomial.fit(amplitude, zeta, 1)
        change = abs(float(line(amplitude.max()) - line(amplitude.min())))
        if change > AMPLITUDE_TREND * mean:
            yield Finding(
                "damping-depends-on-amplitude",
                "warning",
                f"zeta changes by {change / mean:.0%} from {amplitude.min():.3g} to {amplitude.max():.3g}: one ratio "
                "stands for one amplitude",
                cure="use a model with quadratic damping, or give the simulator the ratio of the amplitude it meets",
            )
    if mean > 0.2:
        yield Finding(
            "damping-heavy",
            "info",
            f"zeta = {mean:.3g}: the light-damping form would be "
            f"{100.0 * (1.0 / math.sqrt(1.0 - mean**2) - 1.0):.1f} % too high",
        )


def heave_frequency(ship: Ship, waterplane_area: float, added_mass: float) -> float:
    """``sqrt(rho g Awp / (m + added mass))`` in rad/s.

    Parameters
    ----------
    ship : Ship
        With its mass or volume.
    waterplane_area : float
        m2.
    added_mass : float
        ``-Zwdot`` in kg, positive.
    """
    return _frequency(ship.rho * GRAVITY * waterplane_area, _mass(ship) + added_mass)


def pitch_frequency(ship: Ship, longitudinal_metacentric_height: float, inertia: float) -> float:
    """``sqrt(m g GML / (Iyy + added inertia))`` in rad/s, with the `inertia` (kg m2) of both parts."""
    return _frequency(_mass(ship) * GRAVITY * longitudinal_metacentric_height, inertia)


def roll_frequency(ship: Ship, inertia: float) -> float:
    """``sqrt(m g GM / (Ixx + added inertia))`` in rad/s, with the `inertia` (kg m2) of both parts.

    Raises
    ------
    FitError
        When the ship has no GM.
    """
    if ship.GM is None:
        raise FitError(f"'{ship.name}' has no GM", cure="give the ship's GM")
    return _frequency(_mass(ship) * GRAVITY * ship.GM, inertia)


def _mass(ship: Ship) -> float:
    if ship.displacement_mass is None:
        raise FitError(f"'{ship.name}' has no volume", cure="give the ship's volume or mass")
    return ship.displacement_mass


def _frequency(restoring: float, inertia: float) -> float:
    if not (restoring > 0.0 and inertia > 0.0):
        raise FitError(
            f"restoring {restoring:.4g} and inertia {inertia:.4g} give no oscillation",
            cure="both are positive, SI",
        )
    return math.sqrt(restoring / inertia)
