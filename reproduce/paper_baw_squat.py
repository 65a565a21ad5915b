"""Quality Q and bias BS of computed squat (BAW, MASHCON 2019), and what the propeller changes (same volume)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pandas as pd

from ..datasets import load_table
from ..verify import bias_is_possible, pooled_scores, quality_and_bias, relative_errors
from .case import Case, Paper, half_digit
from .printed_numbers import printed_by, printed_rows, ship_of
from .rounding import spread_of

KEY = "baw-squat"

_QUANTITIES = {"bow": "bow", "stern": "stern", "cog": "centre of gravity", "trim": "trim"}
_SECTION_COEFFICIENT = 0.98
_BANK_SLOPE = 3.0
"""Horizontal over vertical; with the section coefficient inferred from the printed ratios, not printed."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _definition()
    yield from _totals()
    yield from _parity()
    yield from _benchmark()
    yield from _trim_of_sinkages()
    yield from _ships()
    yield from _canals()
    yield from _propeller()


def _definition() -> Iterator[Case]:
    """The two numbers by hand: deviations of 10 % to both sides, and of 9 % to one side at eight speeds."""
    of_two = quality_and_bias([1.1, 1.8], [1.0, 2.0])
    data = [0.002 * step for step in range(1, 9)]
    of_eight = quality_and_bias([1.09 * value for value in data], data)
    for what, quality, bias, score in (
        ("10 % to both sides", 0.100, "0/2", of_two),
        ("9 % too large", 0.09, "-8/8", of_eight),
    ):
        yield Case(KEY, f"equations 2 and 3, {what}", "Q", quality, score.quality, 1e-12)
        yield Case(KEY, f"equations 2 and 3, {what}", "BS", bias, score.bias_text)


def _totals() -> Iterator[Case]:
    printed = {
        str(row["case"]): row for row in load_table("baw-squat-scores", corrected=False).frame.to_dict("records")
    }
    totals = printed.pop("sum")
    long = pd.DataFrame(
        [
            {
                "case": case,
                "quantity": name,
                "n": int(row["n"]),
                "Q": float(row[f"Q_{name}"]),
                "BS": int(row[f"BS_{name}"]),
            }
            for case, row in printed.items()
            for name in _QUANTITIES
        ]
    )
    pooled = pooled_scores(long).set_index("quantity")
    yield Case(KEY, "Table 4, sums", "points", float(totals["n"]), float(pooled["n"].to_dict()["bow"]))
    for name, said in _QUANTITIES.items():
        misprint = name == "cog"
        yield Case(
            KEY,
            "Table 4, sums",
            f"BS at {said}" if name != "trim" else "BS of trim",
            float(totals[f"BS_{name}"]),
            float(pooled["BS"].to_dict()[name]),
            expected=21.0 if misprint else None,
            note="9 is the sum of the cases A1 to B4; with C1, which the other sums hold, it is 21"
            if misprint
            else "",
        )


def _parity() -> Iterator[Case]:
    """A bias has the parity of its points unless two values are equal."""
    for row in printed_rows("baw-squat-scores"):
        if row["case"] == "sum":
            continue
        for name, said in _QUANTITIES.items():
            possible = bias_is_possible(int(row[f"BS_{name}"]), int(row["n"]))
            yield Case(
                KEY,
                "Table 4, parity of the bias",
                f"{row['case']}, {said}: {int(row[f'BS_{name}'])}/{int(row['n'])}",
                "possible",
                "possible" if possible else "needs a tie",
                note="" if possible else "five signs without a tie have an odd sum",
            )


def _benchmark() -> Iterator[Case]:
    printed = load_table("baw-dtc-squat", corrected=False).frame.to_dict("records")
    for row, mended in zip(printed, printed_rows("baw-dtc-squat"), strict=True):
        decimals = 4
        pair = ((float(mended["CFD"]), decimals), (float(mended["EFD"]), decimals))
        misprint = row["EFD"] != mended["EFD"]
        computed = quality_and_bias([pair[0][0]], [pair[1][0]]).quality
        spread = spread_of(lambda cfd, efd: abs(efd - cfd) / efd, *pair)
        as_printed = quality_and_bias([float(row["CFD"])], [float(row["EFD"])]).quality
        yield Case(
            KEY,
            f"Table 6, {row['case']}",
            f"Q of {row['quantity']}",
            float(row["Q"]),
            computed,
            spread + half_digit(3),
            expected=float(row["Q"]) if misprint else None,
            note=f"the printed 0.0045 m gives {as_printed:.3f}; Q, trim and centre of gravity all need 0.0050 m"
            if misprint
            else "",
        )


def _trim_of_sinkages() -> Iterator[Case]:
    """Trim in degrees from bow and stern over the length between perpendiculars."""
    length = ship_of("baw-dtc-squat").L
    rows = {(str(row["case"]), str(row["quantity"])): row for row in printed_rows("baw-dtc-squat")}
    for case in ("DTC-C2", "DTC-C3"):
        for side in ("EFD", "CFD"):
            bow = float(rows[case, "squat at the bow"][side])
            stern = float(rows[case, "squat at the stern"][side])
            spread = spread_of(lambda b, s: math.degrees(math.atan((b - s) / length)), (bow, 4), (stern, 4))
            yield Case(
                KEY,
                f"Table 6, {case}",
                f"trim of {side} from bow and stern, deg",
                float(rows[case, "trim"][side]),
                math.degrees(math.atan((bow - stern) / length)),
                spread + half_digit(4),
            )


def _ships() -> Iterator[Case]:
    for row in printed_rows("baw-squat-ships"):
        box = (float(row["L"]), 1), (float(row["B"]), 1), (float(row["T"]), 1)
        computed = float(row["volume"]) / math.prod(value for value, _ in box)
        yield Case(
            KEY, "Table 1", f"block coefficient of {row['ship']}", float(row["CB"]), computed, half_digit(2)
        )
        yield Case(
            KEY,
            "Table 1",
            f"h/T of {row['ship']}",
            float(row["h_over_T"]),
            float(row["depth"]) / float(row["T"]),
            half_digit(3),
        )


def _canals() -> Iterator[Case]:
    """Area of the canal over that of the midship section, of a trapezium with banks of 1:3."""
    ships = printed_by("baw-squat-ships", "ship")
    for row in printed_rows("baw-squat-cases"):
        if row["case"] == "C1":
            continue
        ship = ships[row["ship"]]
        scale = float(ship["scale"])
        depth = float(ship["depth"]) / scale
        section = _SECTION_COEFFICIENT * float(ship["B"]) * float(ship["T"]) / scale**2
        canal = 2.0 * float(row["b1"]) * depth + _BANK_SLOPE * depth**2
        yield Case(KEY, "Table 2", f"S of {row['case']}", float(row["S"]), canal / section, half_digit(0))


def _propeller() -> Iterator[Case]:
    """Change that the missing propeller makes, in per cent of the self-propelled model."""
    decimals = {"bow": (2, 1), "stern": (2, 1), "trim": (3, 3)}
    reference = {"bow": 10.7, "stern": -3.9, "trim": 54.0}
    for row in printed_rows("baw-propeller-squat"):
        name = str(row["quantity"])
        with_it, without = float(row["self_propelled"]), float(row["no_propeller"])
        change = float(relative_errors([without], [with_it]).s_minus_d[0])
        places = decimals[name]
        spread = spread_of(lambda a, b: 100.0 * (b - a) / a, (with_it, places[0]), (without, places[1]))
        yield Case(
            KEY,
            "propeller removed",
            f"change of {name}, %",
            reference[name],
            change,
            spread + half_digit(1),
        )


PAPER = Paper(
    KEY,
    "Bechthold and Kastens (2019), robustness and quality of squat predictions in shallow water, 5th MASHCON",
    cases,
)
