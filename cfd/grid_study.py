"""A sweep on several grids to derivatives with numerical uncertainty, and beside an experiment.

Each grid's settled means are reduced points of a captive campaign; the campaign's own fit gives one derivative set a
grid. The sets give the numerical uncertainty of each derivative, and the finest grid's set, with both uncertainties, is
compared with the measured one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError
from ..core.findings import Finding
from ..core.ship import Ship
from ..formats.write import atomic_path
from ..pmm.campaign import Campaign
from ..pmm.virtual_campaign import campaign_text
from ..verify import derivative_uncertainty, refinement_findings, spacings_from_cells, validate_derivatives
from ..verify.derivative_uncertainty import DerivativeUncertainty
from .settled_loads import SettledCase, points_table, settling_findings

if TYPE_CHECKING:
    import pandas as pd

Progress = Callable[[str, int, int], None]

POINTS_FILE = "points.csv"
CAMPAIGN_FILE = "campaign.toml"


@dataclass(frozen=True, eq=False)
class GridStudy:
    """Derivatives of a sweep on several grids.

    Attributes
    ----------
    name : str
    settled : tuple of SettledCase
    grids : tuple of str
        Names of the grids, finest first.
    spacings : ndarray, shape (g,)
        Relative spacing, finest 1.
    sets : tuple of DerivativeSet
        One a grid, finest first.
    uncertainty : DerivativeUncertainty
        Numerical uncertainty of each derivative.
    reference : DerivativeSet or None
        The measured set.
    validation : DataFrame or None
        Finest grid against the measured set.
    truth : DerivativeSet or None
        What a virtual sweep was made from.
    findings : tuple of Finding
    campaigns : tuple of Path
        Campaign file of each grid.
    """

    name: str
    settled: tuple[SettledCase, ...]
    grids: tuple[str, ...]
    spacings: np.ndarray
    sets: tuple[DerivativeSet, ...]
    uncertainty: DerivativeUncertainty
    reference: DerivativeSet | None = None
    validation: pd.DataFrame | None = None
    truth: DerivativeSet | None = None
    findings: tuple[Finding, ...] = ()
    campaigns: tuple[Path, ...] = field(default=())

    @property
    def derivatives(self) -> DerivativeSet:
        """The finest grid's set with the covariance of fit and numerical error."""
        return self.uncertainty.combined

    def table(self) -> pd.DataFrame:
        """One row a derivative: value on each grid, class, order, U_num, u_fit, U95, and the truth where it is known.

        Column ``truth inside`` says whether the truth lies within value plus and minus U95.
        """
        frame = self.uncertainty.table.copy()
        for grid, one in zip(self.grids[1:], self.sets[1:], strict=True):
            frame[f"grid {grid}"] = [one[name] for name in frame["name"]]
        if self.truth is not None:
            known = self.truth.to(self.derivatives.conventions)
            frame["truth"] = [known[name] if name in known else math.nan for name in frame["name"]]
            frame["truth inside"] = (frame["value"] - frame["truth"]).abs() <= frame["U95"]
        return frame


def relative_spacings(
    settled: Sequence[SettledCase], spacings: Mapping[str, float] | None = None
) -> dict[str, float]:
    """Relative spacing of each grid of a sweep, finest first; from the cell counts where none are given.

    Parameters
    ----------
    settled : sequence of SettledCase
    spacings : mapping of str to float, optional
        Spacing of each grid by its name, any unit.

    Raises
    ------
    CampaignError
        With fewer than two grids, or a grid without cells and spacing.
    """
    names = list(dict.fromkeys(item.case.grid for item in settled))
    if len(names) < 2:
        raise CampaignError(
            f"the sweep has {len(names)} grid(s)", cure="compute it on three: names such as beta_4_grid2 tell them"
        )
    if spacings is not None:
        missing = [name for name in names if name not in spacings]
        if missing:
            raise CampaignError(
                f"grid '{missing[0]}' has no spacing", cure=f"give one for each of {', '.join(names)}"
            )
        values = np.array([spacings[name] for name in names], dtype=float)
    else:
        cells = {item.case.grid: item.case.cells for item in settled if math.isfinite(item.case.cells)}
        missing = [name for name in names if name not in cells]
        if missing:
            raise CampaignError(
                f"the number of cells of grid '{missing[0]}' is not known",
                cure="give --cells 1=8000000,2=2828000,3=1000000, or a column cells in the table",
            )
        values = spacings_from_cells([cells[name] for name in names], 3)
    values = values / values.min()
    order = np.argsort(values, kind="stable")
    return {names[k]: float(values[k]) for k in order}


def write_grid_campaign(
    settled: Sequence[SettledCase], ship: Ship, folder: Path, *, name: str, fit: Mapping[str, Any] | None = None
) -> Path:
    """Campaign of the settled means of one grid; returns the campaign file.

    Parameters
    ----------
    settled : sequence of SettledCase
        Cases of one grid, all settled or waived.
    ship : Ship
        At the scale of the computation.
    folder : Path
        Takes ``points.csv`` and ``campaign.toml``; made when it is missing.
    name : str
    fit : mapping, optional
        Section ``[fit]`` of the campaign.

    Raises
    ------
    FitError
        If a case has not settled and is not waived.
    CampaignError
        If a case has no speed.
    """
    points = points_table(settled)
    nameless = points[points["speed"].isna()]
    if len(nameless):
        raise CampaignError(
            f"the speed of case '{nameless.iloc[0]['name']}' is not known",
            cure="name it in the folder (U_1.2) or in the table",
        )
    folder.mkdir(parents=True, exist_ok=True)
    with atomic_path(folder / POINTS_FILE) as temporary:
        points.to_csv(temporary, index=False)
    virtual = any((item.case.path.parent / "truth.json").is_file() for item in settled)
    sections = {
        "campaign": {"name": name, "source": "settled means of a computation", "virtual": virtual},
        "ship": ship.to_dict(),
        "conventions": {"angle_unit": "deg"},
        "points": {"file": POINTS_FILE, "scaling": "dimensional"},
        "fit": dict(fit or {}),
    }
    with atomic_path(folder / CAMPAIGN_FILE) as temporary:
        temporary.write_text(campaign_text(sections, []), encoding="utf-8")
    return folder / CAMPAIGN_FILE


def grid_study(
    settled: Sequence[SettledCase],
    ship: Ship,
    folder: str | Path,
    *,
    name: str = "CFD sweep",
    spacings: Mapping[str, float] | None = None,
    assumed_ratio: float | None = None,
    fit: Mapping[str, Any] | None = None,
    method: str = "default",
    reference: DerivativeSet | None = None,
    truth: DerivativeSet | None = None,
    progress: Progress | None = None,
) -> GridStudy:
    """Derivatives of each grid, their numerical uncertainty, and the comparison with an experiment.

    Parameters
    ----------
    settled : sequence of SettledCase
        All cases of all grids; each motion on each grid.
    ship : Ship
    folder : path
        Takes one campaign a grid, which ``towtank run`` can fit again.
    name : str
    spacings : mapping of str to float, optional
        Spacing of each grid; from the cell counts when not given.
    assumed_ratio : float, optional
        Refinement ratio that was meant; a finding tells when the cell counts say otherwise.
    fit : mapping, optional
        Section ``[fit]`` of the campaigns; the terms that the motions call for when not given.
    method : str
        Method of the numerical uncertainty, see :func:`~towtank.verify.derivative_uncertainty`.
    reference : DerivativeSet, optional
        The measured set.
    truth : DerivativeSet, optional
        What a virtual sweep was made from.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    TowtankError
        For a case that has not settled, a motion that is missing on a grid, fewer than two grids, or a fit that the
        points do not support.
    """
    spaced = relative_spacings(settled, spacings)
    _require_same_motions(settled, list(spaced))
    sets, campaigns = [], []
    for number, grid in enumerate(spaced):
        if progress:
            progress("fitting grids", number, len(spaced))
        mine = [item for item in settled if item.case.grid == grid]
        file = write_grid_campaign(mine, ship, Path(folder) / f"grid_{grid}", name=f"{name}, grid {grid}", fit=fit)
        campaigns.append(file)
        sets.append(Campaign.load(file).run(compare=False).derivatives)
    if progress:
        progress("fitting grids", len(spaced), len(spaced))
    values = np.array(list(spaced.values()))
    uncertainty = derivative_uncertainty(sets, values, method=method)
    findings = [*settling_findings(settled), *uncertainty.findings]
    findings += refinement_findings(values, assumed_ratio)
    validation = None if reference is None else validate_derivatives(uncertainty.combined, reference)
    return GridStudy(
        name=name,
        settled=tuple(settled),
        grids=tuple(spaced),
        spacings=values,
        sets=tuple(sets),
        uncertainty=uncertainty,
        reference=reference,
        validation=validation,
        truth=truth,
        findings=tuple(dict.fromkeys(findings)),
        campaigns=tuple(campaigns),
    )


def _require_same_motions(settled: Sequence[SettledCase], grids: Sequence[str]) -> None:
    motions = {grid: {item.case.condition for item in settled if item.case.grid == grid} for grid in grids}
    everything = set().union(*motions.values())
    for grid, there in motions.items():
        if there != everything:
            beta, rate, _ = sorted(everything - there)[0]
            raise CampaignError(
                f"grid '{grid}' has no case of beta {beta:g} deg, r' {rate:g}",
                cure="derivatives of different motions cannot be compared: compute it, or leave it out on all grids",
            )


def load_truth(folder: Path) -> DerivativeSet | None:
    """The set that a virtual sweep was made from, ``truth.json``; None for a real one."""
    file = folder / "truth.json"
    return DerivativeSet.from_json(file) if file.is_file() else None
