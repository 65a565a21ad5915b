"""From the file of a voyage to its squat: sensors, tables and rest are read, and every record is reduced."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..core.errors import CampaignError
from ..core.provenance import Provenance, file_hash
from .full_scale import FullScaleSquat, reduce_full_scale
from .rtk_antennas import AntennaLayout, AntennaRecord, read_antennas
from .static_reference import StaticReference, static_reference
from .tide import TideTable, read_current, read_water_level
from .voyage_file import CurrentEntry, TideEntry, VoyageFile, load_voyage

Progress = Callable[[str, int, int], None]


def reduce_voyage(path: str | Path, *, progress: Progress | None = None) -> list[FullScaleSquat]:
    """Squat of every record of a voyage file.

    Parameters
    ----------
    path : str or Path
        See :mod:`.voyage_file`.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    CampaignError
        When a key of the file is wrong or a record has no name of its own.
    ReadError, AuditError, FitError
        From the records and tables, as the functions of this room raise them.
    """
    path = Path(path)
    voyage = load_voyage(path)
    layout, folder = voyage.make_layout(), path.parent
    level, current = _level(voyage.tide, folder), _current(voyage.current, folder)
    reference = _reference(voyage, layout, level, folder)
    found: list[FullScaleSquat] = []
    for number, entry in enumerate(voyage.records):
        if progress is not None:
            progress("reducing", number, len(voyage.records))
        record = _read(voyage, layout, folder / entry.file)
        name = entry.name or Path(entry.file).stem
        if name in {squat.run for squat in found}:
            raise CampaignError(f"two records have the name '{name}'", cure="give each its own name", file=path)
        found.append(_reduce(voyage, record, reference, level, current, name))
    if progress is not None:
        progress("reducing", len(voyage.records), len(voyage.records))
    return found


def voyage_provenance(path: str | Path, found: list[FullScaleSquat]) -> Provenance:
    """Where the squat of a voyage came from: files with their digests, choices, findings.

    Parameters
    ----------
    path : str or Path
        The voyage file.
    found : list of FullScaleSquat
        From :func:`reduce_voyage`.
    """
    voyage = load_voyage(path)
    inputs = {str(path): file_hash(path)}
    for squat in found:
        inputs[squat.record.name] = squat.record.sha256
    for entry in (voyage.tide, voyage.current):
        if entry is not None and entry.file:
            table = Path(path).parent / entry.file
            inputs[str(table)] = file_hash(table)
    findings = tuple(finding for squat in found for finding in squat.record.findings)
    choices = {squat.run: dict(squat.choices) for squat in found}
    return Provenance(source=voyage.voyage.source or str(path), inputs=inputs, choices=choices, findings=findings)


def _read(voyage: VoyageFile, layout: AntennaLayout, file: Path) -> AntennaRecord:
    return read_antennas(file, layout, accepted=voyage.accept, units=voyage.sensors.units)


def _level(entry: TideEntry, folder: Path) -> TideTable:
    if entry.level is not None:
        return TideTable.constant(entry.level + entry.correction)
    return read_water_level(
        folder / entry.file,
        time=entry.time,
        level=entry.places or entry.column,
        correction=entry.correction,
        units=entry.units,
    )


def _current(entry: CurrentEntry | None, folder: Path) -> float | TideTable:
    if entry is None or entry.along is not None:
        return 0.0 if entry is None or entry.along is None else entry.along
    return read_current(
        folder / entry.file, time=entry.time, current=entry.places or entry.column, units=entry.units
    )


def _reference(voyage: VoyageFile, layout: AntennaLayout, level: TideTable, folder: Path) -> StaticReference:
    record = _read(voyage, layout, folder / (voyage.static.file or voyage.records[0].file))
    rho = 1025.0 if voyage.density is None else voyage.density.berth
    return static_reference(record, level, start=voyage.static.start, stop=voyage.static.stop, rho=rho)


def _reduce(
    voyage: VoyageFile,
    record: AntennaRecord,
    reference: StaticReference,
    level: TideTable,
    current: float | TideTable,
    name: str,
) -> FullScaleSquat:
    density, bottom, draught = voyage.density, voyage.bottom, voyage.draught
    rho: float | np.ndarray | None = None
    if density is not None:
        rho = record.extra[density.column] if density.column else density.under_way
    depth: float | np.ndarray | None = None
    if bottom is not None:
        depth = record.extra[bottom.column] if bottom.column else bottom.charted_depth
    return reduce_full_scale(
        record,
        reference,
        level,
        rho=rho,
        volume=voyage.make_ship().volume,
        waterplane_area=None if density is None else density.waterplane_area,
        current=current,
        charted_depth=depth,
        draught=None if draught is None else 0.5 * (draught.forward + draught.aft),
        static_trim=0.0 if draught is None else (draught.forward - draught.aft) / record.layout.length,
        u_depth=0.0 if bottom is None else bottom.uncertainty,
        u_draught=0.0 if draught is None else draught.uncertainty,
        window=voyage.steady.window,
        accuracies=voyage.accuracy.make_accuracies(),
        run=name,
    )
