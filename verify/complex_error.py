"""Error of a harmonic motion in amplitude and phase together, as the length of a difference of phasors.

An amplitude without its phase can be right by accident: a bow motion of the measured amplitude and 33 degrees
out of phase moves the bow wrongly by more than half of it. Phases are compared as complex numbers, so that 355
and 2 degrees are 7 degrees apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def phasor(amplitude: ArrayLike, phase: ArrayLike) -> np.ndarray:
    """Complex amplitude of a harmonic.

    Parameters
    ----------
    amplitude : array_like
        Amplitude, not negative, in any unit.
    phase : array_like
        Phase lead in rad: the motion is ``amplitude cos(omega t + phase)``.

    Raises
    ------
    TowtankError
        When an amplitude is negative: its sign belongs into the phase.
    """
    size = np.asarray(amplitude, dtype=float)
    if np.any(size < 0.0):
        raise TowtankError(
            f"the amplitude {np.min(size):g} is negative",
            cure="give its size, and the phase turned by 180 degrees",
        )
    return np.asarray(size * np.exp(1j * np.asarray(phase, dtype=float)))


def complex_error(simulation: ArrayLike, data: ArrayLike) -> float:
    """Length of the difference of phasors over the length of the measured ones.

    Parameters
    ----------
    simulation, data : array_like of complex, shape (n,)
        Phasors S and D of the same motions, e.g. of stern and bow; NaN leaves the pair out.

    Returns
    -------
    float
        ``sqrt(sum |S - D|^2 / sum |D|^2)``: 0 for agreement in amplitude and phase, 1 for a prediction of no
        motion, 2 for the right amplitudes in antiphase; NaN when nothing was measured or D is zero.

    Raises
    ------
    TowtankError
        When the two differ in shape.
    """
    s = np.atleast_1d(np.asarray(simulation, dtype=complex))
    d = np.atleast_1d(np.asarray(data, dtype=complex))
    if s.shape != d.shape:
        raise TowtankError(
            f"phasors of shape {s.shape} cannot be paired with {d.shape}", cure="give one phasor a motion"
        )
    known = np.isfinite(s) & np.isfinite(d)
    size = float(np.sum(np.abs(d[known]) ** 2))
    if size <= 0.0:
        return float("nan")
    return float(np.sqrt(np.sum(np.abs(s[known] - d[known]) ** 2) / size))


def phase_difference(simulation: ArrayLike, data: ArrayLike) -> np.ndarray:
    """Phase of S ahead of D in rad, between -pi and pi.

    Parameters
    ----------
    simulation, data : array_like of complex, shape (n,)
    """
    return np.angle(np.asarray(simulation, dtype=complex) * np.conj(np.asarray(data, dtype=complex)))
