"""A run as sinkage at midship, trim and heel over time, whatever the sensors were."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..core.errors import CampaignError
from ..core.findings import Finding, accept, stop_on_error
from ..formats.raw_table import RawTable
from ..formats.read import read_table
from ..formats.units import SI_SYMBOLS, conversion
from .audit_sinkage import audit_sinkage
from .si_channel import require_channels, si_channel
from .sinkage_layout import SinkageLayout


@dataclass(frozen=True, eq=False)
class SinkageRecord:
    """Sinkage and trim of one run, SI, home convention.

    Attributes
    ----------
    time : ndarray, shape (n,)
        In s.
    midship : ndarray, shape (n,)
        Sinkage at midship on the centre line in m, positive down.
    trim : ndarray, shape (n,)
        Slope, positive by the bow: ``sinkage(x) = midship + trim x``.
    heel : ndarray, shape (n,), or None
        Slope, positive to starboard; None when the sensors do not tell.
    speed : ndarray, shape (n,), or None
        In m/s.
    extra : mapping of str to ndarray, shape (n,)
        Further channels in SI.
    extra_units : mapping of str to str
        Their SI units.
    layout : SinkageLayout
    misfit : float
        Root mean square in m of what the plane through more than three sensors leaves; 0 when they just
        determine it.
    findings : tuple of Finding
        What the audit said.
    name, sha256 : str
        File and its digest.
    history : tuple of str
        What was done to the record since it was read.
    """

    time: np.ndarray
    midship: np.ndarray
    trim: np.ndarray
    layout: SinkageLayout
    heel: np.ndarray | None = None
    speed: np.ndarray | None = None
    extra: Mapping[str, np.ndarray] = field(default_factory=dict)
    extra_units: Mapping[str, str] = field(default_factory=dict)
    misfit: float = 0.0
    findings: tuple[Finding, ...] = ()
    name: str = ""
    sha256: str = ""
    history: tuple[str, ...] = ()

    def sinkage_at(self, x: float, y: float = 0.0) -> np.ndarray:
        """Sinkage in m, positive down, of a point x forward and y to starboard of midship.

        Raises
        ------
        CampaignError
            Off the centre line when no heel was measured.
        """
        along = self.midship + self.trim * x
        if y == 0.0:
            return along
        if self.heel is None:
            raise CampaignError(
                "no heel was measured, so that nothing is known beside the centre line",
                cure="name sinkage channels at different y",
                file=self.name or None,
            )
        return along + self.heel * y


def read_sinkage(
    path: str | Path,
    layout: SinkageLayout,
    *,
    accepted: Iterable[str] = (),
    units: Mapping[str, str] | None = None,
) -> SinkageRecord:
    """Read a run, audit it, and bring it to sinkage and trim.

    Parameters
    ----------
    path : str or Path
        Text, spreadsheet, MATLAB, HDF5 or TDMS.
    layout : SinkageLayout
    accepted : iterable of str
        Rules of :func:`.audit_sinkage.audit_sinkage` that are waived.
    units : mapping of str to str, optional
        Units that the file does not give or gives wrongly.

    Raises
    ------
    ReadError
        When the file or a channel cannot be read, or a unit is not that of its quantity.
    AuditError
        For the first fault that nobody accepted, named by its rule.
    """
    table = read_table(path)
    require_channels(table, layout.channels)
    if units:
        table = replace(table, units={**table.units, **units})
    findings = accept([*table.findings, *audit_sinkage(table, layout)], accepted)
    stop_on_error(findings)
    return _record(table, layout, tuple(findings))


def _record(table: RawTable, layout: SinkageLayout, findings: tuple[Finding, ...]) -> SinkageRecord:
    time = si_channel(table, layout.time, ("time",))
    heel, misfit = None, 0.0
    down = 1.0 if layout.sinkage_positive == "down" else -1.0
    if layout.heave:
        trim = _slope(table, layout)
        midship = down * si_channel(table, layout.heave, ("length",)) - trim * layout.heave_x
    else:
        readings = down * np.column_stack([si_channel(table, name, ("length",)) for name in layout.points])
        plane, misfit = _plane(np.array(list(layout.points.values()), dtype=float), readings)
        midship, trim = plane[0], plane[1]
        heel = plane[2] if len(plane) > 2 else None
    speed = si_channel(table, layout.speed, ("velocity",)) if layout.speed else None
    extra = {name: si_channel(table, name) for name in layout.extra}
    return SinkageRecord(
        time,
        midship,
        trim,
        layout,
        heel,
        speed,
        extra,
        {
            name: SI_SYMBOLS.get(conversion(table.units[name]).dimension, "") if table.units[name] else ""
            for name in extra
        },
        misfit,
        findings,
        table.path,
        table.sha256,
    )


def _slope(table: RawTable, layout: SinkageLayout) -> np.ndarray:
    """Trim as a slope, positive by the bow, from an angle, a slope or a length."""
    values = si_channel(table, layout.trim, ("angle", "slope", "dimensionless", "length"))
    unit = table.units.get(layout.trim, "")
    dimension = conversion(unit).dimension if unit else "slope"
    if dimension == "angle":
        values = np.tan(values)
    elif dimension == "length":
        if not layout.trim_base:
            raise CampaignError(
                f"trim in {unit} needs the length it is measured over",
                cure="give trim_base in m",
                place=layout.trim,
            )
        values = values / layout.trim_base
    return values if layout.trim_positive == "bow-down" else -values


def _plane(places: np.ndarray, readings: np.ndarray) -> tuple[np.ndarray, float]:
    """Sinkage at midship, trim and (when y differs) heel by least squares, and the misfit."""
    columns = [np.ones(len(places)), places[:, 0], places[:, 1]]
    design = np.column_stack(columns)
    if np.linalg.matrix_rank(design) < 3:
        design = design[:, :2]
    solution = np.linalg.lstsq(design, readings.T, rcond=None)[0]
    left = readings.T - design @ solution
    # With as many sensors as unknowns the plane goes through them; what is left is rounding.
    misfit = float(np.sqrt(np.mean(left**2))) if len(places) > design.shape[1] else 0.0
    return solution, misfit
