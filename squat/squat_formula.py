"""What every empirical squat formula is: a function of a ship under way, with its source and its limits as data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..core.errors import TowtankError
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .fairway import MIDSHIP_COEFFICIENT, Fairway, FairwayKind, blockage, width_of_influence

KNOT = 1852.0 / 3600.0
"""Metres a second in one knot."""

_ROUNDING = 1e-9
"""A depth of 1.5 draughts is at the limit 1.5, whatever the last bit of the division."""


@dataclass(frozen=True, eq=False)
class Passage:
    """A full-scale ship at several speeds in a fairway.

    Attributes
    ----------
    L, B, T : float
        In m.
    block_coefficient : float
    speed : ndarray, shape (n,)
        Through the water, m/s.
    fairway : Fairway
    midship_coefficient : float
        Midship section over B T.
    propellers : int
        One or two.
    bulb, transom : bool
        Whether the ship has a bulbous bow, a transom stern that is wetted.
    static_trim : float
        Draught aft less draught forward, over their sum.
    """

    L: float
    B: float
    T: float
    block_coefficient: float
    speed: np.ndarray
    fairway: Fairway
    midship_coefficient: float = MIDSHIP_COEFFICIENT
    propellers: int = 1
    bulb: bool = True
    transom: bool = True
    static_trim: float = 0.0

    @property
    def depth(self) -> float:
        """Water depth in m."""
        return self.fairway.depth

    @property
    def depth_ratio(self) -> float:
        """h/T."""
        return self.depth / self.T

    @property
    def volume(self) -> float:
        """Displaced volume in m3."""
        return self.block_coefficient * self.L * self.B * self.T

    @cached_property
    def depth_froude(self) -> np.ndarray:
        """``V / sqrt(g h)``, shape (n,)."""
        return self.speed / np.sqrt(GRAVITY * self.depth)

    @cached_property
    def knots(self) -> np.ndarray:
        """Speed in knots, for the formulas that were fitted in knots; shape (n,)."""
        return self.speed / KNOT

    @property
    def water_section(self) -> float:
        """Section of the fairway in m2; in open water that of the width that the ship disturbs."""
        if self.fairway.area is not None:
            return self.fairway.area
        return width_of_influence(self.B, self.block_coefficient) * self.depth

    @property
    def blockage(self) -> float:
        """Midship section over :attr:`water_section`."""
        return blockage(self.midship_coefficient * self.B * self.T, self.water_section)

    @property
    def box_blockage(self) -> float:
        """B T over :attr:`water_section`, as Barrass has it."""
        return blockage(self.B * self.T, self.water_section)


@dataclass(frozen=True, eq=False)
class Ends:
    """Squat in m, positive down, shape (n,) each; None where the formula does not speak of that place.

    Attributes
    ----------
    bow, stern, middle : ndarray, optional
        At the perpendiculars and at midship.
    largest : ndarray, optional
        Of a formula that names the largest squat and not its place.
    """

    bow: np.ndarray | None = None
    stern: np.ndarray | None = None
    middle: np.ndarray | None = None
    largest: np.ndarray | None = None

    @property
    def maximum(self) -> np.ndarray:
        """Largest squat that the formula gives anywhere, shape (n,)."""
        given = [value for value in (self.bow, self.stern, self.middle, self.largest) if value is not None]
        return np.asarray(np.max(given, axis=0))


@dataclass(frozen=True)
class Limit:
    """Range of a quantity in which a formula was fitted, or that its author names.

    Attributes
    ----------
    quantity : str
        A key of :data:`QUANTITIES`.
    low, high : float
    """

    quantity: str
    low: float = -np.inf
    high: float = np.inf


QUANTITIES: dict[str, Callable[[Passage], np.ndarray | float]] = {
    "CB": lambda passage: passage.block_coefficient,
    "B/T": lambda passage: passage.B / passage.T,
    "L/B": lambda passage: passage.L / passage.B,
    "h/T": lambda passage: passage.depth_ratio,
    "Fh": lambda passage: passage.depth_froude,
    "S": lambda passage: passage.blockage,
    "BT/Ac": lambda passage: passage.box_blockage,
}
"""The quantities that limits speak of."""


@dataclass(frozen=True)
class SquatFormula:
    """One formula.

    Attributes
    ----------
    key : str
        Name in tables and on the command line.
    evaluate : callable
        Squat of a :class:`Passage`.
    source : str
        Author, year, and in brackets where the coefficients come from: ``[S]`` seen in a public source, ``[K]``
        field knowledge to be checked against the primary, ``[?]`` reconstructed.
    limits : tuple of Limit
    waters : tuple of str
        Kinds of fairway that it is meant for.
    """

    key: str
    evaluate: Callable[[Passage], Ends]
    source: str
    limits: tuple[Limit, ...]
    waters: tuple[FairwayKind, ...] = ("open",)

    def objections(self, passage: Passage) -> list[str]:
        """At each speed, which limits are broken, in words; empty where the formula applies."""
        n = len(passage.speed)
        kind = passage.fairway.kind
        water = "open water" if kind == "open" else f"a {kind}"
        said: list[list[str]] = [[] if kind in self.waters else [f"not for {water}"] for _ in range(n)]
        for limit in self.limits:
            values = np.broadcast_to(np.asarray(QUANTITIES[limit.quantity](passage), dtype=float), (n,))
            for item, value in zip(said, values, strict=True):
                if value < limit.low - _ROUNDING * abs(limit.low):
                    item.append(f"{limit.quantity} {value:.3g} below {limit.low:g}")
                elif value > limit.high + _ROUNDING * abs(limit.high):
                    item.append(f"{limit.quantity} {value:.3g} above {limit.high:g}")
        return ["; ".join(item) for item in said]


def slender_body_factor(passage: Passage) -> np.ndarray:
    """Volume over L^2 times ``Fh^2 / sqrt(1 - Fh^2)`` in m: the form of all theories of slender ships, shape (n,)."""
    froude = passage.depth_froude
    return np.asarray(passage.volume / passage.L**2 * froude**2 / np.sqrt(1.0 - froude**2))


def full_scale_passage(
    ship: Ship,
    fairway: Fairway,
    speed: np.ndarray,
    *,
    midship_coefficient: float = MIDSHIP_COEFFICIENT,
    propellers: int = 1,
    bulb: bool = True,
    transom: bool = True,
    static_trim: float = 0.0,
) -> Passage:
    """The passage at full scale of a ship or model: formulas in knots and metres do not hold for models.

    Parameters
    ----------
    ship : Ship
        At its own scale, with its volume.
    fairway : Fairway
        At the scale of the ship.
    speed : ndarray, shape (n,)
        m/s at the scale of the ship.
    midship_coefficient, propellers, bulb, transom, static_trim
        See :class:`Passage`.

    Raises
    ------
    TowtankError
        When the ship has no volume, the water is too shallow or narrow, or a speed is not a number, negative, or at
        or above ``sqrt(g h)``.
    """
    if ship.block_coefficient is None:
        raise TowtankError(f"ship '{ship.name}' has no displaced volume", cure="give volume in m3")
    if fairway.depth <= ship.T:
        raise TowtankError(
            f"water depth {fairway.depth} m is not more than the draught {ship.T} m",
            cure="give more depth, or the draught of the loading",
        )
    if speed.ndim != 1 or not len(speed) or not np.isfinite(speed).all() or (speed < 0).any():
        raise TowtankError("a speed is missing, negative or not a number", cure="give speeds in m/s")
    critical = float(np.sqrt(GRAVITY * fairway.depth))
    if (speed >= critical).any():
        raise TowtankError(
            f"speed {speed.max():.3f} m/s is not below "
            f"the critical {critical:.3f} m/s ({critical / KNOT:.4g} kn) of this depth",
            cure="no squat formula holds there; leave these speeds out",
        )
    if propellers not in (1, 2):
        raise TowtankError(f"{propellers} propellers", cure="the formulas know one or two")
    k = ship.scale
    wide = Fairway(
        fairway.depth * k,
        None if fairway.area is None else fairway.area * k**2,
        None if fairway.top_width is None else fairway.top_width * k,
        None if fairway.bank_height is None else fairway.bank_height * k,
    )
    full = ship.at_scale(1.0)
    return Passage(
        L=full.L,
        B=full.B,
        T=full.T,
        block_coefficient=ship.block_coefficient,
        speed=speed * np.sqrt(k),
        fairway=wide,
        midship_coefficient=midship_coefficient,
        propellers=propellers,
        bulb=bulb,
        transom=transom,
        static_trim=static_trim,
    )
