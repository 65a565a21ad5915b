"""Every figure function draws into the axes it is given, with units on both axes, and says what it draws."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import FitError, TermError
from towtank.pmm import CampaignResult
from towtank.report import compare_sets
from towtank.report.figures import (
    amplitude_fit,
    comparison_figure,
    correlation_map,
    derivative_forest,
    force_fit,
    measured_against_fitted,
    residuals_by_run,
    sweeps,
    time_series,
)
from towtank.report.residual_figures import standardised_residuals

Draw = Callable[..., Axes]


def drawings(result: CampaignResult) -> dict[str, Draw]:
    """Each figure function with its first arguments bound."""
    fit = result.fits[0]
    shown = next(run for run in fit.runs if run.series)
    return {
        "force": lambda ax: force_fit(fit, sweeps(fit)[0], "Y", ax=ax),
        "amplitude": lambda ax: amplitude_fit(fit, "pure_yaw", "N", ax=ax),
        "residuals": lambda ax: residuals_by_run(fit, "X", ax=ax),
        "agreement": lambda ax: measured_against_fitted(fit, "N", ax=ax),
        "series": lambda ax: time_series(fit, shown, "Y", ax=ax),
        "forest": lambda ax: derivative_forest(result.derivatives, result.comparison("three ways"), ax=ax),
        "correlation": lambda ax: correlation_map(result.derivatives, ax=ax),
        "comparison": lambda ax: comparison_figure(compare_sets(result.derivatives, result.derivatives), ax=ax),
    }


@pytest.mark.parametrize(
    "name", ["force", "amplitude", "residuals", "agreement", "series", "forest", "correlation", "comparison"]
)
def test_figures_take_and_return_axes(name: str, pmm_result: CampaignResult) -> None:
    ax = Figure().add_subplot()
    draw = drawings(pmm_result)[name]
    assert draw(ax) is ax
    assert ax.lines or ax.collections or ax.images
    if name != "correlation":
        assert "[" in ax.get_xlabel() or name == "residuals"
        assert "[" in ax.get_ylabel() or name in ("forest", "comparison")
    fresh = draw(None)
    assert fresh is not ax


def test_measured_points_and_curve_of_static_drift(drift_result: CampaignResult) -> None:
    fit = drift_result.fits[0]
    ax = force_fit(fit, sweeps(fit)[0], "Y")
    points = next(line for line in ax.lines if line.get_marker() == "o")
    np.testing.assert_allclose(points.get_xdata(), [0, 5, 10, 15, 20], atol=1e-9)
    np.testing.assert_allclose(points.get_ydata(), [0, 0.015179, 0.030359, 0.045538, 0.108948])
    curve = next(line for line in ax.lines if len(line.get_xdata()) > 10)
    assert np.asarray(curve.get_ydata())[-1] == pytest.approx(
        -0.342020 * fit.derivatives["Yv"] - 0.342020**3 * fit.derivatives["Yvvv"], rel=1e-4
    )


def test_reconstructed_series_follow_the_measured_ones(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    run = next(run for run in fit.runs if run.series and run.order)
    ax = time_series(fit, run, "Y")
    measured, fitted = ax.lines
    assert ax.get_ylabel() == "Y [N]"
    at = np.interp(measured.get_xdata(), fitted.get_xdata(), fitted.get_ydata())
    assert np.std(at - measured.get_ydata()) < 0.05 * np.std(measured.get_ydata())
    quiet = next(run for run in fit.runs if not run.series)
    with pytest.raises(FitError, match="keeps no series of Y"):
        time_series(fit, quiet, "Y")


def test_outlying_runs_carry_their_names(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    result = fit.components["Y"]
    rows = result.rows
    assert not residuals_by_run(fit, "Y").texts
    response = rows.response.copy()
    worst = int(np.flatnonzero(rows.run == 4)[0])
    response[worst] += 30 * result.row_sd[worst]
    spoiled = replace(fit, components={"Y": replace(result, rows=replace(rows, response=response))})
    ax = residuals_by_run(spoiled, "Y")
    assert [text.get_text() for text in ax.texts] == [fit.runs[4].name]
    assert standardised_residuals(spoiled.components["Y"])[worst] > 20


def test_intervals_and_other_ways_in_the_forest(pmm_result: CampaignResult) -> None:
    ax = derivative_forest(pmm_result.derivatives, pmm_result.comparison("three ways"))
    assert [label.get_text() for label in ax.get_yticklabels()] == list(pmm_result.derivatives.names)
    legend = ax.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["mean of single runs", "multiple-run curves"]


def test_wide_intervals_end_in_arrows(hull: DerivativeSet) -> None:
    sd = 0.01 * np.abs(hull.values)
    sd[3] = 10 * abs(hull.values[3])
    ax = derivative_forest(replace(hull, covariance=np.diag(sd**2)))
    assert [line.get_marker() for line in ax.lines if line.get_marker() in ("<", ">")] == ["<", ">"]
    assert ax.get_xlim()[1] < 20


def test_sets_without_covariance(hull: DerivativeSet) -> None:
    with pytest.raises(TermError, match="has no covariance"):
        correlation_map(hull)
    assert len(derivative_forest(hull).lines) == 1 + len(hull)


def test_comparison_marks_what_differs(hull: DerivativeSet) -> None:
    known = replace(hull, covariance=np.diag((0.02 * hull.values) ** 2))
    other = known.with_values(Yv=hull["Yv"] * 1.3, Nv=hull["Nv"] * 4.0)
    ax = comparison_figure(compare_sets(known, other))
    legend = ax.get_legend()
    assert legend is not None
    assert len(legend.get_texts()) == 3
    assert [text.get_text() for text in ax.texts] == ["+300 %"]
    left, right = ax.get_xlim()
    assert -left == right
