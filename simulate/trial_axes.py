"""Positions of sea trials in the axes of a manoeuvre: from geographic positions, an antenna, an arbitrary course."""

from __future__ import annotations

import math

import numpy as np

from ..core.errors import ReadError
from .events import FloatArray
from .found_states import order_time
from .trajectory import Trajectory

# World Geodetic System 1984.
_SEMI_MAJOR_AXIS = 6378137.0
_ECCENTRICITY_SQUARED = 6.69437999014e-3

_FARTHEST = math.radians(1.0)
"""Positions farther apart than this belong to no manoeuvre."""


def local_position(latitude: FloatArray, longitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Distances north and east of the first position in m, each of shape (n,).

    Parameters
    ----------
    latitude, longitude : ndarray, shape (n,)
        In radians, positive to the north and to the east, on the WGS-84 ellipsoid.

    Returns
    -------
    tuple of ndarray
        With the radii of curvature at the mean latitude: within 1e-6 of the distance over a few kilometres.

    Raises
    ------
    ReadError
        For positions that are no latitudes, or farther apart than a degree.
    """
    if np.abs(latitude).max() > 0.5 * math.pi or max(np.ptp(latitude), np.ptp(np.unwrap(longitude))) > _FARTHEST:
        raise ReadError(
            "latitude and longitude are no positions of one manoeuvre",
            cure="give them in degrees with decimals, 'latitude [deg]' and 'longitude [deg]', without outliers",
        )
    middle = 0.5 * float(latitude.max() + latitude.min())
    flattened = 1.0 - _ECCENTRICITY_SQUARED * math.sin(middle) ** 2
    meridian = _SEMI_MAJOR_AXIS * (1.0 - _ECCENTRICITY_SQUARED) / flattened**1.5
    parallel = _SEMI_MAJOR_AXIS / math.sqrt(flattened) * math.cos(middle)
    east = np.unwrap(longitude)
    return meridian * (latitude - latitude[0]), parallel * (east - east[0])


def at_midship(trajectory: Trajectory, forward: float, starboard: float = 0.0) -> Trajectory:
    """The track of midship from that of an antenna.

    Parameters
    ----------
    trajectory : Trajectory
        ``x, y`` of the antenna; velocities, if any, are left as they are.
    forward, starboard : float
        Place of the antenna from midship in m.

    Returns
    -------
    Trajectory
        Indices are defined at midship: an antenna on a bridge aft gives another advance, transfer and drift angle.
    """
    psi = trajectory["psi"]
    return trajectory.with_columns(
        f"track moved to midship from an antenna {forward:g} m forward and {starboard:g} m to starboard of it",
        x=trajectory["x"] - forward * np.cos(psi) + starboard * np.sin(psi),
        y=trajectory["y"] - forward * np.sin(psi) - starboard * np.cos(psi),
    )


def on_original_course(trajectory: Trajectory, execute: float | None = None) -> Trajectory:
    """The trajectory with its origin at the first order, x along the course before it and time from there.

    Parameters
    ----------
    trajectory : Trajectory
        With ``time, x, y, psi``.
    execute : float, optional
        Time of the first order in s; default where the rudder begins to move.

    Returns
    -------
    Trajectory
        The original course is the heading at the first order.
    """
    begin = order_time(trajectory, execute)
    time, psi = trajectory["time"], trajectory["psi"]
    x0, y0, course = (float(np.interp(begin, time, trajectory[name])) for name in ("x", "y", "psi"))
    dx, dy = trajectory["x"] - x0, trajectory["y"] - y0
    c, s = math.cos(course), math.sin(course)
    step = f"axes turned by {math.degrees(course):.6g} deg and moved to the first order at {begin:.6g} s"
    return trajectory.with_columns(step, time=time - begin, x=dx * c + dy * s, y=dy * c - dx * s, psi=psi - course)
