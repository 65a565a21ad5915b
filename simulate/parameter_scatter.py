"""What is uncertain about a vessel: named numbers with their covariance, and draws of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..core.errors import SimulationError
from .random_draws import Sampling, standard_normals
from .vessel import Vessel

FloatArray = np.ndarray

HULL = "hull"
"""Stands for all hull derivatives in a list of names."""

MMG_COEFFICIENTS = (
    "propeller.wP0",
    "propeller.tP",
    "rudder.tR",
    "rudder.aH",
    "rudder.xH",
    "rudder.gammaR_positive",
    "rudder.gammaR_negative",
    "rudder.lR",
    "rudder.eps",
    "rudder.kappa",
    "rudder.f_alpha",
)
"""Coefficients of propeller and rudder that captive tests of the MMG standard method determine beside the hull's."""


@dataclass(frozen=True, eq=False)
class ParameterScatter:
    """Uncertain numbers of a vessel.

    Attributes
    ----------
    names : tuple of str
        Hull derivatives (``"Yv"``) and other numbers (``"rudder.eps"``).
    center : ndarray, shape (p,)
        Values of the unperturbed vessel.
    covariance : ndarray, shape (p, p)
    source : str
        Where the scatter comes from.
    """

    names: tuple[str, ...]
    center: FloatArray
    covariance: FloatArray
    source: str = ""

    @property
    def sd(self) -> FloatArray:
        """Standard deviations, shape (p,)."""
        return np.sqrt(np.clip(np.diag(self.covariance), 0.0, None))

    @property
    def independent(self) -> bool:
        """True when no two numbers are correlated."""
        return not np.any(self.covariance - np.diag(np.diag(self.covariance)))

    def draws(self, n: int, seed: int = 0, sampling: Sampling = "random") -> FloatArray:
        """Draws from the joint normal distribution, shape (n, p); see :func:`standard_normals`."""
        normals = standard_normals(n, len(self.names), seed, sampling)
        if self.independent:
            return self.center + normals * self.sd
        root = semidefinite_root(self.covariance, self.names)
        values = np.tile(self.center, (n, 1))
        # summed column by column: a matrix product may round otherwise for another number of rows
        for column in range(len(self.names)):
            values += normals[:, column, None] * root[:, column]
        return values


def scatter_of(
    vessel: Vessel,
    *,
    covariance: FloatArray | bool | None = None,
    percent: float | Mapping[str, float] | None = None,
    names: Sequence[str] | None = None,
) -> ParameterScatter:
    """Scatter of a vessel's numbers.

    Parameters
    ----------
    vessel : Vessel
    covariance : ndarray of shape (terms, terms) or bool, optional
        Covariance of the hull derivatives, in their order and conventions; True, or no `percent` either: that of the
        set itself.
    percent : float or mapping of str to float, optional
        Standard deviation in per cent of the value, independent for each number: one for all `names`, or one for each
        by name. Together with a covariance it is that of numbers beside the hull.
    names : sequence of str, optional
        What `percent` applies to; ``"hull"`` stands for all hull derivatives, added masses included. The default is
        the hull, or with a covariance the coefficients of propeller and rudder (`MMG_COEFFICIENTS`). Of these groups
        numbers that are 0 are left out.

    Raises
    ------
    SimulationError
        For a set without covariance, a matrix that is none, an unknown name, or per cent of a number that is 0.
    """
    hull = vessel.hull
    correlated = covariance is not None and covariance is not False
    if not correlated and percent is None:
        correlated = True
        if hull.covariance is None:
            raise SimulationError(
                f"set '{hull.name}' has no covariance to draw from",
                cure="give percent=5 for independent scatter, or a covariance of the hull derivatives",
            )
    picked: tuple[str, ...] = ()
    matrix = np.zeros((0, 0))
    sources = []
    if correlated:
        given = hull.covariance if covariance is None or covariance is True else covariance
        matrix = _checked_covariance(given, vessel)
        uncertain = np.flatnonzero(np.diag(matrix) > 0.0)
        picked = tuple(hull.names[i] for i in uncertain)
        matrix = matrix[np.ix_(uncertain, uncertain)]
        sources.append(f"covariance of '{hull.name}'" if given is hull.covariance else "covariance that was given")
    if percent is not None:
        shares = _percentages(vessel, percent, names, beside=correlated)
        twice = [name for name in shares if name in picked]
        if twice:
            raise SimulationError(
                f"{', '.join(twice)} would scatter by the covariance and by a percentage",
                cure="leave one of them out",
            )
        values = np.array([value_of(vessel, name) for name in shares])
        variances = np.square(values * np.array(list(shares.values())) / 100.0)
        size = len(picked)
        matrix = np.pad(matrix, (0, len(shares)))
        matrix[size:, size:] = np.diag(variances)
        picked += tuple(shares)
        sources += _percentage_words(shares)
    if not picked:
        raise SimulationError("nothing of the vessel scatters", cure="give a percentage above 0 or names")
    center = np.array([value_of(vessel, name) for name in picked])
    return ParameterScatter(picked, center, matrix, "; ".join(sources))


def value_of(vessel: Vessel, name: str) -> float:
    """A hull derivative, or another number by its name (:meth:`Vessel.parameter_names`).

    Raises
    ------
    SimulationError
        For a name that the vessel does not have.
    """
    if name in vessel.hull:
        return vessel.hull[name]
    if name not in vessel.parameter_names():
        raise SimulationError(
            f"'{vessel.name}' has no number '{name}'",
            cure=f"it has {', '.join((*vessel.hull.names, *vessel.parameter_names()))}",
        )
    part, item = name.split(".")
    return float(getattr(getattr(vessel, part), item))


def split_draws(
    vessel: Vessel, names: Sequence[str], rows: FloatArray
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Draws as the kernel takes them: values of all hull derivatives, shape (n, terms), and other numbers by name."""
    hull = np.tile(vessel.hull.values, (len(rows), 1))
    beside = {}
    for column, name in enumerate(names):
        if name in vessel.hull:
            hull[:, vessel.hull.names.index(name)] = rows[:, column]
        else:
            beside[name] = np.ascontiguousarray(rows[:, column])
    return hull, beside


def vessel_of_draw(vessel: Vessel, names: Sequence[str], row: FloatArray) -> Vessel:
    """The vessel with the numbers of one draw, shape (p,)."""
    drawn = dict(zip(names, (float(value) for value in row), strict=True))
    hull = {name: value for name, value in drawn.items() if name in vessel.hull}
    parts: dict[str, dict[str, float]] = {}
    for name, value in drawn.items():
        if name not in hull:
            part, item = name.split(".")
            parts.setdefault(part, {})[item] = value
    changes: dict[str, Any] = {part: replace(getattr(vessel, part), **items) for part, items in parts.items()}
    values = vessel.hull.values.copy()
    for name, value in hull.items():
        values[vessel.hull.names.index(name)] = value
    return vessel.but(hull=replace(vessel.hull, values=values), **changes)


def semidefinite_root(covariance: FloatArray, names: Iterable[str]) -> FloatArray:
    """Lower triangular root of a covariance, ``root @ root.T``; columns of 0 where a number follows from others.

    Raises
    ------
    SimulationError
        When the matrix is not positive semi-definite, with the number at which it shows.
    """
    sd = np.sqrt(np.diag(covariance))
    scale = np.where(sd > 0.0, sd, 1.0)
    rest = covariance / np.outer(scale, scale)
    root = np.zeros_like(rest)
    for column, name in enumerate(names):
        pivot = rest[column, column]
        rounding = 1e-10
        dependent = pivot <= rounding
        if pivot < -rounding or (dependent and np.any(np.abs(rest[column:, column]) > 1e-4)):
            raise SimulationError(
                f"the covariance is not positive semi-definite (seen at {name})",
                cure="check its order and its units",
            )
        if not dependent:
            root[:, column] = rest[:, column] / np.sqrt(pivot)
            rest = rest - np.outer(root[:, column], root[:, column])
    return root * scale[:, None]


def _checked_covariance(given: Any, vessel: Vessel) -> FloatArray:
    hull = vessel.hull
    if given is None:
        raise SimulationError(f"set '{hull.name}' has no covariance to draw from", cure="give one, or percentages")
    matrix = np.asarray(given, dtype=float)
    if matrix.shape != (len(hull), len(hull)):
        raise SimulationError(
            f"a covariance of shape {matrix.shape} for the {len(hull)} derivatives of '{hull.name}'",
            cure=f"give a square matrix in the order {', '.join(hull.names)}",
        )
    if not np.all(np.isfinite(matrix)):
        unknown = [name for name, row in zip(hull.names, matrix, strict=True) if not np.all(np.isfinite(row))]
        raise SimulationError(
            f"the covariance of {', '.join(unknown)} is not a number", cure="put 0 where a value is taken as exact"
        )
    size = np.sqrt(np.abs(np.diag(matrix)))
    if np.any(np.abs(matrix - matrix.T) > 1e-9 * np.outer(size, size)):
        raise SimulationError("the covariance is not symmetric", cure="check the order of its rows and columns")
    return 0.5 * (matrix + matrix.T)


def _percentages(
    vessel: Vessel, percent: float | Mapping[str, float], names: Sequence[str] | None, beside: bool
) -> dict[str, float]:
    """Per cent by name, groups resolved."""
    if isinstance(percent, Mapping):
        if names is not None:
            raise SimulationError("percentages by name need no further names", cure="leave names out")
        wanted = dict(percent)
    elif names is not None:
        wanted = dict.fromkeys(names, float(percent))
    elif beside:
        known = vessel.parameter_names()
        wanted = {
            name: float(percent) for name in MMG_COEFFICIENTS if name in known and value_of(vessel, name) != 0.0
        }
    else:
        wanted = {HULL: float(percent)}
    found: dict[str, float] = {}
    for name, share in wanted.items():
        if not share >= 0.0:
            raise SimulationError(f"{share} per cent of {name} is no standard deviation")
        if name == HULL:
            found |= {term: share for term in vessel.hull.names if vessel.hull[term] != 0.0 and term not in wanted}
        elif value_of(vessel, name) == 0.0:
            raise SimulationError(
                f"{name} is 0, of which a percentage is no scatter", cure="leave it out, or give a covariance"
            )
        else:
            found[name] = share
    return {name: share for name, share in found.items() if share > 0.0}


def _percentage_words(shares: Mapping[str, float]) -> list[str]:
    return [
        f"independent {size:g} % of {sum(share == size for share in shares.values())} numbers"
        for size in sorted(set(shares.values()))
    ]
