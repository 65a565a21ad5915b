"""Intervals against truth: virtual campaigns with known noise, many times over."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.pmm.campaign_file import Fit, Reduction, SharedBias
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.reduced_run import ReducedRun
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import pure_sway, pure_yaw, static_drift
from towtank.pmm.virtual_records import VirtualCampaign, virtual_campaign

SPEED = 1.5311
DRIFT = static_drift((-16, -12, -8, -4, 4, 8, 12, 16), SPEED)
MATRIX = [
    *DRIFT,
    *pure_sway((0.1, 0.2, 0.3), 0.841, SPEED),
    *pure_yaw((0.1, 0.2, 0.3, 0.375), 1.08, SPEED),
    *pure_yaw((0.15, 0.3), 1.08, SPEED, (-8.0, 8.0)),
]
LABORATORY = Laboratory(sampling_rate=10.0, duration=30.0, cycles=4)
GAIN = 0.02


def reductions(campaign: VirtualCampaign, noise: Noise, truth: DerivativeSet) -> list[ReducedRun]:
    plan = ReductionPlan(Reduction(skip_cycles=0), truth.ship, HOME, terms=truth.terms)
    return [reduce_run(record, run, plan) for run, record in campaign.records(noise)]


def fitted(runs: Sequence[ReducedRun], truth: DerivativeSet, bias: SharedBias | None = None) -> DerivativeSet:
    settings = Fit(shared_bias=bias or SharedBias())
    return fit_hull(runs, settings, truth.ship, name="twin", terms=truth.terms).derivatives


def covered(derivatives: DerivativeSet, truth: DerivativeSet) -> np.ndarray:
    """Whether the 95 % interval of each coefficient holds the truth, shape (p,)."""
    low, high = np.asarray(derivatives.conf_int()).T
    values = np.array([truth[name] for name in derivatives.names])
    return (low <= values) & (values <= high)


@pytest.mark.slow
def test_intervals_cover_the_truth_under_autocorrelated_noise(hull):
    """Two per cent of AR(1) noise: 95 % intervals cover in 92 to 97 % of 300 campaigns."""
    campaign = virtual_campaign(hull, MATRIX, LABORATORY)
    hits = np.array(
        [
            covered(fitted(reductions(campaign, Noise(ar1=0.02, rho=0.9, seed=seed), hull), hull), hull)
            for seed in range(300)
        ]
    )
    assert hits.shape == (300, len(hull))
    assert 0.92 <= hits.mean() <= 0.97
    each = hits.mean(axis=0)
    assert each.min() >= 0.88
    assert each.max() <= 0.99


@pytest.fixture(scope="module")
def drift(hull) -> tuple[VirtualCampaign, DerivativeSet]:
    truth = hull.subset(["R0", "Xvv", "Xvvvv", "Yv", "Yvvv", "Nv", "Nvvv"])
    return virtual_campaign(truth, DRIFT, LABORATORY), truth


def test_a_gain_error_of_all_runs_is_covered_when_it_is_declared_and_only_then(drift):
    campaign, truth = drift
    declared = SharedBias(gain=dict.fromkeys("XYN", GAIN))
    with_bias, without = [], []
    for seed in range(200):
        runs = reductions(campaign, Noise(ar1=0.002, rho=0.9, gain_bias=GAIN, seed=seed), truth)
        with_bias.append(covered(fitted(runs, truth, declared), truth))
        without.append(covered(fitted(runs, truth), truth))
    assert np.mean(with_bias, axis=0).min() >= 0.92
    # Only the coefficients of large powers are uncertain enough by scatter alone.
    assert np.mean(without) < 0.5
    assert np.mean(without, axis=0)[list(truth.names).index("Yv")] < 0.4


def test_repeating_the_runs_shrinks_the_scatter_and_not_the_shared_bias(drift):
    campaign, truth = drift
    noise = Noise(ar1=0.01, rho=0.9, gain_bias=GAIN, seed=11)
    once = reductions(campaign, noise, truth)
    again: list[Run] = [replace(run, name=f"{run.name} {turn}") for turn in range(4) for run in DRIFT]
    four = reductions(virtual_campaign(truth, again, LABORATORY), noise, truth)
    scatter = fitted(four, truth).bse / fitted(once, truth).bse
    assert np.exp(np.log(scatter).mean()) == pytest.approx(0.5, rel=0.25)
    declared = SharedBias(gain=dict.fromkeys("XYN", GAIN))
    single, repeated = fitted(once, truth, declared), fitted(four, truth, declared)
    for name in ("R0", "Yv", "Nv"):
        assert repeated.bse[name] >= GAIN * abs(repeated[name]) * (1 - 1e-9)
        assert repeated.bse[name] == pytest.approx(single.bse[name], rel=0.15)
    sources = repeated.diagnostics["shared_bias"]
    assert set(sources) == {"gain of X", "gain of Y", "gain of N"}
    assert sources["gain of X"] == pytest.approx(
        GAIN * np.linalg.norm([repeated[name] for name in ("R0", "Xvv", "Xvvvv")])
    )
