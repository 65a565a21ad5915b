"""How a ship steers: course stability of its hull, and Nomoto's indices of its zig-zags."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..core.errors import TowtankError
from .nomoto import fit_nomoto
from .stability import straight_line_stability
from .trajectory import Trajectory
from .vessel import Vessel

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("subject", "quantity", "value", "sd", "unit")


def steering_frame(vessel: Vessel, trajectories: Sequence[Trajectory]) -> pd.DataFrame:
    """Course stability and Nomoto's indices as a table.

    Parameters
    ----------
    vessel : Vessel
        Its hull alone is judged, without rudder and propeller.
    trajectories : sequence of Trajectory
        Nomoto's equation of first order is fitted to the heading of each zig-zag.

    Returns
    -------
    DataFrame
        Columns subject, quantity, value, sd, unit: criterion C, levers, roots and the probability of stability (see
        :class:`~towtank.simulate.stability.StraightLineStability`), then K', T', P and the share of the heading that
        they explain. ``attrs["left_out"]`` says what could not be given, and why.
    """
    import pandas as pd

    rows: list[tuple[str, str, float, float, str]] = []
    left_out: list[str] = []
    try:
        stability = straight_line_stability(vessel.hull)
    except TowtankError as error:
        left_out.append(f"course stability of the hull: {error.cause}")
    else:
        # A set without covariance has no probability of stability, one without inertia no roots.
        known = stability.to_frame().dropna(subset="value")
        # a probability from a linear propagation says nothing so far out in the tails
        chance = known["quantity"].str.startswith("probability")
        known["value"] = known["value"].where(~chance, known["value"].round(6))
        rows += [("hull", *row) for row in known.itertuples(index=False, name=None)]
        if stability.without_inertia:
            left_out.append(f"roots of the hull: {stability.without_inertia}")
    for one in trajectories:
        if not one.manoeuvre.startswith("zigzag"):
            continue
        try:
            fit = fit_nomoto(one)
        except TowtankError as error:
            left_out.append(f"Nomoto's indices of {one.manoeuvre}: {error.cause}")
            continue
        scaled = fit.scaled(vessel.ship, vessel.speed)
        rows += [(one.manoeuvre, name, value, math.nan, "-") for name, value in scaled.items()]
        rows.append((one.manoeuvre, "R2 of the heading", fit.r_squared, math.nan, "-"))
    frame = pd.DataFrame(rows, columns=list(COLUMNS))
    frame.attrs["left_out"] = left_out
    return frame
