"""Radiation memory beside the fits without it: table at the scale of the records, what is known, and the fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..core.ship import Ship
from ..core.variables import GRAVITY
from .damping_models import DampingModel
from .decay_record import DecayRecord
from .memory_damping import MemoryDamping
from .memory_fit import fit_memory_decay
from .radiation_table import RadiationTable, inertia_factor
from .retardation import check_added_mass, impulse_response
from .transfer_function import TransferFunctionFit

if TYPE_CHECKING:
    import pandas as pd

_OFF = 0.1
"""Part by which the restoring moment of the fit may differ from that of the ship before it is told."""


@dataclass(frozen=True, eq=False)
class MemoryComparison:
    """A decay with radiation memory.

    Attributes
    ----------
    table : RadiationTable
        At the scale of the records.
    identified : TransferFunctionFit
        Rational memory of the table.
    fit : MemoryDamping
    known : str
        What was known of inertia and restoring, in words.
    findings : tuple of Finding
        About the table, its transfer function and what was known.
    """

    table: RadiationTable
    identified: TransferFunctionFit
    fit: MemoryDamping
    known: str
    findings: tuple[Finding, ...]

    def retardation(self, points: int = 400) -> pd.DataFrame:
        """K(t) of the table and of the transfer function, in columns ``time [s]``, ``table``, ``fitted`` (SI)."""
        import pandas as pd

        slowest = float(np.abs(self.identified.function.poles.real).min())
        time = np.linspace(0.0, 8.0 / slowest, points)
        kernel = impulse_response(self.table.frequency, self.table.damping, time).kernel
        return pd.DataFrame(
            {"time [s]": time, "table": kernel, "fitted": self.identified.function.impulse_response(time)}
        )

    def to_frame(self) -> pd.DataFrame:
        """The table beside its transfer function: frequency, damping, added mass, and what was fitted, in SI."""
        import pandas as pd

        omega, function = self.table.frequency, self.identified.function
        columns = {"omega [rad/s]": omega, "B": self.table.damping, "B fitted": function.damping(omega)}
        if self.table.added_mass is not None:
            columns |= {"A": self.table.added_mass, "A fitted": self.identified.added_mass(omega)}
        return pd.DataFrame(columns)


def beside_memory(
    records: Sequence[DecayRecord],
    model: DampingModel,
    table: RadiationTable,
    *,
    inertia: float | None = None,
    restoring: float | None = None,
    free: Sequence[str] = (),
    order: int | None = None,
) -> MemoryComparison:
    """Fit records with the memory of a table.

    The inertia I + A_inf is the one given; or that of the ship's radius of gyration (heave: its mass) with the added
    mass at infinite frequency of the table; or it is fitted beside a restoring moment that is known. The restoring
    moment is the one given; without an inertia, that of the ship's GM; else it is fitted.

    Parameters
    ----------
    records : sequence of DecayRecord
        Free parts, centred; with the ship where it is known.
    model : DampingModel
    table : RadiationTable
        At any scale.
    inertia : float, optional
        I + A_inf in kg m2 (heave: kg) at the scale of the table.
    restoring : float, optional
        C in N m (heave: N/m) at the scale of the table.
    free : sequence of str
        ``inertia``, ``restoring``, or both: fitted, whatever is known; a known inertia is then the start.
    order : int, optional
        Of the transfer function.

    Raises
    ------
    FitError
        If neither inertia nor restoring moment is known, or a fit is not possible.
    """
    first = records[0]
    size = inertia_factor(first.motion, table.scale / first.scale)
    length = table.scale / first.scale
    own = table.at_scale(first.scale)
    identified = own.identify(order)
    found = [*identified.findings]
    if own.added_mass is not None:
        positive = own.frequency > 0.0
        time = np.linspace(0.0, np.pi / float(np.median(np.diff(own.frequency))), 2000)
        response = impulse_response(own.frequency, own.damping, time)
        found += check_added_mass(own.frequency[positive], own.added_mass[positive], response).findings
    mass = None if inertia is None else inertia * size
    spring = None if restoring is None else restoring * size / length
    said = []
    if mass is None:
        mass = _inertia_of_ship(first.ship, first.motion, identified, own)
        if mass is not None:
            said.append("inertia from the ship's gyration and the added mass of the table")
    else:
        said.append("inertia given")
    ships = _restoring_of_ship(first.ship, first.motion)
    if spring is not None:
        said.append("restoring moment given")
    elif mass is None and ships is not None:
        spring = ships
        said.append("restoring moment of the ship's GM")
    free_inertia = mass is None or "inertia" in free
    if "restoring" in free:
        spring = None
    said = [
        one
        for one in said
        if not (free_inertia and one.startswith("inertia"))
        and not (spring is None and one.startswith("restoring"))
    ]
    if mass is None:
        if spring is None:
            raise FitError(
                "neither the inertia I + A_inf nor the restoring moment is known beside the memory",
                cure="give the inertia, or a ship with volume and GM (or kxx, and added mass in the table)",
                file=first.source or None,
                place=first.name,
            )
        mass = spring / (2.0 * np.pi / first.period) ** 2
    fit = fit_memory_decay(
        records, identified.function, model, inertia=mass, restoring=spring, free_inertia=free_inertia
    )
    if free_inertia:
        said.append("inertia fitted")
    if spring is None:
        said.append("restoring moment fitted")
    fitted = fit["c1"] * fit.inertia
    if spring is None and ships is not None and abs(fitted / ships - 1.0) > _OFF:
        found.append(
            Finding(
                "restoring-against-ship",
                "warning",
                f"restoring moment {fitted:.4g} N m of the fit with memory, {ships:.4g} N m of the ship's GM",
                first.source,
                first.name,
                "check the inertia, GM, and the scale of the table of radiation",
            )
        )
    return MemoryComparison(own, identified, fit, ", ".join(said), tuple(found))


def _inertia_of_ship(
    ship: Ship | None, motion: str, identified: TransferFunctionFit, table: RadiationTable
) -> float | None:
    """I + A_inf of a ship whose radius of gyration is known, if the table has the added mass."""
    if ship is None or ship.displacement_mass is None or (table.added_mass is None and table.infinite is None):
        return None
    added = identified.infinite if table.added_mass is not None else float(table.infinite or 0.0)
    if motion == "heave":
        return ship.displacement_mass + added
    radius = ship.kxx if motion == "roll" else ship.kyy
    return None if radius is None else ship.displacement_mass * radius**2 + added


def _restoring_of_ship(ship: Ship | None, motion: str) -> float | None:
    """rho g volume GM of roll in N m; None where it is not known."""
    if motion != "roll" or ship is None or ship.displacement_mass is None or ship.GM is None or not ship.GM > 0.0:
        return None
    return ship.displacement_mass * GRAVITY * ship.GM
