"""RollDamping: coefficients of a free decay with covariance, and the equivalent damping that follows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..core.provenance import Provenance
from ..core.ship import Ship
from ..identify.coefficient_table import CoefficientTable
from .damping_models import MOTION_UNITS, DampingModel, term_powers, term_unit
from .equivalent_damping import (
    BERTIN_ANGLES,
    EquivalentDamping,
    equivalent_linear,
    extinction_from_damping,
    extinction_gradient,
    nondimensional_factor,
    total_inertia,
)
from .fit_diagnostics import FitDiagnostics, FittedRun

if TYPE_CHECKING:
    import pandas as pd

#: What every coefficient of this room means, for reports.
CONVENTIONS = (
    "x'' + b1 x' + b2 |x'|x' + b3 x'^3 + c1 x + c3 x^3 + c5 x^5 = 0, divided by the inertia with its added part; "
    "SI, angles in rad, time in s; 2 alpha = b1, beta = b2, gamma = b3"
)
# Amplitudes of the default table of equivalent damping.
TABLE_POINTS = 25


@dataclass(frozen=True, eq=False)
class RollDamping(CoefficientTable):
    """Damping of one motion (roll, and by the same equation heave or pitch) with its uncertainty.

    Beside the attributes of a :class:`~towtank.identify.coefficient_table.CoefficientTable` (names, params, cov, bse,
    conf_int, correlation, to_frame); fixed terms are among the names with zero variance.

    Attributes
    ----------
    method : str
        Name of the estimator.
    model : DampingModel
    motion : {"roll", "pitch", "heave"}
    scale : float
        Length of the ship over the length that the coefficients hold for; 1 for full scale.
    ship : Ship, optional
        At that scale.
    runs : tuple of FittedRun
    diagnostics : FitDiagnostics
    provenance : Provenance
    """

    method: str
    model: DampingModel
    motion: str
    scale: float
    ship: Ship | None
    runs: tuple[FittedRun, ...]
    diagnostics: FitDiagnostics
    provenance: Provenance

    @property
    def values(self) -> np.ndarray:
        """Coefficients in the order of `names`, shape (p,)."""
        return self.params

    @property
    def covariance(self) -> np.ndarray:
        """Covariance of the coefficients, shape (p, p)."""
        return self.cov

    @property
    def conventions(self) -> str:
        """Equation, units and signs that the coefficients belong to."""
        return CONVENTIONS

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each coefficient."""
        return {name: term_unit(name, self.motion) for name in self.names}

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What the user should know about the fit."""
        return self.diagnostics.findings

    @property
    def trusted(self) -> bool:
        """Whether the fit converged and no finding warns against it."""
        return self.diagnostics.converged and all(item.severity == "info" for item in self.findings)

    def coefficients(self, speed: float = 0.0) -> np.ndarray:
        """b1, b2, b3, c1, c3, c5 at a forward speed in m/s, shape (6,); zero where the model has no term."""
        return self.model.spread(speed) @ self.params

    @property
    def omega_n(self) -> float:
        """Natural circular frequency sqrt(c1) in rad/s, without damping, at vanishing amplitude and zero speed."""
        return float(np.sqrt(self.coefficients()[3]))

    @property
    def zeta(self) -> float:
        """Damping ratio b1/(2 omega_n) at vanishing amplitude and zero speed."""
        return float(self.coefficients()[0] / (2.0 * self.omega_n))

    @property
    def sd_of_omega_n(self) -> float:
        """Standard error of omega_n in rad/s."""
        return float(self.bse[self.position("c1")] / (2.0 * self.omega_n))

    @property
    def sd_of_zeta(self) -> float:
        """Standard error of zeta."""
        if "b1" not in self.names:
            return 0.0
        gradient = np.zeros(len(self.names))
        gradient[self.position("b1")] = 0.5 / self.omega_n
        gradient[self.position("c1")] = -0.5 * self.zeta / self.omega_n**2
        return float(np.sqrt(gradient @ self.cov @ gradient))

    @property
    def linear_quadratic_correlation(self) -> float:
        """Correlation of the two highest damping terms (b and c of the extinction curve for three terms).

        nan with fewer than two free damping terms. Near -1 in every decay: quote the equivalent damping.
        """
        free = [name for name in self.model.damping if name in self.model.free]
        if len(free) < 2:
            return float("nan")
        return float(self.correlation[self.position(free[-2]), self.position(free[-1])])

    def equivalent(
        self,
        amplitude: np.ndarray | Sequence[float] | float | None = None,
        *,
        speed: float = 0.0,
        level: float | None = None,
    ) -> EquivalentDamping:
        """Equivalent linear damping with its band.

        Parameters
        ----------
        amplitude : array_like, optional
            Amplitudes in rad or m; a grid over the amplitudes of the record when not given.
        speed : float
            Forward speed in m/s.
        level : float, optional
            Confidence; the fit's own when not given.
        """
        from scipy.special import stdtrit

        low, high = self.diagnostics.amplitudes
        a = (
            np.linspace(low, high, TABLE_POINTS)
            if amplitude is None
            else np.atleast_1d(np.asarray(amplitude, dtype=float))
        )
        if not (np.isfinite(a).all() and (a >= 0.0).all()):
            raise FitError("an amplitude is negative or not finite", cure="give amplitudes in rad (heave: m)")
        chosen = self.confidence if level is None else level
        if not 0.0 < chosen < 1.0:
            raise FitError(f"the confidence level {chosen} is not between 0 and 1", cure="use for example 0.95")
        alpha, omega, by_parameter = self._equivalent_linear(a, speed)
        variance = np.einsum("ij,jk,ik->i", by_parameter, self.cov, by_parameter)
        sd = np.sqrt(np.maximum(variance, 0.0))
        half = stdtrit(float(np.min(self.t_dof)), 0.5 + 0.5 * chosen) * sd
        inside = (a >= 0.999 * low) & (a <= 1.001 * high)
        return EquivalentDamping(a, omega, alpha, sd, alpha - half, alpha + half, inside, chosen, self.motion)

    def _equivalent_linear(self, amplitude: np.ndarray, speed: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Equivalent damping and frequency at amplitudes, and the gradient of the damping by all coefficients."""
        alpha, omega, gradient = equivalent_linear(self.coefficients(speed), amplitude, self.model.curve)
        return alpha, omega, gradient @ self.model.spread(speed)

    def extinction(self, *, degrees: bool = False) -> pd.DataFrame:
        """Coefficients a, b, c of the extinction curve that these terms give to first order, with standard errors.

        Parameters
        ----------
        degrees : bool
            For angles in degrees: b is multiplied by pi/180 and c by its square.
        """
        import pandas as pd

        b1, b2, b3 = self.coefficients()[:3]
        values = extinction_from_damping(b1, b2, b3, self.omega_n)
        gradient = extinction_gradient(self.model, self.omega_n, b3, b1)
        sd = np.sqrt(np.maximum(np.diagonal(gradient @ self.cov @ gradient.T), 0.0))
        unit = np.radians(1.0) if degrees else 1.0
        factor = np.array([1.0, unit, unit**2])
        angle = "deg" if degrees else MOTION_UNITS[self.motion]
        columns = {"value": values * factor, "std": sd * factor, "unit": ["-", f"1/{angle}", f"1/{angle}2"]}
        return pd.DataFrame(columns, index=pd.Index(["a", "b", "c"], name="name"))

    def bertin(self, degrees: Sequence[float] = BERTIN_ANGLES) -> pd.DataFrame:
        """Bertin's N in 1/deg at angles in degrees, as IMO MSC.1/Circ.1200 asks for them, with the band."""
        return self.equivalent(np.radians(degrees)).bertin_frame()

    def dimensional(
        self,
        amplitude: np.ndarray | Sequence[float] | float | None = None,
        *,
        ship: Ship | None = None,
        inertia: float | None = None,
        speed: float = 0.0,
    ) -> pd.DataFrame:
        """Equivalent damping B44 in N m s and its non-dimensional form B44-hat, with the band.

        B44 = 2 alpha_e (Ixx + A44) with Ixx + A44 = rho g volume GM / omega_n^2 unless given;
        B44-hat = B44/(rho volume B^2) sqrt(B/2g).

        Parameters
        ----------
        amplitude : array_like, optional
            Amplitudes in rad.
        ship : Ship, optional
            At the scale of these coefficients; the ship of the record when not given.
        inertia : float, optional
            Ixx + A44 in kg m2.
        speed : float
            Forward speed in m/s.

        Raises
        ------
        FitError
            For another motion than roll, an unknown ship or particular, or a ship at another scale.
        """
        if self.motion != "roll":
            raise FitError(f"B44 belongs to roll, not to {self.motion}", cure="multiply B_e by the inertia")
        hull = self.ship if ship is None else ship
        if hull is None:
            raise FitError("the dimensional damping needs the ship", cure="give ship = Ship(...)")
        if abs(hull.scale / self.scale - 1.0) > 1e-9:
            raise FitError(
                f"'{hull.name}' is given at scale {hull.scale:g}, the damping at {self.scale:g}",
                cure="use ship.at_scale(...) or damping.at_scale(...)",
            )
        total = total_inertia(hull, self.omega_n, inertia)
        return self.equivalent(amplitude, speed=speed).dimensional_frame(total, nondimensional_factor(hull))

    def in_degrees(self) -> pd.DataFrame:
        """Coefficients of the equation with angles in degrees: b2 is smaller by 57.3, b3 and c3 by its square."""
        import pandas as pd

        if self.motion == "heave":
            raise FitError("heave has no angle to express in degrees", cure="use to_frame()")
        factor = np.array([np.radians(1.0) ** -term_powers(name)[0] for name in self.names])
        units = [self.units[name].replace("rad", "deg") for name in self.names]
        return pd.DataFrame(
            {"value": self.params * factor, "std": self.bse * factor, "unit": units},
            index=pd.Index(self.names, name="name"),
        )

    def at_scale(self, scale: float) -> RollDamping:
        """The coefficients at another scale by Froude's law; viscous scale effects are not corrected.

        Parameters
        ----------
        scale : float
            New scale; 1 for full scale.
        """
        from .froude_damping import damping_at_scale

        return damping_at_scale(self, scale)

    def table(self) -> pd.DataFrame:
        """Rows ``method, model, name, value, std, lower95, upper95, unit``; the limits' level is the fit's own."""
        import pandas as pd

        limits = self.conf_int()
        percent = f"{100.0 * self.confidence:g}"
        columns = {
            "method": self.method,
            "model": self.model.label,
            "name": self.names,
            "value": self.params,
            "std": self.bse,
            f"lower{percent}": limits[:, 0],
            f"upper{percent}": limits[:, 1],
            "unit": [self.units[name] for name in self.names],
        }
        return pd.DataFrame(columns)

    def to_dict(self) -> dict[str, Any]:
        """Coefficients, covariance, diagnostics and provenance for JSON, without the series."""
        fit = self.diagnostics
        return {
            "method": self.method,
            "motion": self.motion,
            "model": self.model.label,
            "conventions": self.conventions,
            "scale": self.scale,
            "ship": None if self.ship is None else self.ship.to_dict(),
            "names": list(self.names),
            "values": self.params.tolist(),
            "covariance": self.cov.tolist(),
            "units": self.units,
            "dof": self.t_dof.tolist(),
            "confidence": self.confidence,
            "omega_n": self.omega_n,
            "zeta": self.zeta,
            "diagnostics": {
                "samples": fit.samples,
                "half_cycles": fit.half_cycles,
                "r2": fit.r2,
                "noise": fit.noise,
                "noise_time": fit.noise_time,
                "amplitudes": list(fit.amplitudes),
                "converged": fit.converged,
                "condition": fit.condition,
                "details": dict(fit.details),
            },
            "findings": [vars(item) for item in fit.findings],
            "provenance": self.provenance.to_dict(),
        }


def roll_damping(
    method: str,
    model: DampingModel,
    values: Mapping[str, float],
    covariance: np.ndarray,
    *,
    diagnostics: FitDiagnostics,
    dof: float = np.inf,
    motion: str = "roll",
    scale: float = 1.0,
    ship: Ship | None = None,
    runs: Sequence[FittedRun] = (),
    provenance: Provenance | None = None,
    confidence: float = 0.95,
) -> RollDamping:
    """RollDamping from the fitted terms; fixed terms of the model are put in with zero variance.

    Parameters
    ----------
    method : str
    model : DampingModel
    values : mapping of str to float
        The fitted terms, ``model.free``.
    covariance : ndarray, shape (q, q)
        Their covariance, in the order of ``model.free``.
    diagnostics : FitDiagnostics
    dof : float
        Degrees of freedom of the t-intervals.
    motion, scale, ship, runs, provenance, confidence
        As in :class:`RollDamping`.

    Raises
    ------
    FitError
        If a coefficient is missing, a value is not finite, or the restoring term is not positive.
    """
    everything = model.complete(values)
    spring = everything[model.names.index("c1")]
    if not np.isfinite(everything).all():
        raise FitError(f"the {method} fit gives values that are not finite", cure="check the record and the model")
    if not spring > 0.0:
        raise FitError(
            f"the {method} fit gives c1 = {spring:.4g}, which does not restore",
            cure="check that the record is a free decay about its rest position, and its window",
        )
    places = [model.names.index(name) for name in model.free]
    full = np.zeros((len(model.names), len(model.names)))
    full[np.ix_(places, places)] = covariance
    return RollDamping(
        names=model.names,
        params=everything,
        cov=full,
        t_dof=np.full(len(model.names), float(dof)),
        confidence=confidence,
        method=method,
        model=model,
        motion=motion,
        scale=scale,
        ship=ship,
        runs=tuple(runs),
        diagnostics=diagnostics,
        provenance=provenance or Provenance(),
    )
