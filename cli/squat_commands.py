"""``towtank squat``: records to squat, computations scored against measurements, formulas with their limits."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..core.errors import ReadError, TowtankError
from .campaign_commands import AcceptRules
from .progress import progress_bar
from .squat_predict_command import predict
from .squat_scale_command import scale as scale_errors
from .squat_score_command import score
from .squat_voyage_command import voyage

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..core.findings import Finding
    from ..squat.squat_analysis import SquatAnalysis
    from ..squat.squat_campaign import SquatCampaign


def register(app: typer.Typer) -> None:
    """Add the group of commands to `app`."""
    group = typer.Typer(
        no_args_is_help=True,
        add_completion=False,
        help="Sinkage and trim records to squat, scores of computations, formulas with their limits.\n\n"
        "Example: towtank squat predict kcs --depth 14 --speed 6:14:1",
    )
    group.command("reduce")(reduce)
    group.command("score")(score)
    group.command("predict")(predict)
    group.command("scale")(scale_errors)
    group.command("voyage")(voyage)
    app.add_typer(group, name="squat")


def reduce(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...|CAMPAIGN.toml", help="Runs, or one squat campaign.")
    ],
    channels: Annotated[
        str | None,
        typer.Option(
            help="role=column, ...: time, speed, bow, stern, or heave and trim, extra, wave; a place x or x/y in m is "
            "a role too; a unit may follow in brackets: bow=z_VF \\[mm]."
        ),
    ] = None,
    window: Annotated[
        str,
        typer.Option(help="30-95% of the steady part, plateau, auto, or seconds: 63.5:79.2."),
    ] = "30-95%",
    ship: Annotated[
        str | None, typer.Option(help="TOML file with \\[ship], or a named ship; brought to --scale.")
    ] = None,
    length: Annotated[
        float | None, typer.Option(help="Length between perpendiculars in m where no ship is given.")
    ] = None,
    scale: Annotated[
        float | None, typer.Option(help="Scale of the records: 89.11 for a model 1:89.11; that of the ship.")
    ] = None,
    depth: Annotated[float | None, typer.Option(help="Water depth in m, at the scale of the records.")] = None,
    width: Annotated[
        float | None,
        typer.Option(help="Bottom width of the tank or canal in m, at that scale; open water without."),
    ] = None,
    slope: Annotated[float, typer.Option(help="Run of its banks over their rise; 0: walls.")] = 0.0,
    speed: Annotated[
        float | None, typer.Option(help="Speed in m/s where no channel has it, at the scale of the records.")
    ] = None,
    steps: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="The speed rises in steps: average the last seconds of each."),
    ] = None,
    waves: Annotated[
        bool, typer.Option("--waves", help="Regular waves: mean and harmonics; the window in seconds or plateau.")
    ] = False,
    wave_x: Annotated[
        float | None,
        typer.Option(help="Place of the wave gauge (--channels wave=...) in m forward of midship: gives RAOs."),
    ] = None,
    omega: Annotated[
        float | None, typer.Option(help="Frequency of encounter in rad/s; found when not given.")
    ] = None,
    filter_name: Annotated[
        str, typer.Option("--filter", help="Noise filter: none, butterworth, moving-mean or median.")
    ] = "none",
    cutoff: Annotated[float | None, typer.Option(help="Its cut-off in Hz; 3 sqrt(g/L) when not given.")] = None,
    correct: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="Correction of the curve for walls or bottom: kreitner, lackenby:speeds, ..."
        ),
    ] = None,
    repeats: Annotated[bool, typer.Option("--repeats", help="All files are repeats of one condition.")] = False,
    trim_positive: Annotated[
        str | None, typer.Option(help="Sense of a trim channel, needed with one: bow-down or bow-up.")
    ] = None,
    trim_base: Annotated[float | None, typer.Option(help="Length in m that a trim in m is measured over.")] = None,
    heave_x: Annotated[float, typer.Option(help="Place of the heave channel in m forward of midship.")] = 0.0,
    sinkage_positive: Annotated[str, typer.Option(help="Sense of the sinkage channels: down or up.")] = "down",
    place: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=X", help="Another place to report, x in m forward of midship; may be repeated."
        ),
    ] = None,
    accept: AcceptRules = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results.")] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Steady squat of sinkage and trim records, with uncertainty.

    Sinkage is positive down, trim a slope positive by the bow. Runs of one speed are pooled as repeats; several
    speeds make a curve with bands, beside the formulas. With --out: squat.csv (run, quantity, mean, se, n_eff,
    window_start, window_end, unit), squat_curve.csv and others, squat.json, report.html. A campaign file replaces
    the other options. Records of RTK antennas at full scale: towtank squat voyage.

    Example: towtank squat reduce C1.dat C2.dat --channels "speed=u, bow=z_VF, stern=z_VA" --ship dtc --scale 89.11
    --depth 0.326 --out squat
    """
    if any(file.suffix.lower() == ".toml" for file in files):
        if len(files) > 1:
            raise TowtankError("a squat campaign is given with other files", cure="give the campaign alone")
        campaign: SquatCampaign | Path = files[0]
    else:
        missing = [file for file in files if not file.exists()]
        if missing:
            raise ReadError("file not found", cure="check the path", file=missing[0])
        section = channels_section(files[0], channels)
        section |= {"sinkage_positive": sinkage_positive, "heave_x": heave_x}
        section |= _given(trim_positive=trim_positive, trim_base=trim_base, wave_x=wave_x) | (
            {"places": _places(place)} if place else {}
        )
        sections = {
            "squat": _given(scale=scale),
            "ship": _particulars(ship, length),
            "fairway": {"slope": slope} | _given(depth=depth, width=width),
            "channels": section,
            "window": _window(window),
            "filter": {"name": filter_name} | _given(cutoff=cutoff),
            **_given(
                steps=None if steps is None else {"last": steps},
                correction=None if correct is None else _correction(correct),
            ),
        }
        record = {"speed": speed, "waves": waves, "omega": omega, "condition": "repeats" if repeats else ""}
        campaign = _from_options(files, record, sections)
    if out is not None:
        from ..report.squat_outputs import require_squat_folder

        require_squat_folder(out)
    with progress_bar(not quiet) as bar:
        from ..squat.squat_analysis import run_squat_campaign

        analysis = run_squat_campaign(campaign, accept=accept or (), progress=bar)
        written: list[Path] = []
        if out is not None:
            from ..report.squat_outputs import write_squat

            written = write_squat(analysis, out, report=report and analysis.campaign.output.report, progress=bar)
    if not quiet:
        _print(analysis, json)
    if written and not (quiet or json):
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _given(**values: Any) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is not None}


def channels_section(file: Path, words: str | None) -> dict[str, Any]:
    """Section ``[channels]`` from the words of the command line, or from the usual names in the file."""
    from .squat_channels import channels_from, usual_channels

    return usual_channels(file) if words is None else channels_from(words)


def _window(words: str) -> dict[str, Any]:
    from .squat_channels import window_from

    return window_from(words)


def _correction(words: str) -> dict[str, str]:
    """Section ``[correction]`` from ``name`` or ``name:speeds``."""
    name, _, to = words.partition(":")
    return {"name": name.strip()} | ({"to": to.strip()} if to.strip() else {})


def _places(words: list[str]) -> dict[str, float]:
    places = {}
    for word in words:
        name, _, value = word.partition("=")
        try:
            places[name.strip()] = float(value)
        except ValueError:
            raise TowtankError(f"--place: '{word}' is not name=x", cure="write for example quarter=1.0") from None
    return places


def _particulars(ship: str | None, length: float | None) -> dict[str, Any]:
    if ship is not None:
        from .squat_ship import load_squat_ship

        return load_squat_ship(ship).ship.to_dict()
    if length is None:
        raise TowtankError(
            "the length of the ship is not known, so that bow and stern have no place",
            cure="give --ship, or --length in m at the scale of the records",
        )
    return {"name": "ship", "L": length}


def _from_options(files: list[Path], record: dict[str, Any], sections: dict[str, Any]) -> SquatCampaign:
    from ..squat.squat_campaign import command_line_squat

    return command_line_squat(files, record=record, sections=sections)


def _print(analysis: SquatAnalysis, as_json: bool) -> None:
    if as_json:
        import json

        typer.echo(json.dumps(analysis.to_dict(), indent=1, ensure_ascii=False))
        return
    from ..report.squat_outputs import squat_text

    typer.echo(squat_text(analysis))
    print_all_findings(analysis.findings)


def print_all_findings(findings: Iterable[Finding]) -> None:
    """Print every finding, remarks included, those of one rule and wording in one line."""
    from ..core.findings import findings_frame

    frame = findings_frame(findings)
    if frame.empty:
        return
    typer.echo("")
    for (rule, message), rows in frame.groupby(["rule", "message"], sort=False):
        first = rows.iloc[0]
        waived = " (accepted)" if bool(first["accepted"]) else ""
        files = [Path(str(file)).name for file in dict.fromkeys(rows["file"]) if file]
        where = f" in {', '.join(files[:3])}" + (f" and {len(files) - 3} more" if len(files) > 3 else "")
        typer.echo(f"{first['severity']}{waived} [{rule}] {message}{where if files else ''}")
