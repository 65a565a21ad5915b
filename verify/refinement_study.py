"""A refinement study of one quantity: grids, time steps and iterations, each by itself and together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .curve_uncertainty import FULL_TURN, CurveUncertainty, curve_uncertainty, unwrapped_phases
from .numerical_uncertainty import DEFAULT, NumericalUncertainty, combined_uncertainty, numerical_uncertainty
from .triplet_uncertainty import UncertaintyEstimate

TIME_STEP = "time step"
COMBINED = "combined"


@dataclass(frozen=True, eq=False)
class Refinement:
    """Values of one quantity on grids or with time steps of different fineness.

    Attributes
    ----------
    values, spacings : ndarray, shape (n,)
        In any order; spacings in any unit.
    points : ndarray, shape (n,), optional
        Place on a curve of each value; None for a number.
    """

    values: np.ndarray
    spacings: np.ndarray
    points: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class RefinementStudy:
    """Everything that a study has on one quantity.

    Attributes
    ----------
    quantity, unit : str
        A quantity whose name ends in ``phase`` and whose unit is rad or deg is unwrapped.
    grid, time_step : Refinement or None
    iterative : float
        Half-width of the iterative uncertainty on the finest grid; NaN when not given.
    """

    quantity: str
    unit: str = ""
    grid: Refinement | None = None
    time_step: Refinement | None = None
    iterative: float = math.nan


@dataclass(frozen=True, eq=False)
class StudyUncertainty:
    """Numerical uncertainty of one quantity.

    Attributes
    ----------
    study : RefinementStudy
    grid, time_step : NumericalUncertainty, CurveUncertainty or None
    method : str
        The method that counts; the default one where it has no value.
    """

    study: RefinementStudy
    grid: NumericalUncertainty | CurveUncertainty | None
    time_step: NumericalUncertainty | CurveUncertainty | None
    method: str = DEFAULT

    @property
    def parts(self) -> tuple[NumericalUncertainty, ...]:
        """Every number that was refined: the points of curves one by one, grids before time steps."""
        found: list[NumericalUncertainty] = []
        for part in (self.grid, self.time_step):
            if isinstance(part, NumericalUncertainty):
                found.append(part)
            elif part is not None:
                found += part.local
        return tuple(found)

    @property
    def curves(self) -> tuple[CurveUncertainty, ...]:
        """The refinements that are curves."""
        return tuple(part for part in (self.grid, self.time_step) if isinstance(part, CurveUncertainty))

    @cached_property
    def chosen(self) -> tuple[UncertaintyEstimate, ...]:
        """The estimates that count: one a number, or one a point of a curve.

        With more than one part (grid, time step, iterations) of a number it is their root of squares.
        """
        sizes = {
            name: part.by(self.method).uncertainty
            for name, part in (("grid", self.grid), ("time_step", self.time_step))
            if isinstance(part, NumericalUncertainty)
        }
        if not math.isnan(self.study.iterative) and sizes:
            sizes["iterative"] = self.study.iterative
        if len(sizes) < 2:
            return tuple(part.by(self.method) for part in self.parts)
        first = self.parts[0]
        words = ", ".join(f"{name.replace('_', ' ')} {size:.3g}" for name, size in sizes.items())
        return (
            UncertaintyEstimate(
                COMBINED,
                first.behaviour,
                math.nan,
                math.nan,
                combined_uncertainty(**sizes),
                f"root of squares of {words}",
                self.study.quantity,
                self.study.unit,
            ),
        )

    @property
    def estimates(self) -> tuple[UncertaintyEstimate, ...]:
        """Every row of the table: each method of each part, pooled curves, the combination."""
        rows = [estimate for part in self.parts for estimate in part.estimates]
        rows += [estimate for curve in self.curves for estimate in curve.pooled]
        if self.chosen and self.chosen[0].method == COMBINED:
            rows += self.chosen
        return tuple(rows)


def study_uncertainty(
    study: RefinementStudy, *, method: str = DEFAULT, formal_order: float = 2.0, interpolate: bool = False
) -> StudyUncertainty:
    """Uncertainty of every part of a study and of all together.

    Parameters
    ----------
    study : RefinementStudy
    method : str
        ``default``, or one of :data:`~towtank.verify.numerical_uncertainty.METHODS`: which one counts.
    formal_order : float
        Of space and of time.
    interpolate : bool
        Bring curves to the points of the finest grid, see
        :func:`~towtank.verify.curve_uncertainty.curve_uncertainty`.

    Raises
    ------
    TowtankError
        See :func:`~towtank.verify.numerical_uncertainty.numerical_uncertainty`.
    """
    results: list[NumericalUncertainty | CurveUncertainty | None] = []
    for part, name in ((study.grid, study.quantity), (study.time_step, f"{study.quantity} ({TIME_STEP})")):
        if part is None:
            results.append(None)
        elif part.points is None:
            values = part.values
            if study.quantity.lower().endswith("phase") and study.unit in FULL_TURN:
                values = unwrapped_phases(values, part.spacings, study.unit)
            results.append(
                numerical_uncertainty(
                    values, part.spacings, quantity=name, unit=study.unit, formal_order=formal_order
                )
            )
        else:
            results.append(_curve(part, name, study.unit, formal_order, interpolate))
    return StudyUncertainty(study, results[0], results[1], method)


def _curve(part: Refinement, name: str, unit: str, formal_order: float, interpolate: bool) -> CurveUncertainty:
    assert part.points is not None
    spacings = np.unique(part.spacings)
    rows: Sequence[np.ndarray] = [np.flatnonzero(part.spacings == spacing) for spacing in spacings]
    curves = [part.values[row] for row in rows]
    points = [part.points[row] for row in rows]
    return curve_uncertainty(
        points, curves, spacings, quantity=name, unit=unit, interpolate=interpolate, formal_order=formal_order
    )
