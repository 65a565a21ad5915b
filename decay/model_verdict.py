"""Which terms a decay record supports: an F test of what each smaller model leaves out of the largest one.

The largest model that the record carries is fitted by integration. With its coefficients q and their covariance V, for
autocorrelated residuals, a model that leaves out q_s is judged by F = q_s' V_ss^-1 q_s / count: no further fit is
needed, and the noise is the same for all of them. A small p says that the record contradicts the model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError, TowtankError
from .compare import fit_decay
from .damping_models import DampingModel, damping_model
from .decay_record import DecayRecord
from .roll_damping import RollDamping

if TYPE_CHECKING:
    import pandas as pd

SIGNIFICANCE = 0.05
"""A model whose left-out terms have a smaller p is contradicted by the record."""

DAMPING = ("linear", "quadratic", "cubic", "linear+quadratic", "linear+cubic", "linear+quadratic+cubic")
RESTORING = ("linear", "cubic", "quintic")
_LARGEST = (("linear+quadratic+cubic", "quintic"), ("linear+quadratic", "quintic"), ("linear+quadratic", "linear"))

WELL_KNOWN = 0.25
"""Standard error over value below which a term is identified."""


@dataclass(frozen=True, eq=False)
class ModelVerdict:
    """Models judged on one set of records.

    Attributes
    ----------
    largest : RollDamping
        Fit of the largest model.
    restoring : str
        The fewest restoring terms that the records do not contradict, in words.
    models : tuple of (str, float, float)
        Damping in words, F and p of what it leaves out, each with these restoring terms.
    """

    largest: RollDamping
    restoring: str
    models: tuple[tuple[str, float, float], ...]

    @property
    def supported(self) -> str:
        """The damping with the fewest terms that the records do not contradict, in words."""
        allowed = [(words.count("+"), -p, words) for words, _, p in self.models if p >= SIGNIFICANCE]
        return min(allowed)[2] if allowed else self.models[-1][0]

    def contradicts(self, words: str) -> bool:
        """Whether the records contradict this damping; False for one that was not judged."""
        return any(p < SIGNIFICANCE for name, _, p in self.models if name == words)

    def to_frame(self) -> pd.DataFrame:
        """Columns ``damping, restoring, F, p, supported``."""
        import pandas as pd

        rows = [
            {"damping": words, "restoring": self.restoring, "F": f, "p": p, "supported": p >= SIGNIFICANCE}
            for words, f, p in self.models
        ]
        return pd.DataFrame(rows)


def judge_models(records: Sequence[DecayRecord], *, restoring: str | None = None) -> ModelVerdict:
    """Restoring and damping terms that the records support.

    Parameters
    ----------
    records : sequence of DecayRecord
        Free parts, centred, at one speed.
    restoring : str, optional
        Restoring terms in words when they are not to be chosen.

    Raises
    ------
    FitError
        When not even the smallest of the large models can be fitted.
    """
    largest, reason = None, ""
    for damping, springs in _LARGEST:
        try:
            largest = fit_decay(records, damping_model(damping, restoring or springs))
            break
        except TowtankError as error:
            reason = reason or str(error)
    if largest is None:
        raise FitError(f"no model could be judged; {reason}", cure="see the record")
    full = largest.model
    words = [word for word in RESTORING if set(damping_model("linear", word).names) <= {"b1", *full.restoring}]
    if restoring is None:
        kept = next(
            word
            for word in words
            if _test(largest, full, damping_model(list(full.damping), word))[1] >= SIGNIFICANCE
        )
    else:
        kept = restoring
    judged = []
    for damping in DAMPING:
        model = damping_model(damping, kept)
        if set(model.damping) <= set(full.damping):
            judged.append((damping, *_test(largest, full, model)))
    return ModelVerdict(largest, kept, tuple(judged))


def _test(fit: RollDamping, full: DampingModel, model: DampingModel) -> tuple[float, float]:
    """F and p of the terms of the full model that a smaller one leaves out; 0 and 1 when it leaves out none."""
    from scipy.special import fdtrc

    left = [fit.position(name) for name in full.names if name not in model.names]
    if not left:
        return 0.0, 1.0
    values = fit.params[left]
    covariance = fit.cov[np.ix_(left, left)]
    scale = np.sqrt(np.diagonal(covariance))
    standard = values / scale
    statistic = float(standard @ np.linalg.pinv(covariance / np.outer(scale, scale)) @ standard) / len(left)
    return statistic, float(fdtrc(len(left), float(np.min(fit.t_dof)), statistic))


def term_verdicts(fit: RollDamping) -> list[tuple[str, str]]:
    """Each free term of a fit and what can be said of it alone."""
    limits = fit.conf_int()
    said = []
    for name in fit.model.free:
        place = fit.position(name)
        value, error = float(fit.params[place]), float(fit.bse[place])
        others = [fit.position(other) for other in fit.model.free if other != name]
        closest = max(others, key=lambda k: abs(fit.correlation[place, k]), default=None)
        if limits[place, 0] <= 0.0 <= limits[place, 1]:
            text = "not identified, the interval holds zero"
        elif error > WELL_KNOWN * abs(value):
            text = f"weakly identified, standard error {100.0 * error / abs(value):.0f} % of the value"
        else:
            text = f"identified to {100.0 * error / abs(value):.2g} %"
        if closest is not None and abs(fit.correlation[place, closest]) > 0.9:
            text += (
                f"; not apart from {fit.names[closest]} (correlation "
                f"{fit.correlation[place, closest]:+.3f}): quote the equivalent damping"
            )
        said.append((name, text))
    return said
