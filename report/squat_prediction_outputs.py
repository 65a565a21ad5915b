"""The folder of results of a squat prediction, and what a terminal shows of it."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

from ..core.provenance import program_versions
from ..squat.forecast import SCHIJF, SquatForecast
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

PREDICTION_FORMAT = "towtank squat prediction provenance 1"

Style = Callable[[str], str]


def require_prediction_folder(out: str | Path) -> None:
    """Refuse a place that cannot take the results of a prediction, before anything is computed.

    Raises
    ------
    TowtankError
        When `out` is a file, or holds results of another kind.
    """
    require_folder(Path(out), PREDICTION_FORMAT)


def write_prediction(
    forecast: SquatForecast, out: str | Path, *, report: bool = True, progress: Progress | None = None
) -> list[Path]:
    """Write ``predict.csv`` (every formula and speed), ``spread.csv``, ``predict.json``, the page and the provenance.

    Parameters
    ----------
    forecast : SquatForecast
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool
        Write ``report.html``.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("predict.csv", csv_writer(lambda: forecast.frame)),
        ("spread.csv", csv_writer(lambda: forecast.spread)),
        ("predict.json", lambda path: write_json(forecast.to_dict(), path)),
    ]
    if report:

        def write_page(path: Path) -> None:
            # drawing needs matplotlib, which the command line must not load at its start
            from .squat_prediction_page import render_prediction

            path.write_text(render_prediction(forecast), encoding="utf-8")

        writers.append(("report.html", write_page))
    return write_folder(Path(out), writers, prediction_provenance(forecast), progress)


def prediction_provenance(forecast: SquatForecast, created: datetime | None = None) -> dict[str, Any]:
    """Ship, water, formulas with their sources, versions, as plain data."""
    table = forecast.prediction.table.drop_duplicates("formula")
    return {
        "format": PREDICTION_FORMAT,
        "created": timestamp(created),
        "versions": program_versions(),
        "ship": forecast.ship.to_dict(),
        "fairway": vars(forecast.fairway),
        "formulas": dict(zip(table["formula"], table["source"], strict=True)),
        "findings": [vars(item) for item in forecast.findings],
    }


def prediction_text(
    forecast: SquatForecast, unit: str = "kn", *, most: int = 12, inapplicable: Style = lambda line: line
) -> str:
    """The largest squat by formula and speed; formulas outside their limits in brackets and last.

    Parameters
    ----------
    forecast : SquatForecast
    unit : str
        ``kn`` (full scale) or ``m/s``: of the speeds in the heading.
    most : int
        Speeds that are shown; the table of files has all.
    inapplicable : callable
        How a line of a formula that never applies is set, e.g. dim.
    """
    from .figure_style import spread_evenly
    from .squat_units import shown_length

    table = forecast.prediction.table
    factor, shown = shown_length(forecast.ship.L)
    picked = spread_evenly(len(forecast.speeds), most)
    spread = forecast.spread.iloc[picked]
    over = spread["full-scale speed [kn]" if unit == "kn" else "speed [m/s]"]
    heads = [f"{value:.4g}" for value in over]
    rows: list[tuple[str, list[str], str, bool]] = []
    for name, of in table.groupby("formula", sort=False):
        part = of.iloc[picked]
        cells = [
            f"{factor * value:.3g}" if inside else f"({factor * value:.3g})"
            for value, inside in zip(part["maximum"], part["applicable"], strict=True)
        ]
        rows.append(
            (str(name), cells, next((flag for flag in part["flag"] if flag), ""), bool(of["applicable"].any()))
        )
    rows.sort(key=lambda row: not row[3])
    below = [
        ("least", [f"{factor * value:.3g}" for value in spread["least [m]"]]),
        ("median", [f"{factor * value:.3g}" for value in spread["median [m]"]]),
        ("largest", [f"{factor * value:.3g}" for value in spread["largest [m]"]]),
        ("clearance", [f"{factor * value:.3g}" for value in spread["least clearance [m]"]]),
    ]
    first = max(len(name) for name in (*(row[0] for row in rows), f"speed [{unit}]"))
    width = (
        max(len(cell) for cells in ([heads], *([row[1]] for row in rows)) for line in cells for cell in line) + 2
    )
    width = max(width, 8)

    def line(name: str, cells: list[str], tail: str = "") -> str:
        return (
            name.ljust(first) + "".join(cell.rjust(width) for cell in cells) + (f"  {tail}" if tail else "")
        ).rstrip()

    scale = "full scale" if forecast.ship.scale == 1.0 else f"model 1:{forecast.ship.scale:g}"
    lines = [
        f"{forecast.ship.name}, {scale}: largest squat anywhere [{shown}], positive down; {water_text(forecast)}",
        "",
        line(f"speed [{unit}]", heads),
        line("Fh", [f"{value:.3f}" for value in table["depth_froude"].iloc[picked]]),
        *(
            line(name, cells, flag) if applies else inapplicable(line(name, cells, flag))
            for name, cells, flag, applies in rows
        ),
        "",
        "of the applicable formulas:",
        *(line(name, ["–" if cell == "nan" else cell for cell in cells]) for name, cells in below),
        "",
        "(in brackets: outside the limits of the formula, which stand behind it)",
    ]
    if len(picked) < len(forecast.speeds):
        lines.append(f"{len(picked)} of {len(forecast.speeds)} speeds are shown; the files have all")
    return "\n".join(lines)


def water_text(forecast: SquatForecast) -> str:
    """The water around the ship in words."""
    water, fairway = forecast.water, forecast.fairway
    said = [f"depth {fairway.depth:g} m, h/T {fairway.depth / forecast.ship.T:.3g}"]
    if fairway.kind == "open":
        said.append(f"open water (width of influence {water['width of influence [m]']:.4g} m)")
    else:
        said.append(f"{fairway.kind} of {fairway.area:.5g} m² (Schijf limit {water[SCHIJF]:.3g} m/s)")
    said.append(f"blockage {water['blockage']:.4f}, S = 1/m {water['S']:.3g}")
    return ", ".join(said)
