"""A table as a file holds it: columns under their printed names, in their printed units."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding

if TYPE_CHECKING:
    import pandas as pd

    from .dialect import Dialect


@dataclass(frozen=True, eq=False)
class RawTable:
    """Columns of one file before any conversion.

    Attributes
    ----------
    columns : dict of str to ndarray of float64, shape (n,)
        Values as printed, under the printed names (a unit in brackets behind a name is taken off it).
        The arrays are read-only. Empty cells are NaN.
    units : dict of str to str
        Unit of each column as printed; empty where the file gives none.
    header : tuple of str
        The lines above the data and comment lines, as read.
    metadata : dict of str to str or float
        Entries ``key: value`` or ``key = value`` of the header; scalars and attributes of binary files.
    path : str
        The file.
    sha256 : str
        Digest of its bytes.
    findings : tuple of Finding
        What the reader noticed or mended.
    file_columns : tuple of str
        Names of all columns of the file in their order, also of those that were not read.
    dialect : Dialect or None
        How a text file was understood; pass it on to read the next file of the same campaign faster.

    Raises
    ------
    ReadError
        If the columns differ in length.
    """

    columns: dict[str, np.ndarray]
    units: dict[str, str] = field(default_factory=dict)
    header: tuple[str, ...] = ()
    metadata: dict[str, str | float] = field(default_factory=dict)
    path: str = ""
    sha256: str = ""
    findings: tuple[Finding, ...] = ()
    file_columns: tuple[str, ...] = ()
    dialect: Dialect | None = None

    def __post_init__(self) -> None:
        frozen = {}
        for name, values in self.columns.items():
            view = np.asarray(values, dtype=np.float64).view()
            view.flags.writeable = False
            frozen[name] = view
        if len({len(values) for values in frozen.values()}) > 1:
            lengths = ", ".join(f"{name}: {len(values)}" for name, values in frozen.items())
            raise ReadError(f"columns differ in length ({lengths})", file=self.path or None)
        object.__setattr__(self, "columns", frozen)
        object.__setattr__(self, "units", {name: self.units.get(name, "") for name in frozen})
        if not self.file_columns:
            object.__setattr__(self, "file_columns", tuple(frozen))

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()))) if self.columns else 0

    @property
    def frame(self) -> pd.DataFrame:
        """The columns as a DataFrame; ``attrs`` holds ``units``, ``path`` and ``sha256``."""
        import pandas as pd

        frame = pd.DataFrame(dict(self.columns))
        frame.attrs.update(units=dict(self.units), path=self.path, sha256=self.sha256)
        return frame


def find_column(
    wanted: str | int, names: Sequence[str], *, file: str = "", place: str = "", unit: str | None = None
) -> str:
    """Name of the column that `wanted` means.

    Parameters
    ----------
    wanted : str or int
        A name as printed, or the number of the column counted from 1 at the left.
    names : sequence of str
        Names of all columns of the file in their order.
    file, place : str
        Named in the error.
    unit : str, optional
        Also accept a column whose stored name ends in this unit in brackets.

    Raises
    ------
    ReadError
        If there is no such column; the message lists the closest names.
    """
    have = f"the file has {', '.join(names)}"
    if isinstance(wanted, int):
        if 1 <= wanted <= len(names):
            return names[wanted - 1]
        raise ReadError(
            f"there is no column {wanted}",
            cure=f"count the columns from 1 to {len(names)}; {have}",
            file=file or None,
            place=place,
        )
    spellings = (wanted, f"{wanted} [{unit}]", f"{wanted} ({unit})") if unit else (wanted,)
    for spelling in spellings:
        if spelling in names:
            return spelling
    by_lower_case = {name.lower(): name for name in names}
    close = difflib.get_close_matches(wanted.lower(), by_lower_case, n=3, cutoff=0.5)
    guess = f"closest: {', '.join(by_lower_case[name] for name in close)}; " if close else ""
    raise ReadError(f"there is no column '{wanted}'", cure=guess + have, file=file or None, place=place)


def choose_columns(
    wanted: Iterable[str | int] | None,
    names: Sequence[str],
    text_columns: Collection[str] = (),
    *,
    file: str = "",
) -> list[str]:
    """Names of the columns to be read, in the order asked for; all columns of numbers if `wanted` is None.

    Raises
    ------
    ReadError
        If there is no such column, or it is one of `text_columns`.
    """
    if wanted is None:
        return [name for name in names if name not in text_columns]
    chosen = list(dict.fromkeys(find_column(one, names, file=file) for one in wanted))
    for name in chosen:
        if name in text_columns:
            raise ReadError(
                f"column '{name}' holds text, not numbers", cure="map a column of numbers", file=file or None
            )
    return chosen


def number_repeats(names: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Make names unique by numbering the second and later occurrences.

    Returns
    -------
    unique, repeated : tuple of str
        ``("a", "b", "a_2")`` and ``("a",)`` for ``a, b, a``.
    """
    unique: list[str] = []
    repeated: list[str] = []
    taken = set(names)
    seen: set[str] = set()
    for name in names:
        if name not in seen:
            seen.add(name)
            unique.append(name)
            continue
        if name not in repeated:
            repeated.append(name)
        count = 2
        while f"{name}_{count}" in taken:
            count += 1
        taken.add(f"{name}_{count}")
        unique.append(f"{name}_{count}")
    return tuple(unique), tuple(repeated)
