"""The water around a ship: open, a canal, or a dredged trench; its section, and how much of it the ship fills."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from ..core.errors import TowtankError

FairwayKind = Literal["open", "canal", "trench"]

MIDSHIP_COEFFICIENT = 0.98
"""Midship section over B T where the ship's own is not known (PIANC 121)."""


@dataclass(frozen=True)
class Fairway:
    """Cross-section of the water.

    Attributes
    ----------
    depth : float
        Still-water depth h in m.
    area : float, optional
        Wetted section in m2; None in open water. Of a trench: with its banks prolonged to the surface.
    top_width : float, optional
        Width at the water surface in m, of a trench with its banks prolonged; None in open water.
    bank_height : float, optional
        Height of the underwater banks of a trench above its bottom in m; None otherwise.
    """

    depth: float
    area: float | None = None
    top_width: float | None = None
    bank_height: float | None = None

    def __post_init__(self) -> None:
        for name in ("depth", "area", "top_width", "bank_height"):
            value = getattr(self, name)
            if value is not None and not (value > 0 and math.isfinite(value)):
                raise TowtankError(f"fairway: {name} = {value} is not a positive number", cure="give it in m")
        if (self.area is None) != (self.top_width is None):
            raise TowtankError("fairway: section and surface width belong together", cure="give both or none")
        if self.bank_height is not None and (self.area is None or self.bank_height > self.depth):
            raise TowtankError(
                "fairway: a trench needs its section, and banks that do not rise above the water",
                cure="use Fairway.trench with bank_height at most the depth",
            )

    @property
    def kind(self) -> FairwayKind:
        """Open, canal or trench."""
        if self.area is None:
            return "open"
        return "canal" if self.bank_height is None else "trench"

    @property
    def mean_depth(self) -> float:
        """Section over surface width in m; the depth in open water."""
        if self.area is None or self.top_width is None:
            return self.depth
        return self.area / self.top_width

    @classmethod
    def canal(cls, depth: float, bottom_width: float, slope: float = 0.0) -> Fairway:
        """Symmetric trapezoidal canal or rectangular tank.

        Parameters
        ----------
        depth, bottom_width : float
            In m.
        slope : float
            Run of each bank over its rise: 3 for 1:3, 0 for vertical walls.
        """
        if not (bottom_width > 0 and slope >= 0):
            raise TowtankError(
                f"fairway: bottom width {bottom_width} m with bank slope {slope}",
                cure="give a positive width and the slope as run over rise",
            )
        return cls(depth, depth * (bottom_width + slope * depth), bottom_width + 2.0 * slope * depth)

    @classmethod
    def trench(cls, depth: float, bottom_width: float, bank_height: float, slope: float = 0.0) -> Fairway:
        """Dredged trench in wider water; banks of `bank_height` in m, taken up to the surface for its section."""
        section = cls.canal(depth, bottom_width, slope)
        return cls(depth, section.area, section.top_width, bank_height)


def width_of_influence(breadth: float, block_coefficient: float) -> float:
    """Width in m of open water that a ship disturbs, ``7.04 B / CB**0.85`` (Barrass).

    Parameters
    ----------
    breadth : float
        In m.
    block_coefficient : float
    """
    return 7.04 * breadth / block_coefficient**0.85


def blockage(midship_area: float, section: float) -> float:
    """Ship's section over the water's, m = As/Ac, between 0 and 1.

    Parameters
    ----------
    midship_area, section : float
        In m2.

    Raises
    ------
    TowtankError
        When the ship does not fit.
    """
    if not 0.0 < midship_area < section:
        raise TowtankError(
            f"a midship section of {midship_area:g} m2 does not fit into a water section of {section:g} m2"
        )
    return midship_area / section


def section_ratio(midship_area: float, section: float) -> float:
    """Water's section over the ship's, Ac/As above 1: the inverse of :func:`blockage`, the S of some laboratories."""
    return 1.0 / blockage(midship_area, section)
