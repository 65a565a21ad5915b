"""``towtank reproduce``: the gallery of papers."""

from __future__ import annotations

from typing import Annotated

import typer

from .progress import progress_bar


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("reproduce")(reproduce)


def reproduce(
    paper: Annotated[
        list[str] | None, typer.Argument(metavar="[PAPER]", help="Keys of papers; all when none.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print a JSON list of objects.")] = False,
    list_papers: Annotated[bool, typer.Option("--list", help="List the papers.")] = False,
) -> None:
    """Recompute published results: printed value, ours, tolerance, verdict.

    Example: towtank reproduce dtc-pmm
    """
    from ..reproduce import gallery, papers

    if list_papers:
        for key, item in papers().items():
            typer.echo(f"{key:<24} {item.citation}")
        return
    with progress_bar(not as_json) as progress:
        cases = gallery(paper or (), progress=progress)
    if as_json:
        import json

        typer.echo(json.dumps([case.to_dict() for case in cases], indent=1))
        return
    from ..reproduce.table import gallery_text

    typer.echo(gallery_text(cases))
