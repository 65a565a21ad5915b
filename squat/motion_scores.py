"""Computed motions in waves against measured ones, amplitude and phase together: columns x_amplitude and x_phase."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import ReadError
from ..formats.units import conversion
from ..verify import at_measured_points, complex_error, phase_difference, phasor
from .curve_table import CASE, CurveTable

if TYPE_CHECKING:
    import pandas as pd

AMPLITUDE, PHASE = "_amplitude", "_phase"
ALL_MOTIONS = "all"
MOTION_COLUMNS = ("code", "case", "motion", "n", "complex_error", "amplitude_error [%]", "phase_difference [deg]")


def motions_of(table: CurveTable) -> list[str]:
    """Names of the quantities that a table has with amplitude and phase."""
    stems = [name.removesuffix(AMPLITUDE) for name in table.quantities if name.endswith(AMPLITUDE)]
    return [stem for stem in stems if stem + PHASE in table.quantities]


def motion_scores(measured: CurveTable, codes: Sequence[CurveTable]) -> pd.DataFrame:
    """Complex error of each motion, and of all motions of one unit together.

    Parameters
    ----------
    measured : CurveTable
    codes : sequence of CurveTable
        In the units of the measurement. Phasors are brought to the measured points by straight lines in the complex
        plane, never beyond the ends of a computation.

    Returns
    -------
    DataFrame
        Columns :data:`MOTION_COLUMNS`: ``sqrt(sum |S - D|^2 / sum |D|^2)``, mean of (|S| - |D|)/|D| in per cent, root
        mean square of the phase of S ahead of D in degrees. Without rows when no motion has both columns.

    Raises
    ------
    ReadError
        When a phase has no unit or is no angle, or an amplitude is negative.
    """
    import pandas as pd

    rows: list[dict[str, Any]] = []
    motions = motions_of(measured)
    for code in codes:
        shared = [name for name in motions if name in motions_of(code)]
        for case in measured.cases:
            if case not in code.cases:
                continue
            pairs = {name: _pair(measured, code, case, name) for name in shared}
            rows += [_row(code.name, case, name, *pair) for name, pair in pairs.items()]
            if len(pairs) > 1 and len({measured.units[name + AMPLITUDE] for name in pairs}) == 1:
                s, d = (np.concatenate([pair[k] for pair in pairs.values()]) for k in (0, 1))
                rows.append(_row(code.name, case, ALL_MOTIONS, s, d))
    return pd.DataFrame(rows, columns=list(MOTION_COLUMNS))


def _pair(measured: CurveTable, code: CurveTable, case: str, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Phasors of computation and measurement at the measured points; nan outside the computation."""
    over, data = _phasors(measured, case, name)
    at, computed = _phasors(code, case, name)
    parts = [at_measured_points(over, at, part) for part in (computed.real, computed.imag)]
    return parts[0] + 1j * parts[1], data


def _phasors(table: CurveTable, case: str, name: str) -> tuple[np.ndarray, np.ndarray]:
    unit = table.units.get(name + PHASE, "")
    if not unit or conversion(unit).dimension != "angle":
        raise ReadError(
            f"is in {unit}, which is no angle" if unit else "has no unit: degrees and radians look alike",
            cure=f"write {name}{PHASE} [deg] or [rad] in the heading, or use --unit {name}{PHASE}=deg",
            file=table.path,
            place=f"column {name}{PHASE}",
        )
    columns = [table.by, name + AMPLITUDE, name + PHASE]
    rows = table.frame.loc[table.frame[CASE] == case, columns].dropna()
    over, amplitude, phase = (rows[column].to_numpy(dtype=float) for column in columns)
    if (amplitude < 0.0).any():
        raise ReadError(
            f"the amplitude {amplitude.min():g} is negative",
            cure="give its size, and the phase turned by 180 degrees",
            file=table.path,
            place=f"column {name}{AMPLITUDE}",
        )
    return over, phasor(amplitude, phase * conversion(unit).factor)


def _row(code: str, case: str, name: str, s: np.ndarray, d: np.ndarray) -> dict[str, Any]:
    known = np.isfinite(s) & np.isfinite(d) & (np.abs(d) > 0.0)
    turned = phase_difference(s[known], d[known])
    n = int(np.count_nonzero(known))
    size = float(np.mean(np.abs(s[known]) / np.abs(d[known]) - 1.0)) if n else float("nan")
    turn = float(np.degrees(np.sqrt(np.mean(turned**2)))) if n else float("nan")
    return dict(zip(MOTION_COLUMNS, (code, case, name, n, complex_error(s, d), 100.0 * size, turn), strict=True))
