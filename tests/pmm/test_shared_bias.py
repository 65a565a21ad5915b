"""Type B uncertainty: its effects against campaigns that really have the error; repeats do not shrink it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.scales import force_unit
from towtank.pmm.campaign_file import Fit, SharedBias
from towtank.pmm.hull_fit import HullFit, fit_hull
from towtank.pmm.reduced_run import ReducedRun
from towtank.pmm.run_types import Run
from towtank.pmm.shared_bias import bias_covariance, bias_effects

SPEED = 1.2


def campaign(drift: float = 0.0, speed: float = 1.0) -> list[Run]:
    """Drift, pure sway, pure yaw and yaw with drift; with an error of all angles and of the carriage speed."""
    runs = [
        Run(f"drift {b}", "static_drift", speed=SPEED, drift_angle=math.radians(b)) for b in (-9, -4, 0, 4, 9, 12)
    ]
    for y in (0.1, 0.2):
        runs.append(Run(f"sway {y}", "pure_sway", speed=SPEED, frequency=0.9, sway_amplitude=y))
        runs.append(Run(f"yaw {y}", "pure_yaw", speed=SPEED, frequency=0.9, sway_amplitude=y))
        runs.append(Run(f"both {y}", "yaw_drift", speed=SPEED, frequency=0.9, sway_amplitude=y, drift_angle=0.12))
    return [replace(run, drift_angle=run.drift_angle + drift, speed=run.speed * speed) for run in runs]


def fitted(runs: list[ReducedRun], hull, bias: SharedBias | None = None) -> HullFit:
    settings = Fit(shared_bias=bias or SharedBias(), estimator="ols")
    return fit_hull(runs, settings, hull.ship, name="fit", terms=hull.terms)


def rescaled(runs: list[ReducedRun], assumed: list[ReducedRun]) -> list[ReducedRun]:
    """Forces of the true runs, reduced with the motion that the laboratory believes in."""
    results = []
    for true, believed in zip(runs, assumed, strict=True):
        ratio = (true.motion.speed / believed.motion.speed) ** 2
        results.append(replace(believed, scaled={name: ratio * values for name, values in true.scaled.items()}))
    return results


@pytest.fixture(scope="module")
def clean(reduced, hull) -> list[ReducedRun]:
    return reduced(hull, campaign())


def effect_of(runs: list[ReducedRun], hull, bias: SharedBias) -> np.ndarray:
    fit = fitted(runs, hull)
    ((_, vector),) = bias_effects(runs, fit.components, bias).values()
    return vector


def changed(runs: list[ReducedRun], hull) -> np.ndarray:
    fit = fitted(runs, hull).derivatives
    return np.array([fit[term.name] - hull[term.name] for term in fit.terms])


def test_gain(clean, hull) -> None:
    wrong = [replace(run, scaled={**run.scaled, "Y": 1.01 * run.scaled["Y"]}) for run in clean]
    predicted = 0.01 * effect_of(clean, hull, SharedBias(gain={"Y": 0.01}))
    np.testing.assert_allclose(changed(wrong, hull), predicted, atol=1e-10)


def test_offset_of_the_balance(clean, hull) -> None:
    """An offset of the moment in N m changes the steady means, and the static drift derivatives with them."""
    size = 0.05
    wrong = []
    for run in clean:
        values = run.scaled["N"].copy()
        values[0] += size / force_unit("N", "LT", run.ship, run.motion.speed)
        wrong.append(replace(run, scaled={**run.scaled, "N": values}))
    predicted = size * effect_of(clean, hull, SharedBias(offset={"N": size}))
    actual = changed(wrong, hull)
    assert np.abs(actual).max() > 1e-4
    np.testing.assert_allclose(actual, predicted, atol=1e-9)


def test_drift_angle(reduced, hull, clean) -> None:
    error = math.radians(0.02)
    wrong = rescaled(reduced(hull, campaign(drift=error)), clean)
    predicted = -error * effect_of(clean, hull, SharedBias(drift_angle=error))
    actual = changed(wrong, hull)
    size = np.abs(predicted).max()
    assert size > 1e-5
    np.testing.assert_allclose(actual, predicted, atol=2e-3 * size)


def test_carriage_speed_is_relative(reduced, hull, clean) -> None:
    error = 1e-4
    wrong = rescaled(reduced(hull, campaign(speed=1 + error)), clean)
    predicted = -error * effect_of(clean, hull, SharedBias(speed=error))
    actual = changed(wrong, hull)
    size = np.abs(predicted).max()
    assert size > 1e-5
    np.testing.assert_allclose(actual, predicted, atol=2e-3 * size)


def test_place_of_the_moment(clean, hull) -> None:
    shift = 0.01
    wrong = [
        replace(run, scaled={**run.scaled, "N": run.scaled["N"] + shift / run.ship.L * run.scaled["Y"]})
        for run in clean
    ]
    predicted = shift * effect_of(clean, hull, SharedBias(moment_x=shift))
    np.testing.assert_allclose(changed(wrong, hull), predicted, atol=1e-10)


def test_covariance_is_the_sum_of_outer_products(clean, hull) -> None:
    bias = SharedBias(gain={"Y": 0.01, "N": 0.02}, speed=0.003, drift_angle=0.002)
    fit = fitted(clean, hull)
    covariance, shares = bias_covariance(clean, fit.components, bias)
    effects = bias_effects(clean, fit.components, bias)
    expected = sum(u**2 * np.outer(vector, vector) for u, vector in effects.values())
    np.testing.assert_allclose(covariance, expected, rtol=1e-12, atol=1e-20)
    assert list(shares) == ["gain of Y", "gain of N", "carriage speed", "drift angle"]
    for source, (u, vector) in effects.items():
        assert shares[source] == pytest.approx(u * np.linalg.norm(vector), rel=1e-12)


def test_no_bias_is_no_covariance(clean, hull) -> None:
    fit = fitted(clean, hull)
    covariance, shares = bias_covariance(clean, fit.components, SharedBias())
    assert covariance.shape == (len(hull.terms), len(hull.terms))
    assert not covariance.any()
    assert shares == {}


def test_repeats_average_the_scatter_and_not_the_bias(reduced, hull) -> None:
    """Four campaigns instead of one: half of the scatter, all of the bias."""
    bias = SharedBias(gain={"X": 0.02, "Y": 0.02, "N": 0.02})
    repeats, size = 4, {"noise": 0.02, "samples": 120, "cycles": 2}
    once = reduced(hull, campaign(), seed=1, **size)
    many = []
    for seed in range(repeats):
        part = reduced(hull, campaign(), seed=seed + 1, **size)
        many += [replace(run, run=replace(run.run, name=f"{run.name} ({seed})")) for run in part]
    scatter = [fitted(runs, hull).derivatives.bse for runs in (once, many)]
    total = [fitted(runs, hull, bias).derivatives.bse for runs in (once, many)]
    ratio = scatter[1] / scatter[0]
    assert np.median(ratio) == pytest.approx(1 / math.sqrt(repeats), rel=0.15)
    for runs, with_bias, without in zip((once, many), total, scatter, strict=True):
        values = fitted(runs, hull).derivatives
        for name in hull.names:
            # a gain error of 2 % is 2 % of every derivative, however many runs there are
            assert with_bias[name] ** 2 - without[name] ** 2 == pytest.approx((0.02 * values[name]) ** 2, rel=1e-6)


def test_gain_of_all_forces_is_a_gain_of_all_derivatives(clean, hull) -> None:
    fit = fitted(clean, hull, SharedBias(gain={"Y": 0.02}))
    for name in hull.names:
        expected = 0.02 * abs(hull[name]) if name.startswith("Y") else 0.0
        assert fit.derivatives.bse[name] == pytest.approx(expected, rel=1e-6, abs=1e-9)
    correlation = fit.derivatives.cov_params().loc["Yv", "Yvvv"]
    assert correlation == pytest.approx(0.02**2 * hull["Yv"] * hull["Yvvv"], rel=1e-6)


def test_bias_of_a_force_that_is_not_fitted(clean, hull) -> None:
    with pytest.raises(FitError, match="shared bias of 'K', which is not fitted"):
        fitted(clean, hull, SharedBias(gain={"K": 0.01}))
