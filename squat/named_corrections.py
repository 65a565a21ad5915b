"""Corrections for shallow and narrow water by name, added to the speeds or to the sinkages of a curve or record.

A tank lets a model squat as if it ran faster. One may move its points to the speed that would do the same in wide
water, or take the additional sinkage from them at the speed they have; doing both counts the walls twice, so each call
does one of the two.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Literal

import numpy as np

from ..core.errors import FitError, TowtankError
from ..core.ship import Ship
from ..core.variables import GRAVITY
from . import restricted_flow as flow
from . import speed_corrections as trials
from .fairway import MIDSHIP_COEFFICIENT, Fairway, blockage, width_of_influence
from .sinkage_record import SinkageRecord
from .squat_curve import SquatCurve

Added = Literal["speeds", "sinkages"]


@dataclass(frozen=True)
class ShipInWater:
    """What corrections ask for, in SI at the scale of the points; None where unknown.

    Attributes
    ----------
    depth, section, width : float, optional
        Still-water depth in m, section of the tank or canal in m2, width at its surface in m.
    midship_area, length, breadth, volume, block_coefficient : float, optional
        Of the ship: m2, m, m, m3, -.
    viscous_share : float, optional
        Viscous over total resistance in deep water (Schuster).
    gamma, waterline_gamma, outflow : float, optional
        Flow over ship speed in wide shallow water, averaged over the width of the tank and along the waterline; flow
        through the planes of the walls over V Ac (Raven, from a computation).
    volume_coefficient, wave_coefficient : float, optional
        K1 and K2 of Scott.
    """

    depth: float | None = None
    section: float | None = None
    width: float | None = None
    midship_area: float | None = None
    length: float | None = None
    breadth: float | None = None
    volume: float | None = None
    block_coefficient: float | None = None
    viscous_share: float | None = None
    gamma: float | None = None
    waterline_gamma: float | None = None
    outflow: float | None = None
    volume_coefficient: float | None = None
    wave_coefficient: float | None = None

    def __post_init__(self) -> None:
        for item in fields(self):
            value = getattr(self, item.name)
            if value is not None and not (np.isfinite(value) and value >= 0.0):
                raise TowtankError(f"{item.name} = {value:g} is impossible", cure="give it in SI, not negative")
            if value == 0.0 and item.name in ("depth", "section", "width", "length", "breadth", "volume"):
                raise TowtankError(f"{item.name} is zero", cure="give it in SI, positive")

    @classmethod
    def of(
        cls, ship: Ship, fairway: Fairway, midship_coefficient: float = MIDSHIP_COEFFICIENT, **more: float
    ) -> ShipInWater:
        """Of a ship in a fairway, both at the scale of the points; `more` names what they do not tell."""
        return cls(
            depth=fairway.depth,
            section=fairway.area,
            width=fairway.top_width,
            midship_area=midship_coefficient * ship.B * ship.T,
            length=ship.L,
            breadth=ship.B,
            volume=ship.volume,
            block_coefficient=ship.block_coefficient,
            **more,
        )


class Known:
    """Particulars for one correction: reading one that was not given is an error that names it."""

    def __init__(self, water: ShipInWater, correction: str, guarded: bool) -> None:
        self.water, self.correction, self.guarded = water, correction, guarded

    def __getattr__(self, name: str) -> float:
        value = getattr(self.water, name)
        if value is None:
            raise TowtankError(
                f"the correction '{self.correction}' needs {name}", cure=f"give ShipInWater({name}=...) in SI"
            )
        return float(value)

    def depth_froude(self, speed: np.ndarray, depth: float) -> np.ndarray:
        """V / sqrt(g h)."""
        return np.asarray(speed / np.sqrt(GRAVITY * depth))


Change = Callable[[Known, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class NamedCorrection:
    """One correction.

    Attributes
    ----------
    key : str
    speed : callable or None
        Factor of the speed by ship and speeds in m/s, shape (n,); None when the method has no such form.
    sinkage : callable or None
        Sinkage in m to be taken off, shape (n,); None when the method has no such form.
    leads_to : str
        The water that the corrected points stand for.
    source : str
    """

    key: str
    speed: Change | None
    sinkage: Change | None
    leads_to: str
    source: str

    @property
    def added_to(self) -> tuple[Added, ...]:
        """To what the correction can be added, its usual form first."""
        forms: tuple[tuple[Added, Change | None], ...] = (("speeds", self.speed), ("sinkages", self.sinkage))
        return tuple(name for name, form in forms if form is not None)


def _channel(known: Known) -> tuple[float, float]:
    """Blockage and mean depth of the tank or canal."""
    return blockage(known.midship_area, known.section), known.section / known.width


def _influenced(known: Known) -> tuple[float, float]:
    """Blockage and depth of the open water that the ship disturbs (Barrass)."""
    width = width_of_influence(known.breadth, known.block_coefficient)
    return blockage(known.midship_area, width * known.depth), known.depth


def _gamma(known: Known, speed: np.ndarray, water: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    share, depth = water
    froude = known.depth_froude(speed, depth)
    found = flow.kreitner(share, froude)
    _require_flow(known, speed, found.gamma, found.critical * np.sqrt(GRAVITY * depth))
    return found.gamma, flow.level_drop(depth, froude, found.gamma)


def _require_flow(known: Known, speed: np.ndarray, gamma: np.ndarray, critical: float) -> None:
    if not np.isfinite(gamma).all():
        worst = float(speed[~np.isfinite(gamma)].min())
        raise FitError(
            f"{known.correction}: {worst:.4g} m/s is above the critical speed {critical:.4g} m/s of this water",
            cure="leave such speeds out: no steady flow passes the ship there",
        )


def _raven(known: Known, speed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    share, depth = _channel(known)
    froude = known.depth_froude(speed, depth)
    walls = flow.raven_overspeed(share, froude, known.gamma, known.outflow)
    _require_flow(known, speed, walls, flow.critical_depth_froude(share)[0] * np.sqrt(GRAVITY * depth))
    return walls, froude


def _raven_speed(known: Known, speed: np.ndarray) -> np.ndarray:
    return flow.equivalent_speed(np.ones_like(speed), known.waterline_gamma, _raven(known, speed)[0])


def _raven_sinkage(known: Known, speed: np.ndarray) -> np.ndarray:
    walls, froude = _raven(known, speed)
    return flow.wall_sinkage(_channel(known)[1], froude, known.waterline_gamma, walls)


def _loss(of: Callable[[Known, float], float]) -> Change:
    """Factor of the speed from a relative loss by a formula for one speed; 1 at rest."""
    return lambda known, speed: np.array([1.0 + of(known, float(v)) if v > 0.0 else 1.0 for v in speed])


def _lackenby(known: Known, speed: float) -> float:
    return trials.lackenby_speed_loss(speed, known.depth, known.midship_area, guarded=known.guarded)


def _schuster(known: Known, speed: float) -> float:
    share, depth = _channel(known)
    froude = speed / float(np.sqrt(GRAVITY * depth))
    return trials.schuster_speed_loss(froude, share, known.viscous_share, guarded=known.guarded)


def _tamura(known: Known, speed: float) -> float:
    share, depth = _channel(known)
    return trials.tamura_speed_loss(speed / float(np.sqrt(GRAVITY * depth)), share, known.length / known.width)


def _tamura_ittc(known: Known, speed: float) -> float:
    share, depth = _channel(known)
    return trials.tamura_speed_loss(speed / float(np.sqrt(GRAVITY * depth)), share, known.length / known.breadth)


def _scott(known: Known, speed: float) -> float:
    return trials.scott_speed_loss(
        speed / float(np.sqrt(GRAVITY * known.length)),
        volume=known.volume,
        breadth=known.breadth,
        length=known.length,
        section=known.section,
        volume_coefficient=known.volume_coefficient,
        wave_coefficient=known.wave_coefficient,
        guarded=known.guarded,
    )


def _ittc_sinkage(known: Known, speed: np.ndarray) -> np.ndarray:
    ship = {"depth": known.depth, "length": known.length, "volume": known.volume}
    return np.array([trials.additional_sinkage(speed=float(v), **ship) for v in speed])


CORRECTIONS: dict[str, NamedCorrection] = {
    item.key: item
    for item in (
        NamedCorrection(
            "kreitner",
            lambda known, speed: _gamma(known, speed, _channel(known))[0],
            lambda known, speed: _gamma(known, speed, _channel(known))[1],
            "water of unlimited width and depth",
            "Kreitner 1934; 5th MASHCON 2019",
        ),
        NamedCorrection(
            "barrass-width",
            lambda known, speed: _gamma(known, speed, _influenced(known))[0],
            lambda known, speed: _gamma(known, speed, _influenced(known))[1],
            "deep water, from open shallow water",
            "Kreitner with the width of influence of Barrass; 5th MASHCON 2019",
        ),
        NamedCorrection(
            "raven-width",
            _raven_speed,
            _raven_sinkage,
            "shallow water of unlimited width",
            "Raven 2018; 5th MASHCON 2019, equations 2 to 4",
        ),
        NamedCorrection("schuster", _loss(_schuster), None, "water of unlimited width and depth", "Schuster 1952"),
        NamedCorrection("lackenby", _loss(_lackenby), None, "deep water", "Lackenby 1963"),
        NamedCorrection(
            "tamura",
            _loss(_tamura),
            None,
            "water of unlimited width",
            "Tamura, L over the width of the channel [S]",
        ),
        NamedCorrection(
            "tamura-ittc",
            _loss(_tamura_ittc),
            None,
            "water of unlimited width",
            "Tamura, L over the breadth of the ship [?]",
        ),
        NamedCorrection(
            "scott", _loss(_scott), None, "water of unlimited width", "Scott 1966, K1 and K2 given [S]"
        ),
        NamedCorrection("ittc-2017", None, _ittc_sinkage, "deep water", "ITTC 2017 after Raven, Tuck's sinkage"),
    )
}
"""The corrections by name."""


def correct_curve(
    curve: SquatCurve, name: str, water: ShipInWater, *, to: Added | None = None, guarded: bool = True
) -> SquatCurve:
    """A curve with a correction added; its name says which.

    Parameters
    ----------
    curve : SquatCurve
    name : str
        A key of :data:`CORRECTIONS`.
    water : ShipInWater
        At the scale of the curve. Its depth is that of the curve when not given.
    to : {"speeds", "sinkages"}, optional
        What is corrected; the usual form of the method when not given. A drop of level lowers all places alike:
        trim stays.
    guarded : bool
        Refuse conditions outside those that the authors name.

    Raises
    ------
    TowtankError
        For an unknown name or form, a particular that is missing, or conditions outside the limits of the method.
    FitError
        For a speed at which no steady flow passes the ship.
    """
    speed = curve.points["speed"].to_numpy(dtype=float)
    form, factor, drop = _correction(name, _with_depth(water, curve.depth), to, guarded, speed)
    points = curve.points.copy()
    points["speed"] = speed * factor
    for column in points.columns:
        if str(column).startswith("sinkage_") and not str(column).endswith("_se"):
            points[column] = points[column] - drop
    return replace(curve, points=points, name=", ".join(filter(None, (curve.name, f"{form} by {name}"))))


def correct_record(
    record: SinkageRecord,
    name: str,
    water: ShipInWater,
    *,
    to: Added | None = None,
    guarded: bool = True,
) -> SinkageRecord:
    """A record with a correction added, sample by sample; its history says which.

    Parameters
    ----------
    record : SinkageRecord
        With a speed.
    name, water, to, guarded
        As in :func:`correct_curve`.

    Raises
    ------
    TowtankError, FitError
        As :func:`correct_curve`, and when the record has no speed.
    """
    if record.speed is None:
        raise FitError(
            "a correction needs the speed", cure="name the speed channel in the layout", file=record.name or None
        )
    speed = np.asarray(record.speed, dtype=float)
    if not np.isfinite(speed).all():
        raise FitError("a speed is missing", cure="cut the record there", file=record.name or None)
    form, factor, drop = _correction(name, water, to, guarded, np.abs(speed))
    return replace(
        record,
        speed=speed * factor,
        midship=record.midship - drop,
        history=(*record.history, f"{form} corrected by {name}"),
    )


def _with_depth(water: ShipInWater, depth: float) -> ShipInWater:
    return water if water.depth is not None else replace(water, depth=depth)


def _correction(
    name: str, water: ShipInWater, to: Added | None, guarded: bool, speed: np.ndarray
) -> tuple[Added, np.ndarray, np.ndarray]:
    """Form, factor of the speeds and drop of the sinkages; the one that is not corrected is 1 or 0."""
    if name not in CORRECTIONS:
        raise TowtankError(f"there is no correction '{name}'", cure=f"use one of {', '.join(CORRECTIONS)}")
    correction = CORRECTIONS[name]
    form = correction.added_to[0] if to is None else to
    change = {"speeds": correction.speed, "sinkages": correction.sinkage}.get(form)
    if change is None:
        raise TowtankError(
            f"the correction '{name}' is not added to {form}",
            cure=f"it is added to {' or '.join(correction.added_to)}",
        )
    found = change(Known(water, name, guarded), speed)
    still = np.zeros_like(speed)
    return (form, found, still) if form == "speeds" else (form, still + 1.0, found)
