"""What simulated manoeuvres leave behind: tables, tracks, figures, provenance, page; complete or not at all."""

from __future__ import annotations

import math
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.provenance import program_versions
from ..simulate.manoeuvring_results import COLUMNS, ManoeuvringResults
from .aligned_text import aligned_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder

if TYPE_CHECKING:
    from .manoeuvre_drawings import Figure

MANOEUVRES_FORMAT = "towtank manoeuvres 1"

NOTHING = 1e-6
"""An index smaller than this is the error of the integration, and is shown as 0."""

DOTS = 150
"""Dots an inch of the figures."""


def require_manoeuvre_folder(out: str | Path) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), MANOEUVRES_FORMAT)


def write_manoeuvres(
    results: ManoeuvringResults, out: str | Path, *, report: bool = True, progress: Progress | None = None
) -> list[Path]:
    """Write everything that some manoeuvres yield.

    Files are ``indices.csv`` (manoeuvre, index, value, unit, sd, p05, p95; the last three empty without draws),
    ``imo.csv``, ``steering.csv`` (course stability, Nomoto), ``trajectory_<manoeuvre>.csv``, with draws
    ``draws.csv``, ``elasticities.csv``, ``failures.csv``, then ``figure_<name>.png``, ``report.html`` and
    ``provenance.json``. Numbers have all their digits; angles are in degrees.

    Parameters
    ----------
    results : ManoeuvringResults
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool
        Write figures and ``report.html``.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    writers = manoeuvre_tables(results)
    if report:
        from .manoeuvre_drawings import manoeuvre_drawings

        figures = manoeuvre_drawings(results)
        writers += [(f"figure_{figure.name}.png", partial(_write_picture, figure)) for figure in figures]
        writers.append(("report.html", partial(_write_page, results, figures)))
    return write_folder(Path(out), writers, manoeuvres_provenance(results), progress)


def manoeuvre_tables(results: ManoeuvringResults, ending: str = "") -> list[tuple[str, Writer]]:
    """Tables and tracks: name of each file, with `ending`, and what writes it."""
    writers: list[tuple[str, Writer]] = [
        (f"indices{ending}.csv", csv_writer(results.indices_frame)),
        (f"imo{ending}.csv", csv_writer(results.imo_frame)),
        (f"steering{ending}.csv", csv_writer(results.steering_frame)),
        *((f"trajectory_{file_part(one.manoeuvre)}{ending}.csv", one.to_csv) for one in results.trajectories),
    ]
    if results.ensemble is not None:
        drawn = results.ensemble
        writers += [
            (f"draws{ending}.csv", lambda path: _flat_draws(drawn.raw).to_csv(path, index=False)),
            (f"elasticities{ending}.csv", csv_writer(lambda: drawn.elasticities)),
            (f"failures{ending}.csv", csv_writer(lambda: drawn.failures)),
        ]
    return writers


def file_part(manoeuvre: str) -> str:
    """Name of a manoeuvre as a part of file names: ``turning_35``, ``zigzag_-10-10``."""
    return manoeuvre.replace("+", "").replace("/", "-").replace(" ", "_")


def _flat_draws(raw: Any) -> Any:
    flat = raw.copy()
    flat.columns = [name if part == "parameter" else f"{part}: {name}" for part, name in raw.columns]
    return flat


def _write_picture(figure: Figure, path: Path) -> None:
    whole = figure.draw().get_figure(root=True)
    assert whole is not None
    whole.savefig(path, dpi=DOTS, facecolor="white", metadata={"Software": "towtank"})


def _write_page(results: ManoeuvringResults, figures: list[Figure], path: Path) -> None:
    from .manoeuvre_page import render_manoeuvres

    path.write_text(render_manoeuvres(results, figures=figures), encoding="utf-8")


def manoeuvres_provenance(results: ManoeuvringResults, created: datetime | None = None) -> dict[str, Any]:
    """Where the numbers come from, as plain data: ship, parts, choices, doubts, versions."""
    vessel = results.vessel
    hull = vessel.hull
    return {
        "format": MANOEUVRES_FORMAT,
        "created": timestamp(created),
        "versions": program_versions(),
        "ship": vessel.ship.to_dict(),
        "vessel": vessel.name,
        "approach speed [m/s]": vessel.speed,
        "sources": dict(vessel.sources),
        "hull": {"name": hull.name, "provenance": hull.to_dict()["provenance"]},
        "manoeuvres": {one.manoeuvre: _plain(one.provenance.choices) for one in results.trajectories},
        "ensemble": None if results.ensemble is None else _plain(results.ensemble.provenance.choices),
        "environment": _environment(results),
        "doubts": results.doubts(),
    }


def _plain(choices: Any) -> dict[str, Any]:
    return {name: list(value) if isinstance(value, tuple) else value for name, value in choices.items()}


def _environment(results: ManoeuvringResults) -> list[str]:
    from .manoeuvre_section import surroundings

    return surroundings(results.environment)


def index_records(results: ManoeuvringResults) -> list[dict[str, Any]]:
    """Indices as a list of mappings with the columns of ``indices.csv``; None for what there is not."""
    rows = results.indices_frame().to_dict("records")
    return [
        {name: None if isinstance(row[name], float) and math.isnan(row[name]) else row[name] for name in COLUMNS}
        for row in rows
    ]


def manoeuvres_text(results: ManoeuvringResults) -> str:
    """Indices, verdicts and doubts as lines for a terminal."""
    vessel = results.vessel
    frame = results.indices_frame()
    head = (
        f"{vessel.name}: L = {vessel.ship.L:g} m, approach at {vessel.speed:.4g} m/s; angles positive to starboard"
    )
    blocks = [head]
    if len(frame):
        # lengths are counted in ship lengths; what they mean is in the page
        told = frame.assign(value=frame["value"].where(frame["value"].abs() >= NOTHING, 0.0))
        blocks.append(aligned_text(told, COLUMNS))
    else:
        blocks.append("manoeuvres without indices: " + ", ".join(one.manoeuvre for one in results.trajectories))
    return "\n\n".join([*blocks, *verdict_blocks(results)])


def verdict_blocks(results: ManoeuvringResults) -> list[str]:
    """Verdicts, course stability, doubts and failed draws as paragraphs for a terminal."""
    blocks = []
    imo = results.imo_frame()
    tested = imo[imo["verdict"] != "not tested"]
    if len(tested):
        columns = ["criterion", "value", "limit", "unit", "margin_pct", "verdict"]
        columns += ["probability"] if "probability" in tested else []
        blocks.append("IMO MSC.137(76)\n" + aligned_text(tested, columns))
    steering = results.steering_frame()
    if len(steering):
        blocks.append("course stability and Nomoto's indices\n" + aligned_text(steering, list(steering.columns)))
    blocks += [f"left out: {line}" for line in steering.attrs["left_out"]]
    blocks += [f"doubt: {line}" for line in results.doubts()]
    if results.ensemble is not None:
        blocks += [
            f"{row['manoeuvre']}: {row['draws']} of {results.ensemble.draws} draws without a result: {row['reason']}"
            for row in results.ensemble.failures.to_dict("records")
        ]
    return blocks
