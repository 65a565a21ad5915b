"""``towtank run``, ``audit`` and ``init``: from a folder of runs to a derivative table."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .progress import progress_bar

if TYPE_CHECKING:
    from ..core.findings import Finding

AcceptRules = Annotated[
    list[str] | None,
    typer.Option("--accept", metavar="RULE", help="Accept the findings of an audit rule; may be repeated."),
]

Workers = Annotated[int, typer.Option(help="Files read at the same time.", min=1, max=64)]


def register(app: typer.Typer) -> None:
    """Add the commands to `app`."""
    app.command("run")(run)
    app.command("audit")(audit)
    app.command("init")(init)


def run(
    campaign: Annotated[Path, typer.Argument(help="Campaign file (TOML).")],
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for the results.")] = Path("results"),
    accept: AcceptRules = None,
    workers: Workers = 2,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Read, audit, reduce and fit a captive-test campaign.

    Writes derivatives.csv, derivatives.json, harmonics.csv, runs.csv, findings.csv, provenance.json and
    report.html.

    Example: towtank run campaign.toml --out results --accept density
    """
    from ..pmm.campaign import Campaign
    from ..report.campaign_manoeuvres import check_simulate, sail_campaign, sailed_text
    from ..report.outputs import loading_ahead, write_results

    with progress_bar(not quiet) as bar:
        progress = loading_ahead(bar) if report else bar
        loaded = Campaign.load(campaign)
        if loaded.file.simulate is not None:
            check_simulate(loaded.file.simulate, loaded.path, loaded.file.make_ship())
        result = loaded.run(accept_rules=accept or (), progress=progress, workers=workers, compare=report)
        sailed = sail_campaign(result, progress)
        wanted = report and result.settings.output.report
        written = write_results(result, out, report=wanted, sailed=sailed, progress=progress)
    if quiet:
        return
    typer.echo(result.summary())
    print_findings(result.findings)
    if sailed:
        typer.echo(f"\n{sailed_text(sailed)}")
    typer.echo(f"\n{len(result.runs)} runs -> {out}{'/'}: {', '.join(path.name for path in written)}")


def print_findings(findings: Iterable[Finding]) -> None:
    """Print errors and warnings, those of one rule in one line."""
    from ..core.findings import findings_frame

    frame = findings_frame(findings)
    frame = frame[frame["severity"] != "info"]
    if frame.empty:
        return
    typer.echo("")
    for rule, rows in frame.groupby("rule", sort=False):
        first = rows.iloc[0]
        waived = " (accepted)" if bool(first["accepted"]) else ""
        where = f" in {first['file']}" if first["file"] else ""
        more = f" and {len(rows) - 1} more" if len(rows) > 1 else ""
        typer.echo(f"{first['severity']}{waived} [{rule}] {first['message']}{where}{more}")


def audit(
    campaign: Annotated[Path | None, typer.Argument(help="Campaign file (TOML).")] = None,
    list_rules: Annotated[bool, typer.Option("--list", help="List every audit rule.")] = False,
    accept: AcceptRules = None,
    workers: Workers = 2,
) -> None:
    """Check the files of a campaign without fitting, or list the audit rules.

    Every finding is printed, not only the first; the exit status is 2 when an error is not accepted.

    Example: towtank audit campaign.toml
    """
    from ..pmm.audit_rules import RULES

    if list_rules or campaign is None:
        width = max(len(rule.name) for rule in RULES.values())
        for rule in RULES.values():
            typer.echo(f"{rule.severity:<8} {rule.name:<{width}}  {rule.meaning}")
        return
    from ..core.findings import findings_frame
    from ..pmm.campaign import Campaign

    loaded = Campaign.load(campaign)
    with progress_bar() as progress:
        findings = loaded.audit(accept_rules=accept or (), progress=progress, workers=workers)
    if not findings:
        typer.echo(f"{campaign}: no finding")
        return
    for row in findings_frame(findings).itertuples():
        place = ", ".join(part for part in (str(row.file), str(row.place)) if part)
        waived = " (accepted)" if row.accepted else ""
        typer.echo(f"{row.severity}{waived} [{row.rule}] {place}: {row.message} -> {row.cure}")
    if any(item.severity == "error" and not item.accepted for item in findings):
        raise typer.Exit(2)


def init(
    folder: Annotated[Path, typer.Argument(help="Folder with run files.")],
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Campaign file to write.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Look into a folder of run files and write a campaign file to complete.

    Example: towtank init runs/
    """
    from ..pmm.campaign_draft import draft_campaign

    target = out or folder / "campaign.toml"
    typer.echo(draft_campaign(folder, target, replace=force))
