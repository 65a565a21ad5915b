"""Test programmes before they are run: expected standard errors, and which run to add next.

The information of a run is X'X/s^2 of its rows; informations add up, and their inverse is the covariance that
the programme will give (Fedorov 1972). D-optimality shrinks the volume of the joint confidence region,
A-optimality the sum of the coefficients' relative variances, and a target the variance of one coefficient.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError

Criterion = Literal["D", "A"]

# Smallest eigenvalue of the information, columns scaled, that counts as full rank.
SINGULAR_LIMIT = 1e-12


def run_information(design: np.ndarray, sd: float | np.ndarray = 1.0) -> np.ndarray:
    """Information of a run.

    Parameters
    ----------
    design : ndarray, shape (n, p)
        Term columns of the run's independent rows (means or harmonics; or samples, with `sd` enlarged by the
        root of the autocorrelation time).
    sd : float or ndarray, shape (n,)
        Standard deviation of each row's response.

    Returns
    -------
    ndarray, shape (p, p)

    Raises
    ------
    FitError
        If a standard deviation is not positive.
    """
    x = np.asarray(design, dtype=float)
    spread = np.broadcast_to(np.asarray(sd, dtype=float), x.shape[:1])
    if not (spread > 0.0).all():
        raise FitError("a standard deviation is not positive", cure="give the noise of each row")
    rows = x / spread[:, None]
    return rows.T @ rows


def expected_covariance(information: np.ndarray, bias: np.ndarray | None = None) -> np.ndarray:
    """Covariance that a programme with this information will give, shape (p, p).

    Parameters
    ----------
    information : ndarray, shape (p, p)
    bias : ndarray, shape (p, p), optional
        Covariance of shared errors, which more runs do not reduce.

    Raises
    ------
    FitError
        If the programme cannot separate all terms; their positions are named.
    """
    m = np.asarray(information, dtype=float)
    scale = np.sqrt(np.maximum(np.diagonal(m), 0.0))
    idle = np.flatnonzero(scale == 0.0)
    if idle.size:
        raise FitError(f"no run excites term(s) {idle.tolist()}", cure="add runs that excite them")
    values, vectors = np.linalg.eigh(m / np.outer(scale, scale))
    if values[0] <= SINGULAR_LIMIT * values[-1]:
        weak = np.flatnonzero(np.abs(vectors[:, 0]) > 0.05)
        raise FitError(
            f"the programme cannot separate terms {weak.tolist()}", cure="add runs that tell them apart"
        )
    inverse = (vectors / values) @ vectors.T / np.outer(scale, scale)
    return inverse if bias is None else inverse + bias


def expected_standard_errors(information: np.ndarray, bias: np.ndarray | None = None) -> np.ndarray:
    """Standard errors that a programme will give, shape (p,); arguments as :func:`expected_covariance`."""
    return np.sqrt(np.diagonal(expected_covariance(information, bias)))


@dataclass(frozen=True, eq=False)
class CandidateRanking:
    """Candidates in order of merit.

    Attributes
    ----------
    order : ndarray of int, shape (c,)
        Candidates, best first.
    score : ndarray, shape (c,)
        Criterion of the programme with each candidate added, in the order of the candidates; smaller is
        better: log volume (D), mean relative variance (A), or variance of the target.
    standard_errors : ndarray, shape (c, p)
        Expected standard errors with each candidate added; inf where terms stay inseparable.
    """

    order: np.ndarray
    score: np.ndarray
    standard_errors: np.ndarray


def rank_candidates(
    information: np.ndarray,
    candidates: np.ndarray | Sequence[np.ndarray],
    criterion: Criterion = "D",
    target: int | np.ndarray | None = None,
    *,
    scales: np.ndarray | None = None,
) -> CandidateRanking:
    """Rank single runs that could be added to a programme.

    Parameters
    ----------
    information : ndarray, shape (p, p)
        Of the programme so far; may be singular.
    candidates : ndarray, shape (c, p, p)
        Information of each candidate run.
    criterion : {"D", "A"}
        Ignored when a target is given.
    target : int or ndarray of shape (p,), optional
        Position of one coefficient, or a linear combination, whose variance is to fall.
    scales : ndarray, shape (p,), optional
        Expected sizes of the coefficients, which make variances relative in criterion A; 1 when omitted.

    Raises
    ------
    FitError
        If shapes disagree or the criterion is unknown.
    """
    base, extra = np.asarray(information, dtype=float), np.asarray(candidates, dtype=float)
    p = base.shape[0]
    if base.shape != (p, p) or extra.ndim != 3 or extra.shape[1:] != (p, p):
        raise FitError(
            f"candidates of shape {extra.shape} do not fit an information of shape {base.shape}",
            cure="give one p x p matrix a candidate",
        )
    if criterion not in ("D", "A"):
        raise FitError(f"there is no criterion '{criterion}'", cure="use D or A")
    total = base + extra
    # One common scale keeps the comparison fair and the inverses accurate.
    common = np.sqrt(np.maximum(np.diagonal(base + extra.sum(axis=0)), 1e-300))
    values, vectors = np.linalg.eigh(total / np.outer(common, common))
    floor = SINGULAR_LIMIT * values[:, -1:]
    open_ = values <= floor
    inverse = 1.0 / np.maximum(values, np.maximum(floor, 1e-300))
    parts = (vectors / common[:, None]) ** 2
    exposed = ((vectors**2 > 1e-9) & open_[:, None, :]).any(axis=2)
    variances = np.where(exposed, np.inf, np.einsum("cij,cj->ci", parts, inverse))
    if target is not None:
        direction = np.eye(p)[target] if np.ndim(target) == 0 else np.asarray(target, dtype=float)
        along = np.einsum("cij,i->cj", vectors, direction / common)
        score = np.einsum("cj,cj->c", along**2, inverse)
    elif criterion == "D":
        score = np.log(inverse).sum(axis=1)
    else:
        size = np.ones(p) if scales is None else np.asarray(scales, dtype=float)
        score = np.einsum("cij,cj,i->c", parts, inverse, 1.0 / size**2) / p
    return CandidateRanking(np.argsort(score, kind="stable"), score, np.sqrt(variances))


def augment_greedily(
    information: np.ndarray,
    candidates: np.ndarray | Sequence[np.ndarray],
    runs: int,
    criterion: Criterion = "D",
    target: int | np.ndarray | None = None,
    *,
    scales: np.ndarray | None = None,
    repeats: bool = True,
) -> tuple[list[int], np.ndarray]:
    """Add the best candidate again and again.

    Parameters
    ----------
    information, candidates, criterion, target, scales :
        As :func:`rank_candidates`.
    runs : int
        Runs to add.
    repeats : bool
        Whether a candidate may be taken more than once.

    Returns
    -------
    chosen : list of int
        Candidates in the order in which they are added.
    information : ndarray, shape (p, p)
        Of the enlarged programme.

    Raises
    ------
    FitError
        As :func:`rank_candidates`; if there are fewer candidates than runs and none may be repeated.
    """
    extra = np.asarray(candidates, dtype=float)
    if runs < 1 or extra.shape[0] == 0 or (not repeats and runs > extra.shape[0]):
        raise FitError(f"{runs} runs cannot be taken from {extra.shape[0]} candidates", cure="allow repeats")
    total, chosen = np.array(information, dtype=float), []
    left = list(range(extra.shape[0]))
    for _ in range(runs):
        ranking = rank_candidates(total, extra[left], criterion, target, scales=scales)
        best = left[int(ranking.order[0])]
        chosen.append(best)
        total = total + extra[best]
        if not repeats:
            left.remove(best)
    return chosen, total


def repeats_for_target(
    information: np.ndarray, position: int, target_se: float, *, bias: np.ndarray | None = None
) -> int:
    """How often a programme must be run so that one coefficient's standard error falls to a target.

    Parameters
    ----------
    information : ndarray, shape (p, p)
        Of the programme run once.
    position : int
        Column of the coefficient.
    target_se : float
        Standard error wanted.
    bias : ndarray, shape (p, p), optional
        Covariance of shared errors, which repeats do not reduce.

    Returns
    -------
    int
        At least 1.

    Raises
    ------
    FitError
        If the shared errors alone exceed the target, or the programme cannot separate the terms.
    """
    if not target_se > 0.0:
        raise FitError(f"the target {target_se} is not positive", cure="give a standard error above zero")
    floor = 0.0 if bias is None else float(bias[position, position])
    room = target_se**2 - floor
    if room <= 0.0:
        raise FitError(
            f"errors shared by all runs give {math.sqrt(floor):.3g} alone, above the target {target_se:.3g}",
            cure="calibrate better: repeats do not help",
        )
    variance = float(expected_covariance(information)[position, position])
    return max(math.ceil(variance / room * (1.0 - 1e-12)), 1)
