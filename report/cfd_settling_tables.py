"""Tables of settled runs for a page and for a terminal."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..cfd.settled_loads import SettledCase
from .aligned_text import aligned_text
from .page_table import Column, Table, make_table
from .typography import fixed, significant

if TYPE_CHECKING:
    import pandas as pd

MOST_LOADS = 6
"""Columns of means that stand beside the verdicts."""

MARKS = {"still drifting": "weak", "too short": "weak", "diverged": "bad"}


def verdict_table(cases: Sequence[SettledCase]) -> Table:
    """One row a case: motion, grid, verdict, cut, means of the fitted loads with their standard uncertainty."""
    loads = list(dict.fromkeys(name for item in cases for name in item.fitted))
    # A history of many columns does not fit beside the verdict; its means stand below.
    loads = loads if len(loads) <= MOST_LOADS else []
    labels = {name: item.loads.labelled(name) for item in cases for name in item.fitted}
    columns = [
        Column("case", "short"),
        Column("verdict", "short"),
        Column("cut", "number"),
        Column("end", "number"),
    ]
    for name in loads:
        columns += [Column(labels[name], "number"), Column("±", "number", "standard uncertainty")]
    columns += [Column("drift to come", "number", "of the load with the worst verdict")]
    rows, marks = [], []
    for item in cases:
        cells = [item.case.name, item.verdict + (", waived" if item.waived else "")]
        cells += [significant(item.settling.cut_time, 4), significant(item.settling.end_time, 4)]
        for name in loads:
            if name not in item.names:
                cells += ["–", "–"]
                continue
            channel = item[name]
            cells += [
                fixed(channel.mean, _places(channel.standard_uncertainty)),
                significant(channel.standard_uncertainty, 2),
            ]
        worst = next(item[name] for name in item.fitted if item[name].verdict == item.verdict)
        cells.append(significant(worst.drift, 2))
        rows.append(cells)
        marks.append("" if item.waived else MARKS.get(item.verdict, ""))
    return make_table(columns, rows, marks=marks)


def load_table(item: SettledCase) -> Table:
    """Every load of one case: mean, errors, independent samples, drift, verdict, and why."""
    columns = [
        Column("load", "short"),
        Column("mean", "number"),
        Column("se", "number", "standard error from the autocorrelation"),
        Column("batch se", "number", "standard error by batch means"),
        Column("independent", "number", "independent samples; whole cycles of a periodic load"),
        Column("drift to come", "number"),
        Column("±", "number"),
        Column("verdict", "short"),
        Column("why", "name"),
    ]
    rows, marks = [], []
    for name, channel in zip(item.names, item.settling.channels):
        rows.append(
            [
                item.loads.labelled(name),
                fixed(channel.mean, _places(channel.se)),
                *(significant(value, 2) for value in (channel.se, channel.batch_se)),
                fixed(channel.n_eff, 0),
                significant(channel.drift, 2),
                significant(channel.drift_se, 2),
                channel.verdict,
                channel.note,
            ]
        )
        marks.append(MARKS.get(channel.verdict, ""))
    return make_table(columns, rows, marks=marks)


def settling_facts(cases: Sequence[SettledCase]) -> list[tuple[str, str, str]]:
    """What the head of the page says: how many cases there are of each verdict."""
    counts = Counter(item.verdict for item in cases)
    facts = [("cases", str(len(cases)), f"{len({item.case.grid for item in cases})} grid(s)")]
    facts += [(verdict, str(count), "") for verdict, count in counts.most_common()]
    return facts


def settled_text(cases: Sequence[SettledCase]) -> str:
    """What a terminal shows: one row a case and fitted load."""
    import pandas as pd

    rows: list[dict[str, Any]] = []
    for item in cases:
        for name in item.fitted:
            channel = item[name]
            rows.append(
                {
                    "case": item.case.name,
                    "load": item.loads.labelled(name),
                    "mean": channel.mean,
                    "se": channel.se,
                    "n_eff": channel.n_eff,
                    "cut": item.settling.cut_time,
                    "verdict": channel.verdict,
                    "remaining drift": channel.drift,
                    "± ": channel.drift_se,
                }
            )
    frame = pd.DataFrame(rows)
    counts = Counter(item.verdict for item in cases)
    summary = ", ".join(f"{count} {verdict}" for verdict, count in counts.most_common())
    return f"{aligned_text(frame, list(frame.columns))}\n\n{len(cases)} case(s): {summary}"


def settled_records(frame: pd.DataFrame) -> list[dict[str, Any]]:
    """Rows of a table as plain data for JSON; NaN as None."""
    return [
        {str(key): None if isinstance(value, float) and math.isnan(value) else value for key, value in row.items()}
        for row in frame.to_dict("records")
    ]


def _places(error: float) -> int:
    if not (math.isfinite(error) and error > 0.0):
        return 4
    return min(max(1 - math.floor(math.log10(error)), 0), 8)
