"""What a page shows of the manoeuvres of one ship: tables, drawings, doubts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..simulate.environment import Environment
from ..simulate.manoeuvring_results import ManoeuvringResults
from .drawings import Drawing
from .manoeuvre_tables import (
    choices_table,
    criteria_table,
    failures_table,
    index_tables,
    parts_table,
    steering_table,
)
from .page_table import Table

if TYPE_CHECKING:
    from .manoeuvre_drawings import Figure

KINDS = ("track", "time", "fan", "histogram", "elasticity")


@dataclass(frozen=True)
class ManoeuvreSection:
    """What a page shows of the manoeuvres of one ship.

    Attributes
    ----------
    tables : tuple of (str, Table)
        Indices, by kind of manoeuvre.
    criteria, steering : Table
    failures : Table or None
    drawings : mapping of str to tuple of Drawing
        By kind: ``track``, ``time``, ``fan``, ``histogram``, ``elasticity``.
    doubts : tuple of str
    parts, choices : Table
    surroundings : tuple of str
    draws : str
        What was drawn; empty for none.
    """

    tables: tuple[tuple[str, Table], ...]
    criteria: Table
    steering: Table
    failures: Table | None
    drawings: dict[str, tuple[Drawing, ...]]
    doubts: tuple[str, ...]
    parts: Table
    choices: Table
    surroundings: tuple[str, ...]
    draws: str


def manoeuvre_section(
    results: ManoeuvringResults, prefix: str, figures: list[Figure] | None = None
) -> ManoeuvreSection:
    """Tables and drawings of some manoeuvres.

    Parameters
    ----------
    results : ManoeuvringResults
    prefix : str
        Unique in the page, e.g. ``m1``.
    figures : list of Figure, optional
        Those to be shown; all when not given.
    """
    # drawing needs matplotlib, which the command line must not load at its start
    from .figure_style import inline_svg
    from .manoeuvre_drawings import manoeuvre_drawings

    shown = manoeuvre_drawings(results) if figures is None else figures
    drawn: dict[str, list[Drawing]] = {kind: [] for kind in KINDS}
    for number, figure in enumerate(shown):
        whole = figure.draw().get_figure(root=True)
        assert whole is not None
        svg = inline_svg(whole, f"{prefix}-{number}", figure.caption)
        drawn[figure.kind].append(Drawing(svg, figure.caption))
    choices = {} if results.ensemble is None else results.ensemble.provenance.choices
    return ManoeuvreSection(
        tables=tuple(index_tables(results)),
        criteria=criteria_table(results),
        steering=steering_table(results),
        failures=failures_table(results),
        drawings={kind: tuple(items) for kind, items in drawn.items()},
        doubts=tuple(results.doubts()),
        parts=parts_table(results),
        choices=choices_table(results),
        surroundings=tuple(surroundings(results.environment)),
        draws=f"{choices['draws']} draws, seed {choices['seed']}: {choices['scatter']}" if choices else "",
    )


def surroundings(environment: Environment | None) -> list[str]:
    """Current, wind and waves in words."""
    if environment is None:
        return []
    said = []
    if environment.current is not None:
        to = math.degrees(environment.current.direction)
        said.append(f"current of {environment.current.speed:g} m/s flowing to {to:g}°")
    if environment.wind is not None:
        wind = environment.wind
        said.append(
            f"wind of {wind.speed:g} m/s from {math.degrees(wind.direction):g}° ({wind.coefficients.source})"
        )
    if environment.waves is not None:
        waves = environment.waves
        length = "" if waves.wavelength is None else f", {waves.wavelength:g} m long,"
        said.append(f"waves of {waves.height:g} m{length} travelling to {math.degrees(waves.direction):g}°")
    return said
