"""Measured roll damping beside the components of the simplified Ikeda formula, at the same amplitudes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..core.ship import Ship
from .ikeda import IkedaDamping, IkedaHull, ikeda_damping
from .roll_damping import RollDamping

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class IkedaComparison:
    """Measured and predicted damping.

    Attributes
    ----------
    table : DataFrame
        One row an amplitude: ``amplitude_deg``, ``frequency`` (rad/s), ``measured`` with ``lower`` and ``upper``, the
        components, ``predicted``, and ``ratio`` of predicted to measured; damping as B44-hat.
    predicted : IkedaDamping
    findings : tuple of Finding
        Particulars outside the regressions.
    """

    table: pd.DataFrame
    predicted: IkedaDamping
    findings: tuple[Finding, ...]


def beside_ikeda(
    damping: RollDamping,
    hull: IkedaHull,
    amplitude: np.ndarray | None = None,
    *,
    ship: Ship | None = None,
    inertia: float | None = None,
    speed: float = 0.0,
    viscosity: float = 1.14e-6,
) -> IkedaComparison:
    """Equivalent damping of a decay test beside the prediction.

    Parameters
    ----------
    damping : RollDamping
        Of roll.
    hull : IkedaHull
        At the scale of the damping: friction knows the scale.
    amplitude : ndarray, shape (m,), optional
        rad; those of the record when not given.
    ship, inertia, speed
        As in :meth:`.RollDamping.dimensional`.
    viscosity : float
        Kinematic viscosity in m2/s.

    Raises
    ------
    FitError
        When the hull has another scale than the damping, and as :meth:`.RollDamping.dimensional`.
    """
    import pandas as pd

    owner = damping.ship if ship is None else ship
    if owner is not None and abs(hull.L / owner.L - 1.0) > 0.02:
        raise FitError(
            f"the hull of the prediction is {hull.L:.4g} m long, that of the damping {owner.L:.4g} m",
            cure="bring both to one scale",
        )
    measured = damping.dimensional(amplitude, ship=ship, inertia=inertia, speed=speed)
    at = damping.equivalent(amplitude, speed=speed)
    predicted = ikeda_damping(hull, at.amplitude, at.omega, speed=speed, viscosity=viscosity)
    components = predicted.to_frame().rename(columns={"B44_hat": "predicted"})
    table = pd.concat(
        [
            components[["amplitude_deg", "frequency"]],
            pd.DataFrame(
                {
                    "measured": measured["B44-hat [-]"],
                    "lower": measured["B44-hat lower [-]"],
                    "upper": measured["B44-hat upper [-]"],
                }
            ),
            components.drop(columns=["amplitude_deg", "frequency"]),
        ],
        axis=1,
    )
    table["ratio"] = table["predicted"] / table["measured"]
    return IkedaComparison(table, predicted, predicted.findings)
