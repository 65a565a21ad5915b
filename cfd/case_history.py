"""Histories of a case that are no loads: motions, probes, surface elevations, residuals, monitors."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import ReadError
from ..formats import SolverCase
from .case_loads import CaseLoads

if TYPE_CHECKING:
    import pandas as pd

EVERY = "all"
"""Stands for every history of a case."""


def history_names(case: SolverCase, wanted: str = EVERY) -> tuple[str, ...]:
    """Names of the histories that `wanted` means: one by its name, those of a kind, or all.

    Parameters
    ----------
    case : SolverCase
    wanted : str
        Name of a history (``probes/p``), a kind (``motion``, ``probes``, ``surface``, ``residuals``, ``coefficients``,
        ``monitor``, ``forces``), or ``all``.

    Raises
    ------
    ReadError
        If the case has none of it; the cure lists what it has.
    """
    found = tuple(name for name, log in case.logs.items() if wanted in (EVERY, name))
    found = found or tuple(name for name, log in case.logs.items() if log.kind == wanted)
    if found:
        return found
    have = ", ".join(f"{name} ({log.kind})" for name, log in case.logs.items())
    raise ReadError(f"there is no history '{wanted}'", cure=f"the case has {have}", file=case.folder)


def history_of(case: SolverCase, wanted: str, name: str | None = None) -> CaseLoads:
    """One history with all its columns, in the solver's own axes and units.

    Parameters
    ----------
    case : SolverCase
    wanted : str
        Its name, or its kind where the case has one of that kind.
    name : str, optional
        Name of the case; the folder's when not given.

    Raises
    ------
    ReadError
        If there is none, there are several, or it has no column of numbers.
    """
    names = history_names(case, wanted)
    if len(names) > 1:
        raise ReadError(
            f"the case has {len(names)} histories '{wanted}'",
            cure=f"name one of {', '.join(names)}",
            file=case.folder,
        )
    log = case.logs[names[0]]
    values = {str(column): log.frame[column].to_numpy() for column in log.frame.columns[1:]}
    channels = {column: one for column, one in values.items() if np.isfinite(one).any()}
    if not channels:
        raise ReadError(f"the history '{log.name}' has no numbers", cure="name another one", file=log.files[0])
    empty = [column for column in values if column not in channels]
    notes = [*log.notes, *(restart.text for restart in log.restarts)]
    notes += [f"column(s) without numbers are left out: {', '.join(empty)}"] if empty else []
    return CaseLoads(
        name=case.name if name is None else name,
        time=log.frame.iloc[:, 0].to_numpy(),
        index_name=log.index_name,
        channels=channels,
        conventions=Conventions(force_scaling="dimensional"),
        steps=(f"{log.kind} '{log.name}' in the solver's own axes and units",),
        notes=tuple(dict.fromkeys(notes)),
        files=tuple(str(file) for file in log.files),
        restarts=len(log.restarts),
        diverged_at=log.diverged_at,
        units=dict(log.units),
        history=log.name,
    )


def histories_table(case: SolverCase, name: str | None = None) -> pd.DataFrame:
    """One row a history: case, history, kind, rows, start, end, columns, and where its points are."""
    import pandas as pd

    rows = []
    for log in case.logs.values():
        at = log.frame.iloc[:, 0].to_numpy()
        rows.append(
            {
                "case": case.name if name is None else name,
                "history": log.name,
                "kind": log.kind,
                "rows": len(log),
                "start": float(at[0]),
                "end": float(at[-1]),
                "counts": log.index_name,
                "columns": " ".join(str(column) for column in log.frame.columns[1:]),
                "points": "; ".join(f"{key} ({x:g} {y:g} {z:g})" for key, (x, y, z) in log.points.items()),
            }
        )
    return pd.DataFrame(rows)
