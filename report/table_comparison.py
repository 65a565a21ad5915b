"""Tables of results against a reference: values, manoeuvring indices, curves; and several sets or tables ranked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import TowtankError
from ..verify.curve_scores import pooled_scores, score_codes, score_curves
from ..verify.matched_derivatives import match_derivatives
from ..verify.scores import quality_and_bias, score_table
from .aligned_text import aligned_text

if TYPE_CHECKING:
    import pandas as pd

RANKED = ["rank", "code", "n", "Q", "mean_absolute_percent", "note"]
"""Columns of a ranking that are shown; the values are relative to the reference, so that rms is Q."""


def compare_values(reference: pd.DataFrame, judged: pd.DataFrame, coverage: float = 2.0) -> pd.DataFrame:
    """Compare two tables of values, quantity by quantity.

    Parameters
    ----------
    reference, judged : DataFrame
        Columns quantity, value, uncertainty (expanded) and unit, as :func:`~towtank.report.value_table.read_values`
        gives them.
    coverage : float
        Coverage factor of the uncertainties.

    Returns
    -------
    DataFrame
        Columns of :func:`towtank.verify.score_table`; ``a`` is the judged table, ``b`` the reference. ``attrs``: Q,
        BS, n.

    Raises
    ------
    TowtankError
        When the tables share no quantity, or differ in a unit.
    """
    columns = {}
    for key, table in (("reference", reference), ("judged", judged)):
        values = dict(zip(table["quantity"], table["value"], strict=True))
        spread = dict(zip(table["quantity"], table["uncertainty"] / coverage, strict=True))
        units = dict(zip(table["quantity"], table["unit"], strict=True))
        columns[key] = values, spread, units
    (values_b, spread_b, units_b), (values_a, spread_a, units_a) = columns["reference"], columns["judged"]
    shared = [name for name in values_b if name in values_a]
    if not shared:
        raise TowtankError(
            f"the tables share no quantity: {', '.join(list(values_b)[:4])} against {', '.join(list(values_a)[:4])}",
            cure="name the quantities alike",
        )
    for name in shared:
        if units_a[name] and units_b[name] and units_a[name] != units_b[name]:
            raise TowtankError(
                f"one table in '{units_b[name]}', the other in '{units_a[name]}'",
                cure="give both in one unit",
                place=f"quantity {name}",
            )
    frame = score_table(values_a, values_b, sd_a=spread_a, sd_b=spread_b)
    score = quality_and_bias(
        [values_a[name] for name in shared], [values_b[name] for name in shared], near_zero=0.0
    )
    frame.attrs = {"Q": score.quality, "BS": score.bias, "n": score.n}
    return frame


def values_text(comparison: pd.DataFrame, reference: str, judged: str) -> str:
    """A comparison of values as lines for a terminal; A is the reference, B the judged table."""
    shown = comparison.rename(
        columns={
            "b": "A",
            "sd_b": "std A",
            "a": "B",
            "sd_a": "std B",
            "difference": "B-A",
            "s_minus_d": "(B-A)/A %",
            "d_minus_s": "(A-B)/A %",
            "absolute": "|B-A|/|A| %",
        }
    )
    shown["note"] = [_in_capitals(note) for note in comparison["note"]]
    columns = ["name", "A", "std A", "B", "std B", "B-A", "(B-A)/A %", "(A-B)/A %", "|B-A|/|A| %", "z", "note"]
    facts = comparison.attrs
    totals = f"Q = {facts['Q']:.3f} (root mean square of (A-B)/A)   BS = {facts['BS']:+d}/{facts['n']}"
    return "\n".join([f"A: {reference}", f"B: {judged}", "", aligned_text(shown, columns), "", totals])


def _in_capitals(note: str) -> str:
    """A note of the scores, which call the judged table a, in the letters of the command line."""
    return (
        note.replace("only in a", "only in B")
        .replace("only in b", "only in A")
        .replace("b is near zero", "A is zero")
        .replace("uncertainty of a", "uncertainty of B")
        .replace("uncertainty of b", "uncertainty of A")
    )


def rank_values(reference: Mapping[str, float], judged: Mapping[str, Mapping[str, float]]) -> pd.DataFrame:
    """Rank several tables or sets by Q, the root mean square of their relative errors.

    Parameters
    ----------
    reference : mapping of str to float
    judged : mapping of str to mapping of str to float
        Values of each by the same names.

    Returns
    -------
    DataFrame
        Rows of :func:`towtank.verify.score_codes`, smallest Q first; quantities whose reference is zero do not count.

    Raises
    ------
    TowtankError
        When one shares no quantity with the reference.
    """
    known = {name: value for name, value in reference.items() if value and np.isfinite(value)}
    relative = {
        code: {name: value / known[name] for name, value in values.items() if name in known}
        for code, values in judged.items()
    }
    return score_codes(dict.fromkeys(known, 1.0), relative)


def rank_sets(reference: DerivativeSet, judged: Sequence[DerivativeSet]) -> pd.DataFrame:
    """Rank several derivative sets against a reference, each converted to its conventions.

    Parameters
    ----------
    reference : DerivativeSet
    judged : sequence of DerivativeSet

    Returns
    -------
    DataFrame
        As :func:`rank_values`.

    Raises
    ------
    ConventionError
        When a set cannot be converted to the conventions of the reference, or shares no derivative with it.
    """
    codes: dict[str, dict[str, float]] = {}
    for place, own in enumerate(judged, start=1):
        matched = match_derivatives(reference, own)
        name = own.name if own.name not in codes else f"{own.name} ({place})"
        # ratios are free of conventions, should the reference have had to be converted
        codes[name] = {
            term: value * (reference[term] / base) if base else 0.0
            for term, value, base in zip(matched.names, matched.b, matched.a, strict=True)
        }
    return rank_values(dict(zip(reference.names, reference.values.tolist(), strict=True)), codes)


def ranking_text(ranking: pd.DataFrame) -> str:
    """A ranking as lines for a terminal."""
    return aligned_text(ranking, RANKED)


def compare_curves(
    reference: pd.DataFrame, judged: Mapping[str, pd.DataFrame], by: str
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Score computed curves against measured ones.

    Parameters
    ----------
    reference : DataFrame
        A column `by` and one column a quantity.
    judged : mapping of str to DataFrame
        Tables with the same columns, by name.
    by : str
        The column to compare over.

    Returns
    -------
    scores : DataFrame
        Rows of :func:`towtank.verify.score_curves`, one a table and quantity.
    pooled : DataFrame
        Totals of each quantity over all tables.

    Raises
    ------
    TowtankError
        As :func:`towtank.verify.score_curves`.
    """
    import pandas as pd

    scores = pd.concat(
        [score_curves(reference, own, by, case=name) for name, own in judged.items()], ignore_index=True
    )
    return scores, pooled_scores(scores)
