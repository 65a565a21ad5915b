"""``towtank synthesize`` and ``plan``: virtual campaigns and test programmes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.errors import CampaignError
from .derivative_source import load_derivatives
from .progress import progress_bar

if TYPE_CHECKING:
    from ..core.ship import Ship
    from ..pmm.run_types import Run

SetName = Annotated[
    str, typer.Argument(metavar="SET", help="derivatives.json, a results folder, or a published set.")
]
Matrix = Annotated[
    str, typer.Option("--matrix", "-m", help="Test matrix: a CSV file or the name of a standard one (--list).")
]
Ar1 = Annotated[float, typer.Option("--ar1", help="AR(1) noise, share of the largest force.", min=0)]
White = Annotated[float, typer.Option("--white", help="White noise, share of the largest force.", min=0)]
Rho = Annotated[float, typer.Option("--rho", help="Correlation of neighbouring samples of the AR(1) noise.")]
Gain = Annotated[float, typer.Option("--gain-bias", help="Gain error that all runs share, relative.", min=0)]
Speed = Annotated[float | None, typer.Option("--speed", help="Speed in m/s for a standard matrix.")]


def register(app: typer.Typer) -> None:
    """Add the commands to `app`."""
    app.command("synthesize")(synthesize)
    app.command("plan")(plan)


def _runs(matrix: str, ship: Ship, speed: float | None) -> list[Run]:
    from ..core.conventions import Conventions
    from ..pmm.standard_matrices import STANDARD_MATRICES, matrix_from_csv, standard_matrix

    if matrix in STANDARD_MATRICES:
        return standard_matrix(matrix, ship, speed)
    if not Path(matrix).is_file():
        raise CampaignError(
            f"'{matrix}' is neither a file nor a standard test matrix",
            cure=f"standard ones are {', '.join(STANDARD_MATRICES)}",
        )
    return matrix_from_csv(matrix, Conventions(angle_unit="deg"))


def synthesize(
    name: SetName = "dtmb5512-efd",
    matrix: Matrix = "general",
    out: Annotated[Path, typer.Option("--out", "-o", help="New folder for the campaign.")] = Path("virtual"),
    speed: Speed = None,
    white: White = 0.0,
    ar1: Ar1 = 0.0,
    rho: Rho = 0.9,
    drift: Annotated[
        float, typer.Option(help="Zero drift within a run, share of the largest force.", min=0)
    ] = 0.0,
    offset: Annotated[
        float, typer.Option(help="Zero error of each run, share of the largest force.", min=0)
    ] = 0.0,
    quantum: Annotated[
        float, typer.Option(help="Step of the converter, share of the largest force.", min=0)
    ] = 0.0,
    gain_bias: Gain = 0.0,
    seed: Annotated[int, typer.Option(help="Seed of the noise.")] = 0,
    inertia: Annotated[bool, typer.Option(help="Put the inertia of the model inside the forces.")] = False,
    mount: Annotated[float, typer.Option(help="Mass of the mount in kg, with --inertia.", min=0)] = 0.0,
    origin: Annotated[float, typer.Option(help="Point of the moment, m forward of midship.")] = 0.0,
    port_up: Annotated[bool, typer.Option("--port-up", help="Axes y to port and z up.")] = False,
    by_ship: Annotated[bool, typer.Option("--by-ship", help="Forces of the ship on the balance.")] = False,
    drift_sign: Annotated[str, typer.Option(help="-v (ITTC) or +v (MARIN).")] = "-v",
    sampling_rate: Annotated[float, typer.Option(help="Samples a second.", min=0.1)] = 20.0,
    duration: Annotated[float, typer.Option(help="Length of a steady run in s.", min=1)] = 30.0,
    fmt: Annotated[str, typer.Option("--format", help="text, csv or simman.")] = "text",
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace a virtual campaign in that folder.")
    ] = False,
    list_matrices: Annotated[bool, typer.Option("--list", help="List the standard test matrices.")] = False,
) -> None:
    """Write a virtual campaign (run files and campaign file) from a derivative set.

    Example: towtank synthesize dtmb5512-efd --matrix dtmb5512 --ar1 0.02 --out virtual
    """
    from ..core.conventions import Conventions
    from ..pmm.laboratory import Laboratory
    from ..pmm.noise import Noise
    from ..pmm.rigid_body import RigidBody
    from ..pmm.standard_matrices import STANDARD_MATRICES
    from ..pmm.virtual_campaign import FORMATS
    from ..pmm.virtual_campaign import synthesize as write_campaign

    if list_matrices:
        for key, item in STANDARD_MATRICES.items():
            typer.echo(f"{key:<12} {item.meaning}")
        return
    if fmt not in FORMATS:
        raise CampaignError(f"'{fmt}' is not a format of run files", cure=f"use one of {', '.join(FORMATS)}")
    derivatives = load_derivatives(name)
    ship = derivatives.ship
    body = None
    if inertia:
        mass, moment = ship.displacement_mass, ship.yaw_inertia
        if mass is None or moment is None:
            raise CampaignError(
                f"the mass or yaw inertia of '{ship.name}' is not known", cure="leave --inertia out"
            )
        body = RigidBody(mass + mount, ship.xG, moment)
    laboratory = Laboratory(
        conventions=Conventions(
            angle_unit="deg",
            axes="forward-port-up" if port_up else "forward-starboard-down",
            force_sign="by-ship" if by_ship else "on-ship",
            drift_sign=drift_sign,
        ),
        moment_x=origin,
        inertia=body,
        sampling_rate=sampling_rate,
        duration=duration,
    )
    noise = Noise(white, ar1, rho, drift, offset, quantum, gain_bias, seed)
    runs = _runs(matrix, ship, speed)
    with progress_bar() as progress:
        campaign = write_campaign(
            derivatives,
            runs,
            out,
            name=f"virtual {ship.name}, {matrix}",
            noise=noise,
            laboratory=laboratory,
            fmt=fmt,
            overwrite=overwrite,
            progress=progress,
        )
    typer.echo(f"{len(runs)} virtual runs -> {campaign}\nnext: towtank run {campaign} --out {out}/results")


def plan(
    name: SetName = "dtmb5512-efd",
    matrix: Matrix = "general",
    speed: Speed = None,
    white: White = 0.0,
    ar1: Ar1 = 0.02,
    rho: Rho = 0.9,
    gain_bias: Gain = 0.0,
    target: Annotated[str | None, typer.Option("--for", help="Derivative that matters, e.g. Nv.")] = None,
    within: Annotated[
        float, typer.Option(help="Half-width of its 95 % interval, share of its value.", min=0)
    ] = 0.05,
    candidates: Annotated[
        str | None, typer.Option(help="Test matrix of further runs to rank; default the same matrix.")
    ] = None,
    criterion: Annotated[str, typer.Option(help="D (joint region) or A (mean variance).")] = "D",
    best: Annotated[int, typer.Option(help="Further runs to list.", min=0)] = 5,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Write the expected table as CSV.")] = None,
) -> None:
    """Expected standard errors of a test programme before a run is made, and the best next run.

    Example: towtank plan kvlcc2 --matrix general --ar1 0.02 --for Nv --within 0.05
    """
    from ..pmm.further_runs import best_next_run, repeats_for
    from ..pmm.noise import Noise
    from ..pmm.programme import plan as expected

    if criterion not in ("D", "A"):
        raise CampaignError(f"'{criterion}' is not a criterion", cure="use D or A")
    derivatives = load_derivatives(name)
    runs = _runs(matrix, derivatives.ship, speed)
    programme = expected(derivatives, runs, Noise(white=white, ar1=ar1, rho=rho, gain_bias=gain_bias))
    typer.echo(programme.summary())
    if target is not None:
        typer.echo("\n" + repeats_for(programme, target, within).describe())
    if best:
        more = _runs(candidates, derivatives.ship, speed) if candidates else runs
        ranked = best_next_run(programme, more, "D" if criterion == "D" else "A", target)
        typer.echo(f"\nbest next runs ({criterion}-optimality{f' for {target}' if target else ''}):")
        typer.echo(ranked.head(best).to_string(index=False))
    if out is not None:
        from ..formats.write import atomic_path

        with atomic_path(out) as temporary:
            programme.to_frame().to_csv(temporary, index=False)
        typer.echo(f"written: {out}")
