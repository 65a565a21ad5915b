"""The ship of a squat command: a named ship, or a TOML file with its particulars."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import ReadError, TowtankError

if TYPE_CHECKING:
    from ..core.ship import Ship


@dataclass(frozen=True)
class SquatShip:
    """A ship and what some formulas ask for beside its particulars.

    Attributes
    ----------
    ship : Ship
        At its own scale, with its displaced volume where it is known.
    hull : dict
        Section ``[hull]``: midship_coefficient, propellers, bulb, transom, static_trim.
    restoring : dict
        Section ``[restoring]``: waterplane_area, flotation, longitudinal_GM, at the scale of the ship.
    """

    ship: Ship
    hull: dict[str, Any] = field(default_factory=dict)
    restoring: dict[str, Any] = field(default_factory=dict)


def load_squat_ship(name: str) -> SquatShip:
    """Ship by name, or from a TOML file with ``[ship]`` and, if wanted, ``[hull]`` and ``[restoring]``.

    Raises
    ------
    TowtankError
        For an unknown name, a missing or wrong file, or an unknown key.
    """
    path = Path(name)
    if path.suffix.lower() != ".toml" and not path.exists():
        from ..simulate.ships import named_ship

        return SquatShip(_with_volume(named_ship(name).ship))
    from ..core.ship import Ship
    from ..formats.checked_toml import read_toml, validated_sections
    from ..squat.campaign_sections import HullFile, SquatHull, SquatRestoring

    data = read_toml(path, ReadError, what="TOML file with [ship]")
    if not isinstance(data.get("ship"), dict):
        raise ReadError("there is no section [ship]", cure="give name, L, B, T, volume there", file=path)
    given = validated_sections(
        HullFile,
        {key: data[key] for key in ("ship", "hull", "restoring") if key in data},
        path,
        ReadError,
        {"hull": SquatHull, "restoring": SquatRestoring},
    )
    try:
        ship = Ship.from_dict(given.ship)
    except (TowtankError, TypeError) as error:
        cause = error.cause if isinstance(error, TowtankError) else "a particular is not a number"
        cure = error.cure if isinstance(error, TowtankError) and error.cure else "complete or correct it, in SI"
        raise ReadError(cause, cure=cure, file=path, place="[ship]") from None
    return SquatShip(
        _with_volume(ship),
        given.hull.model_dump(),
        {} if given.restoring is None else given.restoring.model_dump(),
    )


def _with_volume(ship: Ship) -> Ship:
    """The displaced volume follows from the mass where only that is known."""
    if ship.volume is None and ship.mass is not None:
        return replace(ship, volume=ship.mass / ship.rho)
    return ship
