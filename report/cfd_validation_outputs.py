"""The folder of a validation: table, report, provenance; complete or not at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from ..core.provenance import program_versions
from .cfd_validation_tables import (
    error_table,
    validation_records,
    validation_table,
    validation_totals,
    verdict_sentences,
)
from .page_template import page_environment
from .provenance_tables import inputs_table, versions_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

if TYPE_CHECKING:
    import pandas as pd

CFD_VALIDATION_FORMAT = "towtank cfd-validation 1"


@dataclass(frozen=True)
class ValidationHeading:
    """What stands above a validation.

    Attributes
    ----------
    title : str
    simulation, data : str
        What S and D are.
    conventions : str
        Of the derivatives; empty for other quantities.
    inputs : mapping of str to str
        Hash of each file by its name.
    notes : tuple of str
    """

    title: str
    simulation: str
    data: str
    conventions: str = ""
    inputs: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def require_cfd_validation_folder(out: str | Path) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), CFD_VALIDATION_FORMAT)


def write_cfd_validation(
    validation: pd.DataFrame,
    out: str | Path,
    heading: ValidationHeading,
    *,
    report: bool = True,
    progress: Progress | None = None,
) -> list[Path]:
    """Write ``validation.csv``, ``validation.json``, ``report.html`` and ``provenance.json``.

    Parameters
    ----------
    validation : DataFrame
        From :func:`~towtank.verify.validate_table` or :func:`~towtank.verify.validate_derivatives`.
    out : str or Path
        Folder of the results; made when it is missing.
    heading : ValidationHeading
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
    writers: list[tuple[str, Writer]] = [
        ("validation.csv", csv_writer(lambda: validation)),
        ("validation.json", lambda path: write_json(validation_records(validation), path)),
    ]
    if report:
        writers.append(
            (
                "report.html",
                lambda path: path.write_text(render_cfd_validation(validation, heading), encoding="utf-8"),
            )
        )
    return write_folder(Path(out), writers, _provenance(validation, heading), progress)


def _provenance(validation: pd.DataFrame, heading: ValidationHeading) -> dict[str, Any]:
    return {
        "format": CFD_VALIDATION_FORMAT,
        "created": timestamp(),
        "versions": program_versions(),
        "simulation": heading.simulation,
        "data": heading.data,
        "conventions": heading.conventions,
        "inputs": dict(heading.inputs),
        "coverage factor": validation.attrs["coverage"],
        "notes": list(heading.notes),
    }


def render_cfd_validation(
    validation: pd.DataFrame, heading: ValidationHeading, *, created: datetime | None = None
) -> str:
    """The page of a validation as HTML, which needs nothing beside itself.

    Parameters
    ----------
    validation : DataFrame
    heading : ValidationHeading
    created : datetime, optional
        Time that the page carries; now when not given.
    """
    # drawing needs matplotlib, which the command line must not load at its start
    from .cfd_validation_figures import validation_figure
    from .drawings import Drawing
    from .figure_style import inline_svg

    moment = (created or datetime.now(UTC)).astimezone(UTC)
    axes = validation_figure(validation)
    whole = axes.get_figure(root=True)
    assert whole is not None
    text = "Comparison error of each quantity with the validation uncertainty as a bar"
    caption = (
        "Points: comparison error E = S − D in per cent of |D|. Bars: E ± U_V, the interval of the modelling error. "
        "A quantity whose bar reaches zero is validated at the level U_V."
    )
    page: dict[str, Any] = {
        "heading": heading,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((Path(__file__).parent / "report.css").read_text(encoding="utf-8")),
        "facts": _facts(validation),
        "coverage": f"{validation.attrs['coverage']:g}",
        "drawing_of_errors": Drawing(inline_svg(whole, "validation", text), caption),
        "verdicts": validation_table(validation),
        "errors": error_table(validation),
        "sentences": verdict_sentences(validation),
        "totals": validation_totals(validation),
        "inputs": inputs_table(heading.inputs),
        "versions": versions_text(program_versions()),
    }
    return page_environment().get_template("cfd_validation.html.j2").render(page)


def _facts(validation: pd.DataFrame) -> list[tuple[str, str, str]]:
    counts = validation["verdict"].value_counts()
    return [
        (verdict, str(int(counts.get(verdict, 0))), f"of {len(validation)} quantities")
        for verdict in ("validated", "not validated", "not judged")
    ]
