"""Damping of a decay with radiation memory: viscous terms beside the waves, and the equivalent damping of both."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError
from ..core.ship import Ship
from .damping_models import MOTION_UNITS, DampingModel, term_unit
from .equivalent_damping import lever_describing_function, nondimensional_factor
from .roll_damping import RollDamping
from .transfer_function import TransferFunction

if TYPE_CHECKING:
    import pandas as pd

INERTIA = "inertia"
INERTIA_UNITS = {"roll": "kg m2", "pitch": "kg m2", "heave": "kg"}

_PASSES = 60
_STEP = 1e-6


@dataclass(frozen=True, eq=False)
class MemoryDamping(RollDamping):
    """Viscous damping beside radiation memory.

    The terms of the model are per unit of ``inertia`` (I + A_inf), which stands behind them among the names; a known
    value has zero variance. `equivalent`, `omega_n` and `zeta` are those of the whole motion, waves included.
    Beside the attributes of a :class:`~towtank.decay.roll_damping.RollDamping`:

    Attributes
    ----------
    memory : TransferFunction
        K of the motion at the scale of the records, SI.
    """

    memory: TransferFunction

    @property
    def inertia(self) -> float:
        """I + A_inf in kg m2 (heave: kg)."""
        return self[INERTIA]

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each coefficient."""
        terms = {name: term_unit(name, self.motion) for name in self.model.names}
        return terms | {INERTIA: INERTIA_UNITS[self.motion]}

    def coefficients(self, speed: float = 0.0) -> np.ndarray:
        """b1, b2, b3, c1, c3, c5 per unit of inertia at a forward speed in m/s, shape (6,)."""
        return self.model.spread(speed) @ self.params[:-1]

    @property
    def omega_n(self) -> float:
        """Natural circular frequency in rad/s with the added mass of that frequency, at vanishing amplitude."""
        return float(_harmonic_balance(self.params, self.model, self.memory, np.zeros(1), 0.0)[1][0])

    @property
    def zeta(self) -> float:
        """Damping ratio of waves and b1 at vanishing amplitude and zero speed."""
        alpha, omega, _ = _harmonic_balance(self.params, self.model, self.memory, np.zeros(1), 0.0)
        return float(alpha[0] / omega[0])

    def radiation_share(self, amplitude: np.ndarray | Sequence[float] | float, speed: float = 0.0) -> np.ndarray:
        """Share of the equivalent damping that is due to waves, shape (m,), at amplitudes in rad or m."""
        a = np.atleast_1d(np.asarray(amplitude, dtype=float))
        return _harmonic_balance(self.params, self.model, self.memory, a, speed)[2]

    def effective_inertia(self, omega: np.ndarray) -> np.ndarray:
        """I + A(omega) in kg m2 (heave: kg) at frequencies in rad/s."""
        return self.inertia * effective_inertia(self.memory, omega, self.inertia)

    def dimensional_terms(self) -> dict[str, tuple[float, float]]:
        """Terms times inertia, in SI, with their standard errors (B1 in N m s for b1, C44 for c1)."""
        found = {}
        for place, name in enumerate(self.model.names):
            gradient = np.zeros(len(self.names))
            gradient[place], gradient[-1] = self.inertia, self.params[place]
            variance = float(gradient @ self.cov @ gradient)
            found[name] = (float(self.params[place]) * self.inertia, math.sqrt(max(variance, 0.0)))
        return found

    def dimensional(
        self,
        amplitude: np.ndarray | Sequence[float] | float | None = None,
        *,
        ship: Ship | None = None,
        inertia: float | None = None,
        speed: float = 0.0,
    ) -> pd.DataFrame:
        """Equivalent B44 in N m s and B44-hat with the band, by the inertia I + A(omega) of this fit.

        Parameters as in :meth:`RollDamping.dimensional`; an `inertia` that is given takes its place.

        Raises
        ------
        FitError
            For another motion than roll, or an unknown ship.
        """
        hull = self.ship if ship is None else ship
        if self.motion != "roll" or hull is None:
            raise FitError("B44-hat needs a roll decay and its ship", cure="give ship = Ship(...)")
        at = self.equivalent(amplitude, speed=speed)
        total = self.effective_inertia(at.omega) if inertia is None else np.full_like(at.omega, inertia)
        return at.dimensional_frame(total, nondimensional_factor(hull))

    def extinction(self, *, degrees: bool = False) -> pd.DataFrame:
        """Not given: a, b, c belong to damping without memory.

        Raises
        ------
        FitError
            Always.
        """
        raise FitError("a motion with memory has no extinction coefficients", cure="use equivalent()")

    def at_scale(self, scale: float) -> RollDamping:
        """Not given: the table of radiation is brought to the scale of the records instead.

        Raises
        ------
        FitError
            Always.
        """
        raise FitError(
            "damping with memory is not scaled",
            cure="bring records and table of radiation to that scale, then fit",
        )

    def in_degrees(self) -> pd.DataFrame:
        """Not given: the inertia has no angle; see `dimensional_terms`.

        Raises
        ------
        FitError
            Always.
        """
        raise FitError("damping with memory is given in rad", cure="use table() or dimensional_terms()")

    def to_dict(self) -> dict[str, Any]:
        """Coefficients, covariance, memory, diagnostics and provenance for JSON, without the series."""
        return super().to_dict() | {
            "memory": {
                "order": self.memory.order,
                "numerator": self.memory.numerator.tolist(),
                "denominator": self.memory.denominator.tolist(),
            },
            "coordinate": MOTION_UNITS[self.motion],
        }

    def _equivalent_linear(self, amplitude: np.ndarray, speed: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        alpha, omega, _ = _harmonic_balance(self.params, self.model, self.memory, amplitude, speed)
        gradient = np.empty((amplitude.size, len(self.names)))
        for place, value in enumerate(self.params):
            step = _STEP * max(abs(value), 1e-9)
            moved = self.params.copy()
            moved[place] += step
            other = _harmonic_balance(moved, self.model, self.memory, amplitude, speed)[0]
            gradient[:, place] = (other - alpha) / step
        return alpha, omega, gradient


def effective_inertia(memory: TransferFunction, omega: np.ndarray, inertia: float) -> np.ndarray:
    """I + A(omega) over I + A_inf at frequencies in rad/s."""
    return np.maximum(1.0 + memory.added_mass_difference(omega) / inertia, 1e-6)


def _harmonic_balance(
    params: np.ndarray, model: DampingModel, memory: TransferFunction, amplitude: np.ndarray, speed: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Equivalent damping (1/s), frequency (rad/s) and share of the waves at the amplitudes."""
    b1, b2, b3, c1, c3, c5 = model.spread(speed) @ params[:-1]
    inertia = float(params[-1])
    spring = c1 * lever_describing_function(model.curve, amplitude)
    spring = np.maximum(spring + 0.75 * c3 * amplitude**2 + 0.625 * c5 * amplitude**4, 1e-300)
    omega = np.sqrt(spring)
    for _ in range(_PASSES):
        omega = np.sqrt(spring / effective_inertia(memory, omega, inertia))
    rate = omega * amplitude
    viscous = b1 + 8.0 / (3.0 * math.pi) * rate * b2 + 0.75 * rate**2 * b3
    waves = memory.damping(omega) / inertia
    total = viscous + waves
    share = np.divide(waves, total, out=np.zeros_like(total), where=total != 0.0)
    return 0.5 * total / effective_inertia(memory, omega, inertia), omega, share
