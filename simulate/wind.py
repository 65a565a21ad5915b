"""Steady wind: relative wind, coefficient tables, Blendermann's coefficients by type of ship.

Angles of the wind are those it blows *from*: the true wind from the x0 axis (the initial course), the relative
wind off the bow, both positive to starboard; 0 is a head wind. Coefficients are in home axes, so that a wind from
starboard has a negative CY::

    X = CX q A_F      Y = CY q A_L      N = CN q A_L L      K = CK q A_L H_L      q = rho_a V**2 / 2

with H_L = A_L / L. The forces include what the ship's own speed makes of still air.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ConventionError, DatasetError, ReadError, TowtankError
from ..core.ship import Ship
from ..datasets import load_table
from .angle_table import AngleTable
from .coefficient_frame import coefficient_columns, read_from

if TYPE_CHECKING:
    import pandas as pd

AIR_DENSITY = 1.225
"""Density of air at 15 degrees Celsius and sea level in kg/m3 (ISO 2533)."""

COEFFICIENTS = ("CX", "CY", "CK", "CN")


@dataclass(frozen=True, eq=False)
class WindCoefficients:
    """Wind coefficients over the relative wind angle, with the areas that they belong to.

    Attributes
    ----------
    table : AngleTable
        CX, CY, CK, CN over the angle off the bow, from starboard.
    frontal_area, lateral_area : float
        Projected areas above water in m2, on a ship of length `length`.
    length : float
        Length between perpendiculars in m; areas are scaled to the ship that sails.
    source : str
    """

    table: AngleTable
    frontal_area: float
    lateral_area: float
    length: float
    source: str = ""

    def __post_init__(self) -> None:
        for name in ("frontal_area", "lateral_area", "length"):
            if not getattr(self, name) > 0:
                raise TowtankError(f"wind coefficients: {name} = {getattr(self, name)} is not positive")
        signs = (("CX", "a head wind", 0.0, 0, "ahead"), ("CY", "a wind from starboard", 90.0, 1, "to starboard"))
        for name, wind, angle, column, way in signs:
            if self.table.at(math.radians(angle))[column] > 0:
                raise ConventionError(
                    f"{name} of {wind} is positive: it would push the ship {way}",
                    cure="axes are x forward and y to starboard, angles off the bow; reverse the column or angles",
                )

    @classmethod
    def from_frame(
        cls, frame: pd.DataFrame, *, frontal_area: float, lateral_area: float, length: float, source: str = ""
    ) -> WindCoefficients:
        """Coefficients from a table with the columns ``angle [deg]``, CX, CY, CN and, if known, CK.

        Parameters
        ----------
        frame : DataFrame
            Angles off the bow from 0 to 180 deg, wind from starboard; CK is 0 where the column is missing.
        frontal_area, lateral_area : float
            In m2.
        length : float
            Length between perpendiculars in m.
        source : str

        Raises
        ------
        ReadError
            For a missing column or angles that do not run from 0 to 180.
        ConventionError
            For columns in other axes.
        """
        angles, columns = coefficient_columns(frame, "angle [deg]", ("CX", "CY", "CN"), ("CK",))
        values = np.column_stack([columns[name] for name in COEFFICIENTS])
        table = AngleTable(np.radians(angles), values, (False, True, True, True), COEFFICIENTS)
        return cls(table, frontal_area, lateral_area, length, source)

    @classmethod
    def from_csv(
        cls, path: str | Path, *, frontal_area: float, lateral_area: float, length: float
    ) -> WindCoefficients:
        """:meth:`from_frame` of a CSV file.

        Raises
        ------
        ReadError
            Also when the file cannot be read.
        """
        areas = {"frontal_area": frontal_area, "lateral_area": lateral_area, "length": length}
        with read_from(path) as frame:
            return cls.from_frame(frame, **areas, source=Path(path).name)

    def at(self, angle: np.ndarray | float) -> np.ndarray:
        """CX, CY, CK, CN at relative wind angles in rad, shape (..., 4)."""
        return self.table.at(angle)

    def units(self, ship: Ship, air_density: float) -> np.ndarray:
        """Force over coefficient and squared wind speed of X, Y, K, N for a ship of this form, shape (4,)."""
        similar = (ship.L / self.length) ** 2
        frontal, lateral = similar * self.frontal_area, similar * self.lateral_area
        return 0.5 * air_density * np.array([frontal, lateral, lateral**2 / ship.L, lateral * ship.L])


@dataclass(frozen=True, eq=False)
class Wind:
    """Steady uniform wind.

    Attributes
    ----------
    speed : float
        True wind speed in m/s, at the height that the coefficients belong to.
    direction : float
        Direction that it blows from, from x0, positive to starboard, rad.
    coefficients : WindCoefficients
    air_density : float
        In kg/m3.
    """

    speed: float
    direction: float
    coefficients: WindCoefficients
    air_density: float = AIR_DENSITY

    def __post_init__(self) -> None:
        if not self.speed >= 0:
            raise TowtankError(f"wind: a speed of {self.speed} m/s", cure="give its size; the sign is a direction")

    @property
    def velocity(self) -> tuple[float, float]:
        """Velocity of the air over ground along x0 and y0, m/s."""
        return -self.speed * math.cos(self.direction), -self.speed * math.sin(self.direction)


def relative_wind(
    speed: np.ndarray | float,
    direction: np.ndarray | float,
    psi: np.ndarray | float,
    u: np.ndarray | float,
    v: np.ndarray | float,
) -> tuple[np.ndarray, np.ndarray]:
    """Wind that a moving ship feels.

    Parameters
    ----------
    speed : float or ndarray
        True wind speed in m/s.
    direction : float or ndarray
        Where it blows from, from x0, rad.
    psi : float or ndarray
        Heading, rad.
    u, v : float or ndarray
        Velocity of the ship over ground along its x and y, m/s.

    Returns
    -------
    speed, angle : ndarray
        Relative wind speed in m/s and angle off the bow in rad, -pi to pi, positive from starboard.
    """
    from_bow = np.asarray(direction, dtype=float) - psi
    ahead, across = speed * np.cos(from_bow) + u, speed * np.sin(from_bow) + v
    return np.hypot(ahead, across), np.arctan2(across, ahead)


def wind_at_height(speed: float, height: float, reference: float = 10.0, exponent: float = 7.0) -> float:
    """Wind speed at another height above water by the power law ``V (h / h_ref)**(1/exponent)``.

    Parameters
    ----------
    speed : float
        In m/s at the `reference` height.
    height, reference : float
        In m.
    exponent : float
        7 over open sea.

    Raises
    ------
    TowtankError
        For a height that is not positive.
    """
    if not (height > 0 and reference > 0):
        raise TowtankError(f"wind at {height} m from {reference} m: heights must be positive")
    return speed * (height / reference) ** (1.0 / exponent)


def blendermann_coefficients(
    kind: str,
    ship: Ship,
    *,
    frontal_area: float,
    lateral_area: float,
    centroid_forward: float = 0.0,
    centroid_height: float | None = None,
    overall_length: float | None = None,
    step: float = 10.0,
) -> WindCoefficients:
    """Coefficients of Blendermann 1994 for a type of ship, as a table.

    Parameters
    ----------
    kind : str
        Type of ship, such as ``"container ship, loaded"``; see ``load_table("blendermann-ship-types")``.
    ship : Ship
        Gives the length between perpendiculars.
    frontal_area, lateral_area : float
        Projected areas above water in m2.
    centroid_forward : float
        Centroid of the lateral area forward of midship in m.
    centroid_height : float, optional
        Its height above the waterline in m; half the mean height A_L/L_OA when not given.
    overall_length : float, optional
        L_OA in m; the length between perpendiculars when not given.
    step : float
        Between the angles of the table in deg; a divisor of 180.

    Raises
    ------
    DatasetError
        For an unknown type.

    Notes
    -----
    Parameter identification of wind loads on ships, J. Wind Eng. Ind. Aerodyn. 51:339-351, the form that Fossen's
    handbook gives. The longitudinal coefficient of a beam wind is 0, where its bow and stern values meet.
    """
    types = {row["type"]: row for row in load_table("blendermann-ship-types").frame.to_dict("records")}
    if kind not in types:
        raise DatasetError(f"no wind coefficients for '{kind}'", cure=f"types are {'; '.join(types)}")
    row = types[kind]
    length = ship.L if overall_length is None else overall_length
    mean_height = lateral_area / length
    height = 0.5 * mean_height if centroid_height is None else centroid_height
    count = round(180.0 / step)
    if count < 2 or abs(count * step - 180.0) > 1e-9:
        raise ReadError(f"a table of 0 to 180 deg in steps of {step:g} deg", cure="use a divisor of 180")
    angle = np.linspace(0.0, math.pi, count + 1)
    across = float(row["CD_t"])
    along = np.where(angle <= 0.5 * math.pi, float(row["CD_l_bow"]), float(row["CD_l_stern"]))
    ratio = along * frontal_area / lateral_area / across
    shape = 1.0 - 0.5 * float(row["delta"]) * (1.0 - ratio) * np.sin(2.0 * angle) ** 2
    side = across * np.sin(angle) / shape
    lever = centroid_forward / length - 0.18 * (angle - 0.5 * math.pi)
    # K and N of the source are over the mean height and the overall length; the table's are over A_L/L and L
    to_ours = length / ship.L
    values = np.column_stack(
        [
            -along * np.cos(angle) / shape,
            -side,
            -float(row["kappa"]) * height / mean_height * side / to_ours,
            -lever * side * to_ours,
        ]
    )
    values[[0, -1], 1:] = 0.0
    table = AngleTable(angle, values, (False, True, True, True), COEFFICIENTS)
    return WindCoefficients(table, frontal_area, lateral_area, ship.L, f"Blendermann 1994, {kind}")
