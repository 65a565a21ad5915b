"""What the columns of a solver log are, as told by its header and its first row."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from .solver_log import LogKind, Point


@dataclass(frozen=True)
class LogLayout:
    """The form of one file of histories.

    Attributes
    ----------
    dialect : str
        The solver or family of files.
    kind : str
        What it holds; see :class:`towtank.formats.solver_log.SolverLog`.
    names : tuple of str
        A name for each number of a row; empty for text, which is passed over. One is ``time`` or ``iteration``.
    units : mapping of str to str
        Units by name; empty if the file gives none.
    first_byte : int
        Where the rows begin.
    delimiter : str
        One character; a blank stands for runs of blanks, tabs and parentheses.
    comment : str
        First character of lines to be skipped; empty if there are none.
    header : mapping of str to str
        Entries of the header as printed.
    points : mapping of str to (float, float, float)
        Coordinates of probes by column without component.
    notes : tuple of str
        What is missing or was inferred.
    """

    dialect: str
    kind: LogKind
    names: tuple[str, ...]
    units: Mapping[str, str]
    first_byte: int
    delimiter: str = " "
    comment: str = "#"
    header: Mapping[str, str] = field(default_factory=dict)
    points: Mapping[str, Point] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def index_name(self) -> str:
        """``"time"`` if there is such a column, else ``"iteration"``."""
        return "time" if "time" in self.names else "iteration"
