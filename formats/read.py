"""One door for all formats: the reader is chosen by the bytes of the file."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from ..core.errors import ReadError
from .dialect import Dialect
from .raw_table import RawTable
from .source_file import SourceFile


@dataclass(frozen=True)
class Choices:
    """What the caller may say about a file; each format uses what concerns it."""

    dialect: Dialect | None = None
    sheet: str | None = None
    group: str | None = None
    columns: tuple[str | int, ...] | None = None
    compiled: bool = False


@dataclass(frozen=True)
class Format:
    """A kind of file.

    Attributes
    ----------
    name : str
        As given to ``read_table(format=...)``.
    endings : tuple of str
        File names that usually belong to it.
    marks : tuple of (int, bytes)
        Bytes that tell it, and where they stand; empty for text.
    parse : callable
        Reads a :class:`SourceFile` with :class:`Choices`. Imports its library when it is called.
    """

    name: str
    endings: tuple[str, ...]
    marks: tuple[tuple[int, bytes], ...]
    parse: Callable[[SourceFile, Choices], RawTable]


def _delimited(source: SourceFile, choices: Choices) -> RawTable:
    from .delimited import parse_delimited

    return parse_delimited(source, choices.dialect, choices.columns, compiled=choices.compiled)


def _simman(source: SourceFile, choices: Choices) -> RawTable:
    from .simman import parse_simman

    return parse_simman(source, None, choices.dialect, choices.columns)


def _spreadsheet(source: SourceFile, choices: Choices) -> RawTable:
    from .spreadsheet import parse_spreadsheet

    return parse_spreadsheet(source, choices.sheet, choices.columns)


def _matlab(source: SourceFile, choices: Choices) -> RawTable:
    from .matlab import parse_matlab

    return parse_matlab(source, choices.group, choices.columns)


def _hdf5(source: SourceFile, choices: Choices) -> RawTable:
    from .hdf5 import parse_hdf5

    return parse_hdf5(source, choices.group, choices.columns)


def _tdms(source: SourceFile, choices: Choices) -> RawTable:
    from .tdms import parse_tdms

    return parse_tdms(source, choices.group, choices.columns)


_HDF5_MARK = b"\x89HDF\r\n\x1a\n"

#: All formats by name, those with a mark before those that are told by their ending or not at all.
FORMATS: dict[str, Format] = {
    one.name: one
    for one in (
        Format("matlab", (".mat",), ((0, b"MATLAB 5.0 MAT-file"), (0, b"MATLAB 7.3 MAT-file")), _matlab),
        # A user block of a power of two bytes may stand before the mark.
        Format(
            "hdf5", (".h5", ".hdf5", ".hdf", ".nc"), tuple((n, _HDF5_MARK) for n in (0, 512, 1024, 2048)), _hdf5
        ),
        Format("tdms", (".tdms",), ((0, b"TDSm"),), _tdms),
        Format(
            "spreadsheet",
            (".xls", ".xlsx", ".xlsm", ".xlsb", ".ods"),
            ((0, b"PK\x03\x04"), (0, b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1")),
            _spreadsheet,
        ),
        Format("simman", (".simman",), (), _simman),
        Format(
            "delimited", (".csv", ".tsv", ".txt", ".dat", ".asc", ".prn", ".tab", ".out", ".lvm"), (), _delimited
        ),
    )
}


def read_table(
    path: str | Path,
    *,
    format: str = "auto",
    dialect: Dialect | None = None,
    sheet: str | None = None,
    group: str | None = None,
    columns: Iterable[str | int] | None = None,
    compiled: bool = False,
) -> RawTable:
    """Read a table from a file of any known format.

    Parameters
    ----------
    path : str or Path
        The file.
    format : str
        A name of `FORMATS`; ``"auto"`` goes by the first bytes of the file, then by its ending, and takes anything
        else for a delimited text table.
    dialect : Dialect, optional
        How a text table is written, e.g. ``table.dialect`` of another run of the campaign.
    sheet : str, optional
        Sheet of a workbook; default the first that holds a table.
    group : str, optional
        Group of an HDF5 or TDMS file, struct of a MATLAB file.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to read; default all.
    compiled : bool
        Parse the numbers of text tables by compiled code: three times as fast, after half a second of start-up.

    Raises
    ------
    ReadError
        If the file is missing, empty, of an unknown kind, or not readable in its format.
    """
    if format != "auto" and format not in FORMATS:
        raise ReadError(
            f"format '{format}' is unknown", cure=f"use auto or one of {', '.join(FORMATS)}", file=path
        )
    source = SourceFile.read(path)
    kind = FORMATS[format] if format != "auto" else detect(source)
    wanted = None if columns is None else tuple(columns)
    return kind.parse(source, Choices(dialect, sheet, group, wanted, compiled))


def detect(source: SourceFile) -> Format:
    """The format of a file, by its first bytes, then by its ending; delimited text if neither tells."""
    for kind in FORMATS.values():
        if any(source.data.startswith(mark, place) for place, mark in kind.marks):
            return kind
    ending = Path(source.path).suffix.lower()
    for kind in FORMATS.values():
        # MATLAB 4 files bear no mark; a text that is merely called .xls is read as text.
        if ending in kind.endings and (not kind.marks or (kind.name == "matlab" and b"\x00" in source.data[:64])):
            return kind
    return FORMATS["delimited"]
