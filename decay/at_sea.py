"""Roll equation from the response at sea alone: one ship, and an unknown excitation of its own for each oscillation.

``phi'' + b1 phi' + b3 phi'^3 + c1 phi + c3 phi^3 + c5 phi^5 = f sin(we t + phase) + f0``. The terms of the ship are
shared by all oscillations of the record; f, we, phase, f0 and the state at its begin belong to each. All are fitted
together to the measured angle (shooting), the ship's part after each oscillation's own unknowns are projected out, so
that what is left of a term's effect tells how far the record identifies it at all. The sum of squares has hollows;
the search is made several times, from bold to cautious, and the lowest is taken.

One oscillation that is nearly harmonic determines a mean, an amplitude and a phase. Nine numbers cannot be had from
it: c1 trades with f and we, b1 with the phase. Such a request is refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..identify.coefficient_table import CoefficientTable
from ..identify.regression import fit_linear
from .damping_models import TERMS
from .excited_roll import harmonic_motion, integrate_excited, longest_step, needed_excitation
from .oscillations import Oscillation, split_oscillations

if TYPE_CHECKING:
    import pandas as pd

SHIP_TERMS = ("b1", "b3", "c1", "c3", "c5")
OWN = ("sine", "cosine", "we", "f0", "start", "start rate")
"""Unknowns of each oscillation."""

_UNCERTAIN = 0.5
_LITTLE = 1e-4
_PASSES = 60
_DIFFERENCE = 1e-5
_CAUTION = (1e-3, 1.0, 10.0)
"""Damping that the searches begin with, from bold to cautious."""

_SAME = 0.01
_EXACT = 1e-20


@dataclass(frozen=True, eq=False)
class AtSeaFit(CoefficientTable):
    """Terms of the ship from a record at sea.

    Beside the attributes of a :class:`~towtank.identify.coefficient_table.CoefficientTable`.

    Attributes
    ----------
    excitations : DataFrame
        One row an oscillation: ``start`` and ``period`` (s), ``amplitude_deg``, ``f`` and ``f0`` (rad/s2), ``we``
        (rad/s), ``phase`` (rad).
    own_share : dict of str to float
        For each term, the share of its effect on the angle that no excitation or initial state of an oscillation
        can imitate; near zero means that the record says nothing about the term.
    condition_number : float
        Of what is left of the terms' effects, in columns of unit length.
    fitted : ndarray, shape (n,)
        Fitted angle in rad; nan outside the oscillations.
    r2 : float
    amplitude_error : ndarray, shape (m,)
        (fitted - measured) amplitude over the measured one, of each oscillation: the score of the paper.
    passes : int
    converged : bool
    findings : tuple of Finding
    """

    excitations: pd.DataFrame
    own_share: dict[str, float]
    condition_number: float
    fitted: np.ndarray
    r2: float
    amplitude_error: np.ndarray
    passes: int
    converged: bool
    findings: tuple[Finding, ...]


def fit_roll_at_sea(
    time: np.ndarray,
    angle: np.ndarray,
    *,
    guess: Mapping[str, float],
    terms: Sequence[str] = SHIP_TERMS,
    noise: float = 0.0,
    level: float | None = None,
    least_amplitude: float = 0.0,
    confidence: float = 0.95,
) -> AtSeaFit:
    """Joint fit of the ship's terms and of an excitation for each oscillation.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        Record in s and rad.
    guess : mapping of str to float
        Rough values of the terms per unit inertia, SI; terms that are not among `terms` keep theirs.
    terms : sequence of str
        Shared terms that are fitted.
    noise : float
        Standard deviation of the angle's noise in rad, for the count of what an oscillation determines.
    level : float, optional
        Angle in rad whose upward crossings part the oscillations; the mean of the record when not given.
    least_amplitude : float
        Oscillations below this (rad) are left out.
    confidence : float
        Level of the intervals.

    Raises
    ------
    FitError
        When the oscillations together determine fewer numbers than are asked for, with both counts; for an unknown
        term, a guess without c1, or a record without oscillations.
    """
    import pandas as pd

    strangers = [name for name in (*terms, *guess) if name not in TERMS]
    if strangers:
        raise FitError(f"there is no term '{strangers[0]}'", cure=f"terms are {', '.join(TERMS)}")
    if not guess.get("c1", 0.0) > 0.0:
        raise FitError("the search needs a rough c1", cure="give guess = {'c1': (2 pi / roll period)^2, ...}")
    t, x = np.asarray(time, dtype=float), np.asarray(angle, dtype=float)
    oscillations = split_oscillations(t, x, level=level, least_amplitude=least_amplitude)
    require_identifiable(oscillations, len(terms), noise)
    problem = _Joint(t, x, oscillations, guess, terms)
    passes, converged, agreeing = problem.solve()
    left, residual, groups = problem.projected()
    fit = fit_linear(left, residual, list(terms), covariance="hac", groups=groups, allow_singular=True)
    scale = problem.units
    effects = np.sqrt(problem.effects)
    share = np.divide(np.einsum("ij,ij->j", left, left), effects**2, out=np.zeros(len(terms)), where=effects > 0.0)
    fitted = problem.fitted()
    inside = np.isfinite(fitted)
    r2 = 1.0 - float(np.sum((x - fitted)[inside] ** 2) / np.sum((x[inside] - x[inside].mean()) ** 2))
    params = problem.ship * scale
    cov = fit.cov * np.outer(scale, scale)
    own = dict(zip(terms, share.tolist()))
    return AtSeaFit(
        names=tuple(terms),
        params=params,
        cov=cov,
        # Each oscillation is one draw of the sea.
        t_dof=np.full(len(terms), float(max(len(oscillations) - 1, 1))),
        confidence=confidence,
        excitations=pd.DataFrame(problem.rows()),
        own_share=own,
        condition_number=fit.condition_number,
        fitted=fitted,
        r2=r2,
        amplitude_error=np.array(
            [0.5 * float(np.ptp(fitted[item.rows])) / item.amplitude - 1.0 for item in oscillations]
        ),
        passes=passes,
        converged=converged,
        findings=tuple(_doubts(terms, params, np.sqrt(np.diagonal(cov)), own, converged, agreeing)),
    )


def term_sizes(stiffness: float, amplitude: float) -> dict[str, float]:
    """Sizes in which each term is of order one at an amplitude in rad, for a c1 of `stiffness`."""
    rate = math.sqrt(stiffness)
    sizes = {"b1": rate, "b2": 1.0 / amplitude, "b3": 1.0 / (rate * amplitude**2), "c1": stiffness}
    return sizes | {"c3": stiffness / amplitude**2, "c5": stiffness / amplitude**4}


def require_identifiable(oscillations: Sequence[Oscillation], terms: int, noise: float) -> None:
    """Refuse a record whose oscillations determine fewer numbers than are asked for.

    Raises
    ------
    FitError
        With both counts.
    """
    asked = terms + 4 * len(oscillations)
    offered = sum(item.determines(noise) for item in oscillations)
    if offered < asked:
        one = len(oscillations) == 1
        which = (
            "one near-harmonic oscillation determines" if one else f"{len(oscillations)} oscillations determine"
        )
        raise FitError(
            f"{asked} parameters are asked of a record in which {which} {offered} numbers (mean, and amplitude and "
            "phase of each harmonic): c1 trades with f and we, b1 with the phase",
            cure="fix terms, give more and more violent oscillations, or use the random decrement",
        )


def _doubts(
    terms: Sequence[str],
    values: np.ndarray,
    sd: np.ndarray,
    own: Mapping[str, float],
    converged: bool,
    agreeing: int,
) -> Iterator[Finding]:
    if not converged:
        yield Finding("no-convergence", "error", "the joint fit did not converge", cure="give a better guess")
    if agreeing < 2:
        yield Finding(
            "several-minima",
            "warning",
            f"{len(_CAUTION)} searches ended in different places; the lowest may not be the lowest there is",
            cure="give a better guess, and compare",
        )
    for name, value, error in zip(terms, values, sd):
        if own[name] < _LITTLE or not error <= _UNCERTAIN * abs(value):
            yield Finding(
                "not-identified",
                "warning",
                f"{name} = {value:.4g} with a standard error of {error:.2g}; {own[name]:.1e} of its effect cannot be "
                "imitated by the excitations",
                place=name,
                cure="do not use the term by itself; fix it from a decay test",
            )


class _Joint:
    """Levenberg and Marquardt's method on the shared terms, each oscillation's own unknowns eliminated by QR."""

    def __init__(
        self,
        time: np.ndarray,
        angle: np.ndarray,
        oscillations: Sequence[Oscillation],
        guess: Mapping[str, float],
        terms: Sequence[str],
    ) -> None:
        self.time, self.angle, self.oscillations = time, angle, oscillations
        self.places = [TERMS.index(name) for name in terms]
        self.base = np.array([guess.get(name, 0.0) for name in TERMS], dtype=float)
        sizes = term_sizes(self.base[3], max(item.amplitude for item in oscillations))
        self.units = np.array([sizes[name] for name in terms])
        self.ship = self.base[self.places] / self.units
        self.own = [self._first_guess(item) for item in oscillations]
        self.effects = np.zeros(len(terms))

    def _first_guess(self, item: Oscillation) -> np.ndarray:
        """Excitation that the guess of the ship needs, by least squares of the equation of motion."""
        t = self.time[item.rows] - self.time[item.rows.start]
        x = self.angle[item.rows]
        omega = 2.0 * math.pi / item.period
        motion = harmonic_motion(t, x, omega)
        sine, cosine, bias = needed_excitation(t, motion, self.base, omega)
        c1 = self.base[3]
        force = max(float(np.hypot(sine, cosine)), 1e-3 * c1 * item.amplitude)
        units = np.array([force, force, omega, force, item.amplitude, item.amplitude * omega])
        return np.vstack([np.array([sine, cosine, omega, bias, x[0], motion[1][0]]) / units, units])

    def _path(self, item: Oscillation, ship: np.ndarray, own: np.ndarray) -> np.ndarray:
        c = self.base.copy()
        c[self.places] = ship * self.units
        e = own[0] * own[1]
        t = np.ascontiguousarray(self.time[item.rows])
        with np.errstate(over="ignore", invalid="ignore"):
            path = integrate_excited(t, e[4:].copy(), c, e[:4].copy(), longest_step(c[3], e[2]))[:, 0]
        return np.where(np.isfinite(path), path, 1e3)

    def _cost(self, ship: np.ndarray, own: Sequence[np.ndarray]) -> float:
        return sum(
            float(np.sum((self.angle[item.rows] - self._path(item, ship, mine)) ** 2))
            for item, mine in zip(self.oscillations, own)
        )

    def _linearised(self, item: Oscillation, own: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Residual, and its (negative) Jacobians by the ship and by the oscillation's own unknowns."""
        residual = self.angle[item.rows] - self._path(item, self.ship, own)
        by_ship = np.empty((residual.size, self.ship.size))
        for j in range(self.ship.size):
            step = np.zeros(self.ship.size)
            step[j] = _DIFFERENCE
            by_ship[:, j] = self._path(item, self.ship + step, own) - self._path(item, self.ship - step, own)
        by_own = np.empty((residual.size, len(OWN)))
        for j in range(len(OWN)):
            up, down = own.copy(), own.copy()
            up[0, j] += _DIFFERENCE
            down[0, j] -= _DIFFERENCE
            by_own[:, j] = self._path(item, self.ship, up) - self._path(item, self.ship, down)
        return residual, by_ship / (2.0 * _DIFFERENCE), by_own / (2.0 * _DIFFERENCE)

    def solve(self) -> tuple[int, bool, int]:
        """Passes of the best search, whether it converged, and how many searches ended where it did."""
        begin = self.ship, self.own
        exact = _EXACT * float(np.sum(self.angle**2))
        ends = []
        for caution in _CAUTION:
            self.ship, self.own = begin
            ends.append((*self._descend(caution), self.ship, self.own))
            if ends[-1][0] <= exact:
                # Nothing can be lower than a record that is explained to rounding.
                agreeing = len(_CAUTION)
                break
        else:
            lowest = min(end[0] for end in ends)
            agreeing = sum(end[0] <= (1.0 + _SAME) * lowest for end in ends)
        _, passes, converged, self.ship, self.own = min(ends, key=lambda end: end[0])
        return passes, converged, agreeing

    def _descend(self, damping: float) -> tuple[float, int, bool]:
        """Sum of squares at the end, passes taken, and whether the last improvement was negligible."""
        cost = self._cost(self.ship, self.own)
        floor = 1e-26 * float(np.sum(self.angle**2))
        for number in range(1, _PASSES + 1):
            blocks = [self._linearised(item, own) for item, own in zip(self.oscillations, self.own)]
            while True:
                ship, own = self._step(blocks, damping)
                trial = self._cost(ship, own)
                if trial < cost or damping > 1e12:
                    break
                damping *= 8.0
            if not trial < cost:
                return cost, number, True
            gain = (cost - trial) / cost
            self.ship, self.own, cost = ship, own, trial
            damping = max(damping / 10.0, 1e-14)
            if gain < 1e-9 or cost <= floor:
                return cost, number, True
        return cost, _PASSES, False

    def _step(
        self, blocks: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]], damping: float
    ) -> tuple[np.ndarray, list[np.ndarray]]:
        kept, rows, targets = [], [], []
        root = math.sqrt(damping)
        for residual, by_ship, by_own in blocks:
            length = np.sqrt(np.einsum("ij,ij->j", by_own, by_own))
            q, r = np.linalg.qr(np.vstack([by_own, np.diag(root * np.maximum(length, 1e-12))]))
            padded = np.vstack([by_ship, np.zeros((len(OWN), by_ship.shape[1]))])
            target = np.concatenate([residual, np.zeros(len(OWN))])
            kept.append((q, r, padded, target))
            rows.append(padded - q @ (q.T @ padded))
            targets.append(target - q @ (q.T @ target))
        left = np.vstack(rows)
        length = np.sqrt(np.einsum("ij,ij->j", left, left))
        left = np.vstack([left, np.diag(root * np.maximum(length, 1e-12))])
        move = np.linalg.lstsq(left, np.concatenate([*targets, np.zeros(self.ship.size)]), rcond=None)[0]
        own = []
        for (q, r, padded, target), mine in zip(kept, self.own):
            shift = np.linalg.solve(r, q.T @ (target - padded @ move))
            own.append(np.vstack([mine[0] + shift, mine[1]]))
        return self.ship + move, own

    def projected(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """What is left of the ship's effects and of the residual, and the oscillation of each row."""
        rows, targets, groups = [], [], []
        self.effects = np.zeros(self.ship.size)
        for number, (item, own) in enumerate(zip(self.oscillations, self.own)):
            residual, by_ship, by_own = self._linearised(item, own)
            self.effects += np.einsum("ij,ij->j", by_ship, by_ship)
            q = np.linalg.qr(by_own)[0]
            rows.append(by_ship - q @ (q.T @ by_ship))
            targets.append(residual - q @ (q.T @ residual))
            groups.append(np.full(residual.size, number))
        return np.vstack(rows), np.concatenate(targets), np.concatenate(groups)

    def fitted(self) -> np.ndarray:
        """Fitted angle at every sample; nan outside the oscillations."""
        values = np.full(self.time.size, math.nan)
        for item, own in zip(self.oscillations, self.own):
            values[item.rows] = self._path(item, self.ship, own)
        return values

    def rows(self) -> Iterator[dict[str, float]]:
        """Excitation of each oscillation."""
        for item, own in zip(self.oscillations, self.own):
            sine, cosine, frequency, bias = (own[0] * own[1])[:4]
            yield {
                "start": float(self.time[item.rows.start]),
                "period": item.period,
                "amplitude_deg": math.degrees(item.amplitude),
                "f": float(np.hypot(sine, cosine)),
                "we": float(frequency),
                "phase": float(np.arctan2(cosine, sine)),
                "f0": float(bias),
            }
