"""Which run of an OpenFOAM case is the newest: usually the one with the latest start time, but not after a rerun.

Each run writes into a folder named after its start time. A case that is run again from an earlier time leaves the later
folders of the run before in place; joined by start time, their rows would stand behind those of the new run.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .log_index import first_index, last_index
from .log_layout import LogLayout

SURELY_LATER = 60.0
"""Seconds between two modification times that copying or unpacking a case does not explain."""

_WORTH_TELLING = 2.0
_GAP = 10.0
"""Steps between the end of a run and the start of the next that a restart does not leave."""


_NEWER = "is newer than run"


def tells_run_order(note: str) -> bool:
    """Whether a note of a history is about runs whose order is not that of their start times."""
    return _NEWER in note


class _Run(NamedTuple):
    file: Path
    layout: LogLayout
    written: float
    first: float
    last: float
    step: float

    @property
    def folder(self) -> str:
        return self.file.parent.name

    def follows(self, earlier: _Run) -> bool:
        """Whether this run begins where the earlier one ends, as a restart without overlap does."""
        reach = _GAP * max(self.step, earlier.step)
        return earlier.last - 0.5 * earlier.step <= self.first <= earlier.last + reach


def in_run_order(
    files: Sequence[tuple[Path, LogLayout]],
) -> tuple[list[tuple[Path, LogLayout]], tuple[str, ...]]:
    """Files of a history from the oldest run to the newest.

    By start time, as they are given, unless a run that starts earlier was written later by more than
    :data:`SURELY_LATER` and its times contradict a restart: it reaches into the other run, or stops long before it.
    Then the runs are ordered by the time of their last writing, so that the newer run wins.

    Parameters
    ----------
    files : sequence of (Path, LogLayout)
        In the order of their start times.

    Returns
    -------
    files : list of (Path, LogLayout)
    notes : tuple of str
        Which folder was left behind, or that the order is doubtful, by the names of the folders.
    """
    whole = list(files)
    if len(whole) < 2:
        return whole, ()
    written = [path.stat().st_mtime for path, _ in whole]
    # Nothing to look at where each run was written after those that start before it: the usual case.
    if all(later >= earlier - _WORTH_TELLING for earlier, later in zip(np.maximum.accumulate(written), written)):
        return whole, ()
    runs = [_run(path, layout, at) for (path, layout), at in zip(whole, written)]
    notes: list[str] = []
    stale: list[_Run] = []
    for place, earlier in enumerate(runs):
        for later in runs[place + 1 :]:
            ahead = earlier.written - later.written
            if ahead <= _WORTH_TELLING or not np.isfinite([earlier.first, later.first]).all():
                continue
            told = (
                f"run {earlier.folder}, written {_clock(earlier)}, {_NEWER} {later.folder}, written "
                f"{_clock(later)}, and "
            )
            if ahead > SURELY_LATER and not later.follows(earlier):
                meets = "reaches into it" if earlier.last >= later.first else "stops before it"
                notes.append(told + f"{meets}: folder {later.folder} is left from a run before and does not count")
                stale.append(later)
            elif later not in stale:
                doubt = "ends where it begins" if later.follows(earlier) else "both may be copies"
                notes.append(
                    told + f"{doubt}: joined by start time; if it is stale, move folder {later.folder} away"
                )
    if stale:
        runs.sort(key=lambda run: run.written)
    return [(run.file, run.layout) for run in runs], tuple(notes)


def _run(path: Path, layout: LogLayout, written: float) -> _Run:
    first, (before, last) = first_index(path, layout), last_index(path, layout)
    step = last - before if np.isfinite(before) else 0.0
    return _Run(path, layout, written, np.nan if first is None else first, last, max(step, 0.0))


def _clock(run: _Run) -> str:
    return time.strftime("%Y-%m-%d %H:%M:%S", time.gmtime(run.written))
