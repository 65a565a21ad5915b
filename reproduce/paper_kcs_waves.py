"""KCS static drift in regular waves (KRISO, MASHCON 2019): what waves do to Yv and Nv, and their MMG form."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.ship import Ship
from ..datasets import load_set
from ..verify import relative_errors
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_by

KEY = "kcs-waves"

CALM = "kcs-waves-calm"

_SMALL = "L^2 scaling of the paper over L T scaling: a factor L/T = 21.3"


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _model()
    yield from _effect_of_waves()
    yield from _mmg_form()


def _model() -> Iterator[Case]:
    full = load_set("kcs").ship
    scale = load_set(CALM).ship.scale
    model: Ship = full.at_scale(scale)
    speed = 16 * KNOT / math.sqrt(scale)
    for quantity, printed, computed, decimals in (
        ("length in m", 3.49, model.L, 2),
        ("displaced volume in m3", 0.1818, float(model.volume or math.nan), 4),
        ("16 knots at model scale in m/s", 1.014, speed, 3),
        ("Froude number", 0.173, model.froude_number(speed), 3),
    ):
        yield Case(KEY, "Table 1, scale 1:65.9", quantity, printed, computed, half_digit(decimals))


def _effect_of_waves() -> Iterator[Case]:
    """Changes against calm water and sway levers; the paper prints the derivatives only."""
    printed = printed_by("kcs-waves-effect", "set")
    programme = printed_by("kcs-waves-coefficients", "set")
    calm = load_set(CALM)
    for key, references in printed.items():
        waves = load_set(key)
        case = f"Table 3, {programme[key]['waves']} water"
        if key != CALM:
            case = f"Table 3, {programme[key]['waves']} waves of {programme[key]['wave_length']:g} L"
            for name in ("Yv", "Nv"):
                change = float(relative_errors([waves[name]], [calm[name]]).s_minus_d[0])
                yield Case(
                    KEY,
                    case,
                    f"change of {name} in % (recomputed reference)",
                    references[f"{name}_change"],
                    change,
                    half_digit(1),
                )
        yield Case(
            KEY,
            case,
            "lever Nv/Yv (recomputed reference)",
            references["lever"],
            waves["Nv"] / waves["Yv"],
            half_digit(3),
        )


def _mmg_form() -> Iterator[Case]:
    calm = load_set(CALM).to("mmg")
    for name, value in (("Yv", -0.190), ("Nv", -0.108)):
        yield Case(
            KEY,
            "Table 3, MMG scaling",
            f"{name} in calm water (recomputed reference)",
            value,
            calm[name],
            half_digit(3),
            note=_SMALL,
        )


PAPER = Paper(
    KEY,
    "Captive model tests of KCS in regular waves: static drift (KRISO, 2019), 5th MASHCON, Ostend, pp. 57-63",
    cases,
)
