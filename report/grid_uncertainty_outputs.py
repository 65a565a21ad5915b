"""The folder of a refinement study: tables, page, provenance; complete or not at all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..core.findings import Finding
from ..core.provenance import program_versions
from ..verify.derivative_uncertainty import DerivativeUncertainty
from ..verify.numerical_uncertainty import UNCERTAINTY_COLUMNS, uncertainty_table
from ..verify.refinement_study import StudyUncertainty
from .grid_uncertainty_tables import derivative_records, uncertainty_records
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

GRID_UNCERTAINTY_FORMAT = "towtank grid-uncertainty 1"


def require_grid_uncertainty_folder(out: str | Path) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), GRID_UNCERTAINTY_FORMAT)


def write_grid_uncertainty(
    results: Sequence[StudyUncertainty],
    out: str | Path,
    *,
    title: str,
    derivatives: DerivativeUncertainty | None = None,
    findings: Sequence[Finding] = (),
    inputs: Mapping[str, str] | None = None,
    choices: Mapping[str, Any] | None = None,
    over: str = "",
    report: bool = True,
    progress: Progress | None = None,
) -> list[Path]:
    """Write a refinement study.

    Files are ``uncertainty.csv`` (every method; quantity, method, class, order, extrapolated, uncertainty, unit),
    ``chosen_uncertainty.csv`` (the same columns, one row a number: the method that counts), ``uncertainty.json`` (with
    notes, ratios and relative values), ``report.html`` and ``provenance.json``; for derivatives also
    ``derivative_uncertainty.csv`` (numerical uncertainty beside that of the fit), ``derivatives.csv`` and
    ``derivatives.json`` (the set of the finest grid with both in its covariance).

    Parameters
    ----------
    results : sequence of StudyUncertainty
    out : str or Path
        Folder of the results; made when it is missing.
    title : str
        Heading of the page.
    derivatives : DerivativeUncertainty, optional
        What the results are of, when they are derivatives.
    findings : sequence of Finding
    inputs : mapping of str to str, optional
        Hash of each file.
    choices : mapping, optional
        Settings by name.
    over : str
        What curves run over.
    report : bool
        Write ``report.html``.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    columns = list(UNCERTAINTY_COLUMNS)
    every = [estimate for result in results for estimate in result.estimates]
    chosen = [estimate for result in results for estimate in result.chosen]
    writers: list[tuple[str, Writer]] = [
        ("uncertainty.csv", csv_writer(lambda: uncertainty_table(every)[columns])),
        ("chosen_uncertainty.csv", csv_writer(lambda: uncertainty_table(chosen)[columns])),
        ("uncertainty.json", lambda path: write_json(uncertainty_data(results, findings, derivatives), path)),
    ]
    if derivatives is not None:
        writers += [
            ("derivative_uncertainty.csv", csv_writer(lambda: derivatives.table)),
            ("derivatives.csv", derivatives.combined.to_csv),
            ("derivatives.json", derivatives.combined.to_json),
        ]
    if report:

        def write_page(path: Path) -> None:
            # drawing needs matplotlib, which the command line must not load at its start
            from .grid_uncertainty_report import render_grid_uncertainty

            page = render_grid_uncertainty(
                results,
                title=title,
                derivatives=derivatives,
                findings=findings,
                inputs=inputs,
                choices=choices,
                over=over,
            )
            path.write_text(page, encoding="utf-8")

        writers.append(("report.html", write_page))
    provenance = {
        "format": GRID_UNCERTAINTY_FORMAT,
        "created": timestamp(),
        "versions": program_versions(),
        "inputs": dict(inputs or {}),
        "choices": dict(choices or {}),
        "findings": [vars(finding) for finding in findings],
    }
    return write_folder(Path(out), writers, provenance, progress)


def uncertainty_data(
    results: Sequence[StudyUncertainty],
    findings: Sequence[Finding] = (),
    derivatives: DerivativeUncertainty | None = None,
) -> dict[str, Any]:
    """Results and findings as plain data; None for what does not exist."""
    data: dict[str, Any] = {} if derivatives is None else {"derivatives": derivative_records(derivatives)}
    return data | {
        "quantities": uncertainty_records(results),
        "findings": [{"rule": one.rule, "severity": one.severity, "message": one.message} for one in findings],
    }
