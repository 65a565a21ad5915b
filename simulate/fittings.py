"""Propeller, rudder and steering gear from what a paper prints beside its derivatives, in the paper's spelling."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..core.errors import DatasetError
from ..core.ship import Ship
from .propeller import Propeller, ThrustSurface
from .rudder import Rudder, fujii_slope
from .vessel import SteeringGear

Printed = Mapping[str, Any]

_SPELLINGS = {
    "wP0": ("wP0", "wp0", "wp"),
    "tP": ("tP", "t"),
    "xP": ("xP", "xp"),
    "cPv": ("cPv", "cpv"),
    "cPr": ("cPr", "cpr"),
    "C2_positive": ("C2_positive", "C2_beta_positive"),
    "C2_negative": ("C2_negative", "C2_beta_negative"),
    "gammaR_positive": ("gammaR_positive", "gammaR_beta_positive", "gammaR_betaP_positive", "gammaR", "gamma"),
    "gammaR_negative": ("gammaR_negative", "gammaR_beta_negative", "gammaR_betaP_negative", "gammaR", "gamma"),
}
"""Spellings of one quantity in different papers; the first one that is there counts."""

_COMPLEMENTS = {"wP0": "one_minus_w", "tP": "one_minus_t", "tR": "one_minus_tR"}
"""Quantities that some papers print as one minus their value."""


def propeller_from(printed: Printed) -> Propeller | ThrustSurface:
    """Propeller of the table ``propeller`` of a set's extras.

    Raises
    ------
    DatasetError
        When the diameter or the open-water diagram is missing.
    """
    if "Tnn" in printed:
        names = ("Tuu", "Tun", "Tnn", "cun", "cnn")
        return ThrustSurface(**{name: float(printed[name]) for name in names}, **_given(printed, "tP"))
    coefficients = [float(printed[key]) for key in ("k0", "k1", "k2", "k3", "k4") if key in printed]
    if "D" not in printed or not coefficients:
        raise DatasetError("the propeller has no diameter D or no thrust coefficients k0, k1, k2")
    wake = str(printed.get("wake", "constant"))
    more = _given(printed, "wP0", "tP", "xP", "C1", "C2_positive", "C2_negative", "tau", "cPv", "cPr")
    if wake == "exponential":
        # papers print wP0 exp(C1 betaP^2) with a negative C1
        more["C1"] = -more["C1"]
    return Propeller(D=float(printed["D"]), KT=coefficients, wake=wake, **more)


def rudder_from(printed: Printed, ship: Ship, propeller: Propeller | None = None) -> Rudder | None:
    """Rudder of the table ``rudder`` of a set's extras; None when it holds the steering gear alone.

    Parameters
    ----------
    printed : mapping
    ship : Ship
        For areas that are printed over L T.
    propeller : Propeller, optional
        For ``eta = D / height`` where it is not printed.
    """
    area = _area(printed, ship)
    if area is None:
        return None
    slope = printed["f_alpha"] if "f_alpha" in printed else fujii_slope(float(printed["aspect_ratio"]))
    more = _given(
        printed, "tR", "aH", "xR", "xH", "zR", "eps", "kappa", "eta", "gammaR_positive", "gammaR_negative", "lR",
        "cRr", "cRrrr", "cRrrv",
    )  # fmt: skip
    if "cRX" in printed:
        more["tR"] = 1.0 - float(printed["cRX"])
    if "eta" not in more and propeller is not None and "height" in printed:
        more["eta"] = propeller.D / float(printed["height"])
    return Rudder(
        area=area,
        f_alpha=float(slope),
        switch="betaP" if "gammaR_betaP_positive" in printed else "betaR",
        inflow=str(printed.get("inflow", "MMG")),
        **more,
    )


def gear_from(printed: Printed) -> SteeringGear | None:
    """Steering gear of the table ``rudder`` of a set's extras; None when no rate is given."""
    if "rate_rad_s" in printed:
        rate = float(printed["rate_rad_s"])
    elif "rate_deg_s" in printed:
        rate = math.radians(float(printed["rate_deg_s"]))
    else:
        return None
    limit = math.radians(float(printed.get("limit_deg", 35.0)))
    return SteeringGear(rate=rate, limit=limit, lag=float(printed.get("lag_s", 0.0)))


def notes_of(extras: Mapping[str, Printed]) -> dict[str, str]:
    """What the paper does not print, by subject."""
    return {subject: str(items["note"]) for subject, items in extras.items() if "note" in items}


def _area(printed: Printed, ship: Ship) -> float | None:
    if "area" in printed:
        return float(printed["area"])
    if "area_over_LT" in printed:
        return float(printed["area_over_LT"]) * ship.L * ship.T
    if "LT_over_area" in printed:
        return ship.L * ship.T / float(printed["LT_over_area"])
    return None


def _given(printed: Printed, *names: str) -> dict[str, Any]:
    """The quantities that are printed, under the names of this package."""
    found: dict[str, Any] = {}
    for name in names:
        spelling = next((key for key in _SPELLINGS.get(name, (name,)) if key in printed), None)
        if spelling is not None:
            found[name] = float(printed[spelling])
        elif _COMPLEMENTS.get(name) in printed:
            found[name] = 1.0 - float(printed[_COMPLEMENTS[name]])
    return found
