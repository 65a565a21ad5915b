"""Water level and tidal current along a voyage: tables over time, and over the place in the fairway where needed.

Between the entries the tables are read by straight lines. Nothing is read before the first or after the last entry:
half an hour beyond the end of a tide table may be a decimetre, as much as the squat itself is uncertain.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError, ReadError
from ..formats.read import read_table
from .si_channel import require_channels, si_channel

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False)
class TideTable:
    """A water level or a current over time, at one place or at several along the fairway.

    Attributes
    ----------
    time : ndarray, shape (n,)
        In s, on the clock of the records; of one entry the value holds always.
    values : ndarray, shape (n,) or (n, k)
        Level in m above the datum of the altitudes, positive up; or current in m/s, positive with the ship.
    positions : ndarray, shape (k,), optional
        Places along the fairway in m, increasing, when there are several.
    quantity : str
        What the table holds, for messages.
    name, sha256 : str
        File and its digest.

    Raises
    ------
    FitError
        When a value is missing, the time or the places do not increase, or the shapes do not fit.
    """

    time: np.ndarray
    values: np.ndarray
    positions: np.ndarray | None = None
    quantity: str = "water level"
    name: str = ""
    sha256: str = ""

    def __post_init__(self) -> None:
        time, values = np.atleast_1d(np.asarray(self.time, float)), np.atleast_1d(np.asarray(self.values, float))
        places = None if self.positions is None else np.atleast_1d(np.asarray(self.positions, float))
        expected = (time.size,) if places is None else (time.size, places.size)
        if values.shape != expected:
            raise self._fault(
                f"has values of shape {values.shape} for {expected}", "give one value a time and place"
            )
        for axis, what in ((time, "time"), (values, "value"), (places, "place")):
            if axis is not None and not np.isfinite(axis).all():
                raise self._fault(f"a {what} is missing", "fill or leave out the entry")
        for axis, what in ((time, "times"), (places, "places")):
            if axis is not None and np.any(np.diff(axis) <= 0.0):
                raise self._fault(f"its {what} do not increase", "sort the table and drop repeated entries")
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "positions", places)

    @classmethod
    def constant(cls, value: float, quantity: str = "water level") -> TideTable:
        """A level in m, or a current in m/s, that does not change."""
        return cls(np.zeros(1), np.array([float(value)]), quantity=quantity)

    def at(self, time: ArrayLike, position: ArrayLike | None = None) -> np.ndarray:
        """Value at times in s and, with several places, at positions along the fairway in m; shape (n,).

        Raises
        ------
        FitError
            Outside the table, or without the position where the table needs it.
        """
        t = np.atleast_1d(np.asarray(time, dtype=float))
        if self.positions is None:
            return self._over_time(t, self.values)
        if position is None:
            raise self._fault("holds several places", "give the position along the fairway")
        x = np.broadcast_to(np.asarray(position, dtype=float), t.shape)
        self._inside(x, self.positions, "position", "m")
        columns = np.column_stack([self._over_time(t, column) for column in self.values.T])
        if columns.shape[1] == 1:
            return columns[:, 0]
        left = np.clip(np.searchsorted(self.positions, x, side="right") - 1, 0, columns.shape[1] - 2)
        share = (x - self.positions[left]) / (self.positions[left + 1] - self.positions[left])
        rows = np.arange(t.size)
        return np.asarray((1.0 - share) * columns[rows, left] + share * columns[rows, left + 1])

    def _over_time(self, time: np.ndarray, values: np.ndarray) -> np.ndarray:
        if self.time.size == 1:
            return np.full(time.shape, values[0])
        self._inside(time, self.time, "time", "s")
        return np.interp(time, self.time, values)

    def _inside(self, wanted: np.ndarray, known: np.ndarray, what: str, unit: str) -> None:
        outside = wanted[(wanted < known[0]) | (wanted > known[-1]) | ~np.isfinite(wanted)]
        if outside.size:
            raise self._fault(
                f"{what} {outside[0]:.10g} {unit} is outside its {known[0]:.10g} to {known[-1]:.10g} {unit}",
                "extend the table; nothing is extrapolated",
            )

    def _fault(self, cause: str, cure: str) -> FitError:
        return FitError(cause, cure=cure, file=self.name or None, place=f"table of the {self.quantity}")


def read_water_level(
    path: str | Path,
    *,
    time: str = "time",
    level: str | Mapping[str, float] = "level",
    correction: float = 0.0,
    units: Mapping[str, str] | None = None,
) -> TideTable:
    """Table of the water level from a file.

    Parameters
    ----------
    path : str or Path
    time : str
        Channel of time.
    level : str or mapping of str to float
        Channel of the level; or several, each with its place along the fairway in m.
    correction : float
        Added to all levels, in m: what a tide gauge shows beyond the model that the table comes from.
    units : mapping of str to str, optional
        Units that the file does not give.

    Raises
    ------
    ReadError
        When the file, a channel or its unit is not what it should be.
    FitError
        When values are missing or the time does not increase.
    """
    return _read(path, time, level, units, "length", "water level", correction)


def read_current(
    path: str | Path,
    *,
    time: str = "time",
    current: str | Mapping[str, float] = "current",
    units: Mapping[str, str] | None = None,
) -> TideTable:
    """Table of the current along the ship, positive with it, in m/s; arguments as :func:`read_water_level`.

    Raises
    ------
    ReadError, FitError
        As :func:`read_water_level`.
    """
    return _read(path, time, current, units, "velocity", "current", 0.0)


def _read(
    path: str | Path,
    time: str,
    channels: str | Mapping[str, float],
    units: Mapping[str, str] | None,
    dimension: str,
    quantity: str,
    correction: float,
) -> TideTable:
    table = read_table(path)
    table = replace(table, units={**table.units, **(units or {})})
    names = [channels] if isinstance(channels, str) else sorted(channels, key=lambda name: channels[name])
    if not names:
        raise ReadError(f"no channel of the {quantity} is named", cure="name one", file=path)
    require_channels(table, (time, *names))
    clock = si_channel(table, time, ("time",))
    columns = [si_channel(table, name, (dimension,)) + correction for name in names]
    if isinstance(channels, str):
        return TideTable(clock, columns[0], None, quantity, table.path, table.sha256)
    places = np.array([channels[name] for name in names], dtype=float)
    return TideTable(clock, np.column_stack(columns), places, quantity, table.path, table.sha256)
