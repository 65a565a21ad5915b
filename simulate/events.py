"""Events of a manoeuvre: the full state at each of them, for one run or for many draws."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    import pandas as pd

FloatArray = np.ndarray

COLUMNS = ("time", "x", "y", "psi", "u", "v", "r", "phi", "p", "delta", "n")
"""What is known at an event, in SI: seconds, metres, radians, metres and radians a second, revolutions a second."""

COLUMN_NUMBER = {name: number for number, name in enumerate(COLUMNS)}


@dataclass(frozen=True, eq=False)
class Events:
    """States at the events of a manoeuvre.

    Attributes
    ----------
    mapping : mapping of str to ndarray, shape (draws, 11)
        Event name -> state (`COLUMNS`), a row a draw; rows of NaN where the event did not occur. A single row of
        shape (11,) is taken as one draw.

    Notes
    -----
    Names of a turning circle: ``"execute"``, ``"heading 10"`` (degrees turned since execute, in the direction of
    the manoeuvre), ``"heading 90"``, ..., ``"maximum advance"`` (dx/dt = 0), ``"maximum transfer"`` (dy/dt = 0),
    ``"end"``. Of a zig-zag: ``"execute 1"``, ``"extreme 1"`` (first heading extreme, after ``"execute 2"``),
    ``"execute 2"``, ``"extreme 2"``, ..., ``"end"``. Of a crash stop: ``"execute"``, ``"stopped"``.
    """

    mapping: Mapping[str, FloatArray]

    def __post_init__(self) -> None:
        rows = {name: np.atleast_2d(np.asarray(value, dtype=float)) for name, value in self.mapping.items()}
        shapes = {value.shape for value in rows.values()}
        if any(len(shape) != 2 or shape[1] != len(COLUMNS) for shape in shapes) or len(shapes) > 1:
            raise TowtankError(
                f"events have the shapes {', '.join(map(str, sorted(shapes)))}",
                cure=f"give each event an array of shape (draws, {len(COLUMNS)}), a row a draw",
            )
        object.__setattr__(self, "mapping", rows)

    def __contains__(self, name: str) -> bool:
        return name in self.mapping

    def __iter__(self) -> Iterator[str]:
        return iter(self.mapping)

    def __getitem__(self, name: str) -> FloatArray:
        try:
            return self.mapping[name]
        except KeyError:
            raise TowtankError(
                f"the manoeuvre has no event '{name}'", cure=f"its events are {', '.join(self.mapping) or 'none'}"
            ) from None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the events that were watched, in their order."""
        return tuple(self.mapping)

    @property
    def draws(self) -> int:
        """Number of draws; 1 for a single run."""
        return next((len(rows) for rows in self.mapping.values()), 0)

    def at(self, name: str, column: str) -> FloatArray:
        """One quantity at one event, shape (draws,); NaN where the event did not occur or was not watched.

        Raises
        ------
        TowtankError
            For an unknown column.
        """
        if column not in COLUMN_NUMBER:
            raise TowtankError(f"events have no column '{column}'", cure=f"columns are {', '.join(COLUMNS)}")
        if name not in self.mapping:
            return np.full(self.draws, np.nan)
        return self.mapping[name][:, COLUMN_NUMBER[column]]

    def occurred(self, name: str) -> FloatArray:
        """Whether the event occurred, shape (draws,) of bool."""
        return np.isfinite(self.at(name, "time"))

    def draw(self, number: int | slice | FloatArray) -> Events:
        """Events of one draw, or of a slice or a mask of the draws."""
        return Events({name: np.atleast_2d(rows[number]) for name, rows in self.mapping.items()})

    def frame(self, draw: int = 0) -> pd.DataFrame:
        """Events of one draw that occurred, in the order of time; columns as `COLUMNS`, indexed by name."""
        import pandas as pd

        happened = {name: rows[draw] for name, rows in self.mapping.items() if np.isfinite(rows[draw, 0])}
        table = pd.DataFrame.from_dict(happened, orient="index", columns=list(COLUMNS))
        return table.sort_values("time", kind="stable").rename_axis("event")


def stack_events(parts: Sequence[Events]) -> Events:
    """Draws of several results below one another; an event that a part did not watch is NaN there.

    Raises
    ------
    TowtankError
        When there is nothing to stack.
    """
    if not parts:
        raise TowtankError("there are no events to stack", cure="give the results of at least one draw")
    names = dict.fromkeys(name for part in parts for name in part)
    missing = [np.full((part.draws, len(COLUMNS)), np.nan) for part in parts]
    return Events(
        {
            name: np.concatenate([part.mapping.get(name, gap) for part, gap in zip(parts, missing, strict=True)])
            for name in names
        }
    )
