"""Particulars of a ship at one scale and loading."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from .errors import TowtankError
from .variables import GRAVITY


@dataclass(frozen=True)
class Ship:
    """A hull at one scale, loading and water.

    Attributes
    ----------
    name : str
        Name of the hull.
    L, B, T : float
        Length between perpendiculars, breadth, draught in m.
    volume : float, optional
        Displaced volume in m3.
    mass : float, optional
        Mass in kg; ``rho * volume`` when not given.
    xG : float
        Centre of gravity forward of midship in m.
    Izz : float, optional
        Yaw moment of inertia about the centre of gravity in kg m2.
    kzz : float, optional
        Yaw radius of gyration in m; ``Izz = mass * kzz**2`` when `Izz` is not given.
    rho : float
        Water density in kg/m3.
    depth : float
        Water depth in m; infinite for deep water.
    scale : float
        Length of the full-scale ship over the length here: 1 for the ship, 46.6 for a model 1:46.6.
    KG, GM : float, optional
        Height of the centre of gravity above the keel, transverse metacentric height, in m.
    kxx, kyy : float, optional
        Roll and pitch radii of gyration in m.
    """

    name: str
    L: float
    B: float
    T: float
    volume: float | None = None
    mass: float | None = None
    xG: float = 0.0
    Izz: float | None = None
    kzz: float | None = None
    rho: float = 1025.0
    depth: float = math.inf
    scale: float = 1.0
    KG: float | None = None
    GM: float | None = None
    kxx: float | None = None
    kyy: float | None = None

    def __post_init__(self) -> None:
        for item in ("L", "B", "T", "rho", "depth", "scale"):
            value = getattr(self, item)
            if not value > 0:
                raise TowtankError(
                    f"ship '{self.name}': {item} = {value} is not positive", cure="give it in SI units"
                )
        for item in ("volume", "mass", "Izz", "kzz"):
            value = getattr(self, item)
            if value is not None and not value > 0:
                raise TowtankError(f"ship '{self.name}': {item} = {value} is not positive")
        if self.depth <= self.T:
            raise TowtankError(
                f"ship '{self.name}': water depth {self.depth} m is not more than the draught {self.T} m"
            )

    @property
    def displacement_mass(self) -> float | None:
        """Mass in kg: as given, else ``rho * volume``, else None."""
        if self.mass is not None:
            return self.mass
        return None if self.volume is None else self.rho * self.volume

    @property
    def yaw_inertia(self) -> float | None:
        """Yaw moment of inertia about the centre of gravity in kg m2, or None."""
        if self.Izz is not None:
            return self.Izz
        if self.kzz is None or self.displacement_mass is None:
            return None
        return self.displacement_mass * self.kzz**2

    @property
    def block_coefficient(self) -> float | None:
        """``volume / (L B T)``, or None."""
        return None if self.volume is None else self.volume / (self.L * self.B * self.T)

    @property
    def depth_ratio(self) -> float:
        """Water depth over draught, h/T."""
        return self.depth / self.T

    def froude_number(self, speed: float) -> float:
        """``U / sqrt(g L)`` for a speed in m/s."""
        return speed / math.sqrt(GRAVITY * self.L)

    def depth_froude_number(self, speed: float) -> float:
        """``U / sqrt(g h)`` for a speed in m/s; 0 in deep water."""
        return speed / math.sqrt(GRAVITY * self.depth)

    def at_scale(self, scale: float, *, rho: float | None = None) -> Ship:
        """The geometrically similar ship at another scale (Froude similarity).

        Parameters
        ----------
        scale : float
            New scale factor; 1 for full scale.
        rho : float, optional
            Water density there in kg/m3; unchanged when not given.
        """
        k = self.scale / scale
        density = self.rho if rho is None else rho
        ratio = density / self.rho

        def times(value: float | None, factor: float) -> float | None:
            return None if value is None else value * factor

        return replace(
            self,
            L=self.L * k,
            B=self.B * k,
            T=self.T * k,
            volume=times(self.volume, k**3),
            mass=times(self.mass, ratio * k**3),
            xG=self.xG * k,
            Izz=times(self.Izz, ratio * k**5),
            kzz=times(self.kzz, k),
            rho=density,
            depth=self.depth * k,
            scale=scale,
            KG=times(self.KG, k),
            GM=times(self.GM, k),
            kxx=times(self.kxx, k),
            kyy=times(self.kyy, k),
        )

    def to_dict(self) -> dict[str, Any]:
        """Particulars that are given, for JSON; infinite depth is left out."""
        return {
            key: value
            for key, value in asdict(self).items()
            if value is not None and not (key == "depth" and math.isinf(value))
        }

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Ship:
        """Ship from :meth:`to_dict`.

        Raises
        ------
        TowtankError
            For an unknown or missing key.
        """
        known = {item.name for item in fields(cls)}
        unknown = sorted(set(data) - known)
        if unknown:
            raise TowtankError(f"ship: unknown key '{unknown[0]}'", cure=f"keys are {', '.join(sorted(known))}")
        missing = [key for key in ("name", "L", "B", "T") if key not in data]
        if missing:
            raise TowtankError(f"ship: '{missing[0]}' is missing")
        return cls(**data)
