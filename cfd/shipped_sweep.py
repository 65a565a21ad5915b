"""The virtual sweep that comes with the package, from its files to derivatives with numerical uncertainty."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ..core.derivative_set import DerivativeSet
from .case_sweep import find_cases
from .grid_study import GridStudy, grid_study, load_truth
from .settled_loads import settle_sweep
from .virtual_sweep import (
    MOTIONS,
    GridErrorLaw,
    Histories,
    virtual_choices,
    virtual_truth,
    write_virtual_sweep,
)

DEMO = "virtual-cfd-sweep"

Progress = Callable[[str, int, int], None]


def run_virtual_sweep(
    folder: str | Path,
    *,
    law: GridErrorLaw | None = None,
    histories: Histories | None = None,
    motions: Sequence[tuple[float, float]] = MOTIONS,
    progress: Progress | None = None,
) -> GridStudy:
    """Write the virtual sweep, settle it, fit each grid, and compare with the virtual experiment.

    Parameters
    ----------
    folder : path
        Takes ``cases``, ``fits``, ``efd.json`` and ``virtual.json``.
    law : GridErrorLaw, optional
    histories : Histories, optional
    motions : sequence of (float, float)
        beta in deg and r'; the fit takes the terms that they call for.
    progress : callable, optional
        ``progress(what, done, total)``.
    """
    root = Path(folder)
    errors = law or GridErrorLaw()
    cases = write_virtual_sweep(root, law=errors, histories=histories, motions=motions, progress=progress)
    sweep = find_cases([cases], cells=errors.cells)
    settled = settle_sweep(sweep, virtual_choices(virtual_truth()), progress=progress)
    truth = load_truth(cases)
    return grid_study(
        settled,
        virtual_truth().ship,
        root / "fits",
        name="KVLCC2, virtual CFD sweep",
        assumed_ratio=errors.ratio,
        reference=DerivativeSet.from_json(root / "efd.json"),
        truth=truth,
        progress=progress,
    )
