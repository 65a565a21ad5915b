"""Least squares under signs, bounds, equalities and a prior.

cvxpy finds which constraints hold the solution back; the coefficients are then solved exactly on these
constraints, and their covariance is that of the directions which remain free.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .regression_input import checked_regression

Sign = Literal["+", "-"]
# Distance to a bound, relative to the size of the scaled coefficients, at which it is tried as active.
ACTIVE_DISTANCE = 1e-6


@dataclass(frozen=True, eq=False)
class ConstrainedFit(CoefficientTable):
    """Constrained fit.

    Attributes
    ----------
    active : tuple of str
        Bounds that hold the solution back, as ``"Yv <= 0"``; equalities are not listed.
    scale : float
        Residual variance used for the covariance and for the weight of the prior.
    resid : ndarray, shape (n,)
        Response minus fitted.
    free_directions : int
        Dimension of the coefficient space that the active constraints leave.
    prior_pull : ndarray, shape (p,)
        Coefficient minus prior mean in prior standard deviations; nan without a prior.
    """

    active: tuple[str, ...]
    scale: float
    resid: np.ndarray
    free_directions: int
    prior_pull: np.ndarray


def fit_constrained(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    *,
    signs: Mapping[str, Sign] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    equalities: Sequence[tuple[Mapping[str, float], float]] = (),
    prior: Mapping[str, tuple[float, float]] | None = None,
    noise_sd: float | None = None,
    weights: np.ndarray | None = None,
    confidence: float = 0.95,
) -> ConstrainedFit:
    """Minimise |y - X b|^2/s^2 + sum ((b_j - mean_j)/sd_j)^2 under linear constraints.

    Parameters
    ----------
    design, response, names, weights :
        As :func:`.regression.fit_linear`.
    signs : mapping of name to "+" or "-", optional
        Coefficients that may not be negative, or not positive.
    bounds : mapping of name to (lower, upper), optional
        Use -inf or inf for an open side.
    equalities : sequence of (mapping of name to factor, value)
        Linear equations that the coefficients must obey exactly.
    prior : mapping of name to (mean, standard deviation), optional
        For example an empirical formula and its scatter; acts as a Tikhonov weight.
    noise_sd : float, optional
        Standard deviation of a row of unit weight; the residual scatter of the plain fit when omitted.
    confidence : float
        Level of the intervals in tables.

    Returns
    -------
    ConstrainedFit
        Its intervals hold for the given set of active constraints.

    Raises
    ------
    FitError
        If a name is unknown, the constraints contradict each other, the solver fails, or data, prior and
        constraints together leave a combination of terms open.
    """
    x, y, w = checked_regression(design, response, names, weights)
    p = len(names)
    lower, upper = _box(names, signs or {}, bounds or {})
    matrix, values = _equations(names, equalities)
    root = np.ones(y.size) if w is None else np.sqrt(w)
    rows, target = x * root[:, None], y * root
    plain, _, rank, _ = np.linalg.lstsq(rows, target, rcond=None)
    left = y.size - int(rank)
    if noise_sd is None:
        missed = target - rows @ plain
        noise_sd = math.sqrt(float(missed @ missed) / left) if left > 0 else 0.0
        # Without scatter the prior would get no weight at all; keep it just strong enough to settle ties.
        noise_sd = max(noise_sd, 1e-12 * float(np.sqrt(np.mean(target**2))), 1e-300)
    elif not noise_sd > 0.0:
        raise FitError(f"the noise {noise_sd} is not positive", cure="give a positive standard deviation")

    mean, strength = _prior(names, prior or {})
    weighed = strength > 0.0
    rows = np.vstack([rows, noise_sd * np.diag(strength)[weighed]])
    target = np.concatenate([target, noise_sd * (strength * mean)[weighed]])
    q, triangle = np.linalg.qr(rows)
    aim = q.T @ target
    lengths = np.sqrt(np.einsum("ij,ij->j", triangle, triangle))
    lengths = np.where(lengths > 0.0, lengths, 1.0)
    problem = _Box(triangle / lengths, aim, lower * lengths, upper * lengths, matrix / lengths, values)
    solution, held = problem.solve()
    params = solution / lengths
    params = np.where(held < 0, lower, np.where(held > 0, upper, params))

    free = problem.free_directions(held)
    inner = problem.triangle @ free
    if free.shape[1] and np.linalg.matrix_rank(inner, tol=1e-10) < free.shape[1]:
        direction = free @ np.linalg.svd(inner)[2][-1]
        open_ = [n for n, share in zip(names, np.abs(direction)) if share > 0.05]
        raise FitError(
            f"data and constraints leave a combination of {', '.join(open_)} open",
            cure="add a prior, an equality or runs",
        )
    unit = free @ np.linalg.inv(inner.T @ inner) @ free.T if free.shape[1] else np.zeros((p, p))
    t_dof = float(max(y.size + int(weighed.sum()) - free.shape[1], 1))
    return ConstrainedFit(
        names=tuple(names),
        params=params,
        cov=noise_sd**2 * unit / np.outer(lengths, lengths),
        t_dof=np.full(p, t_dof),
        confidence=confidence,
        active=tuple(
            f"{name} {'>=' if side < 0 else '<='} {value:.6g}"
            for name, side, value in zip(names, held, params)
            if side
        ),
        scale=noise_sd**2,
        resid=y - x @ params,
        free_directions=free.shape[1],
        prior_pull=np.where(weighed, (params - mean) * strength, np.nan),
    )


@dataclass(frozen=True, eq=False)
class _Box:
    """min |R z - c|^2 subject to lower <= z <= upper and A z = b, in scaled coefficients."""

    triangle: np.ndarray
    aim: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    matrix: np.ndarray
    values: np.ndarray

    def solve(self) -> tuple[np.ndarray, np.ndarray]:
        """Solution, and -1 or +1 where the lower or upper bound holds it."""
        boxed = bool(np.isfinite(self.lower).any() or np.isfinite(self.upper).any())
        held = np.zeros(self.aim.size, dtype=int)
        if boxed:
            near = self._by_cvxpy()
            reach = ACTIVE_DISTANCE * max(float(np.max(np.abs(near))), 1e-300)
            held = np.where(near - self.lower <= reach, -1, np.where(self.upper - near <= reach, 1, 0))
        # The solver's guess of the active bounds is corrected one bound at a time; few steps are ever needed.
        for _ in range(4 * self.aim.size + 4):
            z = self._on_face(held)
            size = 1e-12 * max(float(np.max(np.abs(z))), 1e-300)
            outside = np.maximum(self.lower - z, z - self.upper)
            outside[held != 0] = -np.inf
            worst = int(np.argmax(outside))
            if outside[worst] > size:
                held[worst] = -1 if z[worst] < self.lower[worst] else 1
                continue
            push = self._multipliers(z, held)
            wrong = np.where(held != 0, push * held, -np.inf)
            worst = int(np.argmax(wrong))
            limit = 1e-12 * float(np.linalg.norm(self.aim))
            if not wrong[worst] > limit or self.lower[worst] == self.upper[worst]:
                return z, held
            held[worst] = 0
        raise FitError("the active bounds do not settle", cure="loosen contradicting bounds")

    def free_directions(self, held: np.ndarray) -> np.ndarray:
        """Orthonormal directions (p, f) that the equations and the held bounds leave."""
        walls = np.vstack([self.matrix, np.eye(self.aim.size)[held != 0]])
        if walls.shape[0] == 0:
            return np.eye(self.aim.size)
        _, singular, right = np.linalg.svd(walls)
        rank = int(np.count_nonzero(singular > 1e-10 * singular[0]))
        return right[rank:].T

    def _on_face(self, held: np.ndarray) -> np.ndarray:
        at = held != 0
        walls = np.vstack([self.matrix, np.eye(self.aim.size)[at]])
        levels = np.concatenate([self.values, np.where(held < 0, self.lower, self.upper)[at]])
        start = np.linalg.lstsq(walls, levels, rcond=None)[0] if levels.size else np.zeros(self.aim.size)
        if levels.size and not np.allclose(walls @ start, levels, rtol=1e-9, atol=1e-9 * np.abs(levels).max()):
            raise FitError("the constraints contradict each other", cure="loosen bounds or equalities")
        free = self.free_directions(held)
        if free.shape[1] == 0:
            return start
        step = np.linalg.lstsq(self.triangle @ free, self.aim - self.triangle @ start, rcond=None)[0]
        return start + free @ step

    def _multipliers(self, z: np.ndarray, held: np.ndarray) -> np.ndarray:
        slope = self.triangle.T @ (self.triangle @ z - self.aim)
        at = np.flatnonzero(held)
        walls = np.vstack([self.matrix, np.eye(self.aim.size)[at]])
        force = np.linalg.lstsq(walls.T, slope, rcond=None)[0] if walls.size else np.zeros(0)
        push = np.zeros(self.aim.size)
        push[at] = force[self.matrix.shape[0] :]
        return push

    def _by_cvxpy(self) -> np.ndarray:
        import cvxpy as cp

        size = max(float(np.linalg.norm(self.aim)), 1e-300)
        z = cp.Variable(self.aim.size)
        constraints = []
        low, high = np.isfinite(self.lower), np.isfinite(self.upper)
        if low.any():
            constraints.append(z[np.flatnonzero(low)] >= self.lower[low] / size)
        if high.any():
            constraints.append(z[np.flatnonzero(high)] <= self.upper[high] / size)
        if self.values.size:
            constraints.append(self.matrix @ z == self.values / size)
        problem = cp.Problem(cp.Minimize(cp.sum_squares(self.triangle @ z - self.aim / size)), constraints)
        try:
            problem.solve(solver=cp.CLARABEL)
        except cp.error.SolverError as error:
            raise FitError(f"the solver failed: {error}", cure="check the scaling of bounds and prior") from None
        if problem.status not in ("optimal", "optimal_inaccurate") or z.value is None:
            raise FitError(
                f"no coefficients satisfy the constraints ({problem.status})",
                cure="loosen bounds or equalities",
            )
        return np.asarray(z.value) * size


def _column(names: Sequence[str], name: str, kind: str) -> int:
    if name not in names:
        raise FitError(f"the {kind} names '{name}', which is no term", cure=f"use one of {', '.join(names)}")
    return list(names).index(name)


def _box(
    names: Sequence[str], signs: Mapping[str, Sign], bounds: Mapping[str, tuple[float, float]]
) -> tuple[np.ndarray, np.ndarray]:
    lower, upper = np.full(len(names), -np.inf), np.full(len(names), np.inf)
    for name, (low, high) in bounds.items():
        j = _column(names, name, "bound")
        lower[j], upper[j] = low, high
    for name, sign in signs.items():
        j = _column(names, name, "sign")
        if sign not in ("+", "-"):
            raise FitError(f"the sign of '{name}' is '{sign}'", cure="use '+' or '-'")
        if sign == "+":
            lower[j] = max(lower[j], 0.0)
        else:
            upper[j] = min(upper[j], 0.0)
    for name, low, high in zip(names, lower, upper):
        if not low <= high:
            raise FitError(f"the bounds of '{name}' are crossed: {low} > {high}", cure="swap them")
    return lower, upper


def _equations(
    names: Sequence[str], equalities: Sequence[tuple[Mapping[str, float], float]]
) -> tuple[np.ndarray, np.ndarray]:
    matrix = np.zeros((len(equalities), len(names)))
    for row, (factors, _) in zip(matrix, equalities):
        for name, factor in factors.items():
            row[_column(names, name, "equality")] = factor
    return matrix, np.array([value for _, value in equalities], dtype=float)


def _prior(names: Sequence[str], prior: Mapping[str, tuple[float, float]]) -> tuple[np.ndarray, np.ndarray]:
    mean, strength = np.zeros(len(names)), np.zeros(len(names))
    for name, (value, spread) in prior.items():
        j = _column(names, name, "prior")
        if not spread > 0.0:
            raise FitError(f"the prior of '{name}' has no positive standard deviation", cure="use bounds")
        mean[j], strength[j] = value, 1.0 / spread
    return mean, strength
