"""Integration fit: the equation of motion is integrated and fitted to the record (shooting)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .coloured_noise import ColouredNoise
from .damping_models import DAMPING_TERMS, DampingModel, split_speed_term
from .decay_record import DecayRecord
from .derivation_fit import derive, fit_equation
from .fit_assessment import as_records, assess, record_noise, require_speeds
from .fit_diagnostics import FittedRun
from .resimulation import Simulated, Start, first_values, simulate_record
from .roll_damping import RollDamping

MOST_ITERATIONS = 150
# The search has converged when a step would lower the sum of squares by less than this part of it.
GAIN_TOLERANCE = 1e-12
# Two starts agree when their sums of squares differ by less than this part.
SAME_COST = 1e-6
LARGEST_DAMPING_FACTOR = 1e12


@dataclass
class Point:
    """One set of parameters with the sum of squares and the triangular factor of its linearisation."""

    parameters: np.ndarray
    cost: float
    triangle: np.ndarray
    right: np.ndarray
    simulated: list[Simulated]


class Shooting:
    """Sum of squares of several records as a function of shared terms and the initial values of each.

    Parameters
    ----------
    records : sequence of DecayRecord
    model : DampingModel
    start : {"free", "measured"}
    offset : bool
        Whether each record has a rest position of its own.
    """

    def __init__(self, records: Sequence[DecayRecord], model: DampingModel, start: Start, offset: bool) -> None:
        self.records = list(records)
        self.model = model
        self.own = [*([6, 7] if start == "free" else []), *([8] if offset else [])]
        self.shared = len(model.free)
        self.spread = [model.spread(one.speed) for one in self.records]
        self.free = [i for i, name in enumerate(model.names) if name not in model.fixed]
        self.known = np.array([model.fixed.get(name, 0.0) for name in model.names])
        self.first = [first_values(one) for one in self.records]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the shared parameters."""
        return self.model.free

    def initial(self, values: Mapping[str, float]) -> np.ndarray:
        """Parameters from values of the free terms, the first values of the records, and no offsets."""
        shared = [values[name] for name in self.names]
        own = [np.array([*first, 0.0])[np.array(self.own, dtype=int) - 6] for first in self.first]
        return np.concatenate([np.array(shared, dtype=float), *own])

    def coefficients(self, parameters: np.ndarray, record: int) -> np.ndarray:
        """b1 ... c5 at the speed of a record."""
        values = self.known.copy()
        values[self.free] = parameters[: self.shared]
        return self.spread[record] @ values

    def state(self, parameters: np.ndarray, record: int) -> np.ndarray:
        """Initial coordinate, velocity and offset of a record."""
        state = np.array([*self.first[record], 0.0])
        if self.own:
            begin = self.shared + record * len(self.own)
            state[np.array(self.own) - 6] = parameters[begin : begin + len(self.own)]
        return state

    def simulate(self, parameters: np.ndarray, record: int) -> Simulated | None:
        """A record simulated with its gradients; None where the motion diverges or nothing restores."""
        values = self.coefficients(parameters, record)
        if not (np.isfinite(values).all() and values[3] > 0.0):
            return None
        x0, v0, rest = self.state(parameters, record)
        return simulate_record(self.records[record], self.model, values, (x0, v0), rest)

    def gradient(self, simulated: Simulated, record: int) -> np.ndarray:
        """Gradient of a record by the shared terms and its own values, shape (n, q)."""
        terms = simulated.gradient[:, :6] @ self.spread[record][:, self.free]
        return np.hstack([terms, simulated.gradient[:, self.own]])

    def at(self, parameters: np.ndarray) -> Point | None:
        """The linearised problem at some parameters; None where a motion diverges or nothing restores."""
        own = len(self.own)
        size = self.shared + own * len(self.records)
        triangles, rights, cost, paths = [], [], 0.0, []
        for k, record in enumerate(self.records):
            simulated = self.simulate(parameters, k)
            if simulated is None:
                return None
            residual = record.value - simulated.value
            cost += float(residual @ residual)
            factor: np.ndarray = np.linalg.qr(  # type: ignore[assignment]
                np.column_stack([self.gradient(simulated, k), residual]), mode="r"
            )
            wide = np.zeros((factor.shape[0], size))
            wide[:, : self.shared] = factor[:, : self.shared]
            begin = self.shared + k * own
            wide[:, begin : begin + own] = factor[:, self.shared : self.shared + own]
            triangles.append(wide)
            rights.append(factor[:, -1])
            paths.append(simulated)
        return Point(parameters, cost, np.vstack(triangles), np.concatenate(rights), paths)


def search(problem: Shooting, parameters: np.ndarray) -> tuple[Point, bool] | None:
    """Levenberg-Marquardt from some parameters: the best point, and whether it converged; None for a bad start."""
    point = problem.at(parameters)
    if point is None:
        return None
    damping = 1e-3
    for _ in range(MOST_ITERATIONS):
        norms = np.linalg.norm(point.triangle, axis=0)
        scale = 1.0 / np.where(norms > 0.0, norms, 1.0)
        scaled = point.triangle * scale
        full = np.linalg.lstsq(scaled, point.right, rcond=None)[0]
        promised = float(np.sum((scaled @ full) ** 2))
        if promised <= GAIN_TOLERANCE * point.cost or point.cost <= 1e-28:
            return point, True
        while True:
            rows = np.vstack([scaled, np.sqrt(damping) * np.eye(scale.size)])
            step = np.linalg.lstsq(rows, np.concatenate([point.right, np.zeros(scale.size)]), rcond=None)[0]
            trial = problem.at(point.parameters + scale * step)
            if trial is not None and trial.cost < point.cost:
                point, damping = trial, max(0.1 * damping, 1e-15)
                break
            damping *= 10.0
            if damping > LARGEST_DAMPING_FACTOR:
                # No step lowers the sum of squares any more: rounding, or a corner.
                return point, promised <= 1e-6 * point.cost
    return point, False


def starting_values(records: Sequence[DecayRecord], model: DampingModel) -> list[tuple[str, dict[str, float]]]:
    """Values to start a search from: the derivation fit, and the whole loss put into one damping term each."""
    starts: list[tuple[str, dict[str, float]]] = []
    try:
        linear = fit_equation(records, [derive(one) for one in records], model)
        starts.append(("derivation", dict(zip(model.free, map(float, linear.params)))))
    except FitError:
        # The other starts do without derivatives.
        pass
    first = records[0]
    swings = first.extremes.half_swing
    omega = 2.0 * np.pi / (2.0 * float(np.mean(np.diff(first.extremes.time))))
    loss = max(float(np.log(swings[0] / swings[-1])) / max(swings.size - 1, 1) * omega / np.pi, 1e-6)
    middle = float(np.sqrt(swings[0] * swings[-1]))
    whole = {
        "b1": 2.0 * loss,
        "b2": loss * 3.0 * np.pi / (4.0 * omega * middle),
        "b3": loss * 8.0 / (3.0 * (omega * middle) ** 2),
        "c1": omega**2,
    }
    for only in [name for name in model.free if name in DAMPING_TERMS] or ["c1"]:
        values = {
            name: whole[name] if name in (only, "c1") and split_speed_term(name)[1] == 0 else 0.0
            for name in model.free
        }
        starts.append((f"all loss in {only}", values))
    return starts


def fit_integration(
    records: DecayRecord | Sequence[DecayRecord],
    model: DampingModel | None = None,
    *,
    start_values: Mapping[str, float] | None = None,
    starts: int = 3,
    start: Start = "free",
    offset: bool = True,
    white: bool = False,
) -> RollDamping:
    """Fit the integrated equation of motion to the records.

    Levenberg-Marquardt with the sensitivity equations as Jacobian, from several starts: the derivation fit first, then
    the whole loss in one damping term each. The covariance takes the autocorrelation of the residuals into account.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts. The terms are shared, initial values and rest position belong to each record.
    model : DampingModel, optional
        Linear plus quadratic damping when not given.
    start_values : mapping, optional
        Values of the free terms to start from, alone.
    starts : int
        Number of starts tried when no values are given.
    start : {"free", "measured"}
        Whether the initial coordinate and velocity are fitted, or read from the record.
    offset : bool
        Whether a rest position is fitted to each record.
    white : bool
        Take the residuals for independent in the covariance.

    Raises
    ------
    FitError
        If no start leads to a motion that explains the records, or the terms cannot be separated at all.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    problem = Shooting(runs, chosen, start, offset)
    if start_values is not None:
        missing = [name for name in chosen.free if name not in start_values]
        if missing:
            raise FitError(f"start_values lack {missing[0]}", cure="give all free terms of the model")
        tried = [("given", dict(start_values))]
    else:
        tried = starting_values(runs, chosen)[: max(starts, 1)]
    found: list[tuple[str, Point, bool]] = []
    for name, values in tried:
        outcome = search(problem, problem.initial(values))
        if outcome is not None:
            found.append((name, *outcome))
    if not found:
        raise FitError(
            "from every start the integrated motion diverges",
            cure="check the record and the model, or give start_values",
            file=runs[0].source or None,
            place=runs[0].name,
        )
    label, best, converged = min(found, key=lambda one: one[1].cost)
    agreeing = sum(one[1].cost <= best.cost * (1.0 + SAME_COST) + 1e-24 for one in found)
    end = linearised(problem, best, white=white)
    return assess(
        "integration",
        runs,
        chosen,
        dict(zip(chosen.free, map(float, best.parameters))),
        end.covariance,
        end.runs,
        end.noise,
        converged=converged,
        condition=end.condition,
        details={"start": label, "starts": len(found), "starts that agree": agreeing},
        choices={"initial values": start, "offset": offset, "residuals": "white" if white else "autocorrelated"},
    )


@dataclass(frozen=True, eq=False)
class Linearised:
    """The end of a search: the records simulated there, and what their noise does to the shared parameters.

    Attributes
    ----------
    runs : tuple of FittedRun
    noise : ColouredNoise
    covariance : ndarray, shape (q, q)
        Of the shared parameters.
    condition : float
        Condition number of the scaled problem.
    """

    runs: tuple[FittedRun, ...]
    noise: ColouredNoise
    covariance: np.ndarray
    condition: float


def linearised(problem: Shooting, best: Point, *, white: bool = False) -> Linearised:
    """Covariance of the shared parameters where a search ended.

    Parameters
    ----------
    problem : Shooting
    best : Point
    white : bool
        Take the residuals for independent.

    Raises
    ------
    FitError
        If the records cannot separate the parameters.
    """
    count, own = problem.shared, len(problem.own)
    norms = np.linalg.norm(best.triangle, axis=0)
    singular = np.linalg.svd(best.triangle / np.where(norms > 0.0, norms, 1.0), compute_uv=False)
    condition = float(singular[0] / singular[-1]) if singular[-1] > 0.0 else np.inf
    if not condition < 1e12:
        raise FitError(
            f"the record cannot separate {', '.join(problem.names)} (condition number {condition:.2g})",
            cure="use fewer terms, or a record with a larger span of amplitudes",
            file=problem.records[0].source or None,
            place=problem.records[0].name,
        )
    # Columns of length one: the unknowns differ by many powers of ten.
    scale = 1.0 / np.where(norms > 0.0, norms, 1.0)
    scaled = best.triangle * scale
    inverse = np.linalg.pinv(scaled.T @ scaled, hermitian=True) * np.outer(scale, scale)
    simulated, influences, gradients = [], [], []
    for k, (record, path) in enumerate(zip(problem.records, best.simulated)):
        x0, v0, rest = problem.state(best.parameters, k)
        simulated.append(
            FittedRun(
                record.name,
                record.time,
                record.value,
                path.value,
                (float(x0), float(v0)),
                float(rest),
                record.speed,
            )
        )
        columns = [*range(count), *range(count + k * own, count + (k + 1) * own)]
        gradients.append(problem.gradient(path, k))
        influences.append(inverse[:count][:, columns] @ gradients[-1].T)
    noise = record_noise(problem.records, simulated, gradients, left_over=False)
    covariance = noise.white_floor(influences) if white else noise.covariance(influences)
    return Linearised(tuple(simulated), noise, covariance, condition)
