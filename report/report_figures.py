"""The drawings of the report: every figure of a group of runs as inline SVG with its caption."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from matplotlib.axes import Axes

from ..core.derivative_set import DerivativeSet
from ..core.processes import can_fork, in_processes
from ..pmm.hull_fit import HullFit
from .derivative_figures import correlation_map, derivative_forest
from .drawings import Drawing, Row
from .figure_style import Sheet, inline_svg
from .force_curves import sweeps
from .force_figures import MOST_RUNS, amplitude_fit, curve_colour, force_fit
from .residual_figures import MOST_ROWS, measured_against_fitted, residuals_by_run
from .series_figures import time_series

if TYPE_CHECKING:
    import pandas as pd

RUNS_OF_A_KIND = 2
"""Runs of one kind and different amplitudes from which harmonics are drawn against amplitude."""

MANY_RUNS = 200
"""Runs from which on the drawings are shared among processes."""


@dataclass(frozen=True)
class Sections:
    """The drawings of one group by their sections of the page."""

    forest: Drawing
    fits: tuple[Row, ...]
    residuals: Row
    agreement: Row
    series: tuple[Row, ...]
    correlation: Drawing | None


def draw_sections(fit: HullFit, written: DerivativeSet, prefix: str) -> Callable[[pd.DataFrame | None], Sections]:
    """Every drawing of a group; those of a large campaign are begun at once in other processes.

    Parameters
    ----------
    fit : HullFit
    written : DerivativeSet
        The set in the conventions of the output.
    prefix : str
        Unique in the page, e.g. ``g1``.

    Returns
    -------
    callable
        Gives the drawings when it is told the derivatives of the three ways (or None).
    """
    # The longest first, so that the processes end together.
    drawers: dict[str, Callable[[Draughtsman], Any]] = {
        "series": lambda draw: tuple(draw.series()),
        "fits": lambda draw: tuple(draw.force_fits()),
        "residuals": Draughtsman.residuals,
        "agreement": Draughtsman.agreement,
        "correlation": lambda draw: draw.correlation() if written.covariance is not None else None,
    }

    def drawn(name: str) -> Any:
        return drawers[name](Draughtsman(fit, written, f"{prefix}-{name}"))

    names = list(drawers)
    shared = len(fit.runs) > MANY_RUNS and can_fork()
    drawings = in_processes(drawn, names, 2) if shared else map(drawn, names)

    def sections(ways: pd.DataFrame | None) -> Sections:
        forest = Draughtsman(fit, written, f"{prefix}-forest").forest(ways)
        return Sections(forest=forest, **dict(zip(names, drawings, strict=True)))

    return sections


class Draughtsman:
    """Draws the figures of one group; panels of equal size share one sheet.

    Parameters
    ----------
    fit : HullFit
    written : DerivativeSet
        The set in the conventions of the output.
    prefix : str
        Unique in the page, e.g. ``g1-series``.
    """

    def __init__(self, fit: HullFit, written: DerivativeSet, prefix: str) -> None:
        self.fit = fit
        self.written = written
        self._prefix = prefix
        self._sheet = Sheet()
        self._count = 0

    def _panels(self, text: str, draw: Callable[..., Axes], components: Iterable[str]) -> tuple[Drawing, ...]:
        """One panel a component; `text` says what they show to readers who do not see them."""
        panels = []
        for component in components:
            self._count += 1
            draw(component, ax=self._sheet.fresh())
            panels.append(Drawing(self._sheet.svg(f"{self._prefix}-{self._count}", f"{component}: {text}")))
        return tuple(panels)

    def _large(self, caption: str, ax: Axes) -> Drawing:
        self._count += 1
        figure = ax.get_figure(root=True)
        assert figure is not None
        return Drawing(inline_svg(figure, f"{self._prefix}-{self._count}", caption), caption)

    def force_fits(self) -> Iterator[Row]:
        """Forces against drift angle, yaw rate, ... of steady runs, and harmonics against amplitude."""
        for sweep in sweeps(self.fit):
            name = sweep.label.split(" [")[0]
            yield Row(
                f"Steady runs against {name}",
                self._panels(
                    f"force against {name}", partial(force_fit, self.fit, sweep, legend=False), self.fit.components
                ),
                "Points: measured, with bars of 95 %. Lines: fitted, with their 95 % band.",
                tuple((curve_colour(n), curve.label) for n, curve in enumerate(sweep.curves) if curve.label),
            )
        for kind in self._oscillating_kinds():
            name = kind.replace("_", " ")
            excited = [
                component
                for component, result in self.fit.components.items()
                if any(self.fit.runs[index].run.kind == kind for index in result.rows.run.tolist())
            ]
            yield Row(
                f"Harmonics of {name} runs against amplitude",
                self._panels(
                    f"harmonics against amplitude, {name}", partial(amplitude_fit, self.fit, kind), excited
                ),
                "Filled: measured, with bars of 95 %. Open, joined: fitted. "
                f"The largest harmonics; at most {MOST_RUNS} runs.",
            )

    def _oscillating_kinds(self) -> list[str]:
        amplitudes: dict[str, set[tuple[float, float, float]]] = {}
        for run in self.fit.runs:
            if run.order and not run.run.drift_angle:
                test = run.run
                size = (test.sway_amplitude, test.yaw_amplitude, test.surge_amplitude)
                amplitudes.setdefault(test.kind, set()).add(size)
        return [kind for kind, sizes in amplitudes.items() if len(sizes) >= RUNS_OF_A_KIND]

    def residuals(self) -> Row:
        """Standardised residuals run by run."""
        return Row(
            "Residuals by run",
            self._panels(
                "standardised residuals by run", partial(residuals_by_run, self.fit), self.fit.components
            ),
            "Residuals over the standard deviation of their row. Shaded: ± 2. Numbers as in the table of runs.",
        )

    def agreement(self) -> Row:
        """Measured against fitted means and harmonics."""
        return Row(
            "Measured against fitted",
            self._panels(
                "measured against fitted values", partial(measured_against_fitted, self.fit), self.fit.components
            ),
            f"Means and harmonics with bars of 95 %, at most {MOST_ROWS}; the line is equality.",
        )

    def series(self) -> Iterator[Row]:
        """Measured and reconstructed series of the runs that kept theirs."""
        for run in self.fit.runs:
            shown = [component for component in self.fit.components if component in run.series]
            if shown:
                yield Row(
                    f"{run.name} ({run.run.kind.replace('_', ' ')})",
                    self._panels(
                        f"time series of run {run.name}, measured and fitted",
                        partial(time_series, self.fit, run),
                        shown,
                    ),
                )

    def forest(self, ways: pd.DataFrame | None) -> Drawing:
        """Intervals of all derivatives."""
        caption = "95 % interval of each derivative in per cent of its value; an arrow where it leaves the figure."
        if ways is not None:
            caption += (
                " Beside it the estimates from single runs and from multiple-run curves, where they lie inside."
            )
        return self._large(caption, derivative_forest(self.written, ways))

    def correlation(self) -> Drawing:
        """Correlation of all derivatives."""
        caption = "Correlation between the derivatives: orange positive, violet negative; above 0.9 in per cent."
        return self._large(caption, correlation_map(self.written))
