"""The manoeuvres that a campaign's ``[simulate]`` section asks for, sailed with the fitted sets."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, TowtankError
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


def check_simulate(settings: Simulate, file: Path) -> None:
    """Refuse manoeuvres, a ship and an environment file that do not exist, before a campaign is read.

    Raises
    ------
    CampaignError
        Naming the key.
    """
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
    if settings.environment is not None and not (file.parent / settings.environment).is_file():
        raise CampaignError(
            f"environment file '{settings.environment}' not found",
            cure="give its path from the folder of the campaign",
            file=file,
            place="key 'simulate.environment'",
        )


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
