"""Text tables and whole files written so that an interrupted run leaves the old file or none."""

from __future__ import annotations

import csv
import io
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import TowtankError


@contextmanager
def atomic_path(path: str | Path) -> Iterator[Path]:
    """A temporary path beside `path`, which takes its place when the block ends without an error.

    The temporary name keeps the ending, from which some writers take the format. If the block fails, or is
    interrupted, the temporary file is removed and `path` stays as it was.

    Parameters
    ----------
    path : str or Path
        The file to be written; its folder must exist.

    Yields
    ------
    Path
        Write to this.

    Raises
    ------
    TowtankError
        If the folder does not exist, or `path` is a folder.

    Examples
    --------
    >>> with atomic_path("derivatives.csv") as temporary:  # doctest: +SKIP
    ...     frame.to_csv(temporary)
    """
    target = Path(path)
    if not target.parent.is_dir():
        raise TowtankError("the folder to write to does not exist", cure="create it", file=target.parent)
    if target.is_dir():
        raise TowtankError("is a folder, not a file", cure="give the name of a file", file=target)
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}{target.suffix}")
    try:
        yield temporary
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)


def write_table(
    path: str | Path,
    columns: Mapping[str, ArrayLike],
    units: Mapping[str, str] | None = None,
    *,
    delimiter: str = "\t",
    decimal: str = ".",
    header: Sequence[str] = (),
    comment: str = "# ",
    encoding: str = "utf-8",
) -> None:
    """Write a text table that :func:`towtank.formats.read_table` reads back without loss.

    Parameters
    ----------
    path : str or Path
        The file; an existing one is replaced.
    columns : mapping of str to array_like, shape (n,)
        Columns by their names. Numbers are written with as many digits as they need, missing ones as ``nan``.
        Round them beforehand for a shorter file.
    units : mapping of str to str, optional
        Printed in a second row; a column without a unit gets ``-``. Without `units` there is no such row.
    delimiter : str
        Separator of one character.
    decimal : {".", ","}
        Decimal sign.
    header : sequence of str
        Lines put above the names, each behind `comment`.
    comment : str
        Mark of the header lines.
    encoding : str
        Encoding of names, units and header.

    Raises
    ------
    TowtankError
        If the columns differ in length or there are none, or if separator and decimal sign are the same.
    """
    if len(delimiter) != 1 or delimiter == decimal or delimiter in '\r\n"' or decimal not in (".", ","):
        raise TowtankError(
            f"'{delimiter}' as separator and '{decimal}' as decimal sign cannot be told apart or read again",
            cure="separate with a tab or semicolon, and write decimals with a point or a comma",
            file=path,
        )
    arrays = {name: np.ascontiguousarray(values, dtype=np.float64).ravel() for name, values in columns.items()}
    if len({len(values) for values in arrays.values()}) != 1:
        raise TowtankError("a table needs columns of one length", cure="cut or resample the channels", file=path)
    heading = io.StringIO()
    for line in header:
        heading.write(f"{comment}{line}\n")
    writer = csv.writer(heading, delimiter=delimiter, lineterminator="\n")
    writer.writerow(arrays)
    if units is not None:
        writer.writerow([units.get(name) or "-" for name in arrays])
    with atomic_path(path) as temporary, open(temporary, "wb") as file:
        file.write(heading.getvalue().encode(encoding))
        file.write(_rows(arrays, delimiter, decimal))


def _rows(arrays: Mapping[str, np.ndarray], delimiter: str, decimal: str) -> bytes:
    import pyarrow as pa
    from pyarrow import csv as arrow_csv

    table = pa.table({name: pa.array(values) for name, values in arrays.items()})
    sink = pa.BufferOutputStream()
    options = arrow_csv.WriteOptions(include_header=False, delimiter=delimiter, quoting_style="none")
    arrow_csv.write_csv(table, sink, options)
    rows = sink.getvalue().to_pybytes()
    return rows if decimal == "." else rows.replace(b".", decimal.encode())
