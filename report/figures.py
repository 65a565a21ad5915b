"""All figures of the package by name; each takes and returns matplotlib axes."""

from __future__ import annotations

from .comparison_figures import comparison_figure
from .derivative_figures import correlation_map, derivative_forest
from .figure_style import inline_svg, new_axes
from .force_curves import sweeps
from .force_figures import amplitude_fit, force_fit
from .residual_figures import measured_against_fitted, residuals_by_run
from .series_figures import time_series

__all__ = [
    "amplitude_fit",
    "comparison_figure",
    "correlation_map",
    "derivative_forest",
    "force_fit",
    "inline_svg",
    "measured_against_fitted",
    "new_axes",
    "residuals_by_run",
    "sweeps",
    "time_series",
]
