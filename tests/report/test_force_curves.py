"""The numbers behind the figures of a fit."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.ship import Ship
from towtank.pmm import CampaignResult
from towtank.pmm.campaign_file import Fit
from towtank.pmm.hull_fit import HullFit, fit_hull
from towtank.pmm.reduction import point_run
from towtank.pmm.run_types import Run
from towtank.report.force_curves import (
    curve_along,
    harmonic_name,
    interval_factor,
    motion_amplitude,
    predicted,
    sweeps,
)


@pytest.fixture(scope="module")
def turning(hull: DerivativeSet) -> HullFit:
    """Steady yaw with drift: three yaw rates at each of three drift angles."""
    ship, speed = hull.ship, 1.5
    steady = hull.subset([name for name in hull.names if "dot" not in name])
    runs = []
    for beta in (-0.1, 0.0, 0.15):
        for rate in (0.0, 0.2, 0.4):
            kind = "steady_yaw_drift" if beta and rate else "steady_yaw" if rate else "static_drift"
            run = Run(f"{beta} {rate}", kind, speed, drift_angle=beta, yaw_rate=rate * speed / ship.L)
            motion = {"surge": speed * np.cos(beta), "v": -speed * np.sin(beta), "r": run.yaw_rate}
            forces = steady.forces(motion)
            unit = 0.5 * ship.rho * ship.L * ship.T * speed**2
            scaled = {n: float(f) / unit / (ship.L if n == "N" else 1.0) for n, f in forces.items()}
            runs.append(point_run(run, ship, scaled, dict.fromkeys("XYN", 1e-4)))
    return fit_hull(runs, Fit(terms=["R0", "Xvv", "Yv", "Yr", "Yvvr", "Nv", "Nr"]), ship, name="turning")


def test_sweeps_find_what_varies(turning: HullFit) -> None:
    found = {sweep.variable: sweep for sweep in sweeps(turning)}
    assert set(found) == {"beta", "r"}
    assert [curve.label for curve in found["beta"].curves] == ["r′ = 0", "r′ = 0.2", "r′ = 0.4"]
    assert [curve.label for curve in found["r"].curves] == ["β = -5.73°", "β = 0°", "β = 8.59°"]
    np.testing.assert_allclose(found["r"].curves[0].x, [0.0, 0.2, 0.4], atol=1e-12)
    np.testing.assert_allclose(found["beta"].shown(found["beta"].curves[0].x), np.degrees([-0.1, 0.0, 0.15]))
    kept = {sweep.variable: [curve.label for curve in sweep.curves] for sweep in sweeps(turning, most=2)}
    assert kept == {"beta": ["r′ = 0"], "r": ["β = -5.73°", "β = 0°"]}


def test_a_curve_goes_through_the_fitted_points(turning: HullFit) -> None:
    for sweep in sweeps(turning):
        for curve in sweep.curves:
            for component, result in turning.components.items():
                x, value, half = curve_along(turning, curve, sweep.variable, component, count=2001)
                fitted = {
                    int(index): float(row @ result.params)
                    for index, row in zip(result.rows.run, result.rows.design, strict=True)
                }
                for index, at in zip(curve.runs, curve.x, strict=True):
                    if index in fitted:
                        assert np.interp(at, x, value) == pytest.approx(fitted[index], abs=1e-7)
                assert half.min() >= 0
                assert half.max() > 0


def test_the_band_is_that_of_the_covariance(drift_result: CampaignResult) -> None:
    fit = drift_result.fits[0]
    derivatives = fit.derivatives
    v = np.array([-0.2])
    motion = {"surge": np.sqrt(1 - v**2), "v": v, "r": np.zeros(1)}
    value, half = predicted(fit, "Y", motion, 1.0, derivatives.ship)
    row = np.array([v[0], v[0] ** 3])
    where = [derivatives.names.index(name) for name in ("Yv", "Yvvv")]
    block = derivatives.covariance[np.ix_(where, where)]  # type: ignore[index]
    assert value[0] == pytest.approx(row @ derivatives.values[where], rel=1e-12)
    assert half[0] == pytest.approx(interval_factor(derivatives.dof) * np.sqrt(row @ block @ row), rel=1e-12)


def test_interval_factors() -> None:
    assert interval_factor(np.inf) == pytest.approx(1.959964, abs=1e-6)
    assert interval_factor(2.0) == pytest.approx(4.302653, abs=1e-6)


def test_amplitudes_of_oscillating_runs(pmm_result: CampaignResult) -> None:
    runs = {run.name: run for run in pmm_result.runs}
    sway, label = motion_amplitude(runs["sway 0.1"])
    assert sway == pytest.approx(0.1 * 0.84 / np.hypot(1.531, 0.084), rel=1e-3)
    assert "sway velocity" in label
    yaw, label = motion_amplitude(runs["yaw 0.1 drift 0"])
    assert yaw == pytest.approx(0.1 * 2.0**2 / 1.531 * 3.048 / 1.531, rel=0.02)
    assert "yaw rate" in label


def test_names_of_harmonics() -> None:
    assert [harmonic_name(k) for k in (0, 1, 2, 7, 8)] == ["mean", "cos 1", "sin 1", "cos 4", "sin 4"]


def test_no_sweep_without_steady_runs() -> None:
    ship = Ship("s", L=3.0, B=0.4, T=0.13)
    run = point_run(Run("one", "static_drift", 1.0, drift_angle=0.1), ship, {"Y": 0.1}, {"Y": 0.01})
    fit = HullFit("", (run,), {}, DerivativeSet.from_values("d", ship, {"Yv": -0.3}, HOME))
    assert sweeps(fit) == []
