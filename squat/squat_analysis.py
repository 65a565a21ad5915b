"""From squat campaigns to squat: runs reduced, repeats pooled, curves by depth; and the tables of all that."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from .code_scores import plain_rows
from .repeated_runs import REPEAT_COLUMNS, RepeatedRuns, pool_repeats
from .squat_campaign import SquatCampaign, load_squat_campaign
from .squat_curve import SquatCurve
from .squat_group import SquatGroup, squat_groups
from .squat_run import SquatRun, reduce_run
from .steady_squat import SQUAT_COLUMNS, SteadySquat
from .wave_response import RESPONSE_COLUMNS

if TYPE_CHECKING:
    import pandas as pd

Progress = Callable[[str, int, int], None]

FIT_COLUMNS = (
    "depth",
    "quantity",
    "model",
    "parameter",
    "value",
    "std",
    "unit",
    "residual_sd",
    "dof",
    "speed_min",
    "speed_max",
)


@dataclass(frozen=True, eq=False)
class SquatAnalysis:
    """What a squat campaign yields.

    Attributes
    ----------
    campaign : SquatCampaign
    path : Path, optional
        Of the campaign file.
    runs : tuple of SquatRun
    repeats : tuple of RepeatedRuns
    groups : tuple of SquatGroup
        Empty where ship, speed or depth is not known.
    findings : tuple of Finding
        Of files, reduction and comparison, each once.
    """

    campaign: SquatCampaign
    path: Path | None
    runs: tuple[SquatRun, ...]
    repeats: tuple[RepeatedRuns, ...]
    groups: tuple[SquatGroup, ...]
    findings: tuple[Finding, ...] = field(default=())

    @property
    def truth(self) -> Mapping[str, float]:
        """True coefficients of virtual records: c of ``c Fh^2/sqrt(1 - Fh^2)`` in m (trim: m/m) by quantity."""
        return self.campaign.squat.truth

    @property
    def steady(self) -> list[SteadySquat]:
        """Every reduced stretch, in the order of the records."""
        return [one for run in self.runs for one in run.steady]

    def squat_frame(self) -> pd.DataFrame:
        """Columns ``run, quantity, mean, se, n_eff, window_start, window_end, unit``."""
        import pandas as pd

        frames = [one.frame for one in self.steady]
        return pd.concat(frames, ignore_index=True)[list(SQUAT_COLUMNS)]

    def repeats_frame(self) -> pd.DataFrame:
        """Pooled repeats; without rows when no condition was repeated."""
        return _stacked([one.frame for one in self.repeats], REPEAT_COLUMNS)

    def waves_frame(self) -> pd.DataFrame:
        """Mean and harmonics of the runs in waves; without rows when there are none."""
        frames = [run.waves.frame for run in self.runs if run.waves is not None]
        return _stacked(frames, ("run", "quantity", "mean", "se", "omega", "r2", "unit"))

    def responses_frame(self) -> pd.DataFrame:
        """Motions over the wave of the runs whose gauge is named; without rows when there are none."""
        frames = [run.responses.frame for run in self.runs if run.responses is not None]
        return _stacked(frames, RESPONSE_COLUMNS)

    def curve_frame(self) -> pd.DataFrame:
        """Points of the curves with units in the headings: speed, depth, depth Froude number, quantities, clearance."""
        return _stacked([self._points(group.curve) for group in self.groups], ("speed [m/s]",))

    def full_scale_frame(self) -> pd.DataFrame:
        """:meth:`curve_frame` at full scale by Froude's law; without rows when the records are at full scale."""
        if self.campaign.scale == 1.0:
            return _stacked([], ("speed [m/s]",))
        return _stacked([self._points(group.curve.full_scale()) for group in self.groups], ("speed [m/s]",))

    def corrected_frame(self) -> pd.DataFrame:
        """:meth:`curve_frame` with the correction added; without rows when there is none."""
        curves = [group.corrected for group in self.groups if group.corrected is not None]
        return _stacked([self._points(curve) for curve in curves], ("speed [m/s]",))

    def _points(self, curve: SquatCurve) -> pd.DataFrame:
        import pandas as pd

        columns: dict[str, Any] = {
            "speed [m/s]": curve.points["speed"],
            "depth [m]": curve.depth,
            "depth_froude [-]": curve.depth_froude_number,
        }
        units = self.steady[0].units
        for name in curve.points.columns[1:]:
            quantity = str(name).removesuffix("_se")
            columns[f"{name} [{units.get(quantity, '') or '-'}]"] = curve.points[name]
        columns["clearance [m]"] = curve.clearance()
        return pd.DataFrame(columns)

    def fits_frame(self) -> pd.DataFrame:
        """Parameters of the curves, columns :data:`FIT_COLUMNS`."""
        import pandas as pd

        rows = [row for group in self.groups for row in _fit_rows(group)]
        return pd.DataFrame(rows, columns=list(FIT_COLUMNS))

    def formulas_frame(self) -> pd.DataFrame:
        """Scores of the formulas against the measured curves; without rows when they were not compared."""
        frames = [
            group.comparison.scores.assign(depth=group.curve.depth)
            for group in self.groups
            if group.comparison is not None
        ]
        return _stacked(frames, ("formula",))

    def to_dict(self) -> dict[str, Any]:
        """Everything but the series, for JSON."""
        return {
            "format": "towtank squat 1",
            "name": self.campaign.squat.name,
            "virtual": self.campaign.squat.virtual,
            "truth": dict(self.truth),
            "scale": self.campaign.scale,
            "conventions": CONVENTIONS,
            "runs": [
                {
                    "run": run.name,
                    "file": run.record.name,
                    "sha256": run.record.sha256,
                    "windows": [one.window.note for one in run.steady],
                }
                for run in self.runs
            ],
            "squat": plain_rows(self.squat_frame()),
            "repeats": plain_rows(self.repeats_frame()),
            "waves": plain_rows(self.waves_frame()),
            "responses": plain_rows(self.responses_frame()),
            "curve": plain_rows(self.curve_frame()),
            "corrected": plain_rows(self.corrected_frame()),
            "fits": plain_rows(self.fits_frame()),
            "failures": {key: reason for group in self.groups for key, reason in group.failures.items()},
            "formulas": plain_rows(self.formulas_frame()),
            "findings": [vars(item) for item in self.findings],
        }


CONVENTIONS = "sinkage positive down; trim as a slope, positive by the bow; x forward of midship; SI"


def run_squat_campaign(
    campaign: SquatCampaign | str | Path,
    *,
    folder: str | Path | None = None,
    accept: Sequence[str] = (),
    progress: Progress | None = None,
) -> SquatAnalysis:
    """Read and reduce a squat campaign.

    Parameters
    ----------
    campaign : SquatCampaign, str or Path
        Campaign, or its file.
    folder : str or Path, optional
        Where the names of the record files start; that of the campaign file, or the present one.
    accept : sequence of str
        Audit rules that the user waives beside those of the campaign.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    TowtankError
        When a file or key is wrong, or a record cannot be reduced.
    """
    path = None
    if not isinstance(campaign, SquatCampaign):
        path = Path(campaign)
        campaign = load_squat_campaign(path)
    start = Path(folder) if folder is not None else path.parent if path is not None else Path()
    for entry in campaign.records:
        if not (start / entry.file).exists():
            raise ReadError("file not found", cure="check the path", file=start / entry.file)
    waived = (*campaign.accept, *accept)
    runs = []
    for number, (entry, name) in enumerate(zip(campaign.records, campaign.run_names(), strict=True)):
        if progress:
            progress("reducing", number, len(campaign.records))
        runs.append(reduce_run(campaign, entry, name, start, waived))
    if progress:
        progress("reducing", len(runs), len(runs))
    return analyse_squat(campaign, runs, path=path)


def analyse_squat(campaign: SquatCampaign, runs: Sequence[SquatRun], *, path: Path | None = None) -> SquatAnalysis:
    """Pool repeats, fit curves and compare formulas for runs that are reduced.

    Parameters
    ----------
    campaign : SquatCampaign
    runs : sequence of SquatRun
    path : Path, optional
        Of the campaign file.
    """
    stretches, conditions = [], []
    for run in runs:
        for one in run.steady:
            stretches.append(one)
            # waves shift the mean: such runs are repeats only when the user says so
            conditions.append(run.entry.condition or (one.run if run.waves is not None else ""))
    repeats = pool_repeats(stretches, conditions, campaign.fit.same_speed)
    found = [item for run in runs for item in run.findings]
    found += [
        Finding(
            "repeats-pooled",
            "info",
            f"{len(one.runs)} runs are pooled as repeats of {one.condition}: "
            + ", ".join(run.run for run in one.runs),
            cure="name conditions, or set same_speed = 0, where they are not",
        )
        for one in repeats
    ]
    groups = tuple(squat_groups(campaign, runs, found))
    return SquatAnalysis(campaign, path, tuple(runs), tuple(repeats), groups, tuple(dict.fromkeys(found)))


def _fit_rows(group: SquatGroup) -> Iterator[tuple[Any, ...]]:
    for quantity, models in group.fits.items():
        unit = "m/m" if quantity == "trim" else "m"
        for model, fit in models.items():
            names = ("c",) if model == "depth-froude" else ("c", "p")
            units = (unit,) if model == "depth-froude" else (f"{unit} (s/m)^p", "-")
            errors = np.sqrt(np.diagonal(fit.cov))
            for name, value, error, of in zip(names, fit.params, errors, units, strict=True):
                low, high = fit.speed_range
                yield (
                    group.curve.depth, quantity, model, name, float(value), float(error), of, fit.residual_sd,
                    fit.dof, low, high,
                )  # fmt: skip


def _stacked(frames: list[pd.DataFrame], columns: Sequence[str]) -> pd.DataFrame:
    import pandas as pd

    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=list(columns))
