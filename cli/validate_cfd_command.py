"""``towtank validate-cfd``: computed values against measured ones, with the validation uncertainty and a verdict."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.errors import ReadError, TowtankError
from .derivative_source import load_derivatives
from .progress import progress_bar

if TYPE_CHECKING:
    import pandas as pd

    from ..core.derivative_set import DerivativeSet

WHAT = "table quantity,value,uncertainty[,unit], indices.csv, derivatives.json, results folder, or published set"


@dataclass
class Source:
    """One side of a validation: a derivative set or a table of values, and where it comes from."""

    title: str
    derivatives: DerivativeSet | None = None
    kind: str = "derivatives"
    frame: pd.DataFrame | None = None
    hashes: dict[str, str] = field(default_factory=dict)


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("validate-cfd")(validate_cfd)


def validate_cfd(
    cfd: Annotated[str, typer.Option("--cfd", "-s", metavar="S", help=f"Simulation: {WHAT}.")],
    efd: Annotated[str, typer.Option("--efd", "-d", metavar="D", help=f"Data: {WHAT}.")],
    numerical: Annotated[
        Path | None,
        typer.Option("--numerical", help="Numerical uncertainties U_SN: folder or table of towtank gci."),
    ] = None,
    method: Annotated[
        str, typer.Option("--method", help="Method of --numerical, where its table has several.")
    ] = "",
    coverage: Annotated[
        float, typer.Option("--coverage", "-k", help="Coverage factor of expanded uncertainties.")
    ] = 2.0,
    required: Annotated[
        float | None,
        typer.Option("--required", metavar="PERCENT", help="Uncertainty that the use can bear, % of D."),
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results.")] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Validate computed values, derivatives or manoeuvres: E = S - D against U_V, with a verdict and its level.

    Uncertainties are expanded (95 %); a column std holds standard ones. An empty cell is unknown and gives no verdict.
    With --out: validation.csv, validation.json, report.html, provenance.json.

    Example: towtank validate-cfd --cfd results --efd dtmb5512-efd --out validation
    """
    from ..report.cfd_validation_outputs import (
        ValidationHeading,
        require_cfd_validation_folder,
        write_cfd_validation,
    )
    from ..report.cfd_validation_tables import validation_records, validation_text

    if coverage <= 0.0:
        raise TowtankError(f"the coverage factor {coverage:g} is not positive", cure="give 2 for 95 %")
    if required is not None and not required > 0.0:
        raise TowtankError(f"--required {required:g} is not positive", cure="give per cent of D, e.g. 5")
    if out is not None:
        require_cfd_validation_folder(out)
    simulation, data = _source(cfd, coverage), _source(efd, coverage)
    grids = _grid_table(numerical, method)
    uncertainties = None
    if grids is not None:
        from ..report.value_table import numerical_uncertainties

        units = {} if simulation.frame is None else dict(simulation.frame[["quantity", "unit"]].to_numpy())
        uncertainties = numerical_uncertainties(grids, method, units)
    validation, notes = _validated(simulation, data, uncertainties, coverage, required)
    written: list[Path] = []
    if out is not None:
        hashes = {f"S: {file}": digest for file, digest in simulation.hashes.items()}
        hashes |= {f"D: {file}": digest for file, digest in data.hashes.items()}
        if grids is not None:
            from ..core.provenance import file_hash

            hashes[f"U_SN: {grids.name}"] = file_hash(grids)
        heading = ValidationHeading(
            title=f"{simulation.title} against {data.title}",
            simulation=simulation.title,
            data=data.title,
            conventions=validation.attrs.get("conventions", ""),
            inputs=hashes,
            notes=tuple(notes),
        )
        with progress_bar(not quiet) as bar:
            written = write_cfd_validation(validation, out, heading, report=report, progress=bar)
    if quiet:
        return
    if json:
        import json as text

        typer.echo(text.dumps(validation_records(validation) | {"remarks": notes}, indent=1, ensure_ascii=False))
        return
    typer.echo(validation_text(validation))
    for note in notes:
        typer.echo(note)
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _source(name: str, coverage: float) -> Source:
    path = Path(name)
    if path.is_dir() and not (path / "derivatives.json").is_file() and (path / "indices.csv").is_file():
        path = path / "indices.csv"
    if path.suffix.lower() in (".csv", ".txt"):
        from ..report.value_table import read_values

        table = read_values(path, coverage=coverage)
        if table.kind == "curves":
            raise ReadError(
                f"the table has the columns {', '.join(table.frame.columns)}",
                cure="give columns quantity,value,uncertainty,unit, or score curves with towtank compare",
                file=path,
            )
        if table.kind != "derivatives":
            return Source(path.name, kind=table.kind, frame=table.frame, hashes={table.file: table.sha256})
    derivatives = load_derivatives(name)
    file = path / "derivatives.json" if path.is_dir() else path
    hashes = {}
    if file.is_file():
        from ..core.provenance import file_hash

        hashes = {file.name: file_hash(file)}
    return Source(derivatives.name, derivatives=derivatives, hashes=hashes)


def _grid_table(path: Path | None, method: str) -> Path | None:
    """Table of numerical uncertainties; of a folder of ``towtank gci`` the chosen ones, or those of every method."""
    if path is None and method:
        raise TowtankError("--method without --numerical", cure="give the table of numerical uncertainties")
    if path is not None and path.is_dir():
        return path / ("uncertainty.csv" if method else "chosen_uncertainty.csv")
    return path


def _validated(
    simulation: Source,
    data: Source,
    numerical: dict[str, float] | None,
    coverage: float,
    required: float | None,
) -> tuple[pd.DataFrame, list[str]]:
    """The validation and what has to be said about it."""
    from ..verify.derivative_validation import validate_derivatives
    from ..verify.validation import validate_table

    if simulation.derivatives is not None and data.derivatives is not None:
        from ..report.set_table import with_ship

        first = with_ship(simulation.derivatives, data.derivatives.ship)
        second = with_ship(data.derivatives, simulation.derivatives.ship)
        limits = _limits(dict(zip(second.names, second.values.tolist(), strict=True)), required)
        frame = validate_derivatives(first, second, numerical=numerical, coverage=coverage, required=limits)
        notes = [
            f"'{own.name}' does not say its ship: taken as {known.ship.name}"
            for own, known in ((simulation.derivatives, first), (data.derivatives, second))
            if own is not known
        ]
        if numerical is None and first.covariance is not None:
            notes.append(
                "U_SN is the whole covariance of the simulated set, of its fit and of what was added to it"
            )
        return frame, notes
    if simulation.derivatives is not None or data.derivatives is not None:
        raise TowtankError(
            "a derivative set cannot be validated with a table of values, which names no conventions",
            cure="head its columns name,value,std and write its conventions above, as docs/conventions.md shows",
        )
    assert simulation.frame is not None
    assert data.frame is not None
    computed, notes = simulation.frame.copy(), []
    if simulation.kind == "indices":
        # what spreads simulated indices are the derivatives, which are inputs of the simulation
        computed["input_uncertainty"] = computed["uncertainty"]
        computed["uncertainty"] = 0.0
        notes.append(
            "U_input of simulated indices is the spread of the draws; the integrator's own error counts as 0"
        )
    if numerical is not None:
        if not set(numerical) & set(computed["quantity"]):
            raise TowtankError(
                f"numerical uncertainties of {', '.join(list(numerical)[:4])} belong to no quantity of the simulation",
                cure=f"it has {', '.join(computed['quantity'][:6])}",
            )
        computed["uncertainty"] = [
            numerical.get(name, own)
            for name, own in zip(computed["quantity"], computed["uncertainty"], strict=True)
        ]
    shared = dict(zip(computed["quantity"], computed["covariance"], strict=True))
    limits = _limits(dict(zip(data.frame["quantity"], data.frame["value"], strict=True)), required)
    frame = validate_table(computed, data.frame, coverage=coverage, covariance=shared, required=limits)
    return frame, notes


def _limits(values: dict[str, float], percent: float | None) -> dict[str, float] | None:
    """Required uncertainty of each quantity; none where D is zero, of which there are no per cent."""
    if percent is None:
        return None
    return {name: abs(value) * percent / 100.0 for name, value in values.items() if value}
