"""``towtank compare``: derivative sets, tables of values, manoeuvring indices or curves against a reference."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.derivative_set import DerivativeSet
from ..core.errors import ReadError, TowtankError
from .derivative_source import load_derivatives

if TYPE_CHECKING:
    import pandas as pd

    from ..report.value_table import ValueTable


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("compare")(compare)


def compare(
    a: Annotated[
        str, typer.Argument(metavar="A", help="Reference (experiment): set, results folder, or table of results.")
    ],
    b: Annotated[list[str], typer.Argument(metavar="B...", help="What is judged (CFD): of the same kind as A.")],
    by: Annotated[
        str, typer.Option("--by", help="Column to compare curves over: speed, drift angle, ...")
    ] = "speed",
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Write the table as CSV.")] = None,
) -> None:
    """Score derivatives, values, manoeuvring indices or curves: errors in the three sign conventions, Q, BS, z.

    Several B are also ranked. Tables have columns name,value (derivatives), quantity,value, manoeuvre,index,value, or
    one column to compare over and one for each quantity.

    Example: towtank compare dtmb5512-efd results
    """
    reference, judged = _side(a), [_side(name) for name in b]
    sets = [own for own in judged if isinstance(own, DerivativeSet)]
    tables = [own for own in judged if not isinstance(own, DerivativeSet)]
    if isinstance(reference, DerivativeSet):
        if tables:
            raise TowtankError("A is a derivative set, a B is not", cure="compare things of one kind")
        table = _sets(reference, sets)
    else:
        kinds = {own.kind for own in (reference, *tables)}
        if sets or ("curves" in kinds and len(kinds) > 1):
            raise TowtankError("A and B are not of one kind", cure="compare sets with sets, curves with curves")
        named = _named(tables)
        table = _curves(reference, named, by) if reference.kind == "curves" else _values(reference, named)
    if out is not None:
        from ..formats.write import atomic_path

        with atomic_path(out) as temporary:
            table.to_csv(temporary, index=False)
        typer.echo(f"written: {out}")


def _side(name: str) -> DerivativeSet | ValueTable:
    """A derivative set, or a table of results."""
    path = Path(name)
    if path.is_dir() and not (path / "derivatives.json").is_file() and (path / "indices.csv").is_file():
        path = path / "indices.csv"
    if path.suffix.lower() == ".csv":
        from ..report.value_table import read_values

        table = read_values(path)
        if table.kind != "derivatives":
            return table
    return load_derivatives(name)


def _named(tables: list[ValueTable]) -> dict[str, ValueTable]:
    named = {table.file: table for table in tables}
    if len(named) < len(tables):
        raise ReadError("two tables have the same name", cure="name the files differently")
    return named


def _sets(reference: DerivativeSet, judged: list[DerivativeSet]) -> pd.DataFrame:
    import pandas as pd

    from ..report.comparison import compare_sets, comparison_text

    frames = []
    for own in judged:
        comparison = compare_sets(reference, own)
        typer.echo(comparison_text(comparison))
        if len(judged) > 1:
            typer.echo("")
            comparison = comparison.copy()
            comparison.insert(0, "set", own.name)
            comparison.attrs = {}
        frames.append(comparison)
    if len(judged) == 1:
        return frames[0]
    from ..report.table_comparison import rank_sets, ranking_text

    typer.echo(ranking_text(rank_sets(reference, judged)))
    return pd.concat(frames, ignore_index=True)


def _values(reference: ValueTable, judged: dict[str, ValueTable]) -> pd.DataFrame:
    import pandas as pd

    from ..report.table_comparison import compare_values, rank_values, ranking_text, values_text

    frames = []
    for name, own in judged.items():
        comparison = compare_values(reference.frame, own.frame)
        typer.echo(values_text(comparison, reference.file, name))
        typer.echo("")
        comparison.insert(0, "table", name)
        comparison.attrs = {}
        frames.append(comparison)
    if len(judged) > 1:
        ranking = rank_values(
            dict(zip(reference.frame["quantity"], reference.frame["value"], strict=True)),
            {
                name: dict(zip(own.frame["quantity"], own.frame["value"], strict=True))
                for name, own in judged.items()
            },
        )
        typer.echo(ranking_text(ranking))
    return pd.concat(frames, ignore_index=True)


def _curves(reference: ValueTable, judged: dict[str, ValueTable], by: str) -> pd.DataFrame:
    from ..report.aligned_text import aligned_text
    from ..report.table_comparison import compare_curves

    scores, pooled = compare_curves(reference.frame, {name: own.frame for name, own in judged.items()}, by)
    columns = ["case", "quantity", "n", "Q", "BS", "bias", "rms", "mean_absolute_percent", "max_abs", "note"]
    typer.echo(aligned_text(scores, columns))
    if len(judged) > 1:
        typer.echo("\nall tables together\n" + aligned_text(pooled, ["quantity", "n", "Q", "BS"]))
    return scores
