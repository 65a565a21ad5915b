"""``towtank decay``: free-decay records to damping with its uncertainty, every method beside the others."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..core.errors import ReadError, TowtankError
from .campaign_commands import AcceptRules, print_findings
from .progress import progress_bar

if TYPE_CHECKING:
    from ..decay.decay_analysis import DecayAnalysis
    from ..decay.decay_campaign import DecayCampaign


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("decay")(decay)


def decay(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...|CAMPAIGN.toml", help="Record files, or one decay campaign.")
    ],
    time: Annotated[str, typer.Option(help="Column with the time in s.")] = "time",
    angle: Annotated[
        str | None, typer.Option(help="Column with the angle or heave; phi, theta or heave when not given.")
    ] = None,
    unit: Annotated[
        str | None, typer.Option(help="Its unit: rad, deg, m, mm; needed when the file prints none.")
    ] = None,
    motion: Annotated[str, typer.Option("--motion", "--mode", help="roll, pitch or heave.")] = "roll",
    scale: Annotated[float, typer.Option(help="Scale of the records: 36 for a model 1:36.")] = 1.0,
    ship: Annotated[
        str | None,
        typer.Option(help="TOML file with [ship] (and [ikeda]), or a named ship: B44 and the Ikeda components."),
    ] = None,
    speed: Annotated[float, typer.Option(help="Forward speed in m/s, at the scale of the records.")] = 0.0,
    model: Annotated[
        str,
        typer.Option(help="Damping, several separated by commas: linear, quadratic, cubic, linear+quadratic, ..."),
    ] = "linear+quadratic",
    restoring: Annotated[
        str, typer.Option(help="auto (what the records support), linear, cubic or quintic.")
    ] = "auto",
    methods: Annotated[str, typer.Option(help="all, or names separated by semicolons.")] = "all",
    offset: Annotated[str, typer.Option(help="Rest position: drift, constant or none.")] = "drift",
    cutoff: Annotated[
        float | None, typer.Option(help="Low-pass of the derivation fit in Hz; five times the roll frequency.")
    ] = None,
    start: Annotated[float | None, typer.Option(help="Start of the free part in s; found when not given.")] = None,
    end: Annotated[float | None, typer.Option(help="End of the free part in s; found when not given.")] = None,
    first_amplitude: Annotated[float | None, typer.Option(help="Largest amplitude in deg (heave: m).")] = None,
    last_amplitude: Annotated[
        float | None, typer.Option(help="Smallest amplitude in deg (heave: m); the noise decides.")
    ] = None,
    skip: Annotated[int, typer.Option(help="Half cycles dropped after the release.")] = 0,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results.")] = None,
    accept: AcceptRules = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Damping of a free decay in roll, pitch or heave, by every method side by side.

    Pushes by hand, the release and the end are found; files given together are repeats and are fitted together. With
    --out: damping.csv, equivalent_damping.csv, damping.json, report.html, provenance.json. A campaign file replaces
    the other options.

    Example: towtank decay roll.csv --angle phi --unit deg --scale 68 --ship tanker.toml --out roll
    """
    if any(file.suffix.lower() == ".toml" for file in files):
        if len(files) > 1:
            raise TowtankError("a decay campaign is given with other files", cure="give the campaign alone")
        campaign: DecayCampaign | Path = files[0]
    else:
        sections = {
            "channels": {"time": time} | _given(angle=angle, unit=unit),
            "reduction": {"offset": offset, "skip": skip}
            | _given(cutoff=cutoff, first_amplitude=first_amplitude, last_amplitude=last_amplitude),
            "fit": {"models": _words(model, ","), "restoring": restoring, "methods": _words(methods, ";")},
            **_particulars(ship),
        }
        record = {"motion": motion, "scale": scale, "speed": speed, "start": start, "end": end}
        campaign = _from_options(files, record, sections)
    if out is not None:
        from ..report.damping_outputs import require_damping_folder

        require_damping_folder(out)
    with progress_bar(not quiet) as bar:
        from ..decay.decay_analysis import run_decay_campaign

        analysis = run_decay_campaign(campaign, accept=accept or (), progress=bar)
        written: list[Path] = []
        if out is not None:
            from ..report.damping_outputs import write_damping

            written = write_damping(analysis, out, report=report and analysis.campaign.output.report, progress=bar)
    if not quiet:
        _print(analysis, json)
    if written and not (quiet or json):
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _given(**values: Any) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is not None}


def _words(text: str, separator: str) -> list[str]:
    return [word.strip() for word in text.split(separator) if word.strip()]


def _from_options(files: list[Path], record: dict[str, Any], sections: dict[str, Any]) -> DecayCampaign:
    from ..decay.decay_campaign import command_line_campaign

    missing = [file for file in files if not file.exists()]
    if missing:
        raise ReadError("file not found", cure="check the path", file=missing[0])
    return command_line_campaign(files, record=record, sections=sections)


def _particulars(ship: str | None) -> dict[str, Any]:
    """Sections ``ship`` and ``ikeda`` from a file, or the particulars of a named ship."""
    if ship is None:
        return {}
    path = Path(ship)
    if path.suffix.lower() != ".toml" and not path.exists():
        from ..simulate.ships import named_ship

        return {"ship": named_ship(ship).ship.to_dict()}
    from ..formats.checked_toml import read_toml

    data = read_toml(path, ReadError, what="TOML file with [ship]")
    if not isinstance(data.get("ship"), dict):
        raise ReadError("there is no section [ship]", cure="give name, L, B, T, volume, KG, GM there", file=path)
    return {key: data[key] for key in ("ship", "ikeda") if key in data}


def _print(analysis: DecayAnalysis, as_json: bool) -> None:
    if as_json:
        import json

        typer.echo(json.dumps(analysis.to_dict(), indent=1, ensure_ascii=False))
        return
    from ..report.damping_outputs import damping_text

    typer.echo(damping_text(analysis))
    print_findings([item for group in analysis.groups for item in group.all_findings])
