"""The gallery: every paper module of this folder, found by its name."""

from __future__ import annotations

import difflib
import pkgutil
from collections.abc import Callable, Sequence
from importlib import import_module

from ..core.errors import DatasetError
from .case import Case, Paper

_PREFIX = "paper_"


def papers() -> dict[str, Paper]:
    """All papers by key: each module ``paper_*.py`` of this folder holds one ``PAPER``."""
    package = __package__ or "towtank.reproduce"
    folder = import_module(package).__path__
    found = {}
    for module in sorted(info.name for info in pkgutil.iter_modules(folder)):
        if module.startswith(_PREFIX):
            paper: Paper = import_module(f"{package}.{module}").PAPER
            found[paper.key] = paper
    return found


def gallery(keys: Sequence[str] = (), *, progress: Callable[[str, int, int], None] | None = None) -> list[Case]:
    """Cases of the named papers, or of all.

    Parameters
    ----------
    keys : sequence of str
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    DatasetError
        For an unknown paper, with the known ones.
    """
    known = papers()
    for key in keys:
        if key not in known:
            close = difflib.get_close_matches(key, known, n=3, cutoff=0.3) or list(known)
            raise DatasetError(f"the gallery has no paper '{key}'", cure=f"try one of {', '.join(close)}")
    chosen = list(keys) or list(known)
    cases: list[Case] = []
    for number, key in enumerate(chosen):
        if progress is not None:
            progress("reproducing", number, len(chosen))
        cases.extend(known[key].cases())
    if progress is not None:
        progress("reproducing", len(chosen), len(chosen))
    return cases
