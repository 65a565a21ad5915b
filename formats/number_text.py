"""Numbers as text files print them."""

from __future__ import annotations

import re

_POINT = re.compile(r"[+\-\u2212]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?")
_COMMA = re.compile(r"[+\-\u2212]?(\d+(,\d+)?|,\d+)([eEdD][+-]?\d+)?")

#: Words for a missing or infinite value, in lower case; the C runtime of Windows prints those with ``#``.
WORDS = {
    "nan": "nan",
    "-nan": "nan",
    "na": "nan",
    "n/a": "nan",
    "#n/a": "nan",
    "null": "nan",
    "1.#qnan": "nan",
    "-1.#qnan": "nan",
    "1.#ind": "nan",
    "-1.#ind": "nan",
    "inf": "inf",
    "+inf": "inf",
    "-inf": "-inf",
    "infinity": "inf",
    "-infinity": "-inf",
    "1.#inf": "inf",
    "-1.#inf": "-inf",
}


def is_number(text: str, decimal: str = ".") -> bool:
    """Whether `text` is a number with this decimal sign, or a word for a missing or infinite one."""
    pattern = _COMMA if decimal == "," else _POINT
    return pattern.fullmatch(text) is not None or text.lower() in WORDS


def to_number(text: str, decimal: str = ".") -> float:
    """Value of `text`; NaN if it is blank.

    Accepts what a strict reader refuses: Fortran exponents (``1.5D+03``), a typographic minus sign and
    no-break spaces.

    Raises
    ------
    ValueError
        If `text` is not a number.
    """
    text = text.replace("\u2212", "-").strip().strip("\u00a0")
    if not text:
        return float("nan")
    if not is_number(text, decimal):
        raise ValueError(f"'{text}' is not a number")
    word = WORDS.get(text.lower(), text)
    return float(word.replace(",", ".").replace("D", "E").replace("d", "e") if word is text else word)
