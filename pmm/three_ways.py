"""Derivatives three ways, side by side: one fit of all runs, single runs, several runs of one kind.

The fit is the default of the package: all runs at once, exact kinematics, covariance. The other two are what
older tables hold; their differences show what the sinusoid assumption and the split into kinds of tests do to
the numbers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

from ..core.terms import Factor, Term
from .hull_fit import HullFit
from .multiple_run import Ordinate, multiple_run_derivatives
from .single_run import FROM_MEAN, Form, average_over_runs

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = (
    "name",
    "fit",
    "fit_std",
    "single_run",
    "single_run_std",
    "single_runs",
    "multiple_run",
    "multiple_run_std",
    "multiple_run_method",
    "single_minus_fit",
    "single_minus_fit_percent",
    "single_minus_fit_in_std",
    "multiple_minus_fit",
    "multiple_minus_fit_percent",
    "multiple_minus_fit_in_std",
)


def three_ways(
    fit: HullFit, *, average: Literal["mean", "rms"] = "mean", ordinate: Ordinate = "amplitude"
) -> pd.DataFrame:
    """Compare a fit with single-run and multiple-run estimates from the same runs.

    All three are in the conventions of the fit: scaled by ``0.5 rho L T U^2``, about midship, with the added-mass
    terms that act through the motion inside (Yr is Yr - mx', Xvr is Xvr + my').

    Parameters
    ----------
    fit : HullFit
    average : {"mean", "rms"}
        Average of the single-run estimates over runs.
    ordinate : {"amplitude", "ratio"}
        See :func:`~towtank.pmm.multiple_run.multiple_run_curves`.

    Returns
    -------
    DataFrame
        One row a derivative of the fit: value and standard error of each way (NaN where a way gives none), the
        number of single runs, the kind of tests behind the multiple-run value, and the differences from the fit:
        as they are, in per cent of the fit, and in combined standard errors. The ways share their data, so the
        last is a lower bound. ``attrs`` hold what the other ways could not give (``single_run_left_out``,
        ``multiple_run_left_out``) and the terms that only they give (``not_in_fit``).
    """
    import pandas as pd

    terms = fit.derivatives.terms
    single = average_over_runs(fit.runs, kind=average, form=_form(terms))
    multiple = multiple_run_derivatives(fit.runs, terms, ordinate=ordinate)
    single_way = _by_key(single, "n")
    multiple_way = _by_key(multiple, "method")
    rows = []
    for term, value, std in zip(terms, fit.derivatives.values, fit.derivatives.bse.to_numpy(), strict=True):
        one, one_std, runs = _in_sign(single_way.get(_key(term)), term, 0)
        many, many_std, method = _in_sign(multiple_way.get(_key(term)), term, "")
        ways = (one, one_std, runs, many, many_std, method)
        differences = (*_difference(one, one_std, value, std), *_difference(many, many_std, value, std))
        rows.append((term.name, value, std, *ways, *differences))
    frame = pd.DataFrame(rows, columns=list(COLUMNS))
    known = {_key(term) for term in terms}
    frame.attrs = {
        "average": average,
        "single_run_left_out": single.attrs["left_out"],
        "multiple_run_left_out": multiple.attrs["left_out"],
        "not_in_fit": sorted(term.name for key, (term, *_) in single_way.items() if key not in known),
    }
    return frame


_Key = tuple[str, tuple[Factor, ...]]
_Entry = tuple[Term, float, float, Any]


def _form(terms: Sequence[Term]) -> Form:
    """The non-linear form of the lateral terms: a modulus in v or r where there is no cubic term."""
    names = {term.name[1:] for term in terms if term.component != "X"}
    return "modulus" if names & {"v|v|", "r|r|"} and not names & {"vvv", "rrr"} else "cubic"


def _key(term: Term) -> _Key:
    return term.component, term.factors


def _by_key(frame: pd.DataFrame, detail: str) -> dict[_Key, _Entry]:
    """First entry of each term: the way that the field trusts most comes first in the tables."""
    entries: dict[_Key, _Entry] = {}
    for name, value, std, more in zip(frame["name"], frame["value"], frame["std"], frame[detail], strict=True):
        if not name.endswith(FROM_MEAN):
            term = Term.parse(name)
            entries.setdefault(_key(term), (term, float(value), float(std), more))
    return entries


def _in_sign(entry: _Entry | None, term: Term, none: Any) -> tuple[float, float, Any]:
    """Value in the sign of `term`: the resistance R0 of the fit is minus the X0 of the relations."""
    if entry is None:
        return math.nan, math.nan, none
    theirs, value, std, detail = entry
    return theirs.sign * term.sign * value, std, detail


def _difference(value: float, std: float, fit: float, fit_std: float) -> tuple[float, float, float]:
    difference = value - fit
    combined = math.hypot(std, fit_std)
    return (
        difference,
        100.0 * difference / abs(fit) if fit else math.nan,
        difference / combined if combined > 0 else math.nan,
    )
