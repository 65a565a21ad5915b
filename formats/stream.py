"""Runs read one after the other, a few at a time in the background."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from functools import partial
from typing import TypeVar

from ..core.errors import ReadError, TowtankError
from ..core.processes import in_processes

_BATCH = 8
"""Runs that a process takes at a time."""

Item = TypeVar("Item")
Result = TypeVar("Result")


def iter_records(
    paths: Iterable[Item],
    read_one: Callable[[Item], Result],
    *,
    workers: int = 2,
    processes: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[Result]:
    """Results of ``read_one(path)`` in the order of `paths`.

    At most ``2 * workers`` results are held at a time, so that memory does not grow with the number of runs. The
    parser of text tables works without the interpreter lock, so threads read in parallel. Closing the iterator
    early drops what has not been started.

    Parameters
    ----------
    paths : iterable
        Files, or anything that `read_one` takes.
    read_one : callable
        Reads one of them.
    workers : int
        Threads; with 1 or less the runs are read in the calling thread.
    processes : bool
        Use processes in place of threads: worth their start when there are hundreds of runs. `read_one` and its
        results must then be picklable; where processes cannot be forked they also take seconds to start.
    progress : callable, optional
        Called as ``progress(done, total)`` after each run that is handed out.

    Yields
    ------
    object
        What `read_one` returned.

    Raises
    ------
    TowtankError
        As raised by `read_one`, with the file added if it named none. Any other exception becomes a
        :class:`ReadError` that names the file.
    """
    items = list(paths)
    if workers <= 1:
        results = _in_turn(items, read_one)
    elif processes:
        results = in_processes(partial(_read, read_one), items, workers, batch=_BATCH)
    else:
        results = _ahead(items, read_one, workers)
    with closing(results):
        for done, result in enumerate(results, start=1):
            if progress is not None:
                progress(done, len(items))
            yield result
            # Not kept here while the next one is waited for.
            del result


def _in_turn(items: list[Item], read_one: Callable[[Item], Result]) -> Generator[Result, None, None]:
    for item in items:
        yield _read(read_one, item)


def _ahead(items: list[Item], read_one: Callable[[Item], Result], workers: int) -> Generator[Result, None, None]:
    pool = ThreadPoolExecutor(workers, thread_name_prefix="towtank-read")
    waiting: deque[Future[Result]] = deque()
    try:
        for item in items:
            waiting.append(pool.submit(_read, read_one, item))
            if len(waiting) >= 2 * workers:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _read(read_one: Callable[[Item], Result], item: Item) -> Result:
    try:
        return read_one(item)
    except TowtankError as error:
        if not error.file:
            error.file = str(item)
        raise
    except Exception as error:
        raise ReadError(
            f"cannot be read ({type(error).__name__}: {error})",
            cure="export the run again or leave it out",
            file=str(item),
        ) from error
