"""Tables of a page about manoeuvres: indices with their definitions, verdicts, what the ship is made of."""

from __future__ import annotations

import math
from itertools import groupby
from typing import TYPE_CHECKING

from markupsafe import Markup

from ..simulate.index_definitions import definition_of
from ..simulate.manoeuvre_names import read_manoeuvre_name
from ..simulate.manoeuvring_results import ManoeuvringResults
from .manoeuvre_outputs import NOTHING
from .page_table import Column, Table, make_table
from .typography import fixed, significant

if TYPE_CHECKING:
    import pandas as pd

_UNITS = {"L": "L", "deg": "°", "deg/s": "°/s", "-": "–"}
_WITH_DEFINITION = Markup('{}<span class="under">{}</span>')
_VERDICTS = {"pass": "", "fail": "bad", "not reached": "bad", "not tested": ""}


def index_tables(results: ManoeuvringResults) -> list[tuple[str, Table]]:
    """One table a kind of manoeuvre: a row an index, a column a manoeuvre, the definition beside them."""
    frame = results.indices_frame()
    named = [(read_manoeuvre_name(name), name) for name in frame["manoeuvre"].unique()]
    kinds = list(dict.fromkeys((one.kind, one.heading) for one, _ in named))
    tables = []
    for kind, heading in kinds:
        names = [name for one, name in named if (one.kind, one.heading) == (kind, heading)]
        part = frame[frame["manoeuvre"].isin(names)]
        title = {"zigzag": "Zig-zag"}.get(kind, kind.capitalize())
        if heading is not None:
            title += f" to {heading:g}°"
        tables.append((title, _index_table(part, names, spread=results.ensemble is not None)))
    return tables


def _index_table(frame: pd.DataFrame, names: list[str], *, spread: bool) -> Table:
    # the columns of several manoeuvres with their bands leave no room for another one
    crowded = spread and len(names) > 1
    columns = [Column("index", "text" if crowded else "short"), Column("unit", "short")]
    for name in names:
        columns.append(Column(name, "number", "value" + (" ± standard deviation of the draws" if spread else "")))
        if spread:
            columns.append(Column("5 to 95 %", "number", f"quantiles over the draws, {name}"))
    if not crowded:
        columns.append(Column("definition"))
    cells = {(row["manoeuvre"], row["index"]): row for row in frame.to_dict("records")}
    rows = []
    for index in frame["index"].unique():
        unit, definition = definition_of(index)
        row = [_WITH_DEFINITION.format(index, definition) if crowded else index, _UNITS.get(unit, unit)]
        for name in names:
            found = cells.get((name, index))
            row += (
                _value_cells(found["value"], found["sd"], found["p05"], found["p95"], spread)
                if found
                else (["–", "–"] if spread else ["–"])
            )
        rows.append(row if crowded else [*row, definition])
    return make_table(columns, rows)


def _value_cells(value: float, sd: float, low: float, high: float, spread: bool) -> list[str]:
    if not spread:
        return [significant(0.0 if abs(value) < NOTHING else value, 4)]
    if math.isnan(sd):
        return [significant(value, 4), "–"]
    places = _places(sd)
    return [f"{fixed(value, places)} ± {fixed(sd, places)}", f"{fixed(low, places)} to {fixed(high, places)}"]


def _places(sd: float) -> int:
    """Decimals that show two digits of a standard deviation."""
    return 3 if sd == 0.0 else min(max(1 - math.floor(math.log10(abs(sd))), 0), 6)


def steering_table(results: ManoeuvringResults) -> Table:
    """Course stability of the hull and Nomoto's indices of the zig-zags."""
    frame = results.steering_frame()
    columns = [
        Column("of", "short"),
        Column("quantity", "short"),
        Column("value", "number"),
        Column("std", "number", "from the covariance of the set, to first order"),
        Column("unit", "short"),
    ]
    rows = [
        [
            row["subject"],
            row["quantity"],
            significant(row["value"], 4),
            "–" if math.isnan(row["sd"]) else significant(row["sd"], 2),
            _UNITS.get(row["unit"], row["unit"]),
        ]
        for row in frame.to_dict("records")
    ]
    left_out = frame.attrs["left_out"]
    return make_table(columns, rows, caption=f"Left out: {'; '.join(left_out)}." if left_out else "")


def criteria_table(results: ManoeuvringResults) -> Table:
    """Criteria of IMO resolution MSC.137(76): value, limit, margin, verdict, and the probability of passing."""
    frame = results.imo_frame()
    spread = "probability" in frame
    columns = [
        Column("criterion"),
        Column("clause", "short"),
        Column("value", "number"),
        Column("limit", "number"),
        Column("unit", "short"),
        Column("margin", "number", "limit less value"),
        Column("margin %", "number", "of the limit"),
        Column("verdict", "short"),
    ]
    if spread:
        columns += [
            Column("probability %", "number", "share of the draws that pass, and its standard error"),
            Column("margin, 5 to 95 %", "number", "quantiles over the draws"),
        ]
    rows, marks = [], []
    for row in frame.to_dict("records"):
        cells = [row["criterion"], row["clause"], *(fixed(row[name], 2) for name in ("value", "limit"))]
        cells += [_UNITS.get(row["unit"], row["unit"]), fixed(row["margin"], 2), fixed(row["margin_pct"], 1)]
        cells.append(row["verdict"])
        if spread:
            share, error = 100.0 * row["probability"], 100.0 * row["probability_se"]
            tested = not math.isnan(share)
            cells.append(f"{fixed(share, 1)} ± {fixed(error, 1)}" if tested else "–")
            cells.append(f"{fixed(row['margin_p05'], 2)} to {fixed(row['margin_p95'], 2)}" if tested else "–")
        rows.append(cells)
        marks.append(_VERDICTS[row["verdict"]])
    return make_table(columns, rows, caption="; ".join(frame.attrs["notes"]) + ".", marks=marks)


def failures_table(results: ManoeuvringResults) -> Table | None:
    """Draws that did not complete a manoeuvre; None when all did."""
    if results.ensemble is None or results.ensemble.failures.empty:
        return None
    columns = [
        Column("manoeuvre", "short"),
        Column("draws", "number"),
        Column("share %", "number"),
        Column("reason"),
    ]
    rows = [
        (row["manoeuvre"], str(row["draws"]), fixed(100.0 * row["share"], 1), row["reason"])
        for row in results.ensemble.failures.to_dict("records")
    ]
    return make_table(columns, rows)


def parts_table(results: ManoeuvringResults) -> Table:
    """Parts of the vessel and where they come from."""
    vessel = results.vessel
    rows = [(part, source) for part, source in vessel.sources.items() if source]
    return make_table([Column("part", "short"), Column("source")], rows)


def choices_table(results: ManoeuvringResults) -> Table:
    """What was chosen: the numbers of each manoeuvre, and those of the ensemble."""
    rows = []
    for one in results.trajectories:
        rows += [(one.manoeuvre, name, _choice(value)) for name, value in one.provenance.choices.items()]
    if results.ensemble is not None:
        rows += [("ensemble", name, _choice(value)) for name, value in results.ensemble.provenance.choices.items()]
    merged = [
        (", ".join(name for name, *_ in group), what, value)
        for (what, value), group in (
            (key, list(items)) for key, items in groupby(sorted(rows, key=_last), key=_last)
        )
    ]
    return make_table([Column("manoeuvre"), Column("choice"), Column("value")], merged)


def _last(row: tuple[str, str, str]) -> tuple[str, str]:
    return row[1], row[2]


def _choice(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, tuple | list):
        return ", ".join(f"{item:.4g}" if isinstance(item, float) else str(item) for item in value)
    return str(value)
