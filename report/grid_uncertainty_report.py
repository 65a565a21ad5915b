"""The report of a refinement study: one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from ..core.findings import Finding
from ..core.provenance import program_versions
from ..verify.derivative_uncertainty import DerivativeUncertainty
from ..verify.refinement_study import TIME_STEP, StudyUncertainty
from .drawings import Drawing
from .figure_style import inline_svg
from .grid_uncertainty_figures import convergence_figure, curve_uncertainty_figure
from .grid_uncertainty_tables import chosen_table, derivatives_table, methods_table, pooled_table
from .page_table import Table
from .page_template import page_environment
from .provenance_tables import findings_table, inputs_table, versions_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HERE = Path(__file__).parent

MOST_POINTS = 12
"""Points of a curve that are drawn and tabulated one by one."""


@dataclass(frozen=True)
class NumberSection:
    """What the page shows of one number."""

    title: str
    behaviour: str
    drawing: Drawing
    methods: Table


@dataclass(frozen=True)
class CurveSection:
    """What the page shows of one curve."""

    title: str
    drawing: Drawing
    pooled: Table
    notes: tuple[str, ...]


def render_grid_uncertainty(
    results: Sequence[StudyUncertainty],
    *,
    title: str,
    derivatives: DerivativeUncertainty | None = None,
    findings: Sequence[Finding] = (),
    inputs: Mapping[str, str] | None = None,
    choices: Mapping[str, Any] | None = None,
    over: str = "",
    created: datetime | None = None,
) -> str:
    """The page of a refinement study as HTML, which needs nothing beside itself.

    Parameters
    ----------
    results : sequence of StudyUncertainty
    title : str
    derivatives : DerivativeUncertainty, optional
        What the results are of, when they are derivatives.
    findings : sequence of Finding
    inputs : mapping of str to str, optional
        Hash of each file.
    choices : mapping, optional
        Settings by name.
    over : str
        What curves run over.
    created : datetime, optional
        Time that the page carries; the present one when not given.
    """
    moment = (created or datetime.now(UTC)).astimezone(UTC)
    numbers, curves = [], []
    for place, result in enumerate(results):
        for number, curve in enumerate(result.curves):
            curves.append(
                CurveSection(
                    result.study.quantity,
                    _drawn(
                        curve_uncertainty_figure(curve, name=over),
                        f"curve-{place}-{number}",
                        "Finest grid with its uncertainty point by point.",
                    ),
                    pooled_table(curve.pooled),
                    curve.notes,
                )
            )
        for number, part in enumerate(result.parts[:MOST_POINTS]):
            spacing = "relative time step Δt / Δt₁" if TIME_STEP in part.quantity else "relative cell size h / h₁"
            numbers.append(
                NumberSection(
                    f"{part.quantity or 'value'}{f' [{part.unit}]' if part.unit else ''}",
                    part.behaviour,
                    _drawn(
                        convergence_figure(part, method=result.method, spacing_name=spacing),
                        f"convergence-{place}-{number}",
                        f"{part.behaviour}; bar and band: 95 % by {part.by(result.method).method}.",
                    ),
                    methods_table(part, result.method),
                )
            )
    page: dict[str, Any] = {
        "title": title,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "derivatives": None if derivatives is None else derivatives_table(derivatives),
        "chosen": chosen_table(results),
        "numbers": numbers,
        "curves": curves,
        "findings": findings_table(findings),
        "choices": {name: str(value) for name, value in (choices or {}).items()},
        "versions": versions_text(program_versions()),
        "inputs": inputs_table(inputs or {}),
    }
    return page_environment().get_template("grid_uncertainty.html.j2").render(page)


def _drawn(ax: Axes, name: str, caption: str) -> Drawing:
    figure = ax.get_figure(root=True)
    assert figure is not None
    return Drawing(inline_svg(figure, name, caption), caption)
