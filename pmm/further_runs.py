"""How a test programme is best made better: repeats for a wanted precision, and the best next run."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import CampaignError, FitError
from ..identify.design_optimality import Criterion, augment_greedily, rank_candidates, repeats_for_target
from .planned_rows import planned_rows
from .programme import Programme
from .run_types import Run

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Repeats:
    """How often runs must be repeated for one coefficient.

    Attributes
    ----------
    name : str
    target : float
        Standard error wanted.
    present : float
        Standard error of the programme run once, shared bias included.
    shared : float
        Standard error from what all runs share.
    whole_programme : int
        How often the whole programme must be run, the first time included.
    runs : mapping of str to int
        How often single runs must be repeated beside the programme run once, most informative ones first.
    reached : float
        Standard error with these repeats.
    """

    name: str
    target: float
    present: float
    shared: float
    whole_programme: int
    runs: Mapping[str, int]
    reached: float

    def describe(self) -> str:
        """One or two sentences for a report."""
        if self.whole_programme == 1:
            return f"{self.name}: the programme gives {self.present:.3g}, wanted is {self.target:.3g}; no repeats"
        some = ", ".join(f"{count} x {run}" for run, count in self.runs.items())
        return (
            f"{self.name}: the programme gives {self.present:.3g}, wanted is {self.target:.3g}: run the whole "
            f"programme {self.whole_programme} times, or repeat {some}"
        )


def repeats_for(programme: Programme, name: str, relative: float = 0.05, *, level: float = 0.95) -> Repeats:
    """How many repeats bring a coefficient within a share of its value.

    Parameters
    ----------
    programme : Programme
        Planned with a derivative set, which says how large the coefficient is.
    name : str
    relative : float
        Half-width of the interval wanted, as a share of the value.
    level : float
        Confidence of the interval.

    Raises
    ------
    TermError
        When the programme does not have the term.
    FitError
        When the size of the coefficient is not known, the programme does not determine it, or the bias that all
        runs share is larger than what is wanted.
    """
    from scipy.special import ndtri

    place = programme.position(name)
    value = float(programme.values[place])
    if not (math.isfinite(value) and value != 0.0):
        raise FitError(f"the size of {name} is not known", cure="plan with a derivative set that has it")
    present = float(programme.standard_errors[place])
    if not math.isfinite(present):
        raise FitError(f"the programme does not determine {name}", cure="add a run: ask for the best next run")
    target = relative * abs(value) / float(ndtri(0.5 + level / 2))
    keep, information = _determined(programme, programme.information)
    at = int(np.flatnonzero(keep == place)[0])
    bias = programme.bias[np.ix_(keep, keep)]
    whole = repeats_for_target(information, at, target, bias=bias)
    shared = float(bias[at, at])
    counts: Counter[str] = Counter()
    reached = present
    if whole > 1:
        candidates = programme.run_information[:, keep[:, None], keep[None, :]]
        while reached > target:
            # Several at once when many are needed: the best run hardly changes from one to the next.
            batch = 1 + counts.total() // 20
            (best,), _ = augment_greedily(information, candidates, 1, target=at)
            information = information + batch * candidates[best]
            counts[programme.runs[best].name] += batch
            reached = math.sqrt(float(np.linalg.inv(information)[at, at]) + shared)
    return Repeats(name, target, present, math.sqrt(shared), whole, dict(counts.most_common()), reached)


def _determined(programme: Programme, information: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places of the terms that the programme determines, and the information about them alone."""
    keep = np.flatnonzero(np.isfinite(np.diag(programme.covariance)))
    # The others are estimated beside them: what they take is gone.
    lost = np.setdiff1d(np.arange(len(information)), keep)
    inner = information[np.ix_(keep, keep)]
    if not lost.size:
        return keep, inner
    cross = information[np.ix_(keep, lost)]
    return keep, inner - cross @ np.linalg.pinv(information[np.ix_(lost, lost)], hermitian=True) @ cross.T


def best_next_run(
    programme: Programme, candidates: Sequence[Run], criterion: Criterion = "D", target: str | None = None
) -> pd.DataFrame:
    """Rank single runs that could be added to a programme.

    Parameters
    ----------
    programme : Programme
    candidates : sequence of Run
        Runs in the same water depth; runs of the programme may be among them, as repeats.
    criterion : {"D", "A"}
        Smallest volume of the joint confidence region, or smallest mean variance relative to the expected
        values (to the present standard errors where values are not known).
    target : str, optional
        Name of one term whose standard error is to fall instead.

    Returns
    -------
    DataFrame
        Best first: ``run``, ``type``, ``score`` (of the criterion, smaller is better), ``gain`` (fall of the score
        against the programme alone; infinite when terms become determined), ``determined`` (terms whose standard
        error is finite) and, with a target, ``std`` of it.

    Raises
    ------
    CampaignError
        When there is no candidate.
    TermError
        When the target is not a term of the programme.
    """
    import pandas as pd

    wet = [run for run in candidates if not run.dry]
    if not wet:
        raise CampaignError("there is no candidate", cure="give runs that could be made")
    extra = np.array([planned_rows(run, programme.terms, programme.noise).information for run in wet])
    nothing = np.zeros((1, *programme.information.shape))
    sizes = np.abs(programme.values)
    present = programme.standard_errors
    sizes = np.where(np.isfinite(sizes) & (sizes > 0), sizes, np.where(np.isfinite(present), present, 1.0))
    place = None if target is None else programme.position(target)
    ranking = rank_candidates(
        programme.information, np.concatenate([nothing, extra]), criterion, place, scales=sizes
    )
    found = np.isfinite(ranking.standard_errors).sum(axis=1)
    gain = np.where(found[1:] > found[0], np.inf, ranking.score[0] - ranking.score[1:])
    table = pd.DataFrame(
        {
            "run": [run.name for run in wet],
            "type": [run.kind for run in wet],
            "score": ranking.score[1:],
            "gain": gain,
            "determined": found[1:],
        }
    )
    if place is not None:
        table["std"] = np.sqrt(ranking.standard_errors[1:, place] ** 2 + programme.bias[place, place])
    best_first = table.sort_values(["determined", "score"], ascending=[False, True], kind="stable")
    return best_first.reset_index(drop=True)
