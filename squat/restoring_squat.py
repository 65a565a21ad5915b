"""Bow and stern squat from one of them through the hydrostatic restoring matrix, as manoeuvring simulators do.

A vertical force at the origin of the matrix makes the ship sink and trim; its size is chosen so
that the bow sinks by what a formula says. Source: Tannuri, 5th MASHCON 2019, equations 5 and 6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..core.errors import TowtankError
from ..core.variables import GRAVITY
from .squat_formula import Ends, Passage, SquatFormula


def restoring_matrix(
    waterplane_area: float, flotation: float, volume: float, longitudinal_GM: float, rho: float = 1025.0
) -> np.ndarray:
    """Heave and pitch restoring of a ship, shape (2, 2): N/m, N/rad, N, N m/rad.

    Parameters
    ----------
    waterplane_area, volume, longitudinal_GM : float
        m2, m3, m.
    flotation : float
        Centre of flotation forward of midship in m.
    rho : float
        kg/m3.

    Notes
    -----
    Heave is positive up and pitch positive bow down, so that a waterplane whose centre lies aft couples with a
    positive sign: a force down there puts the bow down.
    """
    heave = rho * GRAVITY * waterplane_area
    return np.array([[heave, -heave * flotation], [-heave * flotation, rho * GRAVITY * volume * longitudinal_GM]])


def stern_over_bow(restoring: np.ndarray, length: float) -> float:
    """Stern squat over bow squat, one number for a hull at its draught whatever the speed and depth.

    Parameters
    ----------
    restoring : ndarray, shape (2, 2)
        Heave positive up, pitch positive bow down, about midship.
    length : float
        Between perpendiculars in m, at the scale of the matrix.

    Raises
    ------
    TowtankError
        For a matrix that is not symmetric and positive, or a bow that would rise.
    """
    matrix = np.asarray(restoring, dtype=float)
    if (
        matrix.shape != (2, 2)
        or not np.allclose(matrix[0, 1], matrix[1, 0])
        or not (np.linalg.eigvalsh(matrix) > 0).all()
    ):
        raise TowtankError(
            "the restoring matrix is not symmetric and positive", cure="give [[K33, K35], [K35, K55]]"
        )
    heave, pitch = np.linalg.solve(matrix, [1.0, 0.0])
    bow, stern = -heave + 0.5 * length * pitch, -heave - 0.5 * length * pitch
    # For a force down both signs turn; a bow that does not sink cannot be given its squat by a force.
    if bow >= 0.0:
        raise TowtankError("with this restoring matrix a force down lifts the bow", cure="check the sign of K35")
    return float(stern / bow)


def with_stern(formula: SquatFormula, restoring: np.ndarray, length: float) -> SquatFormula:
    """The simulator's form of a formula that gives the bow: the stern follows from the restoring matrix.

    Parameters
    ----------
    formula : SquatFormula
        One that gives the bow.
    restoring, length
        As in :func:`stern_over_bow`.
    """
    ratio = stern_over_bow(restoring, length)
    return replace(
        formula,
        key=f"{formula.key}-restored",
        evaluate=_completed(formula.evaluate, ratio),
        source=f"{formula.source}; stern by the restoring matrix, Tannuri 2019 [S]",
    )


def _completed(evaluate: Callable[[Passage], Ends], ratio: float) -> Callable[[Passage], Ends]:
    def both(passage: Passage) -> Ends:
        bow = evaluate(passage).bow
        if bow is None:
            raise TowtankError("this formula does not give the bow squat", cure="take icorels")
        return Ends(bow=bow, stern=ratio * bow, middle=0.5 * (1.0 + ratio) * bow)

    return both
