"""Radiation memory as a rational transfer function, identified from tables of added mass and damping.

``K(s) = (p_(n-1) s^(n-1) + ... + p_1 s) / (s^n + q_(n-1) s^(n-1) + ... + q_0)``: relative degree one and a zero at
s = 0, as the theory of radiation demands; ``K(i omega) = B(omega) + i omega (A(omega) - A_inf)``. The fit is that of
Perez and Fossen (2009): linear least squares on ``Q K - P``, weighted with 1/|Q|^2 of the pass before until the
denominator stands still, and the order raised from two until both tables are explained.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from .retardation import checked_table, coefficient_of_determination, impulse_response

if TYPE_CHECKING:
    import pandas as pd

LOWEST_ORDER = 2
HIGHEST_ORDER = 10
LEAST_R2 = 0.99
NEGATIVE_SHARE = 0.01
"""Negative damping, as a share of the largest, that a fit may have before it is a finding."""

_PASSES = 200
_STANDSTILL = 1e-12


@dataclass(frozen=True, eq=False)
class TransferFunction:
    """Strictly proper K(s) of radiation, highest power first.

    Attributes
    ----------
    numerator : ndarray, shape (n,)
        p_(n-1) ... p_1, p_0; p_0 is zero.
    denominator : ndarray, shape (n + 1,)
        1, q_(n-1) ... q_0.
    """

    numerator: np.ndarray
    denominator: np.ndarray

    def __post_init__(self) -> None:
        top, bottom = np.asarray(self.numerator, dtype=float), np.asarray(self.denominator, dtype=float)
        if top.ndim != 1 or bottom.shape != (top.size + 1,) or top.size < LOWEST_ORDER or bottom[0] != 1.0:
            raise FitError(
                "a radiation memory of order n >= 2 has n coefficients above and 1, q_(n-1) ... q_0 below",
                cure="give the highest power first, and a monic denominator",
            )
        object.__setattr__(self, "numerator", top)
        object.__setattr__(self, "denominator", bottom)

    @property
    def order(self) -> int:
        """Degree of the denominator."""
        return self.numerator.size

    @cached_property
    def poles(self) -> np.ndarray:
        """Roots of the denominator in rad/s, shape (n,), complex."""
        return np.roots(self.denominator)

    @property
    def stable(self) -> bool:
        """True when every pole decays."""
        return bool((self.poles.real < 0.0).all())

    def __call__(self, frequency: np.ndarray) -> np.ndarray:
        """K(i omega), complex, at frequencies in rad/s."""
        s = 1j * np.asarray(frequency, dtype=float)
        return np.asarray(np.polyval(self.numerator, s) / np.polyval(self.denominator, s))

    def damping(self, frequency: np.ndarray) -> np.ndarray:
        """B(omega), real part of K."""
        return self(frequency).real

    def added_mass_difference(self, frequency: np.ndarray) -> np.ndarray:
        """A(omega) - A_inf; at zero frequency its limit p_1/q_0."""
        omega = np.asarray(frequency, dtype=float)
        at_rest = self.numerator[-2] / self.denominator[-1]
        safe = np.where(omega == 0.0, 1.0, omega)
        return np.where(omega == 0.0, at_rest, self(omega).imag / safe)

    def passive(self, frequency: np.ndarray, tolerance: float = 1e-9) -> bool:
        """True when the damping at these frequencies is nowhere below minus `tolerance` times its largest."""
        damping = self.damping(frequency)
        return bool(damping.min() >= -tolerance * np.abs(damping).max())

    def state_space(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Controllable canonical form: z' = A z + b x', memory force = c z; shapes (n, n), (n,), (n,)."""
        n = self.order
        a = np.zeros((n, n))
        a[0] = -self.denominator[1:]
        a[1:, :-1] = np.eye(n - 1)
        b = np.zeros(n)
        b[0] = 1.0
        return a, b, self.numerator.copy()

    def impulse_response(self, time: np.ndarray) -> np.ndarray:
        """K(t), shape (m,), at times that rise uniformly from zero."""
        from scipy.linalg import expm

        t = np.asarray(time, dtype=float)
        a, state, c = self.state_space()
        step = expm(a * (t[1] - t[0]))
        kernel = np.empty(t.size)
        for i in range(t.size):
            kernel[i] = c @ state
            state = step @ state
        return kernel


@dataclass(frozen=True, eq=False)
class TransferFunctionFit:
    """Identified memory.

    Attributes
    ----------
    function : TransferFunction
    infinite : float
        Added mass at infinite frequency: given, or fitted with the function.
    r2_damping, r2_added_mass : float
        Share of the variance of both tables that is explained.
    tried : DataFrame
        Columns ``order``, ``r2_damping``, ``r2_added_mass``, ``stable`` of all orders up to the chosen one.
    findings : tuple of Finding
    """

    function: TransferFunction
    infinite: float
    r2_damping: float
    r2_added_mass: float
    tried: pd.DataFrame
    findings: tuple[Finding, ...]

    @property
    def order(self) -> int:
        """Order that was chosen."""
        return self.function.order

    def added_mass(self, frequency: np.ndarray) -> np.ndarray:
        """A(omega) of the fit."""
        return self.infinite + self.function.added_mass_difference(frequency)


def fit_transfer_function(
    frequency: np.ndarray,
    damping: np.ndarray,
    added_mass: np.ndarray,
    *,
    infinite: float | None = None,
    order: int | None = None,
    least_r2: float = LEAST_R2,
    highest_order: int = HIGHEST_ORDER,
) -> TransferFunctionFit:
    """Rational memory of a table of radiation coefficients.

    Parameters
    ----------
    frequency : ndarray, shape (m,)
        Rising and positive, rad/s.
    damping, added_mass : ndarray, shape (m,)
        B and A of one motion, SI.
    infinite : float, optional
        A at infinite frequency; fitted together with the function when not given.
    order : int, optional
        Fixed order; raised from 2 until both R2 reach `least_r2` when not given.
    least_r2 : float
    highest_order : int
        Where raising stops; the best order is then returned with a finding.

    Raises
    ------
    FitError
        For tables that do not pair or rise, an order below 2, or fewer rows than coefficients.
    """
    import pandas as pd

    omega, b = checked_table(frequency, damping, "damping")
    _, a = checked_table(frequency, added_mass, "added mass")
    if omega[0] <= 0.0:
        raise FitError("the table starts at zero frequency", cure="leave that row out")
    if order is not None and order < LOWEST_ORDER:
        raise FitError(f"a memory of order {order} cannot vanish at zero frequency", cure="use order 2 or more")
    orders = range(LOWEST_ORDER, highest_order + 1) if order is None else [order]
    fits, rows = [], []
    for n in orders:
        if 2 * omega.size < 2 * n:
            break
        function, limit = _identify(omega, b, a, n, infinite)
        fit_b = coefficient_of_determination(b, function.damping(omega))
        fit_a = coefficient_of_determination(a, limit + function.added_mass_difference(omega))
        fits.append((function, limit, fit_b, fit_a))
        rows.append({"order": n, "r2_damping": fit_b, "r2_added_mass": fit_a, "stable": function.stable})
        if min(fit_b, fit_a) >= least_r2:
            break
    if not fits:
        raise FitError(
            f"{omega.size} frequencies cannot determine a memory of order {order}", cure="lower the order"
        )
    best = max(fits, key=lambda item: min(item[2], item[3]))
    return TransferFunctionFit(
        *best, tried=pd.DataFrame(rows), findings=tuple(_doubts(best[0], min(best[2:]), omega, least_r2))
    )


def memory_of_damping(
    frequency: np.ndarray,
    damping: np.ndarray,
    *,
    order: int | None = None,
    least_r2: float = LEAST_R2,
    highest_order: int = HIGHEST_ORDER,
) -> TransferFunctionFit:
    """Rational memory of a table that has the damping alone: the added mass is that which the damping implies.

    The impulse response is taken up to half the repetition time of the table, pi over its frequency step. ``infinite``
    of the result is 0: the added mass is counted from that at infinite frequency.

    Parameters
    ----------
    frequency, damping : ndarray, shape (m,)
        Rising and positive, rad/s; B of one motion, SI.
    order, least_r2, highest_order
        As in :func:`fit_transfer_function`.

    Raises
    ------
    FitError
        As :func:`fit_transfer_function`.
    """
    omega, b = checked_table(frequency, damping, "damping")
    end = math.pi / float(np.median(np.diff(omega)))
    # Eight samples in a period of the highest frequency.
    time = np.linspace(0.0, end, max(math.ceil(4.0 * end * float(omega[-1]) / math.pi), 16) + 1)
    response = impulse_response(omega, b, time)
    fit = fit_transfer_function(
        omega,
        b,
        response.added_mass_difference(omega),
        infinite=0.0,
        order=order,
        least_r2=least_r2,
        highest_order=highest_order,
    )
    return replace(fit, findings=(*response.findings, *fit.findings))


def _doubts(function: TransferFunction, r2: float, omega: np.ndarray, least_r2: float) -> Iterator[Finding]:
    if not r2 >= least_r2:
        yield Finding(
            "memory-not-explained",
            "warning",
            f"order {function.order} explains the tables with R2 = {r2:.4f}, below {least_r2:g}",
            cure="remove wild points of the tables, or allow a higher order",
        )
    if not function.passive(np.linspace(0.0, 3.0 * omega[-1], 600), NEGATIVE_SHARE):
        yield Finding(
            "radiation-not-passive",
            "warning",
            f"at some frequency up to three times the last of the table the fitted damping is negative by more than "
            f"{NEGATIVE_SHARE:.0%} of its largest value",
            cure="use a lower order, or tables up to higher frequencies",
        )


def _identify(
    omega: np.ndarray, damping: np.ndarray, added_mass: np.ndarray, order: int, infinite: float | None
) -> tuple[TransferFunction, float]:
    """Iterated weighted least squares of one order, in frequencies and forces of order one."""
    limit = float(added_mass[-1]) if infinite is None else float(infinite)
    rate = float(np.sqrt(omega[0] * omega[-1]))
    size = float(np.abs(damping + 1j * omega * (added_mass - limit)).max()) or 1.0
    s = 1j * omega / rate
    powers = s[:, None] ** np.arange(order + 1)
    bottom = np.zeros(order + 1)
    weight = np.ones(omega.size)
    for _ in range(_PASSES):
        response = (damping + 1j * omega * (added_mass - limit)) / size
        columns = [response[:, None] * powers[:, :order], -powers[:, 1:order]]
        if infinite is None:
            # K Q - P depends on the limit by -s Q: with the weight 1/|Q| of the last pass a column of its own.
            last = powers @ bottom if bottom[-1] else powers[:, order]
            columns.append(-(s * last)[:, None])
        solution = _complex_lstsq(np.hstack(columns) * weight[:, None], -response * powers[:, order] * weight)
        fresh = np.append(solution[:order], 1.0)
        change = float(np.abs(fresh - bottom).max())
        bottom = fresh
        if infinite is None:
            step = float(solution[-1]) * size / rate
            limit += step
            change = max(change, abs(step) * rate / size)
        weight = 1.0 / np.abs(powers @ bottom)
        if change <= _STANDSTILL * float(np.abs(bottom).max()):
            break
    top = np.concatenate([[0.0], solution[order : 2 * order - 1]])
    roots = np.roots(bottom[::-1])
    if (roots.real >= 0.0).any():
        # A growing pole is no radiation; its mirror image has the same damping denominator.
        roots = -np.abs(roots.real) + 1j * roots.imag
        bottom = np.real(np.poly(roots))[::-1]
        response = (damping + 1j * omega * (added_mass - limit)) / size
        whole = powers @ bottom
        top[1:] = _complex_lstsq(powers[:, 1:order] / whole[:, None], response)
    # From the scaled s/rate back to s.
    scale = rate ** np.arange(order, -1.0, -1.0)
    return TransferFunction((size * top * scale[:order])[::-1], (bottom * scale)[::-1]), limit


def _complex_lstsq(design: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Real least-squares solution of complex equations, columns scaled to unit length."""
    rows = np.vstack([design.real, design.imag])
    length = np.sqrt(np.einsum("ij,ij->j", rows, rows))
    length = np.where(length > 0.0, length, 1.0)
    return np.linalg.lstsq(rows / length, np.concatenate([target.real, target.imag]), rcond=None)[0] / length
