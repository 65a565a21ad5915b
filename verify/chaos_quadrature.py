"""Nodes and weights for the mean over several independent inputs: the full grid, or the sparse one of Smolyak."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import Literal

import numpy as np

from ..core.errors import FitError
from .chaos_basis import gauss_rule
from .input_distribution import UncertainInput, check_inputs

Grid = Literal["tensor", "sparse"]

MOST_NODES = 200_000
"""Nodes beyond which a rule is refused: a run of the solver stands behind each."""


def quadrature(
    inputs: Sequence[UncertainInput], level: int, grid: Grid = "tensor"
) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of the inputs and weights of their mean.

    Parameters
    ----------
    inputs : sequence of UncertainInput
    level : int
        Tensor: points of each input, exact for polynomials up to order 2 level - 1 in each. Sparse: level of
        Smolyak's construction from the same Gauss rules (level 1 is one point), exact up to total order 2 level - 1.
    grid : {"tensor", "sparse"}
        Sparse grids have fewer nodes from about four inputs on; some of their weights are negative.

    Returns
    -------
    nodes : ndarray, shape (n, inputs)
        In the units of the inputs: run the solver there.
    weights : ndarray, shape (n,)
        Sum 1.

    Raises
    ------
    FitError
        When the level is no whole number from 1, or the rule has more nodes than :data:`MOST_NODES`.
    """
    chosen = tuple(inputs)
    check_inputs(chosen)
    if level < 1 or int(level) != level:
        raise FitError(f"the level {level} of the quadrature is no whole number from 1", cure="give order + 1")
    if grid == "tensor":
        germs, weights = _tensor(chosen, (level,) * len(chosen))
    elif grid == "sparse":
        germs, weights = _smolyak(chosen, level)
    else:
        raise FitError(f"unknown grid '{grid}'", cure="use tensor or sparse")
    return np.column_stack([one.value(germs[:, i]) for i, one in enumerate(chosen)]), weights


def _tensor(inputs: tuple[UncertainInput, ...], points: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    count = math.prod(points)
    if count > MOST_NODES:
        raise FitError(
            f"the rule has {count} nodes", cure="use a sparse grid, a lower level, or regression on samples"
        )
    rules = [gauss_rule(one, many) for one, many in zip(inputs, points, strict=True)]
    nodes = np.stack([axis.ravel() for axis in np.meshgrid(*(rule[0] for rule in rules), indexing="ij")], axis=1)
    weights = np.ones(1)
    for _, own in rules:
        weights = np.multiply.outer(weights, own).ravel()
    return nodes, weights


def _smolyak(inputs: tuple[UncertainInput, ...], level: int) -> tuple[np.ndarray, np.ndarray]:
    """Smolyak's rule by the combination of full grids (Gerstner and Griebel 1998)."""
    d, top = len(inputs), level + len(inputs) - 1
    merged: dict[tuple[float, ...], tuple[np.ndarray, float]] = {}
    for points in product(range(1, level + 1), repeat=d):
        missing = top - sum(points)
        if not 0 <= missing <= d - 1:
            continue
        factor = (-1.0) ** missing * math.comb(d - 1, missing)
        nodes, weights = _tensor(inputs, points)
        for node, weight in zip(nodes, weights.tolist(), strict=True):
            # nodes that two grids share differ in the last bits only
            key = tuple(np.round(node, 10).tolist())
            known = merged.get(key)
            merged[key] = (node, factor * weight + (known[1] if known else 0.0))
        if len(merged) > MOST_NODES:
            raise FitError(f"the rule has more than {MOST_NODES} nodes", cure="use a lower level, or regression")
    kept = [item for item in merged.values() if abs(item[1]) > 1e-15]
    return np.array([node for node, _ in kept]), np.array([weight for _, weight in kept])
