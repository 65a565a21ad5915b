"""What can be wrong with a file of sinkage and trim, each fault by its name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.findings import Finding, Severity
from ..formats.units import conversion
from .sinkage_layout import SinkageLayout

if TYPE_CHECKING:
    from ..formats.raw_table import RawTable

FEWEST_SAMPLES = 10
LONG_STEP = 1.5
"""A step of time longer than this many usual ones is a gap."""
LARGEST_SHARE_OF_LENGTH = 0.05
"""Sinkage beyond this part of the ship's length is in another unit."""

_ANGLES = {"roll", "heel", "pitch", "trim", "yaw", "psi", "phi", "theta"}


def audit_sinkage(table: RawTable, layout: SinkageLayout) -> list[Finding]:
    """Faults of a file, in the order file, time, channels.

    Rules: ``not-utf8``, ``units-row``, ``heading-width``, ``moment-named-as-angle``, ``no-unit``, ``too-short``,
    ``time-not-increasing``, ``gap``, ``all-missing``, ``missing-values``, ``constant-channel``,
    ``sinkage-too-large``.

    Parameters
    ----------
    table : RawTable
        The file as read.
    layout : SinkageLayout
        The channels that are used; those of the file that are not are looked at for their names only.
    """
    return [*heading_findings(table), *time_findings(table, layout.time), *_of_channels(table, layout)]


def heading_findings(table: RawTable) -> list[Finding]:
    """Faults of the heading of a file: ``not-utf8``, ``units-row``, ``heading-width``, ``moment-named-as-angle``."""
    found = []
    dialect = table.dialect
    if dialect is not None and not dialect.encoding.startswith(("utf-8", "utf-16")):
        found.append(
            Finding(
                "not-utf8",
                "warning",
                f"the text is {dialect.encoding}, not UTF-8",
                table.path,
                "heading",
                "read it as such; a reader that expects UTF-8 stops here",
            )
        )
    if dialect is not None and dialect.units_row is not None and dialect.units_row >= 0:
        row = dialect.units_row
        found.append(
            Finding(
                "units-row",
                "info",
                f"units stand in a row of their own below the names: {', '.join(filter(None, table.units.values()))}",
                table.path,
                f"row {row + 1}",
                "skip the row when the file is read as plain numbers",
            )
        )
    if dialect is not None and table.header:
        cells = len(table.header[-1].rstrip("\r\n").split(dialect.delimiter or None))
        width = len(table.file_columns)
        if cells != width:
            found.append(
                Finding(
                    "heading-width",
                    "warning",
                    f"the heading has {cells} cells and the data {width}",
                    table.path,
                    "heading",
                    "columns are counted from the left; the surplus cell is empty",
                )
            )
    for name, unit in table.units.items():
        if name.strip().lower() in _ANGLES and unit and conversion(unit).dimension in ("moment", "force"):
            found.append(
                Finding(
                    "moment-named-as-angle",
                    "warning",
                    f"'{name}' is in {unit}: a {conversion(unit).dimension} under the name of an angle",
                    table.path,
                    f"channel {name}",
                    "take it for the moment that holds the model, not for its motion",
                )
            )
    return found


def time_findings(table: RawTable, name: str, *, gaps: Severity = "error") -> list[Finding]:
    """Faults of the time: ``too-short``, ``missing-values``, ``time-not-increasing``, ``gap``.

    Parameters
    ----------
    table : RawTable
    name : str
        The channel of time.
    gaps : {"error", "warning", "info"}
        How grave a gap is: hours at sea may have one, a run in a tank may not.
    """
    time = table.columns[name]
    place = f"channel {name}"
    if len(time) < FEWEST_SAMPLES:
        message = f"{len(time)} samples, at least {FEWEST_SAMPLES} are needed"
        return [Finding("too-short", "error", message, table.path, place, "give the whole record")]
    if not np.isfinite(time).all():
        message = f"time is missing in {np.count_nonzero(~np.isfinite(time))} of {len(time)} rows"
        return [Finding("missing-values", "error", message, table.path, place, "fill in the time")]
    steps = np.diff(time)
    if steps.min() <= 0.0:
        row = int(np.flatnonzero(steps <= 0.0)[0])
        message = f"time does not increase after {time[row]:.6g} s"
        return [Finding("time-not-increasing", "error", message, table.path, place, "cut or sort the record")]
    usual = float(np.median(steps))
    long = np.flatnonzero(steps > LONG_STEP * usual)
    if long.size:
        worst = int(long[np.argmax(steps[long])])
        message = (
            f"{long.size} gap(s), the longest after {time[worst]:.6g} s: "
            f"{steps[worst]:.4g} s instead of {usual:.4g} s"
        )
        return [Finding("gap", gaps, message, table.path, place, "choose a window without the gap")]
    return []


def _of_channels(table: RawTable, layout: SinkageLayout) -> list[Finding]:
    found = []
    for name in layout.channels:
        if name == layout.time or len(table) < FEWEST_SAMPLES:
            continue
        found.extend(value_findings(table, name, varies=name in layout.sinkage_channels))
        known = table.columns[name][np.isfinite(table.columns[name])]
        if known.size:
            found.extend(_of_size(table, layout, name, known))
    return found


def value_findings(table: RawTable, name: str, *, varies: bool, holes: Severity = "error") -> list[Finding]:
    """Faults of the values of a channel: ``all-missing``, ``missing-values``, ``constant-channel``.

    Parameters
    ----------
    table : RawTable
    name : str
    varies : bool
        Whether a sensor that works cannot give the same value all the time.
    holes : {"error", "warning", "info"}
        How grave single missing values are.
    """
    values = table.columns[name]
    place = f"channel {name}"
    known = values[np.isfinite(values)]
    if not known.size:
        message = "not one value is a number"
        return [Finding("all-missing", "error", message, table.path, place, "name another channel")]
    found = []
    if known.size < values.size:
        message = f"{values.size - known.size} of {values.size} values are missing"
        found.append(Finding("missing-values", holes, message, table.path, place, "choose a window without them"))
    if varies and np.ptp(known) == 0.0:
        message = f"every value is {known[0]:g}: the sensor did not measure"
        found.append(
            Finding("constant-channel", "error", message, table.path, place, "check the sensor and its cable")
        )
    return found


def _of_size(table: RawTable, layout: SinkageLayout, name: str, known: np.ndarray) -> list[Finding]:
    unit = table.units.get(name, "")
    place = f"channel {name}"
    if not unit:
        return [Finding("no-unit", "warning", "has no unit; taken as SI", table.path, place, "declare the unit")]
    if name not in layout.sinkage_channels or name == layout.trim:
        return []
    if conversion(unit).dimension != "length":
        # A force has no size in m: what the unit may be is told when the channel is brought to SI.
        return []
    # The median of the sizes: one spike is not a unit.
    usual = float(np.median(np.abs(known))) * conversion(unit).factor
    if usual <= LARGEST_SHARE_OF_LENGTH * layout.length:
        return []
    message = f"sinkage of {usual:.3g} m on a ship of {layout.length:g} m, read in {unit}"
    return [Finding("sinkage-too-large", "error", message, table.path, place, "check the unit (mm for m?)")]
