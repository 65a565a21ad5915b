"""Derivative sets from files: derivatives.json, or a published table typed into a CSV file.

A table has the columns ``name``, ``value`` and, where known, ``std`` and ``scaling``. What gives its numbers a
meaning stands above it in comment lines::

    # name = KVLCC2, Yasukawa and Yoshimura 2015
    # source = J Mar Sci Technol 20, Table 3
    # ship.name = KVLCC2 model L7
    # ship.L = 7.0
    # ship.B = 1.27
    # ship.T = 0.455
    # force_scaling = LT
    # added_mass_coriolis = outside
    name,value,std
    Yv,-0.315,0.01

Conventions that are not named are those of home (:class:`towtank.core.Conventions`). A table that names no ship
can be compared, but not converted by anything that needs the particulars of the ship.
"""

from __future__ import annotations

import json
import math
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..core.conventions import CHOICES, Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError, ReadError, TowtankError
from ..core.provenance import Provenance, file_hash
from ..core.ship import Ship
from ..core.terms import parse_terms
from .numbered_rows import cell_number, numbered_rows

SETS_FORMAT = "towtank derivative sets 1"
"""Format of a derivatives.json that holds the sets of several groups."""

_CONVENTIONS = {item.name for item in fields(Conventions)}
_SHIP = {item.name for item in fields(Ship)}
_SHIP_TEXT = {"name"}
_HEAD = {"name", "source", "reference_speed"}


class ShipNotGiven(Ship):
    """The ship of a table that names none: asking for its length, breadth or draught is an error."""

    def __init__(self, file: str) -> None:
        object.__setattr__(self, "file", file)
        object.__setattr__(self, "name", "ship not given")
        for item in fields(Ship):
            if item.name not in ("name", "L", "B", "T"):
                object.__setattr__(self, item.name, item.default)

    def __getattr__(self, name: str) -> Any:
        if name in ("L", "B", "T"):
            raise ConventionError(
                f"the table does not say the {name} of its ship",
                cure=f"write above it, e.g. '# ship.{name} = 7.0'",
                file=self.__dict__.get("file"),
            )
        raise AttributeError(name)


def read_set(path: str | Path, *, ship: Ship | None = None) -> DerivativeSet:
    """Read a derivative set from a JSON file of towtank or from a table.

    Parameters
    ----------
    path : str or Path
        ``derivatives.json``, or a CSV file as the module describes. Beside a CSV file that towtank wrote, the JSON
        file of the same stem gives ship and conventions.
    ship : Ship, optional
        The ship of a table that names none; :class:`ShipNotGiven` otherwise.

    Returns
    -------
    DerivativeSet
        The covariance of a table is diagonal: tables do not print correlations.

    Raises
    ------
    ReadError
        Naming file, line, cause and cure.
    """
    path = Path(path)
    if path.suffix.lower() == ".json":
        return _single_set(path)
    header, rows = _split(path)
    values, spread, scalings = _columns(rows, path)
    known = _companion(path) if not header and ship is None else None
    if known is not None:
        particulars, conventions = known.ship, known.conventions
    else:
        particulars = ship or _ship(header, path)
        conventions = _conventions(header, scalings, path)
    if scalings - {conventions.force_scaling}:
        raise ReadError(
            f"the table says scaling {', '.join(sorted(scalings))}, its heading {conventions.force_scaling}",
            cure="mend one of them",
            file=path,
        )
    try:
        terms = parse_terms(values)
        speed = float(header["reference_speed"]) if "reference_speed" in header else None
    except TowtankError as error:
        raise type(error)(error.cause, cure=error.cure, file=path) from None
    except ValueError:
        raise ReadError(
            f"reference_speed = {header['reference_speed']} is not a number", cure="give it in m/s", file=path
        ) from None
    covariance = np.diag(np.array(spread) ** 2) if spread else None
    return DerivativeSet(
        name=header.get("name", path.stem),
        ship=particulars,
        terms=terms,
        values=np.array(list(values.values())),
        conventions=conventions,
        covariance=covariance,
        reference_speed=speed,
        provenance=Provenance(source=header.get("source", path.name), inputs={path.name: file_hash(path)}),
    )


def with_ship(derivatives: DerivativeSet, ship: Ship) -> DerivativeSet:
    """The set with another one's ship, when its own table names none and the other's is known; else the same set."""
    if not isinstance(derivatives.ship, ShipNotGiven) or isinstance(ship, ShipNotGiven):
        return derivatives
    return replace(derivatives, ship=ship)


def _single_set(path: Path) -> DerivativeSet:
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return DerivativeSet.from_json(path)  # which says what is wrong
    if isinstance(data, dict) and data.get("format") == SETS_FORMAT:
        labels = list(data.get("sets", {}))
        raise ReadError(
            f"the file holds {len(labels)} derivative sets: {', '.join(labels)}",
            cure="give the file of one group, derivatives-<group>.json",
            file=path,
        )
    return DerivativeSet.from_json(path)


def _companion(path: Path) -> DerivativeSet | None:
    """The set of the JSON file beside a table that towtank wrote."""
    other = path.with_suffix(".json")
    return _single_set(other) if other.is_file() else None


def _split(path: Path) -> tuple[dict[str, str], tuple[tuple[int, dict[str, str]], ...]]:
    """Heading of the comment lines, and the rows of the table with their line numbers."""
    table = numbered_rows(path, "name,value,std")
    header: dict[str, str] = {}
    for number, line in table.comments:
        key, equals, value = line.partition("=")
        if not equals:
            continue
        key = key.strip()
        if key not in _HEAD | _CONVENTIONS and key.removeprefix("ship.") not in _SHIP:
            raise ReadError(
                f"unknown key '{key}' in the heading",
                cure="use name, source, reference_speed, ship.<particular> or a convention: "
                + ", ".join(sorted(CHOICES)),
                file=path,
                place=f"line {number}",
            )
        header[key] = value.strip()
    if "name" not in table.names or "value" not in table.names:
        raise ReadError(
            f"the table has the columns {', '.join(table.names)}",
            cure="name them name,value and std where known",
            file=path,
        )
    return header, table.rows


def _columns(
    rows: tuple[tuple[int, dict[str, str]], ...], path: Path
) -> tuple[dict[str, float], list[float], set[str]]:
    """Values by name, standard uncertainties (empty when one is missing) and the scalings that are named."""
    values: dict[str, float] = {}
    spread: list[float] = []
    scalings: set[str] = set()
    for number, row in rows:
        name, place = row["name"], f"line {number}"
        if name in values:
            raise ReadError(f"'{name}' is given twice", cure="keep one row", file=path, place=place)
        values[name] = cell_number(row["value"], "value", path, place)
        if not math.isfinite(values[name]):
            raise ReadError(
                f"the value of '{name}' is missing", cure="fill or drop the row", file=path, place=place
            )
        if row.get("std"):
            spread.append(cell_number(row["std"], "std", path, place))
        if row.get("scaling"):
            scalings.add(row["scaling"])
    complete = len(spread) == len(values) and all(math.isfinite(sd) for sd in spread)
    return values, spread if complete else [], scalings


def _ship(header: dict[str, str], path: Path) -> Ship:
    given: dict[str, Any] = {}
    for key, value in header.items():
        part = key.removeprefix("ship.")
        if part != key:
            given[part] = value if part in _SHIP_TEXT else cell_number(value, key, path, "heading")
    if not given:
        return ShipNotGiven(str(path))
    try:
        return Ship.from_dict({"name": "ship of the table"} | given)
    except TowtankError as error:
        raise ReadError(error.cause, cure=error.cure, file=path, place="heading") from None


def _conventions(header: dict[str, str], scalings: set[str], path: Path) -> Conventions:
    choices: dict[str, Any] = {key: value for key, value in header.items() if key in _CONVENTIONS}
    if "force_scaling" not in choices:
        if len(scalings) != 1:
            raise ReadError(
                "the table does not say how its values are scaled",
                cure="write '# force_scaling = LT' above it (LT, L2, bis or dimensional), or add a column scaling",
                file=path,
            )
        choices["force_scaling"] = next(iter(scalings))
    if "origin" in choices and choices["origin"] not in ("midship", "cog"):
        choices["origin"] = cell_number(choices["origin"], "origin", path, "heading")
    try:
        return Conventions.from_dict(choices)
    except TowtankError as error:
        raise ReadError(error.cause, cure=error.cure, file=path, place="heading") from None
