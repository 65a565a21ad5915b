"""The page of a squat prediction: every formula with its limits, the spread, the water left."""

from __future__ import annotations

from datetime import datetime

import numpy as np

from ..squat.fairway import Fairway
from ..squat.forecast import SquatForecast
from ..squat.prediction import SquatPrediction
from .formula_figures import formula_clearance_figure, formula_figure
from .page_table import Column, Table, make_table
from .ship_particulars import particulars
from .squat_page import Part, Section, drawn, findings_section, provenance_section, render_squat_page
from .squat_prediction_outputs import water_text
from .squat_units import shown_length
from .typography import fixed, significant

_MOST_SPEEDS = 9


def render_prediction(forecast: SquatForecast, *, created: datetime | None = None) -> str:
    """The page of a prediction as HTML that needs nothing beside itself.

    Parameters
    ----------
    forecast : SquatForecast
    created : datetime, optional
        Time that the page carries; the present one when not given.
    """
    ship, prediction = forecast.ship, forecast.prediction
    knots = ship.scale == 1.0
    drawings = [
        drawn(
            formula_figure(prediction, ship.L, knots=knots),
            "largest",
            "Largest squat anywhere. Grey, dotted: outside the limits of the formula.",
        )
    ]
    drawings += [
        drawn(
            formula_figure(prediction, ship.L, place, knots=knots),
            place,
            f"The formulas that speak of the {place}.",
        )
        for place in ("bow", "stern")
        if prediction.table[place].notna().any() and prediction.table[place].max() > 0.0
    ]
    sections = [
        Section(
            "formulas",
            "Formulas",
            (
                Part(drawings=tuple(drawings[:1])),
                numbers_part("Largest squat", prediction, ship.L, knots=knots),
                Part("By place", drawings=tuple(drawings[1:])),
                Part("Sources", lines=source_lines(prediction)),
            ),
        ),
        Section(
            "clearance",
            "Water under the keel",
            (
                Part(
                    drawings=(
                        drawn(
                            formula_clearance_figure(forecast, knots=knots),
                            "clearance",
                            "Depth less draught less squat; band: least to largest squat of the applicable formulas.",
                        ),
                    )
                ),
                Part("Spread", tables=(spread_table(forecast),)),
            ),
        ),
        Section("water", "The water", (Part(lines=_water_lines(forecast)),)),
        findings_section(forecast.findings),
        provenance_section({}),
    ]
    return render_squat_page(
        f"Squat of {ship.name} by formulas",
        "squat prediction",
        sections,
        source=water_text(forecast),
        particulars=particulars(
            [ship], [("Volume", ship.volume, "m³"), ("Water depth", forecast.fairway.depth, "m")]
        )[:-1],
        created=created,
    )


def numbers_part(title: str, prediction: SquatPrediction, length: float, *, knots: bool) -> Part:
    """Squat by formula and speed, and below it the limits that are broken."""
    return Part(
        title, tables=(formula_table(prediction, length, knots=knots),), lines=limit_lines(prediction), kind="long"
    )


def limit_lines(prediction: SquatPrediction) -> tuple[tuple[str, str], ...]:
    """Formula, and the limits that it breaks at one speed or more."""
    return tuple(
        (str(name), flag)
        for name, of in prediction.table.groupby("formula", sort=False)
        if (flag := next((str(text) for text in of["flag"] if text), ""))
    )


def formula_table(prediction: SquatPrediction, length: float, *, knots: bool, place: str = "maximum") -> Table:
    """Squat by formula and speed; values outside the limits in brackets, formulas that never apply shaded."""
    factor, unit = shown_length(length)
    table = prediction.table
    first = table[table["formula"] == table["formula"].iloc[0]]
    # repeats of a measured speed would only fill the table
    heads = first["knots" if knots else "speed"].map(lambda value: f"{value:.3g}")
    distinct = np.flatnonzero(~heads.duplicated().to_numpy())
    step = max(-(-(len(distinct) - 1) // (_MOST_SPEEDS - 1)), 1)
    picked = distinct[::step] if (len(distinct) - 1) % step == 0 else np.r_[distinct[::step], distinct[-1]]
    over = first["knots" if knots else "speed"].iloc[picked]
    columns = [Column("formula", "short")]
    columns += [Column(f"{value:.4g}", "number") for value in over]
    rows: list[tuple[bool, list[str]]] = []
    for name, of in table.groupby("formula", sort=False):
        part = of.iloc[picked]
        cells = [
            fixed(factor * value, 3 if unit == "m" else 2)
            if inside
            else f"({fixed(factor * value, 3 if unit == 'm' else 2)})"
            for value, inside in zip(part[place], part["applicable"], strict=True)
        ]
        rows.append((bool(of["applicable"].any()), [str(name), *cells]))
    rows.sort(key=lambda row: not row[0])
    speeds = f"Speeds in {'kn' if knots else 'm/s'}; squat in {unit}, positive down."
    speeds += " Further speeds are in the files beside this page." if step > 1 else ""
    caption = f"{speeds} In brackets or grey: outside the limits that stand below."
    return make_table(columns, [row for _, row in rows], caption, ["" if inside else "grey" for inside, _ in rows])


def source_lines(prediction: SquatPrediction) -> tuple[tuple[str, str], ...]:
    """Formula and source."""
    first = prediction.table.drop_duplicates("formula")
    return tuple((str(name), str(source)) for name, source in zip(first["formula"], first["source"], strict=True))


def spread_table(forecast: SquatForecast) -> Table:
    """Least, median and largest squat, and the water left, by speed."""
    factor, unit = shown_length(forecast.ship.L)
    spread = forecast.spread
    channel = "overspeed [-]" in spread
    columns = [
        Column("speed [kn, full scale]", "number"),
        Column("speed [m/s]", "number"),
        Column("formulas", "number"),
    ]
    columns += [Column(f"{name} [{unit}]", "number") for name in ("least", "median", "largest", "water left")]
    if channel:
        columns += [Column("Kreitner overspeed [-]", "number"), Column(f"level drop [{unit}]", "number")]
    rows, marks = [], []
    for of in spread.to_dict("records"):
        row = [significant(of["full-scale speed [kn]"], 4), fixed(of["speed [m/s]"], 3)]
        row.append(f"{of['applicable']} of {of['formulas']}")
        row += [
            fixed(factor * of[name], 3 if unit == "m" else 2)
            for name in ("least [m]", "median [m]", "largest [m]", "least clearance [m]")
        ]
        if channel:
            row += [fixed(of["overspeed [-]"], 4), fixed(factor * of["level drop [m]"], 3 if unit == "m" else 2)]
        rows.append(row)
        marks.append("bad" if of["least clearance [m]"] <= 0.0 else "")
    note = " A dash: no steady flow exists at this speed." if channel else ""
    return make_table(columns, rows, f"Of the applicable formulas; water left with the largest.{note}", marks)


def _water_lines(forecast: SquatForecast) -> tuple[tuple[str, str], ...]:
    fairway: Fairway = forecast.fairway
    lines: list[tuple[str, str]] = [("kind", fairway.kind if fairway.kind != "open" else "open water")]
    if fairway.area is not None:
        lines.append(
            (
                "section",
                f"{significant(fairway.area, 4)} m², {significant(fairway.top_width or 0.0, 4)} m wide at the surface",
            )
        )
    names = {"blockage": "blockage m = As/Ac", "S": "its inverse S = Ac/As"}
    return (*lines, *((names.get(name, name), significant(value, 4)) for name, value in forecast.water.items()))
