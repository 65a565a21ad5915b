"""The manoeuvres that a campaign's ``[simulate]`` section asks for, sailed with the fitted sets."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, TowtankError
from ..core.ship import Ship
from ..pmm.campaign_file import Simulate

if TYPE_CHECKING:
    from ..pmm.campaign_result import CampaignResult
    from ..simulate.manoeuvring_results import ManoeuvringResults

Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, eq=False)
class SailedSet:
    """The manoeuvres of one fitted set, or why it cannot be sailed.

    Attributes
    ----------
    label, name : str
        Of the group of runs, and of the set.
    results : ManoeuvringResults or None
    cause : str
        Why there are none.
    """

    label: str
    name: str
    results: ManoeuvringResults | None
    cause: str = ""


def check_simulate(settings: Simulate, file: Path, ship: Ship | None = None) -> None:
    """Refuse manoeuvres, a ship and an environment that do not exist or cannot be, before a campaign is read.

    Parameters
    ----------
    settings : Simulate
    file : Path
        The campaign file.
    ship : Ship, optional
        Of the campaign; the environment file is read for it.

    Raises
    ------
    CampaignError
        Naming the key.
    TowtankError
        For a fault inside the environment file.
    """
    from ..simulate.environment_file import read_environment
    from ..simulate.named_programmes import named_programme
    from ..simulate.ships import named_ship

    for key, values, look in (
        ("manoeuvres", settings.manoeuvres, lambda name: named_programme(name, 1.0)),
        ("ship_from", [settings.ship_from] if settings.ship_from else [], named_ship),
    ):
        for value in values:
            try:
                look(value)
            except TowtankError as error:
                raise CampaignError(
                    error.cause, cure=error.cure, file=file, place=f"key 'simulate.{key}'"
                ) from None
    _check_orders(settings, file)
    if settings.environment is not None and not (file.parent / settings.environment).is_file():
        raise CampaignError(
            f"environment file '{settings.environment}' not found",
            cure="give its path from the folder of the campaign",
            file=file,
            place="key 'simulate.environment'",
        )
    if settings.environment is not None and ship is not None:
        with warnings.catch_warnings():
            # what the environment doubts is in the results
            warnings.simplefilter("ignore")
            read_environment(file.parent / settings.environment, ship)


def _check_orders(settings: Simulate, file: Path) -> None:
    """Refuse a single draw, a manoeuvre that is named twice, and a rudder angle beyond the gear of the lender."""
    from ..simulate.named_programmes import named_programme
    from ..simulate.ships import named_ship

    if settings.draws == 1:
        raise CampaignError(
            "one draw has no spread",
            cure="give 200 or more, or 0 for none",
            file=file,
            place="key 'simulate.draws'",
        )
    programmes = [named_programme(name, 1.0) for name in settings.manoeuvres]
    limit = named_ship(settings.ship_from).gear.limit if settings.ship_from else math.inf
    names = [one.name for one in programmes]
    for one in programmes:
        cause, cure = "", "name each manoeuvre once"
        if names.count(one.name) > 1:
            cause = f"'{one.name}' is asked for twice"
        elif one.largest_rudder() > limit * (1.0 + 1e-9):
            cause = (
                f"the gear of '{settings.ship_from}' stops at {math.degrees(limit):.4g} deg, short of '{one.name}'"
            )
            cure = "order less"
        if cause:
            raise CampaignError(cause, cure=cure, file=file, place="key 'simulate.manoeuvres'")


def sail_campaign(result: CampaignResult, progress: Progress | None = None) -> list[SailedSet]:
    """Sail the sets of a campaign as its ``[simulate]`` section says; empty without that section.

    A set that cannot be sailed, or that does not complete a manoeuvre, is told with its cause: the campaign itself
    is not at fault.
    """
    settings = result.settings.simulate
    if settings is None:
        return []
    sailed = []
    for fit in result.fits:
        name = fit.derivatives.name
        try:
            with warnings.catch_warnings():
                # what the environment doubts is in the results
                warnings.simplefilter("ignore")
                found = _sail(fit.derivatives, settings, result.path, progress)
            sailed.append(SailedSet(fit.label, name, found))
        except TowtankError as error:
            sailed.append(SailedSet(fit.label, name, None, str(error)))
    return sailed


def sailed_text(sailed: list[SailedSet]) -> str:
    """What the sets of a campaign did, as lines for a terminal: verdicts, doubts, and why a set was not sailed."""
    from .manoeuvre_outputs import verdict_blocks

    blocks = []
    for one in sailed:
        if one.results is None:
            blocks.append(f"'{one.name}' was not sailed: {one.cause}")
            continue
        names = ", ".join(trajectory.manoeuvre for trajectory in one.results.trajectories)
        draws = "" if one.results.ensemble is None else f", {one.results.ensemble.draws} draws"
        blocks += [f"'{one.name}' was sailed{draws}: {names}", *verdict_blocks(one.results)]
    return "\n\n".join(blocks)


def sailed_provenance(sailed: list[SailedSet]) -> list[dict[str, Any]]:
    """Where the numbers of the manoeuvres come from, a mapping a set, as plain data."""
    from .manoeuvre_outputs import manoeuvres_provenance

    return [
        {"label": one.label, "not sailed": one.cause}
        if one.results is None
        else {"label": one.label} | _apart_from_the_campaign(manoeuvres_provenance(one.results))
        for one in sailed
    ]


def _apart_from_the_campaign(found: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in found.items() if name not in ("format", "created", "versions")}


def _sail(
    derivatives: DerivativeSet, settings: Simulate, file: Path, progress: Progress | None
) -> ManoeuvringResults:
    from ..simulate.environment_file import read_environment
    from ..simulate.fitted_vessel import vessel_from_set
    from ..simulate.manoeuvring_results import sail_manoeuvres
    from ..simulate.named_programmes import IMO_SET, named_programme

    vessel = vessel_from_set(derivatives, like=settings.ship_from, speed=settings.speed)
    tick = vessel.ship.L / vessel.speed
    surroundings = None
    if settings.environment is not None:
        surroundings = read_environment(file.parent / settings.environment, vessel.ship)
    return sail_manoeuvres(
        vessel,
        [named_programme(name, tick) for name in settings.manoeuvres or IMO_SET],
        environment=surroundings,
        draws=settings.draws,
        percent=settings.percent,
        seed=settings.seed,
        progress=progress,
    )
