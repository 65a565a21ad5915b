"""Single oscillations of a roll record, and how many numbers each of them can determine."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..core.errors import FitError
from ..identify.harmonic_projection import harmonic_basis

# Harmonics that are looked for in an oscillation, and the share of the first below which one says nothing.
HARMONICS = 5
SMALLEST_HARMONIC = 0.01
# Samples of an oscillation that its harmonics need.
FEWEST_SAMPLES = 16


@dataclass(frozen=True, eq=False)
class Oscillation:
    """One oscillation between two upward crossings of the mean.

    Attributes
    ----------
    rows : slice
        Its samples in the record.
    period : float
        s.
    amplitude : float
        Half the range, rad.
    harmonics : ndarray, shape (k,)
        Amplitudes of the first harmonics in rad.
    """

    rows: slice
    period: float
    amplitude: float
    harmonics: np.ndarray

    def determines(self, noise: float = 0.0) -> int:
        """Numbers that the shape of this oscillation can determine: its mean, and two for each harmonic.

        Parameters
        ----------
        noise : float
            Standard deviation of the record's noise in rad; a harmonic counts when it is three standard errors
            and one hundredth of the first.
        """
        samples = self.rows.stop - self.rows.start
        floor = max(3.0 * noise * np.sqrt(2.0 / samples), SMALLEST_HARMONIC * float(self.harmonics[0]))
        return 1 + 2 * int(np.count_nonzero(self.harmonics >= floor))


def split_oscillations(
    time: np.ndarray, angle: np.ndarray, *, level: float | None = None, least_amplitude: float = 0.0
) -> list[Oscillation]:
    """Oscillations of a record from one upward crossing of a level to the next.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s and rad.
    level : float, optional
        Angle in rad whose crossings part the oscillations; the mean of the record when not given.
    least_amplitude : float
        Smaller oscillations (rad) are left out.

    Raises
    ------
    FitError
        When there is none, or one has too few samples for its harmonics.
    """
    t, x = np.asarray(time, dtype=float), np.asarray(angle, dtype=float)
    height = x - (x.mean() if level is None else level)
    upward = np.flatnonzero((height[:-1] < 0.0) & (height[1:] >= 0.0)) + 1
    found = []
    for first, last in pairwise(upward):
        if last - first < FEWEST_SAMPLES:
            raise FitError(
                f"the oscillation at {t[first]:.4g} s has {last - first} samples, of which no shape can be told",
                cure="sample faster, or filter the record",
            )
        piece, instants = x[first:last], t[first:last]
        # Crossings lie between samples.
        begin, end = (t[i] - height[i] * (t[i] - t[i - 1]) / (height[i] - height[i - 1]) for i in (first, last))
        period = float(end - begin)
        basis = harmonic_basis(instants - begin, 2.0 * np.pi / period, HARMONICS)
        parts = np.linalg.lstsq(basis, piece, rcond=None)[0]
        sizes = np.hypot(parts[1::2], parts[2::2])
        amplitude = 0.5 * float(np.ptp(piece))
        if amplitude >= least_amplitude:
            found.append(Oscillation(slice(int(first), int(last)), period, amplitude, sizes))
    if not found:
        raise FitError(
            "the record holds no whole oscillation", cure="give a longer record, or a smaller least amplitude"
        )
    return found
