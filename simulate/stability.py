"""Course stability on a straight line with the rudder held: criterion, levers, roots, with their uncertainty.

A ship that is disturbed settles on a new straight course when both roots of its linear sway and yaw equations
have negative real parts, which is so when the criterion C is positive: the damping lever lies ahead of the sway
lever.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError
from .linear_motion import LinearMotion, linear_motion

if TYPE_CHECKING:
    import pandas as pd

Number = TypeVar("Number", float, np.ndarray)

_DAMPING = ("Yv", "Yr", "Nv", "Nr")
_INERTIA = ("Yvdot", "Yrdot", "Nvdot", "Nrdot")


def criterion_mmg(Yv: Number, Yr: Number, Nv: Number, Nr: Number, m: Number, mx: Number, xG: Number) -> Number:
    """Criterion of an MMG set, ``C = Yv (Nr - m xG) - Nv (Yr - m - mx)``.

    Parameters
    ----------
    Yv, Yr, Nv, Nr : float or ndarray
        With inertia and added-mass Coriolis terms outside, in one non-dimensional system.
    m, mx, xG : float or ndarray
        Mass, added mass in surge, centre of gravity forward of midship, in the same system.

    Returns
    -------
    float or ndarray
        Positive for a ship that is stable on a straight course.
    """
    return Yv * (Nr - m * xG) - Nv * (Yr - m - mx)


def criterion_abkowitz(Yv: Number, Yr: Number, Nv: Number, Nr: Number, m: Number, xG: Number) -> Number:
    """Criterion of an Abkowitz set, ``C = Yv (Nr - m xG) - Nv (Yr - m)``.

    Parameters
    ----------
    Yv, Yr, Nv, Nr : float or ndarray
        With the ship's inertia outside and the added-mass terms inside, as planar-motion tests find them.
    m, xG : float or ndarray

    Returns
    -------
    float or ndarray
    """
    return Yv * (Nr - m * xG) - Nv * (Yr - m)


@dataclass(frozen=True, eq=False)
class StraightLineStability:
    """Course stability of a set; standard uncertainties are to first order, NaN when the set has none.

    Attributes
    ----------
    name : str
    criterion, criterion_sd : float
        C over the squares of ``0.5 rho L T U^2`` and ``0.5 rho L^2 T U^2`` as in MMG.
    sway_lever, sway_lever_sd : float
        ``Nv/Yv``: where the force of a drift angle acts, in L forward of midship.
    damping_lever, damping_lever_sd : float
        ``(Nr - m' xG')/(Yr - m' - mx')``: where that of a turn acts.
    roots : ndarray, shape (2,), complex
        Of the motion, in U/L, the least damped first; NaN when the inertia is not known.
    roots_sd : ndarray, shape (2,)
        Of their real parts; NaN where two roots meet and the first order says nothing.
    probability : float
        That the ship is stable, from C and its standard uncertainty.
    without_inertia : str
        Why there are no roots.
    """

    name: str
    criterion: float
    criterion_sd: float
    sway_lever: float
    sway_lever_sd: float
    damping_lever: float
    damping_lever_sd: float
    roots: np.ndarray
    roots_sd: np.ndarray
    probability: float
    without_inertia: str = ""

    @property
    def stable(self) -> bool:
        """True when C is positive."""
        return self.criterion > 0.0

    @property
    def margin(self) -> float:
        """Damping lever less sway lever, in L: positive for a stable ship."""
        return self.damping_lever - self.sway_lever

    def to_frame(self) -> pd.DataFrame:
        """Table with the columns quantity, value, sd, unit."""
        import pandas as pd

        rows = [
            ("criterion C", self.criterion, self.criterion_sd, "-"),
            ("sway lever", self.sway_lever, self.sway_lever_sd, "L"),
            ("damping lever", self.damping_lever, self.damping_lever_sd, "L"),
        ]
        for number, (root, sd) in enumerate(zip(self.roots, self.roots_sd, strict=True), start=1):
            rows.append((f"root {number}, real part", root.real, sd, "U/L"))
            if root.imag:
                rows.append((f"root {number}, imaginary part", root.imag, math.nan, "U/L"))
        rows.append(("probability of stability", self.probability, math.nan, "-"))
        return pd.DataFrame(rows, columns=["quantity", "value", "sd", "unit"])


def straight_line_stability(motion: DerivativeSet | LinearMotion) -> StraightLineStability:
    """Criterion, levers and roots of a set in any conventions.

    Parameters
    ----------
    motion : DerivativeSet or LinearMotion

    Raises
    ------
    ConventionError
        When a linear derivative, the ship's mass or Xudot is missing where it is needed. A missing yaw inertia or
        added mass leaves the roots unknown and says why.
    """
    if isinstance(motion, DerivativeSet):
        motion = linear_motion(motion)
    (yv, yr), (nv, nr) = motion.damping
    if yv == 0.0 or yr == 0.0:
        raise ConventionError(f"'{motion.derivatives.name}' has Yv = {yv:g} and Yr - m' = {yr:g}: no levers")
    criterion = yv * nr - nv * yr
    covariance = motion.covariance(_DAMPING)
    criterion_sd = _sd(np.array([nr, -nv, -yr, yv]), covariance)
    known = not motion.without_inertia
    unknown = np.full(2, math.nan)
    roots, roots_sd = straight_line_roots(motion) if known else (unknown.astype(complex), unknown)
    return StraightLineStability(
        name=motion.derivatives.name,
        criterion=criterion,
        criterion_sd=criterion_sd,
        sway_lever=nv / yv,
        sway_lever_sd=_sd(np.array([-nv / yv**2, 0.0, 1.0 / yv, 0.0]), covariance),
        damping_lever=nr / yr,
        damping_lever_sd=_sd(np.array([0.0, -nr / yr**2, 0.0, 1.0 / yr]), covariance),
        roots=roots,
        roots_sd=roots_sd,
        probability=_above_zero(criterion, criterion_sd),
        without_inertia=motion.without_inertia,
    )


def straight_line_roots(motion: LinearMotion) -> tuple[np.ndarray, np.ndarray]:
    """Roots of ``det(lambda M - D) = 0`` and the standard uncertainty of their real parts.

    A root moves by ``w (dD - lambda dM) x / (w M x)`` with its left and right eigenvectors w and x.

    Returns
    -------
    roots : ndarray, shape (2,), complex
        In U/L, the largest real part first.
    sd : ndarray, shape (2,)

    Raises
    ------
    ConventionError
        When the mass matrix is not known.
    """
    from scipy.linalg import eig

    mass, damping = motion.mass, motion.damping
    roots, left, right = eig(damping, mass, left=True, right=True)
    order = np.argsort(-roots.real, kind="stable")
    roots, left, right = roots[order], left[:, order], right[:, order]
    covariance = motion.covariance((*_DAMPING, *_INERTIA))
    sd = np.full(2, math.nan)
    if covariance is not None:
        for place, root in enumerate(roots):
            w, x = left[:, place].conj(), right[:, place]
            weight = w @ mass @ x
            # where two roots meet, the first order does not exist
            if abs(weight) > 1e-8 * np.abs(mass).max():
                by_damping = np.outer(w, x).ravel() / weight
                gradient = np.concatenate([by_damping, root * by_damping])
                sd[place] = _sd(gradient.real, covariance)
    return roots, sd


def _sd(gradient: np.ndarray, covariance: np.ndarray | None) -> float:
    if covariance is None:
        return math.nan
    return math.sqrt(max(float(gradient @ covariance @ gradient), 0.0))


def _above_zero(value: float, sd: float) -> float:
    """Probability that a normal number is positive; NaN when its spread is not known."""
    if math.isnan(sd):
        return math.nan
    if sd == 0.0:
        return 1.0 if value > 0 else 0.0
    return 0.5 * math.erfc(-value / sd / math.sqrt(2.0))
