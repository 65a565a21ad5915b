"""Pure car carrier near a bank (Hiroshima University, MASHCON 2019): check helm and course stability."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..core.errors import DatasetError
from ..datasets import load_extras, load_set
from ..simulate.autopilot import Autopilot
from ..simulate.bank import (
    ShipNearBank,
    bank_equilibrium,
    bank_stability,
    characteristic_coefficients,
    helm_limit,
)
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows

KEY = "pcc-bank-stability"

DEPTHS = {1.5: "hd1.5", 1.2: "hd1.2"}

PLACES = (0.09, 0.18, 0.27, 0.31, 0.36)
"""Deviations towards the bank that were tested, over L (Table 4)."""


def cases() -> Iterator[Case]:
    """All cases of the analysis."""
    yield from _stability_table()
    yield from _statements()
    yield from _polynomial()
    yield from _misprints()
    yield from _helm()


def ship_near_bank(depth_ratio: float) -> ShipNearBank:
    """The car carrier at one of :data:`DEPTHS`, from Tables 2, 5 and 6.

    Raises
    ------
    DatasetError
        For another depth.
    """
    if depth_ratio not in DEPTHS:
        raise DatasetError(
            f"no bank tests at h/d = {depth_ratio}", cure=f"depths are {', '.join(map(str, DEPTHS))}"
        )
    at = DEPTHS[depth_ratio]
    extras = load_extras(f"pcc-{at}")
    return ShipNearBank.from_sets(
        load_set(f"pcc-{at}"),
        load_set(f"pcc-bank-{at}"),
        Yd=extras["rudder"]["Yd"],
        Nd=extras["rudder"]["Nd"],
        yaw_inertia=extras["inertia"]["Iz_plus_Jz"],
    )


def _stability_table() -> Iterator[Case]:
    for row in printed_rows("pcc-course-stability"):
        gain = row["gain"]
        found = bank_stability(ship_near_bank(row["depth_ratio"]), row["eta"], Autopilot(gain, gain))
        yield Case(
            KEY,
            f"equations 20 to 27, h/d = {row['depth_ratio']:g}, G1 = G2 = {gain:g}, eta = {row['eta']:g} L",
            "100 D5 (recomputed reference)",
            row["D5_100"],
            100.0 * found.D5,
            half_digit(5),
        )


def _statements() -> Iterator[Case]:
    """What the text says of Figures 12 and 13."""
    for depth in DEPTHS:
        ship = ship_near_bank(depth)
        for gain, said in ((0, "unstable"), (4, "stable"), (6, "stable")):
            verdicts = [bank_stability(ship, eta, Autopilot(gain, gain)).stable for eta in PLACES]
            found = "stable" if all(verdicts) else "both" if any(verdicts) else "unstable"
            yield Case(
                KEY,
                f"Figures 12 and 13, h/d = {depth:g}, G1 = G2 = {gain}",
                "course stability at all five distances, text",
                said,
                found,
            )
        signs = np.array([characteristic_coefficients(ship, eta)[2:4] > 0 for eta in PLACES])
        for column, name, said in (
            (0, "D2", "positive"),
            (1, "D1", "partly negative" if depth == 1.5 else "positive"),
        ):
            positive = signs[:, column]
            found = "positive" if positive.all() else "partly negative" if positive.any() else "negative"
            yield Case(KEY, f"Figure 12, h/d = {depth:g}, no autopilot", f"sign of {name}, text", said, found)


# Recomputed references at eta = 0.27 L and, for h/d = 1.2, the largest real root and its frequency.
_COEFFICIENTS = {
    1.5: (0.010829, 0.06397, 0.06140, 0.00380, 0.05432),
    1.2: (0.015953, 0.14128, 0.25441, 0.17418, 0.92426),
}
_ROOTS = {0: (0.3899, 1.6288), 4: (-0.1168, 1.4300)}


def _polynomial() -> Iterator[Case]:
    for depth, references in _COEFFICIENTS.items():
        found = characteristic_coefficients(ship_near_bank(depth), 0.27)
        case = f"equations 20 to 25, h/d = {depth:g}, eta = 0.27 L"
        for power, reference, value in zip((4, 3, 2, 1, 0), references, found, strict=True):
            decimals = 6 if power == 4 else 5
            name = f"D{power} (recomputed reference)"
            yield Case(KEY, case, name, reference, float(value), half_digit(decimals))
    for gain, (real, imaginary) in _ROOTS.items():
        root = bank_stability(ship_near_bank(1.2), 0.27, Autopilot(gain, gain)).roots[0]
        case = f"roots, h/d = 1.2, eta = 0.27 L, G1 = G2 = {gain}"
        yield Case(KEY, case, "largest real part (recomputed reference)", real, float(root.real), half_digit(4))
        # the reference is printed to one unit more than its rounding
        frequency = abs(float(root.imag))
        yield Case(KEY, case, "its frequency (recomputed reference)", imaginary, frequency, 2 * half_digit(4))
    yield Case(
        KEY,
        "Figure 12, h/d = 1.5, no autopilot",
        "eta/L where D1 changes sign (recomputed reference)",
        0.181,
        _sign_change(ship_near_bank(1.5)),
        half_digit(3),
    )


def _sign_change(ship: ShipNearBank) -> float:
    from scipy.optimize import brentq

    return float(brentq(lambda eta: characteristic_coefficients(ship, eta)[3], PLACES[0], PLACES[-1]))


def _misprints() -> Iterator[Case]:
    """Equations that contradict the text as they are printed."""
    ship, autopilot = ship_near_bank(1.2), Autopilot(4.0, 4.0)
    printed = 100 * bank_stability(ship, 0.36, autopilot, form="printed").D5
    yield Case(
        KEY,
        "equation 23, h/d = 1.2, G1 = G2 = 4, eta = 0.36 L",
        "100 D5",
        round(printed, 3),
        100 * bank_stability(ship, 0.36, autopilot).D5,
        half_digit(5),
        expected=0.52400,
        note="D2 is printed with Yr - m - my; equations 17 and 18 give Yr - mx - m, and the text says D5 > 0",
    )
    ship = ship_near_bank(1.5)
    for eta, three_times, once in ((0.09, 4.02, 3.60), (0.27, 27.0, 15.8)):
        yield Case(
            KEY,
            f"equations 12 to 15, h/d = 1.5, eta = {eta:g} L",
            "check helm in deg",
            three_times,
            math.degrees(bank_equilibrium(ship, eta).helm),
            half_digit(2 if eta < 0.1 else 1),
            expected=once,
            note="equation 14 has three times the cubic bank term, the slope that belongs to the stability; "
            "the balance of equations 12 and 13 has it once",
        )


def _helm() -> Iterator[Case]:
    equilibrium = bank_equilibrium(ship_near_bank(1.5), 0.27)
    yield Case(
        KEY,
        "Figure 11, h/d = 1.5, eta = 0.27 L",
        "heading an order of magnitude smaller than the check helm, text",
        "yes",
        "yes" if abs(equilibrium.helm) > 10 * abs(equilibrium.heading) else "no",
    )
    ship = ship_near_bank(1.2)
    tenth = replace(ship, Netaetaeta=ship.Netaetaeta / 10)
    limit = math.radians(35.0)
    yield Case(
        KEY,
        "Figure 11, h/d = 1.2",
        "eta/L where the check helm reaches 35 deg, text",
        0.27,
        helm_limit(ship, limit),
        half_digit(2),
        note=f"Netaetaeta = {ship.Netaetaeta:g} is suspect: with a tenth of it the place is "
        f"{helm_limit(tenth, limit):.2f} L",
    )


PAPER = Paper(
    KEY,
    "Captive model tests and course stability of a pure car carrier in the proximity of a bank (2019), 5th "
    "MASHCON, Ostend, pp. 385-394: check helm and course stability",
    cases,
)
