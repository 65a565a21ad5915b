"""Scores of computed curves against a measured one, quantity by quantity, and of many codes against one experiment.

Each computation is brought to the points of the measurement by straight lines and never beyond its own ends, as
Bechthold and Kastens (5th MASHCON 2019) do for squat over speed; a measured point that it does not reach is
not counted, and the table says how many are.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import TowtankError
from .scores import at_measured_points, normalised_rms, quality_and_bias, relative_errors

if TYPE_CHECKING:
    import pandas as pd

SCORE_COLUMNS = (
    "case",
    "quantity",
    "n",
    "Q",
    "BS",
    "bias",
    "rms",
    "normalised_rms",
    "mean_absolute_percent",
    "max_abs",
    "ties",
    "unit",
    "note",
)


def score_curves(
    measured: pd.DataFrame,
    computed: pd.DataFrame,
    by: str = "speed",
    *,
    case: str = "",
    units: Mapping[str, str] | None = None,
    near_zero: Mapping[str, float] | None = None,
) -> pd.DataFrame:
    """Score every quantity that two tables share.

    Parameters
    ----------
    measured, computed : DataFrame
        A column `by` and one column a quantity.
    by : str
        The column to interpolate over, usually the speed.
    case : str
        Name of the case, for the table.
    units : mapping of str to str, optional
        Unit of each quantity, for the table.
    near_zero : mapping of str to float, optional
        Size of each quantity up to which a measurement counts as zero and has no relative score.

    Returns
    -------
    DataFrame
        One row a quantity, columns :data:`SCORE_COLUMNS`: n measured points inside the computed range, Q and BS
        over them, bias (mean of S - D), rms and largest absolute S - D in the unit of the quantity, the rms over
        that of the measurement, and the mean of |S - D|/|D| in per cent.

    Raises
    ------
    TowtankError
        When `by` is missing, the tables share no quantity, or the computation reaches no measured point.
    """
    import pandas as pd

    for name, table in (("measurement", measured), ("computation", computed)):
        if by not in table:
            raise TowtankError(
                f"the {name} has no column '{by}'",
                cure=f"name one of {', '.join(map(str, table.columns))}",
                place=case,
            )
    shared = [str(name) for name in measured.columns if name != by and name in computed.columns]
    if not shared:
        raise TowtankError(
            "measurement and computation share no quantity", cure="name the columns alike", place=case
        )
    points = measured[by].to_numpy(dtype=float)
    rows = []
    for name in shared:
        data = measured[name].to_numpy(dtype=float)
        given = computed[[by, name]].dropna()
        there = at_measured_points(points, given[by].to_numpy(float), given[name].to_numpy(float))
        reached = np.isfinite(there) & np.isfinite(data)
        if not reached.any():
            raise TowtankError(
                f"the computation reaches no measured {by} of {name}",
                cure="compute inside the range of the measurement; nothing is extrapolated",
                place=case,
            )
        row = _row(there[reached], data[reached], (near_zero or {}).get(name))
        outside = int(np.count_nonzero(~reached & np.isfinite(data)))
        notes = [f"{outside} measured point(s) outside the computation"] if outside else []
        if row["note"]:
            notes.append(row["note"])
        unit = (units or {}).get(name, "")
        rows.append({**row, "case": case, "quantity": name, "unit": unit, "note": "; ".join(notes)})
    return pd.DataFrame(rows, columns=list(SCORE_COLUMNS))


def score_codes(measured: Mapping[str, float], codes: Mapping[str, Mapping[str, float]]) -> pd.DataFrame:
    """Rank many codes against one experiment.

    Parameters
    ----------
    measured : mapping of str to float
        Measured values by the name of the point (case and quantity).
    codes : mapping of str to mapping of str to float
        The values of each code by the same names; a code may leave points out.

    Returns
    -------
    DataFrame
        One row a code, smallest rms first: rank, code, and the columns of :data:`SCORE_COLUMNS` from n to ties,
        and note. Codes that compute fewer points than another are ranked with it and say so in their note.

    Raises
    ------
    TowtankError
        When a code has no point of the experiment.
    """
    import pandas as pd

    most, rows = 0, []
    for code, values in codes.items():
        names = [
            name for name in measured if np.isfinite(values.get(name, np.nan)) and np.isfinite(measured[name])
        ]
        if not names:
            raise TowtankError(
                "has no point of the experiment", cure="name its points as the measured ones", place=code
            )
        most = max(most, len(names))
        simulation = np.array([values[name] for name in names], dtype=float)
        data = np.array([measured[name] for name in names], dtype=float)
        rows.append({"code": code, **_row(simulation, data, None)})
    for row in rows:
        if row["n"] < most:
            row["note"] = "; ".join(filter(None, (row["note"], f"{row['n']} of {most} points")))
    ranked = sorted(rows, key=lambda row: float(row["rms"]))
    columns = ["rank", "code", *(name for name in SCORE_COLUMNS if name not in ("case", "quantity", "unit"))]
    return pd.DataFrame([{"rank": place + 1, **row} for place, row in enumerate(ranked)], columns=columns)


def pooled_scores(scores: pd.DataFrame) -> pd.DataFrame:
    """Totals over the cases of a table of scores.

    Parameters
    ----------
    scores : DataFrame
        Rows of :func:`score_curves`, or any table with case, quantity, n, Q and BS.

    Returns
    -------
    DataFrame
        One row a quantity: n, Q = sqrt(sum n Q^2 / sum n), which is the Q of all points together, and the sum of BS.
    """
    import pandas as pd

    rows = []
    for quantity, of in scores.groupby("quantity", sort=False):
        n = of["n"].to_numpy(dtype=float)
        quality = of["Q"].to_numpy(dtype=float)
        scored = np.isfinite(quality) & (n > 0)
        total = float(n[scored].sum())
        q = float(np.sqrt(np.sum(n[scored] * quality[scored] ** 2) / total)) if total else float("nan")
        rows.append((quantity, int(total), q, int(of["BS"].sum())))
    return pd.DataFrame(rows, columns=["quantity", "n", "Q", "BS"])


def _row(s: np.ndarray, d: np.ndarray, near_zero: float | None) -> dict[str, Any]:
    score = quality_and_bias(s, d, near_zero=near_zero)
    errors = relative_errors(s, d, near_zero=near_zero).absolute
    known = errors[np.isfinite(errors)]
    return {
        "n": score.n,
        "Q": score.quality,
        "BS": score.bias,
        "bias": score.mean_error,
        "rms": score.rms,
        "normalised_rms": normalised_rms(s, d, by="rms"),
        "mean_absolute_percent": float(known.mean()) if known.size else float("nan"),
        "max_abs": float(np.max(np.abs(s - d))),
        "ties": score.ties,
        "note": "; ".join(score.notes),
    }
