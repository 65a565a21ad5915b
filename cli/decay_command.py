"""``towtank decay``: free-decay records to damping with its uncertainty, every method beside the others."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..core.errors import ReadError, TowtankError
from .campaign_commands import AcceptRules, print_findings
from .progress import progress_bar

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..decay.at_sea_results import AtSeaAnalysis
    from ..decay.decay_campaign import DecayCampaign
    from ..decay.decay_results import DecayAnalysis


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
        typer.Option(
            help="TOML file with \\[ship] (and \\[ikeda]), or a named ship: B44 and the Ikeda components."
        ),
    ] = None,
    speed: Annotated[
        str, typer.Option(help="Forward speed in m/s, at the scale of the records; or one for each file: 0,0.5,1.")
    ] = "0",
    depth: Annotated[
        str | None, typer.Option(help="Water depth in m, at the scale of the records; or one for each file.")
    ] = None,
    speed_terms: Annotated[
        str | None, typer.Option(help="Fit all speeds together with these terms: b1*U, b2*U, b1*U2, ...")
    ] = None,
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
    memory: Annotated[
        Path | None,
        typer.Option(
            help="Table of radiation: omega in rad/s, B (B44, ...) and, if known, A: a fit with memory too."
        ),
    ] = None,
    inertia: Annotated[
        float | None, typer.Option(help="I + A_inf in kg m2 (heave: kg), at the scale of the table of radiation.")
    ] = None,
    at_sea: Annotated[
        bool,
        typer.Option("--at-sea", help="Roll at sea, excitation unknown: random decrement, joint fit, search."),
    ] = False,
    period: Annotated[float | None, typer.Option(help="With --at-sea: rough roll period in s.")] = None,
    terms: Annotated[
        str | None, typer.Option(help="With --at-sea: terms of the joint fit, b1,b3,c1,c3,c5.")
    ] = None,
    least_amplitude: Annotated[
        float | None, typer.Option(help="With --at-sea: leave smaller oscillations (deg) out of the joint fit.")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results.")] = None,
    accept: AcceptRules = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Damping of a free decay in roll, pitch or heave, by every method side by side.

    Pushes by hand, the release and the end are found; files given together are repeats and are fitted together; at
    several speeds each has its own damping. With --out: damping.csv, equivalent_damping.csv, damping.json,
    report.html, provenance.json. A campaign file replaces the other options.

    With --at-sea there is no release: the files are rolls in waves, and at_sea.csv and excitations.csv are written.

    Example: towtank decay roll.csv --angle phi --unit deg --scale 68 --ship tanker.toml --out roll
    """
    if any(file.suffix.lower() == ".toml" for file in files):
        if len(files) > 1:
            raise TowtankError("a decay campaign is given with other files", cure="give the campaign alone")
        campaign: DecayCampaign | Path = files[0]
    else:
        settings = {"least_amplitude": least_amplitude, "period": period, "terms": _optional_words(terms)}
        _require_switch("--at-sea", at_sea, settings)
        _require_switch("--memory", memory is not None, {"inertia": inertia})
        fit = {
            "models": _words(model, ","),
            "restoring": restoring,
            "speed_terms": _optional_words(speed_terms) or [],
        }
        sections = {
            "channels": {"time": time} | _given(angle=angle, unit=unit),
            "reduction": {"offset": offset, "skip": skip}
            | _given(cutoff=cutoff, first_amplitude=first_amplitude, last_amplitude=last_amplitude),
            "fit": fit if at_sea else fit | {"methods": _words(methods, ";")},
            "memory": None if memory is None else {"table": str(memory)} | _given(inertia=inertia),
            "at_sea": {"methods": _words(methods, ";"), **_given(**settings)} if at_sea else None,
            **_particulars(ship),
        }
        record = {"motion": motion, "scale": scale, "start": start, "end": end}
        each = {"speed": _numbers(speed, "--speed", len(files)), "depth": _numbers(depth, "--depth", len(files))}
        campaign = _from_options(files, record, each, sections)
    if out is not None:
        from ..report.damping_outputs import require_damping_folder

        require_damping_folder(out)
    analysis, written = _run(campaign, out, accept or (), report, not quiet)
    if not quiet:
        _print(analysis, json)
    if written and not (quiet or json):
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _run(
    campaign: DecayCampaign | Path, out: Path | None, accept: Sequence[str], report: bool, progress: bool
) -> tuple[DecayAnalysis | AtSeaAnalysis, list[Path]]:
    """Analyse the records of a campaign, free decays or rolls at sea, and write what was asked for."""
    from ..decay.decay_campaign import DecayCampaign, load_decay_campaign

    settings = campaign if isinstance(campaign, DecayCampaign) else load_decay_campaign(campaign)
    wanted = report and settings.output.report
    with progress_bar(progress) as bar:
        if settings.at_sea is not None:
            from ..decay.at_sea_analysis import run_at_sea_campaign
            from ..report.damping_at_sea import write_at_sea

            at_sea = run_at_sea_campaign(campaign, accept=accept, progress=bar)
            return at_sea, [] if out is None else write_at_sea(at_sea, out, report=wanted, progress=bar)
        from ..decay.decay_analysis import run_decay_campaign
        from ..report.damping_outputs import write_damping

        decays = run_decay_campaign(campaign, accept=accept, progress=bar)
        return decays, [] if out is None else write_damping(decays, out, report=wanted, progress=bar)


def _given(**values: Any) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is not None}


def _words(text: str, separator: str) -> list[str]:
    return [word.strip() for word in text.split(separator) if word.strip()]


def _optional_words(text: str | None) -> list[str] | None:
    return None if text is None else _words(text, ",")


def _require_switch(switch: str, present: bool, options: dict[str, Any]) -> None:
    """Refuse options that do nothing without another one."""
    for name, value in options.items():
        if value is not None and not present:
            raise TowtankError(
                f"--{name.replace('_', '-')} is given without {switch}", cure=f"add {switch}, or leave it out"
            )


def _numbers(text: str | None, option: str, count: int) -> list[float | None]:
    """One number for all files, or one for each."""
    if text is None:
        return [None] * count
    try:
        values = [float(word) for word in _words(text, ",")]
    except ValueError:
        raise TowtankError(f"{option} {text} is no number", cure="give one number, or one for each file") from None
    if len(values) not in (1, count):
        raise TowtankError(
            f"{option} has {len(values)} numbers for {count} file(s)", cure="give one number, or one for each file"
        )
    return [*(values * count if len(values) == 1 else values)]


def _from_options(
    files: list[Path], record: dict[str, Any], each: dict[str, list[float | None]], sections: dict[str, Any]
) -> DecayCampaign:
    from ..decay.decay_campaign import command_line_campaign

    missing = [file for file in files if not file.exists()]
    if missing:
        raise ReadError("file not found", cure="check the path", file=missing[0])
    return command_line_campaign(files, record=record, each=each, sections=sections)


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


def _print(analysis: DecayAnalysis | AtSeaAnalysis, as_json: bool) -> None:
    if as_json:
        import json

        typer.echo(json.dumps(analysis.to_dict(), indent=1, ensure_ascii=False))
        return
    from ..decay.at_sea_results import AtSeaAnalysis

    if isinstance(analysis, AtSeaAnalysis):
        from ..report.damping_at_sea import at_sea_text

        typer.echo(at_sea_text(analysis))
        print_findings([item for one in analysis.records for item in one.all_findings])
        return
    from ..report.damping_outputs import damping_text

    typer.echo(damping_text(analysis))
    print_findings([item for group in analysis.groups for item in group.all_findings])
