"""Numerical uncertainty of whole curves and of harmonics.

A curve is compared at the points that all grids share; each point has its own class and order. Where many points
oscillate, an order per point says little: the curve as a whole has a pooled order from the root mean squares of its
changes (Stern et al. 2001, section 3.5), and the mean of the local orders with the share of oscillating points
(Celik et al. 2008, section 2). A harmonic is an amplitude and a phase; phases are unwrapped from grid to grid before
they are compared, since 359 and 1 degree are 2 degrees apart.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError
from .grid_triplet import GridTriplet
from .numerical_uncertainty import NumericalUncertainty, numerical_uncertainty, uncertainty_table
from .refinement import finest_first
from .triplet_uncertainty import GCI_SAFETY, UncertaintyEstimate, factor_of_safety

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

SAME_POINT = 1e-6
"""Share of the range of the points within which two grids' points are one."""

FULL_TURN = {"rad": 2.0 * math.pi, "deg": 360.0}


@dataclass(frozen=True, eq=False)
class CurveUncertainty:
    """A curve on two or more grids.

    Attributes
    ----------
    points : ndarray, shape (m,)
        Where all grids have a value.
    local : tuple of NumericalUncertainty, length m
        Every point by itself.
    pooled : tuple of UncertaintyEstimate
        The whole curve: ``pooled change`` (order of the root-mean-square changes) and ``mean order`` (Celik);
        their uncertainty is the root mean square over the points. Empty for two grids.
    oscillating : float
        Share of the points that oscillate; NaN for two grids.
    notes : tuple of str
    """

    points: np.ndarray
    local: tuple[NumericalUncertainty, ...]
    pooled: tuple[UncertaintyEstimate, ...]
    oscillating: float
    notes: tuple[str, ...] = ()

    @property
    def uncertainty(self) -> np.ndarray:
        """Default uncertainty of the finest grid at each point."""
        return np.array([one.preferred.uncertainty for one in self.local])

    @property
    def table(self) -> pd.DataFrame:
        """Preferred estimate of every point, with the point in the first column."""
        frame = uncertainty_table(one.preferred for one in self.local)
        frame.insert(0, "point", self.points)
        frame.insert(2, "value", [one.fine for one in self.local])
        return frame


def curve_uncertainty(
    points: Sequence[ArrayLike],
    curves: Sequence[ArrayLike],
    spacings: ArrayLike,
    *,
    quantity: str = "",
    unit: str = "",
    interpolate: bool = False,
    formal_order: float = 2.0,
) -> CurveUncertainty:
    """Uncertainty of a curve point by point and pooled.

    Parameters
    ----------
    points : sequence of array_like
        Abscissae of the curve on each grid, e.g. speeds or drift angles.
    curves : sequence of array_like
        Values there.
    spacings : array_like, shape (n,)
        One a grid, in the order of `curves`.
    quantity, unit : str
    interpolate : bool
        Take the points of the finest grid that lie inside every other grid's range, by straight lines, instead of
        the points that all grids share.
    formal_order : float

    Raises
    ------
    TowtankError
        When grids have no point in common, a curve and its points differ in length, or see
        :func:`~towtank.verify.numerical_uncertainty.numerical_uncertainty`.
    """
    order = finest_first(spacings)
    if not len(points) == len(curves) == order.size:
        raise TowtankError(
            f"{len(curves)} curves over {len(points)} sets of points on {order.size} grids",
            cure="give one of each a grid",
            place=quantity,
        )
    tables = [_curve(points[k], curves[k], int(k) + 1, quantity) for k in order]
    h = np.asarray(spacings, dtype=float)[order]
    at, columns, notes = _interpolated(tables) if interpolate else _shared(tables)
    if at.size == 0:
        cure = "compute the same points on every grid, or interpolate"
        raise TowtankError("the grids have no point in common", cure=cure, place=quantity)
    local = tuple(
        numerical_uncertainty(
            columns[:, k], h, quantity=f"{quantity} at {at[k]:g}", unit=unit, formal_order=formal_order
        )
        for k in range(at.size)
    )
    if order.size < 3:
        return CurveUncertainty(at, local, (), math.nan, notes)
    swings = float(np.mean([one.triplet is not None and one.triplet.ratio < 0.0 for one in local]))
    pooled = tuple(one.of(quantity, unit) for one in _pooled(columns, h, swings, formal_order))
    return CurveUncertainty(at, local, pooled, swings, notes)


def _curve(points: ArrayLike, curve: ArrayLike, number: int, quantity: str) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.asarray(points, dtype=float).ravel(), np.asarray(curve, dtype=float).ravel()
    if x.size != y.size:
        raise TowtankError(
            f"grid {number} has {y.size} values at {x.size} points", cure="give one a point", place=quantity
        )
    known = np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    ranks = np.argsort(x, kind="stable")
    return x[ranks], y[ranks]


def _shared(tables: Sequence[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray, tuple[str, ...]]:
    x = tables[0][0]
    reach = SAME_POINT * max(float(np.ptp(np.concatenate([one[0] for one in tables]))), 1e-300)
    kept = np.ones(x.size, dtype=bool)
    columns = [tables[0][1]]
    for other, values in tables[1:]:
        if other.size == 0:
            return x[:0], np.empty((len(tables), 0)), ()
        nearest = np.abs(other[None, :] - x[:, None]).argmin(axis=1)
        kept &= np.abs(other[nearest] - x) <= reach
        columns.append(values[nearest])
    lost = int(x.size - np.count_nonzero(kept))
    notes = (f"{lost} point(s) of the finest grid are not on every grid and were left out",) if lost else ()
    return x[kept], np.array(columns)[:, kept], notes


def _interpolated(
    tables: Sequence[tuple[np.ndarray, np.ndarray]],
) -> tuple[np.ndarray, np.ndarray, tuple[str, ...]]:
    x = tables[0][0]
    if any(one[0].size == 0 for one in tables):
        return x[:0], np.empty((len(tables), 0)), ()
    inside = (x >= max(float(one[0][0]) for one in tables)) & (x <= min(float(one[0][-1]) for one in tables))
    at = x[inside]
    columns = np.array([np.interp(at, *one) for one in tables])
    note = "coarser grids were interpolated by straight lines, whose own error is in the differences"
    return at, columns, (note,)


def _pooled(columns: np.ndarray, h: np.ndarray, swings: float, formal_order: float) -> list[UncertaintyEstimate]:
    """The three finest grids as one triplet of root-mean-square changes, and by the mean of the local orders."""
    r21, r32 = float(h[1] / h[0]), float(h[2] / h[1])
    triplets = [GridTriplet(a, b, c, r21, r32) for a, b, c in columns[:3].T.tolist()]
    change21, change32 = (float(np.sqrt(np.mean((columns[k + 1] - columns[k]) ** 2))) for k in (0, 1))
    # values whose changes are the root mean squares
    whole = factor_of_safety(GridTriplet(0.0, change21, change21 + change32, r21, r32), formal_order)
    # root mean squares have no sign: the class is that of most points, unless the changes grow as a whole
    most = Counter(one.behaviour for one in triplets).most_common(1)[0][0]
    behaviour = most if whole.behaviour == "monotone convergent" else whole.behaviour
    said = f"{100.0 * swings:.0f} % of the points oscillate"
    change = UncertaintyEstimate(
        "pooled change",
        behaviour,
        whole.order,
        math.nan,
        whole.uncertainty,
        "; ".join(filter(None, (said, whole.note))),
    )
    orders = [one.order for one in triplets if one.behaviour.endswith(" convergent")]
    if not orders:
        note = f"{said}; no point converges"
        return [change, UncertaintyEstimate("mean order", behaviour, math.nan, math.nan, math.nan, note)]
    mean = float(np.mean(orders))
    size = GCI_SAFETY * change21 / math.expm1(mean * math.log(r21))
    reach = f"from {min(orders):.3g} to {max(orders):.3g}"
    note = f"{said}; mean of {len(orders)} local orders {reach}, safety factor {GCI_SAFETY:g}"
    return [change, UncertaintyEstimate("mean order", behaviour, mean, math.nan, size, note)]


def unwrapped_phases(phases: ArrayLike, spacings: ArrayLike, unit: str = "rad") -> np.ndarray:
    """Phases of one harmonic on several grids, moved by whole turns to the branch of the next finer grid.

    Parameters
    ----------
    phases : array_like, shape (n,)
    spacings : array_like, shape (n,)
    unit : {"rad", "deg"}

    Returns
    -------
    ndarray, shape (n,)
        In the order given; the finest grid's phase stays as it is.

    Raises
    ------
    TowtankError
        For another unit.
    """
    if unit not in FULL_TURN:
        raise TowtankError(f"a phase in '{unit}' cannot be unwrapped", cure="give rad or deg")
    turn = FULL_TURN[unit]
    order = finest_first(spacings)
    along = np.asarray(phases, dtype=float)[order]
    result = np.empty_like(along)
    result[order] = np.unwrap(along, period=turn)
    return result


def harmonic_uncertainty(
    amplitudes: ArrayLike,
    phases: ArrayLike,
    spacings: ArrayLike,
    *,
    quantity: str = "",
    unit: str = "",
    phase_unit: str = "rad",
    formal_order: float = 2.0,
) -> tuple[NumericalUncertainty, NumericalUncertainty]:
    """Uncertainty of the amplitude and of the unwrapped phase of one harmonic.

    Parameters
    ----------
    amplitudes, phases : array_like, shape (n,)
        One a grid.
    spacings : array_like, shape (n,)
    quantity, unit : str
        Of the amplitude; the phase is called ``<quantity> phase``.
    phase_unit : {"rad", "deg"}
    formal_order : float

    Returns
    -------
    (NumericalUncertainty, NumericalUncertainty)
        Amplitude, phase.

    Raises
    ------
    TowtankError
        When an amplitude is negative; see also
        :func:`~towtank.verify.numerical_uncertainty.numerical_uncertainty`.
    """
    size = np.asarray(amplitudes, dtype=float)
    if np.any(size < 0.0):
        raise TowtankError(
            f"the amplitude {np.min(size):g} is negative", cure="turn its phase by half a turn", place=quantity
        )
    amplitude = numerical_uncertainty(size, spacings, quantity=quantity, unit=unit, formal_order=formal_order)
    phase = numerical_uncertainty(
        unwrapped_phases(phases, spacings, phase_unit),
        spacings,
        quantity=f"{quantity} phase".strip(),
        unit=phase_unit,
        formal_order=formal_order,
    )
    return amplitude, phase
