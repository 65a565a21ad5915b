"""``towtank validate``: a measured manoeuvre against the simulated one and its band."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..core.errors import TowtankError
from .progress import progress_bar
from .simulate_command import Draws, Percent, Quiet, Seed, ShipFrom, Speed, written_text
from .vessel_source import load_vessel


def register(app: typer.Typer) -> None:
    """Add the command to `app`."""
    app.command("validate")(validate)


def validate(
    trial: Annotated[Path, typer.Argument(metavar="TRIAL", help="Table with units in its headings.")],
    ship: Annotated[
        str, typer.Option("--set", "-s", metavar="SHIP|SET", help="Named ship, derivatives.json or published set.")
    ],
    manoeuvre: Annotated[
        str, typer.Option("--manoeuvre", "-m", help="What was ordered: 'turning 35', 'zigzag -10/10', ...")
    ] = "",
    rudder: Annotated[
        str,
        typer.Option("--rudder", metavar="DEG", help="Its rudder angle, where --manoeuvre names the kind alone."),
    ] = "",
    schedule: Annotated[
        bool, typer.Option("--schedule", help="Sail the trial's own rudder (and propeller rate), not the orders.")
    ] = False,
    remove_current: Annotated[
        bool, typer.Option("--remove-current", help="Estimate a current from the steady turn and remove it.")
    ] = False,
    over_ground: Annotated[
        bool, typer.Option("--over-ground", help="u and v of the trial are over the ground.")
    ] = False,
    execute: Annotated[
        float | None,
        typer.Option("--execute", metavar="T", help="Time of the first order in s; found when not given."),
    ] = None,
    rudder_port: Annotated[
        bool, typer.Option("--rudder-port", help="The rudder angle of the file is positive to port.")
    ] = False,
    speed: Speed = None,
    ship_from: ShipFrom = None,
    draws: Draws = 0,
    percent: Percent = None,
    seed: Seed = 0,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for tables, tracks and figures.")] = None,
    quiet: Quiet = False,
) -> None:
    """Score a measured manoeuvre against the simulated one: errors, z-scores, coverage of the band.

    The ship must be at the scale of the trial. The simulated ship approaches with the speed of the trial.

    Example: towtank validate trial.csv --set kvlcc2 --manoeuvre "turning 35" --draws 200 --percent 5 --out check
    """
    from ..simulate.trajectory_file import read_trajectory
    from ..simulate.trial_validation import validate_trial

    if rudder and not manoeuvre:
        raise TowtankError("--rudder without --manoeuvre", cure="name the manoeuvre, e.g. --manoeuvre turning")
    vessel = load_vessel(ship, ship_from=ship_from, speed=speed)
    measured = read_trajectory(
        trial, vessel.ship, f"{manoeuvre} {rudder}".strip(), signs={"delta": -1} if rudder_port else None
    )
    if out is not None:
        from ..report.validation_outputs import require_validation_folder

        require_validation_folder(out)
    written = []
    with progress_bar(not quiet) as bar:
        result = validate_trial(
            vessel,
            measured,
            speed=speed,
            replay=schedule,
            without_current=remove_current,
            over_ground=over_ground,
            execute=execute,
            draws=draws,
            percent=percent,
            seed=seed,
            progress=bar,
        )
        if out is not None:
            from ..report.validation_outputs import write_validation

            written = write_validation(result, vessel, out, progress=bar)
    if quiet:
        return
    from ..report.validation_outputs import validation_text

    typer.echo(validation_text(result, vessel))
    if written:
        typer.echo(f"\n{written_text(written)}")
