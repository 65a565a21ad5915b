"""What a flow solver logged: histories of forces, motions, probes and residuals, in one form for all solvers."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import ReadError

if TYPE_CHECKING:
    import pandas as pd

LogKind = Literal["forces", "coefficients", "motion", "probes", "surface", "residuals", "monitor"]

Point = tuple[float, float, float]

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


class EmptyLogError(ReadError):
    """A file of histories without rows: its run wrote nothing, or has not yet."""


@dataclass(frozen=True)
class Restart:
    """A place where a history was taken up again at an earlier time.

    Attributes
    ----------
    file : Path
        File of the newer run.
    start : float
        Its first time (or iteration).
    previous_end : float
        Last time of the run before.
    rows_dropped : int
        Rows of the older run at and behind `start`, which the newer run replaced.
    """

    file: Path
    start: float
    previous_end: float
    rows_dropped: int

    @property
    def text(self) -> str:
        """The restart in one line."""
        return (
            f"restarted at {self.start:.9g} ({self.file.name}); the run before ended at {self.previous_end:.9g}, "
            f"{self.rows_dropped} of its rows were replaced"
        )


@dataclass(frozen=True, eq=False)
class SolverLog:
    """One history as the solver wrote it: its own axes, its own units, no density applied.

    Attributes
    ----------
    name : str
        Name of the function object, monitor or file.
    kind : {"forces", "coefficients", "motion", "probes", "surface", "residuals", "monitor"}
        What it holds.
    frame : DataFrame
        First column ``time``, or ``iteration`` where the solver counts only iterations, strictly increasing; then
        the histories as float64. Missing values are NaN.
    units : mapping of str to str
        Unit of each column as printed or known of the solver; empty where there is none.
    files : tuple of Path
        Files that it was read from, oldest run first.
    restarts : tuple of Restart
        Where runs were joined.
    notes : tuple of str
        What was mended, left out or not found.
    header : mapping of str to str
        Entries of the newest file's header as printed, e.g. ``{"CofR": "(0 0 0)", "Aref": "1.0e+00"}``.
    points : mapping of str to (float, float, float)
        Coordinates of probes and gauges by the column they belong to, without its component.
    diverged_at : float or None
        First time at which the solver printed ``nan`` or ``inf`` for good; the rows from there on are left out.
    """

    name: str
    kind: LogKind
    frame: pd.DataFrame
    units: Mapping[str, str]
    files: tuple[Path, ...]
    restarts: tuple[Restart, ...] = ()
    notes: tuple[str, ...] = ()
    header: Mapping[str, str] = field(default_factory=dict)
    points: Mapping[str, Point] = field(default_factory=dict)
    diverged_at: float | None = None

    def __len__(self) -> int:
        return len(self.frame)

    @property
    def index_name(self) -> str:
        """``"time"`` or ``"iteration"``."""
        return str(self.frame.columns[0])

    @property
    def dt(self) -> float:
        """Median step of the time or iteration; NaN for a single row."""
        at = self.frame.iloc[:, 0].to_numpy()
        return float(np.median(np.diff(at))) if len(at) > 1 else float("nan")

    def vector(self, key: str) -> tuple[float, ...] | None:
        """Numbers of a header entry such as ``CofR``; None if the header has no such entry."""
        if key not in self.header:
            return None
        return tuple(float(number) for number in _NUMBER.findall(self.header[key]))


@dataclass(frozen=True, eq=False)
class SolverCase:
    """All histories of one computation.

    Attributes
    ----------
    name : str
        Name of the case folder, or of the file.
    folder : Path
        Where it stands.
    logs : mapping of str to SolverLog
        Histories by name.
    notes : tuple of str
        Files that were passed over, and why.
    """

    name: str
    folder: Path
    logs: Mapping[str, SolverLog]
    notes: tuple[str, ...] = ()

    def of_kind(self, kind: LogKind) -> tuple[SolverLog, ...]:
        """All histories of one kind, in the order of their names."""
        return tuple(log for log in self.logs.values() if log.kind == kind)

    def log(self, kind: LogKind, name: str | None = None) -> SolverLog:
        """The one history of a kind, or the one of this name.

        Raises
        ------
        ReadError
            If there is none, or there are several and no name is given.
        """
        found = {log.name: log for log in self.of_kind(kind)}
        if name is not None:
            found = {key: log for key, log in found.items() if key == name}
        if len(found) == 1:
            return next(iter(found.values()))
        if not found:
            named = f" named '{name}'" if name is not None else ""
            have = ", ".join(f"{log.name} ({log.kind})" for log in self.logs.values()) or "nothing"
            raise ReadError(
                f"the case has no {kind}{named}",
                cure="; ".join((f"write them in the next run; it has {have}", *self.notes)),
                file=self.folder,
            )
        raise ReadError(
            f"the case has {len(found)} histories of kind {kind}",
            cure=f"name one of {', '.join(found)}",
            file=self.folder,
        )
