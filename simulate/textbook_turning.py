"""Turning circle as a widely used textbook program measures it, beside which the interpolated indices stand.

The figures of Fossen's handbook and of the Marine Systems Simulator for the Mariner come from a loop with fixed steps:
positions are those of the first step whose heading, rounded to full degrees, has reached 90 or 180 degrees (up to half
a degree early); advance is counted from the position at execute but along the earth axes; transfer and
diameter are distances from the x axis, not from the position at execute. Use these numbers to compare with such
programs, and :func:`~towtank.simulate.turning_indices.turning_indices` for everything else.
"""

from __future__ import annotations

import numpy as np

from ..core.errors import ReadError
from .events import FloatArray
from .trajectory import Trajectory
from .trajectory_checks import check_samples


def textbook_turning(trajectory: Trajectory, execute: float) -> dict[str, float]:
    """Seven numbers of a turning circle in metres, by the rules of the textbook program.

    Parameters
    ----------
    trajectory : Trajectory
        ``time, x, y, psi, u, v, r`` at equal steps from time 0; earth axes with x along the initial heading.
    execute : float
        Nominal time of the rudder order in s.

    Returns
    -------
    dict of str to float
        ``"rudder execute x"``, ``"steady turning radius"``, ``"maximum transfer"``, ``"maximum advance"``,
        ``"transfer at 90"``, ``"advance at 90"``, ``"tactical diameter at 180"``; NaN for headings that were not
        reached.

    Raises
    ------
    ReadError
        For missing channels or values, or an execute time outside the record.
    """
    check_samples(trajectory, ("x", "y", "psi", "u", "v", "r"))
    time, x, y = trajectory["time"], trajectory["x"], trajectory["y"]
    step = float(np.median(np.diff(time)))
    # The program counts samples from 1, so that this is the one before the nominal time.
    row = round((execute - float(time[0])) / step) - 1
    if not 0 <= row < len(time):
        raise ReadError(
            f"execute = {execute:g} s is outside the record from {time[0]:g} to {time[-1]:g} s",
            cure="give a time inside the record",
        )
    start = float(x[row])
    # Ties are rounded away from zero, as the program does.
    heading = np.floor(np.degrees(np.abs(trajectory["psi"])) + 0.5)

    def at(channel: FloatArray, degrees: float) -> float:
        reached = np.flatnonzero(heading >= degrees)
        return float(channel[reached[0]]) if len(reached) else float("nan")

    return {
        "rudder execute x": abs(start),
        "steady turning radius": float(trajectory.speed()[-1] / abs(trajectory["r"][-1])),
        "maximum transfer": float(np.abs(y).max()),
        "maximum advance": float(np.abs(x).max()) - start,
        "transfer at 90": abs(at(y, 90.0)),
        "advance at 90": abs(at(x, 90.0) - start),
        "tactical diameter at 180": abs(at(y, 180.0)),
    }
