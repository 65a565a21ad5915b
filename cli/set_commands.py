"""``towtank sets``, ``show``, ``convert`` and ``export``: work with derivative sets."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .derivative_source import load_derivatives

SetName = Annotated[
    str, typer.Argument(metavar="SET", help="derivatives.json, a results folder, or a published set.")
]


def register(app: typer.Typer) -> None:
    """Add the commands to `app`."""
    app.command("sets")(sets)
    app.command("show")(show)
    app.command("convert")(convert)
    app.command("export")(export)


def sets(
    tables: Annotated[bool, typer.Option("--tables", help="List published captive tables instead.")] = False,
) -> None:
    """List the published derivative sets that come with towtank.

    Example: towtank sets
    """
    from ..datasets import list_sets, list_tables

    frame = list_tables() if tables else list_sets()
    typer.echo(frame.to_string(index=False, justify="left", max_colwidth=60))


def show(name: SetName) -> None:
    """Print a derivative set with its conventions, source and known misprints.

    Example: towtank show kvlcc2
    """
    derivatives = load_derivatives(name)
    typer.echo(derivatives.summary())
    for label, choice, meaning in derivatives.conventions.describe():
        typer.echo(f"  {label:<22} {choice:<24} {meaning}")
    typer.echo(f"source: {derivatives.provenance.source or 'not given'}")
    for misprint in derivatives.provenance.misprints:
        typer.echo(f"misprint: {misprint}")
    for variable, (low, high) in derivatives.validity.items():
        typer.echo(f"valid for {variable} from {low:.4g} to {high:.4g}")


def convert(
    name: SetName,
    to: Annotated[
        str,
        typer.Option(
            "--to", help="Target: mmg, prime, bis, dimensional, cog, midship, drift-angle, ... joined by commas."
        ),
    ],
    scale: Annotated[float | None, typer.Option(help="Froude-scale to this scale first; 1 is the ship.")] = None,
    speed: Annotated[float | None, typer.Option(help="Reference speed in m/s where the set has none.")] = None,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Write the converted set here (.json or .csv).")
    ] = None,
) -> None:
    """Convert a derivative set to other conventions, covariance included.

    Example: towtank convert results/derivatives.json --to prime,cog
    """
    from dataclasses import replace

    derivatives = load_derivatives(name)
    if speed is not None:
        derivatives = replace(derivatives, reference_speed=speed)
    if scale is not None:
        derivatives = derivatives.at_scale(scale)
    converted = derivatives.to(to)
    if out is None:
        typer.echo(converted.summary())
        return
    if out.suffix.lower() == ".csv":
        from ..formats.write import atomic_path

        with atomic_path(out) as temporary:
            converted.to_csv(temporary)
    else:
        converted.to_json(out)
    typer.echo(f"{len(converted)} derivatives -> {out}")


def export(
    name: SetName,
    target: Annotated[str, typer.Option("--for", help="shipmmg, mss, csv, latex, xlsx or json.")],
    out: Annotated[Path | None, typer.Option("--out", "-o", help="File to write; printed when not given.")] = None,
) -> None:
    """Write a derivative set as a simulator or a paper wants it.

    Example: towtank export results --for shipmmg --out hull.py
    """
    from ..report.exports import export_set

    text = export_set(load_derivatives(name), target, out)
    typer.echo(text if out is None else f"written: {out}")
