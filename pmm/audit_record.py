"""The audit of one run: the header of its file, and its record in SI against the test matrix.

Every check is a named rule of :mod:`~towtank.pmm.audit_rules`. A clean record costs a fraction of a millisecond.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..core.findings import Finding
from ..core.record import Record
from ..core.ship import Ship
from .audit_channels import audit_channels, audit_steadiness
from .audit_matrix import audit_angles
from .audit_motion import audit_frequency, audit_oscillation
from .audit_rules import finding
from .audit_steady_motion import audit_constant_angles, audit_steady_motion, rows_at_speed
from .audit_table import audit_table
from .audit_time import audit_time
from .run_types import Run

__all__ = ["audit_record", "audit_table"]

_LIVELY = {
    "pure_sway": frozenset({"y", "v", "vdot", "Y", "N"}),
    "pure_yaw": frozenset({"y", "psi", "r", "rdot", "Y", "N"}),
    "yaw_drift": frozenset({"y", "psi", "r", "rdot", "Y", "N"}),
    "sway_yaw": frozenset({"y", "psi", "r", "rdot", "Y", "N"}),
    "pure_surge": frozenset({"u", "udot", "X"}),
    "dry_sway": frozenset({"y", "Y"}),
    "dry_yaw": frozenset({"psi", "r", "rdot", "N"}),
    "dry_surge": frozenset({"u", "udot", "X"}),
}


def audit_record(
    record: Record, run: Run, ship: Ship, *, reference: float = 0.0, measured_motion: bool = False
) -> list[Finding]:
    """Findings about the record of one run.

    Parameters
    ----------
    record : Record
        Channels in SI, home axes and signs, by their standard names; ``time`` is needed.
    run : Run
        What the test matrix says.
    ship : Ship
    reference : float
        Point that follows the prescribed path, m forward of midship.
    measured_motion : bool
        True when the reduction takes the motion from the record, so that its phase against the matrix is free.

    Returns
    -------
    list of Finding
        In the order of the checks; empty for a clean record.

    Raises
    ------
    ReadError
        When the record has no time channel.
    """
    if absurd := audit_angles(run):
        return [replace(item, file=record.source) for item in absurd]
    time = record.time
    found, usable = audit_time(time)
    if usable:
        channels = record.channels
        rows = slice(0, len(time)) if run.harmonic else rows_at_speed(channels, len(time))
        unit = 0.5 * ship.rho * ship.L * ship.T * run.speed**2
        found += audit_channels(channels, time, rows, lively=_LIVELY.get(run.kind, frozenset()), force_unit=unit)
        incomplete = {item.place for item in found if item.rule == "missing-values"}
        if incomplete:
            channels = {name: values for name, values in channels.items() if f"channel {name}" not in incomplete}
        if run.harmonic:
            cycles = _cycles(time, run)
            if any(item.severity == "error" for item in cycles):
                found += audit_frequency(channels, time, run) or cycles
            else:
                found += cycles
                found += audit_oscillation(channels, time, run, ship, reference)
        else:
            found += audit_steadiness(channels, rows)
            found += audit_steady_motion(channels, time, rows, run, ship, reference)
        found += audit_constant_angles(channels, rows, run)
    if measured_motion:
        found = [item for item in found if item.rule != "phase-mismatch"]
    return [
        replace(item, file=record.source, place=f"run '{run.name}'" + (f", {item.place}" if item.place else ""))
        for item in found
    ]


def _cycles(time: np.ndarray, run: Run) -> list[Finding]:
    length = float(time[-1] - time[0]) * len(time) / (len(time) - 1)
    cycles = length / run.period
    if cycles >= 1.95 or not math.isfinite(cycles):
        return []
    return [
        finding(
            "short-of-whole-cycles",
            f"the record of {length:.4g} s holds {cycles:.2f} cycles of {run.period:.4g} s; two are needed to "
            "leave out the transient",
            severity="error" if cycles < 0.98 else "warning",
        )
    ]
