"""Zero-phase low-pass of uniform samples."""

from __future__ import annotations

import numpy as np

from ..core.errors import FitError

FILTER_ORDER = 4
"""Order of the Butterworth filter, which runs forward and backward."""

# Steps that differ by less than this part of their median count as uniform.
UNIFORM_TOLERANCE = 0.2


def is_uniform(time: np.ndarray) -> bool:
    """Whether the steps differ so little that a filter for uniform samples may run over them."""
    steps = np.diff(time)
    middle = float(np.median(steps))
    return bool(np.all(np.abs(steps - middle) <= UNIFORM_TOLERANCE * middle))


def low_pass(value: np.ndarray, step: float, cutoff: float, order: int = FILTER_ORDER) -> np.ndarray:
    """Butterworth low-pass run forward and backward, so that nothing is delayed.

    Parameters
    ----------
    value : ndarray, shape (n,) or (n, k)
        Uniform samples; columns are filtered each.
    step : float
        Sampling interval in s.
    cutoff : float
        Frequency in Hz at which one pass halves the power.
    order : int
        Order of one pass.

    Raises
    ------
    FitError
        If the cut-off is not positive or the order not between 1 and 10.
    """
    from scipy.signal import butter, sosfiltfilt

    if not cutoff > 0.0 or not 1 <= order <= 10:
        raise FitError(
            f"a filter of order {order} with cut-off {cutoff:g} Hz cannot be built",
            cure="give a positive cut-off in Hz and an order from 1 to 10",
        )
    relative = 2.0 * cutoff * step
    if relative >= 0.95:
        # Above the Nyquist frequency there is nothing to take away.
        return np.array(value, dtype=float)
    sections = butter(order, relative, output="sos")
    # Reflected ends of two periods of the cut-off let the transient of the filter die out.
    pad = min(int(2.0 / (cutoff * step)) + 3 * order, value.shape[0] - 1)
    return np.asarray(sosfiltfilt(sections, value, axis=0, padlen=pad))
