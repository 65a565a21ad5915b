"""Any other table of histories: a line of names, then columns, as FINE/Marine, ReFRESCO and many tools write them."""

from __future__ import annotations

import re
from pathlib import Path

from ..core.errors import ReadError
from .dialect import FIXED, Dialect, sniff
from .log_layout import LogLayout
from .solver_log import EmptyLogError

#: Names under which tools write the time and the count of iterations, in lower case.
TIME_NAMES = ("time", "t", "physical time", "flow-time", "flow time", "simulation time", "temps")
ITERATION_NAMES = ("iteration", "iter", "iterations", "it", "time step", "timestep", "step", "nstep", "outer loop")


def monitor_layout(head: bytes, path: Path, index: str | int | None = None) -> LogLayout | None:
    """Columns of a table whose header names them; None if the file is no table with a time or a count.

    `index` is the column of the time, by name or by number from 1, where its name does not say so.

    Raises
    ------
    ReadError
        If it holds a header only.
    """
    bare, tecplot = _without_tecplot(head)
    try:
        # The last line of the beginning may be cut.
        form = sniff(bare.rpartition(b"\n")[0] + b"\n" if b"\n" in bare else bare, path)
    except ReadError as error:
        if "no data rows" in error.cause:
            raise EmptyLogError(error.cause, cure=error.cure, file=path) from None
        return None
    if form.delimiter == FIXED or form.decimal != ".":
        return None
    names = _index_named(form, index)
    if not {"time", "iteration"} & set(names):
        return None
    units = dict(zip(names, form.units))
    if "time" in units and not units["time"]:
        units["time"] = "s"
    kept = tuple("" if column in form.text_columns else name for column, name in enumerate(names))
    return LogLayout(
        dialect="columns",
        kind="monitor",
        names=kept,
        units={name: units[name] for name in kept if name},
        first_byte=tecplot + len(form.head),
        delimiter=" " if form.delimiter in (" ", "\t") and not _has_empty_cells(bare, form) else form.delimiter,
        comment=form.comment[:1],
        header={key: str(value) for key, value in form.metadata.items()},
        notes=tuple(finding.message for finding in form.findings),
    )


def _index_named(form: Dialect, index: str | int | None) -> tuple[str, ...]:
    """Names with the time and the count of iterations called ``time`` and ``iteration``."""
    names = list(form.names)
    if isinstance(index, int) and 1 <= index <= len(names):
        names[index - 1] = "time"
    elif index in names:
        names[names.index(str(index))] = "time"
    for known, name in ((TIME_NAMES, "time"), (ITERATION_NAMES, "iteration")):
        lower = [one.strip().lower() for one in names]
        place = next((lower.index(one) for one in known if one in lower), None)
        if place is not None and name not in names:
            names[place] = name
    return tuple(names)


def _has_empty_cells(head: bytes, form: Dialect) -> bool:
    return form.delimiter == "\t" and re.search(rb"\t\t|\t\r?\n", head[len(form.head) :]) is not None


def _without_tecplot(head: bytes) -> tuple[bytes, int]:
    """Tecplot headers (``TITLE =``, ``VARIABLES = "a" "b"``, ``ZONE T=``) as a plain line of names.

    Returns the beginning with such a header replaced, and the number of bytes by which it became shorter.
    """
    match = re.match(rb"(?is)\s*(?:#[^\n]*\n\s*)*(?:title[^\n]*\n\s*)?variables\s*=\s*", head)
    if match is None:
        return head, 0
    rows = re.search(rb"(?m)^[ \t]*[-+]?[0-9.][^\n\"=]*$", head[match.end() :])
    if rows is None:
        return head, 0
    listed = head[match.end() : match.end() + rows.start()].partition(b"ZONE")[0]
    names = re.findall(rb'"([^"]*)"', listed) or listed.replace(b",", b" ").split()
    if not names:
        return head, 0
    line = b"\t".join(names) + b"\n"
    body = head[match.end() + rows.start() :]
    # Blanks between the values become tabs only in this sample; the rows themselves are read as they are.
    sample = re.sub(rb"(?m)^\t+|[ \t]+$", b"", re.sub(rb"[ \t]+", b"\t", body))
    return line + sample, match.end() + rows.start() - len(line)
