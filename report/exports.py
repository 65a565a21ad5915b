"""Derivative sets in the forms that simulators and papers want."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..core.derivative_set import DerivativeSet
from ..core.errors import TowtankError
from ..formats.write import atomic_path
from .mss_export import mss_text
from .shipmmg_export import shipmmg_text


def _csv_text(derivatives: DerivativeSet) -> str:
    return str(derivatives.to_frame().to_csv(index=False, lineterminator="\n"))


def _latex_text(derivatives: DerivativeSet) -> str:
    return derivatives.to_latex()


def _json_text(derivatives: DerivativeSet) -> str:
    return derivatives.to_json() + "\n"


TARGETS: dict[str, Callable[[DerivativeSet], str]] = {
    "shipmmg": shipmmg_text,
    "mss": mss_text,
    "csv": _csv_text,
    "latex": _latex_text,
    "json": _json_text,
}
"""Targets that are text, and what writes them."""


def export_set(derivatives: DerivativeSet, target: str, path: str | Path | None = None) -> str:
    """A derivative set as a simulator or a paper wants it.

    Parameters
    ----------
    derivatives : DerivativeSet
    target : {"shipmmg", "mss", "csv", "latex", "json", "xlsx"}
        ``shipmmg`` and ``mss`` are converted to the conventions of those programs; the others stay as they are.
    path : str or Path, optional
        File to write; needed for ``xlsx``.

    Returns
    -------
    str
        The text; for ``xlsx`` the path.

    Raises
    ------
    ConventionError
        When a term has no place in the target, naming it, or a conversion is not exact.
    TowtankError
        For an unknown target, or ``xlsx`` without a path.
    """
    key = target.lower()
    if key == "xlsx":
        if path is None:
            raise TowtankError(
                "a workbook cannot be printed", cure="give a file with --out, e.g. derivatives.xlsx"
            )
        if Path(path).suffix.lower() != ".xlsx":
            raise TowtankError("a workbook needs the ending .xlsx", cure="name it so", file=path)
        with atomic_path(path) as temporary:
            derivatives.to_excel(temporary)
        return str(path)
    if key not in TARGETS:
        raise TowtankError(
            f"'{target}' is not an export", cure=f"use one of {', '.join(sorted([*TARGETS, 'xlsx']))}"
        )
    text = TARGETS[key](derivatives)
    if path is not None:
        with atomic_path(path) as temporary:
            temporary.write_text(text, encoding="utf-8")
    return text
