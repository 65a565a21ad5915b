"""Viscous resistance in shallow water: form factor against depth, and the step from model to ship.

Source: Raven, 5th MASHCON 2019, equations 5, 6 and 8. The form factor of Gross and Watanabe and the roughness allowance
of Townsin, which the trial correction of the ITTC takes, are field knowledge, not seen in a source [?].
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

DRAUGHT_OVER_DEPTH_LIMIT = 0.5
"""Raven's law holds for T/h below this."""


def friction_line(reynolds: ArrayLike) -> np.ndarray:
    """Frictional coefficient of the ITTC 1957 line at a Reynolds number."""
    return np.asarray(0.075 / (np.log10(np.asarray(reynolds, dtype=float)) - 2.0) ** 2)


def viscous_ratio(draught: float, depth: float) -> float:
    """Viscous resistance over that in deep water, ``1 + 0.57 (T/h)**1.79``.

    Parameters
    ----------
    draught, depth : float
        In m.

    Raises
    ------
    TowtankError
        For T/h of 0.5 and more, where the law does not hold.
    """
    if not 0.0 < draught < depth:
        raise TowtankError(f"draught {draught} m and depth {depth} m leave no water under the keel")
    ratio = draught / depth
    if ratio >= DRAUGHT_OVER_DEPTH_LIMIT:
        raise TowtankError(
            f"T/h = {ratio:.3f}: the depth-dependent form factor holds below {DRAUGHT_OVER_DEPTH_LIMIT}",
            cure="measure the form factor at this depth",
        )
    return 1.0 + 0.57 * ratio**1.79


def form_factor_in_depth(deep_form_factor: float, draught: float, depth: float) -> float:
    """1+k in water of finite depth from 1+k in deep water; lengths in m. Raises as :func:`viscous_ratio`."""
    return deep_form_factor * viscous_ratio(draught, depth)


def gross_watanabe_form_factor(length: float, breadth: float, draught: float, block_coefficient: float) -> float:
    """1+k in deep water, ``1.017 + 20 CB / ((L/B)^2 sqrt(B/T))`` (Gross and Watanabe [?]); lengths in m."""
    return 1.017 + 20.0 * block_coefficient / ((length / breadth) ** 2 * (breadth / draught) ** 0.5)


def townsin_roughness(length: float, reynolds: ArrayLike, roughness: float = 150e-6) -> np.ndarray:
    """Roughness allowance, ``0.044 ((ks/L)^(1/3) - 10 Re^(-1/3)) + 0.000125`` (Townsin [?]).

    Parameters
    ----------
    length : float
        In m.
    reynolds : array_like, shape (n,)
        Of the ship.
    roughness : float
        Mean height ks in m.

    Raises
    ------
    TowtankError
        For a negative roughness.
    """
    if roughness < 0.0:
        raise TowtankError(f"a roughness of {roughness:g} m is impossible", cure="give its height in m")
    number = np.asarray(reynolds, dtype=float)
    return np.asarray(0.044 * ((roughness / length) ** (1 / 3) - 10.0 * number ** (-1 / 3)) + 0.000125)


def deep_viscous_resistance(
    speed: ArrayLike,
    *,
    length: float,
    wetted_surface: float,
    form_factor: float,
    roughness: float = 150e-6,
    rho: float = 1025.0,
    viscosity: float = 1.19e-6,
) -> np.ndarray:
    """Viscous resistance of a ship in deep water in N, with which a trial correction begins; shape (n,).

    Parameters
    ----------
    speed : array_like, shape (n,)
        In m/s.
    length, wetted_surface : float
        In m and m2.
    form_factor : float
        1+k in deep water, e.g. :func:`gross_watanabe_form_factor`.
    roughness : float
        Mean height in m.
    rho, viscosity : float
        Of the water in kg/m3 and m2/s.

    Raises
    ------
    TowtankError
        For a speed that is not positive, or a negative roughness.
    """
    v = np.asarray(speed, dtype=float)
    if not (v > 0.0).all():
        raise TowtankError("a speed is not positive", cure="give speeds through the water in m/s")
    reynolds = v * length / viscosity
    coefficient = form_factor * friction_line(reynolds) + townsin_roughness(length, reynolds, roughness)
    return np.asarray(0.5 * rho * v**2 * wetted_surface * coefficient)


def ship_resistance_coefficient(
    model_coefficient: ArrayLike, model_reynolds: ArrayLike, ship_reynolds: ArrayLike, form_factor: float = 1.0
) -> np.ndarray:
    """Total coefficient of the smooth ship from that of the model at the same Froude number.

    Parameters
    ----------
    model_coefficient, model_reynolds, ship_reynolds : array_like, shape (n,)
    form_factor : float
        1+k at the depth of the test; 1 is Froude's way.
    """
    drop = friction_line(model_reynolds) - friction_line(ship_reynolds)
    return np.asarray(np.asarray(model_coefficient, dtype=float) - form_factor * drop)
