"""The folder of propagated uncertainty: statistics, Sobol indices, coefficients, report; complete or not at all."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from markupsafe import Markup

from ..core.provenance import program_versions
from ..verify.propagation import DRAWS, Propagation
from ..verify.scores import relative_errors
from .aligned_text import aligned_text
from .page_table import Column, Table, make_table
from .page_template import page_environment
from .provenance_tables import inputs_table, versions_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder
from .typography import fixed, signed, significant

UNCERTAINTY_FORMAT = "towtank propagated-uncertainty 1"


@dataclass(frozen=True)
class UncertaintyHeading:
    """What stands above propagated uncertainty.

    Attributes
    ----------
    title : str
    inputs : mapping of str to str
        Hash of each file by its name.
    measured : mapping of str to float
        Measured values of outputs; may be empty.
    """

    title: str
    inputs: Mapping[str, str] = field(default_factory=dict)
    measured: Mapping[str, float] = field(default_factory=dict)


def require_uncertainty_folder(out: str | Path) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), UNCERTAINTY_FORMAT)


def write_uncertainty(
    propagation: Propagation,
    out: str | Path,
    heading: UncertaintyHeading,
    *,
    report: bool = True,
    progress: Progress | None = None,
) -> list[Path]:
    """Write ``statistics.csv``, ``sobol.csv``, ``coefficients.csv``, ``report.html`` and ``provenance.json``.

    Parameters
    ----------
    propagation : Propagation
    out : str or Path
        Folder of the results; made when it is missing.
    heading : UncertaintyHeading
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
        ("statistics.csv", csv_writer(propagation.statistics)),
        ("sobol.csv", csv_writer(lambda: propagation.sobol)),
        ("coefficients.csv", csv_writer(propagation.expansion.coefficient_frame)),
    ]
    if report:
        writers.append(
            (
                "report.html",
                lambda path: path.write_text(render_uncertainty(propagation, heading), encoding="utf-8"),
            )
        )
    provenance = {
        "format": UNCERTAINTY_FORMAT,
        "created": timestamp(),
        "versions": program_versions(),
        "inputs": dict(heading.inputs),
        "distributions": {one.name: str(one) for one in propagation.inputs},
        "order": propagation.expansion.basis.order,
        "seed": propagation.seed,
        "draws": DRAWS,
        "notes": list(propagation.notes),
    }
    return write_folder(Path(out), writers, provenance, progress)


def uncertainty_text(propagation: Propagation, measured: Mapping[str, float]) -> str:
    """Statistics and Sobol indices as lines for a terminal."""
    fit = propagation.expansion
    inputs = ", ".join(f"{one.name} {one} -> {one.polynomial}" for one in propagation.inputs)
    head = [
        inputs,
        f"order {fit.basis.order}: {len(fit.basis.orders)} coefficients from {fit.samples} runs "
        f"(oversampling {fit.oversampling:g}), condition number {fit.condition:.3g}",
    ]
    frame = propagation.statistics()
    columns = ["output", "method", "mean", "mean_error", "sd", "p05", "p95", "r2", "leave_one_out"]
    if measured:
        data = [measured.get(name, math.nan) for name in frame["output"]]
        errors = relative_errors(frame["mean"].to_numpy(float), data)
        frame["D"], frame["(D-S)/D [%]"] = data, errors.d_minus_s
        columns += ["D", "(D-S)/D [%]"]
    blocks = [
        "\n".join(head),
        aligned_text(frame, columns),
        aligned_text(propagation.sobol, ["output", "input", "first", "total"]),
    ]
    blocks += ["\n".join(propagation.notes)] if propagation.notes else []
    return "\n\n".join(blocks)


def uncertainty_records(propagation: Propagation) -> dict[str, Any]:
    """Statistics, Sobol indices and coefficients as plain data; None for what is unknown."""
    fit = propagation.expansion

    def plain(frame: Any) -> list[dict[str, Any]]:
        return [
            {key: None if isinstance(value, float) and math.isnan(value) else value for key, value in row.items()}
            for row in frame.to_dict("records")
        ]

    return {
        "distributions": {one.name: str(one) for one in propagation.inputs},
        "order": fit.basis.order,
        "coefficients_fitted": len(fit.basis.orders),
        "oversampling": fit.oversampling,
        "condition": fit.condition,
        "statistics": plain(propagation.statistics()),
        "sobol": plain(propagation.sobol),
        "coefficients": plain(fit.coefficient_frame()),
        "notes": list(propagation.notes),
    }


def render_uncertainty(
    propagation: Propagation, heading: UncertaintyHeading, *, created: datetime | None = None
) -> str:
    """The page of propagated uncertainty as HTML, which needs nothing beside itself.

    Parameters
    ----------
    propagation : Propagation
    heading : UncertaintyHeading
    created : datetime, optional
        Time that the page carries; now when not given.
    """
    # drawing needs matplotlib, which the command line must not load at its start
    from .drawings import Drawing
    from .figure_style import inline_svg
    from .uncertainty_figures import distribution_figure, sobol_figure

    def drawn(axes: Any, name: str, text: str) -> Drawing:
        return Drawing(inline_svg(axes.get_figure(root=True), name, text))

    moment = (created or datetime.now(UTC)).astimezone(UTC)
    fit = propagation.expansion
    page: dict[str, Any] = {
        "title": heading.title,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((Path(__file__).parent / "report.css").read_text(encoding="utf-8")),
        "facts": [
            ("runs", str(fit.samples), f"{fit.oversampling:.3g} a coefficient"),
            ("order", str(fit.basis.order), f"{len(fit.basis.orders)} coefficients"),
            ("condition number", significant(fit.condition, 3), "of the regression"),
        ],
        "inputs_used": _inputs_used(propagation),
        "statistics": _statistics(propagation, heading.measured),
        "distributions": [
            drawn(
                distribution_figure(propagation, name, measured=heading.measured.get(name)),
                f"distribution-{j}",
                f"Distribution of {name}",
            )
            for j, name in enumerate(fit.outputs)
        ],
        "sobol": drawn(sobol_figure(propagation), "sobol", "Shares of the variance by input"),
        "coefficients": _coefficients(propagation),
        "notes": propagation.notes,
        "files": inputs_table(heading.inputs),
        "versions": versions_text(program_versions()),
    }
    return page_environment().get_template("uncertainty.html.j2").render(page)


def _inputs_used(propagation: Propagation) -> Table:
    columns = [Column("input"), Column("distribution", "short"), Column("mean", "number"), Column("sd", "number")]
    rows = [(one.name, str(one), significant(one.mean, 5), significant(one.sd, 3)) for one in propagation.inputs]
    return make_table(
        [*columns, Column("polynomials", "short")],
        [(*row, one.polynomial) for row, one in zip(rows, propagation.inputs, strict=True)],
    )


def _statistics(propagation: Propagation, measured: Mapping[str, float]) -> Table:
    columns = [Column("output"), Column("method", "short")]
    columns += [Column(name, "number") for name in ("mean", "± its error", "sd", "5 %", "95 %", "R²")]
    columns.append(Column("left out", "number", "mean square error of leaving out each run, over the variance"))
    if measured:
        columns.append(Column("(D−S)/D [%]", "number"))
    rows = []
    spreads = dict(zip(propagation.expansion.outputs, propagation.expansion.sd.tolist(), strict=True))
    for row in propagation.statistics().to_dict("records"):
        sd = spreads[row["output"]]
        places = max(2 - math.floor(math.log10(sd)), 0) if sd > 0.0 else 4
        cells = [str(row["output"]), str(row["method"]), fixed(row["mean"], places)]
        cells += [fixed(row[name], places) for name in ("mean_error", "sd", "p05", "p95")]
        cells += [fixed(row["r2"], 3), fixed(row["leave_one_out"], 2)]
        if measured:
            data = measured.get(row["output"], math.nan)
            error = relative_errors([row["mean"]], [data]).d_minus_s[0]
            cells.append(signed(float(error), 2))
        rows.append(cells)
    return make_table(columns, rows)


def _coefficients(propagation: Propagation) -> Table:
    columns = [Column("output"), Column("term", "code"), Column("coefficient", "number"), Column("± sd", "number")]
    columns += [Column("mean square", "number"), Column("share of the variance", "number")]
    rows = [
        [
            str(row["output"]),
            str(row["term"]),
            significant(row["coefficient"], 4),
            significant(row["coefficient_sd"], 2),
            significant(row["norm"], 3),
            fixed(row["share"], 4),
        ]
        for row in propagation.expansion.coefficient_frame().to_dict("records")
    ]
    return make_table(columns, rows)
