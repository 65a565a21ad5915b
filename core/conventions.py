"""Everything that two laboratories do differently, as named choices.

The home convention is that of the MMG group: x forward, y to starboard, z down, origin at midship, forces
divided by ``0.5 rho L T U**2`` with the instantaneous speed U, radians, rudder positive when it turns the ship
to starboard, inertia and added-mass Coriolis terms outside the derivatives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from .errors import ConventionError

CHOICES: dict[str, dict[str, str]] = {
    "axes": {
        "forward-starboard-down": "x forward, y to starboard, z down",
        "forward-port-up": "x forward, y to port, z up",
    },
    "force_scaling": {
        "LT": "0.5 rho L T U^2 (moment 0.5 rho L^2 T U^2), as in MMG",
        "L2": "0.5 rho L^2 U^2 (moment 0.5 rho L^3 U^2), prime system I",
        "bis": "mass times g (moment times L), speeds by sqrt(g L)",
        "dimensional": "SI, at the reference speed",
    },
    "velocity_scale": {
        "instantaneous": "the speed U of the origin at each moment",
        "approach": "the constant approach speed U0",
    },
    "sway_variable": {
        "v": "sway velocity v' = v/U",
        "beta": "drift angle",
    },
    "drift_sign": {
        "-v": "beta = atan(-v/u), ITTC and MMG",
        "+v": "beta = atan(v/u), MARIN",
    },
    "rudder_sign": {
        "starboard": "positive rudder turns the ship to starboard",
        "port": "positive rudder turns the ship to port",
    },
    "angle_unit": {"rad": "radians", "deg": "degrees"},
    "rigid_body_inertia": {
        "outside": "the mass of the ship is not in the derivatives",
        "inside": "the mass of the ship is in the derivatives (Yr - m', Yvdot - m', ...)",
    },
    "added_mass_coriolis": {
        "outside": "mx u r and my v r stand on the left side of the equations, as in MMG",
        "inside": "the derivatives hold them (Yr - mx', Xvr + my')",
        "outside-with-munk": "the whole added-mass Coriolis matrix stands outside, Munk moment included",
    },
    "wave_heading": {
        "following=0": "0 deg is a following sea, 180 deg a head sea",
        "head=0": "0 deg is a head sea, 180 deg a following sea",
    },
    "force_sign": {
        "on-ship": "forces act on the ship",
        "by-ship": "forces are those of the ship on the balance",
    },
    "scale": {"model": "model scale", "full": "full scale"},
}
"""Each convention with its choices and their meaning; ``origin`` is a place and listed apart."""


@dataclass(frozen=True)
class Conventions:
    """The choices that give a number its meaning; the default is the home convention.

    Attributes
    ----------
    axes, force_scaling, velocity_scale, sway_variable, drift_sign, rudder_sign, angle_unit, \
rigid_body_inertia, added_mass_coriolis, wave_heading, force_sign, scale : str
        One of :data:`CHOICES`.
    origin : "midship", "cog" or float
        Reference point of velocities and moments; a number is x/L forward of midship.
    """

    axes: str = "forward-starboard-down"
    origin: str | float = "midship"
    force_scaling: str = "LT"
    velocity_scale: str = "instantaneous"
    sway_variable: str = "v"
    drift_sign: str = "-v"
    rudder_sign: str = "starboard"
    angle_unit: str = "rad"
    rigid_body_inertia: str = "outside"
    added_mass_coriolis: str = "outside"
    wave_heading: str = "following=0"
    force_sign: str = "on-ship"
    scale: str = "model"

    def __post_init__(self) -> None:
        for key, choices in CHOICES.items():
            value = getattr(self, key)
            if value not in choices:
                raise ConventionError(
                    f"conventions.{key} = '{value}' is not a choice", cure=f"use one of {', '.join(choices)}"
                )
        if isinstance(self.origin, bool) or not (
            self.origin in ("midship", "cog") or isinstance(self.origin, int | float)
        ):
            raise ConventionError(
                f"conventions.origin = '{self.origin}' is not a place",
                cure="use 'midship', 'cog' or x/L forward of midship as a number",
            )

    def but(self, **changes: Any) -> Conventions:
        """Copy with some choices changed."""
        unknown = sorted(set(changes) - {item.name for item in fields(self)})
        if unknown:
            raise ConventionError(
                f"unknown convention '{unknown[0]}'",
                cure=f"conventions are {', '.join(item.name for item in fields(self))}",
            )
        return replace(self, **changes)

    def to_dict(self) -> dict[str, Any]:
        """All choices, for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Conventions:
        """Conventions from :meth:`to_dict`; what is not named is home."""
        return cls().but(**dict(data))

    def differences(self, other: Conventions) -> dict[str, tuple[Any, Any]]:
        """Choices in which two conventions differ: name -> (ours, theirs)."""
        ours, theirs = self.to_dict(), other.to_dict()
        return {key: (ours[key], theirs[key]) for key in ours if ours[key] != theirs[key]}

    def describe(self) -> list[tuple[str, str, str]]:
        """Rows (convention, choice, meaning) for reports."""
        rows = []
        for item in fields(self):
            value = getattr(self, item.name)
            if item.name == "origin":
                place = {"midship": "at midship", "cog": "at the centre of gravity"}
                meaning = place.get(str(value), f"{value} L forward of midship")
            else:
                meaning = CHOICES[item.name][value]
            rows.append((item.name.replace("_", " "), str(value), meaning))
        return rows


HOME = Conventions()

PRESETS: dict[str, dict[str, Any]] = {
    "mmg": {
        "force_scaling": "LT",
        "velocity_scale": "instantaneous",
        "sway_variable": "v",
        "rudder_sign": "starboard",
        "angle_unit": "rad",
        "origin": "midship",
    },
    "prime": {"force_scaling": "L2"},
    "lt": {"force_scaling": "LT"},
    "bis": {"force_scaling": "bis"},
    "dimensional": {"force_scaling": "dimensional"},
    "approach-speed": {"velocity_scale": "approach"},
    "instantaneous-speed": {"velocity_scale": "instantaneous"},
    "drift-angle": {"sway_variable": "beta", "drift_sign": "-v"},
    "drift-angle-marin": {"sway_variable": "beta", "drift_sign": "+v"},
    "sway-velocity": {"sway_variable": "v"},
    "cog": {"origin": "cog"},
    "midship": {"origin": "midship"},
    "added-mass-inside": {"added_mass_coriolis": "inside"},
    "added-mass-outside": {"added_mass_coriolis": "outside"},
    "rudder-port": {"rudder_sign": "port"},
    "rudder-starboard": {"rudder_sign": "starboard"},
    "degrees": {"angle_unit": "deg"},
    "radians": {"angle_unit": "rad"},
}
"""Named changes of convention for ``towtank convert --to``."""


def preset(name: str, start: Conventions) -> Conventions:
    """`start` with the named preset(s) applied; several are joined by commas.

    Raises
    ------
    ConventionError
        For an unknown name.
    """
    changes: dict[str, Any] = {}
    for part in name.split(","):
        key = part.strip().lower()
        if key not in PRESETS:
            raise ConventionError(f"unknown convention '{part}'", cure=f"use one of {', '.join(PRESETS)}")
        changes |= PRESETS[key]
    return start.but(**changes)
