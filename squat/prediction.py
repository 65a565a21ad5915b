"""What every formula says of one ship at several speeds, with the limits that it breaks and the spread of all."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError
from ..core.ship import Ship
from . import ankudinov, barrass, eryuzlu, icorels, millward, norrbin, roemisch, yoshimura
from .fairway import MIDSHIP_COEFFICIENT, Fairway
from .squat_formula import KNOT, Ends, SquatFormula, full_scale_passage

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

FORMULAS: dict[str, SquatFormula] = {
    formula.key: formula
    for family in (icorels, barrass, eryuzlu, yoshimura, roemisch, millward, norrbin, ankudinov)
    for formula in family.FORMULAS
}
"""All formulas by key."""

PLACES = ("bow", "stern", "middle", "maximum")


@dataclass(frozen=True, eq=False)
class SquatPrediction:
    """Squat by formula and speed.

    Attributes
    ----------
    table : DataFrame
        One row for each formula and speed: speed (m/s) and depth_froude, knots of the full-scale ship, formula;
        bow, stern, middle and maximum in m, positive down, nan where the formula does not speak of the place;
        applicable, and flag: the limits that are broken; source.
    """

    table: pd.DataFrame

    def spread(self, place: str = "maximum", *, applicable: bool = True) -> pd.DataFrame:
        """Number, least, median and largest squat in m by speed.

        Parameters
        ----------
        place : str
            One of :data:`PLACES`.
        applicable : bool
            Of the applicable formulas only.

        Raises
        ------
        TowtankError
            For an unknown place.
        """
        if place not in PLACES:
            raise TowtankError(f"no place '{place}'", cure=f"places are {', '.join(PLACES)}")
        values = self.table[place]
        if applicable:
            values = values.where(self.table["applicable"])
        by_speed = values.groupby(self.table["speed"])
        frame = by_speed.agg(["count", "min", "median", "max"])
        frame.attrs["unit"] = "m"
        return frame

    def of(self, formula: str, place: str) -> np.ndarray:
        """Squat in m of one formula at one place, shape (n,).

        Raises
        ------
        TowtankError
            For an unknown formula or place.
        """
        if place not in PLACES:
            raise TowtankError(f"no place '{place}'", cure=f"places are {', '.join(PLACES)}")
        rows = self.table[self.table["formula"] == formula]
        if rows.empty:
            known = ", ".join(dict.fromkeys(self.table["formula"]))
            raise TowtankError(f"no formula '{formula}' in this prediction", cure=f"it has {known}")
        return rows[place].to_numpy(dtype=float)


def predict(
    ship: Ship,
    depth: float,
    speeds: ArrayLike,
    *,
    channel: Fairway | None = None,
    formulas: Iterable[SquatFormula] = tuple(FORMULAS.values()),
    midship_coefficient: float = MIDSHIP_COEFFICIENT,
    propellers: int = 1,
    bulb: bool = True,
    transom: bool = True,
    static_trim: float = 0.0,
) -> SquatPrediction:
    """Squat of a ship or model by every formula.

    Parameters
    ----------
    ship : Ship
        With its volume. A model is computed as the ship that it stands for and scaled back.
    depth : float
        In m at the scale of the ship.
    speeds : array_like, shape (n,)
        Through the water in m/s at the scale of the ship; never knots.
    channel : Fairway, optional
        Canal or trench of that depth; open water when not given.
    formulas : iterable of SquatFormula
    midship_coefficient : float
        Midship section over B T.
    propellers : int
    bulb, transom : bool
    static_trim : float
        Draught aft less forward over their sum.

    Returns
    -------
    SquatPrediction
        Formulas out of their limits are there and flagged.

    Raises
    ------
    TowtankError
        For a ship without volume, too little water, or a speed that is missing, negative or not subcritical.
    """
    import pandas as pd

    fairway = Fairway(depth) if channel is None else channel
    if fairway.depth != depth:
        raise TowtankError(f"depth {depth} m, but the channel is {fairway.depth} m deep", cure="give one depth")
    speed = np.atleast_1d(np.asarray(speeds, dtype=float))
    passage = full_scale_passage(
        ship,
        fairway,
        speed,
        midship_coefficient=midship_coefficient,
        propellers=propellers,
        bulb=bulb,
        transom=transom,
        static_trim=static_trim,
    )
    parts = []
    for formula in formulas:
        ends = formula.evaluate(passage)
        flags = formula.objections(passage)
        parts.append(
            pd.DataFrame(
                {
                    "speed": speed,
                    "knots": passage.speed / KNOT,
                    "depth_froude": passage.depth_froude,
                    "formula": formula.key,
                    **{place: _at(ends, place, len(speed)) / ship.scale for place in PLACES},
                    "applicable": [not flag for flag in flags],
                    "flag": flags,
                    "source": formula.source,
                }
            )
        )
    if not parts:
        raise TowtankError("no formula was chosen", cure=f"choose from {', '.join(FORMULAS)}")
    table = pd.concat(parts, ignore_index=True)
    table.attrs["units"] = {"speed": "m/s", "knots": "kn, full scale", **dict.fromkeys(PLACES, "m")}
    return SquatPrediction(table)


def _at(ends: Ends, place: str, n: int) -> np.ndarray:
    values = getattr(ends, place)
    return np.full(n, np.nan) if values is None else np.asarray(values, dtype=float)
