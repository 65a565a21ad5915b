"""What the formulas say of a passage: squat and clearance by formula and speed, the water around it, what to heed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.findings import Finding
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .code_scores import plain_rows
from .fairway import MIDSHIP_COEFFICIENT, Fairway, blockage, width_of_influence
from .prediction import FORMULAS, PLACES, SquatPrediction, predict
from .restoring_squat import restoring_matrix, with_stern
from .restricted_flow import critical_depth_froude, kreitner, level_drop

if TYPE_CHECKING:
    import pandas as pd

_RESTORED = ("icorels", "icorels-2.4")
"""Formulas of the bow that the restoring matrix completes."""


SCHIJF = "Schijf speed [m/s]"


@dataclass(frozen=True, eq=False)
class SquatForecast:
    """Squat of one ship by every formula at several speeds.

    Attributes
    ----------
    ship : Ship
        At the scale of all numbers here.
    fairway : Fairway
    prediction : SquatPrediction
    water : mapping of str to float
        Of the fairway: blockage, its inverse S, Schijf's lower critical speed (m/s), the critical speed of the
        depth (m/s), the width of influence (m) in open water.
    findings : tuple of Finding
    """

    ship: Ship
    fairway: Fairway
    prediction: SquatPrediction
    water: Mapping[str, float]
    findings: tuple[Finding, ...]

    @property
    def speeds(self) -> np.ndarray:
        """In m/s, shape (n,)."""
        return self.prediction.table["speed"].drop_duplicates().to_numpy(dtype=float)

    @property
    def frame(self) -> pd.DataFrame:
        """One row for each formula and speed, units in the headings; the clearance is with the largest squat."""
        import pandas as pd

        table = self.prediction.table
        places = {f"{place} [m]": table[place] for place in PLACES}
        return pd.DataFrame(
            {
                "formula": table["formula"],
                "speed [m/s]": table["speed"],
                "full-scale speed [kn]": table["knots"],
                "depth_froude [-]": table["depth_froude"],
                **places,
                "clearance [m]": self.fairway.depth - self.ship.T - table["maximum"],
                "applicable": table["applicable"],
                "flag": table["flag"],
                "source": table["source"],
            }
        )

    @property
    def spread(self) -> pd.DataFrame:
        """By speed: number, least, median and largest squat of the applicable formulas and of all, and clearances."""
        import pandas as pd

        of, every = self.prediction.spread(), self.prediction.spread(applicable=False)
        left = self.fairway.depth - self.ship.T
        frame = pd.DataFrame(
            {
                "speed [m/s]": of.index.to_numpy(dtype=float),
                "full-scale speed [kn]": self.prediction.table["knots"].drop_duplicates().to_numpy(dtype=float),
                "applicable": of["count"].to_numpy(),
                "least [m]": of["min"].to_numpy(),
                "median [m]": of["median"].to_numpy(),
                "largest [m]": of["max"].to_numpy(),
                "least clearance [m]": left - of["max"].to_numpy(),
                "formulas": every["count"].to_numpy(),
                "least of all [m]": every["min"].to_numpy(),
                "largest of all [m]": every["max"].to_numpy(),
            }
        )
        if self.fairway.kind != "open":
            froude = frame["speed [m/s]"].to_numpy() / np.sqrt(GRAVITY * self.fairway.mean_depth)
            flow = kreitner(self.water["blockage"], froude)
            frame["overspeed [-]"] = flow.gamma
            frame["level drop [m]"] = level_drop(self.fairway.mean_depth, froude, flow.gamma)
        return frame

    def to_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return {
            "format": "towtank squat prediction 1",
            "ship": self.ship.to_dict(),
            "fairway": {key: value for key, value in vars(self.fairway).items() if value is not None},
            "water": dict(self.water),
            "prediction": plain_rows(self.frame),
            "spread": plain_rows(self.spread),
            "findings": [vars(item) for item in self.findings],
        }


def forecast(
    ship: Ship,
    fairway: Fairway,
    speeds: np.ndarray,
    *,
    restoring: Mapping[str, float] | None = None,
    **hull: Any,
) -> SquatForecast:
    """Squat by every formula, with the water around the ship and what is to be heeded.

    Parameters
    ----------
    ship : Ship
        With its volume.
    fairway : Fairway
        At the scale of the ship.
    speeds : ndarray, shape (n,)
        Through the water in m/s, at that scale.
    restoring : mapping, optional
        waterplane_area, flotation, longitudinal_GM at the scale of the ship: the stern of the ICORELS formulas is
        then given through the restoring matrix too.
    **hull
        What :func:`.prediction.predict` takes beside the ship.

    Raises
    ------
    TowtankError
        For a ship without volume, too little water, or a speed that is not below the critical one.
    """
    formulas = list(FORMULAS.values())
    if restoring and ship.volume is not None:
        matrix = restoring_matrix(volume=ship.volume, rho=ship.rho, **restoring)
        formulas += [with_stern(FORMULAS[key], matrix, ship.L) for key in _RESTORED]
    found = predict(ship, fairway.depth, speeds, channel=fairway, formulas=formulas, **hull)
    water = _water(ship, fairway, float(hull.get("midship_coefficient", MIDSHIP_COEFFICIENT)))
    found = _below_schijf(found, water)
    result = SquatForecast(ship, fairway, found, water, ())
    return SquatForecast(ship, fairway, found, water, tuple(_findings(result)))


def _water(ship: Ship, fairway: Fairway, midship_coefficient: float) -> dict[str, float]:
    block = ship.block_coefficient
    assert block is not None  # predict refuses a ship without volume
    wide = width_of_influence(ship.B, block)
    section = wide * fairway.depth if fairway.area is None else fairway.area
    share = blockage(midship_coefficient * ship.B * ship.T, section)
    water = {
        "blockage": share,
        "S": 1.0 / share,
        "critical speed [m/s]": float(np.sqrt(GRAVITY * fairway.depth)),
    }
    if fairway.kind == "open":
        return water | {"width of influence [m]": wide}
    lower = critical_depth_froude(share)[0]
    return water | {SCHIJF: lower * float(np.sqrt(GRAVITY * fairway.mean_depth))}


def _below_schijf(found: SquatPrediction, water: Mapping[str, float]) -> SquatPrediction:
    """No formula applies where no steady flow passes the ship."""
    table = found.table.copy()
    above = table["speed"] > water.get(SCHIJF, np.inf)
    table.loc[above, "applicable"] = False
    flags = table.loc[above, "flag"]
    table.loc[above, "flag"] = flags.map(
        lambda flag: "; ".join(filter(None, (flag, "above Schijf's critical speed")))
    )
    return SquatPrediction(table)


def _findings(result: SquatForecast) -> list[Finding]:
    found = []
    table = result.prediction.table
    outside = [str(name) for name, of in table.groupby("formula", sort=False)["applicable"] if not of.any()]
    if outside:
        found.append(
            Finding(
                "formula-limits",
                "info",
                f"outside their limits at every speed: {', '.join(outside)}",
                cure="the flag of each says why",
            )
        )
    if not table["applicable"].any():
        found.append(
            Finding(
                "no-formula-applies",
                "warning",
                "no formula is inside its limits at any speed",
                cure="measure, or compute; the numbers are extrapolations",
            )
        )
    limit = result.water.get(SCHIJF)
    if limit is not None and (result.speeds > limit).any():
        found.append(
            Finding(
                "above-schijf",
                "warning",
                f"{int((result.speeds > limit).sum())} speed(s) above Schijf's critical {limit:.3f} m/s of this "
                "channel: no steady flow exists there, whatever the formulas say",
                cure="leave these speeds out",
            )
        )
    spread = result.spread
    aground = spread[(result.fairway.depth - result.ship.T - spread["largest of all [m]"]) <= 0.0]
    if not aground.empty:
        found.append(
            Finding(
                "no-clearance",
                "warning",
                f"from {aground['speed [m/s]'].iloc[0]:.3f} m/s on a formula leaves no water under the keel",
                cure="see which, and whether it applies",
            )
        )
    return found
