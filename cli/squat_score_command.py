"""``towtank squat score``: computed curves against a measured one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..core.errors import ReadError, TowtankError


def score(
    efd: Annotated[Path, typer.Option("--efd", help="Measured: column of --by and one column a quantity.")],
    cfd: Annotated[list[Path], typer.Option("--cfd", help="Computed, columns named alike; may be repeated.")],
    by: Annotated[str, typer.Option(help="Column that the curves run over.")] = "speed",
    scale: Annotated[
        float, typer.Option(help="Full-scale length over that of the tables: deviations in m at full scale.")
    ] = 1.0,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN=UNIT", help="Unit of a column where no heading gives it; may be repeated."),
    ] = None,
    near_zero: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN=SIZE", help="A measurement up to this size has no relative score."),
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for tables and page.")] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Quality Q, bias BS and errors of computed curves against a measured one.

    Computed curves are interpolated linearly at the measured points, never extrapolated. Errors are S - D, computed
    less measured; BS sums the signs of D - S. A text column 'case' splits the tables. Motions in waves, columns
    x_amplitude and x_phase, are scored as phasors (motions.csv). With --out: scores.csv (case, quantity, n, Q, BS,
    bias, rms, max_abs, unit), score_details.csv, errors.csv, ranking.csv, totals.csv, scores.json, report.html.

    Example: towtank squat score --efd tank.csv --cfd rans.csv --cfd panel.csv --scale 89.11 --out scores
    """
    from ..squat.code_scores import score_tables
    from ..squat.curve_table import read_curve_table

    units = dict(assignment(word, "--unit") for word in unit or ())
    zeros = {
        name: _number(value, "--near-zero")
        for name, value in (assignment(w, "--near-zero") for w in near_zero or ())
    }
    if out is not None:
        from ..report.score_outputs import require_score_folder

        require_score_folder(out)
    for file in (efd, *cfd):
        if not file.exists():
            raise ReadError("file not found", cure="check the path", file=file)
    measured = read_curve_table(efd, by, units=units)
    result = score_tables(
        measured, [read_curve_table(file, by, units=units) for file in cfd], scale=scale, near_zero=zeros
    )
    written: list[Path] = []
    if out is not None:
        from ..report.score_outputs import write_scores

        written = write_scores(result, out, report=report)
    if quiet:
        return
    if json:
        import json as text

        typer.echo(text.dumps(result.to_dict(), indent=1, ensure_ascii=False))
        return
    from ..report.score_outputs import score_text
    from .campaign_commands import print_findings

    typer.echo(score_text(result))
    print_findings(result.findings)
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def assignment(word: str, option: str) -> tuple[str, str]:
    """Column and value of a word ``column=value``.

    Raises
    ------
    TowtankError
        For a word of another form; it names the option.
    """
    name, _, value = (part.strip() for part in word.partition("="))
    if not (name and value):
        raise TowtankError(f"{option}: '{word}' is not column=value", cure="write for example bow=mm")
    return name, value


def _number(value: str, option: str) -> float:
    try:
        return float(value)
    except ValueError:
        raise TowtankError(f"{option}: '{value}' is no number", cure="write for example trim=0.01") from None
