"""Where a solver began to print ``nan`` or ``inf`` and never printed a number again."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


class DivergenceWatch:
    """Looks at the rows of a history block by block.

    Parameters
    ----------
    names : sequence of str
        Columns, the index first.

    Notes
    -----
    A printed ``nan`` comes as an infinity and a missing value as NaN; see :mod:`towtank.formats.decimal_rows`. A column
    that stops having values, as the monitor of a part that was removed, does not diverge.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self._names = list(names)
        self._has_numbers = np.zeros(len(names), dtype=bool)
        self._since = np.full(len(names), np.nan)
        self._bad = np.zeros(len(names), dtype=np.int64)
        self._trailing = np.zeros(len(names), dtype=np.int64)

    def add(self, block: np.ndarray) -> None:
        """Take rows, shape (k, n); infinities in them become NaN."""
        values = block[1:]
        infinite = np.isinf(values)
        if not infinite.any():
            numbered = np.flatnonzero(~np.isnan(values).all(axis=1)) + 1
            self._has_numbers[numbered] = True
            self._end_trail(numbered)
            return
        values[infinite] = np.nan
        for column in range(1, len(block)):
            bad = np.flatnonzero(infinite[column - 1])
            numbers = np.flatnonzero(~np.isnan(block[column]))
            if numbers.size:
                self._has_numbers[column] = True
                self._end_trail(np.array([column]))
                trail = bad[bad > numbers[-1]]
            else:
                trail = bad
            self._bad[column] += len(bad)
            if trail.size and np.isnan(self._since[column]):
                self._since[column] = block[0, trail[0]]
            self._trailing[column] += len(trail)

    def _end_trail(self, columns: np.ndarray) -> None:
        self._since[columns] = np.nan
        self._trailing[columns] = 0

    @property
    def diverged_at(self) -> float | None:
        """Index of the first row of the trail of ``nan`` that some column ends in; None if none does."""
        since = self._since[self._has_numbers]
        return float(np.nanmin(since)) if np.isfinite(since).any() else None

    @property
    def is_empty(self) -> bool:
        """Whether no column ever had a number, and some printed ``nan``."""
        return bool(self._bad.any()) and not self._has_numbers.any()

    def notes(self, rows_left_out: int) -> list[str]:
        """What was seen, in words."""
        said = []
        never = [name for name, bad, has in zip(self._names, self._bad, self._has_numbers) if bad and not has]
        if never:
            said.append(f"{', '.join(never)}: nan or inf throughout")
        gaps = int((self._bad - self._trailing)[self._has_numbers].sum())
        if gaps:
            said.append(f"{gaps} value(s) are printed as nan or inf between numbers and are missing here")
        at = self.diverged_at
        if at is not None:
            guilty = self._names[int(np.nanargmin(np.where(self._has_numbers, self._since, np.nan)))]
            said.append(
                f"diverged: {guilty} is nan or inf from {self._names[0]} {at:.9g} on; {rows_left_out} row(s) from "
                "there were left out"
            )
        return said
