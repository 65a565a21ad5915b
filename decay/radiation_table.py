"""A table of radiation: damping B(omega), and added mass A(omega) where it is known, from a file to a memory."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.errors import FitError, ReadError
from ..formats.units import conversion
from .damping_models import MOTION_UNITS
from .transfer_function import TransferFunctionFit, fit_transfer_function, memory_of_damping

_INDEX = {"roll": "44", "pitch": "55", "heave": "33"}
_FREQUENCIES = ("omega", "frequency", "w")
_DAMPING_UNITS = {"roll": "N m s", "pitch": "N m s", "heave": "N s/m"}
_MASS_UNITS = {"roll": "kg m2", "pitch": "kg m2", "heave": "kg"}


@dataclass(frozen=True, eq=False)
class RadiationTable:
    """Radiation of one motion at one scale, SI.

    Attributes
    ----------
    frequency : ndarray, shape (n,)
        Rising and positive, rad/s.
    damping : ndarray, shape (n,)
        N m s (heave: N s/m).
    added_mass : ndarray, shape (n,), optional
        kg m2 (heave: kg).
    infinite : float, optional
        Added mass at infinite frequency.
    motion : {"roll", "pitch", "heave"}
    scale : float
        Length of the ship over that of the table; 1 for full scale.
    source, sha256 : str
    """

    frequency: np.ndarray
    damping: np.ndarray
    added_mass: np.ndarray | None = None
    infinite: float | None = None
    motion: str = "roll"
    scale: float = 1.0
    source: str = ""
    sha256: str = ""

    def at_scale(self, scale: float) -> RadiationTable:
        """The table at another scale by Froude's law, in the same water.

        Raises
        ------
        FitError
            If the scale is not positive.
        """
        if not scale > 0.0:
            raise FitError(f"the scale {scale} is not positive", cure="give 1 for full scale, 68 for a model 1:68")
        length = self.scale / scale
        mass = inertia_factor(self.motion, length)
        return replace(
            self,
            frequency=self.frequency / math.sqrt(length),
            damping=self.damping * mass / math.sqrt(length),
            added_mass=None if self.added_mass is None else self.added_mass * mass,
            infinite=None if self.infinite is None else self.infinite * mass,
            scale=scale,
        )

    def identify(self, order: int | None = None) -> TransferFunctionFit:
        """Rational memory of the table, its order raised until both tables are explained unless it is given.

        Without added mass the one that the damping implies is taken, counted from that at infinite frequency.

        Raises
        ------
        FitError
            As :func:`.transfer_function.fit_transfer_function`.
        """
        inside = self.frequency > 0.0
        omega, damping = self.frequency[inside], self.damping[inside]
        if self.added_mass is None:
            return memory_of_damping(omega, damping, order=order)
        return fit_transfer_function(omega, damping, self.added_mass[inside], infinite=self.infinite, order=order)


def inertia_factor(motion: str, length: float) -> float:
    """What inertia and added mass are multiplied with when all lengths are: length to the fifth (heave: third)."""
    return length**3 if MOTION_UNITS[motion] == "m" else length**5


def read_radiation(
    path: str | Path,
    *,
    motion: str = "roll",
    frequency: str | None = None,
    damping: str | None = None,
    added_mass: str | None = None,
    infinite: float | None = None,
    scale: float = 1.0,
) -> RadiationTable:
    """Table of radiation from a file of any known format.

    Parameters
    ----------
    path : str or Path
    motion : {"roll", "pitch", "heave"}
    frequency, damping, added_mass : str, optional
        Columns. When not given: omega, frequency or w; B44 or B (pitch: B55, heave: B33); A44 or A, if there is one.
        Units that the file prints are heeded: rad/s or Hz, N m s, kg m2 and their multiples; without them SI is taken.
    infinite : float, optional
        Added mass at infinite frequency in SI; fitted when not given.
    scale : float
        Scale of the table.

    Raises
    ------
    ReadError
        If a column is missing, has another kind of unit, or its values are no table of radiation.
    """
    from ..formats.read import read_table

    table = read_table(path)
    index = _INDEX[motion]
    names = list(table.columns)
    omega = _named(frequency, _FREQUENCIES, names, "frequency", path)
    b = _named(damping, (f"B{index}", "B"), names, "damping", path)
    a = added_mass if added_mass is not None else next((one for one in (f"A{index}", "A") if one in names), None)
    if a is not None:
        _named(a, (), names, "added mass", path)

    def column(name: str, *units: str) -> np.ndarray:
        return np.asarray(table.columns[name]) * _factor(table.units.get(name, ""), name, units, path)

    rate = 2.0 * math.pi if "Hz" in table.units.get(omega, "") else 1.0
    found = RadiationTable(
        rate * column(omega, "rad/s", "Hz", "1/s"),
        column(b, _DAMPING_UNITS[motion], "N m s/rad"),
        None if a is None else column(a, _MASS_UNITS[motion], "kg m2/rad"),
        infinite,
        motion,
        scale,
        str(path),
        table.sha256,
    )
    columns = [found.frequency, found.damping, *([] if found.added_mass is None else [found.added_mass])]
    wild = next((name for name, values in zip((omega, b, a), columns) if not np.isfinite(values).all()), None)
    if wild is not None:
        raise ReadError(
            f"column '{wild}' holds values that are not finite", cure="leave those rows out", file=path
        )
    if found.frequency.size < 3 or found.frequency[0] < 0.0 or not (np.diff(found.frequency) > 0.0).all():
        raise ReadError(
            "the frequencies of the table of radiation do not rise from zero or above in three rows or more",
            cure="sort the table",
            file=path,
            place=f"column {omega}",
        )
    if not found.damping.max() > 0.0:
        raise ReadError(
            "the radiation damping is nowhere positive", cure="check its sign", file=path, place=f"column {b}"
        )
    return found


def _named(given: str | None, usual: tuple[str, ...], names: list[str], what: str, path: str | Path) -> str:
    """The column that was named, or the first of the usual ones."""
    wanted = usual if given is None else (given,)
    for name in wanted:
        if name in names:
            return name
    raise ReadError(
        f"the table of radiation has no column '{' or '.join(wanted)}' of {what}",
        cure=f"name one under [memory]; the file has {', '.join(names)}",
        file=path,
    )


def _factor(unit: str, name: str, known: tuple[str, ...], path: str | Path) -> float:
    """Factor to SI of a printed unit; 1 for none."""
    if not unit:
        return 1.0
    try:
        found = conversion(unit)
        if found.dimension in {conversion(one).dimension for one in known}:
            return found.factor
        cause, cure = f"unit '{unit}' is no unit of '{name}'", f"give it in {known[0]}"
    except ReadError as error:
        cause, cure = error.cause, error.cure
    raise ReadError(cause, cure=cure, file=path, place=f"column {name}")
