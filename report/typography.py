"""Numbers and derivative names as they are printed in a page: digits that mean something, aligned at the point."""

from __future__ import annotations

import math
from collections.abc import Sequence

from markupsafe import Markup, escape

from ..core.terms import Term

FIGURE_SPACE, POINT_SPACE = "\u2007", "\u2008"
MINUS = "\u2212"

_SYMBOLS = {
    "v": "v",
    "beta": "β",
    "r": "r",
    "p": "p",
    "phi": "φ",
    "eta": "η",
    "u": "u",
    "surge": "u",
    "delta": "δ",
    "c": "c",
    "thrust": "T",
    "depth": "z",
    "udot": "u̇",
    "vdot": "v̇",
    "rdot": "ṙ",
    "pdot": "ṗ",
}


_PRINTED = {"0.5 rho": "½ ρ", "rho": "ρ", "^2": "²", "^3": "³", "sqrt(g L)": "√(g L)", "beta": "β", "'": "′"}


def printed_formula(text: str) -> str:
    """A formula of plain letters as it is printed: Greek letters, powers, roots, primes."""
    for plain, printed in _PRINTED.items():
        text = text.replace(plain, printed)
    return text


def symbol(variable: str) -> str:
    """Letter of a motion variable; its name when it has none."""
    return _SYMBOLS.get(variable, variable)


def derivative_name(term: Term) -> Markup:
    """A term as HTML, e.g. ``Y<sub>vvr</sub>``; Greek letters and dots as in print."""
    if term.name == "R0":
        return Markup('<i class="term">R</i><sub>0</sub>')
    symbols = "".join(
        _SYMBOLS[factor.variable] * factor.power + f"|{_SYMBOLS[factor.variable]}|" * factor.modulus
        for factor in term.factors
    )
    return Markup('<i class="term">{}</i><sub>{}</sub>').format(escape(term.component), escape(symbols or "0"))


def fixed(value: float, places: int) -> str:
    """A number with a fixed number of decimals and a typographic minus; a dash when there is none."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else f"{MINUS}∞"
    text = f"{value:.{places}f}"
    if float(text) == 0.0:
        text = text.lstrip("-")
    return text.replace("-", MINUS)


def significant(value: float, digits: int = 3) -> str:
    """A number with some significant digits; very large and very small ones as a power of ten."""
    if not math.isfinite(value) or value == 0.0:
        return fixed(value, 0)
    size = math.floor(math.log10(abs(value)))
    if -4 <= size < 6:
        return fixed(value, max(digits - 1 - size, 0))
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPT)}".replace("-", MINUS)


_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def signed(value: float, places: int) -> str:
    """A number with a sign, plus included."""
    text = fixed(value, places)
    return text if not math.isfinite(value) or text.startswith(MINUS) or float(text) == 0.0 else f"+{text}"


def aligned(cells: Sequence[str]) -> list[str]:
    """Cells of a column, filled up with spaces of a digit's width so that their points stand in line.

    The column must be set flush right in a font with digits of equal width.
    """
    tails = [_tail(cell) for cell in cells]
    widest = max((tail for tail in tails if tail is not None), default=0)
    if widest == 0:
        return list(cells)
    filled = []
    for cell, tail in zip(cells, tails, strict=True):
        if tail is None:
            filled.append(cell)
        elif tail == 0:
            filled.append(cell + POINT_SPACE + FIGURE_SPACE * widest)
        else:
            filled.append(cell + FIGURE_SPACE * (widest - tail))
    return filled


def _tail(cell: str) -> int | None:
    """Digits behind the point; None for what is no plain number."""
    body = cell.lstrip(MINUS + "+±")
    whole, point, decimals = body.partition(".")
    if not whole.isdigit() or (point and not decimals.isdigit()):
        return None
    return len(decimals)
