"""Entries ``key = value`` of file headers and of model or condition files."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from ..core.errors import ReadError
from .number_text import is_number, to_number
from .source_file import SourceFile
from .text_bytes import as_single_bytes, encoding_of, refuse_binary
from .units import (
    conversion,
    convertible,
    counts_revolutions,
    looks_like_unit,
    split_name,
    strip_brackets,
)

# A colon between digits is no assignment: "scale 1:58", "time 12:30".
_ASSIGNED = re.compile(r"^(?P<key>.*?[^:=\s])\s*(?:=|(?<!\d):|:(?!\d))\s*(?P<value>\S.*)$")
_COMMENT = re.compile(r"^\s*[%;].*$|(^|\s)(#|!|//).*$")
_NUMBER_AND_REST = re.compile(r"^(?P<number>\S+)\s*(?P<rest>.*)$")


def header_entries(lines: Iterable[str]) -> dict[str, str | float]:
    """Entries ``key: value`` and ``key = value`` of header lines, without their comment marks.

    Pure numbers become floats; a number with a unit stays text, as printed. Lines of another form are passed over.
    """
    entries: dict[str, str | float] = {}
    for line in lines:
        match = _ASSIGNED.match(line.strip().rstrip(",;\t "))
        if match:
            value = match["value"].strip()
            entries[match["key"].strip()] = to_number(value) if is_number(value) else value
    return entries


def read_condition(path: str | Path) -> dict[str, str | float]:
    """Read a model or condition file.

    One entry a line: ``key value``, ``key = value`` or ``key: value``; a unit may stand behind the value
    (``Lpp = 4367.1 mm``) or in brackets behind the key (``Lpp [m]: 4.3671``). Values with a known unit are
    converted to SI (angles to radians, revolutions per minute to revolutions per second); numbers without a unit
    are taken as they stand; anything else stays text. Comment lines start with ``#``, ``!``, ``%``,
    ``;`` or ``//``, comments behind an entry with ``#``, ``!`` or ``//``; lines in square brackets are headings.

    Raises
    ------
    ReadError
        If a line has a key without a value, or a key comes twice with different values.
    """
    source = SourceFile.read(path)
    refuse_binary(source.data, source.path)
    text = as_single_bytes(source.data)
    lines = text.decode(encoding_of(text)).splitlines()
    entries: dict[str, str | float] = {}
    for number, line in enumerate(lines, start=1):
        line = _COMMENT.sub("", line).strip()
        if not line or (line.startswith("[") and line.endswith("]")):
            continue
        key, value = _entry(line, source.path, number)
        if key in entries and entries[key] != value:
            raise ReadError(
                f"'{key}' is given twice, as {entries[key]} and as {value}",
                cure="keep one of them",
                file=source.path,
                place=f"line {number}",
            )
        entries[key] = value
    return entries


def _entry(line: str, file: str, number: int) -> tuple[str, str | float]:
    match = _ASSIGNED.match(line)
    if match:
        key, value = match["key"].strip(), match["value"].strip()
    else:
        # The unit in brackets belongs to the key: "Lpp [m] 4.3671".
        spaced = re.match(r"^(\S+(?:\s*\[[^\]]*\])?)\s+(\S.*)$", line)
        if not spaced or line.rstrip().endswith((":", "=")):
            raise ReadError(
                f"'{line}' has no value",
                cure="write 'key = value', or put # before a comment",
                file=file,
                place=f"line {number}",
            )
        key, value = spaced[1], spaced[2].strip()
    if not key[0].isalpha():
        raise ReadError(
            f"'{key}' is not the name of a particular",
            cure="this is no condition file; name the right one",
            file=file,
            place=f"line {number}",
        )
    key, unit = split_name(key)
    return key, _si_value(value, unit)


def _si_value(value: str, unit: str) -> str | float:
    match = _NUMBER_AND_REST.match(value)
    if not match:
        return value
    decimal = "," if "," in match["number"] else "."
    if not is_number(match["number"], decimal):
        return value
    rest = strip_brackets(match["rest"])
    if rest and (unit or not looks_like_unit(rest)):
        return value
    magnitude = to_number(match["number"], decimal)
    unit = rest or unit
    if not unit:
        return magnitude
    if not looks_like_unit(unit):
        return value
    in_revolutions = convertible(unit, "revolution rate") if counts_revolutions(unit) else None
    return magnitude * (in_revolutions or conversion(unit).factor)
