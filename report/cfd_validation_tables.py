"""Tables of a validation for a page and for a terminal."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..verify.scores import quality_and_bias
from ..verify.validation import ERROR_FORMS
from .aligned_text import aligned_text
from .page_table import Column, Table, make_table
from .typography import fixed, signed, significant

if TYPE_CHECKING:
    import pandas as pd

_SHADED = {"not validated": "weak"}


def validation_table(validation: pd.DataFrame) -> Table:
    """S, D, the comparison error, the parts of U_V and the verdict; one row a quantity."""
    columns = [
        Column("quantity"),
        Column("S", "number"),
        Column("D", "number"),
        Column("unit", "short"),
        Column("S−D", "number"),
        Column("U_SN", "number", "numerical uncertainty of the simulation"),
        Column("U_input", "number", "from the inputs of the simulation"),
        Column("U_D", "number", "uncertainty of the data"),
        Column("U_V", "number", "validation uncertainty"),
        Column("verdict", "short"),
        Column("level, % of D", "number", "U_V when validated, |E| when not"),
    ]
    rows, marks = [], []
    for row in validation.to_dict("records"):
        places = _places(row)
        share = 100.0 * row["level"] / abs(row["D"]) if row["D"] else math.nan
        rows.append(
            [
                str(row["quantity"]),
                fixed(row["S"], places),
                fixed(row["D"], places),
                str(row["unit"]),
                signed(row["S-D"], places),
                *(significant(row[name], 2) for name in ("U_SN", "U_input", "U_D", "U_V")),
                str(row["verdict"]),
                significant(share, 2),
            ]
        )
        marks.append(_SHADED.get(row["verdict"], ""))
    return make_table(columns, rows, marks=marks)


def error_table(validation: pd.DataFrame) -> Table:
    """The comparison error of each quantity in every sign convention, by name."""
    columns = [Column("quantity"), *(Column(name.replace("-", "−"), "number") for name in ERROR_FORMS)]
    columns += [Column("E/u_V", "number"), Column("model error from", "number"), Column("to", "number")]
    rows = []
    for row in validation.to_dict("records"):
        places = _places(row)
        rows.append(
            [
                str(row["quantity"]),
                *(signed(row[name], places) for name in ERROR_FORMS[:2]),
                *(signed(row[name], 2) for name in ERROR_FORMS[2:]),
                signed(row["z"], 1),
                signed(row["model_error_low"], places),
                signed(row["model_error_high"], places),
            ]
        )
    return make_table(columns, rows)


def validation_totals(validation: pd.DataFrame) -> list[str]:
    """Sentences over all quantities: how many are validated, Q, BS, chi squared, what is left out."""
    counts = validation["verdict"].value_counts()
    parts = [
        f"{int(counts[name])} {name}" for name in ("validated", "not validated", "not judged") if name in counts
    ]
    score = quality_and_bias(validation["S"].to_numpy(float), validation["D"].to_numpy(float), near_zero=0.0)
    lines = [f"{len(validation)} quantities: {', '.join(parts)}"]
    if score.n:
        lines.append(
            f"Q = {score.quality:.3f} (root mean square of (D-S)/D), BS = {score.bias_text} (sum of the signs of D-S)"
        )
    facts = validation.attrs
    chi2 = facts.get("chi2", math.nan)
    if math.isfinite(chi2):
        lines.append(
            f"all together, correlations counted: chi squared = {chi2:.1f} with {facts['degrees_of_freedom']} "
            f"degrees of freedom, probability {facts['p_value']:.3g} when the uncertainties explain every difference"
        )
    for which, key in (("the simulation", "only_simulation"), ("the data", "only_data")):
        if facts.get(key):
            lines.append(f"only in {which}: {', '.join(facts[key])}")
    zero = validation.loc[validation["D"] == 0.0, "quantity"]
    if len(zero):
        lines.append(f"without an error in per cent, and not in Q and BS, since D is zero: {', '.join(zero)}")
    return [*lines, *facts.get("notes", ())]


def validation_text(validation: pd.DataFrame) -> str:
    """The validation as lines for a terminal."""
    shown = validation.rename(columns={"model_error_low": "model error from", "model_error_high": "to"})
    columns = ["quantity", "S", "D", "unit", *ERROR_FORMS, "U_SN", "U_input", "U_D", "U_V", "verdict", "level"]
    columns = [name for name in columns if name != "unit" or shown["unit"].astype(bool).any()]
    head = f"E = S - D; S simulation, D data; U expanded with coverage factor {validation.attrs['coverage']:g}"
    parts = [aligned_text(shown, columns), *verdict_sentences(validation), "", *validation_totals(validation)]
    return "\n".join([head, "", *parts])


def verdict_sentences(validation: pd.DataFrame) -> list[str]:
    """The verdicts in words; quantities that nothing can be said of share a line."""
    sentences = validation.attrs["sentences"]
    judged = validation["verdict"] != "not judged"
    lines = [f"{name}: {sentences[name]}" for name in validation.loc[judged, "quantity"]]
    for reason, of in validation[~judged].groupby("note", sort=False):
        lines.append(f"not judged, {reason}: {', '.join(of['quantity'])}")
    return lines


def validation_records(validation: pd.DataFrame) -> dict[str, Any]:
    """The validation as plain data; None for what is unknown."""
    rows = [
        {
            name: None if isinstance(value, float) and not math.isfinite(value) else value
            for name, value in row.items()
        }
        for row in validation.to_dict("records")
    ]
    facts: dict[str, Any] = {
        str(key): None if isinstance(value, float) and not math.isfinite(value) else value
        for key, value in validation.attrs.items()
    }
    return {**facts, "totals": validation_totals(validation), "quantities": rows}


def _places(row: Mapping[Any, Any]) -> int:
    """Decimals that U_V, or else the error, makes worth printing."""
    smallest = row["U_V"] if math.isfinite(row["U_V"]) and row["U_V"] > 0.0 else abs(row["S-D"]) or abs(row["D"])
    return max(1 - math.floor(math.log10(smallest)), 0) if smallest > 0.0 else 3
