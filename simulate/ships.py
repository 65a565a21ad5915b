"""Ships that are shipped: published derivative sets with their propellers, rudders and steering gear."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any

from ..core.derivative_set import DerivativeSet
from ..core.errors import DatasetError
from ..core.terms import Factor, Term
from ..datasets import load_extras, load_set
from ..datasets.catalogue import correction_sentence
from .fittings import gear_from, notes_of, propeller_from, rudder_from
from .propeller import Propeller
from .vessel import Inertia, Vessel

Extras = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class _Entry:
    """One line of the catalogue of ships."""

    line: str
    set_key: str
    extras_key: str = ""
    speed: float | None = None
    rate: str = ""
    complete: Callable[[DerivativeSet, Extras, bool], DerivativeSet] | None = None
    depth: bool = False

    @property
    def fittings(self) -> str:
        """Key of the set whose extras hold propeller, rudder and gear."""
        return self.extras_key or self.set_key


def named_ship(name: str, *, corrected: bool = True, depth_ratio: float | None = None) -> Vessel:
    """A ship by name, ready to be sailed.

    Parameters
    ----------
    name : str
        One of :func:`named_ships`; case, blanks, hyphens and underscores do not count.
    corrected : bool
        Correct the known misprints; False sails the numbers as they are printed.
    depth_ratio : float, optional
        Water depth over draught, for ships whose derivatives know the depth; deep water when not given.

    Returns
    -------
    Vessel
        ``sources`` says where each part comes from and what the paper does not print.

    Raises
    ------
    DatasetError
        For an unknown name, with those nearest to it; for a depth that the derivatives do not know.
    """
    key = _key(name)
    entry = _SHIPS[key]
    hull = load_set(entry.set_key, corrected=corrected)
    extras = load_extras(entry.fittings)
    if depth_ratio is not None:
        hull = _at_depth(hull, entry, key, depth_ratio)
    if entry.complete is not None:
        hull = entry.complete(hull, extras, corrected)
    hull = replace(hull, provenance=replace(hull.provenance, misprints=_misprints(hull, extras, corrected)))
    return _assembled(key, entry, hull, extras if corrected else _as_printed(extras))


def named_ships() -> dict[str, str]:
    """Every ship by name, with one line about it."""
    return {name: entry.line for name, entry in _SHIPS.items()}


def _key(name: str) -> str:
    wanted = _plain(name)
    known = {_plain(key): key for key in _SHIPS}
    if wanted in known:
        return known[wanted]
    close = get_close_matches(wanted, known, n=4, cutoff=0.4)
    near = [known[item] for item in close] or list(_SHIPS)
    raise DatasetError(f"no ship '{name}'", cure=f"did you mean {', '.join(near)}")


def _plain(name: str) -> str:
    return "".join(letter for letter in name.lower() if letter.isalnum() or letter == ".")


_PRINTED = "_printed"
"""Ending of the printed, wrong value of a fitting beside the right one."""


def _as_printed(extras: Extras) -> dict[str, dict[str, Any]]:
    """Extras with the printed values in the place of the corrected ones."""
    return {
        subject: {
            name: items.get(name + _PRINTED, value) for name, value in items.items() if not name.endswith(_PRINTED)
        }
        for subject, items in extras.items()
    }


def _misprints(hull: DerivativeSet, extras: Extras, corrected: bool) -> tuple[str, ...]:
    """Misprints of the derivatives and of the fittings, and what was done about them."""
    found = list(hull.provenance.misprints)
    for subject, items in extras.items():
        for name in (key.removesuffix(_PRINTED) for key in items if key.endswith(_PRINTED)):
            mended = {"corrected": items[name], "reason": items.get("note", "misprint")}
            found.append(correction_sentence(f"{subject} {name}", items[name + _PRINTED], mended, corrected))
    return tuple(found)


def _assembled(key: str, entry: _Entry, hull: DerivativeSet, extras: Extras) -> Vessel:
    propeller = propeller_from(extras["propeller"]) if "propeller" in extras else None
    steering = extras.get("rudder", {})
    rudder = rudder_from(steering, hull.ship, propeller if isinstance(propeller, Propeller) else None)
    inertia = extras.get("inertia", {})
    gear = gear_from(steering)
    speed = entry.speed if entry.speed is not None else hull.reference_speed
    if gear is None or speed is None:
        raise DatasetError(f"ship '{key}' has no rudder rate or no approach speed", cure="complete its data")
    sources = {"hull": hull.provenance.source, **notes_of(extras)}
    return Vessel(
        name=key,
        hull=hull,
        speed=speed,
        gear=gear,
        propeller=propeller,
        rudder=rudder,
        inertia=Inertia(lx=float(inertia.get("lx", 0.0))),
        rate=_rate(extras["propeller"][entry.rate], entry.rate) if entry.rate else None,
        sources=sources,
    )


def _rate(value: float, unit: str) -> float:
    return float(value) / 60.0 if unit == "n_rpm" else float(value)


# What a paper leaves to be completed -------------------------------------------------------------------------------


def _at_depth(hull: DerivativeSet, entry: _Entry, key: str, ratio: float) -> DerivativeSet:
    if not entry.depth:
        deep = ", ".join(name for name, other in _SHIPS.items() if other.depth)
        raise DatasetError(
            f"the derivatives of '{key}' do not know the water depth", cure=f"leave the depth out, or sail {deep}"
        )
    return replace(hull, ship=replace(hull.ship, depth=ratio * hull.ship.T))


def _esso(hull: DerivativeSet, extras: Extras, corrected: bool) -> DerivativeSet:
    """Yuvz of the paper is a step-wise function of the depth: a term with the value at this depth."""
    if math.isinf(hull.ship.depth):
        return hull
    z = hull.ship.T / (hull.ship.depth - hull.ship.T)
    if z <= 0.8:
        return hull
    factor = float(extras["shallow"]["Yuvz_factor_above"])
    term = Term("Yuvz", "Y", (Factor("surge", 1), Factor("v", 1), Factor("depth", 1)))
    return _with_term(hull, term, factor * (1.0 - 0.8 / z))


def _dtc(hull: DerivativeSet, extras: Extras, corrected: bool) -> DerivativeSet:
    masses = extras["added_mass"]
    completed = hull.with_values(Xudot=-masses["mx"], Yvdot=-masses["my"], Nrdot=-masses["Jz"])
    return _noted(completed, f"added masses {masses['note']}")


def _s175(hull: DerivativeSet, extras: Extras, corrected: bool) -> DerivativeSet:
    """Forces by the speed of the moment, as Son and Nomoto have it; the paper prints the approach speed."""
    completed = replace(
        hull,
        ship=replace(hull.ship, kzz=float(extras["inertia"]["kzz"])),
        conventions=hull.conventions.but(velocity_scale="instantaneous"),
    )
    return _noted(completed, "forces by the speed of the moment, where the paper prints the approach speed")


def _s175_regression(hull: DerivativeSet, extras: Extras, corrected: bool) -> DerivativeSet:
    """Table 5 has no surge terms: those of Table 2."""
    surge = load_set("s175", corrected).subset(["Xuu", "Xvv", "Xvr", "Xrr"])
    for term, value in zip(surge.terms, surge.values, strict=True):
        hull = _with_term(hull, term, float(value))
    return _s175(_noted(hull, "surge terms of Table 2"), extras, corrected)


def _noted(hull: DerivativeSet, step: str) -> DerivativeSet:
    return replace(hull, provenance=hull.provenance.and_then(step))


def _with_term(hull: DerivativeSet, term: Term, value: float) -> DerivativeSet:
    """Set with one more term, whose factors its name may not tell."""
    more = hull.with_values(**{term.name: value})
    return replace(more, terms=(*more.terms[:-1], term))


_SHIPS: dict[str, _Entry] = {
    "kvlcc2": _Entry("KVLCC2 tanker, 7 m model at 1.18 m/s, MMG (Yasukawa and Yoshimura 2015)", "kvlcc2"),
    "kvlcc2-full": _Entry("KVLCC2 tanker, 320 m at 15.5 knots, MMG (Yasukawa and Yoshimura 2015)", "kvlcc2-full"),
    "kcs": _Entry("KCS container ship, 230 m at 24 knots, MMG in the drift angle (SIMMAN 2008)", "kcs"),
    "mariner": _Entry("Mariner class, 161 m at 15 knots, Abkowitz with rudder terms (1965)", "mariner"),
    "esso190k": _Entry(
        "Esso 190 000 dwt tanker, 305 m at 16 knots, deep or shallow (van Berlekom and Goddard 1972)",
        "esso-190k",
        rate="n_rpm",
        complete=_esso,
        depth=True,
    ),
    "s175-4dof": _Entry(
        "S-175 container ship, 175 m at 105 rpm and 21.4 knots, with roll (Son and Nomoto 1981)",
        "s175-son-nomoto",
        speed=10.99,
    ),
    "s175-3dof": _Entry(
        "S-175 container ship, 3.5 m model at 0.879 m/s, MMG (ELIGMOS, Table 2)", "s175", complete=_s175
    ),
    "s175-3dof-regression": _Entry(
        "S-175 container ship, 3.5 m model, derivatives by regression (ELIGMOS, Table 5)",
        "s175-regression",
        extras_key="s175",
        complete=_s175_regression,
    ),
    "s175-3dof-shallow": _Entry(
        "S-175 container ship, 3.5 m model at h/d = 1.2, derivatives by regression (ELIGMOS, Table 5)",
        "s175-regression-shallow",
        extras_key="s175",
        speed=0.879,
        complete=_s175_regression,
    ),
    "dtc": _Entry(
        "Duisburg Test Case container ship, 3.55 m model at 0.309 m/s, MMG from CFD (MANSIM 2019)",
        "dtc",
        rate="n_rps",
        complete=_dtc,
    ),
    "dtmb5512": _Entry(
        "DTMB 5512 combatant, 3.05 m model at 1.53 m/s; diverges in turns as printed (Yoon 2009)",
        "dtmb5512-steering-efd",
    ),
}
