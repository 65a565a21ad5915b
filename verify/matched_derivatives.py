"""Two derivative sets brought into one convention, their common terms matched by what they mean."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError
from ..core.terms import Factor


@dataclass(frozen=True, eq=False)
class MatchedDerivatives:
    """Common derivatives of two sets.

    Attributes
    ----------
    names : tuple of str
        Common terms, named and ordered as in the first set.
    a, b : ndarray, shape (n,)
        Their values in one convention.
    a_covariance, b_covariance : ndarray, shape (n, n)
        NaN when the set has none.
    set_a, set_b : DerivativeSet
        The sets in that convention.
    only_a, only_b : tuple of str
        Terms that only one of them has.
    turned_because : str
        Why the first set had to be converted to the conventions of the second; empty when the second was.
    """

    names: tuple[str, ...]
    a: np.ndarray
    b: np.ndarray
    a_covariance: np.ndarray
    b_covariance: np.ndarray
    set_a: DerivativeSet
    set_b: DerivativeSet
    only_a: tuple[str, ...]
    only_b: tuple[str, ...]
    turned_because: str = ""


def match_derivatives(a: DerivativeSet, b: DerivativeSet) -> MatchedDerivatives:
    """Bring two sets into one convention and match their terms.

    `b` is converted to the conventions of `a`; where that is not exact, `a` to those of `b`. Terms are matched by what
    they mean, not by how they are spelled: R0 of one meets X0 of the other with its sign turned.

    Parameters
    ----------
    a, b : DerivativeSet

    Returns
    -------
    MatchedDerivatives

    Raises
    ------
    ConventionError
        When neither set can be converted to the conventions of the other, or they have no term in common.
    """
    first, second, reason = _in_one_convention(a, b)
    ours = {_key(first, i): i for i in range(len(first))}
    theirs = {_key(second, i): i for i in range(len(second))}
    common = [key for key in ours if key in theirs]
    if not common:
        raise ConventionError(
            f"'{a.name}' and '{b.name}' have no derivative in common",
            cure="compare sets of the same model, or convert the sway variable (v or drift-angle)",
        )
    rows_a, rows_b = [ours[key] for key in common], [theirs[key] for key in common]
    sign = np.array([first.terms[i].sign * second.terms[j].sign for i, j in zip(rows_a, rows_b, strict=True)])
    return MatchedDerivatives(
        names=tuple(first.names[i] for i in rows_a),
        a=first.values[rows_a],
        b=sign * second.values[rows_b],
        a_covariance=first.cov_params().to_numpy(float)[np.ix_(rows_a, rows_a)],
        b_covariance=np.outer(sign, sign) * second.cov_params().to_numpy(float)[np.ix_(rows_b, rows_b)],
        set_a=first,
        set_b=second,
        only_a=tuple(first.names[i] for key, i in ours.items() if key not in theirs),
        only_b=tuple(second.names[i] for key, i in theirs.items() if key not in ours),
        turned_because=reason,
    )


def _key(derivatives: DerivativeSet, index: int) -> tuple[str, tuple[Factor, ...]]:
    term = derivatives.terms[index]
    return term.component, term.factors


def _in_one_convention(a: DerivativeSet, b: DerivativeSet) -> tuple[DerivativeSet, DerivativeSet, str]:
    try:
        return a, _converted(b, a), ""
    except ConventionError as error:
        try:
            turned = _converted(a, b)
        except ConventionError:
            raise ConventionError(
                f"'{b.name}' cannot be brought into the conventions of '{a.name}': {error.cause}", cure=error.cure
            ) from None
        return turned, b, error.cause


def _converted(derivatives: DerivativeSet, like: DerivativeSet) -> DerivativeSet:
    """A set in the conventions of another; dimensional values also at its scale."""
    scalings = {derivatives.conventions.force_scaling, like.conventions.force_scaling}
    if "dimensional" in scalings and derivatives.ship.scale != like.ship.scale:
        derivatives = derivatives.at_scale(like.ship.scale, rho=like.ship.rho)
    # non-dimensional values are the same for model and ship
    conventions = derivatives.conventions.but(scale=like.conventions.scale)
    return replace(derivatives, conventions=conventions).to(like.conventions)
