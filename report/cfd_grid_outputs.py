"""The folder of a grid study: derivatives with numerical uncertainty, comparison, report; complete or not at all."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from markupsafe import Markup

from ..cfd.grid_study import GridStudy
from ..cfd.settled_loads import settled_table
from ..core.provenance import file_hash, program_versions
from .cfd_grid_tables import grid_derivatives_table, grids_table
from .cfd_settling_outputs import drawn_cases, settling_row
from .cfd_settling_tables import verdict_table
from .cfd_validation_tables import validation_table, validation_totals
from .comparison import compare_sets
from .drawings import Drawing, Row
from .page_template import page_environment
from .provenance_tables import findings_table, versions_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder
from .ship_particulars import particulars

GRID_STUDY_FORMAT = "towtank cfd-grid-study 1"
DRAWN_CASES = 2
HERE = Path(__file__).parent


def require_grid_study_folder(out: str | Path) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), GRID_STUDY_FORMAT)


def write_grid_study(
    study: GridStudy, out: str | Path, *, report: bool = True, progress: Progress | None = None
) -> list[Path]:
    """Write what a grid study yields.

    Files are ``derivatives.csv`` and ``derivatives.json`` (finest grid, covariance of fit and numerical error),
    ``grid_derivatives.csv``, ``uncertainty.csv`` (every method for every derivative), ``settled.csv``, with an
    experiment ``validation.csv`` and ``comparison.csv`` (A: experiment, B: computation), ``report.html`` and
    ``provenance.json``.

    Parameters
    ----------
    study : GridStudy
    out : str or Path
    report : bool
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("derivatives.csv", study.derivatives.to_csv),
        ("derivatives.json", study.derivatives.to_json),
        ("grid_derivatives.csv", csv_writer(study.table)),
        ("uncertainty.csv", csv_writer(lambda: study.uncertainty.methods)),
        ("settled.csv", csv_writer(lambda: settled_table(study.settled))),
    ]
    validation = study.validation
    if validation is not None:
        writers.append(("validation.csv", csv_writer(lambda: validation)))
    reference = study.reference
    if reference is not None:
        writers.append(("comparison.csv", csv_writer(lambda: compare_sets(reference, study.derivatives))))
    if report:
        writers.append(
            (
                "report.html",
                lambda path: path.write_text(render_grid_study(study, progress=progress), encoding="utf-8"),
            )
        )
    return write_folder(Path(out), writers, _provenance(study), progress)


def _provenance(study: GridStudy) -> dict[str, Any]:
    return {
        "format": GRID_STUDY_FORMAT,
        "created": timestamp(),
        "versions": program_versions(),
        "name": study.name,
        "virtual": study.truth is not None,
        "grids": {grid: float(h) for grid, h in zip(study.grids, study.spacings, strict=True)},
        "reference": "" if study.reference is None else study.reference.name,
        "inputs": {f"{file.parent.name}/{file.name}": file_hash(file) for file in study.campaigns},
        "findings": [vars(item) for item in study.findings],
    }


def render_grid_study(
    study: GridStudy, *, created: datetime | None = None, progress: Progress | None = None
) -> str:
    """The page of a grid study as HTML, which needs nothing beside itself.

    Parameters
    ----------
    study : GridStudy
    created : datetime, optional
        Time that the page carries; now when not given.
    progress : callable, optional
    """
    # drawing needs matplotlib, which the command line must not load at its start
    from .cfd_grid_figures import derivative_convergence_figure
    from .cfd_validation_figures import validation_figure
    from .figure_style import inline_svg

    def drawn(axes: Any, name: str, text: str) -> Drawing:
        return Drawing(inline_svg(axes.get_figure(root=True), name, text))

    moment = (created or datetime.now(UTC)).astimezone(UTC)
    names = study.derivatives.names
    convergence = []
    for number, name in enumerate(names):
        if progress:
            progress("drawing", number, len(names))
        axes = derivative_convergence_figure(study, name)
        convergence.append(drawn(axes, f"h{number}", f"{name} against the grid spacing"))
    validation = study.validation
    truth = study.table()["truth inside"] if study.truth is not None else None
    facts = [
        ("cases", str(len(study.settled)), f"{len(study.grids)} grids"),
        ("derivatives", str(len(names)), "fitted on each grid"),
    ]
    if truth is not None:
        facts.append(("truth inside", f"{int(truth.sum())} of {len(truth)}", "value ± U95"))
    if validation is not None and study.reference is not None:
        good = int((validation["verdict"] == "validated").sum())
        facts.append(("validated", f"{good} of {len(validation)}", f"against {study.reference.name}"))
    page: dict[str, Any] = {
        "name": study.name,
        "virtual": study.truth is not None,
        "truth": "" if study.truth is None else study.truth.name,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "particulars": particulars([study.derivatives.ship]),
        "facts": facts,
        "grids": grids_table(study),
        "derivatives": grid_derivatives_table(study),
        "convergence": Row("", tuple(convergence)),
        "validation": None if validation is None else validation_table(validation),
        "validation_drawing": None
        if validation is None
        else drawn(validation_figure(validation), "validation", "Comparison error of each derivative"),
        "totals": [] if validation is None else validation_totals(validation),
        "reference": "" if study.reference is None else study.reference.name,
        "settled": verdict_table(study.settled),
        "rows": [
            settling_row(item, f"s{number}")
            for number, item in enumerate(drawn_cases(study.settled, DRAWN_CASES), start=1)
        ],
        "findings": findings_table(study.findings),
        "versions": versions_text(program_versions()),
    }
    return page_environment().get_template("cfd_grid_study.html.j2").render(page)
