"""Wave-making part of the simplified Ikeda roll damping: the regressions of Kawahara, Maekawa and Ikeda (2009).

Polynomials are written with the highest power first, as they are printed. The exponent is steep in its last
coefficient (A3), so that these numbers cannot be shortened.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import polynomial

# Powers of B/d inside, powers of CB outside.
_A11 = (
    (-0.002222, 0.040871, -0.286866, 0.599424),
    (0.010185, -0.161176, 0.904989, -1.641389),
    (-0.015422, 0.220371, -1.084987, 1.834167),
)
_A12 = (
    (-0.0628667, 0.4989259, 0.52735, -10.7918672, 16.616327),
    (0.1140667, -0.8108963, -2.2186833, 25.1269741, -37.7729778),
    (-0.0589333, 0.2639704, 3.1949667, -21.8126569, 31.4113508),
    (0.0107667, 0.0018704, -1.2494083, 6.9427931, -10.2018992),
)
_A13 = (
    (0.192207, -2.787462, 12.507855, -14.764856),
    (-0.350563, 5.222348, -23.974852, 29.007851),
    (0.237096, -3.535062, 16.368376, -20.539908),
    (-0.067119, 0.966362, -4.407535, 5.894703),
)
_AA11 = (
    (17.945, -166.294, 489.799, -493.142),
    (-25.507, 236.275, -698.683, 701.494),
    (9.077, -84.332, 249.983, -250.787),
)
_AA12 = (
    (-16.872, 156.399, -460.689, 463.848),
    (24.015, -222.507, 658.027, -660.665),
    (-8.56, 79.549, -235.827, 236.579),
)
# Powers of CB inside, powers of 1 - OG/d outside.
_A3 = (
    (-7686.0287, 30131.5678, -49048.9664, 42480.7709, -20665.147, 5355.2035, -577.8827),
    (61639.9103, -241201.0598, 392579.5937, -340629.4699, 166348.6917, -43358.7938, 4714.7918),
    (-130677.4903, 507996.2604, -826728.7127, 722677.104, -358360.7392, 95501.4948, -10682.8619),
    (-110034.6584, 446051.22, -724186.4643, 599411.9264, -264294.7189, 58039.7328, -4774.6414),
    (709672.0656, -2803850.2395, 4553780.5017, -3888378.9905, 1839829.259, -457313.6939, 46600.823),
    (-822735.9289, 3238899.7308, -5256636.5472, 4500543.147, -2143487.3508, 538548.1194, -55751.1528),
    (299122.8727, -1175773.1606, 1907356.1357, -1634256.8172, 780020.9393, -196679.7143, 20467.0904),
)
_AA311 = ((-17.102, 41.495, -33.234, 8.8007), (36.566, -89.203, 71.8, -18.108))
_AA3_SHAPE = (
    -1.05584, 12.688, -63.70534, 172.84571, -274.05701, 257.68705, -141.40915, 44.13177, -7.1654, 0.0,
)  # fmt: skip


def _falling(coefficients: tuple[float, ...], x: float) -> float:
    """Polynomial with the highest power first."""
    return float(polynomial.polyval(x, coefficients[::-1]))


def _nested(table: tuple[tuple[float, ...], ...], inner: float, outer: float) -> float:
    """Polynomial in `outer` whose coefficients are polynomials in `inner`."""
    return _falling(tuple(_falling(row, inner) for row in table), outer)


def wave_coefficient(
    breadth_draught: float, block: float, midship: float, og_draught: float, reduced_frequency: np.ndarray
) -> np.ndarray:
    """Non-dimensional wave damping at zero speed.

    Parameters
    ----------
    breadth_draught : float
        B/d.
    block, midship : float
        CB and CM.
    og_draught : float
        OG/d, positive downward.
    reduced_frequency : ndarray, shape (n,)
        omega sqrt(B/2g), positive.

    Returns
    -------
    ndarray, shape (n,)
        ``A1/omega_hat exp(-A2 (ln omega_hat - A3)^2 / 1.44)``.
    """
    x1, x2, x3, x4 = breadth_draught, block, midship, 1.0 - og_draught
    section = _nested(_AA11, x1, x2) * x3 + _nested(_AA12, x1, x2)
    size = (_nested(_A11, x1, x2) * x4**2 + _nested(_A12, x1, x2) * x4 + _nested(_A13, x1, x2)) * (
        section * (1.0 - x4) + 1.0
    )
    width = _falling((-1.402, 7.189, -10.993, 9.45), x4)
    shift = x4 - _falling((-0.0727, 0.7, -1.2818), x1)
    lever = _falling((-0.3767, 3.39, -10.356, 11.588), x1) * _nested(_AA311, x2, x4)
    place = _nested(_A3, x2, x4) + lever * (
        _falling(_AA3_SHAPE, shift) + _falling((-0.0495, 0.4518, -0.61655), x1)
    )
    reduced = np.asarray(reduced_frequency, dtype=float)
    return size / reduced * np.exp(-width * (np.log(reduced) - place) ** 2 / 1.44)
