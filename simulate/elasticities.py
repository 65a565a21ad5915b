"""Which number drives which index: regression of the relative changes of the indices on those of the numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .parameter_scatter import ParameterScatter

if TYPE_CHECKING:
    import pandas as pd

FloatArray = np.ndarray

_DEPENDENT = 1e-7
"""Size of the part of a column that the others do not explain, below which it is rounding."""

COLUMNS = ("manoeuvre", "index", "parameter", "elasticity", "standard_error", "share", "first_order")


def relative_changes(values: FloatArray, reference: float) -> FloatArray:
    """Changes of positive size relative to a reference: ``log(values / reference)``.

    Where values are on the other side of zero they have no logarithm: then ``values / reference - 1``, which has the
    same slope at the reference.
    """
    ratio = values / reference
    return np.log(ratio) if np.all(ratio > 0.0) else ratio - 1.0


def elasticity_table(
    values: Mapping[str, Mapping[str, FloatArray]],
    unperturbed: Mapping[str, Mapping[str, float]],
    scatter: ParameterScatter,
    parameters: FloatArray,
    first_order: Mapping[str, Mapping[str, FloatArray]],
) -> pd.DataFrame:
    """Elasticities of all indices by all parameters.

    Parameters
    ----------
    values : mapping of str to mapping of str to ndarray, shape (draws,)
        Manoeuvre -> index -> values of the draws; those that are NaN are left out.
    unperturbed : mapping of str to mapping of str to float
    scatter : ParameterScatter
    parameters : ndarray, shape (draws, p)
    first_order : mapping of str to mapping of str to ndarray, shape (p,)
        Elasticities at the unperturbed vessel.

    Returns
    -------
    DataFrame
        `COLUMNS`. Indices that are 0 or unknown for the unperturbed vessel have no relative change and are left out.
        `share` is ``b_j cov(x_j, y) / var(y)``. A parameter that is 0 has a share but no elasticity.
    """
    import pandas as pd

    changes = np.column_stack(
        [
            relative_changes(column, center) if center else column / sd
            for column, center, sd in zip(parameters.T, scatter.center, scatter.sd, strict=True)
        ]
    )
    relative = scatter.center != 0.0
    frames = []
    for manoeuvre, indices in values.items():
        references = unperturbed[manoeuvre]
        wanted = [index for index in indices if np.isfinite(references.get(index, np.nan)) and references[index]]
        for good, names in _alike(indices, wanted):
            responses = [relative_changes(indices[index][good], references[index]) for index in names]
            slopes, errors, shares = regress(changes[good], np.column_stack(responses))
            for column, index in enumerate(names):
                frames.append(
                    pd.DataFrame(
                        {
                            "manoeuvre": manoeuvre,
                            "index": index,
                            "parameter": list(scatter.names),
                            "elasticity": np.where(relative, slopes[:, column], np.nan),
                            "standard_error": np.where(relative, errors[:, column], np.nan),
                            "share": shares[:, column],
                            "first_order": np.where(relative, first_order[manoeuvre][index], np.nan),
                        }
                    )
                )
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=list(COLUMNS))


def _alike(indices: Mapping[str, FloatArray], wanted: list[str]) -> list[tuple[FloatArray, list[str]]]:
    """Names of indices that are known for the same draws, with a mask of these draws."""
    groups: dict[bytes, tuple[FloatArray, list[str]]] = {}
    for index in wanted:
        good = np.isfinite(indices[index])
        groups.setdefault(good.tobytes(), (good, []))[1].append(index)
    return list(groups.values())


def regress(changes: FloatArray, responses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Slopes of linear regressions with intercept, their standard errors, and each column's share of the variance.

    Parameters
    ----------
    changes : ndarray, shape (n, p)
    responses : ndarray, shape (n, k)

    Returns
    -------
    tuple of ndarray, each of shape (p, k)
        NaN when there are too few rows, or columns that depend on one another: then no column has a slope of its own.
    """
    n, p = changes.shape
    unknown = np.full((p, responses.shape[1]), np.nan)
    if n <= p + 1:
        return unknown, unknown, unknown
    x = changes - changes.mean(axis=0)
    y = responses - responses.mean(axis=0)
    # scaled columns: their sizes must not decide about the rank
    scale = np.linalg.norm(x, axis=0)
    if not np.all(scale > 0.0):
        return unknown, unknown, unknown
    x /= scale
    basis, triangle = np.linalg.qr(x)
    if np.min(np.abs(np.diag(triangle))) < _DEPENDENT:
        return unknown, unknown, unknown
    inverse = np.linalg.inv(triangle)
    slopes = inverse @ (basis.T @ y)
    variance = np.sum((y - x @ slopes) ** 2, axis=0) / (n - p - 1)
    errors = np.sqrt(np.outer(np.sum(inverse**2, axis=1), variance))
    total = np.sum(y**2, axis=0)
    shares = slopes * (x.T @ y) / np.where(total > 0.0, total, 1.0)
    return slopes / scale[:, None], errors / scale[:, None], shares
