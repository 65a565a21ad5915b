"""Rudder schedules from a file: times, rudder angles and propeller rates of a trial, to be sailed again."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.errors import ReadError
from ..formats import read_table
from .manoeuvres import schedule
from .programme import Programme
from .trajectory_file import read_channels, require_file

_NEEDED = ("time", "delta")


def read_schedule(path: str | Path) -> Programme:
    """Programme of a table with the columns ``time [s]``, ``delta [deg]`` and, where it changes, ``n [1/s]``.

    Headings may have other names and units (``t [s]``, ``rudder angle [rad]``, ``rpm [rpm]``); columns of other
    channels are passed over, so that a recorded trial serves as its own schedule.

    Raises
    ------
    ReadError
        When the file, a column or a value is missing, a unit is not that of the channel, or the times do not ascend.
    """
    channels = read_channels(read_table(require_file(path)), path)
    missing = [name for name in _NEEDED if name not in channels]
    if missing:
        raise ReadError(
            f"a schedule has no column '{missing[0]}'",
            cure="give the columns 'time [s]' and 'delta [deg]', and 'n [1/s]' where the propeller rate changes",
            file=path,
        )
    time, delta = channels["time"], channels["delta"]
    if len(time) < 2:
        raise ReadError(
            "a schedule of less than two rows", cure="give the rudder angle at two times or more", file=path
        )
    for name in _NEEDED:
        blank = np.flatnonzero(~np.isfinite(channels[name]))
        if len(blank):
            raise ReadError(
                f"'{name}' is missing", cure="fill the row or remove it", file=path, place=f"row {blank[0] + 1}"
            )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if len(back):
        raise ReadError(
            f"the time {time[back[0] + 1]:g} s does not come after {time[back[0]]:g} s",
            cure="sort the rows and name each time once",
            file=path,
            place=f"row {back[0] + 2}",
        )
    return schedule(time, np.degrees(delta), channels.get("n"))
