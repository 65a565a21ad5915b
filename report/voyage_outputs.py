"""The folder of results of a voyage, its page, and what a terminal shows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.provenance import Provenance, program_versions
from ..squat.code_scores import plain_rows
from ..squat.full_scale import FullScaleSquat
from ..squat.voyage_file import VoyageFile
from .aligned_text import aligned_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

if TYPE_CHECKING:
    import pandas as pd

VOYAGE_FORMAT = "towtank voyage provenance 1"


def require_voyage_folder(out: str | Path) -> None:
    """Refuse a place that cannot take the results of a voyage, before anything is computed.

    Raises
    ------
    TowtankError
        When `out` is a file, or holds results of another kind.
    """
    require_folder(Path(out), VOYAGE_FORMAT)


@dataclass(frozen=True, eq=False)
class Voyage:
    """A voyage and what it gave.

    Attributes
    ----------
    file : VoyageFile
    runs : tuple of FullScaleSquat
        One a record.
    provenance : Provenance
    """

    file: VoyageFile
    runs: tuple[FullScaleSquat, ...]
    provenance: Provenance

    def voyage_frame(self) -> pd.DataFrame:
        """Every quantity over time, units in the headings, the record in the column ``run``."""
        return self._stacked(
            lambda one: one.frame.rename(
                columns={name: f"{name} [{unit}]" for name, unit in one.frame.attrs["units"].items()}
            )
        )

    def summary_frame(self) -> pd.DataFrame:
        """Extremes of each record with the uncertainty of the sensors."""
        return self._stacked(lambda one: one.summary)

    def budget_frame(self) -> pd.DataFrame:
        """Contribution of each sensor at bow, stern and midship, which all records share."""
        import pandas as pd

        parts = [budget.frame.assign(place=place) for place, budget in self.runs[0].budgets.items()]
        return pd.concat(parts, ignore_index=True)

    def to_dict(self) -> dict[str, Any]:
        """Everything but the series, for JSON."""
        return {
            "format": "towtank voyage 1",
            "name": self.file.voyage.name,
            "virtual": self.file.voyage.virtual,
            "runs": {one.run: {"choices": dict(one.choices), "notes": list(one.notes)} for one in self.runs},
            "summary": plain_rows(self.summary_frame()),
            "budget": plain_rows(self.budget_frame()),
            "findings": [vars(item) for item in self.provenance.findings],
        }

    def _stacked(self, frame: Callable[[FullScaleSquat], pd.DataFrame]) -> pd.DataFrame:
        import pandas as pd

        parts = []
        for one in self.runs:
            part = frame(one).copy()
            part.insert(0, "run", one.run)
            part.attrs = {}
            parts.append(part)
        return pd.concat(parts, ignore_index=True)


def write_voyage(
    analysis: Voyage, out: str | Path, *, report: bool = True, progress: Progress | None = None
) -> list[Path]:
    """Write ``voyage.csv`` (every quantity over time), ``voyage_summary.csv``, ``sensor_budget.csv``, ``voyage.json``,
    ``report.html`` and the provenance.

    Parameters
    ----------
    analysis : Voyage
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool
        Write ``report.html``.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("voyage.csv", csv_writer(analysis.voyage_frame)),
        ("voyage_summary.csv", csv_writer(analysis.summary_frame)),
        ("sensor_budget.csv", csv_writer(analysis.budget_frame)),
        ("voyage.json", lambda path: write_json(analysis.to_dict(), path)),
    ]
    if report:

        def write_page(path: Path) -> None:
            # drawing needs matplotlib, which the command line must not load at its start
            from .voyage_page import render_voyage

            path.write_text(render_voyage(analysis), encoding="utf-8")

        writers.append(("report.html", write_page))
    return write_folder(Path(out), writers, folder_provenance(analysis), progress)


def folder_provenance(analysis: Voyage, created: datetime | None = None) -> dict[str, Any]:
    """Files, choices, settings, versions, as plain data."""
    return {
        "format": VOYAGE_FORMAT,
        "created": timestamp(created),
        "campaign": analysis.file.model_dump(),
        "versions": program_versions(),
        "inputs": dict(analysis.provenance.inputs),
        "choices": dict(analysis.provenance.choices),
        "notes": {one.run: list(one.notes) for one in analysis.runs},
        "findings": [vars(item) for item in analysis.provenance.findings],
    }


def voyage_text(analysis: Voyage) -> str:
    """The extremes of the voyage with their uncertainties."""
    summary = analysis.summary_frame()
    for name in ("value", "u_rss", "u_linear"):
        summary[name] = [f"{value:.3g}" if np.isfinite(value) else "" for value in summary[name]]
    lines = [
        f"{analysis.file.voyage.name}: sinkage positive down, trim by the bow; steady is a mean over "
        f"{analysis.file.steady.window:g} s",
        "",
        aligned_text(summary, list(summary.columns)),
        "",
        "u_rss: independent sensors; u_linear: all err to one side",
    ]
    return "\n".join([*lines, *(f"note: {one.run}: {note}" for one in analysis.runs for note in one.notes)])
