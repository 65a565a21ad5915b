"""Fitted coefficients with their covariance: what every estimator of this room returns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class CoefficientTable:
    """Named coefficients, their covariance and the degrees of freedom of their intervals.

    Attributes
    ----------
    names : tuple of str
        Names of the p columns of the design.
    params : ndarray, shape (p,)
        Coefficients.
    cov : ndarray, shape (p, p)
        Their covariance.
    t_dof : ndarray, shape (p,)
        Degrees of freedom of each coefficient's t-interval.
    confidence : float
        Level of the intervals in tables.
    """

    names: tuple[str, ...]
    params: np.ndarray
    cov: np.ndarray
    t_dof: np.ndarray
    confidence: float

    def __getitem__(self, name: str) -> float:
        return float(self.params[self.position(name)])

    def position(self, name: str) -> int:
        """Column of the coefficient `name`.

        Raises
        ------
        FitError
            If there is no such coefficient.
        """
        try:
            return self.names.index(name)
        except ValueError:
            raise FitError(
                f"there is no coefficient '{name}'", cure=f"use one of {', '.join(self.names)}"
            ) from None

    @cached_property
    def bse(self) -> np.ndarray:
        """Standard errors, shape (p,)."""
        return np.sqrt(np.maximum(np.diagonal(self.cov), 0.0))

    def cov_params(self) -> np.ndarray:
        """Covariance of the coefficients, shape (p, p)."""
        return self.cov

    @cached_property
    def correlation(self) -> np.ndarray:
        """Correlation of the coefficients, shape (p, p); zero beside a coefficient without error."""
        inverse = np.divide(1.0, self.bse, out=np.zeros_like(self.bse), where=self.bse > 0.0)
        result = self.cov * np.outer(inverse, inverse)
        np.fill_diagonal(result, 1.0)
        return result

    @property
    def tvalues(self) -> np.ndarray:
        """Coefficients over their standard errors, shape (p,)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.params / self.bse

    @property
    def pvalues(self) -> np.ndarray:
        """Two-sided p-values of the coefficients being zero, shape (p,)."""
        from scipy.special import stdtr

        return 2.0 * stdtr(self.t_dof, -np.abs(self.tvalues))

    def conf_int(self, level: float | None = None) -> np.ndarray:
        """t-intervals of the coefficients.

        Parameters
        ----------
        level : float, optional
            Confidence; the fit's own when omitted.

        Returns
        -------
        ndarray, shape (p, 2)
            Lower and upper limits.
        """
        from scipy.special import stdtrit

        chosen = self.confidence if level is None else level
        if not 0.0 < chosen < 1.0:
            raise FitError(f"the confidence level {chosen} is not between 0 and 1", cure="use for example 0.95")
        half = stdtrit(self.t_dof, 0.5 + 0.5 * chosen) * self.bse
        return np.column_stack([self.params - half, self.params + half])

    def to_frame(self) -> pd.DataFrame:
        """One row a coefficient: value, std, t, p, lower, upper, dof."""
        import pandas as pd

        limits = self.conf_int()
        columns = {
            "value": self.params,
            "std": self.bse,
            "t": self.tvalues,
            "p": self.pvalues,
            "lower": limits[:, 0],
            "upper": limits[:, 1],
            "dof": self.t_dof,
        }
        return pd.DataFrame(columns, index=pd.Index(self.names, name="name"))
