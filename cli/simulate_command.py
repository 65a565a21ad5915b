"""``towtank simulate``: sail a ship through manoeuvres, with uncertainty where there are draws."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.errors import SimulationError, TowtankError
from .progress import progress_bar
from .vessel_source import load_vessel

if TYPE_CHECKING:
    from ..simulate.manoeuvring_results import ManoeuvringResults
    from ..simulate.programme import Programme

Angles = list[str] | None

ShipFrom = Annotated[
    str | None,
    typer.Option("--ship-from", metavar="SHIP", help="Named ship that lends propeller, rudder and gear to a set."),
]
Draws = Annotated[
    int,
    typer.Option("--draws", metavar="N", help="Draws of the derivatives for standard deviations and quantiles."),
]
Percent = Annotated[
    float | None,
    typer.Option(
        "--percent", metavar="P", help="Draw every number independently by P per cent, not the covariance."
    ),
]
Seed = Annotated[int, typer.Option("--seed", help="Seed of the draws.")]
Speed = Annotated[float | None, typer.Option("--speed", metavar="U0", help="Approach speed in m/s.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("simulate")(simulate)


def simulate(
    ship: Annotated[
        str,
        typer.Argument(metavar="SHIP|SET", help="Named ship, derivatives.json, results folder or published set."),
    ] = "",
    turning: Annotated[
        Angles, typer.Option("--turning", metavar="DEG", help="Turning circle, rudder to starboard positive.")
    ] = None,
    zigzag: Annotated[
        Angles, typer.Option("--zigzag", metavar="DEG/DEG", help="Zig-zag, rudder/heading: 20/20, -10/10, 35/5.")
    ] = None,
    initial_turning: Annotated[
        Angles, typer.Option("--initial-turning", metavar="DEG", help="Initial turning test.")
    ] = None,
    pull_out: Annotated[
        Angles, typer.Option("--pull-out", metavar="DEG", help="Pull-out from a steady turn with this rudder.")
    ] = None,
    spiral: Annotated[
        bool, typer.Option("--spiral", help="Direct spiral from 25 deg to -25 deg and back.")
    ] = False,
    reverse_spiral: Annotated[
        bool, typer.Option("--reverse-spiral", help="Reverse spiral about the straight course.")
    ] = False,
    crash_stop: Annotated[bool, typer.Option("--crash-stop", help="Full astern until the ship stops.")] = False,
    williamson: Annotated[
        bool, typer.Option("--williamson", help="Williamson turn with 35 deg of rudder.")
    ] = False,
    course_keeping: Annotated[
        float | None,
        typer.Option(
            "--course-keeping", metavar="DEG", help="Hold this course by an autopilot; 0 is the initial one."
        ),
    ] = None,
    gains: Annotated[
        str, typer.Option(metavar="P,D,I", help="Gains of the autopilot: of course, in L/U0, and in U0/L.")
    ] = "1,1,0",
    duration: Annotated[float, typer.Option(help="Length of course keeping in L/U0.", min=1.0, max=300.0)] = 30.0,
    schedule: Annotated[
        Path | None,
        typer.Option("--schedule", metavar="FILE", help="Rudder (and propeller) over time: t, delta, n."),
    ] = None,
    speed: Speed = None,
    environment: Annotated[
        Path | None, typer.Option("--environment", metavar="FILE", help="Current, wind and waves (TOML).")
    ] = None,
    ship_from: ShipFrom = None,
    draws: Draws = 0,
    percent: Percent = None,
    seed: Seed = 0,
    workers: Annotated[int, typer.Option(help="Threads that sail the draws.", min=1, max=64)] = 1,
    interval: Annotated[
        float | None, typer.Option("--interval", metavar="DT", help="Seconds between the samples of the tracks.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder for tables, tracks, figures, report.")
    ] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print the indices as JSON.")] = False,
    list_ships: Annotated[bool, typer.Option("--list", help="List the named ships.")] = False,
    quiet: Quiet = False,
) -> None:
    """Sail manoeuvres with a named ship or a fitted derivative set.

    Without a manoeuvre those of the IMO standards are sailed: turning circles with 35 deg, zig-zags 10/10 and 20/20 and
    initial turning, to both sides. Angles are in degrees, positive to starboard; lengths are in ship lengths.

    Example: towtank simulate kvlcc2 --turning 35 --zigzag 20/20 --out kvlcc2-manoeuvres
    """
    if list_ships:
        _print_ships()
        return
    if not ship:
        raise TowtankError("which ship?", cure="give a named ship or a set (see: towtank simulate --list)")
    vessel = load_vessel(ship, ship_from=ship_from, speed=speed)
    tick = vessel.ship.L / vessel.speed
    names = [
        *(f"turning {item}" for item in turning or ()),
        *(f"zigzag {item}" for item in zigzag or ()),
        *(f"initial turning {item}" for item in initial_turning or ()),
        *(f"pull-out {item}" for item in pull_out or ()),
        *(["spiral"] if spiral else []),
        *(["reverse spiral"] if reverse_spiral else []),
        *(["crash stop"] if crash_stop else []),
        *(["williamson 35"] if williamson else []),
    ]
    others = []
    if course_keeping is not None:
        others.append(_course_keeping(course_keeping, gains, duration, tick))
    if schedule is not None:
        from ..simulate.schedule_file import read_schedule

        others.append(read_schedule(schedule))
    programmes = _programmes(names, others, tick)
    surroundings = None
    if environment is not None:
        from ..simulate.environment_file import read_environment

        surroundings = read_environment(environment, vessel.ship)
    if out is not None:
        from ..report.manoeuvre_outputs import require_manoeuvre_folder

        require_manoeuvre_folder(out)
    from ..simulate.manoeuvring_results import sail_manoeuvres

    with progress_bar(not quiet) as bar, warnings.catch_warnings():
        # what the environment doubts is printed below
        warnings.simplefilter("ignore")
        results = sail_manoeuvres(
            vessel,
            programmes,
            environment=surroundings,
            interval=interval,
            draws=draws,
            percent=percent,
            seed=seed,
            workers=workers,
            progress=bar,
        )
        written = []
        if out is not None:
            from ..report.manoeuvre_outputs import write_manoeuvres

            written = write_manoeuvres(results, out, report=report, progress=bar)
    if quiet:
        return
    _print(results, json)
    if written and not json:
        typer.echo(f"\n{written_text(written)}")


def _programmes(names: list[str], others: list[Programme], tick: float) -> list[Programme]:
    from ..simulate.named_programmes import IMO_SET, named_programme

    wanted = names if names or others else list(IMO_SET)
    return [*(named_programme(name, tick) for name in wanted), *others]


def _course_keeping(course: float, gains: str, duration: float, tick: float) -> Programme:
    from ..simulate.manoeuvres import course_keeping

    try:
        gain, yaw_gain, integral = (float(item) for item in gains.split(","))
    except ValueError:
        raise SimulationError(
            f"the gains '{gains}' are not three numbers", cure="give P,D,I, e.g. --gains 1,1,0"
        ) from None
    return course_keeping(duration * tick, gain, yaw_gain * tick, integral / tick, course)


def written_text(written: list[Path]) -> str:
    """The files of a folder in one line, tracks and figures counted."""
    counted = {"trajectory_": "track", "figure_": "figure"}
    names = [path.name for path in written if not path.name.startswith(tuple(counted))]
    for beginning, what in counted.items():
        count = sum(path.name.startswith(beginning) for path in written)
        names += [f"{count} {what}{'s' if count > 1 else ''} ({beginning}*)"] if count else []
    return f"-> {written[0].parent}/: {', '.join(names)}"


def _print_ships() -> None:
    from ..simulate.ships import named_ships

    ships = named_ships()
    width = max(map(len, ships))
    for name, line in ships.items():
        typer.echo(f"{name:<{width}}  {line}")


def _print(results: ManoeuvringResults, as_json: bool) -> None:
    from ..report.manoeuvre_outputs import index_records, manoeuvres_text

    if as_json:
        import json

        typer.echo(json.dumps(index_records(results), indent=1, ensure_ascii=False))
        for line in results.doubts():
            typer.echo(f"doubt: {line}", err=True)
        return
    typer.echo(manoeuvres_text(results))
