"""Hydrodynamic derivatives fitted on several grids: their numerical uncertainty, beside and with that of the fit.

Each grid's tests give one set of derivatives with the covariance of its fit. The differences between the sets give
each derivative a class of convergence and an expanded uncertainty U (95 %); half of it is its standard uncertainty,
which is added in squares to the variance of the fit on the finest grid. The correlation of the numerical errors of
two derivatives is not known from a few grids and is taken as zero. Where the grids differ by less than the fits
scatter, the class is one of the scatter, and a finding says so.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError, TowtankError
from ..core.findings import Finding
from .numerical_uncertainty import DEFAULT, METHODS, NumericalUncertainty, numerical_uncertainty, uncertainty_table
from .refinement import finest_first
from .triplet_uncertainty import UncertaintyEstimate

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

COVERAGE = 2.0
"""Expanded over standard uncertainty, as for a normal distribution at 95 %."""

_SAME = 1e-9


@dataclass(frozen=True, eq=False)
class DerivativeUncertainty:
    """Derivatives on two or more grids.

    Attributes
    ----------
    quantities : tuple of NumericalUncertainty
        One a term, in the order of the finest grid's set.
    chosen : tuple of UncertaintyEstimate
        The estimate that counts for each.
    combined : DerivativeSet
        The set of the finest grid with the fit's covariance plus the squared standard numerical uncertainties.
    fit_errors : ndarray, shape (m,)
        Standard uncertainties of the fit on the finest grid; NaN where it gives none.
    findings : tuple of Finding
    """

    quantities: tuple[NumericalUncertainty, ...]
    chosen: tuple[UncertaintyEstimate, ...]
    combined: DerivativeSet
    fit_errors: np.ndarray
    findings: tuple[Finding, ...]

    @property
    def table(self) -> pd.DataFrame:
        """One row a derivative.

        Columns name, value, class, method, order, extrapolated, U_num (expanded, 95 %), u_num (standard), u_fit
        (standard), u (standard, both), U95 (twice u), note.
        """
        import pandas as pd

        rows = []
        for quantity, estimate, fit in zip(self.quantities, self.chosen, self.fit_errors, strict=True):
            numerical = estimate.uncertainty / COVERAGE
            both = math.hypot(numerical, 0.0 if math.isnan(fit) else float(fit))
            rows.append(
                (
                    quantity.quantity,
                    quantity.fine,
                    quantity.behaviour,
                    estimate.method,
                    estimate.order,
                    estimate.extrapolated,
                    estimate.uncertainty,
                    numerical,
                    float(fit),
                    both,
                    COVERAGE * both,
                    estimate.note,
                )
            )
        names = ("name", "value", "class", "method", "order", "extrapolated")
        return pd.DataFrame(rows, columns=[*names, "U_num", "u_num", "u_fit", "u", "U95", "note"])

    @property
    def methods(self) -> pd.DataFrame:
        """Every method for every derivative, see :func:`~towtank.verify.numerical_uncertainty.uncertainty_table`."""
        return uncertainty_table(estimate for one in self.quantities for estimate in one.estimates)


def derivative_uncertainty(
    sets: Sequence[DerivativeSet], spacings: ArrayLike, *, method: str = DEFAULT, formal_order: float = 2.0
) -> DerivativeUncertainty:
    """Numerical uncertainty of every derivative, combined with the covariance of the fit.

    Parameters
    ----------
    sets : sequence of DerivativeSet
        One a grid (or time step), with the same terms in any order, the same conventions and the same ship.
    spacings : array_like, shape (n,)
        In the order of `sets`.
    method : str
        ``default`` (see :mod:`towtank.verify.numerical_uncertainty`) or one of its methods. A derivative for which
        that method has no value takes the default one, and a finding says so.
    formal_order : float

    Raises
    ------
    ConventionError
        When the sets differ in terms, conventions, ship or (dimensional sets) reference speed.
    TowtankError
        With fewer than two sets, an unknown method, or see
        :func:`~towtank.verify.numerical_uncertainty.numerical_uncertainty`.
    """
    if method != DEFAULT and method not in METHODS:
        raise TowtankError(f"there is no method '{method}'", cure=f"use one of {DEFAULT}, {', '.join(METHODS)}")
    h = np.asarray(spacings, dtype=float).ravel()
    if len(sets) != h.size or h.size < 2:
        raise TowtankError(
            f"{len(sets)} derivative sets on {h.size} grids", cure="give one set a grid, two at least"
        )
    order = finest_first(h)
    along = [sets[k] for k in order]
    finest = along[0]
    for other in along[1:]:
        _require_alike(finest, other)
    values = np.array([[one[name] for name in finest.names] for one in along])
    unit = "SI" if finest.conventions.force_scaling == "dimensional" else "-"
    quantities = tuple(
        numerical_uncertainty(values[:, k], h[order], quantity=name, unit=unit, formal_order=formal_order)
        for k, name in enumerate(finest.names)
    )
    chosen, findings = [], []
    for one in quantities:
        estimate = one.by(method)
        if method not in (DEFAULT, estimate.method):
            findings.append(
                Finding(
                    "numerical-method",
                    "warning",
                    f"'{method}' has no value for {one.quantity} ({one.behaviour}): {estimate.method} stands in",
                    place=one.quantity,
                    cure="look at the methods side by side",
                )
            )
        chosen.append(estimate)
    errors = [one.bse.to_numpy(dtype=float) for one in (each.subset(finest.names) for each in along)]
    findings += _scatter_findings(quantities, np.array(errors))
    return DerivativeUncertainty(
        quantities, tuple(chosen), _combined(finest, along, chosen, method), errors[0], tuple(findings)
    )


def _require_alike(a: DerivativeSet, b: DerivativeSet) -> None:
    """Same terms, conventions and ship, or an error that names the first difference."""
    if set(a.names) != set(b.names):
        odd = sorted(set(a.names) ^ set(b.names))
        raise ConventionError(
            f"'{a.name}' and '{b.name}' do not have the same terms: {', '.join(odd)} is in one of them",
            cure="fit the same terms on every grid",
        )
    different = a.conventions.differences(b.conventions)
    if different:
        key, (first, second) = next(iter(different.items()))
        raise ConventionError(
            f"'{a.name}' has {key} {first}, '{b.name}' {second}", cure="convert one of them with .to(conventions)"
        )
    for name in ("L", "B", "T", "scale"):
        first, second = getattr(a.ship, name), getattr(b.ship, name)
        if not math.isclose(first, second, rel_tol=_SAME):
            raise ConventionError(
                f"'{a.name}' is of a ship with {name} = {first:g}, '{b.name}' with {second:g}",
                cure="grids are compared for one ship at one scale",
            )
    speeds = (a.reference_speed, b.reference_speed)
    if a.conventions.force_scaling in ("dimensional", "bis") and None not in speeds and speeds[0] != speeds[1]:
        raise ConventionError(
            f"'{a.name}' holds at {speeds[0]:g} m/s, '{b.name}' at {speeds[1]:g} m/s", cure="compare at one speed"
        )


def _scatter_findings(quantities: Sequence[NumericalUncertainty], errors: np.ndarray) -> list[Finding]:
    """Derivatives whose grids differ by less than twice the standard error of that difference."""
    found = []
    for k, one in enumerate(quantities):
        pair = math.hypot(errors[0, k], errors[1, k])
        change = abs(float(one.values[1] - one.values[0]))
        if math.isfinite(pair) and pair > 0.0 and change < COVERAGE * pair:
            found.append(
                Finding(
                    "grids-within-scatter",
                    "info",
                    f"{one.quantity} changes by {change:.3g} between the two finest grids, within the scatter of the "
                    f"fits (standard error {pair:.2g}): class and order are not significant",
                    place=one.quantity,
                    cure="longer records or more runs make the difference significant",
                )
            )
    return found


def _combined(
    finest: DerivativeSet, sets: Sequence[DerivativeSet], chosen: Sequence[UncertaintyEstimate], method: str
) -> DerivativeSet:
    standard = np.array([one.uncertainty for one in chosen]) / COVERAGE
    fit = np.zeros((len(finest),) * 2) if finest.covariance is None else finest.covariance
    words = "without a fit's covariance" if finest.covariance is None else "added to the fit's covariance"
    history = finest.provenance.and_then(
        f"numerical uncertainty of {len(sets)} grids ({method}), U 95 % / {COVERAGE:g} as standard uncertainty, {words}"
    )
    choices = {**history.choices, "numerical uncertainty": {one.quantity: one.uncertainty for one in chosen}}
    return replace(finest, covariance=fit + np.diag(standard**2), provenance=replace(history, choices=choices))
