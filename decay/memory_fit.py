"""Free decay with radiation memory fitted to records: inertia and restoring known, or free.

The equation is that of :mod:`.fluid_memory`, fitted by shooting as in :mod:`.integration_fit`. With an unknown inertia
the memory itself is the yardstick: radiation is known in SI, everything else per unit of inertia, so that a record in
which waves are weak cannot tell inertia and restoring at once.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from .damping_models import TERMS, DampingModel
from .decay_record import DecayRecord
from .fit_assessment import as_records, assess, require_speeds
from .fluid_memory import memory_state, simulate_memory_decay
from .integration_fit import Shooting, fit_integration, linearised, search
from .memory_damping import INERTIA, MemoryDamping, effective_inertia
from .resimulation import Simulated
from .transfer_function import TransferFunction

METHOD = "integration with memory"

_UNCERTAIN = 0.5
# A known inertia further than this factor from that of the period is an error of unit or scale.
_FAR = 2.0
_INERTIA_COLUMN = 9


class MemoryShooting(Shooting):
    """Shooting of several records with memory; the shared parameters are the free terms, and the inertia behind them.

    Parameters
    ----------
    records : sequence of DecayRecord
    model : DampingModel
    memory : TransferFunction
    inertia : float
        I + A_inf, known or the start of the search.
    restoring : float, optional
        C that is known while the inertia is not: c1 = C/inertia follows it and is no parameter of its own.
    free_inertia, offset : bool
    """

    def __init__(
        self,
        records: Sequence[DecayRecord],
        model: DampingModel,
        memory: TransferFunction,
        *,
        inertia: float,
        restoring: float | None,
        free_inertia: bool,
        offset: bool,
    ) -> None:
        super().__init__(records, model, "free", offset)
        self.memory, self.inertia = memory, inertia
        self.following = restoring if free_inertia else None
        self.free_inertia = free_inertia
        self.shared = len(self.names)
        self.histories = [_history(one, memory) for one in self.records]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the shared parameters."""
        return (*self.model.free, INERTIA) if self.free_inertia else self.model.free

    def inertia_of(self, parameters: np.ndarray) -> float:
        """I + A_inf at some parameters."""
        return float(parameters[self.shared - 1]) if self.free_inertia else self.inertia

    def coefficients(self, parameters: np.ndarray, record: int) -> np.ndarray:
        """b1 ... c5 per unit inertia at the speed of a record."""
        values = self.known.copy()
        values[self.free] = parameters[: len(self.free)]
        if self.following is not None:
            values[self.model.names.index("c1")] = self.following / self.inertia_of(parameters)
        return self.spread[record] @ values

    def simulate(self, parameters: np.ndarray, record: int) -> Simulated | None:
        """A record simulated with its gradients; None where the motion diverges or nothing restores."""
        values, inertia = self.coefficients(parameters, record), self.inertia_of(parameters)
        if not (np.isfinite(values).all() and values[3] > 0.0 and inertia > 0.0):
            return None
        x0, v0, rest = self.state(parameters, record)
        one = self.records[record]
        path = simulate_memory_decay(
            one.time,
            (x0, v0),
            dict(zip(TERMS, values.tolist())),
            self.memory,
            inertia,
            state=self.histories[record],
            curve=self.model.curve,
            sensitivities=True,
        )
        if not np.isfinite(path[-1]).all():
            return None
        gradient = np.empty((len(one), 10))
        gradient[:, :8] = path[:, 2:18:2]
        gradient[:, 8] = 1.0
        gradient[:, _INERTIA_COLUMN] = path[:, 18]
        if self.following is not None:
            gradient[:, _INERTIA_COLUMN] -= self.following / inertia**2 * gradient[:, 3]
        return Simulated(path[:, 0] + rest, path[:, 0], path[:, 1], gradient)

    def gradient(self, simulated: Simulated, record: int) -> np.ndarray:
        """Gradient of a record by the shared parameters and its own values, shape (n, q)."""
        terms = simulated.gradient[:, :6] @ self.spread[record][:, self.free]
        mass = simulated.gradient[:, [_INERTIA_COLUMN] if self.free_inertia else []]
        return np.hstack([terms, mass, simulated.gradient[:, self.own]])


def _history(record: DecayRecord, memory: TransferFunction) -> np.ndarray:
    """States of the memory at the first sample of a free part, from the record before it."""
    whole = record.whole
    if whole is None or not whole.time[0] < record.time[0]:
        return np.zeros(memory.order)
    rows = int(np.searchsorted(whole.time, record.time[0] - 0.5 * record.time_step)) + 1
    return memory_state(whole.time[:rows], whole.value[:rows], memory)


def fit_memory_decay(
    records: DecayRecord | Sequence[DecayRecord],
    memory: TransferFunction,
    model: DampingModel | None = None,
    *,
    inertia: float,
    restoring: float | None = None,
    free_inertia: bool = False,
    offset: bool = True,
) -> MemoryDamping:
    """Least squares of the simulated decay with memory on records.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts, centred. What stands before them in the whole record fills the memory; without it the ship was held
        at rest before the first sample.
    memory : TransferFunction
        Radiation of the same motion at the scale of the records, SI.
    model : DampingModel, optional
        Viscous and restoring terms; linear plus quadratic damping when not given.
    inertia : float
        I + A_inf in kg m2 (heave: kg), known, or the start of the search with `free_inertia`.
    restoring : float, optional
        Known C in N m/rad (heave: N/m); fitted when not given.
    free_inertia : bool
        Whether the inertia is fitted.
    offset : bool
        Whether a rest position is fitted to each record.

    Raises
    ------
    FitError
        For an inertia that is not positive, a model that fixes c1 beside `restoring`, or when no start leads to a
        motion that explains the records.
    """
    if not inertia > 0.0:
        raise FitError(f"the inertia {inertia:g} is not positive", cure="give I + A_inf in kg m2")
    runs = as_records(records)
    chosen = DampingModel() if model is None else model
    require_speeds(runs, chosen)
    if restoring is not None and "c1" in chosen.fixed:
        raise FitError("both the restoring moment and c1 are given", cure="give one of them")
    searched = chosen if restoring is None else chosen.with_fixed(c1=restoring / inertia)
    problem = MemoryShooting(
        runs,
        searched,
        memory,
        inertia=inertia,
        restoring=restoring,
        free_inertia=free_inertia,
        offset=offset,
    )
    start = _start(runs, chosen, memory, inertia, restoring, free_inertia)
    outcome = search(problem, problem.initial(start))
    if outcome is None:
        raise FitError(
            "from its start the motion with memory diverges",
            cure="check the inertia, and unit and scale of the table of radiation",
            file=runs[0].source or None,
            place=runs[0].name,
        )
    best, converged = outcome
    end = linearised(problem, best)
    mass = problem.inertia_of(best.parameters)
    found = dict(zip(problem.names, map(float, best.parameters)))
    values = {**searched.fixed, **found}
    if restoring is not None:
        values["c1"] = restoring / mass
    names = (*chosen.names, INERTIA)
    full = _full_covariance(end.covariance, problem.names, names, restoring, mass)
    count = len(chosen.names)
    places = [chosen.names.index(name) for name in chosen.free]
    draft = assess(
        METHOD,
        runs,
        replace(chosen, memory=f"memory of order {memory.order}"),
        {name: values[name] for name in chosen.free},
        full[np.ix_(places, places)],
        end.runs,
        end.noise,
        converged=converged,
        condition=end.condition,
        choices={
            "memory": f"order {memory.order}; filled by the record before the free part",
            INERTIA: "fitted" if free_inertia else "known",
            "restoring": "fitted" if restoring is None else "known",
        },
    )
    doubts = tuple(_doubts(found, np.sqrt(np.maximum(np.diagonal(end.covariance), 0.0)), problem.names))
    return MemoryDamping(
        **vars(draft)
        | {
            "names": names,
            "params": np.append(draft.params[:count], mass),
            "cov": full,
            "t_dof": np.full(len(names), draft.t_dof[0]),
            "diagnostics": replace(draft.diagnostics, findings=(*draft.diagnostics.findings, *doubts)),
            "memory": memory,
        },
    )


def _start(
    runs: Sequence[DecayRecord],
    model: DampingModel,
    memory: TransferFunction,
    inertia: float,
    restoring: float | None,
    free_inertia: bool,
) -> dict[str, float]:
    """Terms of the fit without memory, per unit of I + A_inf, less the waves at its frequency; and the inertia.

    A restoring moment that is known tells a free inertia by the period, and a known one must not contradict it.
    """
    free = replace(model, fixed={name: value for name, value in model.fixed.items() if name != "c1"})
    plain = fit_integration(runs, free, starts=2)
    rate = np.array([plain.omega_n])
    if restoring is not None:
        here = restoring / float(rate[0]) ** 2 - float(memory.added_mass_difference(rate)[0])
        if free_inertia and here > 0.0:
            inertia = here
        elif not inertia / _FAR < here < inertia * _FAR:
            raise FitError(
                f"the restoring moment {restoring:.4g} and the period {2.0 * math.pi / float(rate[0]):.4g} s of the "
                f"record ask for an inertia I + A_inf of {here:.4g}, {inertia:.4g} is given",
                cure="check the units and scale of inertia, restoring and the table of radiation, or free the inertia",
                file=runs[0].source or None,
                place=runs[0].name,
            )
    share = float(effective_inertia(memory, rate, inertia)[0])
    start = {name: share * float(value) for name, value in zip(plain.names, plain.params)}
    if "b1" in start:
        start["b1"] = max(start["b1"] - float(memory.damping(rate)[0]) / inertia, 1e-3 * start["b1"])
    return start | {INERTIA: inertia}


def _full_covariance(
    covariance: np.ndarray,
    searched: Sequence[str],
    names: Sequence[str],
    restoring: float | None,
    inertia: float,
) -> np.ndarray:
    """Covariance of all names; c1 = C/inertia moves with the inertia when the restoring moment is known."""
    spread = np.zeros((len(names), len(searched)))
    for column, name in enumerate(searched):
        spread[names.index(name), column] = 1.0
    if restoring is not None and INERTIA in searched:
        spread[names.index("c1"), list(searched).index(INERTIA)] = -restoring / inertia**2
    return spread @ covariance @ spread.T


def _doubts(values: Mapping[str, float], sd: np.ndarray, names: Sequence[str]) -> Iterator[Finding]:
    for name, error in zip(names, sd):
        if name in ("c1", INERTIA) and error > _UNCERTAIN * abs(values[name]):
            yield Finding(
                "not-identified",
                "warning",
                f"{name} = {values[name]:.4g} with a standard error of {error:.2g}: the record does not determine it",
                place=name,
                cure="fix it, or compare equivalent damping instead of single terms",
            )
