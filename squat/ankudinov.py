"""Ankudinov 2009 (MARSIM): midship sinkage and trim with propeller, bulb, transom and channel."""

from __future__ import annotations

import math

import numpy as np

from .squat_formula import Ends, Passage, SquatFormula

_PROPELLER_SINKAGE = {1: 0.15, 2: 0.13}
_PROPELLER_TRIM = {1: 0.15, 2: 0.20}
_BULB = 0.1
_TRANSOM = 0.1


def _ends(passage: Passage) -> Ends:
    block = passage.block_coefficient
    froude = passage.depth_froude
    hull = 1.7 * block * passage.B * passage.T / passage.L**2 + 0.004 * block**2
    speed = froude ** (1.8 + 0.4 * froude)
    channel, channel_trim = _channel_factors(passage)
    sinkage = (
        (1.0 + _PROPELLER_SINKAGE[passage.propellers])
        * hull
        * speed
        * (1.0 + 0.35 / passage.depth_ratio**2)
        * channel
    )
    with np.errstate(divide="ignore"):
        depth_trim = 1.0 - np.exp(2.5 * (1.0 - passage.depth_ratio) / froude)
    propulsion = 0.15 * _PROPELLER_SINKAGE[passage.propellers] + _PROPELLER_TRIM[passage.propellers]
    ship = _BULB * passage.bulb + _TRANSOM * passage.transom + passage.static_trim
    trim_form = block ** (2.0 + 0.8 * channel / block) - propulsion - ship
    trim = -1.7 * hull * speed * depth_trim * trim_form * channel_trim
    return Ends(
        bow=passage.L * (sinkage - 0.5 * trim),
        stern=passage.L * (sinkage + 0.5 * trim),
        middle=passage.L * sinkage,
    )


def _channel_factors(passage: Passage) -> tuple[float, float]:
    """Factors of sinkage and trim; both 1 in open water."""
    fairway = passage.fairway
    if fairway.kind == "open":
        return 1.0, 1.0
    share = 1.0 if fairway.bank_height is None else fairway.bank_height / fairway.depth
    parameter = passage.block_coefficient * passage.blockage / passage.depth_ratio * share
    sinkage = 1.0 + 10.0 * parameter - 1.5 * (1.0 + parameter) * math.sqrt(parameter)
    return sinkage, 1.0 - 5.0 * parameter


FORMULAS = (
    SquatFormula(
        "ankudinov",
        _ends,
        "Ankudinov 2009; constants not seen in a source, 0.1 each for bulb and transom reconstructed [?]",
        (),
        ("open", "canal", "trench"),
    ),
)
