"""``towtank demo``: the shipped campaigns, from forces to derivative tables and reports."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .progress import progress_bar


def demo(
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for campaigns and results.")] = Path(
        "towtank-demo"
    ),
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Run the shipped campaigns: measured DTC static drift and a virtual DTMB 5512 PMM campaign.

    Each folder holds a campaign file, its data and its results; change the file and run it again with
    towtank run.

    Example: towtank demo --out towtank-demo
    """
    from ..pmm.campaign import Campaign
    from ..pmm.shipped_campaigns import PMM, POINTS, write_pmm_campaign, write_points_campaign
    from ..report.outputs import write_results

    said = []
    with progress_bar(not quiet) as progress:
        files = [
            write_points_campaign(out / POINTS),
            write_pmm_campaign(out / PMM, progress=progress),
        ]
        for file in files:
            result = Campaign.load(file).run(progress=progress)
            results = file.parent / "results"
            write_results(result, results, progress=progress)
            said.append((result.summary(), results / "report.html", file))
    if quiet:
        return
    for summary, _, _ in said:
        typer.echo(summary + "\n")
    typer.echo("reports, open in a browser:")
    for _, report, _ in said:
        typer.echo(f"  {report}")
    typer.echo(f"next: change {said[0][2]} and run it again: towtank run {said[0][2]} --out {out}/again")
