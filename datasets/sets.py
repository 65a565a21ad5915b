"""Published derivative sets.

A set in a paper's file::

    [[set]]
    key = "s175"                       # name, ship and place (table or figure) are required
    [set.conventions]                  # beside those of the paper
    [set.values]                       # term = number, as printed
    [set.factors]                      # [[variable, power, modulus], ...] where the name does not say it
    [set.added_mass]                   # mx, my, Jz, Jx as printed; form: see _added_mass_terms
    [set.correction.Nrrr]              # corrected, reason: the loader uses it
    [set.suspect.Nv]                   # likely, reason: the loader says it and keeps the printed number
    [set.derived.R0]                   # value, from: computed out of printed numbers
    [set.combine]                      # other sets of the paper: "all" or the names of terms
    [set.extras]                       # propeller, rudder, inertia, ...

Added masses become the terms ``Xudot = -mx'``, ``Yvdot = -my'``, ``Nrdot = -Jz'``, ``Kpdot = -Jx'``, in the
scaling of the set: there the conversions between conventions look for them.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.conventions import HOME, Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import DatasetError, TowtankError
from ..core.provenance import Provenance
from ..core.ship import Ship
from ..core.terms import Factor, Term
from .catalogue import Paper, check_keys, correction_sentence, doubt_sentence, find, index

if TYPE_CHECKING:
    import pandas as pd

_SET_KEYS = {
    "key", "name", "ship", "place", "reference_speed", "validity", "conventions", "notes", "values", "factors",
    "added_mass", "mass_outside", "correction", "suspect", "derived", "combine", "extras",
}  # fmt: skip
_ADDED_MASSES = {"mx": "Xudot", "my": "Yvdot", "Jz": "Nrdot", "Jx": "Kpdot"}


def load_set(key: str, corrected: bool = True) -> DerivativeSet:
    """A published derivative set.

    Parameters
    ----------
    key : str
        See :func:`list_sets`.
    corrected : bool
        Correct the known misprints; False gives the numbers as they are printed.

    Returns
    -------
    DerivativeSet
        Without covariance: none of these sources prints one. ``provenance.source`` names the paper and the
        table, ``provenance.misprints`` tells each misprint and what was done about it,
        ``provenance.choices["notes"]`` what else must be known, ``provenance.history`` each term that was
        computed instead of printed.

    Raises
    ------
    DatasetError
        For an unknown key, with those nearest to it.
    """
    paper = find("set", key)
    block = _block(paper, key)
    try:
        return _build(paper, block, corrected)
    except DatasetError:
        raise
    except (TowtankError, TypeError, ValueError) as error:
        raise DatasetError(f"malformed set: {error}", file=paper.file, place=key) from error


def list_sets() -> pd.DataFrame:
    """All published sets: key, name, ship, source, conventions that differ from home, number of terms."""
    import pandas as pd

    rows = []
    for key in index("set"):
        one = load_set(key)
        rows.append(
            {
                "key": key,
                "name": one.name,
                "ship": one.ship.name,
                "source": one.provenance.source,
                "conventions": in_brief(one.conventions),
                "terms": len(one),
            }
        )
    return pd.DataFrame(rows)


def load_extras(key: str) -> dict[str, Any]:
    """What a paper prints beside a set: propeller, rudder, inertia, hull; empty when nothing.

    Parameters
    ----------
    key : str
        Key of the set.

    Returns
    -------
    dict
        Tables by subject, as printed (SI or non-dimensional, angles in ``_deg`` in degrees); a merged set
        inherits those of its parts.

    Raises
    ------
    DatasetError
        For an unknown key.
    """
    block = _block(find("set", key), key)
    extras: dict[str, Any] = {}
    for part in block.get("combine", {}):
        _merge(extras, load_extras(part))
    _merge(extras, copy.deepcopy(block.get("extras", {})))
    return extras


def in_brief(conventions: Conventions) -> str:
    """The choices that differ from home, in one line; ``"home"`` when none does."""
    differences = HOME.differences(conventions)
    return ", ".join(f"{key.replace('_', ' ')} {theirs}" for key, (_, theirs) in differences.items()) or "home"


def _merge(into: dict[str, Any], more: Mapping[str, Any]) -> None:
    for subject, items in more.items():
        into[subject] = {**into.get(subject, {}), **items}


def _block(paper: Paper, key: str) -> Mapping[str, Any]:
    block = paper.block("set", key)
    check_keys(block, _SET_KEYS, {"name", "ship", "place"}, paper.file, key)
    return block


def _build(paper: Paper, block: Mapping[str, Any], corrected: bool) -> DerivativeSet:
    ship = paper.ship(block["ship"])
    conventions = paper.conventions(block.get("conventions", {}))
    speed = block.get("reference_speed")
    values: dict[Term, float] = {}
    notes = [*paper.data.get("notes", []), *block.get("notes", [])]
    misprints: list[str] = []
    history: list[str] = []

    for part, names in block.get("combine", {}).items():
        source = _part(paper, part, names, conventions, corrected)
        values.update(zip(source.terms, map(float, source.values), strict=True))
        misprints += [text for text in source.provenance.misprints if text.split(":")[0] in source.names]
        notes += source.provenance.choices["notes"]
        history.append(f"{', '.join(source.names)} from the set '{part}'")

    printed = {_term(name, block): float(value) for name, value in block.get("values", {}).items()}
    misprints += _mend(printed, block, corrected)
    values.update(printed)
    for term, value in _added_mass_terms(block, ship, conventions, speed).items():
        values[term] = value
    if "mass_outside" in block:
        _take_mass_inside(values, block["mass_outside"], ship, conventions)
        history.append(f"the ship's inertia added to {', '.join(block['mass_outside'])}")
    for name, item in block.get("derived", {}).items():
        values[_term(name, block)] = float(item["value"])
        history.append(f"{name} = {item['value']} is computed, not printed: {item['from']}")

    choices: dict[str, Any] = {"corrected": corrected, "notes": tuple(dict.fromkeys(notes))}
    if note := paper.ship_note(block["ship"]):
        choices["ship"] = note
    return DerivativeSet(
        name=block["name"],
        ship=ship,
        terms=tuple(values),
        values=np.array(list(values.values()), dtype=float),
        conventions=conventions,
        reference_speed=speed,
        validity={name: (float(low), float(high)) for name, (low, high) in block.get("validity", {}).items()},
        provenance=Provenance(
            source=f"{paper.reference}, {block['place']}",
            choices=choices,
            history=tuple(history),
            misprints=tuple(misprints),
        ),
    )


def _term(name: str, block: Mapping[str, Any]) -> Term:
    """Term of a printed name; explicit factors go before what the name says."""
    factors = block.get("factors", {}).get(name)
    if factors is None:
        return Term.parse(name)
    return Term(name, name[0], tuple(Factor(*factor) for factor in factors))


def _part(
    paper: Paper, key: str, names: str | Iterable[str], conventions: Conventions, corrected: bool
) -> DerivativeSet:
    source = load_set(key, corrected)
    # a full-scale set may be built from the values that were found at model scale
    if source.conventions.but(scale=conventions.scale) != conventions:
        raise DatasetError(f"'{key}' has other conventions than the set built from it", file=paper.file)
    return source if names == "all" else source.subset(names)


def _mend(values: dict[Term, float], block: Mapping[str, Any], corrected: bool) -> list[str]:
    """Correct `values` in place and return a sentence for each misprint and each doubt."""
    sentences = []
    by_name = {term.name: term for term in values}
    for name, item in block.get("correction", {}).items():
        term = by_name[name]
        sentences.append(correction_sentence(name, values[term], item, corrected))
        if corrected:
            values[term] = float(item["corrected"])
    for name, item in block.get("suspect", {}).items():
        sentences.append(doubt_sentence(name, values[by_name[name]], item))
    return sentences


def _added_mass_terms(
    block: Mapping[str, Any], ship: Ship, conventions: Conventions, speed: float | None
) -> dict[Term, float]:
    """Acceleration terms from the printed added masses, in the conventions of the set.

    ``form`` says what is printed: ``coefficient`` (the default, in the scaling of the set), ``over-density``
    (added mass over water density, m3 and m5) or ``with-ship`` (ship and added mass in one coefficient).
    """
    masses = dict(block.get("added_mass", {}))
    form = masses.pop("form", "coefficient")
    if not masses:
        return {}
    negative = {_ADDED_MASSES[name]: -float(value) for name, value in masses.items()}
    outside = conventions.but(rigid_body_inertia="outside")
    if form == "over-density":
        given = outside.but(force_scaling="dimensional")
        negative = {name: ship.rho * value for name, value in negative.items()}
    elif form == "with-ship":
        given = outside.but(rigid_body_inertia="inside")
    elif form == "coefficient":
        given = outside
    else:
        raise DatasetError(
            f"added_mass.form = '{form}' is not known", cure="coefficient, over-density or with-ship"
        )
    found = DerivativeSet.from_values("added mass", ship, negative, given, reference_speed=speed).to(conventions)
    return dict(zip(found.terms, map(float, found.values), strict=True))


def _take_mass_inside(
    values: dict[Term, float], names: Iterable[str], ship: Ship, conventions: Conventions
) -> None:
    """Add the ship's inertia to acceleration terms that a set with inertia inside prints without it."""
    by_name = {term.name: term for term in values}
    printed = {name: values[by_name[name]] for name in names}
    outside = conventions.but(rigid_body_inertia="outside")
    inside = DerivativeSet.from_values("inertia", ship, printed, outside).to(conventions)
    for name in printed:
        values[by_name[name]] = inside[name]
