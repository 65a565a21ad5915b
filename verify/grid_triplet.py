"""One result on three grids: class of convergence, observed order, extrapolated value, error estimates.

Grids are numbered as in the literature: 1 is fine, 2 medium, 3 coarse; ``eps21 = S2 - S1``, ``eps32 = S3 - S2``. The
order solves, for ratios that may differ,

    eps32 / eps21 = s r21^p (r32^p - s) / (r21^p - s),   s = sign(eps32 / eps21),

of which Celik et al. (2008) take the fixed point ``p = |ln|eps32/eps21| + ln((r21^p - s)/(r32^p - s))| / ln r21``.
The left side grows steadily with p for either sign, so that there is one root; a negative one belongs to
a triplet that diverges, for which the absolute value of the fixed point would show a positive order.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import TowtankError
from .refinement import finest_first

Behaviour = Literal[
    "monotone convergent",
    "oscillatory convergent",
    "monotone divergent",
    "oscillatory divergent",
    "equal solutions",
]

EQUAL = 1e-12
"""Difference, relative to the largest value, below which two solutions are the same number."""


@dataclass(frozen=True)
class GridTriplet:
    """One result on three grids.

    Attributes
    ----------
    fine, medium, coarse : float
        Values in any unit.
    r21, r32 : float
        Refinement ratios medium over fine and coarse over medium, above 1.
    """

    fine: float
    medium: float
    coarse: float
    r21: float = 2.0
    r32: float = 2.0

    def __post_init__(self) -> None:
        for name, value in (("fine", self.fine), ("medium", self.medium), ("coarse", self.coarse)):
            if not math.isfinite(value):
                raise TowtankError(f"the {name} grid has no value", cure="leave a failed run out, or run it again")
        for name, ratio in (("r21", self.r21), ("r32", self.r32)):
            if not (math.isfinite(ratio) and ratio > 1.0):
                raise TowtankError(
                    f"the refinement ratio {name} = {ratio:g} does not exceed 1", cure="finest first"
                )

    @classmethod
    def from_spacings(cls, values: Sequence[float], spacings: Sequence[float]) -> GridTriplet:
        """Triplet from three values and spacings in any order.

        Raises
        ------
        TowtankError
            When there are not three, two spacings are the same, or a value is missing.
        """
        if len(values) != 3 or len(spacings) != 3:
            raise TowtankError(f"{len(values)} values on {len(spacings)} grids are no triplet", cure="give three")
        order = finest_first(spacings)
        h = np.asarray(spacings, dtype=float)[order]
        fine, medium, coarse = np.asarray(values, dtype=float)[order].tolist()
        return cls(fine, medium, coarse, float(h[1] / h[0]), float(h[2] / h[1]))

    @property
    def eps21(self) -> float:
        """Medium less fine; 0 when they are the same number."""
        return self._difference(self.medium, self.fine)

    @property
    def eps32(self) -> float:
        """Coarse less medium; 0 when they are the same number."""
        return self._difference(self.coarse, self.medium)

    def _difference(self, coarser: float, finer: float) -> float:
        size = max(abs(self.fine), abs(self.medium), abs(self.coarse))
        change = coarser - finer
        return 0.0 if abs(change) <= EQUAL * size else change

    @property
    def extent(self) -> float:
        """Largest less smallest value."""
        values = (self.fine, self.medium, self.coarse)
        return max(values) - min(values)

    @property
    def ratio(self) -> float:
        """Convergence ratio R = eps21 / eps32; NaN when both are zero, infinite when eps32 alone is."""
        if self.eps32 == 0.0:
            return math.nan if self.eps21 == 0.0 else math.inf
        # a difference of zero has no sign
        return self.eps21 / self.eps32 + 0.0

    @property
    def largest_convergent_ratio(self) -> float:
        """R at which the order is zero: ln r21 / ln r32 for monotone triplets, 1 for equal ratios."""
        return math.log(self.r21) / math.log(self.r32)

    @property
    def behaviour(self) -> Behaviour:
        """Class of convergence.

        Monotone triplets converge for 0 < R < :attr:`largest_convergent_ratio`, oscillatory ones for -1 < R < 0
        (Stern et al. 2001 for equal ratios, where both limits are 1 in size). A difference of zero makes
        the triplet ``equal solutions``: it has no order.
        """
        if self.eps21 == 0.0 or self.eps32 == 0.0:
            return "equal solutions"
        ratio = self.ratio
        if ratio < 0.0:
            return "oscillatory convergent" if ratio > -1.0 else "oscillatory divergent"
        return "monotone convergent" if ratio < self.largest_convergent_ratio else "monotone divergent"

    @property
    def order(self) -> float:
        """Observed order p; negative for divergent triplets, NaN for equal solutions."""
        if self.behaviour == "equal solutions":
            return math.nan
        if self.r21 == self.r32:
            return -math.log(abs(self.ratio)) / math.log(self.r21)
        return _order(-math.log(abs(self.ratio)), math.log(self.r21), math.log(self.r32), self.ratio > 0.0)

    @property
    def error(self) -> float:
        """Richardson estimate of the fine grid's error, delta_RE = eps21 / (r21^p - 1), with its sign.

        NaN when the order is not positive. For oscillatory triplets it is the monotone formula all the same,
        as Celik et al. (2008) apply it: the caller must say so.
        """
        return self._step(self.eps21, self.r21)

    @property
    def medium_error(self) -> float:
        """The same estimate for the medium grid from the coarse pair, eps32 / (r32^p - 1)."""
        return self._step(self.eps32, self.r32)

    def _step(self, change: float, ratio: float) -> float:
        p = self.order
        if not p > 0.0:
            return math.nan
        return change / math.expm1(p * math.log(ratio))

    @property
    def extrapolated(self) -> float:
        """Value at vanishing spacing, fine value less :attr:`error`; the common value of equal solutions."""
        if self.eps21 == 0.0:
            return self.fine
        return self.fine - self.error

    def correction_factor(self, formal_order: float = 2.0) -> float:
        """Stern's correction factor C = (r21^p - 1) / (r21^p_est - 1): 1 in the asymptotic range."""
        p = self.order
        if not p > 0.0:
            return math.nan
        step = math.log(self.r21)
        return math.expm1(p * step) / math.expm1(formal_order * step)

    @property
    def asymptotic_ratio(self) -> float:
        """Relative indices of the coarse and the fine pair over r21^p: near 1 in the asymptotic range.

        ``GCI32 / (r21^p GCI21)``, each index over the value of its finer grid; NaN without order or at a value of
        zero. For a triplet that its own order describes, it is ``|S1 / S2|``.
        """
        fine, medium = self.error, self.medium_error
        if math.isnan(fine) or self.fine == 0.0 or self.medium == 0.0:
            return math.nan
        return abs(medium / self.medium) / (self.r21**self.order * abs(fine / self.fine))

    @property
    def relative_change(self) -> float:
        """e_a21 = |eps21 / S1|; NaN when the fine value is zero."""
        return abs(self.eps21 / self.fine) if self.fine != 0.0 else math.nan

    @property
    def relative_extrapolation(self) -> float:
        """e_ext21 = |(S_ext - S1) / S_ext|; NaN when the extrapolated value is zero or missing."""
        there = self.extrapolated
        return abs((there - self.fine) / there) if there != 0.0 else math.nan


def _order(wanted: float, a: float, b: float, monotone: bool) -> float:
    """Root of ln|eps32/eps21| = `wanted` for ratios exp(a) and exp(b), by bracketing and Brent's method."""
    from scipy.optimize import brentq

    def excess(p: float) -> float:
        if monotone:
            # (r32^p - 1)/(r21^p - 1) tends to ln r32/ln r21 at p = 0
            share = (
                math.log(b / a) if abs(p) < 1e-9 else math.log(_growth(p * b) / _growth(p * a)) + math.log(b / a)
            )
        else:
            share = _softplus(p * b) - _softplus(p * a)
        return p * a + share - wanted

    reach = 1.0
    while excess(reach) < 0.0:
        reach *= 2.0
    low = -1.0
    while excess(low) > 0.0:
        low *= 2.0
    return float(brentq(excess, low, reach, xtol=1e-14, rtol=8.9e-16, maxiter=200))


def _growth(x: float) -> float:
    """(e^x - 1)/x, without loss at x = 0."""
    if abs(x) < 1e-12:
        return 1.0
    return math.expm1(x) / x


def _softplus(x: float) -> float:
    """ln(e^x + 1) without overflow."""
    return max(x, 0.0) + math.log1p(math.exp(-abs(x)))
