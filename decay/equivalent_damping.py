"""Equivalent linear damping against amplitude, and its dimensional, Bertin and ITTC forms."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .damping_models import TERMS, DampingModel
from .restoring_curve import RestoringCurve

if TYPE_CHECKING:
    import pandas as pd

#: Angles in degrees of the Bertin coefficients of IMO MSC.1/Circ.1200.
BERTIN_ANGLES = (10.0, 12.5, 15.0, 17.5, 20.0, 22.5, 25.0)
# Points of a quarter cycle at which the lever curve is averaged.
QUARTER_POINTS = 64


@dataclass(frozen=True, eq=False)
class EquivalentDamping:
    """Linear damping that takes the same energy out of a cycle.

    Attributes
    ----------
    amplitude : ndarray, shape (m,)
        Amplitudes in rad (roll, pitch) or m (heave).
    omega : ndarray, shape (m,)
        Circular frequency of the free motion at the amplitude in rad/s, by harmonic balance.
    alpha, alpha_sd : ndarray, shape (m,)
        Equivalent damping alpha_e in 1/s and its standard error: x'' + 2 alpha_e x' + omega^2 x = 0.
    alpha_lower, alpha_upper : ndarray, shape (m,)
        Limits of its t-interval.
    inside : ndarray of bool, shape (m,)
        Whether the record held this amplitude; elsewhere the value is an extrapolation of the model.
    level : float
        Confidence of the limits.
    motion : str
    """

    amplitude: np.ndarray
    omega: np.ndarray
    alpha: np.ndarray
    alpha_sd: np.ndarray
    alpha_lower: np.ndarray
    alpha_upper: np.ndarray
    inside: np.ndarray
    level: float
    motion: str

    @property
    def B(self) -> np.ndarray:
        """B_e = 2 alpha_e in 1/s: damping moment over inertia and velocity."""
        return 2.0 * self.alpha

    @property
    def B_lower(self) -> np.ndarray:
        """Lower limit of B_e in 1/s."""
        return 2.0 * self.alpha_lower

    @property
    def B_upper(self) -> np.ndarray:
        """Upper limit of B_e in 1/s."""
        return 2.0 * self.alpha_upper

    @property
    def zeta(self) -> np.ndarray:
        """alpha_e over the frequency at the amplitude: part of critical damping."""
        return self.alpha / self.omega

    @property
    def bertin(self) -> np.ndarray:
        """Bertin's N in 1/deg: loss of a half cycle over the square of the mean amplitude, both in degrees."""
        if self.motion == "heave":
            raise FitError("Bertin's coefficient belongs to angles", cure="use alpha or zeta of heave")
        degrees = np.degrees(self.amplitude)
        return np.pi * self.alpha / self.omega / degrees

    def bertin_frame(self) -> pd.DataFrame:
        """Bertin's N in 1/deg with its limits, one row an amplitude."""
        import pandas as pd

        degrees = np.degrees(self.amplitude)
        factor = self.bertin / self.alpha
        columns = {
            "angle [deg]": degrees,
            "N [1/deg]": self.bertin,
            "N lower [1/deg]": self.alpha_lower * factor,
            "N upper [1/deg]": self.alpha_upper * factor,
            "inside the record": self.inside,
        }
        return pd.DataFrame(columns)

    def dimensional_frame(self, inertia: float | np.ndarray, hat: float) -> pd.DataFrame:
        """B44 in N m s and B44-hat with their limits.

        Parameters
        ----------
        inertia : float or ndarray, shape (m,)
            In kg m2: one, or one an amplitude.
        hat : float
            Factor of the hat form.
        """
        frame = self.to_frame().iloc[:, :2].copy()
        for name, value in (("", self.B), (" lower", self.B_lower), (" upper", self.B_upper)):
            frame[f"B44{name} [N m s]"] = value * inertia
            frame[f"B44-hat{name} [-]"] = value * inertia * hat
        frame["inside the record"] = self.inside
        frame.attrs["inertia [kg m2]"] = inertia
        return frame

    def to_frame(self) -> pd.DataFrame:
        """One row an amplitude; units stand in the column names."""
        import pandas as pd

        unit = "m" if self.motion == "heave" else "deg"
        shown = self.amplitude if self.motion == "heave" else np.degrees(self.amplitude)
        percent = f"{100.0 * self.level:g}"
        columns = {
            f"amplitude [{unit}]": shown,
            "omega [rad/s]": self.omega,
            "alpha_e [1/s]": self.alpha,
            "alpha_e std [1/s]": self.alpha_sd,
            f"alpha_e lower{percent} [1/s]": self.alpha_lower,
            f"alpha_e upper{percent} [1/s]": self.alpha_upper,
            "B_e [1/s]": self.B,
            "zeta [-]": self.zeta,
            "inside the record": self.inside,
        }
        if self.motion != "heave":
            columns["N [1/deg]"] = self.bertin
        return pd.DataFrame(columns)


def lever_describing_function(curve: RestoringCurve | None, amplitude: np.ndarray) -> np.ndarray:
    """First harmonic of g(A cos t) over A, shape (m,): 1 for the straight line."""
    if curve is None:
        return np.ones_like(amplitude)
    # Midpoints of a quarter cycle: the rule is spectrally accurate for a smooth odd curve.
    phase = (np.arange(QUARTER_POINTS) + 0.5) * (0.5 * np.pi / QUARTER_POINTS)
    cosine = np.cos(phase)
    levers = curve(amplitude[:, None] * cosine)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = 2.0 * (levers @ cosine) / QUARTER_POINTS / amplitude
    return np.where(amplitude > 0.0, ratio, 1.0)


def equivalent_linear(
    coefficients: np.ndarray, amplitude: np.ndarray, curve: RestoringCurve | None = None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Equivalent damping, frequency, and gradient of the damping by the coefficients.

    alpha_e = b1/2 + 4/(3 pi) omega A b2 + 3/8 omega^2 A^2 b3 and omega^2 = c1 k(A) + 3/4 c3 A^2 + 5/8 c5 A^4: equal
    loss of energy in a cycle of x = A cos(omega t), and harmonic balance (e.g. ITTC 7.5-02-07-04.5).

    Parameters
    ----------
    coefficients : ndarray, shape (6,)
        Of `TERMS`.
    amplitude : ndarray, shape (m,)
    curve : RestoringCurve, optional

    Returns
    -------
    alpha, omega : ndarray, shape (m,)
        nan where the restoring moment does not restore.
    gradient : ndarray, shape (m, 6)
    """
    b1, b2, b3, c1, c3, c5 = coefficients
    a = np.asarray(amplitude, dtype=float)
    share = lever_describing_function(curve, a)
    stiffness = np.column_stack([share, 0.75 * a**2, 0.625 * a**4])
    squared = stiffness @ np.array([c1, c3, c5])
    omega = np.sqrt(np.where(squared > 0.0, squared, np.nan))
    rate = omega * a
    alpha = 0.5 * b1 + 4.0 / (3.0 * math.pi) * rate * b2 + 0.375 * rate**2 * b3
    by_omega = 4.0 / (3.0 * math.pi) * a * b2 + 0.75 * rate * a * b3
    gradient = np.empty((a.size, len(TERMS)))
    gradient[:, 0] = 0.5
    gradient[:, 1] = 4.0 / (3.0 * math.pi) * rate
    gradient[:, 2] = 0.375 * rate**2
    gradient[:, 3:] = (by_omega / (2.0 * omega))[:, None] * stiffness
    return alpha, omega, gradient


def extinction_from_damping(b1: float, b2: float, b3: float, omega: float) -> np.ndarray:
    """Extinction coefficients a, b, c of angles in rad, shape (3,), to first order in the damping.

    Loss of a half cycle = a m + b m^2 + c m^3 of the mean amplitude m: a = pi b1/(2 omega), b = 4/3 b2,
    c = 3 pi/8 omega b3.
    """
    return np.array(
        [0.5 * math.pi * b1 / omega, 4.0 / 3.0 * b2, 0.375 * math.pi * omega * b3],
    )


def extinction_gradient(model: DampingModel, omega: float, b3: float, b1: float) -> np.ndarray:
    """Gradient of a, b, c by the coefficients of `TERMS`, shape (3, 6); omega = sqrt(c1)."""
    gradient = np.zeros((3, len(TERMS)))
    gradient[0, 0] = 0.5 * math.pi / omega
    gradient[1, 1] = 4.0 / 3.0
    gradient[2, 2] = 0.375 * math.pi * omega
    by_c1 = 0.5 / omega
    gradient[0, 3] = -0.5 * math.pi * b1 / omega**2 * by_c1
    gradient[2, 3] = 0.375 * math.pi * b3 * by_c1
    return gradient @ model.spread()


def total_inertia(ship: Ship, omega: float, inertia: float | None = None) -> float:
    """Inertia of roll with its added part in kg m2: given, or rho g volume GM / omega_n^2.

    Raises
    ------
    FitError
        If neither the inertia nor volume and GM are known.
    """
    if inertia is not None:
        if not inertia > 0.0:
            raise FitError(f"the inertia {inertia:g} is not positive", cure="give it in kg m2 with its added part")
        return inertia
    mass = ship.displacement_mass
    if mass is None or ship.GM is None:
        raise FitError(
            f"'{ship.name}' has no {'GM' if mass is not None else 'volume'}, so that its roll inertia is not known",
            cure="give the ship's volume and GM, or inertia = (Ixx + A44) in kg m2",
        )
    return mass * GRAVITY * ship.GM / omega**2


def nondimensional_factor(ship: Ship) -> float:
    """B44-hat over B44 in SI: sqrt(B/2g)/(rho volume B^2), the form of ITTC 7.5-02-07-04.5 and of Ikeda."""
    mass = ship.displacement_mass
    if mass is None:
        raise FitError(f"'{ship.name}' has no volume", cure="give the ship's volume or mass")
    return math.sqrt(ship.B / (2.0 * GRAVITY)) / (mass * ship.B**2)
