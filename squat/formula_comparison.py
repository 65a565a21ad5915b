"""Measured squat beside what every formula says at its speeds, with the score of each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.findings import Finding
from ..core.ship import Ship
from ..verify.scores import quality_and_bias
from .fairway import Fairway
from .prediction import FORMULAS, SquatPrediction, predict
from .squat_curve import SquatCurve
from .squat_formula import SquatFormula

if TYPE_CHECKING:
    import pandas as pd

COMPARED = {"bow": "sinkage_bow", "stern": "sinkage_stern", "middle": "sinkage_midship"}
"""Place of a formula and the measured quantity that it is held against; ``maximum`` against the larger end."""


@dataclass(frozen=True, eq=False)
class FormulaComparison:
    """Formulas against one measured curve.

    Attributes
    ----------
    prediction : SquatPrediction
        At the measured speeds.
    measured : DataFrame
        Column ``speed`` and, in m positive down, ``bow``, ``stern``, ``middle``, ``maximum`` as measured.
    scores : DataFrame
        One row for each formula and place: formula, place, n, Q, BS, bias, rms, max_abs (m, formula less
        measurement), applicable (speeds at which the formula is inside its limits) and flag. Smallest rms of the
        largest squat first.
    findings : tuple of Finding
    """

    prediction: SquatPrediction
    measured: pd.DataFrame
    scores: pd.DataFrame
    findings: tuple[Finding, ...] = ()


def beside_formulas(
    curve: SquatCurve,
    ship: Ship,
    *,
    channel: Fairway | None = None,
    formulas: Iterable[SquatFormula] = tuple(FORMULAS.values()),
    **hull: Any,
) -> FormulaComparison:
    """Hold every formula against a measured curve.

    Parameters
    ----------
    curve : SquatCurve
        With bow and stern.
    ship : Ship
        At the scale of the curve, with its volume.
    channel : Fairway, optional
        Canal or tank of the curve's depth; open water when not given.
    formulas : iterable of SquatFormula
    **hull
        What :func:`.prediction.predict` takes beside the ship.

    Raises
    ------
    TowtankError
        For a ship without volume, or a speed at or above the critical one.
    """
    import pandas as pd

    points = curve.points[curve.points["speed"] > 0.0]
    speed = points["speed"].to_numpy(dtype=float)
    prediction = predict(ship, curve.depth, speed, channel=channel, formulas=formulas, **hull)
    measured = pd.DataFrame({"speed": speed})
    for place, quantity in COMPARED.items():
        if quantity in points:
            measured[place] = points[quantity].to_numpy(dtype=float)
    measured["maximum"] = points[["sinkage_bow", "sinkage_stern"]].max(axis=1).to_numpy(dtype=float)
    rows: list[dict[str, Any]] = []
    for formula, of in prediction.table.groupby("formula", sort=False):
        for place in ("maximum", *COMPARED):
            computed = of[place].to_numpy(dtype=float)
            if place not in measured or not np.isfinite(computed).any():
                continue
            data = measured[place].to_numpy(dtype=float)
            score = quality_and_bias(computed, data)
            rows.append(
                {
                    "formula": formula,
                    "place": place,
                    "n": score.n,
                    "Q": score.quality,
                    "BS": score.bias,
                    "bias": score.mean_error,
                    "rms": score.rms,
                    "max_abs": float(np.nanmax(np.abs(computed - data))),
                    "applicable": int(of["applicable"].sum()),
                    "flag": _shortest(of["flag"]),
                }
            )
    scores = pd.DataFrame(rows)
    order = scores[scores["place"] == "maximum"].sort_values("rms")["formula"].tolist()
    scores = scores.sort_values(
        "formula", key=lambda names: names.map({name: rank for rank, name in enumerate(order)}), kind="stable"
    ).reset_index(drop=True)
    return FormulaComparison(prediction, measured, scores, tuple(_about(prediction)))


def _shortest(flags: pd.Series[str]) -> str:
    """What is wrong at most speeds, in words."""
    said = [flag for flag in flags if flag]
    return max(set(said), key=said.count) if said else ""


def _about(prediction: SquatPrediction) -> list[Finding]:
    inside = prediction.table.groupby("formula", sort=False)["applicable"].any()
    outside = [str(name) for name in inside.index[~inside]]
    if not outside:
        return []
    return [
        Finding(
            "formula-limits",
            "info",
            f"outside their limits at every speed: {', '.join(outside)}",
            cure="they are shown greyed; the flag of each says why",
        )
    ]
