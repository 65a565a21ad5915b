"""Tables of plain decimal numbers, parsed by compiled code.

A large campaign spends most of its time on turning text into numbers. This parser takes only what it can turn into the
nearest double with a single rounding (at most 15 digits, powers of ten up to 22; Clinger 1990) in lines that all have
the same number of cells, and refuses everything else, which then goes to the general reader.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit

_DIGITS = 15
_POWERS = 10.0 ** np.arange(23)
"""Powers of ten that are doubles without rounding."""

_ZERO, _NINE, _MINUS, _PLUS, _RETURN, _NEWLINE = (ord(c) for c in "09-+\r\n")
_E, _SMALL_E = ord("E"), ord("e")


def parse_plain(
    body: bytes, delimiter: str, decimal: str, columns: int, wanted: Sequence[int], trailing: int = 0
) -> list[np.ndarray] | None:
    """Columns of a table of numbers; None when anything in it is not plain.

    Parameters
    ----------
    body : bytes
        Rows without header, the last without a line end.
    delimiter, decimal : str
        One character each.
    columns : int
        Cells of every row.
    wanted : sequence of int
        Columns to return, from 0.
    trailing : int
        Delimiters behind the last cell of every row.
    """
    text = np.frombuffer(body + b"\n", dtype=np.uint8)
    place = np.full(columns, -1, dtype=np.int64)
    place[list(wanted)] = np.arange(len(wanted))
    rows = body.count(b"\n") + 1
    result = np.empty((len(wanted), rows))
    done = _parse(text, ord(delimiter), ord(decimal), place, trailing, _POWERS, result)
    return list(result) if done == rows else None


@njit(cache=True, nogil=True, error_model="numpy")
def _parse(
    text: np.ndarray,
    delimiter: int,
    decimal: int,
    place: np.ndarray,
    trailing: int,
    powers: np.ndarray,
    result: np.ndarray,
) -> int:
    """Number of rows parsed, or -1 at the first thing that is not a plain number."""
    at, row, stop, columns = 0, 0, len(text), len(place)
    while at < stop:
        for column in range(columns):
            char = text[at]
            negative = char == _MINUS
            if negative or char == _PLUS:
                at += 1
                char = text[at]
            mantissa, first = np.int64(0), at
            while _ZERO <= char <= _NINE:
                mantissa = mantissa * 10 + (char - _ZERO)
                at += 1
                char = text[at]
            digits, power = at - first, 0
            if char == decimal:
                at += 1
                char = text[at]
                first = at
                while _ZERO <= char <= _NINE:
                    mantissa = mantissa * 10 + (char - _ZERO)
                    at += 1
                    char = text[at]
                power = first - at
                digits -= power
            if digits == 0 or digits > _DIGITS:
                return -1
            if char in (_E, _SMALL_E):
                at += 1
                char = text[at]
                down = char == _MINUS
                if down or char == _PLUS:
                    at += 1
                    char = text[at]
                exponent, first = 0, at
                while _ZERO <= char <= _NINE and at - first < 4:
                    exponent = exponent * 10 + (char - _ZERO)
                    at += 1
                    char = text[at]
                if at == first:
                    return -1
                power += -exponent if down else exponent
            if power > 22 or power < -22:
                return -1
            target = place[column]
            if target >= 0:
                value = mantissa / powers[-power] if power < 0 else mantissa * powers[power]
                result[target, row] = -value if negative else value
            if column < columns - 1:
                if char != delimiter:
                    return -1
                at += 1
        for _ in range(trailing):
            if text[at] != delimiter:
                return -1
            at += 1
        if text[at] == _RETURN:
            at += 1
        if at >= stop or text[at] != _NEWLINE:
            return -1
        at += 1
        row += 1
    return row
