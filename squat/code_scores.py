"""Many computations scored against one experiment: by case and quantity, ranked, pooled, at full scale.

Errors are S - D, computed less measured: positive where the computation is larger. The bias score BS counts the
signs of D - S, as its authors do: negative where the computation is larger.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import TowtankError
from ..core.findings import Finding
from ..formats.units import conversion
from ..verify.curve_scores import pooled_scores, score_codes, score_curves
from ..verify.scores import at_measured_points, relative_errors, z_score
from .curve_table import CASE, CurveTable
from .motion_scores import PHASE, motion_scores, motions_of

if TYPE_CHECKING:
    import pandas as pd

CASE_COLUMNS = ("case", "quantity", "n", "Q", "BS", "bias", "rms", "max_abs", "unit")
"""Columns of ``scores.csv``."""

SIGNS = (
    "errors are S - D (computed less measured): positive means computed larger; BS sums the signs of D - S: "
    "negative means computed larger"
)

ALL = "all"
_FAR = 100.0
"""A typical ratio of computation to measurement beyond this is a unit."""


@dataclass(frozen=True, eq=False)
class CodeScores:
    """Scores of computations against a measurement.

    Attributes
    ----------
    measured : CurveTable
    codes : tuple of CurveTable
        In the units of the measurement.
    scale : float
        Full-scale length over that of the tables, for the deviations at full scale.
    details : DataFrame
        code, case, quantity, then every score of :func:`.curve_scores.score_curves`, and bias, rms and max_abs at
        full scale with their unit (m, deg, m/s).
    points : DataFrame
        One row for each code, case, quantity and measured point: D, S, S - D, the relative errors in the three
        conventions (per cent), z where an uncertainty is known.
    ranking : DataFrame
        quantity (or ``all [unit]``), rank, code and scores; smallest rms first.
    totals : DataFrame
        code, quantity (``all`` too), n, Q and BS over all cases.
    motions : DataFrame
        Complex errors of motions that have amplitude and phase, see :func:`.motion_scores.motion_scores`.
    findings : tuple of Finding
    """

    measured: CurveTable
    codes: tuple[CurveTable, ...]
    scale: float
    details: pd.DataFrame
    points: pd.DataFrame
    ranking: pd.DataFrame
    totals: pd.DataFrame
    motions: pd.DataFrame
    findings: tuple[Finding, ...]

    @property
    def scores(self) -> pd.DataFrame:
        """Columns :data:`CASE_COLUMNS`, one row for each case and quantity.

        ``case`` names the computation, the case of the experiment, or both, whatever tells the rows apart.
        """
        frame = self.details.copy()
        named = self.measured.cases != [""]
        if named and len(self.codes) > 1:
            frame["case"] = frame["code"] + ", " + frame["case"]
        elif not named:
            frame["case"] = frame["code"]
        return frame[list(CASE_COLUMNS)]

    def to_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return {
            "format": "towtank scores 1",
            "signs": SIGNS,
            "by": self.measured.by,
            "scale": self.scale,
            "measured": self.measured.path,
            "codes": {one.name: one.path for one in self.codes},
            "scores": plain_rows(self.scores),
            "details": plain_rows(self.details),
            "ranking": plain_rows(self.ranking),
            "totals": plain_rows(self.totals),
            "motions": plain_rows(self.motions),
            "points": plain_rows(self.points),
            "findings": [vars(item) for item in self.findings],
        }


def plain_rows(frame: pd.DataFrame) -> list[dict[str, Any]]:
    """Rows of a table as plain data; None for what is not a finite number."""
    return [
        {
            str(key): None if isinstance(value, float) and not np.isfinite(value) else value
            for key, value in row.items()
        }
        for row in frame.to_dict("records")
    ]


def score_tables(
    measured: CurveTable,
    codes: Sequence[CurveTable],
    *,
    scale: float = 1.0,
    near_zero: Mapping[str, float] | None = None,
) -> CodeScores:
    """Score computations against a measurement.

    Parameters
    ----------
    measured : CurveTable
    codes : sequence of CurveTable
        Each is brought to the measured points by straight lines, never beyond its own ends.
    scale : float
        Full-scale length over that of the tables.
    near_zero : mapping of str to float, optional
        Size of a quantity, in its unit, up to which a measurement counts as zero.

    Raises
    ------
    TowtankError
        When nothing can be compared: no shared quantity or case, no measured point inside a computation, units that
        do not fit, two codes of one name.
    """
    import pandas as pd

    if not scale > 0.0:
        raise TowtankError(f"a scale of {scale:g} is impossible", cure="give 89.11 for a model 1:89.11")
    names = [one.name for one in codes]
    if len(set(names)) < len(names):
        again = next(name for name in names if names.count(name) > 1)
        raise TowtankError(f"two computations have the name '{again}'", cure="rename one of the files")
    brought = tuple(one.in_units_of(measured) for one in codes)
    found = [*measured.findings, *(item for one in codes for item in one.findings)]
    tables, points = [], []
    for code in brought:
        for case, data, computed in _pairs(measured, code, found):
            label = f"{code.path}" + (f", case {case}" if case else "")
            try:
                scored = score_curves(
                    data, computed, measured.by, case=label, units=measured.units, near_zero=near_zero
                )
            except TowtankError as error:
                raise TowtankError(error.cause, cure=error.cure, file=code.path, place=case) from None
            tables.append(scored.assign(case=case, code=code.name))
            points += list(_points(measured, code, case, data, computed, scored["quantity"].tolist(), near_zero))
    details = pd.concat(tables, ignore_index=True)
    details = details[["code", *(name for name in details.columns if name != "code")]]
    details = _at_full_scale(details, scale)
    frame = pd.DataFrame(points)
    found += _suspicions(frame)
    return CodeScores(
        measured,
        brought,
        scale,
        details,
        frame,
        _ranking(frame),
        _totals(details),
        motion_scores(measured, brought),
        tuple(dict.fromkeys(found)),
    )


def _pairs(
    measured: CurveTable, code: CurveTable, found: list[Finding]
) -> Iterator[tuple[str, pd.DataFrame, pd.DataFrame]]:
    """Case by case the measured rows and the computed ones."""
    if code.cases == [""] and measured.cases != [""]:
        raise TowtankError(
            f"has no column 'case', the measurement has {', '.join(measured.cases)}",
            cure="name the case of each row",
            file=code.path,
        )
    shared = [case for case in measured.cases if case in code.cases]
    if not shared:
        raise TowtankError(
            f"shares no case with the measurement, which has {', '.join(measured.cases) or 'none'}",
            cure="name the cases alike",
            file=code.path,
        )
    for case in measured.cases:
        if case not in shared:
            found.append(
                Finding("case-missing", "warning", f"case {case} is not computed", code.path, cure="compute it")
            )
    # 359 and 1 degrees are alike: a phase is scored with its amplitude, as a phasor
    aside = [CASE, *(name + PHASE for name in motions_of(measured))]
    missing = [name for name in measured.quantities if name not in code.quantities]
    if missing and len(missing) < len(measured.quantities):
        found.append(Finding("quantity-missing", "info", f"not computed: {', '.join(missing)}", code.path))
    for case in shared:
        yield (
            case,
            measured.frame[measured.frame[CASE] == case].drop(columns=aside),
            code.frame[code.frame[CASE] == case].drop(columns=aside, errors="ignore"),
        )


def _points(
    measured: CurveTable,
    code: CurveTable,
    case: str,
    data: pd.DataFrame,
    computed: pd.DataFrame,
    quantities: Sequence[str],
    near_zero: Mapping[str, float] | None,
) -> Iterator[dict[str, Any]]:
    over = data[measured.by].to_numpy(dtype=float)
    for name in quantities:
        given = computed[[measured.by, name]].dropna()
        d = data[name].to_numpy(dtype=float)
        at = given[measured.by].to_numpy(dtype=float)
        s = at_measured_points(over, at, given[name].to_numpy(dtype=float))
        errors = relative_errors(s, d, near_zero=(near_zero or {}).get(name))
        sd_s = None
        if name in code.errors:
            of = code.errors.loc[given.index, name].to_numpy(dtype=float)
            sd_s = at_measured_points(over, at, of)
        sd_d = measured.errors.loc[data.index, name].to_numpy(dtype=float) if name in measured.errors else None
        z = z_score(s, d, sd_s, sd_d)
        for k in range(over.size):
            yield {
                "code": code.name,
                "case": case,
                "quantity": name,
                measured.by: float(over[k]),
                "D": float(d[k]),
                "S": float(s[k]),
                "S - D": float(s[k] - d[k]),
                "(S - D)/D [%]": float(errors.s_minus_d[k]),
                "(D - S)/D [%]": float(errors.d_minus_s[k]),
                "|S - D|/|D| [%]": float(errors.absolute[k]),
                "z": float(z[k]),
                "unit": measured.units[name],
            }


def _at_full_scale(details: pd.DataFrame, scale: float) -> pd.DataFrame:
    factors, units = [], []
    for unit in details["unit"]:
        factor, shown = full_scale_unit(unit, scale)
        factors.append(factor)
        units.append(shown)
    frame = details.copy()
    for name in ("bias", "rms", "max_abs"):
        frame[f"{name}_full_scale"] = details[name] * np.array(factors)
    frame["unit_full_scale"] = units
    return frame


def full_scale_unit(unit: str, scale: float) -> tuple[float, str]:
    """Factor from a value in `unit` to full scale, and the unit there; nan where the dimension is not known.

    Lengths become m, angles and slopes degrees (small trim), speeds m/s; others have no factor here.
    """
    if not unit:
        return float("nan"), ""
    own = conversion(unit)
    if own.dimension == "length":
        return own.factor * scale, "m"
    if own.dimension in ("angle", "slope"):
        return own.factor * 180.0 / np.pi, "deg"
    if own.dimension == "velocity":
        return own.factor * float(np.sqrt(scale)), "m/s"
    return float("nan"), ""


def _ranking(points: pd.DataFrame) -> pd.DataFrame:
    """Codes by quantity, and over all quantities of one unit where there are several."""
    import pandas as pd

    scopes: list[tuple[str, list[str]]] = [(str(name), [str(name)]) for name in points["quantity"].unique()]
    for unit, names in points.groupby("unit", sort=False)["quantity"].unique().items():
        if len(names) > 1:
            scopes.append((f"{ALL} [{unit}]" if unit else ALL, [str(name) for name in names]))
    parts = []
    for label, names in scopes:
        rows = points[points["quantity"].isin(names)]
        # two measured points may share a speed, so that points are told apart by their number in the curve
        number = rows.groupby(["code", "case", "quantity"], sort=False).cumcount().astype(str)
        keyed = rows.assign(key=rows["case"] + "|" + rows["quantity"] + "|" + number)
        data = dict(zip(keyed["key"], keyed["D"], strict=True))
        codes = {
            str(code): dict(zip(of["key"], of["S"], strict=True)) for code, of in keyed.groupby("code", sort=False)
        }
        parts.append(score_codes(data, codes).assign(quantity=label))
    table = pd.concat(parts, ignore_index=True)
    return table[["quantity", *(name for name in table.columns if name != "quantity")]]


def _totals(details: pd.DataFrame) -> pd.DataFrame:
    import pandas as pd

    parts = []
    for code, of in details.groupby("code", sort=False):
        pooled = [pooled_scores(of)]
        if of["quantity"].nunique() > 1:
            pooled.append(pooled_scores(of.assign(quantity=ALL)))
        parts.append(pd.concat(pooled, ignore_index=True).assign(code=code))
    table = pd.concat(parts, ignore_index=True)
    return table[["code", "quantity", "n", "Q", "BS"]]


def _suspicions(points: pd.DataFrame) -> list[Finding]:
    found = []
    for (code, quantity), rows in points.groupby(["code", "quantity"], sort=False):
        pairs = rows[["D", "S"]].dropna()
        d, s = pairs["D"].to_numpy(dtype=float), pairs["S"].to_numpy(dtype=float)
        if len(d) > 1 and (d * s < 0.0).all():
            found.append(
                Finding(
                    "opposite-sign",
                    "warning",
                    f"every computed {quantity} has the sign opposite to the measured one",
                    str(code),
                    str(quantity),
                    "bring both to one sign convention",
                )
            )
        sizes = np.median(np.abs(d)) if len(d) else 0.0
        ratio = float(np.median(np.abs(s)) / sizes) if sizes > 0.0 else 1.0
        if ratio > _FAR or 0.0 < ratio < 1.0 / _FAR:
            found.append(
                Finding(
                    "unit-suspected",
                    "warning",
                    f"computed {quantity} is typically {ratio:.3g} times the measured one",
                    str(code),
                    str(quantity),
                    "check the units of both (mm for m? model for full scale?)",
                )
            )
    return found
