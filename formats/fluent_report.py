"""Report files of Fluent: lines of quoted names, then blank-separated columns.

::

    "report-drag-rfile"
    "Time Step" "report-drag etc.."
    ("Time Step" "report-drag" "flow-time")
    1 12.5 0.001

The last line of quoted names that is as long as the rows names the columns. Plot files (``.frp``, ``.out`` of older
monitors) have a title, the labels of two axes, and rows that may stand between ``((xy/key/label "name")`` and ``)``.
"""

from __future__ import annotations

import re
from pathlib import Path

from ..core.errors import ReadError
from .log_layout import LogLayout
from .number_text import is_number
from .solver_log import EmptyLogError

_QUOTED = re.compile(r'"([^"]*)"')
_BEGINNINGS = ('"', '("', "(title", "(labels", "((xy/")
_INDEX_NAMES = {
    **dict.fromkeys(("time step", "time-step"), "time_step"),
    **dict.fromkeys(("iteration", "iterations"), "iteration"),
    **dict.fromkeys(("flow-time", "flow time", "time"), "time"),
}
_HEADER_LINES = 12


def fluent_layout(head: bytes, path: Path) -> LogLayout | None:
    """Columns of a Fluent report or plot file; None if it is none.

    Raises
    ------
    EmptyLogError
        If it is one and has no rows.
    ReadError
        If it has another number of names than of values, or neither time nor iterations.
    """
    lines = head.splitlines(keepends=True)
    if not lines or not lines[0].decode(errors="replace").startswith(_BEGINNINGS) or b"," in lines[0]:
        return None
    at = 0
    cells: list[str] = []
    heads: list[str] = []
    for raw in lines[:_HEADER_LINES]:
        line = raw.decode("utf-8", errors="replace").strip()
        values = line.strip("()").split()
        if values and all(map(is_number, values)):
            cells = values
            break
        if line:
            heads.append(line)
        at += len(raw)
    if not any(line.startswith(_BEGINNINGS[1:]) for line in heads) and len(heads) != 2:
        return None
    if not cells:
        raise EmptyLogError(
            "there are no data rows", cure="the file holds a header only: the run wrote nothing", file=path
        )
    names = _names(heads, len(cells), path)
    plain = [_INDEX_NAMES.get(name.lower(), name) for name in names]
    if "time_step" in plain and not {"time", "iteration"} & set(plain):
        plain[plain.index("time_step")] = "iteration"
    if not {"time", "iteration"} & set(plain):
        raise ReadError(
            f"none of the columns {', '.join(names)} counts time or iterations",
            cure="add flow-time to the report file",
            file=path,
        )
    title = next((_QUOTED.findall(line)[0] for line in heads if len(_QUOTED.findall(line)) == 1), "")
    return LogLayout(
        dialect="Fluent",
        kind="residuals" if "residual" in title.lower() else "monitor",
        names=tuple(plain),
        units={name: "s" if name == "time" else "" for name in plain},
        first_byte=at,
        comment="",
        header={"title": title} if title else {},
    )


def _names(heads: list[str], count: int, path: Path) -> list[str]:
    """Names of the columns from the lines above them."""
    quoted = [_QUOTED.findall(line) for line in heads]
    fitting = [names for names in quoted if len(names) == count]
    if not fitting:
        widest = max(map(len, quoted), default=0)
        raise ReadError(
            f"the header names {widest} columns and the rows have {count} values",
            cure="two report files were joined, or the report was changed within the run: split the file",
            file=path,
        )
    names = fitting[-1]
    # The key of a plot is the name of the monitor; its axis may only say "Cd".
    key = next((own[0] for line, own in zip(heads, quoted) if "xy/key/label" in line and own), "")
    return [names[0], key] if key and count == 2 else names
