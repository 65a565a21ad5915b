"""First-order propagation: sensitivities of the indices by central differences, and their spread ``J C J^T``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .index_definitions import definition_of
from .parameter_scatter import ParameterScatter
from .programme import Programme
from .sailed_batches import Voyage, sail_rows
from .vessel import Vessel

if TYPE_CHECKING:
    import pandas as pd

    from .environment import Environment

FloatArray = np.ndarray

STEP = 0.1
"""Step of the differences in standard deviations: small against the curvature of the indices."""

SMALLEST_STEP = 1e-4
"""Smallest step as a share of the value: large against the error of the integration."""

TOLERANCE = 1e-9
"""Error of a step of the integration in units of L, U0 and rad: below what the differences resolve."""


@dataclass(frozen=True, eq=False)
class FirstOrder:
    """Sensitivities of the indices of an unperturbed vessel, and the spread that follows from them.

    Attributes
    ----------
    scatter : ParameterScatter
    values : mapping of str to mapping of str to float
        Manoeuvre -> index -> value of the unperturbed vessel.
    sensitivities : mapping of str to mapping of str to ndarray, shape (p,)
        Derivative of the index by each parameter; NaN where a neighbour has no such index.
    """

    scatter: ParameterScatter
    values: Mapping[str, Mapping[str, float]]
    sensitivities: Mapping[str, Mapping[str, FloatArray]]

    def sd(self, manoeuvre: str, index: str) -> float:
        """Standard deviation, ``sqrt(J C J^T)``."""
        slope = self.sensitivities[manoeuvre][index]
        return float(np.sqrt(max(slope @ self.scatter.covariance @ slope, 0.0)))

    @property
    def elasticities(self) -> dict[str, dict[str, FloatArray]]:
        """Manoeuvre -> index -> per cent of the index per per cent of each parameter; 0 for a parameter that is 0."""
        return {
            manoeuvre: {
                index: slope * self.scatter.center / self.values[manoeuvre][index]
                if self.values[manoeuvre][index]
                else np.full(len(slope), np.nan)
                for index, slope in slopes.items()
            }
            for manoeuvre, slopes in self.sensitivities.items()
        }

    def table(self) -> pd.DataFrame:
        """Columns manoeuvre, index, value, unit, sd, p05, p95; the quantiles are those of a normal distribution."""
        import pandas as pd
        from scipy.special import ndtri

        reach = float(ndtri(0.95))
        rows = []
        for manoeuvre, indices in self.values.items():
            for index, value in indices.items():
                if np.isfinite(value):
                    sd = self.sd(manoeuvre, index)
                    limits = (value - reach * sd, value + reach * sd)
                    rows.append((manoeuvre, index, value, definition_of(index).unit, sd, *limits))
        return pd.DataFrame(rows, columns=["manoeuvre", "index", "value", "unit", "sd", "p05", "p95"])

    def beside(self, statistics: pd.DataFrame) -> pd.DataFrame:
        """This spread beside that of an ensemble.

        Parameters
        ----------
        statistics : DataFrame
            Of :func:`~towtank.simulate.ensemble_table.index_statistics`.

        Returns
        -------
        DataFrame
            Columns manoeuvre, index, unit, sd, sd_first_order, difference_pct, mean_shift.
        """
        table = statistics[["manoeuvre", "index", "unit", "sd"]].copy()
        first = [
            self.sd(manoeuvre, index) if index in self.sensitivities.get(manoeuvre, {}) else np.nan
            for manoeuvre, index in zip(table["manoeuvre"], table["index"], strict=True)
        ]
        table["sd_first_order"] = first
        sd = table["sd"].where(table["sd"] > 0.0)
        table["difference_pct"] = 100.0 * (table["sd_first_order"] - sd) / sd
        table["mean_shift"] = statistics["mean"] - statistics["value"]
        return table


def propagate(
    vessel: Vessel,
    programmes: tuple[Programme, ...],
    scatter: ParameterScatter,
    *,
    environment: Environment | None = None,
) -> FirstOrder:
    """Sail the vessel with each of its uncertain numbers a little higher and lower.

    Parameters
    ----------
    vessel : Vessel
    programmes : tuple of Programme
    scatter : ParameterScatter
        From :func:`~towtank.simulate.parameter_scatter.scatter_of`.
    environment : Environment, optional
    """
    steps = np.maximum(STEP * scatter.sd, SMALLEST_STEP * np.abs(scatter.center))
    rows = np.concatenate([scatter.center[None], scatter.center + np.diag(steps), scatter.center - np.diag(steps)])
    sailed = sail_rows(Voyage(vessel, programmes, scatter.names, environment, TOLERANCE), rows)
    count = len(steps)
    widths = rows[1 : count + 1].diagonal() - rows[count + 1 :].diagonal()
    return FirstOrder(
        scatter,
        {m: {index: float(drawn[0]) for index, drawn in found.items()} for m, found in sailed.values.items()},
        {
            m: {index: (drawn[1 : count + 1] - drawn[count + 1 :]) / widths for index, drawn in found.items()}
            for m, found in sailed.values.items()
        },
    )
