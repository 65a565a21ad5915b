"""Which hull model do the runs support, and how far do the derivatives depend on the range that was fitted?"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import FitError, TermError
from ..core.motion import scaled_state
from ..core.terms import Term
from ..identify.regression import LinearFit, fit_linear
from ..identify.sandwich import FULL_LEVERAGE
from .campaign_file import Fit
from .component_fit import ComponentFit, default_stages, fit_component
from .force_rows import ForceRows, between_run_scatter, force_rows
from .reduced_run import FORCES, ReducedRun

if TYPE_CHECKING:
    import pandas as pd


def compare_models(
    runs: Sequence[ReducedRun], candidates: Mapping[str, Sequence[Term]], settings: Fit
) -> pd.DataFrame:
    """Compare hull models on the same data, component by component.

    All candidates of a component are fitted to the same rows (those that any of them explains) with the same weights
    (noise within the runs, and the scatter between runs that the best of them leaves), for criteria of different
    data cannot be compared.

    Parameters
    ----------
    runs : sequence of ReducedRun
        Runs of one group.
    candidates : mapping of str to sequence of Term
    settings : Fit
        Fit settings: ``ols`` weighs all rows alike; ``fixed`` coefficients stay fixed.

    Returns
    -------
    DataFrame
        Columns component, model, terms (number), n (rows), AICc, delta_AICc, weight (Akaike), R2, residual_rms,
        cv_rms, note; the best model of each component first. ``residual_rms`` and ``cv_rms`` are in scaled force
        (LT); ``cv_rms`` is that of each run predicted by the fit without it, infinite when the others cannot
        determine the model. A candidate that cannot be fitted has NaN and a note.
    """
    import pandas as pd

    wet = [run for run in runs if not run.run.dry]
    tables = []
    for component in FORCES:
        names = [name for name, terms in candidates.items() if any(t.component == component for t in terms)]
        if names and any(component in run.scaled for run in wet):
            tables.append(_compare_component(wet, {name: candidates[name] for name in names}, component, settings))
    columns = ["component", "model", "terms", "n", "AICc", "delta_AICc", "weight", "R2", "residual_rms", "cv_rms"]
    if not tables:
        return pd.DataFrame(columns=[*columns, "note"])
    return pd.concat(tables, ignore_index=True)[[*columns, "note"]]


def _compare_component(
    runs: Sequence[ReducedRun], candidates: Mapping[str, Sequence[Term]], component: str, settings: Fit
) -> pd.DataFrame:
    import pandas as pd

    union: dict[tuple[object, int], Term] = {}
    notes: dict[str, str] = {}
    own: dict[str, list[tuple[object, int]]] = {}
    for name, terms in candidates.items():
        keys = []
        for term in (t for t in terms if t.component == component):
            key = (term.factors, term.sign)
            union.setdefault(key, term)
            keys.append(key)
        own[name] = keys
    rows = force_rows(runs, tuple(union.values()), component)
    return pd.DataFrame(notes)
