"""Work shared among processes: for what the interpreter lock would keep from running side by side."""

from __future__ import annotations

import multiprocessing
import sys
from collections import deque
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import cached_property
from itertools import islice
from typing import Any, TypeVar

from .errors import TowtankError

_BATCHES_AHEAD = 4
"""Batches a worker that are under way: enough to keep it busy, few enough to bound the memory."""

Item = TypeVar("Item")
Result = TypeVar("Result")


def can_fork() -> bool:
    """True where processes start as a copy of this one, with everything that it has loaded."""
    return sys.platform == "linux" and "fork" in multiprocessing.get_all_start_methods()


def in_processes(
    function: Callable[[Item], Result], items: Sequence[Item], workers: int, *, batch: int = 1
) -> Generator[Result, None, None]:
    """Results of ``function(item)`` in order, computed in `workers` processes that begin at once.

    Parameters
    ----------
    function : callable
        Where processes are forked it is inherited and may be anything; elsewhere it must be picklable.
    items : sequence
        Picklable, as are the results.
    workers : int
    batch : int
        Items that a process takes at a time.

    Raises
    ------
    TowtankError
        When a process was killed.
    Exception
        As raised by `function`.
    """
    if not can_fork():
        return _in_new_processes(function, items, workers, batch)
    context = multiprocessing.get_context("fork")
    executor = ProcessPoolExecutor(workers, mp_context=context, initializer=_adopt, initargs=(function,))
    batches = iter([items[start : start + batch] for start in range(0, len(items), batch)])
    waiting = deque(executor.submit(_apply, some) for some in islice(batches, _BATCHES_AHEAD * workers))
    return _collected(executor, batches, waiting)


def _collected(
    executor: ProcessPoolExecutor, batches: Iterator[Sequence[Item]], waiting: deque[Future[list[Any]]]
) -> Generator[Any, None, None]:
    try:
        while waiting:
            done = waiting.popleft().result()
            waiting.extend(executor.submit(_apply, some) for some in islice(batches, 1))
            yield from done
    except BrokenProcessPool:
        raise TowtankError(
            "a process that did part of the work was killed", cure="free memory, or use one worker"
        ) from None
    finally:
        executor.shutdown(wait=True, cancel_futures=True)


def _in_new_processes(
    function: Callable[[Item], Result], items: Sequence[Item], workers: int, batch: int
) -> Generator[Result, None, None]:
    from joblib import Parallel, delayed

    ahead = _BATCHES_AHEAD * batch * workers
    pool = Parallel(n_jobs=workers, return_as="generator", batch_size=batch, pre_dispatch=ahead)
    yield from pool(delayed(function)(item) for item in items)


class Later(Mapping[str, Any]):
    """A mapping that another process computes meanwhile; the first look at it waits.

    Parameters
    ----------
    function : callable
        Called without arguments in a copy of this process; what it returns must be picklable.

    Raises
    ------
    TowtankError
        At the first look, when the process was killed.
    Exception
        At the first look, as raised by `function`.
    """

    def __init__(self, function: Callable[[], Mapping[str, Any]]) -> None:
        self._results = in_processes(lambda _: function(), [None], 1)

    @cached_property
    def _mapping(self) -> Mapping[str, Any]:
        (mapping,) = self._results
        return mapping

    def __getitem__(self, key: str) -> Any:
        return self._mapping[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._mapping)

    def __len__(self) -> int:
        return len(self._mapping)


_function: Callable[[Any], Any]


def _adopt(function: Callable[[Any], Any]) -> None:
    global _function
    _function = function


def _apply(items: Sequence[Any]) -> list[Any]:
    return [_function(item) for item in items]
