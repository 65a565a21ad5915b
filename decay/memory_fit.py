"""Free decay with radiation memory fitted to a record: inertia and restoring known, or free.

The equation is that of :mod:`.fluid_memory`. With an unknown inertia the memory itself is the yardstick: radiation is
known in SI, everything else per unit of inertia, so that a record in which waves are weak cannot tell the inertia.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..identify.coefficient_table import CoefficientTable
from ..identify.regression import fit_linear
from .damping_models import TERMS
from .fluid_memory import simulate_memory_decay
from .transfer_function import TransferFunction

_LEAST_R2 = 0.95
_UNCERTAIN = 0.5


@dataclass(frozen=True, eq=False)
class MemoryDecayFit(CoefficientTable):
    """Viscous damping beside radiation memory.

    Beside the attributes of a :class:`~towtank.identify.coefficient_table.CoefficientTable`; fixed values are among
    the names with zero variance. Names are the terms of the equation and ``inertia`` (I + A_inf).

    Attributes
    ----------
    memory : TransferFunction
    time, measured, fitted : ndarray, shape (n,)
    start : tuple of float
        Fitted coordinate and velocity at the first time.
    r2 : float
        Part of the variance of the record that the simulated decay explains.
    converged : bool
    findings : tuple of Finding
    """

    memory: TransferFunction
    time: np.ndarray
    measured: np.ndarray
    fitted: np.ndarray
    start: tuple[float, float]
    r2: float
    converged: bool
    findings: tuple[Finding, ...]

    @property
    def inertia(self) -> float:
        """I + A_inf in kg m2 (heave: kg)."""
        return self["inertia"]

    def coefficients(self) -> dict[str, float]:
        """Terms per unit inertia by name."""
        return {name: float(value) for name, value in zip(self.names, self.params) if name in TERMS}

    def dimensional(self) -> dict[str, tuple[float, float]]:
        """Terms times inertia, in SI, with their standard errors (B1 in N m s for b1, C44 for c1)."""
        found = {}
        last = self.names.index("inertia")
        for place, name in enumerate(self.names):
            if name in TERMS:
                gradient = np.zeros(len(self.names))
                gradient[place], gradient[last] = self.inertia, self.params[place]
                variance = float(gradient @ self.cov @ gradient)
                found[name] = (float(self.params[place]) * self.inertia, math.sqrt(max(variance, 0.0)))
        return found

    def equivalent(self, amplitude: np.ndarray | float) -> dict[str, np.ndarray]:
        """Equivalent linear damping of the whole motion, radiation included, at amplitudes in rad (heave: m).

        Returns
        -------
        dict
            ``omega`` (rad/s), ``alpha`` and ``alpha_sd`` (1/s), ``radiation`` (share of alpha from waves); x'' +
            2 alpha x' + omega^2 x = 0.
        """
        a = np.atleast_1d(np.asarray(amplitude, dtype=float))
        omega, alpha, waves = _equivalent(self.params, self.names, self.memory, a)
        gradient = np.empty((a.size, len(self.names)))
        for place, value in enumerate(self.params):
            step = 1e-6 * max(abs(value), 1e-9)
            moved = self.params.copy()
            moved[place] += step
            gradient[:, place] = (_equivalent(moved, self.names, self.memory, a)[1] - alpha) / step
        variance = np.einsum("ij,jk,ik->i", gradient, self.cov, gradient)
        return {"omega": omega, "alpha": alpha, "alpha_sd": np.sqrt(np.maximum(variance, 0.0)), "radiation": waves}


def _equivalent(
    values: np.ndarray, names: tuple[str, ...], memory: TransferFunction, amplitude: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequency, damping and share of radiation by harmonic balance at the amplitudes."""
    c = dict(zip(names, values))
    inertia = c["inertia"]
    spring = c.get("c1", 0.0) + 0.75 * c.get("c3", 0.0) * amplitude**2 + 0.625 * c.get("c5", 0.0) * amplitude**4
    omega = np.sqrt(np.maximum(spring, 1e-300))
    for _ in range(50):
        omega = np.sqrt(np.maximum(spring, 1e-300) / _effective(memory, omega, inertia))
    mass = _effective(memory, omega, inertia)
    rate = omega * amplitude
    viscous = (
        c.get("b1", 0.0) + 8.0 / (3.0 * math.pi) * rate * c.get("b2", 0.0) + 0.75 * rate**2 * c.get("b3", 0.0)
    )
    waves = memory.damping(omega) / inertia
    total = viscous + waves
    share = np.divide(waves, total, out=np.zeros_like(total), where=total != 0.0)
    return omega, 0.5 * total / mass, share


def _effective(memory: TransferFunction, omega: np.ndarray, inertia: float) -> np.ndarray:
    """Inertia at the frequency over that at infinite frequency."""
    return np.maximum(1.0 + memory.added_mass_difference(omega) / inertia, 1e-6)


def fit_memory_decay(
    time: np.ndarray,
    angle: np.ndarray,
    memory: TransferFunction,
    *,
    inertia: float,
    restoring: float | None = None,
    terms: tuple[str, ...] = ("b1", "b2"),
    free_inertia: bool = False,
    free_restoring: bool = False,
    confidence: float = 0.95,
) -> MemoryDecayFit:
    """Least squares of the simulated decay with memory on a record.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s, from the release, or from any instant at which the waves of the past can be neglected.
    angle : ndarray, shape (n,)
        rad (heave: m), without offset.
    memory : TransferFunction
        Radiation of the same motion at the scale of the record, SI.
    inertia : float
        I + A_inf in kg m2, known, or the start of the search with `free_inertia`.
    restoring : float, optional
        C in N m/rad (heave: N/m), known, or the start of the search with `free_restoring`; from the period of the
        record, and free, when not given.
    terms : tuple of str
        Free terms among b1, b2, b3, c3, c5.
    free_inertia, free_restoring : bool
    confidence : float
        Level of the intervals.

    Returns
    -------
    MemoryDecayFit
        Covariance from residuals that remember (Newey and West), or of the plain model where that is larger.

    Raises
    ------
    FitError
        For a record without two cycles, unknown terms, or a search that finds no decay.
    """
    from scipy.optimize import least_squares

    t, x = np.asarray(time, dtype=float), np.asarray(angle, dtype=float)
    if t.shape != x.shape or t.ndim != 1 or not (np.isfinite(t).all() and np.isfinite(x).all()):
        raise FitError("times and angles of the record do not pair, or are not finite", cure="cut the gaps first")
    strangers = [name for name in terms if name not in TERMS or name == "c1"]
    if strangers:
        raise FitError(f"'{strangers[0]}' is no free term", cure="use b1, b2, b3, c3, c5")
    if not inertia > 0.0:
        raise FitError(f"the inertia {inertia:g} is not positive", cure="give I + A_inf in kg m2")
    period, decrement = _period_and_decrement(t, x)
    rate = 2.0 * math.pi / period
    mass = float(_effective(memory, np.array([rate]), inertia)[0])
    spring = rate**2 * mass if restoring is None else restoring / inertia
    first = {"b1": max(2.0 * decrement * mass - float(memory.damping(np.array([rate]))[0]) / inertia, 1e-6)}
    search = [*terms]
    if restoring is None or free_restoring:
        search.append("c1")
    if free_inertia:
        search.append("inertia")
    top = float(np.abs(x).max())
    # Every unknown is searched in units in which it is of order one.
    unit = {"b1": rate, "b2": 1.0 / top, "b3": 1.0 / (rate * top**2), "c1": spring, "inertia": inertia}
    unit |= {"c3": spring / top**2, "c5": spring / top**4}
    guess = np.array([first.get(name, {"c1": spring, "inertia": inertia}.get(name, 0.0)) for name in search])
    units = np.array([unit[name] for name in search] + [top, top * rate])
    begin = np.concatenate([guess, [x[0], float((x[1] - x[0]) / (t[1] - t[0]))]]) / units

    def read(point: np.ndarray) -> tuple[dict[str, float], float, tuple[float, float]]:
        values = {name: float(value) for name, value in zip(search, point * units)}
        mass = values.pop("inertia", inertia)
        if "c1" not in values:
            values["c1"] = float(restoring or 0.0) / mass
        x0, v0 = point[-2:] * units[-2:]
        return values, mass, (float(x0), float(v0))

    def misses(point: np.ndarray) -> np.ndarray:
        values, mass, start = read(point)
        if not (values["c1"] > 0.0 and mass > 0.0):
            return np.full(t.size, 10.0 * top)
        path = simulate_memory_decay(t, start, values, memory, mass)[:, 0]
        return np.where(np.isfinite(path), path, 10.0 * top) - x

    found = least_squares(misses, begin, jac="3-point", x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-12)
    values, mass, start = read(found.x)
    if not (values["c1"] > 0.0 and mass > 0.0):
        raise FitError(
            "the search ends without a restoring moment", cure="fix inertia and restoring, or check the memory"
        )
    path = simulate_memory_decay(t, start, values, memory, mass)[:, 0]
    unknowns = [*search, "start", "start rate"]
    covariance = _covariance(np.asarray(found.jac) / units, x - path, unknowns)
    names = (*(name for name in TERMS if name in values), "inertia")
    everything = {**values, "inertia": mass}
    full = np.zeros((len(names), len(names)))
    for i, row in enumerate(search):
        for j, column in enumerate(search):
            full[names.index(row), names.index(column)] = covariance[i, j]
    if "c1" not in search and free_inertia:
        _follow_inertia(full, names, float(restoring or 0.0), mass)
    r2 = 1.0 - float(np.sum((x - path) ** 2) / np.sum((x - x.mean()) ** 2))
    result: dict[str, Any] = {
        "names": names,
        "params": np.array([everything[name] for name in names]),
        "cov": full,
        "t_dof": np.full(len(names), float(max(t.size - len(unknowns), 1))),
        "confidence": confidence,
    }
    return MemoryDecayFit(
        **result,
        memory=memory,
        time=t,
        measured=x,
        fitted=path,
        start=start,
        r2=r2,
        converged=bool(found.success),
        findings=tuple(_doubts(everything, np.sqrt(np.diagonal(covariance)), search, r2, bool(found.success))),
    )


def _covariance(jacobian: np.ndarray, residual: np.ndarray, names: list[str]) -> np.ndarray:
    """Of the unknowns, the larger of that for residuals that remember and that for white ones, by each variance."""
    plain = fit_linear(jacobian, residual, names, allow_singular=True).cov
    remembering = fit_linear(jacobian, residual, names, covariance="hac", allow_singular=True).cov
    growth = np.sqrt(np.maximum(np.diagonal(plain) / np.maximum(np.diagonal(remembering), 1e-300), 1.0))
    return remembering * np.outer(growth, growth)


def _follow_inertia(full: np.ndarray, names: tuple[str, ...], restoring: float, inertia: float) -> None:
    """c1 = C/inertia moves with the inertia when the restoring moment is known."""
    c1, last = names.index("c1"), names.index("inertia")
    slope = -restoring / inertia**2
    full[c1], full[:, c1] = slope * full[last], slope * full[:, last]
    full[c1, c1] = slope**2 * full[last, last]


def _doubts(
    values: Mapping[str, float], sd: np.ndarray, search: list[str], r2: float, converged: bool
) -> Iterator[Finding]:
    if not converged:
        yield Finding("no-convergence", "error", "the search did not converge", cure="fix inertia and restoring")
    if not r2 >= _LEAST_R2:
        yield Finding(
            "fit-poor",
            "error",
            f"the simulated decay explains the record with R2 = {r2:.4f}",
            cure="check the window, the unit of the angle, and the scale of the memory",
        )
    for name, error in zip(search, sd):
        if error > _UNCERTAIN * abs(values[name]):
            yield Finding(
                "not-identified",
                "warning",
                f"{name} = {values[name]:.4g} with a standard error of {error:.2g}: the record does not determine it",
                place=name,
                cure="fix it, or compare equivalent damping instead of single terms",
            )


def _period_and_decrement(time: np.ndarray, x: np.ndarray) -> tuple[float, float]:
    """Period (s) from the zero crossings, and rate of decay (1/s) from the largest angle of each half cycle."""
    change = np.flatnonzero(x[:-1] * x[1:] < 0.0)
    if change.size < 4:
        raise FitError("the record has fewer than two cycles", cure="take a longer record, or remove its offset")
    crossings = time[change] - x[change] * (time[change + 1] - time[change]) / (x[change + 1] - x[change])
    period = 2.0 * float(np.polyfit(np.arange(crossings.size), crossings, 1)[0])
    tops = np.array([np.abs(x[a + 1 : b + 1]).max() for a, b in pairwise(change)])
    slope = float(np.polyfit(0.5 * period * np.arange(tops.size), np.log(tops), 1)[0])
    return period, -slope
