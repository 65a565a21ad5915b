"""Mean second-order wave forces: tables over encounter angle and wavelength, and a form without a table.

The encounter angle is the direction in which the waves travel, from the ship's heading, positive to starboard: 0
is a following sea, 180 deg a head sea, 90 deg a beam sea that comes from port. Forces are in home axes and are
added to those of calm water without interaction.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ConventionError, ReadError, TowtankError
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .angle_table import AngleTable
from .coefficient_frame import coefficient_columns, read_from
from .environment_layout import HARMONIC_DRIFT, TABULATED_DRIFT

if TYPE_CHECKING:
    import pandas as pd

COEFFICIENTS = ("CX", "CY", "CN")

_ODD = (False, True, True)


@dataclass(frozen=True)
class AnkudinovDrift:
    """Drift forces from the significant wave height alone, for long waves in deep water.

    The form of Ankudinov in the Duisburg Test Case paper (5th MASHCON 2019, equation 19), with the wave height
    ``H = H_1/3`` and the encounter angle ``a``::

        X = (0.0388 rho g B Cb H^2 + 0.311 rho g B^2 H^2.5 / L^1.5) cos a
        Y = 0.0388 rho g L H^2 sin a
        N = -0.125 rho g L T H^2 cos a sin a - 0.03 Y L
    """

    def amplitudes(self, ship: Ship, height: float) -> np.ndarray:
        """X over cos a, Y over sin a, N over sin a, N over sin 2a, in N and N m.

        Raises
        ------
        ConventionError
            When the ship's volume is not known.
        """
        block = ship.block_coefficient
        if block is None:
            raise ConventionError(
                f"wave drift of '{ship.name}' needs its block coefficient", cure="give the ship's volume"
            )
        weight = ship.rho * GRAVITY * height**2
        surge = weight * (0.0388 * ship.B * block + 0.311 * ship.B**2 * math.sqrt(height) / ship.L**1.5)
        sway = 0.0388 * weight * ship.L
        return np.array([surge, sway, -0.03 * sway * ship.L, -0.0625 * weight * ship.L * ship.T])

    def packed(self, ship: Ship, waves: Waves) -> np.ndarray:
        """Kind and data of the wave block."""
        return np.concatenate([[HARMONIC_DRIFT], self.amplitudes(ship, waves.height)])

    def doubts(self, ship: Ship, waves: Waves) -> list[str]:
        """No sentences: the form has no range of its own."""
        return []


@dataclass(frozen=True, eq=False)
class DriftTable:
    """Drift force coefficients over the encounter angle and the wavelength.

    Coefficients as in the KVLCC2 wave-force paper (5th MASHCON 2019, equation 4), with the wave amplitude ``a``::

        X, Y = CX, CY * rho g a^2 B^2 / L          N = CN * rho g a^2 B^2

    Both interpolations are monotone cubics. Beyond its wavelengths a table holds its last row, and says so.

    Attributes
    ----------
    wavelengths : ndarray, shape (k,)
        Wavelengths over L, ascending.
    tables : tuple of AngleTable
        One for each wavelength, with the same angles: CX, CY, CN.
    source : str
    """

    wavelengths: np.ndarray
    tables: tuple[AngleTable, ...]
    source: str = ""

    def __post_init__(self) -> None:
        lengths = np.array(self.wavelengths, dtype=float)
        if lengths.ndim != 1 or len(lengths) != len(self.tables) or len(lengths) == 0:
            raise ReadError(f"{len(self.tables)} tables for wavelengths of shape {lengths.shape}")
        if np.any(np.diff(lengths) <= 0) or lengths[0] <= 0:
            raise ReadError("wavelengths do not ascend from above 0", cure="name each wavelength once")
        for table in self.tables[1:]:
            if not np.array_equal(table.angles, self.tables[0].angles):
                raise ReadError("wavelengths have different angles", cure="give every angle at every wavelength")
        lengths.setflags(write=False)
        object.__setattr__(self, "wavelengths", lengths)

    @classmethod
    def from_frame(cls, frame: pd.DataFrame, source: str = "") -> DriftTable:
        """Table from the columns ``encounter angle [deg]``, ``wavelength/L``, CX, CY, CN, in any order of rows.

        Raises
        ------
        ReadError
            For a missing column, a missing combination, or angles that do not run from 0 to 180 deg.
        """
        angles, columns = coefficient_columns(frame, "encounter angle [deg]", ("wavelength/L", *COEFFICIENTS))
        if not (np.isfinite(angles).all() and np.isfinite(columns["wavelength/L"]).all()):
            raise ReadError("rows without an angle or a wavelength", cure="fill each row or take it out")
        lengths = np.unique(columns["wavelength/L"])
        values = np.column_stack([columns[name] for name in COEFFICIENTS])
        tables = []
        for length in lengths:
            rows = np.flatnonzero(columns["wavelength/L"] == length)
            rows = rows[np.argsort(angles[rows], kind="stable")]
            tables.append(AngleTable(np.radians(angles[rows]), values[rows], _ODD, COEFFICIENTS))
        return cls(lengths, tuple(tables), source)

    @classmethod
    def from_csv(cls, path: str | Path) -> DriftTable:
        """:meth:`from_frame` of a CSV file.

        Raises
        ------
        ReadError
            Also when the file cannot be read.
        """
        with read_from(path) as frame:
            return cls.from_frame(frame, Path(path).name)

    def at_wavelength(self, wavelength: float) -> AngleTable:
        """Coefficients over the encounter angle in waves of `wavelength` ship lengths."""
        inside = float(np.clip(wavelength, self.wavelengths[0], self.wavelengths[-1]))
        values = np.stack([table.values for table in self.tables])
        if len(self.wavelengths) == 1:
            here = values[0]
        else:
            from scipy.interpolate import PchipInterpolator

            here = PchipInterpolator(self.wavelengths, values, axis=0)(inside)
        return AngleTable(self.tables[0].angles, here, _ODD, COEFFICIENTS)

    def packed(self, ship: Ship, waves: Waves) -> np.ndarray:
        """Kind and data of the wave block."""
        table = self.at_wavelength(waves.length_ratio(ship))
        unit = ship.rho * GRAVITY * (0.5 * waves.height * ship.B) ** 2
        return np.concatenate([[TABULATED_DRIFT], table.packed(unit * np.array([1 / ship.L, 1 / ship.L, 1.0]))])

    def doubts(self, ship: Ship, waves: Waves) -> list[str]:
        """A sentence when the waves are shorter or longer than those of the table."""
        ratio = waves.length_ratio(ship)
        low, high = float(self.wavelengths[0]), float(self.wavelengths[-1])
        if low - 1e-9 <= ratio <= high + 1e-9:
            return []
        return [
            f"waves of {ratio:.3g} L leave the range {low:.3g} to {high:.3g} L of the drift forces; those of "
            f"{min(max(ratio, low), high):.3g} L are used"
        ]


@dataclass(frozen=True, eq=False)
class Waves:
    """Long-crested waves of one direction.

    Attributes
    ----------
    height : float
        In m: crest to trough of regular waves with a :class:`DriftTable`, significant with
        :class:`AnkudinovDrift`.
    direction : float
        Direction of travel from x0, positive to starboard, rad: pi is a head sea on the initial course.
    wavelength : float, optional
        In m; needed by a :class:`DriftTable`.
    drift : AnkudinovDrift or DriftTable
    """

    height: float
    direction: float
    wavelength: float | None = None
    drift: AnkudinovDrift | DriftTable = field(default_factory=AnkudinovDrift)

    def __post_init__(self) -> None:
        if not self.height >= 0:
            raise TowtankError(f"waves: a height of {self.height} m", cure="give a height of 0 or more")
        if self.wavelength is not None and not self.wavelength > 0:
            raise TowtankError(f"waves: a length of {self.wavelength} m", cure="give it in m, above 0")

    def length_ratio(self, ship: Ship) -> float:
        """Wavelength over the length of the ship.

        Raises
        ------
        TowtankError
            When the wavelength is not given.
        """
        if self.wavelength is None:
            raise TowtankError("a table of drift forces needs the wavelength", cure="give waves a wavelength in m")
        return self.wavelength / ship.L
