"""Roll damping of a hull by Ikeda's components in the simplified form of Kawahara, Maekawa and Ikeda (2009).

Friction, wave making, eddies, bilge keels, and with speed the lift, each as regressions on a few particulars.
Home form is non-dimensional: ``B_hat = B44 / (rho volume B^2) sqrt(B / 2g)``. B44 is the equivalent linear
damping coefficient of ``(Ixx + A44) phi'' + B44 phi' + C44 phi = 0`` at a roll amplitude.

The regressions hold within the limits of :data:`LIMITS`; outside of them nothing protects their high powers,
the wave part least, so every particular that is outside is a finding of the result.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import polynomial

from ..core.errors import TowtankError
from ..core.findings import Finding
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .ikeda_wave import wave_coefficient

if TYPE_CHECKING:
    import pandas as pd

LIMITS: dict[str, tuple[float, float]] = {
    "CB": (0.5, 0.85),
    "B/d": (2.5, 4.5),
    "OG/d": (-1.5, 0.2),
    "CM": (0.9, 0.99),
    "bBK/B": (0.01, 0.06),
    "lBK/L": (0.05, 0.4),
    "omega_hat": (0.0, 1.0),
}
"""Ranges of the regressions; OG is positive downward from the waterline, omega_hat = omega sqrt(B/2g)."""

COMPONENTS = ("friction", "wave", "eddy", "bilge_keel", "lift")

_FRESH_WATER_VISCOSITY = 1.14e-6


@dataclass(frozen=True)
class IkedaHull:
    """Particulars that the regressions ask for.

    Attributes
    ----------
    L, B, d : float
        Length, breadth, draught in m.
    CB, CM : float
        Block and midship section coefficients.
    OG : float
        Depth of the centre of gravity below the waterline in m (draught minus KG); negative above it.
    keel_breadth, keel_length : float
        Breadth and length of the bilge keels in m; 0 without.
    gravity : float
        Acceleration of gravity in m/s2; the published program takes 9.81.
    """

    L: float
    B: float
    d: float
    CB: float
    CM: float
    OG: float
    keel_breadth: float = 0.0
    keel_length: float = 0.0
    gravity: float = GRAVITY

    def __post_init__(self) -> None:
        for name in ("L", "B", "d", "CB", "CM"):
            if not getattr(self, name) > 0.0:
                raise TowtankError(f"Ikeda: {name} = {getattr(self, name)} is not positive", cure="give it in m")
        for name in ("CB", "CM"):
            if getattr(self, name) > 1.0:
                raise TowtankError(f"Ikeda: {name} = {getattr(self, name)} is more than 1")
        if self.keel_breadth < 0.0 or self.keel_length < 0.0:
            raise TowtankError("Ikeda: a bilge keel has a negative size", cure="give 0 for a hull without")
        if (self.keel_breadth > 0.0) != (self.keel_length > 0.0):
            raise TowtankError("Ikeda: a bilge keel needs breadth and length", cure="give both, or neither")

    @classmethod
    def of_ship(
        cls, ship: Ship, midship_coefficient: float, *, keel_breadth: float = 0.0, keel_length: float = 0.0
    ) -> IkedaHull:
        """Particulars of a ship.

        Raises
        ------
        TowtankError
            When the ship has no volume or KG.
        """
        if ship.block_coefficient is None or ship.KG is None:
            missing = "volume" if ship.block_coefficient is None else "KG"
            raise TowtankError(f"ship '{ship.name}': {missing} is missing", cure="the Ikeda components need it")
        return cls(
            L=ship.L,
            B=ship.B,
            d=ship.T,
            CB=ship.block_coefficient,
            CM=midship_coefficient,
            OG=ship.T - ship.KG,
            keel_breadth=keel_breadth,
            keel_length=keel_length,
        )

    @property
    def volume(self) -> float:
        """Displaced volume ``CB L B d`` in m3."""
        return self.CB * self.L * self.B * self.d

    @property
    def frequency_unit(self) -> float:
        """``sqrt(2g/B)`` in rad/s: omega over omega_hat."""
        return math.sqrt(2.0 * self.gravity / self.B)

    def damping_unit(self, rho: float = 1025.0) -> float:
        """``rho volume B^2 sqrt(2g/B)`` in N m s/rad: B44 over its non-dimensional form."""
        return rho * self.volume * self.B**2 * self.frequency_unit


@dataclass(frozen=True, eq=False)
class IkedaDamping:
    """Equivalent linear roll damping by component.

    Attributes
    ----------
    hull : IkedaHull
    amplitude : ndarray, shape (n,)
        Roll amplitude in rad.
    frequency : ndarray, shape (n,)
        Roll frequency in rad/s.
    speed : float
        Ship speed in m/s.
    friction, wave, eddy, bilge_keel, lift : ndarray, shape (n,)
        Non-dimensional components.
    findings : tuple of Finding
        Particulars and frequencies outside the limits of the regressions.
    """

    hull: IkedaHull
    amplitude: np.ndarray
    frequency: np.ndarray
    speed: float
    friction: np.ndarray
    wave: np.ndarray
    eddy: np.ndarray
    bilge_keel: np.ndarray
    lift: np.ndarray
    findings: tuple[Finding, ...]

    @property
    def total(self) -> np.ndarray:
        """Sum of the components, non-dimensional, shape (n,)."""
        return self.friction + self.wave + self.eddy + self.bilge_keel + self.lift

    @property
    def within_limits(self) -> bool:
        """True when every particular and frequency is inside the range of the regressions."""
        return not self.findings

    def dimensional(self, rho: float = 1025.0) -> np.ndarray:
        """B44 in N m s/rad, shape (n,), in water of density `rho` (kg/m3)."""
        return self.total * self.hull.damping_unit(rho)

    def extinction_rate(self, inertia: float, rho: float = 1025.0) -> np.ndarray:
        """``alpha_e = B44 / (2 inertia)`` in 1/s, shape (n,).

        Parameters
        ----------
        inertia : float
            Roll inertia with added inertia, kg m2.
        rho : float
            Water density in kg/m3.
        """
        return self.dimensional(rho) / (2.0 * inertia)

    def to_frame(self) -> pd.DataFrame:
        """One row an amplitude: amplitude_deg, frequency, the components and B44_hat."""
        import pandas as pd

        columns = {"amplitude_deg": np.degrees(self.amplitude), "frequency": self.frequency}
        return pd.DataFrame(
            {**columns, **{name: getattr(self, name) for name in COMPONENTS}, "B44_hat": self.total}
        )


def ikeda_damping(
    hull: IkedaHull,
    amplitude: np.ndarray | float,
    frequency: np.ndarray | float,
    *,
    speed: float = 0.0,
    viscosity: float = _FRESH_WATER_VISCOSITY,
) -> IkedaDamping:
    """Components of the equivalent linear roll damping.

    Parameters
    ----------
    hull : IkedaHull
    amplitude : array_like, shape (n,)
        Roll amplitude in rad; zero or positive.
    frequency : array_like, shape (n,)
        Roll frequency in rad/s; positive. Amplitude and frequency are broadcast.
    speed : float
        Ship speed in m/s.
    viscosity : float
        Kinematic viscosity in m2/s. The friction part is laminar (Kato): it belongs to a model.

    Returns
    -------
    IkedaDamping

    Raises
    ------
    TowtankError
        For an amplitude below zero, a frequency or viscosity that is not positive, a speed below zero.
    """
    angles, rates = np.broadcast_arrays(
        np.atleast_1d(np.asarray(amplitude, dtype=float)), np.atleast_1d(np.asarray(frequency, dtype=float))
    )
    if not (angles >= 0.0).all() or not (rates > 0.0).all():
        raise TowtankError(
            "Ikeda: a roll amplitude is negative, or a frequency not positive", cure="give rad and rad/s"
        )
    if not (speed >= 0.0 and viscosity > 0.0):
        raise TowtankError(f"Ikeda: speed {speed} m/s or viscosity {viscosity} m2/s is not usable")
    reduced = rates / hull.frequency_unit
    friction = _friction(hull, rates, viscosity) * (1.0 + 4.1 * speed / (rates * hull.L))
    wave = wave_coefficient(hull.B / hull.d, hull.CB, hull.CM, hull.OG / hull.d, reduced)
    eddy = _eddy(hull, angles, reduced)
    lift = np.zeros_like(reduced)
    if speed > 0.0:
        wave = wave * _wave_with_speed(rates**2 * hull.d / hull.gravity, rates * speed / hull.gravity)
        # Eddies are swept away: K is the reduced frequency omega L / V (Ikeda, Himeno and Tanaka 1978).
        swept = (0.04 * rates * hull.L / speed) ** 2
        eddy = eddy * swept / (1.0 + swept)
        lift = lift + _lift(hull, speed)
    return IkedaDamping(
        hull=hull,
        amplitude=angles,
        frequency=rates,
        speed=speed,
        friction=friction,
        wave=wave,
        eddy=eddy,
        bilge_keel=_bilge_keel(hull, angles, reduced),
        lift=lift,
        findings=tuple(_outside(hull, reduced)),
    )


def _outside(hull: IkedaHull, reduced: np.ndarray) -> Iterator[Finding]:
    values = {
        "CB": (hull.CB, hull.CB),
        "B/d": (hull.B / hull.d,) * 2,
        "OG/d": (hull.OG / hull.d,) * 2,
        "CM": (hull.CM, hull.CM),
        "omega_hat": (float(reduced.min()), float(reduced.max())),
    }
    if hull.keel_length > 0.0:
        values["bBK/B"] = (hull.keel_breadth / hull.B,) * 2
        values["lBK/L"] = (hull.keel_length / hull.L,) * 2
    for name, (lowest, highest) in values.items():
        low, high = LIMITS[name]
        if lowest < low or highest > high:
            seen = highest if highest > high else lowest
            yield Finding(
                "ikeda-limits",
                "warning",
                f"{name} = {seen:.4g} is outside the regressions' {low:g} to {high:g}",
                place=name,
                cure="do not trust the components; measure, or use the full method of Ikeda",
            )


def _polynomial(coefficients: tuple[float, ...], x: np.ndarray | float) -> np.ndarray:
    """Polynomial with the highest power first."""
    return np.asarray(polynomial.polyval(x, coefficients[::-1]))


def _friction(hull: IkedaHull, frequency: np.ndarray, viscosity: float) -> np.ndarray:
    """Kato's laminar friction; the roll amplitude cancels in it."""
    radius = (
        hull.d * ((0.887 + 0.145 * hull.CB) * (1.7 + hull.CB * hull.B / hull.d) - 2.0 * hull.OG / hull.d) / math.pi
    )
    surface = hull.L * (1.75 * hull.d + hull.CB * hull.B)
    period = 2.0 * math.pi / frequency
    # Cf phi_a, with Cf = 1.328 [3.22 rf^2 phi_a^2 / (T nu)]^(-1/2)
    drag = 1.328 / np.sqrt(3.22 * radius**2 / (period * viscosity))
    coefficient = 4.0 / (3.0 * math.pi) * surface * radius**3 * frequency * drag
    return coefficient / hull.damping_unit(1.0)


def _eddy(hull: IkedaHull, amplitude: np.ndarray, reduced: np.ndarray) -> np.ndarray:
    x1, block, og = hull.B / hull.d, hull.CB, hull.OG / hull.d
    size = (-0.0182 * block + 0.0155) * (x1 - 1.8) ** 3 + _polynomial(
        (-79.414, 215.695, -215.883, 93.894, -14.848), block
    )
    first = (
        (3.98 * block - 5.1525)
        * (-0.2 * x1 + 1.6)
        * og
        * ((0.9717 * block**2 - 1.55 * block + 0.723) * og + 0.04567 * block + 0.9408)
    )
    second = (0.25 * og + 0.95) * og + _polynomial((-219.2, 443.7, -283.3, 59.6), block)
    third = -15.0 * block * x1 + 46.5 * block + 11.2 * x1 - 28.6
    resistance = size * np.exp(first + second * hull.CM**third)
    return 4.0 * reduced * amplitude / (3.0 * math.pi * block * x1**3) * resistance


def _bilge_keel(hull: IkedaHull, amplitude: np.ndarray, reduced: np.ndarray) -> np.ndarray:
    x1, block, og = hull.B / hull.d, hull.CB, hull.OG / hull.d
    breadth, length, degrees = hull.keel_breadth / hull.B, hull.keel_length / hull.L, np.degrees(amplitude)
    f1 = (-0.3651 * block + 0.3907) * (x1 - 2.83) ** 2 - 2.21 * block + 2.632
    f2 = _polynomial((0.00255, 0.122, 0.4794), degrees)
    f3 = (-0.8913 * breadth**2 - 0.0733 * breadth) * length**2 + (
        5.2857 * breadth**2 - 0.01185 * breadth + 0.00189
    ) * length
    if hull.keel_length == 0.0:
        return np.zeros_like(reduced)
    k1 = (5.0 * breadth + 0.3 * x1 - 0.2 * length + 0.00125 * degrees**2 - 0.0425 * degrees - 1.86) * og
    k2 = -15.0 * breadth + 1.2 * block - 0.1 * x1 - 0.0657 * og**2 + 0.0586 * og + 1.6164
    k3 = 2.5 * og + 15.75
    return f1 * f2 * f3 * np.exp(k1 + k2 * hull.CM**k3) * reduced


def _wave_with_speed(draught_number: np.ndarray, speed_number: np.ndarray) -> np.ndarray:
    """Wave damping with speed over that without (Ikeda, Himeno and Tanaka 1978): 1 at zero speed.

    Parameters
    ----------
    draught_number : ndarray
        ``omega^2 d / g``.
    speed_number : ndarray
        ``omega V / g``.
    """
    decay = np.exp(-2.0 * draught_number)
    a1, a2 = 1.0 + draught_number**-1.2 * decay, 0.5 + decay / draught_number
    return 0.5 * (
        (a2 + 1.0)
        + (a2 - 1.0) * np.tanh(20.0 * (speed_number - 0.3))
        + (2.0 * a1 - a2 - 1.0) * np.exp(-150.0 * (speed_number - 0.25) ** 2)
    )


def _lift(hull: IkedaHull, speed: float) -> float:
    """Hull lift (Ikeda, Himeno and Tanaka 1978); a cubic of CM joins their steps 0, 0.1 and 0.3 of the factor."""
    arm, lever = 0.3 * hull.d, 0.5 * hull.d
    fullness = 106.0 * (hull.CM - 0.91) ** 2 - 700.0 * (hull.CM - 0.91) ** 3
    slope = 2.0 * math.pi * hull.d / hull.L + fullness * (4.1 * hull.B / hull.L - 0.045)
    shape = 1.0 - 1.4 * hull.OG / lever + 0.7 * hull.OG**2 / (arm * lever)
    return 0.5 * speed * hull.L * hull.d * slope * arm * lever * shape / hull.damping_unit(1.0)
