"""``towtank squat voyage``: a full-scale record of RTK antennas to squat and clearance."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .progress import progress_bar


def voyage(
    file: Annotated[Path, typer.Argument(metavar="VOYAGE.toml", help="Ship, antennas, tide, rest and records.")],
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for tables and page.")] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Squat at full scale: tide, density and static draught taken out, steady and unsteady, water under the keel.

    With --out: voyage.csv (every quantity over time), voyage_summary.csv, sensor_budget.csv, voyage.json, report.html.

    Example: towtank squat voyage voyage.toml --out voyage
    """
    if out is not None:
        from ..report.voyage_outputs import require_voyage_folder

        require_voyage_folder(out)
    from ..report.voyage_outputs import Voyage, voyage_text, write_voyage
    from ..squat.voyage_file import load_voyage
    from ..squat.voyage_reduction import reduce_voyage, voyage_provenance

    with progress_bar(not quiet) as progress:
        found = reduce_voyage(file, progress=progress)
        analysis = Voyage(load_voyage(file), tuple(found), voyage_provenance(file, found))
        written = [] if out is None else write_voyage(analysis, out, report=report, progress=progress)
    if quiet:
        return
    if json:
        import json as text

        typer.echo(text.dumps(analysis.to_dict(), indent=1, ensure_ascii=False))
        return
    from .campaign_commands import print_findings

    typer.echo(voyage_text(analysis))
    print_findings(analysis.provenance.findings)
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")
