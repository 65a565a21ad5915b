"""Numerical uncertainty of a value by every method side by side, and one default among them.

The default: with four grids or more Eca and Hoekstra's least squares; with three the factor of safety of Xing and
Stern (in ITTC 7.5-03-01-01) where they converge monotonically, the range of the data where they do not; with two the
index of Roache with the assumed order and the factor 3. An observed order below 0.5 makes a Richardson estimate
without bound: three grids then take the limited order of Oberkampf and Roy, 0.5, with the factor 3.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError
from .eca_hoekstra import LOWEST_ORDER, ManyGridUncertainty, eca_hoekstra
from .eca_hoekstra import METHOD as LEAST_SQUARES
from .grid_triplet import EQUAL, GridTriplet
from .refinement import finest_first
from .triplet_uncertainty import (
    UncertaintyEstimate,
    correction_factor,
    data_range,
    factor_of_safety,
    gci_celik,
    gci_oberkampf_roy,
    gci_roache,
    gci_two_grids,
)

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

UNCERTAINTY_COLUMNS = ("quantity", "method", "class", "order", "extrapolated", "uncertainty", "unit")
"""Columns of ``uncertainty.csv``."""

METHODS = (
    "GCI Celik",
    "GCI Roache",
    "GCI Oberkampf-Roy",
    "correction factor",
    "correction factor corrected",
    "factor of safety",
    LEAST_SQUARES,
    "data range",
)
"""Methods in the order of the table."""

DEFAULT = "default"
"""Name of the rule that picks one method, see the heading of this file."""


@dataclass(frozen=True, eq=False)
class NumericalUncertainty:
    """One quantity on two or more grids (or with two or more time steps).

    Attributes
    ----------
    quantity, unit : str
    values : ndarray, shape (n,)
        Finest grid first.
    spacings : ndarray, shape (n,)
        Over the finest one.
    estimates : tuple of UncertaintyEstimate
        One a method, in the order of :data:`METHODS`; methods that need three grids use the three finest.
    behaviour : str
        Class of convergence of all grids.
    least_squares : ManyGridUncertainty or None
        The fit through four grids or more.
    """

    quantity: str
    unit: str
    values: np.ndarray
    spacings: np.ndarray
    estimates: tuple[UncertaintyEstimate, ...]
    behaviour: str
    least_squares: ManyGridUncertainty | None = None

    def __getitem__(self, method: str) -> UncertaintyEstimate:
        if method == DEFAULT:
            return self.preferred
        for estimate in self.estimates:
            if estimate.method == method:
                return estimate
        raise TowtankError(f"there is no method '{method}'", cure=f"use one of {DEFAULT}, {', '.join(METHODS)}")

    @property
    def fine(self) -> float:
        """Value of the finest grid."""
        return float(self.values[0])

    @cached_property
    def triplet(self) -> GridTriplet | None:
        """The three finest grids; None for two."""
        if self.values.size < 3:
            return None
        return GridTriplet.from_spacings(self.values[:3].tolist(), self.spacings[:3].tolist())

    @property
    def preferred(self) -> UncertaintyEstimate:
        """Estimate of the default method."""
        if self.behaviour == "too few grids":
            return self["GCI Roache"]
        if self.least_squares is not None:
            return self[LEAST_SQUARES]
        if self.behaviour != "monotone convergent" or self.triplet is None:
            return self["data range"]
        return self["factor of safety" if self.triplet.order >= LOWEST_ORDER else "GCI Oberkampf-Roy"]

    def by(self, method: str) -> UncertaintyEstimate:
        """Estimate of a method, or the default one, which says so, where that method has no value.

        Raises
        ------
        TowtankError
            For an unknown method.
        """
        estimate = self[method]
        if not math.isnan(estimate.uncertainty) or method == DEFAULT:
            return estimate
        return self.preferred.noting(f"'{method}' has no value here")


def numerical_uncertainty(
    values: ArrayLike, spacings: ArrayLike, *, quantity: str = "", unit: str = "", formal_order: float = 2.0
) -> NumericalUncertainty:
    """Uncertainty of the finest grid's value by every method.

    Parameters
    ----------
    values : array_like, shape (n,)
        Results on two or more grids, in any unit.
    spacings : array_like, shape (n,)
        Cell sizes or time steps in any unit and order; see
        :func:`towtank.verify.refinement.spacings_from_cells`.
    quantity, unit : str
        For the table.
    formal_order : float
        Order of the scheme, p_est.

    Raises
    ------
    TowtankError
        With fewer than two grids, a missing value, a spacing that is not positive or given twice.
    """
    phi, h = np.asarray(values, dtype=float).ravel(), np.asarray(spacings, dtype=float).ravel()
    if phi.size != h.size:
        raise TowtankError(f"{phi.size} values on {h.size} grids", cure="give one value a grid", place=quantity)
    if phi.size < 2:
        raise TowtankError(
            f"{phi.size} grid(s): no uncertainty without refinement",
            cure="give at least three grids",
            place=quantity,
        )
    if not (math.isfinite(formal_order) and formal_order > 0.0):
        raise TowtankError(f"the formal order {formal_order:g} is not positive", cure="2 for most schemes")
    missing = np.flatnonzero(~np.isfinite(phi))
    if missing.size:
        raise TowtankError(
            f"grid {int(missing[0]) + 1} has no value",
            cure="leave the failed grid out or run it again",
            place=quantity,
        )
    order = finest_first(h)
    phi, h = phi[order], h[order] / h[order][0]
    fitted = _least_squares(phi, h)
    behaviour = fitted.behaviour if fitted is not None else _behaviour(phi, h)
    found = _estimates(phi, h, fitted, behaviour, formal_order)
    named = tuple(found[method].of(quantity, unit) for method in METHODS)
    return NumericalUncertainty(quantity, unit, phi, h, named, behaviour, fitted)


def _least_squares(phi: np.ndarray, h: np.ndarray) -> ManyGridUncertainty | None:
    if phi.size < 4 or float(np.ptp(phi)) <= EQUAL * float(np.max(np.abs(phi))):
        return None
    return eca_hoekstra(phi, h)


def _behaviour(phi: np.ndarray, h: np.ndarray) -> str:
    if phi.size == 2:
        return "too few grids"
    return GridTriplet.from_spacings(phi[:3].tolist(), h[:3].tolist()).behaviour


def _estimates(
    phi: np.ndarray, h: np.ndarray, fitted: ManyGridUncertainty | None, behaviour: str, formal_order: float
) -> dict[str, UncertaintyEstimate]:
    if fitted is not None:
        many = fitted.estimate
    else:
        why = "needs four grids" if phi.size < 4 else "all grids give the same number"
        many = _without(LEAST_SQUARES, behaviour, why)
    spread = data_range(phi.tolist(), behaviour)
    if phi.size == 2:
        few = [_without(method, behaviour, "needs three grids") for method in METHODS]
        few += [gci_two_grids(float(phi[0]), float(phi[1]), float(h[1] / h[0]), formal_order), many, spread]
        return {estimate.method: estimate for estimate in few}
    triplet = GridTriplet.from_spacings(phi[:3].tolist(), h[:3].tolist())
    three = [
        gci_celik(triplet),
        gci_roache(triplet),
        gci_oberkampf_roy(triplet, formal_order),
        correction_factor(triplet, formal_order),
        correction_factor(triplet, formal_order, corrected=True),
        factor_of_safety(triplet, formal_order),
    ]
    if phi.size > 3:
        three = [estimate.noting("of the three finest grids") for estimate in three]
    return {estimate.method: estimate for estimate in (*three, many, spread)}


def _without(method: str, behaviour: str, why: str) -> UncertaintyEstimate:
    return UncertaintyEstimate(method, behaviour, math.nan, math.nan, math.nan, why)


def uncertainty_table(estimates: Iterable[UncertaintyEstimate]) -> pd.DataFrame:
    """Rows of several estimates: :data:`UNCERTAINTY_COLUMNS` and a note."""
    import pandas as pd

    rows = [
        (one.quantity, one.method, one.behaviour, one.order, one.extrapolated, one.uncertainty, one.unit, one.note)
        for one in estimates
    ]
    return pd.DataFrame(rows, columns=[*UNCERTAINTY_COLUMNS, "note"])


def combined_uncertainty(
    iterative: float = 0.0, grid: float = 0.0, time_step: float = 0.0, other: float = 0.0
) -> float:
    """Simulation numerical uncertainty U_SN = sqrt(U_I^2 + U_G^2 + U_T^2 + U_P^2) (ITTC 7.5-03-01-01).

    The parts must have one unit and one level. A part that is NaN, because no method has a value for it, makes the
    whole NaN.

    Raises
    ------
    TowtankError
        When a part is negative.
    """
    parts = (iterative, grid, time_step, other)
    if any(part < 0.0 for part in parts):
        raise TowtankError("an uncertainty is negative", cure="give half-widths")
    return math.hypot(*parts)
