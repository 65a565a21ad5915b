"""Pure car carrier near a bank (Hiroshima University, MASHCON 2019): refits of its programmes, bank forces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ..core.derivative_set import DerivativeSet, joined
from ..core.hull_models import hull_model
from ..core.scales import mass_coefficient
from ..core.ship import Ship
from ..datasets import load_set
from ..pmm.run_types import Run
from ..pmm.standard_matrices import standard_matrix
from ..simulate.bank import bank_equilibrium
from .case import Case, Paper, half_digit
from .closed_loop import ROUND_TRIP, largest_difference, mean_forces, refitted
from .paper_pcc_stability import ship_near_bank
from .printed_numbers import KNOT, printed_rows, ship_of
from .rounding import spread_of

KEY = "pcc-bank"

DEPTHS = {"pcc-deep": "deep water", "pcc-hd1.5": "h/d = 1.5", "pcc-hd1.2": "h/d = 1.2"}


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _particulars()
    yield from _bank_geometry()
    yield from _heel_refits()
    yield from _bank_refits()
    yield from _bank_forces()
    yield from _check_helm()


# Particulars ----------------------------------------------------------------------------------------------------


def _full_ship() -> Ship:
    return ship_of("pcc-bank-geometry").at_scale(1.0)


def _particulars() -> Iterator[Case]:
    full = _full_ship()
    model = full.at_scale(90.0)
    numbers = (float(full.volume or math.nan), 0), (full.L, 2), (full.B, 2), (full.T, 2)
    # Table 1 of the paper, model column
    for quantity, printed, computed, decimals in (
        ("length in m", 2.000, model.L, 3),
        ("breadth in m", 0.358, model.B, 3),
        ("draught in m", 0.091, model.T, 3),
        ("displaced volume in m3", 0.036, float(model.volume or math.nan), 3),
        ("centre of gravity in m", -0.028, model.xG, 3),
        ("GM in m", 0.014, float(model.GM or math.nan), 3),
    ):
        yield Case(KEY, "Table 1, scale 1:90", quantity, printed, computed, half_digit(decimals))
    yield Case(
        KEY,
        "Table 1, scale 1:90",
        "block coefficient",
        0.547,
        float(full.block_coefficient or math.nan),
        spread_of(lambda volume, length, breadth, draught: volume / (length * breadth * draught), *numbers)
        + half_digit(3),
    )
    yield Case(
        KEY, "Table 1, scale 1:90", "m' (recomputed reference)", 0.19572, mass_coefficient(full), half_digit(5)
    )
    halved = "12 and 6 knots are 0.147 and 0.0735: half of the first number, rounded up"
    deep, shallow = printed_rows("pcc-programme")[:2]
    for knots, row in ((12.0, deep), (6.0, shallow)):
        speed = knots * KNOT / math.sqrt(90.0)
        case = f"test programme, {knots:g} knots"
        yield Case(KEY, case, "speed of the model in m/s", row["speed"], speed, half_digit(3))
        number = model.froude_number(speed)
        yield Case(
            KEY,
            case,
            "Froude number",
            row["froude_number"],
            number,
            half_digit(3),
            note=halved if abs(number - row["froude_number"]) > half_digit(3) else "",
        )


def _bank_geometry() -> Iterator[Case]:
    """Distance from the bank toe to the ship's side: s = W - eta - B/2 with W = 0.45 L."""
    model = _full_ship().at_scale(90.0)
    for row in printed_rows("pcc-bank-geometry"):
        eta = 1e-3 * row["eta"]
        case = f"Table 4, eta = {row['eta']:g} mm"
        yield Case(KEY, case, "eta/L", row["eta_over_L"], eta / model.L, half_digit(2))
        gap = 0.45 * model.L - eta - 0.5 * model.B
        yield Case(KEY, case, "s/L", row["s_over_L"], gap / model.L, half_digit(2))


# Refits ---------------------------------------------------------------------------------------------------------


def _heel_refits() -> Iterator[Case]:
    """Table 2 through virtual runs at 9 drift angles, 7 yaw rates and 3 heel angles, and one fit."""
    for key, depth in DEPTHS.items():
        published = load_set(key)
        derivatives = published.subset([term.name for term in hull_model("heel")])
        matrix = standard_matrix("pcc", derivatives.ship, published.reference_speed)
        fit = refitted(derivatives, matrix)
        case = f"Table 2, {depth}, refit of {len(matrix)} conditions"
        yield from _refit_cases(case, derivatives, fit, ("Yv", "Yvphiphi", "Nrphiphi"))


def _bank_refits() -> Iterator[Case]:
    """Table 5 with the drift terms of Table 2 through the oblique towing programme along the bank."""
    for key in ("pcc-hd1.5", "pcc-hd1.2"):
        derivatives = _near_bank(key)
        matrix = standard_matrix("pcc-bank", derivatives.ship)
        fit = refitted(derivatives, matrix)
        case = f"Table 5, {DEPTHS[key]}, refit of {len(matrix)} conditions"
        yield from _refit_cases(case, derivatives, fit, ("Yeta", "Nvetaeta"))


def _near_bank(key: str) -> DerivativeSet:
    """Drift terms of a depth and its bank terms as one set."""
    drift = load_set(key)
    names = [term.name for term in hull_model("bank") if term.name in drift.names]
    bank = load_set(key.replace("pcc-", "pcc-bank-"))
    return joined([drift.subset(names), bank], f"{drift.name}, near a bank")


def _refit_cases(
    case: str, derivatives: DerivativeSet, fit: DerivativeSet, named: tuple[str, ...]
) -> Iterator[Case]:
    size = largest_difference(derivatives, fit)
    yield Case(KEY, case, f"largest difference over {len(derivatives)} coefficients", 0.0, size, ROUND_TRIP)
    for name in named:
        yield Case(KEY, case, name, derivatives[name], fit[name], ROUND_TRIP)


# Bank forces ----------------------------------------------------------------------------------------------------

_BANK_FORCES = {
    0.09: (0.00570, -0.00119),
    0.18: (0.01161, -0.00306),
    0.27: (0.01794, -0.00627),
    0.31: (0.02093, -0.00831),
    0.36: (0.02487, -0.01151),
}
"""Y' and N' at zero drift and h/d = 1.5 by eta/L, recomputed from Table 5; the paper shows curves."""


def _bank_forces() -> Iterator[Case]:
    """Suction and bow-out moment on a straight course, from the bank terms alone."""
    bank = load_set("pcc-bank-hd1.5")
    speed = float(bank.reference_speed or math.nan)
    for eta, references in _BANK_FORCES.items():
        run = Run("along the bank", "static_drift", speed, bank_position=eta * bank.ship.L)
        forces = mean_forces(bank, run)
        for force, reference in zip(("Y", "N"), references, strict=True):
            yield Case(
                KEY,
                f"Table 5, h/d = 1.5, eta = {eta:g} L",
                f"{force}' at zero drift (recomputed reference)",
                reference,
                forces[force],
                half_digit(5),
            )


def _check_helm() -> Iterator[Case]:
    """Rudder angle that holds the ship parallel to the bank at h/d = 1.2 and eta = 0.27 L (equation 15).

    In the steady balance (equations 12 and 13) the cubic terms count once; three times, as equation 14 has
    them, belongs to the stability equations.
    """
    eta = 0.27
    ship = ship_near_bank(1.2)
    tenth = replace(ship, Netaetaeta=ship.Netaetaeta / 10)
    helm, likely = (abs(math.degrees(bank_equilibrium(one, eta).helm)) for one in (ship, tenth))
    yield Case(
        KEY,
        "Table 5, h/d = 1.2, eta = 0.27 L",
        "size of the check helm in deg, text",
        35.0,
        helm,
        half_digit(0),
        note=f"the text says 35 deg near this place. Netaetaeta = {ship.Netaetaeta:g} is suspect: with a tenth "
        f"of it the check helm is {likely:.0f} deg",
    )


PAPER = Paper(
    KEY,
    "Captive model tests and course stability of a pure car carrier in the proximity of a bank (2019), 5th "
    "MASHCON, Ostend, pp. 385-394",
    cases,
)
