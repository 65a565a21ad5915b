"""The audit of a file before its channels are mapped: what the reader noticed, and what the header says."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace

from ..core.findings import Finding
from ..core.ship import Ship
from ..formats.raw_table import RawTable
from .audit_rules import RULES, finding
from .run_types import Run

_NUMBER = re.compile(r"^\s*1?\s*:?\s*(?P<number>[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*(?P<unit>[A-Za-z/^0-9]*)")
_LENGTH_KEYS = ("lpp", "lbp", "lengthbetweenperpendiculars", "modellength", "length", "l")
_DENSITY_KEYS = ("rho", "density", "waterdensity", "densityofwater", "rhow")
_SCALE_KEYS = ("scale", "modelscale", "scalefactor", "lambda", "scaleratio")
_WATER_KEYS = ("water", "watertype", "typeofwater")
_METRES = {"": 1.0, "m": 1.0, "mm": 1e-3, "cm": 1e-2}
_YAW_RATE = ("r'", "r′", "rprime", "r_prime")
_YAW_ACCELERATION = ("rdot'", "rdot′", "r'dot", "rdotprime", "rdot_prime")


def audit_table(table: RawTable, run: Run | None, *, ship: Ship | None = None) -> list[Finding]:
    """Findings about one file.

    Parameters
    ----------
    table : RawTable
        As read; its own findings are passed on first.
    run : Run or None
        None for a zero run.
    ship : Ship, optional
        Compared with the header when given.

    Returns
    -------
    list of Finding
    """
    # Readers that know no cure take that of the rule.
    found = [item if item.cure else replace(item, cure=RULES[item.rule].cure) for item in table.findings]
    known = {item.rule for item in found}
    dialect = table.dialect
    if dialect is not None:
        if dialect.decimal == "," and "decimal-comma" not in known:
            found.append(finding("decimal-comma", "numbers were read with decimal commas", file=table.path))
        if dialect.encoding.lower().replace("-", "") not in ("utf8", "utf8sig", "ascii") and (
            "header-encoding" not in known
        ):
            text = f"the header is not utf-8; it was read as {dialect.encoding}"
            found.append(finding("header-encoding", text, file=table.path))
    entries = {_key(name): value for name, value in table.metadata.items()}
    if ship is not None and entries:
        found += _particulars(entries, ship, table.path)
    if run is not None and run.harmonic and run.speed:
        found += _length_of_rates(table, run, ship, entries)
    return found


def _key(name: str) -> str:
    return re.sub(r"[^a-z]", "", re.sub(r"[\[(].*?[\])]", "", name.lower()))


def _entry(entries: Mapping[str, str | float], keys: tuple[str, ...]) -> tuple[float, str] | None:
    """First numeric entry under one of `keys`, with its unit in lower case."""
    for key in keys:
        value = entries.get(key)
        if isinstance(value, str):
            match = _NUMBER.match(value)
            if match:
                return float(match["number"].replace(",", ".")), match["unit"].lower()
        elif value is not None and math.isfinite(value):
            return float(value), ""
    return None


def _particulars(entries: Mapping[str, str | float], ship: Ship, file: str) -> list[Finding]:
    found = []
    length = _length(entries)
    if length is not None and abs(length / ship.L - 1.0) > 0.02:
        by_scale = any(abs(length / ship.L / factor - 1.0) < 0.02 for factor in (ship.scale, 1.0 / ship.scale))
        name = "scale-label" if by_scale and ship.scale != 1.0 else "wrong-length"
        text = f"the header gives a length of {length:.5g} m, the campaign's ship has L = {ship.L:.5g} m"
        found.append(finding(name, text, file=file, place="header"))
    density = _entry(entries, _DENSITY_KEYS)
    if density is not None:
        value = density[0] * (1000.0 if density[0] < 10.0 else 1.0)
        if abs(value / ship.rho - 1.0) > 0.005:
            text = f"the header gives a water density of {value:.5g} kg/m3, the campaign's ship has {ship.rho:.5g}"
            found.append(finding("density", text, file=file, place="header"))
    else:
        found += _kind_of_water(entries, ship, file)
    scale = _entry(entries, _SCALE_KEYS)
    if scale is not None and scale[0] > 0:
        # 46.6, 1:46.6 and 0.02146 say the same.
        value = max(scale[0], 1.0 / scale[0])
        if abs(value / ship.scale - 1.0) > 0.01:
            text = f"the header gives a scale of 1:{value:.5g}, the campaign's ship has 1:{ship.scale:.5g}"
            found.append(finding("scale-label", text, file=file, place="header"))
    return found


def _length(entries: Mapping[str, str | float]) -> float | None:
    entry = _entry(entries, _LENGTH_KEYS)
    if entry is None or entry[1] not in _METRES or entry[0] <= 0:
        return None
    return entry[0] * _METRES[entry[1]]


def _kind_of_water(entries: Mapping[str, str | float], ship: Ship, file: str) -> list[Finding]:
    said = " ".join(str(entries[key]).lower() for key in _WATER_KEYS if key in entries)
    fresh, salt = "fresh" in said, "salt" in said or "sea" in said
    if fresh == salt or (fresh and ship.rho < 1010.0) or (salt and ship.rho > 1010.0):
        return []
    kind = "fresh" if fresh else "salt"
    text = f"the header says {kind} water, the campaign's ship has a density of {ship.rho:.5g} kg/m3"
    return [finding("density", text, file=file, place="header")]


def _length_of_rates(
    table: RawTable, run: Run, ship: Ship | None, entries: Mapping[str, str | float]
) -> list[Finding]:
    """Length behind non-dimensional rates: rdot'/r' = omega L/U."""
    names = {name.replace(" ", "").lower(): name for name in table.columns}
    rate = next((names[key] for key in _YAW_RATE if key in names), None)
    acceleration = next((names[key] for key in _YAW_ACCELERATION if key in names), None)
    length = ship.L if ship is not None else _length(entries)
    if rate is None or acceleration is None or length is None:
        return []
    half = len(table) // 2
    spread = float(table.columns[rate][half:].std())
    if not spread > 0:
        return []
    ratio = float(table.columns[acceleration][half:].std()) / spread
    behind = ratio * run.speed / run.frequency
    if abs(behind / length - 1.0) <= 0.03:
        return []
    text = (
        f"{acceleration} over {rate} is {ratio:.5g}, but omega L/U is {run.frequency * length / run.speed:.5g} "
        f"with L = {length:.5g} m: the rates were made with a length of {behind:.5g} m"
    )
    return [finding("wrong-length", text, file=table.path, place=f"columns {rate}, {acceleration}")]
