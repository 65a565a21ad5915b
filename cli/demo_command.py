"""``towtank demo``: the shipped campaigns, forces to derivatives, a free decay to damping, sinkage to squat."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from .progress import progress_bar

DECAY, SQUAT, CFD = "decay", "squat", "cfd"


def demo(
    what: Annotated[
        Literal["captive", "decay", "squat", "cfd"],
        typer.Argument(
            help="captive: forces to derivatives; decay: roll damping; squat: sinkage to squat; "
            "cfd: computations on three grids to derivatives."
        ),
    ] = "captive",
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for campaigns and results.")] = Path(
        "towtank-demo"
    ),
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Run the shipped campaigns: measured DTC static drift, a virtual DTMB 5512 PMM campaign and a virtual KVLCC2
    campaign whose fitted set is sailed; a virtual roll decay; virtual squat records with scored computations; or a
    virtual CFD sweep on three grids.

    Each folder holds a campaign file, its data and its results; change the file and run it again with
    towtank run, towtank decay, or towtank squat reduce.

    Example: towtank demo --out towtank-demo
    """
    if what == DECAY:
        _decay(out, quiet)
    elif what == SQUAT:
        _squat(out, quiet)
    elif what == CFD:
        _cfd(out, quiet)
    else:
        _captive(out, quiet)


def _captive(out: Path, quiet: bool) -> None:
    from ..pmm.campaign import Campaign
    from ..pmm.shipped_campaigns import (
        MANOEUVRES,
        PMM,
        POINTS,
        write_manoeuvres_campaign,
        write_pmm_campaign,
        write_points_campaign,
    )
    from ..report.campaign_manoeuvres import sail_campaign, sailed_text
    from ..report.outputs import write_results

    said = []
    with progress_bar(not quiet) as progress:
        files = [
            write_points_campaign(out / POINTS),
            write_pmm_campaign(out / PMM, progress=progress),
            write_manoeuvres_campaign(out / MANOEUVRES, progress=progress),
        ]
        for file in files:
            result = Campaign.load(file).run(progress=progress)
            results = file.parent / "results"
            sailed = sail_campaign(result, progress)
            write_results(result, results, sailed=sailed, progress=progress)
            summary = "\n\n".join([result.summary(), *([sailed_text(sailed)] if sailed else [])])
            said.append((summary, results / "report.html", file))
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


def _squat(out: Path, quiet: bool) -> None:
    from ..report.score_outputs import score_text, write_scores
    from ..report.squat_outputs import squat_text, write_squat
    from ..squat.code_scores import score_tables
    from ..squat.curve_table import read_curve_table
    from ..squat.shipped_squat import DEMO, computed_files, write_squat_campaign
    from ..squat.squat_analysis import run_squat_campaign

    folder = out / DEMO
    with progress_bar(not quiet) as progress:
        file = write_squat_campaign(folder)
        analysis = run_squat_campaign(file, progress=progress)
        results, scored = folder / "results", folder / "scores"
        write_squat(analysis, results, progress=progress)
        codes = [read_curve_table(path) for path in computed_files(file)]
        scores = score_tables(read_curve_table(results / "squat_curve.csv"), codes, scale=analysis.campaign.scale)
        write_scores(scores, scored, progress=progress)
    if quiet:
        return
    typer.echo(
        "virtual records and computations: made by the program, not measured; the truth stands beside the fits\n"
    )
    typer.echo(squat_text(analysis))
    typer.echo(f"\n{score_text(scores)}")
    typer.echo(f"\nreports, open in a browser:\n  {results / 'report.html'}\n  {scored / 'report.html'}")
    typer.echo(f"next: change {file} and run it again: towtank squat reduce {file} --out {out}/again")


def _cfd(out: Path, quiet: bool) -> None:
    from ..cfd.shipped_sweep import DEMO, run_virtual_sweep
    from ..report.cfd_grid_outputs import require_grid_study_folder, write_grid_study
    from ..report.cfd_grid_tables import grid_study_text

    folder = out / DEMO
    results = folder / "results"
    require_grid_study_folder(results)
    with progress_bar(not quiet) as progress:
        study = run_virtual_sweep(folder, progress=progress)
        write_grid_study(study, results, progress=progress)
    if quiet:
        return
    typer.echo("virtual computations: generated, not computed; the truth stands beside what was found\n")
    typer.echo(grid_study_text(study))
    typer.echo(f"\nreport, open in a browser:\n  {results / 'report.html'}")
    typer.echo(
        f"next: towtank cfd settle {folder / 'cases'} --density 1000 --midship 3.5,0,0 --out {out}/settled, "
        f"or change {study.campaigns[0]} and fit it again: towtank run {study.campaigns[0]} --out {out}/again"
    )
