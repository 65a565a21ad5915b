"""What a user may name where a ship is to be sailed: a named ship, or a derivative set with the fittings of one."""

from __future__ import annotations

import math
from contextlib import suppress
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.errors import DatasetError, ReadError, TowtankError
from .derivative_source import load_derivatives

if TYPE_CHECKING:
    from ..simulate.vessel import Vessel


def load_vessel(name: str, *, ship_from: str | None = None, speed: float | None = None) -> Vessel:
    """Vessel from a named ship, from a set's file or results folder, or from the key of a published set.

    Parameters
    ----------
    name : str
        Of a ship, of a file or folder, or of a published set.
    ship_from : str, optional
        Named ship that lends propeller, rudder and steering gear to a set.
    speed : float, optional
        Approach speed in m/s.

    Raises
    ------
    TowtankError
        When nothing has this name, with the nearest ones; when the set lacks what it needs to be sailed.
    """
    from ..simulate.fitted_vessel import vessel_from_set
    from ..simulate.ships import named_ship, named_ships

    if speed is not None and not 0.0 < speed < math.inf:
        raise TowtankError(
            f"the approach speed {speed:g} m/s is not positive", cure="give --speed in m/s, above 0"
        )
    path = Path(name)
    is_file = path.exists() or path.suffix.lower() in (".json", ".csv")
    if not is_file:
        if ship_from is None:
            with suppress(DatasetError):
                vessel = named_ship(name)
                return vessel if speed is None else vessel.but(speed=speed)
        _require_name(name)
    try:
        derivatives = load_derivatives(name)
        return vessel_from_set(derivatives, like=ship_from, speed=speed)
    except TowtankError as error:
        if ship_from is None and "cannot be sailed" in error.cause:
            raise ReadError(
                error.cause,
                cure=f"name a ship that lends its fittings: --ship-from {next(iter(named_ships()))}"
                " (see: towtank simulate --list)",
                file=name if is_file else None,
            ) from None
        raise


def _require_name(name: str) -> None:
    """An error with the nearest names when `name` is neither a ship nor a published set."""
    from ..datasets import list_sets
    from ..simulate.ships import named_ships

    sets = [str(key) for key in list_sets()["key"]]
    if name in sets:
        return
    known = [*named_ships(), *sets]
    close = get_close_matches(name.lower(), known, n=4, cutoff=0.4)
    cure = f"did you mean {', '.join(dict.fromkeys(close))}" if close else "see: towtank simulate --list"
    raise ReadError(f"'{name}' is neither a ship, a file nor a published set", cure=cure)
