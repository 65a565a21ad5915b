"""How far computed values are from measured ones, and to which side.

S is the simulation (or computation), D the data (or measurement). The field writes the comparison error in
three ways, and papers mix them: (S - D)/D, (D - S)/D and |S - D|/|D|. All are relative to D, so a D near zero
makes them meaningless: such a pair gives NaN and a note, and is left out of every mean. A deviation in absolute
terms belongs beside every relative one; the table gives both.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

NEAR_ZERO = 1e-9
"""A measurement smaller than this times the largest one is taken as zero."""


@dataclass(frozen=True, eq=False)
class RelativeErrors:
    """Comparison errors in per cent, in the three sign conventions of the field; shape (n,).

    Attributes
    ----------
    s_minus_d : ndarray
        ``100 (S - D) / D``: positive when the magnitude is overpredicted.
    d_minus_s : ndarray
        ``100 (D - S) / D``, the E%D of ITTC.
    absolute : ndarray
        ``100 |S - D| / |D|``.
    notes : tuple of str
        Which pairs have no relative error, and why.
    """

    s_minus_d: np.ndarray
    d_minus_s: np.ndarray
    absolute: np.ndarray
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Score:
    """Agreement of paired values in a few numbers.

    Attributes
    ----------
    quality : float
        Q: root mean square of (D - S)/D; 0.09 is 9 %, smaller is better.
    bias : int
        BS: sum of the signs of D - S; -n when every S is larger than its D, +n when every S is smaller.
    n : int
        Pairs that Q and BS count.
    ties : int
        Pairs with S = D, whose sign is 0.
    mean_error, scatter : float
        Mean and standard deviation (n - 1) of S - D.
    rms : float
        Root mean square of S - D, over all pairs that are numbers.
    notes : tuple of str
        Pairs that were left out, and why.
    """

    quality: float
    bias: int
    n: int
    ties: int
    mean_error: float
    scatter: float
    rms: float
    notes: tuple[str, ...] = ()

    @property
    def bias_text(self) -> str:
        """Bias over the number of pairs, as it is printed: ``-4/8``."""
        return f"{self.bias}/{self.n}"

    @property
    def systematic(self) -> bool:
        """True when every deviation has the same sign."""
        return self.n > 0 and abs(self.bias) == self.n


def relative_errors(simulation: ArrayLike, data: ArrayLike, *, near_zero: float | None = None) -> RelativeErrors:
    """Comparison errors of pairs in per cent, in the three sign conventions.

    Parameters
    ----------
    simulation, data : array_like, shape (n,)
        S and D in the same unit; NaN where there is none.
    near_zero : float, optional
        |D| up to this counts as zero; :data:`NEAR_ZERO` times the largest |D| when not given.

    Returns
    -------
    RelativeErrors
        NaN where D is near zero or a value is missing; the notes say which.

    Raises
    ------
    TowtankError
        When the two differ in length.
    """
    s, d = _pairs(simulation, data)
    usable, notes = _usable(s, d, near_zero)
    signed = np.full(s.shape, np.nan)
    signed[usable] = 100.0 * (s[usable] - d[usable]) / d[usable]
    return RelativeErrors(signed, 0.0 - signed, np.abs(signed), notes)


def quality_and_bias(simulation: ArrayLike, data: ArrayLike, *, near_zero: float | None = None) -> Score:
    """Quality score Q and bias BS of paired values.

    Parameters
    ----------
    simulation, data : array_like, shape (n,)
        S and D at the same points; see :func:`at_measured_points` when they are not.
    near_zero : float, optional
        As in :func:`relative_errors`.

    Returns
    -------
    Score

    Notes
    -----
    ``Q = sqrt(mean(((D - S)/D)**2))``, ``BS = sum(sign(D - S))`` with sign(0) = 0: Bechthold and Kastens,
    5th MASHCON 2019, equations 2 and 3, for squat at the speeds of the experiment. Q grows without limit where
    D passes through zero (trim near its change of sign); BS does not weigh magnitudes.
    """
    s, d = _pairs(simulation, data)
    usable, notes = _usable(s, d, near_zero)
    s_used, d_used = s[usable], d[usable]
    known = np.isfinite(s) & np.isfinite(d)
    deviation = s[known] - d[known]
    signs = np.sign(d_used - s_used)
    return Score(
        quality=rms((d_used - s_used) / d_used),
        bias=int(signs.sum()),
        n=len(s_used),
        ties=int(np.count_nonzero(signs == 0)),
        mean_error=float(deviation.mean()) if deviation.size else float("nan"),
        scatter=float(deviation.std(ddof=1)) if deviation.size > 1 else float("nan"),
        rms=rms(deviation),
        notes=notes,
    )


def bias_is_possible(bias: int, n: int, ties: int = 0) -> bool:
    """Whether `n` pairs with `ties` exact ties can have the bias `bias`.

    Each pair that is no tie adds +1 or -1, so the bias has the parity of ``n - ties`` and is not larger.
    """
    counted = n - ties
    return counted >= 0 and abs(bias) <= counted and (bias - counted) % 2 == 0


def at_measured_points(measured_at: ArrayLike, computed_at: ArrayLike, computed: ArrayLike) -> np.ndarray:
    """Computed values at the points of the measurement: linear between points, NaN outside them.

    Parameters
    ----------
    measured_at : array_like, shape (n,)
        Speeds (or angles, ...) of the measurement.
    computed_at, computed : array_like, shape (m,)
        Points and values of the computation; the points may be in any order but not repeated.

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    TowtankError
        When the two computed arrays differ in length, or a point is repeated.
    """
    at, values = _pairs(computed_at, computed)
    order = np.argsort(at)
    at, values = at[order], values[order]
    if np.any(np.diff(at) == 0):
        raise TowtankError(
            f"the computation has two values at {at[:-1][np.diff(at) == 0][0]:g}", cure="average them first"
        )
    return np.interp(np.asarray(measured_at, dtype=float), at, values, left=np.nan, right=np.nan)


def z_score(
    a: ArrayLike,
    b: ArrayLike,
    sd_a: ArrayLike | None,
    sd_b: ArrayLike | None,
    covariance: ArrayLike | None = None,
) -> np.ndarray:
    """Difference of two values over its standard uncertainty: ``(a - b) / sqrt(sd_a^2 + sd_b^2 - 2 cov)``.

    Parameters
    ----------
    a, b : array_like, shape (n,)
    sd_a, sd_b : array_like, shape (n,), or None
        Standard uncertainties; None or NaN when unknown: then the known one stands alone.
    covariance : array_like, shape (n,), optional
        Covariance of each pair, e.g. from a bias that both share; 0 when not given.

    Returns
    -------
    ndarray
        NaN where neither uncertainty is known, or the combined one is zero.
    """
    difference = np.subtract(np.asarray(a, float), np.asarray(b, float))
    unknown = np.full(difference.shape, np.nan)
    first = unknown if sd_a is None else np.broadcast_to(np.asarray(sd_a, float), difference.shape)
    second = unknown if sd_b is None else np.broadcast_to(np.asarray(sd_b, float), difference.shape)
    squares = np.nan_to_num(first) ** 2 + np.nan_to_num(second) ** 2
    variance = squares if covariance is None else squares - 2.0 * np.asarray(covariance, float)
    # fully correlated values leave a variance of rounding error only
    known = (np.isfinite(first) | np.isfinite(second)) & (variance > 1e-12 * squares)
    return np.where(known, difference / np.sqrt(np.where(known, variance, 1.0)), np.nan)


def rms(values: ArrayLike) -> float:
    """Root mean square; NaN of nothing."""
    x = np.asarray(values, dtype=float)
    return float(np.sqrt(np.mean(x**2))) if x.size else float("nan")


def normalised_rms(simulation: ArrayLike, data: ArrayLike, by: Literal["range", "mean", "rms"] = "range") -> float:
    """Root mean square of S - D over the size of D.

    Parameters
    ----------
    simulation, data : array_like, shape (n,)
        Pairs with a NaN are left out.
    by : {"range", "mean", "rms"}
        Size of D: largest less smallest, mean of |D|, or root mean square.

    Returns
    -------
    float
        NaN when the size is zero.
    """
    s, d = _pairs(simulation, data)
    known = np.isfinite(s) & np.isfinite(d)
    s, d = s[known], d[known]
    if not d.size:
        return float("nan")
    size = {"range": np.ptp(d), "mean": np.mean(np.abs(d)), "rms": rms(d)}[by]
    return rms(s - d) / float(size) if size > 0 else float("nan")


def score_table(
    a: Mapping[str, float] | pd.Series,
    b: Mapping[str, float] | pd.Series,
    *,
    sd_a: Mapping[str, float] | pd.Series | None = None,
    sd_b: Mapping[str, float] | pd.Series | None = None,
    covariance: Mapping[str, float] | None = None,
    near_zero: float | None = None,
) -> pd.DataFrame:
    """Two sets of named values side by side, with every comparison error.

    Parameters
    ----------
    a : mapping of str to float
        The simulation S, e.g. ``DerivativeSet.params``.
    b : mapping of str to float
        The data D.
    sd_a, sd_b : mapping of str to float, optional
        Standard uncertainties, e.g. ``DerivativeSet.bse``; NaN when unknown.
    covariance : mapping of str to float, optional
        Covariance between the two values of a name.
    near_zero : float, optional
        |D| up to this counts as zero; exact zero only when not given, since named values differ in size.

    Returns
    -------
    DataFrame
        Columns name, a, sd_a, b, sd_b, difference (a - b), s_minus_d, d_minus_s, absolute (%), z, note; first
        the names of `b` in their order, then those that only `a` has. Its columns ``a`` and ``b`` go to
        :func:`quality_and_bias` for the score of all.
    """
    import pandas as pd

    first, second = _named(a), _named(b)
    names = [*second, *(name for name in first if name not in second)]
    s = np.array([first.get(name, np.nan) for name in names], dtype=float)
    d = np.array([second.get(name, np.nan) for name in names], dtype=float)
    limit = 0.0 if near_zero is None else near_zero
    errors = relative_errors(s, d, near_zero=limit)
    spread_a = _by_name(sd_a, names, np.nan)
    spread_b = _by_name(sd_b, names, np.nan)
    notes = []
    for row, name in enumerate(names):
        if name not in first or name not in second:
            notes.append("only in a" if name in first else "only in b")
            continue
        said = ["b is near zero"] if abs(d[row]) <= limit else []
        if np.isnan(spread_a[row]) != np.isnan(spread_b[row]):
            said.append(f"z without the unknown uncertainty of {'a' if np.isnan(spread_a[row]) else 'b'}")
        notes.append("; ".join(said))
    return pd.DataFrame(
        {
            "name": names,
            "a": s,
            "sd_a": spread_a,
            "b": d,
            "sd_b": spread_b,
            "difference": s - d,
            "s_minus_d": errors.s_minus_d,
            "d_minus_s": errors.d_minus_s,
            "absolute": errors.absolute,
            "z": z_score(s, d, spread_a, spread_b, _by_name(covariance, names, 0.0)),
            "note": notes,
        }
    )


def _named(values: Mapping[str, float] | pd.Series) -> dict[str, float]:
    return {str(name): float(value) for name, value in values.items()}


def _by_name(values: Mapping[str, float] | pd.Series | None, names: list[str], missing: float) -> np.ndarray:
    table = {} if values is None else _named(values)
    return np.array([table.get(name, missing) for name in names], dtype=float)


def _pairs(a: ArrayLike, b: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    first, second = np.atleast_1d(np.asarray(a, dtype=float)), np.atleast_1d(np.asarray(b, dtype=float))
    if first.shape != second.shape or first.ndim != 1:
        raise TowtankError(
            f"values of shape {first.shape} cannot be paired with {second.shape}", cure="give one value a point"
        )
    return first, second


def _usable(s: np.ndarray, d: np.ndarray, near_zero: float | None) -> tuple[np.ndarray, tuple[str, ...]]:
    """Pairs that have a relative error, and a note on the others."""
    known = np.isfinite(s) & np.isfinite(d)
    limit = near_zero
    if limit is None:
        limit = NEAR_ZERO * float(np.max(np.abs(d[known]), initial=0.0))
    usable = known & (np.abs(d) > limit)
    notes = []
    for what, rows in (
        ("a value is missing", np.flatnonzero(~known)),
        ("the measurement is near zero", np.flatnonzero(known & ~usable)),
    ):
        if rows.size:
            plural = "pairs" if rows.size > 1 else "pair"
            notes.append(f"{plural} {', '.join(str(row + 1) for row in rows)} left out: {what}")
    return usable, tuple(notes)
