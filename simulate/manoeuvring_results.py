"""Several manoeuvres of one ship: tracks, indices, verdicts, and their uncertainty where there are draws."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..core.errors import SimulationError
from .criteria import imo_criteria
from .environment import Environment
from .manoeuvre_indices import event_indices, indices
from .manoeuvre_names import KINDS
from .parameter_scatter import HULL, MMG_COEFFICIENTS, value_of
from .programme import Programme
from .sailing import sail
from .steering_character import steering_frame
from .trajectory import Trajectory
from .vessel import Vessel

if TYPE_CHECKING:
    import pandas as pd

    from .ensembles import Ensemble

COLUMNS = ("manoeuvre", "index", "value", "unit", "sd", "p05", "p95")
"""Columns of the table of indices; the last three are NaN without draws."""


@dataclass(frozen=True, eq=False)
class ManoeuvringResults:
    """What a ship did in several manoeuvres.

    Attributes
    ----------
    vessel : Vessel
        At the speed of its approach.
    trajectories : tuple of Trajectory
        One a manoeuvre, with its events.
    environment : Environment or None
    ensemble : Ensemble or None
        The same manoeuvres with draws of the vessel's numbers.
    """

    vessel: Vessel
    trajectories: tuple[Trajectory, ...]
    environment: Environment | None = None
    ensemble: Ensemble | None = None

    def indices_frame(self) -> pd.DataFrame:
        """Every index: columns as `COLUMNS`, lengths in L; what did not occur is left out."""
        import pandas as pd

        parts = [indices(one, approach_speed=self.vessel.speed) for one in self.trajectories if _indexed(one)]
        names = ["manoeuvre", "index", "value", "unit"]
        frame = pd.concat(parts, ignore_index=True)[names] if parts else pd.DataFrame(columns=names)
        if self.ensemble is None:
            return frame.assign(sd=float("nan"), p05=float("nan"), p95=float("nan"))
        spread = self.ensemble.indices[["manoeuvre", "index", "sd", "p05", "p95"]]
        return frame.merge(spread, on=["manoeuvre", "index"], how="left")[list(COLUMNS)]

    def doubts(self) -> list[str]:
        """Sentences for what the results rest on beyond their data, each once."""
        said = [finding.message for one in self.trajectories for finding in one.provenance.findings]
        if self.environment is not None:
            said += self.environment.doubts(self.vessel.ship)
        return list(dict.fromkeys(said))

    def steering_frame(self) -> pd.DataFrame:
        """Course stability and Nomoto's indices; see :func:`~towtank.simulate.steering_character.steering_frame`."""
        return steering_frame(self.vessel, self.trajectories)

    def imo_frame(self) -> pd.DataFrame:
        """Verdicts of IMO resolution MSC.137(76); see :func:`~towtank.simulate.criteria.imo_criteria`.

        With draws the columns probability (share of the draws that pass), probability_se, margin_p05 and margin_p95
        are added.
        """
        found = {}
        for one in self.trajectories:
            if _indexed(one) and one.events is not None:
                values = event_indices(one.manoeuvre, one.events, one.ship, self.vessel.speed)
                found[one.manoeuvre] = {name: float(value[0]) for name, value in values.items()}
        table = imo_criteria(found, self.vessel.ship, self.vessel.speed)
        if self.ensemble is None:
            return table
        spread = self.ensemble.criteria[["criterion", "probability", "probability_se", "margin_p05", "margin_p95"]]
        notes = table.attrs.pop("notes")
        spread.attrs.clear()
        table = table.merge(spread, on="criterion", how="left")
        table.attrs["notes"] = notes
        return table


def _indexed(trajectory: Trajectory) -> bool:
    """True for a manoeuvre that has indices: not for course keeping and schedules."""
    return trajectory.manoeuvre.startswith(KINDS)


def sail_manoeuvres(
    vessel: Vessel,
    programmes: Sequence[Programme],
    *,
    environment: Environment | None = None,
    interval: float | None = None,
    draws: int = 0,
    percent: float | None = None,
    seed: int = 0,
    workers: int = 1,
    progress: Callable[[str, int, int], None] | None = None,
) -> ManoeuvringResults:
    """Sail several manoeuvres, each from the straight approach.

    Parameters
    ----------
    vessel : Vessel
    programmes : sequence of Programme
    environment : Environment, optional
    interval : float, optional
        Time between samples in s; 0.05 L/U0 when not given.
    draws : int
        Draws of the ensemble; 0 for none.
    percent : float, optional
        Independent scatter in per cent: of hull derivatives and of the coefficients of propeller and rudder, or, where
        the set has a covariance, which is drawn from then, of the latter alone.
    seed, workers : int
        Of the ensemble; see :func:`~towtank.simulate.ensembles.ensemble`.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    SimulationError
        For the first manoeuvre that cannot be sailed; for two of one name; for draws of a set without covariance
        and without percentage.
    """
    if draws == 0 and percent is not None:
        raise SimulationError("a scatter in per cent needs draws", cure="give a number of draws, e.g. 1000")
    scatter = None if draws == 0 else percentages(vessel, percent)
    names = [one.name for one in programmes]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise SimulationError(f"the manoeuvre '{twice}' is asked for twice", cure="name each manoeuvre once")
    sailed = []
    for number, programme in enumerate(programmes):
        if progress:
            progress("sailing", number, len(programmes))
        sailed.append(sail(vessel, programme, environment=environment, interval=interval))
    if progress:
        progress("sailing", len(programmes), len(programmes))
    drawn = [one for one in programmes if one.name.startswith(KINDS)]
    spread = None
    if draws != 0 and drawn:
        from .ensembles import ensemble

        spread = ensemble(
            vessel,
            drawn,
            draws,
            seed,
            percent=scatter,
            covariance=True if vessel.hull.covariance is not None else None,
            environment=environment,
            workers=workers,
            progress=progress,
        )
    return ManoeuvringResults(vessel, tuple(sailed), environment, spread)


def percentages(vessel: Vessel, percent: float | None) -> dict[str, float] | None:
    """Per cent by name, as an ensemble takes them: hull (where it has no covariance), propeller and rudder.

    Raises
    ------
    SimulationError
        When neither a covariance nor a percentage is given, or the percentage is not positive.
    """
    if percent is None:
        if vessel.hull.covariance is None:
            raise SimulationError(
                f"'{vessel.name}' has no covariance to draw from",
                cure="give a scatter in per cent too, e.g. 5 (--percent 5)",
            )
        return None
    if not percent > 0.0:
        raise SimulationError(f"a scatter of {percent:g} per cent is not positive", cure="give e.g. 5")
    known = vessel.parameter_names()
    beside = [name for name in MMG_COEFFICIENTS if name in known and value_of(vessel, name) != 0.0]
    return dict.fromkeys(beside if vessel.hull.covariance is not None else [HULL, *beside], percent)
