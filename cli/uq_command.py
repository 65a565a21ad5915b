"""``towtank uq``: where to run a solver for uncertain inputs, and what the runs say of its outputs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.errors import TowtankError
from .progress import progress_bar

if TYPE_CHECKING:
    from ..verify.input_distribution import UncertainInput


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("uq")(uq)


def uq(
    runs: Annotated[
        Path | None, typer.Argument(metavar="RUNS.csv", help="One row a run: a column for each input and output.")
    ] = None,
    inputs: Annotated[
        list[str] | None,
        typer.Option(
            "--input",
            "-i",
            metavar="NAME=DISTRIBUTION",
            help="Repeat: normal(mean, sd), uniform(low, high), gamma(shape, scale), beta(p, q, low, high).",
        ),
    ] = None,
    plan: Annotated[
        int | None, typer.Option("--plan", metavar="N", help="Write a Latin hypercube of N runs instead.")
    ] = None,
    output: Annotated[
        list[str] | None, typer.Option("--output", help="Repeat: columns to be analysed; all others with numbers.")
    ] = None,
    order: Annotated[
        int | None, typer.Option("--order", "-p", help="Order of the polynomials; what the runs allow.")
    ] = None,
    efd: Annotated[Path | None, typer.Option("--efd", help="Measured outputs: a table quantity,value.")] = None,
    seed: Annotated[int, typer.Option("--seed", help="Seed of random numbers.")] = 0,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder for the results; with --plan a CSV file.")
    ] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Uncertainty of outputs from uncertain inputs: polynomial chaos, Monte Carlo beside it, Sobol indices.

    First --plan writes where to run the solver; then the runs, with their outputs added, are analysed. With --out:
    statistics.csv, sobol.csv, coefficients.csv, report.html, provenance.json.

    Example: towtank uq runs.csv --input "height=normal(62.35, 0.64)" --input "period=normal(1.38, 0.01)" --out uq
    """
    from ..verify.input_distribution import check_inputs, parse_input

    chosen = tuple(parse_input(text) for text in inputs or ())
    check_inputs(chosen)
    if plan is not None:
        if runs is not None:
            raise TowtankError("--plan with a table of runs", cure="give one of them")
        _plan(chosen, plan, seed, out, quiet)
        return
    if runs is None:
        raise TowtankError("no table of runs is given", cure="name it, or write sample points with --plan N")
    from ..report.uncertainty_outputs import (
        UncertaintyHeading,
        require_uncertainty_folder,
        uncertainty_records,
        uncertainty_text,
        write_uncertainty,
    )
    from ..report.uncertainty_table import read_sampled_runs
    from ..verify.propagation import propagate_samples

    if out is not None:
        require_uncertainty_folder(out)
    table = read_sampled_runs(runs, [one.name for one in chosen], output or ())
    hashes = {table.file: table.sha256}
    measured: dict[str, float] = {}
    if efd is not None:
        from ..report.value_table import read_values

        data = read_values(efd)
        if data.kind != "values":
            raise TowtankError("measured outputs need columns quantity,value", cure="name them so", file=efd)
        measured = dict(zip(data.frame["quantity"], data.frame["value"], strict=True))
        hashes[data.file] = data.sha256
    result = propagate_samples(chosen, table.inputs, table.outputs, order=order, seed=seed)
    written: list[Path] = []
    if out is not None:
        heading = UncertaintyHeading(runs.stem, hashes, measured)
        with progress_bar(not quiet) as bar:
            written = write_uncertainty(result, out, heading, report=report, progress=bar)
    if quiet:
        return
    if json:
        import json as text

        typer.echo(text.dumps(uncertainty_records(result), indent=1, ensure_ascii=False))
        return
    typer.echo(uncertainty_text(result, measured))
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _plan(inputs: tuple[UncertainInput, ...], count: int, seed: int, out: Path | None, quiet: bool) -> None:
    """Write or print a Latin hypercube."""
    from ..verify.chaos_basis import term_count
    from ..verify.polynomial_chaos import OVERSAMPLING
    from ..verify.sampling import latin_hypercube

    points = latin_hypercube(inputs, count, seed=seed)
    points.insert(0, "run", range(1, count + 1))
    if out is None:
        typer.echo(points.to_csv(index=False).rstrip())
        return
    from ..formats.write import atomic_path

    with atomic_path(out) as temporary:
        points.to_csv(temporary, index=False)
    if not quiet:
        enough = [p for p in (1, 2, 3) if OVERSAMPLING * term_count(len(inputs), p) <= count]
        typer.echo(
            f"{count} runs -> {out}; add their outputs as columns. "
            + (
                f"Enough for order {max(enough)}."
                if enough
                else "Too few for order 1 with twice its coefficients."
            )
        )
