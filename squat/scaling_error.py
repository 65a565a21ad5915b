"""What a model's squat leaves to the ship beyond Froude's law, and what it takes from the clearance.

A model's boundary layer is thicker for its size, so that squat scaled by Froude's law is not quite the ship's. The
scaling error is that of the ship less that of the scaled model, in home signs: positive where the ship sinks more, or
trims more by the bow. The source counts sinkage negative down: there the same error is negative.

Source: scale effects on squat of three container ships (ReSquat), 5th MASHCON 2019, equation 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError, TowtankError
from ..verify import at_measured_points, relative_errors
from .squat_curve import SquatCurve

if TYPE_CHECKING:
    import pandas as pd

SAME_WATER = 0.01
"""Part by which depth and draught of the scaled model may differ from the ship's."""

ALLOWANCES = ((1.25, 0.10), (1.15, 0.15))
"""Depth over draught from which on a part of the sinkage covers the largest scaling error that was computed."""


@dataclass(frozen=True, eq=False)
class ScalingErrors:
    """Scaling errors over speed.

    Attributes
    ----------
    frame : DataFrame
        One row a quantity and speed of the ship: speed (m/s), quantity, model (scaled by Froude's law), ship, error
        (ship less model), error_as_printed (in the sign of the source), percent (of the ship's value, nan near
        zero), percent_of_clearance (of the static one, sinkage only), unit.
    clearance : DataFrame
        One row a speed: speed, static, model, ship (clearance at the deeper end in m), change (ship less model),
        percent_of_static.
    outside : int
        Speeds of the ship that the model did not reach; nothing is extrapolated.
    """

    frame: pd.DataFrame
    clearance: pd.DataFrame
    outside: int

    def largest(self, quantity: str) -> float:
        """Largest error of a quantity in size, in its unit.

        Raises
        ------
        TowtankError
            For a quantity that has no error.
        """
        rows = self.frame[self.frame["quantity"] == quantity]
        if rows.empty:
            known = ", ".join(dict.fromkeys(self.frame["quantity"]))
            raise TowtankError(f"no scaling error of '{quantity}'", cure=f"there are {known}")
        return float(rows["error"].abs().max())


def scaling_errors(model: SquatCurve, ship: SquatCurve) -> ScalingErrors:
    """Compare the curve of a model, scaled to the ship, with that of the ship.

    Parameters
    ----------
    model : SquatCurve
        At its own scale.
    ship : SquatCurve
        At full scale (scale 1), measured or computed, in the same water.

    Raises
    ------
    FitError
        When depth or draught are not the same at full scale, no quantity is shared, or no speed of the ship lies
        between those of the model.
    """
    import pandas as pd

    if ship.scale != 1.0:
        raise FitError(
            f"the ship's curve is at scale {ship.scale:g}", cure="give it at full scale", place=ship.name
        )
    scaled = model.full_scale()
    for what, a, b in (("depth", scaled.depth, ship.depth), ("draught", scaled.draught, ship.draught)):
        if abs(a - b) > SAME_WATER * b:
            raise FitError(
                f"the {what} is {a:.4g} m by the model and {b:.4g} m by the ship",
                cure="compare curves of the same water and loading, and check the scale",
                place=ship.name,
            )
    names = [
        name
        for name in map(str, ship.points.columns)
        if name in scaled.points and name.startswith(("sinkage_", "trim")) and not name.endswith("_se")
    ]
    if not names:
        raise FitError(
            "model and ship share no sinkage and no trim", cure="report the same places", place=ship.name
        )
    speed = ship.points["speed"].to_numpy(dtype=float)
    known = scaled.points["speed"].to_numpy(dtype=float)
    inside = (speed >= known[0]) & (speed <= known[-1])
    if not inside.any():
        raise FitError(
            f"the model runs at {known[0]:.3g} to {known[-1]:.3g} m/s full scale, where the ship has no speed",
            cure="run the model in the range of the ship; nothing is extrapolated",
            place=ship.name,
        )
    at = speed[inside]
    there = {name: at_measured_points(at, known, scaled.points[name].to_numpy(dtype=float)) for name in names}
    here = {name: ship.points[name].to_numpy(dtype=float)[inside] for name in names}
    static = ship.depth - ship.draught
    parts = [_rows(name, at, there[name], here[name], static) for name in names]
    return ScalingErrors(
        pd.concat(parts, ignore_index=True),
        _clearance(at, there, here, static),
        int(np.count_nonzero(~inside)),
    )


def scale_allowance(depth_ratio: float) -> float:
    """Part of a sinkage from model tests that covers its scaling error.

    The computations of the source stay below 10 % for h/T of 1.25 and more, and reach 12 to 15 % at 1.15.

    Parameters
    ----------
    depth_ratio : float
        h/T.

    Raises
    ------
    TowtankError
        In shallower water than was computed.
    """
    for least, part in ALLOWANCES:
        if depth_ratio >= least:
            return part
    raise TowtankError(
        f"scaling errors are known down to h/T {ALLOWANCES[-1][0]}, not at {depth_ratio:.3g}",
        cure="compute or measure the ship at full scale",
    )


def clearance_with_allowance(curve: SquatCurve) -> pd.DataFrame:
    """Clearance of the ship from a model's curve, as scaled and with the scaling error at its largest.

    Parameters
    ----------
    curve : SquatCurve
        Of a model, with the sinkage at bow and stern.

    Returns
    -------
    DataFrame
        speed (m/s, full scale), static, clearance, least (m), allowance (m).

    Raises
    ------
    FitError
        When bow or stern was not reported.
    TowtankError
        In shallower water than the scaling errors are known for.
    """
    import pandas as pd

    ship = curve.full_scale()
    clearance = ship.clearance()
    static = ship.depth - ship.draught
    allowance = scale_allowance(ship.depth / ship.draught) * np.abs(static - clearance)
    return pd.DataFrame(
        {
            "speed": ship.points["speed"].to_numpy(dtype=float),
            "static": static,
            "clearance": clearance,
            "least": clearance - allowance,
            "allowance": allowance,
        }
    )


def _rows(name: str, speed: np.ndarray, model: np.ndarray, ship: np.ndarray, static: float) -> pd.DataFrame:
    import pandas as pd

    error = ship - model
    sinks = name.startswith("sinkage_")
    return pd.DataFrame(
        {
            "speed": speed,
            "quantity": name,
            "model": model,
            "ship": ship,
            "error": error,
            "error_as_printed": -error if sinks else error,
            "percent": relative_errors(model, ship).d_minus_s,
            "percent_of_clearance": 100.0 * error / static if sinks else np.nan,
            "unit": "m" if sinks else "m/m",
        }
    )


def _clearance(
    speed: np.ndarray, model: dict[str, np.ndarray], ship: dict[str, np.ndarray], static: float
) -> pd.DataFrame:
    import pandas as pd

    ends = ("sinkage_bow", "sinkage_stern")
    columns = ["speed", "static", "model", "ship", "change", "percent_of_static"]
    if not set(ends) <= set(model):
        return pd.DataFrame(columns=columns)
    by_model, by_ship = (static - np.maximum(of[ends[0]], of[ends[1]]) for of in (model, ship))
    change = by_ship - by_model
    rows = (speed, np.full(speed.shape, static), by_model, by_ship, change, 100.0 * change / static)
    return pd.DataFrame(dict(zip(columns, rows, strict=True)))
