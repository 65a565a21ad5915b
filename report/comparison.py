"""Two derivative sets side by side: model tests against CFD, this fit against a published table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.derivative_table import digits_for, unit_line
from ..verify.matched_derivatives import match_derivatives
from ..verify.scores import quality_and_bias, score_table
from .set_table import read_set, with_ship

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["COLUMNS", "compare_sets", "comparison_text", "read_set"]

COLUMNS = (
    "name",
    "A",
    "A_std",
    "B",
    "B_std",
    "B-A",
    "(B-A)/A [%]",
    "(A-B)/A [%]",
    "|B-A|/|A| [%]",
    "z",
    "verdict",
)

AGREEMENT, DISAGREEMENT = 2.0, 3.0
"""Combined standard uncertainties up to which two values agree, and from which they differ."""


def compare_sets(a: DerivativeSet, b: DerivativeSet) -> pd.DataFrame:
    """Compare set `b` with set `a`, derivative by derivative.

    `b` is converted to the conventions of `a`; where that is not exact, `a` to those of `b`. Terms are matched by
    what they mean, not by how they are spelled (R0 is minus X0).

    Parameters
    ----------
    a : DerivativeSet
        The reference, e.g. from model tests (D).
    b : DerivativeSet
        The set that is judged, e.g. from CFD (S).

    Returns
    -------
    DataFrame
        Columns :data:`COLUMNS`: the common terms in the order of `a`, then the terms that only one has.
        Percentages are NaN where A is zero. ``z`` is (B - A) over the combined standard uncertainty; where one
        is unknown, over the other alone. ``attrs``: ``a``, ``b`` (names), ``conventions``, ``common``, ``only_a``,
        ``only_b``, ``Q``, ``BS``, ``n``, ``mean_z2`` (mean of z squared, 1 when the uncertainties explain the
        differences) and ``notes``.

    Raises
    ------
    ConventionError
        When neither set can be converted to the conventions of the other, or they have no term in common.
    """
    import pandas as pd

    notes: list[str] = []
    first, second = with_ship(a, b.ship), with_ship(b, a.ship)
    for which, given, known in (("A", a, first), ("B", b, second)):
        if known is not given:
            notes.append(f"{which} does not say its ship: taken as {known.ship.name}")
    matched = match_derivatives(first, second)
    if matched.turned_because:
        notes.append(
            f"A was converted to the conventions of B, because B cannot be converted: {matched.turned_because}"
        )
    first, second, names = matched.set_a, matched.set_b, list(matched.names)
    reference, judged = matched.a, matched.b
    reference_sd = np.sqrt(np.diag(matched.a_covariance))
    judged_sd = np.sqrt(np.diag(matched.b_covariance))
    table = score_table(
        dict(zip(names, judged, strict=True)),
        dict(zip(names, reference, strict=True)),
        sd_a=dict(zip(names, judged_sd, strict=True)),
        sd_b=dict(zip(names, reference_sd, strict=True)),
        near_zero=0.0,
    )
    frame = pd.DataFrame(
        {
            "name": table["name"],
            "A": table["b"],
            "A_std": table["sd_b"],
            "B": table["a"],
            "B_std": table["sd_a"],
            "B-A": table["difference"],
            "(B-A)/A [%]": table["s_minus_d"],
            "(A-B)/A [%]": table["d_minus_s"],
            "|B-A|/|A| [%]": table["absolute"],
            "z": table["z"],
            "verdict": [_verdict(z, note) for z, note in zip(table["z"], table["note"], strict=True)],
        }
    )
    only_a, only_b = list(matched.only_a), list(matched.only_b)
    frame = pd.concat([frame, _alone(first, only_a, "A"), _alone(second, only_b, "B")], ignore_index=True)[
        list(COLUMNS)
    ]
    score = quality_and_bias(judged, reference, near_zero=0.0)
    z = table["z"].to_numpy(float)
    known = np.isfinite(z)
    if first.ship.name != second.ship.name:
        notes.append(f"A is {first.ship.name}, B is {second.ship.name}")
    frame.attrs = {
        "a": a.name,
        "b": b.name,
        "conventions": unit_line(first),
        "common": names,
        "only_a": only_a,
        "only_b": only_b,
        "Q": score.quality,
        "BS": score.bias,
        "n": score.n,
        "mean_z2": float(np.mean(z[known] ** 2)) if known.any() else math.nan,
        "notes": [*notes, *score.notes],
    }
    return frame


def _alone(derivatives: DerivativeSet, names: list[str], which: str) -> pd.DataFrame:
    """Rows of the terms that only one set has."""
    import pandas as pd

    part = derivatives.subset(names).to_frame() if names else derivatives.to_frame().iloc[:0]
    frame = pd.DataFrame({column: pd.Series(np.nan, index=part.index) for column in COLUMNS})
    frame["name"] = part["name"]
    frame["verdict"] = f"only in {which}"
    frame[which], frame[f"{which}_std"] = part["value"], part["std"]
    return frame


def _verdict(z: float, note: str) -> str:
    size = abs(z)
    if not math.isfinite(size):
        verdict = "no uncertainty given"
    elif size <= AGREEMENT:
        verdict = "agree"
    elif size <= DISAGREEMENT:
        verdict = "doubtful"
    else:
        verdict = "differ"
    if "near zero" in note:
        verdict += ", A is zero"
    if "unknown uncertainty" in note:
        verdict += f", uncertainty of {'B' if note.endswith('of a') else 'A'} unknown"
    return verdict


def comparison_text(comparison: pd.DataFrame) -> str:
    """The comparison as an aligned text table with its totals.

    Parameters
    ----------
    comparison : DataFrame
        From :func:`compare_sets`.
    """
    facts = comparison.attrs
    rows = [
        ["name", "A", "std A", "B", "std B", "B-A", "(B-A)/A %", "(A-B)/A %", "|B-A|/|A| %", "z", "verdict"],
        *(comparison_cells(row) for row in comparison.itertuples(index=False)),
    ]
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    lines = []
    for cells in rows:
        middle = [cell.rjust(width) for cell, width in zip(cells[1:-1], widths[1:-1], strict=True)]
        lines.append("  ".join([cells[0].ljust(widths[0]), *middle, cells[-1]]).rstrip())
    rule = "-" * max(len(line) for line in lines)
    head = [f"A: {facts['a']}", f"B: {facts['b']}", facts["conventions"]]
    return "\n".join([*head, rule, lines[0], rule, *lines[1:], rule, *comparison_totals(comparison)])


def comparison_totals(comparison: pd.DataFrame) -> list[str]:
    """Sentences with Q, BS, z and what cannot be compared."""
    facts = comparison.attrs
    side = "as often B > A as B < A" if not facts["BS"] else "mostly B > A" if facts["BS"] < 0 else "mostly B < A"
    lines = [
        f"Q = {facts['Q']:.3f} (root mean square of (A-B)/A)   "
        f"BS = {facts['BS']:+d}/{facts['n']} (sum of the signs of A-B: {side})"
    ]
    if math.isfinite(facts["mean_z2"]):
        lines.append(
            f"mean of z squared = {facts['mean_z2']:.2f} (1 when the uncertainties explain the differences)"
        )
    for which, key in (("A", "only_a"), ("B", "only_b")):
        if facts[key]:
            lines.append(f"only in {which}: {', '.join(facts[key])}")
    return [*lines, *facts["notes"]]


def comparison_cells(row: Any) -> list[str]:
    """Text of one row of the comparison, with the digits that the uncertainty supports."""
    name, a, a_std, b, b_std, error, first, second, third, z, verdict = row
    cells, places = [], 0
    for value, std in ((a, a_std), (b, b_std)):
        places = digits_for(value, std) if math.isfinite(value) else 0
        cells += [f"{number:.{places}f}" if math.isfinite(number) else "" for number in (value, std)]
    return [
        str(name),
        *cells,
        f"{error:+.{places}f}" if math.isfinite(error) else "",
        _signed(first),
        _signed(second),
        f"{third:.1f}" if math.isfinite(third) else "",
        _signed(z),
        str(verdict),
    ]


def _signed(value: float) -> str:
    """One decimal with its sign; nothing for what is no number."""
    if not math.isfinite(value):
        return ""
    text = f"{value:+.1f}"
    return text if float(text) else "0.0"
