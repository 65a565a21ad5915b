"""110 m inland ship (MARIN, MASHCON 2019): forward values, staged round trip, stability, sign of the drift."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.scales import mass_coefficient
from ..datasets import load_set
from ..pmm.run_types import Run
from ..pmm.standard_matrices import standard_matrix
from .case import Case, Paper, half_digit
from .closed_loop import ROUND_TRIP, largest_difference, mean_forces, refitted
from .printed_numbers import printed_rows
from .rounding import spread_of

KEY = "inland"

SPEED = 3.5
"""Speed in m/s of the deep-water computations; non-dimensional forces do not depend on it."""

WATERS = {"inland-deep": "deep water", "inland-shallow": "h/T = 1.4"}


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _particulars()
    yield from _forward_values()
    yield from _staged_round_trip()
    yield from _stability()
    yield from _drift_sign()


def _particulars() -> Iterator[Case]:
    ship = load_set("inland-deep").ship
    displacement = float(ship.displacement_mass or math.nan) / 1000.0
    model = ship.at_scale(18.0)
    box = ship.L * ship.B * ship.T
    for quantity, printed, computed, decimals in (
        ("length of the model in m", 6.111, model.L, 3),
        ("breadth of the model in m", 0.633, model.B, 3),
        ("displacement of the model in t", 0.657, float(model.displacement_mass or math.nan) / 1000.0, 3),
    ):
        yield Case(KEY, "Table 1, scale 1:18", quantity, printed, computed, half_digit(decimals))
    yield Case(
        KEY,
        "Table 1, scale 1:18",
        "block coefficient",
        0.88,
        float(ship.block_coefficient or math.nan),
        spread_of(lambda volume: volume / box, (displacement, 0)) + half_digit(2),
        note="3832 t of fresh water in L B T is 0.873; 0.88 would be 3862 t",
    )


def _condition(beta: float, rate: float, length: float) -> Run:
    """Steady run at a drift angle in degrees, atan(v/u) as in the paper, and r'."""
    kind = "steady_yaw_drift" if rate and beta else "steady_yaw" if rate else "static_drift"
    return Run("condition", kind, SPEED, drift_angle=-math.radians(beta), yaw_rate=rate * SPEED / length)


def _forward_values() -> Iterator[Case]:
    """The polynomials of Table 4 at sixteen conditions; the paper prints no forces."""
    for row in printed_rows("inland-forward-values"):
        hull = load_set(row["set"])
        forces = mean_forces(hull, _condition(row["beta"], row["r"], hull.ship.L))
        for name, value in forces.items():
            yield Case(
                KEY,
                f"Table 4, {WATERS[row['set']]}, drift {row['beta']:g} deg, r' = {row['r']:g}",
                f"{name}', forward value (recomputed reference)",
                row[name],
                value,
                half_digit(5),
            )


def _staged_round_trip() -> Iterator[Case]:
    """Table 4 through the programme of Table 3 and a fit in the paper's order: drift, yaw, coupling."""
    for key, water in WATERS.items():
        derivatives = load_set(key)
        matrix = standard_matrix("inland", derivatives.ship, SPEED)
        fit = refitted(derivatives, matrix, staged=True).to("drift-angle-marin")
        case = f"Table 4, {water}, three stages"
        for name in derivatives.names:
            yield Case(KEY, case, name, derivatives[name], fit[name], ROUND_TRIP)
        size = largest_difference(derivatives, fit)
        yield Case(KEY, case, f"largest difference over {len(derivatives)} coefficients", 0.0, size, ROUND_TRIP)


_STABILITY = {
    "inland-deep": {"C'": (-0.0093, 4), "lever Nb/Yb": (0.497, 3), "lever Nr/(Yr - m')": (0.097, 3)},
    "inland-shallow": {"C'": (-0.0164, 4), "lever Nb/Yb": (0.483, 3), "lever Nr/(Yr - m')": (0.244, 3)},
}
"""Course stability of the bare hull with xG = 0 and without added masses, recomputed, with decimals."""


def _stability() -> Iterator[Case]:
    for key, references in _STABILITY.items():
        hull = load_set(key)
        mass = mass_coefficient(hull.ship)
        # To first order v' = beta in the paper's sign, so Yb and Nb are Yv and Nv.
        turning = hull["Yr"] - mass
        computed = {
            "C'": hull["Yb"] * hull["Nr"] - hull["Nb"] * turning,
            "lever Nb/Yb": hull["Nb"] / hull["Yb"],
            "lever Nr/(Yr - m')": hull["Nr"] / turning,
        }
        for quantity, (reference, decimals) in references.items():
            yield Case(
                KEY,
                f"Table 4, {WATERS[key]}, bare hull",
                f"{quantity} (recomputed reference)",
                reference,
                computed[quantity],
                half_digit(decimals),
                note="negative: unstable on a straight course" if quantity == "C'" else "",
            )
    mass = mass_coefficient(load_set("inland-deep").ship)
    yield Case(KEY, "Table 1", "m' (recomputed reference)", 0.1810, mass, half_digit(4))


def _drift_sign() -> Iterator[Case]:
    """From beta = atan(v/u) of MARIN to atan(-v/u) of ITTC: what is odd in beta turns its sign."""
    for key, water in WATERS.items():
        marin = load_set(key)
        ittc = marin.to("drift-angle")
        turned = " ".join(name for name in marin.names if ittc[name] == -marin[name])
        yield Case(
            KEY,
            f"Table 4, {water}, ITTC drift angle",
            "coefficients that turn their sign (recomputed reference)",
            "Yb Yb|b| Ybrr Nb Nb|b| Nbrr",
            turned,
        )
        back = ittc.to("drift-angle-marin")
        yield Case(
            KEY,
            f"Table 4, {water}, ITTC drift angle",
            "largest difference there and back",
            0.0,
            largest_difference(marin, back),
            ROUND_TRIP,
        )


PAPER = Paper(
    KEY,
    "Mathematical model and data for inland ship manoeuvring (MARIN, 2019), 5th MASHCON, Ostend, pp. 251-260",
    cases,
)
