"""``towtank squat predict``: what every formula says of a ship, with its limits."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from ..core.ship import Ship
    from ..squat.fairway import Fairway


def predict(
    ship: Annotated[
        str, typer.Argument(metavar="SHIP", help="Named ship (kcs, dtc, ...) or TOML file with \\[ship].")
    ],
    depth: Annotated[float, typer.Option(help="Water depth in m.")],
    speed: Annotated[
        str,
        typer.Option(metavar="FIRST:LAST:STEP", help="Speeds through the water, in knots unless --speed-unit."),
    ],
    speed_unit: Annotated[str, typer.Option(help="Unit of --speed: kn (the default) or m/s.")] = "kn",
    width: Annotated[
        float | None, typer.Option(help="Bottom width of a canal or trench in m; open water when not given.")
    ] = None,
    slope: Annotated[float, typer.Option(help="Run of its banks over their rise: 3 for 1:3; 0: walls.")] = 0.0,
    bank_height: Annotated[
        float | None, typer.Option(help="Height of underwater banks in m: a trench, not a canal.")
    ] = None,
    model: Annotated[
        bool, typer.Option("--model", help="All numbers at the scale of SHIP, not at full scale.")
    ] = False,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for tables and page.")] = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Squat by every empirical formula, with the limits that each breaks, the spread and the water left.

    Speeds are in knots unless --speed-unit says m/s. Everything is at full scale unless --model is given; a model's
    particulars are brought there. Formulas outside their limits are greyed and in brackets, never left out. A TOML
    file may also hold the sections hull (propellers, bulb, transom, midship_coefficient, static_trim) and restoring.
    With --out: predict.csv, spread.csv, predict.json, report.html.

    Example: towtank squat predict kcs --depth 16 --speed 6:16:1 --out squat
    """
    from .squat_channels import speeds_from
    from .squat_ship import load_squat_ship

    speeds = speeds_from(speed, speed_unit)
    if not depth > 0.0:
        raise TowtankError(f"a water depth of {depth:g} m is impossible", cure="give --depth in m, positive")
    given = load_squat_ship(ship)
    hull = given.ship if model else given.ship.at_scale(1.0)
    restoring = given.restoring
    if restoring and hull.scale != given.ship.scale:
        ratio = given.ship.scale / hull.scale
        powers = {"waterplane_area": 2, "flotation": 1, "longitudinal_GM": 1}
        restoring = {name: value * ratio ** powers[name] for name, value in restoring.items()}
    if out is not None:
        from ..report.squat_prediction_outputs import require_prediction_folder

        require_prediction_folder(out)
    from ..squat.forecast import forecast

    _require_volume(hull, ship)
    result = forecast(
        hull, _fairway(depth, width, slope, bank_height), speeds, restoring=restoring or None, **given.hull
    )
    written: list[Path] = []
    if out is not None:
        from ..report.squat_prediction_outputs import write_prediction

        written = write_prediction(result, out, report=report)
    if quiet:
        return
    if json:
        import json as text

        typer.echo(text.dumps(result.to_dict(), indent=1, ensure_ascii=False))
        return
    from ..report.squat_prediction_outputs import prediction_text
    from .campaign_commands import print_findings

    typer.echo(prediction_text(result, speed_unit, inapplicable=lambda line: typer.style(line, dim=True)))
    print_findings(result.findings)
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")


def _require_volume(ship: Ship, name: str) -> None:
    if ship.volume is None:
        raise TowtankError(
            f"ship '{ship.name}' has no displaced volume, on which every formula stands",
            cure="give volume in m3 under [ship]",
            file=name if name.endswith(".toml") else None,
        )


def _fairway(depth: float, width: float | None, slope: float, bank_height: float | None) -> Fairway:
    from ..squat.fairway import Fairway

    if width is None:
        if slope or bank_height is not None:
            raise TowtankError("banks without a bottom width", cure="give --width in m")
        return Fairway(depth)
    if bank_height is not None:
        return Fairway.trench(depth, width, bank_height, slope)
    return Fairway.canal(depth, width, slope)
