"""``towtank demo``: the shipped campaigns, from forces to derivatives and from a free decay to damping."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from .progress import progress_bar

DECAY = "decay"


def demo(
    what: Annotated[
        Literal["captive", "decay"], typer.Argument(help="captive: forces to derivatives; decay: roll damping.")
    ] = "captive",
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for campaigns and results.")] = Path(
        "towtank-demo"
    ),
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Run the shipped campaigns: measured DTC static drift, a virtual DTMB 5512 PMM campaign; or a virtual roll decay.

    Each folder holds a campaign file, its data and its results; change the file and run it again with
    towtank run, or towtank decay.

    Example: towtank demo --out towtank-demo
    """
    if what == DECAY:
        _decay(out, quiet)
    else:
        _captive(out, quiet)


def _captive(out: Path, quiet: bool) -> None:
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


def _decay(out: Path, quiet: bool) -> None:
    from ..decay.decay_analysis import run_decay_campaign
    from ..decay.shipped_decay import DEMO, write_decay_campaign
    from ..report.damping_outputs import damping_text, write_damping

    folder = out / DEMO
    with progress_bar(not quiet) as progress:
        file = write_decay_campaign(folder)
        analysis = run_decay_campaign(file, progress=progress)
        results = folder / "results"
        write_damping(analysis, results, progress=progress)
    if quiet:
        return
    typer.echo("virtual record: simulated, not measured; the truth stands in the first line\n")
    typer.echo(damping_text(analysis))
    typer.echo(f"\nreport, open in a browser:\n  {results / 'report.html'}")
    typer.echo(f"next: change {file} and run it again: towtank decay {file} --out {out}/again")
