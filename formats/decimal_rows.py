"""Rows of decimal numbers in solver logs, parsed by compiled code to the nearest double.

Solvers print up to 17 digits, between blanks, tabs, commas or parentheses, and go on for gigabytes. Numbers of up to
19 digits are rounded once: by a product of exact doubles where that is enough (Clinger 1990), else by a product with
a 128-bit power of five (Lemire 2021, Number parsing at a gigabyte per second, section 5). The few that neither covers,
and every line that is not a row of numbers, are handed back to the caller.

A printed ``nan`` or ``inf`` comes back as an infinity and a missing cell (empty, ``N/A``) as NaN, so that a solver that
diverged can be told from a monitor that had no value.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numba import njit

ORDINARY, BLANK, DELIMITER, LINE_END = range(4)
"""What a character is: part of a cell, skipped between cells, end of a cell, end of a row."""

COMPLETE, FAULT, FULL = range(3)
"""Why the parser stopped: all is parsed, a line is no row of numbers, no room for more rows."""

_DIGITS = 19
_LARGEST_POWER = 290
"""Beyond these powers of ten a double may be subnormal or infinite."""

_EXACT = 10.0 ** np.arange(23)
_ZERO, _NINE, _MINUS, _PLUS, _POINT = (ord(c) for c in "09-+.")
_E, _SMALL_E, _NEWLINE = ord("E"), ord("e"), ord("\n")
_NAN_BITS = np.uint64(0x7FF8000000000000)
_INFINITY_BITS = np.uint64(0x7FF0000000000000)
_SIGN_BIT = np.uint64(0x8000000000000000)
_LOW_HALF = np.uint64(0xFFFFFFFF)
_U0, _U1, _U2, _U3, _U10, _U32, _U63, _U64 = (np.uint64(n) for n in (0, 1, 2, 3, 10, 32, 63, 64))
_PRECISION_MASK = np.uint64(0x1FF)
_HIDDEN_BIT = np.uint64(1 << 52)
_EXACT_MANTISSA = np.uint64(1 << 53)


@lru_cache(maxsize=1)
def _powers_of_five() -> np.ndarray:
    """First 128 bits of each power of five as two words, from the least power on; negative ones rounded up."""
    words = np.empty((2 * _LARGEST_POWER + 1, 2), dtype=np.uint64)
    for power in range(-_LARGEST_POWER, _LARGEST_POWER + 1):
        if power >= 0:
            value = 5**power
            shift = value.bit_length() - 128
            value = value >> shift if shift > 0 else value << -shift
        else:
            divisor = 5**-power
            # 128 bits behind the binary point of the reciprocal, whose last bit is rounded up.
            value = (1 << (divisor.bit_length() + 127)) // divisor + 1
            value >>= max(0, value.bit_length() - 128)
        words[power + _LARGEST_POWER] = value >> 64, value & 0xFFFFFFFFFFFFFFFF
    return words


def character_kinds(delimiter: str) -> np.ndarray:
    """Kind of each of the 256 bytes in a table of this delimiter.

    A blank stands for runs of blanks, tabs and parentheses, in which there are no empty cells. With any other
    delimiter each one ends a cell, and blanks and quotes around cells are skipped.
    """
    kinds = np.full(256, ORDINARY, dtype=np.uint8)
    kinds[[ord(c) for c in ' \t\r\f"()']] = BLANK
    if delimiter != " ":
        kinds[ord(delimiter)] = DELIMITER
    kinds[ord("\n")] = LINE_END
    return kinds


def parse_rows(
    text: np.ndarray,
    start: int,
    kinds: np.ndarray,
    delimited: bool,
    comment: int,
    places: np.ndarray,
    result: np.ndarray,
    row: int,
) -> tuple[int, int, int]:
    """Parse lines of `text` from `start` into `result` from `row` on.

    Parameters
    ----------
    text : ndarray of uint8, shape (n,)
        Whole lines: the last byte is a line end.
    start : int
        Where to begin.
    kinds : ndarray of uint8, shape (256,)
        See :func:`character_kinds`.
    delimited : bool
        Whether single delimiters stand between the cells.
    comment : int
        First byte of lines to be skipped; 0 if there are none.
    places : ndarray of int64, shape (columns,)
        Row of `result` for each column of the file, -1 for columns that are passed over.
    result : ndarray of float64, shape (wanted, capacity)
        Filled with the numbers.
    row : int
        First free place in `result`.

    Returns
    -------
    row, at, reason : int
        Next free place, where in `text` the parser stopped, and `COMPLETE`, `FAULT` or `FULL`. After a fault `at` is
        the beginning of the line.
    """
    bits = result.view(np.uint64)
    return _parse(text, start, kinds, delimited, comment, places, bits, row, _EXACT, _powers_of_five())


def first_cells(text: np.ndarray, kinds: np.ndarray, comment: int) -> tuple[np.ndarray, np.ndarray]:
    """The first cell of each line, the rest passed over.

    Parameters
    ----------
    text, kinds, comment
        As for :func:`parse_rows`.

    Returns
    -------
    cells : ndarray of uint8
        One cell a line; a dash where it is empty.
    starts : ndarray of int64
        Where each of these lines begins in `text`; blank lines and comments are left out.
    """
    starts = np.flatnonzero(text == _NEWLINE)
    starts[1:] = starts[:-1] + 1
    starts[:1] = 0
    cells = np.empty(len(text) + len(starts), dtype=np.uint8)
    size, count = _first_cells(text, kinds, comment, cells, starts)
    return cells[:size].copy(), starts[:count].copy()


@njit(cache=True, nogil=True, error_model="numpy")
def _first_cells(
    text: np.ndarray, kinds: np.ndarray, comment: int, cells: np.ndarray, starts: np.ndarray
) -> tuple[int, int]:
    size, count = 0, 0
    for start in starts:
        at = start
        while kinds[text[at]] == BLANK:
            at += 1
        if kinds[text[at]] != LINE_END and text[at] != comment:
            starts[count] = start
            count += 1
            if kinds[text[at]] != ORDINARY:
                cells[size] = _MINUS
                size += 1
            while kinds[text[at]] == ORDINARY:
                cells[size] = text[at]
                size += 1
                at += 1
            cells[size] = _NEWLINE
            size += 1
    return size, count


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _product(a: np.uint64, b: np.uint64) -> tuple[np.uint64, np.uint64]:
    """High and low word of the product of two 64-bit words."""
    a_high, a_low = a >> _U32, a & _LOW_HALF
    b_high, b_low = b >> _U32, b & _LOW_HALF
    low = a_low * b_low
    first = a_high * b_low + (low >> _U32)
    second = a_low * b_high + (first & _LOW_HALF)
    return a_high * b_high + (first >> _U32) + (second >> _U32), (second << _U32) | (low & _LOW_HALF)


@njit(cache=True, nogil=True, error_model="numpy")
def _round_once(mantissa: np.uint64, power: int, fives: np.ndarray) -> np.uint64:
    """Bits of the double nearest to ``mantissa * 10**power``, a normal number; mantissa is not 0."""
    shift = 0
    w = mantissa
    for step in (32, 16, 8, 4, 2, 1):
        if w >> np.uint64(64 - step) == _U0:
            w <<= np.uint64(step)
            shift += step
    index = power + _LARGEST_POWER
    high, low = _product(w, fives[index, 0])
    if high & _PRECISION_MASK == _PRECISION_MASK:
        more, _ = _product(w, fives[index, 1])
        low += more
        if low < more:
            high += _U1
    upper = high >> _U63
    fraction = high >> (upper + np.uint64(9))
    exponent = (((152170 + 65536) * power) >> 16) + 63 + np.int64(upper) - shift + 1023
    # Exactly half-way between two doubles: to the even one.
    if low <= _U1 and -4 <= power <= 23 and fraction & _U3 == _U1 and fraction << (upper + np.uint64(9)) == high:
        fraction &= ~_U1
    fraction += fraction & _U1
    fraction >>= _U1
    if fraction >= _HIDDEN_BIT << _U1:
        fraction = _HIDDEN_BIT
        exponent += 1
    return (fraction & ~_HIDDEN_BIT) | (np.uint64(exponent) << np.uint64(52))


@njit(cache=True, nogil=True, error_model="numpy")
def _word(text: np.ndarray, at: int, stop: int) -> int:
    """1 for a missing value (``N/A``, ``na``, ``null``, ``-``), 2 for ``nan`` or ``inf``, 0 for anything else."""
    first = at
    if text[at] == _MINUS or text[at] == _PLUS:
        first = at + 1
    size = stop - first
    if size == 0:
        return 1 if text[at] == _MINUS else 0
    a = text[first] | 32
    if size == 3 and first == at and a == 110 and text[at + 1] == 47 and text[at + 2] | 32 == 97:
        return 1
    if size == 2 and a == 110 and text[first + 1] | 32 == 97:
        return 1
    if size == 4 and a == 110 and text[first + 1] | 32 == 117:
        return 1
    if size >= 3 and a == 110 and text[first + 1] | 32 == 97 and text[first + 2] | 32 == 110:
        return 2
    if size >= 3 and a == 105 and text[first + 1] | 32 == 110 and text[first + 2] | 32 == 102:
        return 2
    # The C runtime of Windows: 1.#QNAN, 1.#IND, 1.#INF.
    if size >= 3 and text[first] == 49 and text[first + 1] == _POINT and text[first + 2] == 35:
        return 2
    return 0


@njit(cache=True, nogil=True, error_model="numpy")
def _parse(
    text: np.ndarray,
    at: int,
    kinds: np.ndarray,
    delimited: bool,
    comment: int,
    places: np.ndarray,
    bits: np.ndarray,
    row: int,
    exact: np.ndarray,
    fives: np.ndarray,
) -> tuple[int, int, int]:
    stop, columns, capacity = len(text), len(places), bits.shape[1]
    scratch = np.empty(1, dtype=np.float64)
    scratch_bits = scratch.view(np.uint64)
    while at < stop:
        while kinds[text[at]] == BLANK:
            at += 1
        if kinds[text[at]] == LINE_END:
            at += 1
            continue
        line = at
        if text[at] == comment:
            while kinds[text[at]] != LINE_END:
                at += 1
            at += 1
            continue
        if row == capacity:
            return row, line, FULL
        for column in range(columns):
            while kinds[text[at]] == BLANK:
                at += 1
            kind = kinds[text[at]]
            place = places[column]
            if kind != ORDINARY:
                if not delimited:
                    return row, line, FAULT
                if place >= 0:
                    bits[place, row] = _NAN_BITS
            elif place < 0:
                while kinds[text[at]] == ORDINARY:
                    at += 1
            else:
                first = at
                char = text[at]
                negative = char == _MINUS
                if negative or char == _PLUS:
                    at += 1
                    char = text[at]
                mantissa = _U0
                whole = at
                while char == _ZERO:
                    at += 1
                    char = text[at]
                zeros = at - whole
                begin = at
                while _ZERO <= char <= _NINE:
                    mantissa = mantissa * _U10 + np.uint64(char - _ZERO)
                    at += 1
                    char = text[at]
                digits = at - begin
                power = 0
                if char == _POINT:
                    at += 1
                    char = text[at]
                    begin = at
                    if digits == 0:
                        while char == _ZERO:
                            at += 1
                            char = text[at]
                        zeros += at - begin
                    leading = at
                    while _ZERO <= char <= _NINE:
                        mantissa = mantissa * _U10 + np.uint64(char - _ZERO)
                        at += 1
                        char = text[at]
                    digits += at - leading
                    power = begin - at
                fault = digits > _DIGITS or digits + zeros == 0
                if not fault and char in (_E, _SMALL_E):
                    at += 1
                    char = text[at]
                    down = char == _MINUS
                    if down or char == _PLUS:
                        at += 1
                        char = text[at]
                    exponent, begin = 0, at
                    while _ZERO <= char <= _NINE and at - begin < 5:
                        exponent = exponent * 10 + (char - _ZERO)
                        at += 1
                        char = text[at]
                    fault = at == begin
                    power += -exponent if down else exponent
                fault = fault or kinds[char] == ORDINARY
                if not fault and mantissa != _U0 and (power > _LARGEST_POWER or power < -_LARGEST_POWER):
                    fault = True
                if fault:
                    at = first
                    while kinds[text[at]] == ORDINARY:
                        at += 1
                    word = _word(text, first, at)
                    if word == 0:
                        return row, line, FAULT
                    found = _NAN_BITS if word == 1 else _INFINITY_BITS
                elif mantissa == _U0:
                    found = _U0
                elif mantissa < _EXACT_MANTISSA and -22 <= power <= 22:
                    value = np.float64(mantissa)
                    scratch[0] = value / exact[-power] if power < 0 else value * exact[power]
                    found = scratch_bits[0]
                else:
                    found = _round_once(mantissa, power, fives)
                bits[place, row] = found | _SIGN_BIT if negative else found
            if column < columns - 1 and delimited:
                while kinds[text[at]] == BLANK:
                    at += 1
                if kinds[text[at]] != DELIMITER:
                    return row, line, FAULT
                at += 1
        while kinds[text[at]] == BLANK or kinds[text[at]] == DELIMITER:
            at += 1
        if kinds[text[at]] != LINE_END:
            return row, line, FAULT
        at += 1
        row += 1
    return row, at, COMPLETE
