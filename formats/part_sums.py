"""Totals of forces of which a solver writes only the parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .solver_log import SolverLog

_PARTS = ("pressure", "viscous", "porous")
_TOLERANCE = 1e-4
_COMPONENTS = tuple(letter + axis for letter in "FM" for axis in "xyz")


def missing_totals(names: Sequence[str]) -> dict[str, list[str]]:
    """Totals that are not among `names`, as ``Fx_total``, and the parts that add up to each."""
    found = {}
    for component in _COMPONENTS:
        parts = [f"{component}_{part}" for part in _PARTS if f"{component}_{part}" in names]
        if parts and f"{component}_total" not in names:
            found[f"{component}_total"] = parts
    return found


def totals_note(totals: dict[str, list[str]]) -> str:
    """What the totals are, in words."""
    there = {part.partition("_")[2] for parts in totals.values() for part in parts}
    return f"totals are the sum of the parts: {' + '.join(part for part in _PARTS if part in there)}"


def force_unit(name: str) -> str:
    """Unit of ``Fx_total`` and ``Mz_viscous`` as solvers write them."""
    return "N" if name.startswith("F") else "N m"


def with_totals(log: SolverLog) -> SolverLog:
    """A history of forces with ``Fx_total`` and so on: the sum of the parts where the solver writes no total.

    Totals that the solver writes are compared with the sum of pressure, viscous and porous part, and a difference is
    told.
    """
    if log.kind != "forces":
        return log
    totals = missing_totals([str(name) for name in log.frame.columns])
    differing = _differing(log)
    notes = log.notes
    if differing:
        notes = (*notes, f"{', '.join(differing)} as printed is not the sum of its parts")
    if not totals:
        return replace(log, notes=notes)
    frame = log.frame.copy()
    for place, (name, parts) in enumerate(totals.items(), start=1):
        frame.insert(place, name, frame[parts].to_numpy().sum(axis=1))
    units = {**log.units, **{name: force_unit(name) for name in totals}}
    return replace(log, frame=frame, units=units, notes=(*notes, totals_note(totals)))


def _differing(log: SolverLog) -> list[str]:
    """Printed totals that are not the sum of their parts."""
    found = []
    frame = log.frame
    for component in _COMPONENTS:
        parts = [f"{component}_{part}" for part in _PARTS if f"{component}_{part}" in frame]
        total = f"{component}_total"
        if total not in frame or not {f"{component}_pressure", f"{component}_viscous"} <= set(parts):
            continue
        values = frame[parts].to_numpy()
        error = np.abs(frame[total].to_numpy() - values.sum(axis=1))
        if np.nanmax(error, initial=0.0) > _TOLERANCE * np.nanmax(np.abs(values), initial=0.0):
            found.append(total)
    return found
