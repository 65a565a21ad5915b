"""Monitors and reports that STAR-CCM+ exports as CSV.

A heading reads ``Force X Monitor: Force X (N)``: the monitor, what it watches, its unit. The column takes the name of
the monitor without the word, here ``Force X``.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from pathlib import Path

from .log_layout import LogLayout
from .raw_table import number_repeats
from .solver_log import EmptyLogError

_HEADING = re.compile(r"^(?P<monitor>[^:]+?)(?:\s*:\s*(?P<watched>.*?))?\s*(?:\((?P<unit>[^()]*)\))?$")
_INDEX = {"physical time": "time", "time": "time", "iteration": "iteration", "time step": "time_step"}


def star_layout(head: bytes, path: Path) -> LogLayout | None:
    """Columns of a CSV of STAR-CCM+; None if it is none.

    Raises
    ------
    ReadError
        If it has a heading and no rows.
    """
    first, _, below = head.partition(b"\n")
    line = first.decode("utf-8-sig", errors="replace").strip()
    if "," not in line or not re.search(r"Physical Time|Iteration|Time Step|\bMonitor\s*:|\bPlot\s*:", line):
        return None
    headings = [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]
    while headings and not headings[-1]:
        headings.pop()
    matches = [_HEADING.match(heading) for heading in headings]
    if not all(matches) or not (_index_of(headings[0]) or any(": " in heading for heading in headings)):
        return None
    names, units = [], []
    for match in matches:
        assert match is not None
        index = _index_of(match["monitor"])
        names.append(index or re.sub(r"\s+(Monitor|Plot)$", "", match["monitor"].strip()))
        units.append("s" if index == "time" and not match["unit"] else match["unit"] or "")
    twice = {name for name, count in Counter(names).items() if count > 1}
    # A plot of one report on two parts repeats the name; then the watched part tells them apart.
    names = [
        f"{name}: {match['watched']}" if name in twice and match is not None and match["watched"] else name
        for name, match in zip(names, matches)
    ]
    unique, _ = number_repeats(names)
    if not {"time", "iteration"} & set(unique):
        if "time_step" not in unique:
            return None
        unique = tuple("iteration" if name == "time_step" else name for name in unique)
    if not below.strip():
        raise EmptyLogError(
            "there are no data rows", cure="the file holds a header only: export it again", file=path
        )
    return LogLayout(
        dialect="STAR-CCM+",
        kind="residuals" if path.stem.lower().startswith("residual") else "monitor",
        names=unique,
        units=dict(zip(unique, units)),
        first_byte=len(first) + 1,
        delimiter=",",
        comment="",
    )


def _index_of(heading: str) -> str:
    """``time``, ``iteration`` or ``time_step`` if the heading is one of them, else nothing."""
    name = re.sub(r"\s*\([^()]*\)$", "", heading.partition(":")[0].strip()).lower()
    return _INDEX.get(name, "")
