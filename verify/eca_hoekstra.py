"""Uncertainty from four or more grids by least squares: Eca and Hoekstra (2014), J. Comp. Phys. 262:104-130.

The power law ``phi = phi0 + alpha h^p`` is fitted without weights and with weights proportional to 1/h. An observed
order between 0.5 and 2 is used; a higher or lower one is replaced by fits of fixed order, of which that with the
smallest standard deviation counts. The standard deviation sigma, compared with the range of the data per grid,
``Delta = (max - min)/(n - 1)``, decides on the safety factor and on the form of the uncertainty, so that scattered
data are not made better by the fit (Appendices A and B of the paper).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError
from .grid_triplet import EQUAL
from .refinement import finest_first
from .triplet_uncertainty import UncertaintyEstimate

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

LOWEST_ORDER, HIGHEST_ORDER = 0.5, 2.0
"""Observed orders that are used as they are."""

ALMOST_SECOND = 2.1
"""Orders up to this keep the small safety factor."""

SAFE, DOUBTFUL = 1.25, 3.0
"""Safety factors."""

_ORDERS = np.geomspace(0.01, 25.0, 241)
"""Where an order is looked for; below is a logarithm, above only the coarsest grid differs."""

_ROUNDING = 1e-9


@dataclass(frozen=True)
class PowerFit:
    """Least-squares fit of phi0 plus powers of the spacing.

    Attributes
    ----------
    form : str
        ``h^p``, ``h``, ``h^2`` or ``h + h^2``.
    weighted : bool
        Weights proportional to 1/h.
    powers, coefficients : tuple of float
        ``phi = phi0 + sum coefficient (h/h1)^power``, h1 being the finest spacing.
    phi0 : float
    sigma : float
        Standard deviation of the fit, with n - 3 degrees of freedom for two free coefficients and an order or two
        powers, n - 2 for one power.
    """

    form: str
    weighted: bool
    powers: tuple[float, ...]
    coefficients: tuple[float, ...]
    phi0: float
    sigma: float

    @property
    def order(self) -> float:
        """The free order of ``h^p``, else the lowest power."""
        return self.powers[0]

    def at(self, relative_spacing: ArrayLike) -> np.ndarray:
        """Fitted value at spacings over the finest one."""
        h = np.asarray(relative_spacing, dtype=float)
        value = np.full(h.shape, self.phi0)
        for power, coefficient in zip(self.powers, self.coefficients, strict=True):
            value = value + coefficient * h**power
        return value


@dataclass(frozen=True)
class ManyGridUncertainty:
    """Eca and Hoekstra's estimate for one quantity, finest grid first.

    Attributes
    ----------
    values, spacings : ndarray, shape (n,)
        Spacings over the finest one.
    fit : PowerFit
        The fit that counts.
    observed_order : float
        Order of the power law that was found, NaN when none was; the order of `fit` may be another.
    data_range : float
        Delta, the range of the data over n - 1.
    safety : float
    uncertainty : ndarray, shape (n,)
        Of each grid, about 95 %.
    behaviour : str
        Class of convergence.
    """

    values: np.ndarray
    spacings: np.ndarray
    fit: PowerFit
    observed_order: float
    data_range: float
    safety: float
    uncertainty: np.ndarray
    behaviour: str

    @property
    def scattered(self) -> bool:
        """True when sigma exceeds Delta: the scatter, not the fit, then sets the uncertainty."""
        return not self.fit.sigma < self.data_range

    @property
    def estimate(self) -> UncertaintyEstimate:
        """The finest grid's uncertainty as a row of the table of methods."""
        found = (
            "no order found" if math.isnan(self.observed_order) else f"observed order {self.observed_order:.4g}"
        )
        note = (
            f"{self.fit.form} {'weighted' if self.fit.weighted else 'unweighted'}, {found}, "
            f"sigma {self.fit.sigma:.3g}, range per grid {self.data_range:.3g}, safety factor {self.safety:g}"
        )
        if self.scattered:
            note += "; sigma exceeds the range per grid: scatter rules"
        return UncertaintyEstimate(
            METHOD, self.behaviour, self.fit.order, self.fit.phi0, float(self.uncertainty[0]), note
        )


METHOD = "Eca-Hoekstra"


def eca_hoekstra(values: ArrayLike, spacings: ArrayLike) -> ManyGridUncertainty:
    """Uncertainty of one quantity on four or more grids.

    Parameters
    ----------
    values : array_like, shape (n,)
        Results, n >= 4, in any unit.
    spacings : array_like, shape (n,)
        Typical cell sizes in any unit and order.

    Raises
    ------
    TowtankError
        With fewer than four grids, a missing value, a spacing that is not positive or given twice, or equal
        solutions on all grids.
    """
    phi, h = _sorted(values, spacings)
    n = phi.size
    if n < 4:
        raise TowtankError(
            f"{n} grids are too few for least squares", cure="give four, or use a three-grid method"
        )
    extent = float(np.ptp(phi))
    if extent <= EQUAL * float(np.max(np.abs(phi))):
        raise TowtankError("all grids give the same number", cure="no order can be found from equal solutions")
    searched = [_power_law(phi, h, weighted) for weighted in (False, True)]
    found = sorted((fit for fit in searched if fit is not None), key=lambda fit: fit.sigma)
    usable = [fit for fit in found if LOWEST_ORDER - _ROUNDING <= fit.order <= HIGHEST_ORDER + _ROUNDING]
    if usable:
        fit = usable[0]
        order = fit.order
    else:
        order = found[0].order if found else math.nan
        fit = _fixed_order(phi, h, all_forms=len(found) < 2 or min(f.order for f in found) < LOWEST_ORDER)
    delta = extent / (n - 1)
    usual = LOWEST_ORDER - _ROUNDING <= order < ALMOST_SECOND
    safety = SAFE if usual and fit.sigma < delta else DOUBTFUL
    fitted = fit.at(h)
    error, misfit = np.abs(fitted - fit.phi0), np.abs(phi - fitted)
    if fit.sigma < delta:
        uncertainty = safety * error + fit.sigma + misfit
    else:
        uncertainty = DOUBTFUL * fit.sigma / delta * (error + fit.sigma + misfit)
    return ManyGridUncertainty(phi, h, fit, order, delta, safety, uncertainty, _behaviour(phi, bool(found)))


def _sorted(values: ArrayLike, spacings: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    phi, h = np.asarray(values, dtype=float).ravel(), np.asarray(spacings, dtype=float).ravel()
    if phi.size != h.size:
        raise TowtankError(f"{phi.size} values on {h.size} grids", cure="give one value a grid")
    if not np.isfinite(phi).all():
        bad = int(np.flatnonzero(~np.isfinite(phi))[0]) + 1
        raise TowtankError(f"grid {bad} has no value", cure="leave a failed run out, or run it again")
    order = finest_first(h)
    return phi[order], h[order] / h[order][0]


def _weights(h: np.ndarray, weighted: bool) -> np.ndarray:
    """Weights whose mean is 1."""
    if not weighted:
        return np.ones_like(h)
    return np.asarray(h.size * (1.0 / h) / np.sum(1.0 / h))


def _linear(phi: np.ndarray, h: np.ndarray, powers: tuple[float, ...], weighted: bool, form: str) -> PowerFit:
    """Fit with given powers."""
    w = _weights(h, weighted)
    columns = np.column_stack([np.ones_like(h), *(h**power for power in powers)])
    root = np.sqrt(w)[:, None]
    # columns of the same size keep the system well conditioned for high powers
    size = np.max(np.abs(columns), axis=0)
    solution = np.linalg.lstsq(root * (columns / size), root[:, 0] * phi, rcond=None)[0] / size
    left = phi - columns @ solution
    free = 3 if form == "h^p" else columns.shape[1]
    sigma = float(np.sqrt(np.sum(w * left**2) / (h.size - free)))
    return PowerFit(form, weighted, powers, tuple(solution[1:].tolist()), float(solution[0]), sigma)


def _power_law(phi: np.ndarray, h: np.ndarray, weighted: bool) -> PowerFit | None:
    """Best fit with a free positive order; None when the sum of squares has no minimum that is the smallest."""
    from scipy.optimize import brentq

    w = _weights(h, weighted)
    logs = np.log(h)

    def squares_and_slope(p: float) -> tuple[float, float]:
        """Sum of squares with phi0 and alpha eliminated, and the sign of its derivative to p."""
        power = np.exp(p * (logs - logs[-1]))
        centred = power - np.average(power, weights=w)
        level = phi - np.average(phi, weights=w)
        alpha = float(np.sum(w * centred * level) / np.sum(w * centred**2))
        left = level - alpha * centred
        return float(np.sum(w * left**2)), -alpha * float(np.sum(w * left * power * logs))

    table = np.array([squares_and_slope(p) for p in _ORDERS])
    turns = np.flatnonzero((table[:-1, 1] < 0.0) & (table[1:, 1] >= 0.0))
    candidates = [
        float(brentq(lambda p: squares_and_slope(p)[1], _ORDERS[k], _ORDERS[k + 1], xtol=1e-13)) for k in turns
    ]
    if not candidates:
        return None
    best = min(candidates, key=lambda p: squares_and_slope(p)[0])
    if squares_and_slope(best)[0] > min(table[0, 0], table[-1, 0]):
        return None
    return _linear(phi, h, (best,), weighted, "h^p")


def _fixed_order(phi: np.ndarray, h: np.ndarray, *, all_forms: bool) -> PowerFit:
    """Fit of fixed order with the smallest standard deviation, both weightings."""
    forms = [((1.0,), "h"), ((2.0,), "h^2")] + ([((1.0, 2.0), "h + h^2")] if all_forms else [])
    fits = [_linear(phi, h, powers, weighted, form) for powers, form in forms for weighted in (False, True)]
    return min(fits, key=lambda fit: fit.sigma)


def _behaviour(phi: np.ndarray, has_order: bool) -> str:
    """Class of more than three grids: monotone when every step goes one way, else oscillatory.

    A monotone series converges when a positive order fits it; an oscillating one when its three finest grids differ
    by less than its three coarsest.
    """
    steps = np.diff(phi)
    steps = steps[np.abs(steps) > EQUAL * float(np.max(np.abs(phi)))]
    if np.all(steps > 0.0) or np.all(steps < 0.0):
        return "monotone convergent" if has_order else "monotone divergent"
    calms = float(np.ptp(phi[:3])) < float(np.ptp(phi[-3:]))
    return "oscillatory convergent" if calms else "oscillatory divergent"
