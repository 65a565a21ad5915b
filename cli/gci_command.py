"""``towtank gci``: numerical uncertainty from grids or time steps, every method beside the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.errors import ReadError, TowtankError
from .campaign_commands import print_findings
from .progress import progress_bar

if TYPE_CHECKING:
    import numpy as np

    from ..report.grid_table import GridTable
    from ..verify.derivative_uncertainty import DerivativeUncertainty


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("gci")(gci)


def gci(
    table: Annotated[
        Path | None,
        typer.Argument(
            metavar="[TABLE]", help="Columns cells (or h, time_step) and one a quantity; a row a grid."
        ),
    ] = None,
    phi: Annotated[
        str | None, typer.Option("--phi", metavar="F,M,C", help="Values of one quantity instead of a table.")
    ] = None,
    sets: Annotated[
        list[str] | None,
        typer.Option(
            "--set", "-s", metavar="SET", help="derivatives.json or results folder of a grid; once a grid."
        ),
    ] = None,
    cells: Annotated[str | None, typer.Option("--cells", metavar="N,N,N", help="Cells of its grids.")] = None,
    spacing: Annotated[
        str | None, typer.Option("--spacing", metavar="H,H,H", help="Cell sizes or time steps of its grids.")
    ] = None,
    ratio: Annotated[
        float | None, typer.Option("--ratio", help="One refinement ratio for --phi, which is then finest first.")
    ] = None,
    dimension: Annotated[
        int, typer.Option("--dim", help="Directions that the cell counts refine: 1, 2 or 3.")
    ] = 3,
    assumed: Annotated[
        float | None,
        typer.Option("--assumed", help="Ratio that the study claims; a warning where cells disagree."),
    ] = None,
    formal_order: Annotated[float, typer.Option("--order", help="Formal order of the scheme.")] = 2.0,
    method: Annotated[
        str, typer.Option("--method", help="Whose uncertainty counts: default, 'GCI Celik', 'Eca-Hoekstra', ...")
    ] = "default",
    over: Annotated[str, typer.Option("--over", help="Column that curves run over, e.g. drift_angle.")] = "",
    interpolate: Annotated[
        bool, typer.Option("--interpolate", help="Bring curves to the finest grid's points; else common points.")
    ] = False,
    only: Annotated[str, typer.Option("--only", help="Quantities wanted, separated by commas.")] = "",
    name: Annotated[str, typer.Option("--name", help="Name of the quantity of --phi.")] = "phi",
    unit: Annotated[str, typer.Option("--unit", help="Its unit.")] = "",
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results.")] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Numerical uncertainty of CFD results by every method: GCI, correction factor, factor of safety, least squares.

    With --out: uncertainty.csv (quantity, method, class, order, extrapolated, uncertainty, unit),
    chosen_uncertainty.csv, uncertainty.json, report.html, provenance.json. U is the half-width of about 95 %.
    With --set, once a grid: derivatives with numerical uncertainty and the fit's together, derivatives.json.

    Example: towtank gci --phi 6.063,5.972,5.863 --cells 18000,8000,4500 --dim 2
    """
    if [table is None, phi is None, not sets].count(False) != 1:
        raise TowtankError(
            "give either a table, --phi or --set",
            cure="towtank gci grids.csv, or towtank gci --phi 3,2,1 --ratio 2",
        )
    if out is not None:
        from ..report.grid_uncertainty_outputs import require_grid_uncertainty_folder

        require_grid_uncertainty_folder(out)
    if assumed is not None and not assumed > 1.0:
        raise TowtankError(f"--assumed {assumed:g} does not exceed 1", cure="give coarse over fine, e.g. 1.4")
    with progress_bar(not quiet) as bar:
        from ..verify.numerical_uncertainty import DEFAULT, METHODS
        from ..verify.refinement_study import study_uncertainty

        if method not in (DEFAULT, *METHODS):
            raise TowtankError(
                f"there is no method '{method}'", cure=f"use one of {DEFAULT}, {', '.join(METHODS)}"
            )

        derivatives = None
        if table is not None:
            _refuse(table, cells=cells, spacing=spacing, ratio=ratio)
            from ..report.grid_table import read_grid_table

            data = read_grid_table(
                table,
                dimension=dimension,
                over=over,
                quantities=[word.strip() for word in only.split(",") if word.strip()],
                assumed_ratio=assumed,
            )
        elif phi is not None:
            data = _typed(phi, _Fineness(cells, spacing, ratio, dimension), assumed, name, unit)
        else:
            h = _Fineness(cells, spacing, ratio, dimension).of(len(sets or ()), "--set")
            derivatives = _derivatives(sets or [], h, method, formal_order)
            data = _studies_of(derivatives, h, assumed)
        try:
            results = [
                study_uncertainty(study, method=method, formal_order=formal_order, interpolate=interpolate)
                for study in data.studies
            ]
        except TowtankError as error:
            raise TowtankError(error.cause, cure=error.cure, file=data.file or None, place=error.place) from None
        written: list[Path] = []
        if out is not None:
            from ..report.grid_uncertainty_outputs import write_grid_uncertainty

            written = write_grid_uncertainty(
                results,
                out,
                title=f"Numerical uncertainty of {_what(data, derivatives, name)}",
                derivatives=derivatives,
                findings=data.findings,
                inputs={data.file: data.sha256} if data.file else {},
                choices={
                    **({"sets": ", ".join(sets)} if sets else {}),
                    "method": method,
                    "directions refined": dimension,
                    "formal order": formal_order,
                    "assumed ratio": "none" if assumed is None else assumed,
                    "curves over": over or "none",
                    "curves interpolated": interpolate,
                },
                over=over,
                report=report,
                progress=bar,
            )
    if quiet:
        return
    if json:
        import json as writer

        from ..report.grid_uncertainty_outputs import uncertainty_data

        typer.echo(
            writer.dumps(uncertainty_data(results, data.findings, derivatives), indent=1, ensure_ascii=False)
        )
        return
    from ..report.grid_uncertainty_tables import derivative_text, uncertainty_text

    typer.echo(uncertainty_text(results) if derivatives is None else derivative_text(derivatives))
    print_findings(data.findings)
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _refuse(table: Path, **options: object) -> None:
    """A table says itself how fine its grids are."""
    for option, value in options.items():
        if value is not None:
            raise TowtankError(f"--{option} beside a table", cure="give it as a column of the table", file=table)


@dataclass(frozen=True)
class _Fineness:
    """What the options say of the grids."""

    cells: str | None
    spacing: str | None
    ratio: float | None
    dimension: int

    def of(self, count: int, option: str) -> np.ndarray:
        """Spacings of `count` grids."""
        import numpy as np

        from ..verify.refinement import spacings_from_cells, spacings_from_ratio

        said = {"--cells": self.cells, "--spacing": self.spacing, "--ratio": self.ratio}
        given = [name for name, value in said.items() if value is not None]
        if len(given) != 1:
            words = " and ".join(given) or "none of --cells, --spacing, --ratio"
            raise TowtankError(
                f"{option} with {words}", cure="say once how fine the grids are, e.g. --cells 18000,8000,4500"
            )
        if self.ratio is not None:
            return spacings_from_ratio(count, self.ratio)
        if self.cells is not None:
            h = spacings_from_cells(_numbers(self.cells, "--cells"), self.dimension)
        else:
            h = np.array(_numbers(self.spacing or "", "--spacing"))
        if h.size != count:
            raise TowtankError(f"{count} values on {h.size} grids", cure="give one value a grid")
        return h


def _typed(phi: str, fineness: _Fineness, assumed: float | None, name: str, unit: str) -> GridTable:
    """The study that the options describe."""
    import numpy as np

    from ..report.grid_table import GridTable
    from ..verify.refinement import refinement_findings
    from ..verify.refinement_study import Refinement, RefinementStudy

    values = np.array(_numbers(phi, "--phi"))
    h = fineness.of(values.size, "--phi")
    return GridTable(
        "", "", (RefinementStudy(name, unit, Refinement(values, h)),), refinement_findings(h, assumed)
    )


def _derivatives(sets: Sequence[str], h: np.ndarray, method: str, formal_order: float) -> DerivativeUncertainty:
    from ..verify.derivative_uncertainty import derivative_uncertainty
    from .derivative_source import load_derivatives

    return derivative_uncertainty(
        [load_derivatives(name) for name in sets], h, method=method, formal_order=formal_order
    )


def _studies_of(derivatives: DerivativeUncertainty, h: np.ndarray, assumed: float | None) -> GridTable:
    """One study a derivative."""
    from ..report.grid_table import GridTable
    from ..verify.refinement import refinement_findings
    from ..verify.refinement_study import Refinement, RefinementStudy

    studies = tuple(
        RefinementStudy(one.quantity, one.unit, Refinement(one.values, one.spacings))
        for one in derivatives.quantities
    )
    return GridTable("", "", studies, (*refinement_findings(h, assumed), *derivatives.findings))


def _what(data: GridTable, derivatives: DerivativeUncertainty | None, name: str) -> str:
    if derivatives is not None:
        return derivatives.combined.name
    return Path(data.file).stem if data.file else name


def _numbers(text: str, option: str) -> Sequence[float]:
    try:
        return [float(word) for word in text.split(",")]
    except ValueError:
        raise ReadError(
            f"{option} {text} is no list of numbers", cure="separate them by commas, with decimal points"
        ) from None
