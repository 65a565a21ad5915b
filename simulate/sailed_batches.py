"""Manoeuvres of many draws in batches: in turn, in threads, in processes, or on a Dask cluster."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import BrokenExecutor, CancelledError
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import SimulationError
from .manoeuvre_indices import event_indices
from .parameter_scatter import split_draws
from .programme import Programme
from .sailing import DRAW_TOLERANCE, sail_events, status_in_words
from .vessel import Vessel

if TYPE_CHECKING:
    from joblib import Parallel

    from .environment import Environment

FloatArray = np.ndarray
Progress = Callable[[str, int, int], None]

BATCH = 250
"""Draws of a batch: about a tenth of a second of work. It does not depend on the number of workers, so that the
rounding of a draw does not either."""

COMPLETED = status_in_words(0)

NO_RATE = "there is no self-propulsion point"

_ROUNDS = 3
"""How often batches are given out that killed workers do not bring back."""


@dataclass(frozen=True, eq=False)
class Voyage:
    """What every draw sails.

    Attributes
    ----------
    vessel : Vessel
    programmes : tuple of Programme
    names : tuple of str
        Numbers of the vessel that the draws change.
    environment : Environment or None
    tolerance : float
        Error allowed in a step.
    """

    vessel: Vessel
    programmes: tuple[Programme, ...]
    names: tuple[str, ...]
    environment: Environment | None = None
    tolerance: float = DRAW_TOLERANCE


@dataclass(frozen=True, eq=False)
class SailedIndices:
    """Indices of many draws.

    Attributes
    ----------
    values : mapping of str to mapping of str to ndarray, shape (draws,)
        Manoeuvre -> index -> values; NaN where a draw did not complete the manoeuvre.
    endings : mapping of str to ndarray of str, shape (draws,)
        Manoeuvre -> ``completed``, or why a draw failed.
    rates : ndarray, shape (draws,)
        Propeller rate of the approach in 1/s.
    """

    values: Mapping[str, Mapping[str, FloatArray]]
    endings: Mapping[str, np.ndarray]
    rates: FloatArray


@dataclass(frozen=True, eq=False)
class _Batch:
    """Draws from number `first` on, with what they sail.

    One object, because Dask puts large arrays that are arguments on one worker and cannot bring them back when that
    worker dies.
    """

    voyage: Voyage
    first: int
    rows: FloatArray


def sail_rows(voyage: Voyage, rows: FloatArray) -> SailedIndices:
    """Sail all manoeuvres with each draw, shape (draws, p)."""
    hull, beside = split_draws(voyage.vessel, voyage.names, rows)
    values: dict[str, dict[str, FloatArray]] = {}
    endings: dict[str, np.ndarray] = {}
    rates = np.full(len(rows), np.nan)
    for programme in voyage.programmes:
        sailed = sail_events(
            voyage.vessel,
            programme,
            hull,
            beside,
            environment=voyage.environment,
            tolerance=voyage.tolerance,
        )
        rates = sailed.rates
        ending = np.array([status_in_words(status) for status in sailed.status.tolist()], dtype=object)
        ending[np.isnan(rates)] = NO_RATE
        found = event_indices(programme.name, sailed.events, voyage.vessel.ship, voyage.vessel.speed)
        good = ending == COMPLETED
        values[programme.name] = {name: np.where(good, value, np.nan) for name, value in found.items()}
        endings[programme.name] = ending
    return SailedIndices(values, endings, rates)


def sail_batches(
    voyage: Voyage,
    rows: FloatArray,
    *,
    workers: int = 1,
    backend: str | None = None,
    progress: Progress | None = None,
    batch: int = BATCH,
) -> SailedIndices:
    """As :func:`sail_rows`, shared among workers; the result is the same to the last bit.

    Parameters
    ----------
    voyage : Voyage
    rows : ndarray, shape (draws, p)
    workers : int
        Threads, or what `backend` says; 1 sails the batches in turn, unless ``joblib.parallel_config`` is in force.
    backend : str, optional
        One of joblib's: ``"threading"`` (default), ``"loky"`` for processes, ``"dask"`` for the workers of the
        current ``dask.distributed.Client``; a cluster that has lost its workers is waited for.
    progress : callable, optional
        ``progress(what, done, total)``, in draws.
    batch : int
        Draws that a worker takes at a time.

    Raises
    ------
    SimulationError
        When the cluster does not bring all batches back, or there is none.
    """
    draws = len(rows)
    firsts = range(0, draws, batch)
    found: dict[int, SailedIndices] = {}
    done = 0
    fault = "they were lost"
    for _ in range(_ROUNDS):
        waiting = [_Batch(voyage, first, rows[first : first + batch]) for first in firsts if first not in found]
        if not waiting:
            break
        try:
            for first, part in _in_parallel(waiting, workers, backend):
                if first in found:
                    continue
                found[first] = part
                done += len(part.rates)
                if progress is not None:
                    progress("sailing", done, draws)
        except _killed() as error:
            fault = f"{type(error).__name__} {error}"
    if done != draws:
        raise SimulationError(
            f"{draws - done} of {draws} draws did not come back from the workers: {fault}",
            cure="free memory, see the log of the cluster, or take fewer workers",
        )
    return _joined([found[first] for first in firsts])


def _sail_batch(batch: _Batch) -> tuple[int, SailedIndices]:
    return batch.first, sail_rows(batch.voyage, batch.rows)


def _in_parallel(batches: list[_Batch], workers: int, backend: str | None) -> Iterator[tuple[int, SailedIndices]]:
    """Results in the order in which they come."""
    from joblib import delayed
    from joblib.parallel import ThreadingBackend, get_active_backend

    in_force, jobs = get_active_backend(prefer="threads")
    if workers == 1 and backend is None and jobs == 1 and isinstance(in_force, ThreadingBackend):
        yield from map(_sail_batch, batches)
        return
    pool = _pool(workers, backend)
    for item in pool(delayed(_sail_batch)(batch) for batch in batches):
        # a backend that gives up a batch may hand over the fault in its place
        if isinstance(item, tuple):
            yield item


def _pool(workers: int, backend: str | None) -> Parallel:
    from contextlib import nullcontext

    from joblib import Parallel, parallel_config

    jobs = None if workers == 1 else workers
    try:
        with nullcontext() if backend is None else parallel_config(backend):
            # in the order of completion: a batch that begins anew elsewhere holds up no other
            return Parallel(jobs, prefer="threads", return_as="generator_unordered", batch_size=1)
    except ValueError as error:
        raise SimulationError(
            f"the backend '{backend}' cannot be used: {' '.join(str(error).split())}",
            cure="use threading or loky; for dask install towtank[cluster] and create a dask.distributed.Client",
        ) from error


def _killed() -> tuple[type[BaseException], ...]:
    """Errors that tell of a worker that was killed; its batches can be sailed again."""
    kinds: tuple[type[BaseException], ...] = (BrokenExecutor, CancelledError)
    if "distributed" in sys.modules:
        from distributed import KilledWorker

        kinds += (KilledWorker,)
    return kinds


def _joined(parts: list[SailedIndices]) -> SailedIndices:
    first = parts[0]
    return SailedIndices(
        {
            manoeuvre: {
                index: np.concatenate([part.values[manoeuvre][index] for part in parts]) for index in values
            }
            for manoeuvre, values in first.values.items()
        },
        {manoeuvre: np.concatenate([part.endings[manoeuvre] for part in parts]) for manoeuvre in first.endings},
        np.concatenate([part.rates for part in parts]),
    )
