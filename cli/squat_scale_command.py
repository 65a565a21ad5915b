"""``towtank squat scale``: a model's squat held against the ship's, beyond Froude's law."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..core.errors import ReadError, TowtankError


def scale(
    model: Annotated[
        Path, typer.Argument(metavar="MODEL.csv", help="Curve of the model: speed, sinkage_bow, ...")
    ],
    ship: Annotated[Path, typer.Argument(metavar="SHIP.csv", help="Curve of the ship, columns named alike.")],
    ratio: Annotated[
        float, typer.Option("--scale", help="Length of the ship over that of the model: 40 for 1:40.")
    ],
    draught: Annotated[float, typer.Option(help="Draught of the ship in m, at full scale.")],
    depth: Annotated[
        float | None, typer.Option(help="Water depth in m, at full scale; from a column depth when not given.")
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN=UNIT", help="Unit of a column where no heading gives it; may be repeated."),
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the tables.")] = None,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Scaling errors of a model's squat: that of the ship less that of the model by Froude's law.

    Both tables have a column speed, sinkages positive down (sinkage_bow, sinkage_stern, ...) or a trim positive by
    the bow, units in the headings; squat_curve.csv of towtank squat reduce is such a table. The model is
    interpolated linearly at the ship's speeds, never extrapolated. With --out: scaling_errors.csv,
    scaling_clearance.csv, scaling.json.

    Example: towtank squat scale model.csv ship.csv --scale 40 --depth 18 --draught 14.5 --out scaling
    """
    from .squat_score_command import assignment

    units = dict(assignment(word, "--unit") for word in unit or ())
    if not 1.0 < ratio < float("inf"):
        raise TowtankError(f"--scale: a model 1:{ratio:g} is not smaller than its ship", cure="give 40 for 1:40")
    for name, size in (("draught", draught), ("depth", depth)):
        if size is not None and not size > 0.0:
            raise TowtankError(f"--{name}: {size:g} m is impossible", cure="give it in m at full scale, positive")
    if out is not None:
        from ..report.scaling_outputs import require_scaling_folder

        require_scaling_folder(out)
    for file in (model, ship):
        if not file.exists():
            raise ReadError("file not found", cure="check the path", file=file)
    from ..report.scaling_outputs import Scaling, scaling_text, write_scaling
    from ..squat.scaling_error import scaling_errors
    from ..squat.tabled_curve import read_squat_curve

    small = None if depth is None else depth / ratio
    of_model = read_squat_curve(model, draught / ratio, depth=small, scale=ratio, units=units)
    if depth is None:
        depth = of_model.curve.depth * ratio
    of_ship = read_squat_curve(ship, draught, depth=depth, units=units)
    scaling = Scaling(of_model, of_ship, scaling_errors(of_model.curve, of_ship.curve))
    written = [] if out is None else write_scaling(scaling, out)
    if quiet:
        return
    if json:
        import json as text

        typer.echo(text.dumps(scaling.to_dict(), indent=1, ensure_ascii=False))
        return
    from .campaign_commands import print_findings

    typer.echo(scaling_text(scaling))
    print_findings([*of_model.findings, *of_ship.findings])
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")
