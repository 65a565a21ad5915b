"""Ensembles: manoeuvres of many draws of a vessel's numbers, and how uncertain its indices are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import SimulationError
from ..core.findings import Finding
from ..core.provenance import Provenance, program_versions
from .criteria import imo_criteria, length_over_speed, margins, pass_probability
from .elasticities import elasticity_table
from .ensemble_table import index_statistics
from .first_order import FirstOrder, propagate
from .fitted_vessel import vessel_from_set
from .manoeuvre_indices import event_indices
from .manoeuvre_names import read_manoeuvre_name
from .named_programmes import named_programme
from .parameter_scatter import ParameterScatter, scatter_of, vessel_of_draw
from .programme import Programme
from .random_draws import Sampling
from .sailed_batches import COMPLETED, Progress, Voyage, sail_batches
from .sailing import DRAW_TOLERANCE, sail
from .track_fan import TrackFan, sail_fan
from .vessel import Vessel

if TYPE_CHECKING:
    import pandas as pd

    from .environment import Environment

FloatArray = np.ndarray


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Indices of many draws of a vessel.

    Attributes
    ----------
    vessel : Vessel
        Unperturbed.
    programmes : tuple of Programme
    scatter : ParameterScatter
        What was drawn from.
    parameters : ndarray, shape (draws, p)
        The draws, in the order of ``scatter.names``.
    values : mapping of str to mapping of str to ndarray, shape (draws,)
        Manoeuvre -> index -> value of each draw, in the units of the index table; NaN where the draw did not
        complete the manoeuvre.
    unperturbed : mapping of str to mapping of str to float
        The same of the unperturbed vessel.
    endings : mapping of str to ndarray of str, shape (draws,)
        Manoeuvre -> ``completed``, or why the draw failed.
    rates : ndarray, shape (draws,)
        Propeller rate of the approach of each draw in 1/s.
    environment : Environment or None
    provenance : Provenance
        ``choices`` tells seed, sampling and scatter; ``findings`` the draws that failed and the ranges of validity
        that the unperturbed vessel leaves.
    """

    vessel: Vessel
    programmes: tuple[Programme, ...]
    scatter: ParameterScatter
    parameters: FloatArray
    values: Mapping[str, Mapping[str, FloatArray]]
    unperturbed: Mapping[str, Mapping[str, float]]
    endings: Mapping[str, np.ndarray]
    rates: FloatArray
    environment: Environment | None = None
    provenance: Provenance = field(default_factory=Provenance)

    @property
    def draws(self) -> int:
        """Number of draws."""
        return len(self.parameters)

    @property
    def manoeuvres(self) -> tuple[str, ...]:
        """Names of the manoeuvres, as in the tables."""
        return tuple(self.values)

    @cached_property
    def indices(self) -> pd.DataFrame:
        """Statistics of the indices over the draws that completed the manoeuvre.

        Columns manoeuvre, index, value (of the unperturbed vessel), unit, sd, p05, p95, mean, p50, draws (with a
        value). Without failed draws `draws` is the size of the ensemble.
        """
        return index_statistics(self.values, self.unperturbed)

    @cached_property
    def criteria(self) -> pd.DataFrame:
        """Criteria of IMO resolution MSC.137(76) that were tested.

        Columns as :func:`~towtank.simulate.criteria.imo_criteria` has them for the unperturbed vessel, and
        probability (share of all draws that pass; one that fails to complete the manoeuvre does not pass),
        probability_se (its standard error), margin_p05 and margin_p95 (quantiles of the margin over the draws that
        completed it).
        """
        ship, speed = self.vessel.ship, self.vessel.speed
        table = imo_criteria(self.unperturbed, ship, speed)
        notes = table.attrs["notes"]
        table = table[table["verdict"] != "not tested"].reset_index(drop=True)
        shares = pass_probability(self.values, ship, speed)
        ratio = length_over_speed(ship, speed)
        tested = margins(self.values, ship, speed)
        share = np.array([shares[name] for name in table["criterion"]])
        table["probability"] = share
        table["probability_se"] = np.sqrt(share * (1.0 - share) / self.draws)
        for column, quantile in (("margin_p05", 0.95), ("margin_p95", 0.05)):
            table[column] = [
                tested[name][0].limit(ratio) - _quantile(tested[name][1], quantile) for name in table["criterion"]
            ]
        table.attrs["notes"] = notes
        return table

    @cached_property
    def failures(self) -> pd.DataFrame:
        """Draws that did not complete a manoeuvre: columns manoeuvre, reason, draws, share. Empty when all did."""
        import pandas as pd

        rows = []
        for manoeuvre, endings in self.endings.items():
            reasons, counts = np.unique(endings[endings != COMPLETED].astype(str), return_counts=True)
            rows += [
                (manoeuvre, str(reason), int(count), count / self.draws)
                for reason, count in zip(reasons, counts, strict=True)
            ]
        return pd.DataFrame(rows, columns=["manoeuvre", "reason", "draws", "share"])

    @cached_property
    def raw(self) -> pd.DataFrame:
        """Every draw: a row a draw; columns of pairs, (``"parameter"``, name) and (manoeuvre, index)."""
        import pandas as pd

        columns = {
            ("parameter", name): self.parameters[:, column] for column, name in enumerate(self.scatter.names)
        }
        for manoeuvre, values in self.values.items():
            columns |= {(manoeuvre, index): value for index, value in values.items()}
        return pd.DataFrame(columns).rename_axis("draw")

    @cached_property
    def first_order(self) -> FirstOrder:
        """First-order propagation of the same scatter, by central differences."""
        return propagate(self.vessel, self.programmes, self.scatter, environment=self.environment)

    @cached_property
    def elasticities(self) -> pd.DataFrame:
        """Which number drives which index.

        Columns manoeuvre, index, parameter, elasticity (per cent of the index per per cent of the parameter, by
        regression over the draws), standard_error, share (of the variance of the index; may be negative with
        correlated parameters, adds up to what the regression explains), first_order (elasticity at the unperturbed
        vessel, by central differences).
        """
        return elasticity_table(
            self.values, self.unperturbed, self.scatter, self.parameters, self.first_order.elasticities
        )

    @cached_property
    def comparison(self) -> pd.DataFrame:
        """Monte Carlo beside first order.

        Columns manoeuvre, index, unit, sd, sd_first_order, difference_pct (first order less Monte Carlo, of the
        latter), mean_shift (mean of the draws less the unperturbed value: what a first order cannot see).
        """
        return self.first_order.beside(self.indices)

    def quantile(self, manoeuvre: str, index: str, q: float | Sequence[float]) -> float | FloatArray:
        """Quantiles of one index over the draws that completed the manoeuvre."""
        found = np.nanquantile(self.draws_of(manoeuvre, index), q)
        return float(found) if np.ndim(found) == 0 else found

    def draws_of(self, manoeuvre: str, index: str) -> FloatArray:
        """Values of one index, shape (draws,).

        Raises
        ------
        SimulationError
            For a manoeuvre that was not sailed, or an index that it does not have.
        """
        if index not in self.values[self._known(manoeuvre)]:
            known = ", ".join(self.values[manoeuvre])
            raise SimulationError(f"{manoeuvre} has no index '{index}'", cure=f"it has {known}")
        return self.values[manoeuvre][index]

    def vessel_of(self, draw: int) -> Vessel:
        """The vessel of one draw."""
        return vessel_of_draw(self.vessel, self.scatter.names, self.parameters[draw])

    def fan(self, manoeuvre: str, tracks: int = 60) -> TrackFan:
        """Tracks of the unperturbed vessel and of some draws, spread evenly over those that completed it.

        Parameters
        ----------
        manoeuvre : str
            One of :attr:`manoeuvres`.
        tracks : int
            Largest number of draws.
        """
        completed = np.flatnonzero(self.endings[self._known(manoeuvre)] == COMPLETED)
        spread = np.linspace(0, len(completed) - 1, min(tracks, len(completed))).round().astype(int)
        numbers = completed[np.unique(spread)] if len(completed) else completed
        programme = next(p for p in self.programmes if p.name == manoeuvre)
        vessels = [self.vessel_of(int(number)) for number in numbers]
        return sail_fan(self.vessel, programme, vessels, numbers, environment=self.environment)

    def _known(self, manoeuvre: str) -> str:
        if manoeuvre not in self.values:
            raise SimulationError(
                f"the ensemble has not sailed '{manoeuvre}'", cure=f"it has sailed {', '.join(self.values)}"
            )
        return manoeuvre


def ensemble(
    vessel: Vessel | DerivativeSet,
    manoeuvres: Sequence[Programme | str] | Programme | str,
    n: int = 1000,
    seed: int = 0,
    *,
    covariance: FloatArray | bool | None = None,
    percent: float | Mapping[str, float] | None = None,
    names: Sequence[str] | None = None,
    sampling: Sampling = "random",
    like: str | Vessel | None = None,
    environment: Environment | None = None,
    tolerance: float = DRAW_TOLERANCE,
    workers: int = 1,
    backend: str | None = None,
    progress: Progress | None = None,
) -> Ensemble:
    """Sail manoeuvres with many draws of a vessel's numbers.

    Parameters
    ----------
    vessel : Vessel or DerivativeSet
        A set is completed by :func:`~towtank.simulate.fitted_vessel.vessel_from_set`. Where the vessel has no
        propeller rate, each draw approaches with that of its own self-propulsion point; ``vessel.but(rate=...)``
        keeps one for all.
    manoeuvres : Programme or str, or a sequence of them
        From :mod:`towtank.simulate.manoeuvres`, or names such as ``"turning 35"``, ``"zigzag 10/10"``.
    n : int
        Number of draws.
    seed : int
        The same seed gives the same draws and the same result to the last bit, however many workers there are.
    covariance, percent, names
        What scatters: the covariance of the hull derivatives (default: that of the set), independent percentages of
        named numbers, or both; see :func:`~towtank.simulate.parameter_scatter.scatter_of`.
    sampling : {"random", "antithetic", "latin hypercube"}
        See :func:`~towtank.simulate.random_draws.standard_normals`.
    like : str or Vessel, optional
        Ship from which a set takes what it lacks.
    environment : Environment, optional
        Current, wind and waves; none when not given.
    tolerance : float
        Error allowed in a step of a draw, in units of L, U0 and rad.
    workers : int
        Threads; or processes with ``backend="loky"``. The same call runs on a cluster with ``backend="dask"``, or
        within ``joblib.parallel_config("dask")``.
    backend : str, optional
        One of joblib's.
    progress : callable, optional
        ``progress(what, done, total)``, in draws.

    Raises
    ------
    SimulationError
        When the unperturbed vessel fails a manoeuvre, nothing scatters, or draws are lost. Draws that fail are
        counted in the result.
    """
    if isinstance(vessel, DerivativeSet):
        vessel = vessel_from_set(vessel, like=like)
    if n < 2:
        raise SimulationError(f"an ensemble of {n} draws has no spread", cure="take n = 1000 or more")
    programmes = _programmes(manoeuvres, vessel)
    scatter = scatter_of(vessel, covariance=covariance, percent=percent, names=names)
    unperturbed: dict[str, dict[str, float]] = {}
    findings: list[Finding] = []
    for programme in programmes:
        trajectory = sail(vessel, programme, environment=environment)
        assert trajectory.events is not None
        found = event_indices(programme.name, trajectory.events, vessel.ship, vessel.speed)
        unperturbed[programme.name] = {index: float(value[0]) for index, value in found.items()}
        findings += [item for item in trajectory.provenance.findings if item not in findings]
    parameters = scatter.draws(n, seed, sampling)
    sailed = sail_batches(
        Voyage(vessel, programmes, scatter.names, environment, tolerance),
        parameters,
        workers=workers,
        backend=backend,
        progress=progress,
    )
    choices = {
        "draws": n,
        "seed": seed,
        "sampling": sampling,
        "scatter": scatter.source,
        "tolerance": tolerance,
        "propeller rate": "of each draw's self-propulsion point" if vessel.rate is None else vessel.rate,
        "manoeuvres": ", ".join(programme.name for programme in programmes),
    }
    return Ensemble(
        vessel=vessel,
        programmes=programmes,
        scatter=scatter,
        parameters=parameters,
        values=sailed.values,
        unperturbed=unperturbed,
        endings=sailed.endings,
        rates=sailed.rates,
        environment=environment,
        provenance=Provenance(
            source=vessel.hull.provenance.source,
            choices=choices,
            findings=(*findings, *_failure_findings(sailed.endings, n)),
            misprints=vessel.hull.provenance.misprints,
            versions=program_versions(),
        ),
    )


def _programmes(manoeuvres: Sequence[Programme | str] | Programme | str, vessel: Vessel) -> tuple[Programme, ...]:
    """Programmes of manoeuvres that have indices, each once."""
    given = [manoeuvres] if isinstance(manoeuvres, Programme | str) else list(manoeuvres)
    tick = vessel.ship.L / vessel.speed
    found = tuple(named_programme(item, tick) if isinstance(item, str) else item for item in given)
    known = [programme.name for programme in found]
    for name in known:
        read_manoeuvre_name(name)
        if known.count(name) > 1:
            raise SimulationError(f"'{name}' is among the manoeuvres twice", cure="name each once")
    if not found:
        raise SimulationError("an ensemble needs a manoeuvre", cure="give e.g. ['turning 35', 'zigzag 10/10']")
    return found


def _failure_findings(endings: Mapping[str, np.ndarray], n: int) -> list[Finding]:
    found = []
    for manoeuvre, reasons in endings.items():
        failed = reasons[reasons != COMPLETED].astype(str)
        for reason in np.unique(failed):
            found.append(
                Finding(
                    "failed-draws",
                    "warning",
                    f"{manoeuvre}: {np.sum(failed == reason)} of {n} draws have no indices: {reason}",
                    cure="statistics are of the others; narrow the scatter, or read them as conditional",
                )
            )
    return found


def _quantile(values: FloatArray, q: float) -> float:
    known = values[np.isfinite(values)]
    return float(np.quantile(known, q)) if len(known) else float("nan")
