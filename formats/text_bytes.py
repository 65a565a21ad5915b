"""Bytes of a text file to characters: which encoding, and is it text at all."""

from __future__ import annotations

import codecs
import re

from ..core.errors import ReadError

_UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
# Bytes that no text holds: control characters other than tab, line ends, form feed and end-of-file.
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x19\x1b-\x1f\x7f]")


def refuse_binary(data: bytes, file: str) -> None:
    """Raise :class:`ReadError` if the beginning of `data` is not text."""
    if data.startswith(_UTF16_MARKS):
        return
    head = data[:8192]
    if b"\x00" in head or len(_CONTROL.findall(head)) > len(head) // 100:
        raise ReadError(
            "is a binary file of an unknown kind",
            cure="export the run as text, .xls, .xlsx, .mat, HDF5 or TDMS",
            file=file,
        )


def encoding_of(data: bytes) -> str:
    """Encoding of a piece of text: ``utf-8-sig``, ``utf-16``, ``utf-8``, ``cp1252`` or ``latin-1``.

    Plain ASCII counts as ``utf-8``. Bytes that are not UTF-8 are taken for ``cp1252`` if it gives a printable
    meaning to those between 0x80 and 0x9F, else for ``latin-1``.
    """
    if data.startswith(codecs.BOM_UTF8):
        return "utf-8-sig"
    if data.startswith(_UTF16_MARKS):
        return "utf-16"
    try:
        # The piece may end within a character.
        codecs.getincrementaldecoder("utf-8")().decode(data, final=False)
        return "utf-8"
    except UnicodeDecodeError:
        pass
    if any(0x80 <= byte <= 0x9F for byte in data):
        try:
            data.decode("cp1252")
            return "cp1252"
        except UnicodeDecodeError:
            pass
    return "latin-1"


def as_single_bytes(data: bytes) -> bytes:
    """UTF-16 text as UTF-8, so that a line end is one byte; other text as it is."""
    return data.decode("utf-16").encode("utf-8") if data.startswith(_UTF16_MARKS) else data
