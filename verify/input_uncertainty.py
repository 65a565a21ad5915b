"""Uncertainty of a simulation from uncertain inputs, and what it shares with the measurement, to first order.

ASME V&V 20-2009, section 5: inputs that the experiment measures (speed, mass, wave height) carry their uncertainty
into the simulation. Those that the data reduction uses as well act on S and D together.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError
from .validation import COVERAGE

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def input_uncertainty(sensitivities: ArrayLike, covariance: ArrayLike, *, coverage: float = COVERAGE) -> float:
    """Uncertainty of a simulation from its inputs, U_input of ASME V&V 20 (local method).

    Parameters
    ----------
    sensitivities : array_like, shape (n,)
        Derivative of S with respect to each input.
    covariance : array_like, shape (n, n) or (n,)
        Covariance matrix of the inputs, or standard uncertainties of independent ones.
    coverage : float

    Returns
    -------
    float
        ``k sqrt(g' C g)``. For responses that are not straight over the spread of the inputs take the standard
        deviation of :func:`towtank.verify.polynomial_chaos.fit_chaos` instead.

    Raises
    ------
    TowtankError
        When the shapes do not fit or the matrix is no covariance.
    """
    return coverage * math.sqrt(max(shared_inputs(sensitivities, sensitivities, covariance), 0.0))


def shared_inputs(of_simulation: ArrayLike, of_data: ArrayLike, covariance: ArrayLike) -> float:
    """Covariance of S and D from quantities that both use, e.g. the speed by which both are made non-dimensional.

    Parameters
    ----------
    of_simulation, of_data : array_like, shape (n,)
        Derivatives of S and of D with respect to each quantity; 0 where one does not use it.
    covariance : array_like, shape (n, n) or (n,)
        Covariance matrix of the quantities, or standard uncertainties of independent ones.

    Raises
    ------
    TowtankError
        When the shapes do not fit or the matrix is no covariance.
    """
    g, h = np.atleast_1d(np.asarray(of_simulation, float)), np.atleast_1d(np.asarray(of_data, float))
    matrix = np.asarray(covariance, dtype=float)
    if matrix.ndim < 2:
        matrix = np.diag(np.atleast_1d(matrix) ** 2)
    if g.ndim != 1 or g.shape != h.shape or matrix.shape != (len(g), len(g)):
        raise TowtankError(
            f"{g.shape} and {h.shape} sensitivities with a covariance of shape {matrix.shape}",
            cure="give one sensitivity for each row of the covariance",
        )
    size = float(np.max(np.abs(matrix), initial=0.0))
    if not (np.isfinite(matrix).all() and np.allclose(matrix, matrix.T, atol=1e-12 * size)):
        raise TowtankError("the covariance of the inputs is not symmetric", cure="give the covariance matrix")
    if size > 0.0 and np.linalg.eigvalsh(matrix)[0] < -1e-9 * size:
        raise TowtankError(
            "the covariance of the inputs has a negative variance", cure="give the covariance matrix"
        )
    return float(g @ matrix @ h)
