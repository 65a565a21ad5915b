"""What every exported set says about itself: conventions, units, source, uncertainty, validity."""

from __future__ import annotations

from ..core.derivative_set import DerivativeSet
from ..core.derivative_table import unit_line
from ..core.errors import ConventionError
from ..core.provenance import program_versions
from ..core.terms import Term


def heading(converted: DerivativeSet, original: DerivativeSet, target: str) -> list[str]:
    """Lines of comment for the head of an exported file, without comment signs.

    Parameters
    ----------
    converted : DerivativeSet
        The set as it is written.
    original : DerivativeSet
        The set as it was given.
    target : str
        Program that the file is for.
    """
    ship = converted.ship
    scale = "full scale" if ship.scale == 1 else f"1:{ship.scale:g}"
    version = program_versions().get("towtank", "")
    lines = [
        f"{converted.name}: hydrodynamic derivatives for {target}, written by towtank {version}",
        f"Ship: {ship.name}, L = {ship.L:g} m, B = {ship.B:g} m, T = {ship.T:g} m, {scale}",
        f"Units: {unit_line(converted)}",
        "Conventions:",
        *(f"  {name}: {meaning}" for name, _, meaning in converted.conventions.describe()),
    ]
    if original.provenance.source:
        lines.append(f"Source: {original.provenance.source}")
    if original.conventions != converted.conventions:
        changed = original.conventions.differences(converted.conventions)
        lines.append("Converted: " + ", ".join(f"{key} {old} -> {new}" for key, (old, new) in changed.items()))
    if converted.covariance is None:
        lines.append("Uncertainty: not given by the source")
    else:
        lines.append(
            "Uncertainty: std is the standard uncertainty; the correlations are in the JSON form of the set"
        )
    if converted.validity:
        ranges = ", ".join(f"{name} {low:.3g} to {high:.3g}" for name, (low, high) in converted.validity.items())
        lines.append(f"Measured range (non-dimensional): {ranges}")
    lines += [f"Misprint of the source: {text}" for text in original.provenance.misprints]
    return [" ".join(line.split()) if not line.startswith("  ") else line for line in lines]


def number(value: float, digits: int = 8) -> str:
    """A number with some significant digits, always with a point or an exponent."""
    text = f"{float(value) + 0.0:.{digits}g}"
    return text if any(sign in text for sign in ".en") else text + ".0"


def no_place(term: Term, model: str, is_own: bool = True) -> ConventionError:
    """The error for a term that a program cannot take.

    Parameters
    ----------
    term : Term
    model : str
        What the program holds.
    is_own : bool
        False for a term that only the conversion to the program's conventions brings in.
    """
    cause = f"'{term.name}' has no place in {model}"
    if not is_own:
        cause += "; the conversion to its conventions makes it"
    return ConventionError(cause, cure="fit a model without it, or export with --for json")
