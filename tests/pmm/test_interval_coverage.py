"""95 % intervals of a fit cover the truth in 92 to 97 % of virtual campaigns; shared bias is not averaged away."""

import math

import numpy as np
import pytest

from towtank.core import Conventions, DerivativeSet, Ship
from towtank.pmm import Run
from towtank.pmm.campaign_file import Fit, Reduction, SharedBias
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.virtual_records import virtual_campaign

SHIP = Ship("hull", L=3.048, B=0.41, T=0.136, volume=0.086, kzz=0.76, rho=1000.0)
VALUES = {
    "R0": 0.0153, "Xvv": -0.142, "Xvr": 0.03, "Xrr": -0.028, "Yv": -0.3, "Yr": -0.0485, "Yvvv": -1.79, "Yvvr": -1.7,
    "Yvrr": -1.37, "Yrrr": -0.45, "Yvdot": -0.111, "Yrdot": -0.009, "Nv": -0.163, "Nr": -0.0485, "Nvvv": -0.33,
    "Nvvr": -0.55, "Nvrr": -0.4, "Nrrr": -0.05, "Nvdot": -0.013, "Nrdot": -0.007,
}  # fmt: skip
TRUTH = DerivativeSet.from_values("truth", SHIP, VALUES, Conventions(added_mass_coriolis="inside"))
SPEED, OMEGA = 1.531, 0.841
LABORATORY = Laboratory(sampling_rate=10.0, duration=30.0, cycles=4)


def programme(repeats=1):
    runs = []
    for n in range(repeats):
        runs += [
            Run(f"drift {b} {n}", "static_drift", SPEED, drift_angle=math.radians(b))
            for b in (-12, -9, -6, -3, 0, 3, 6, 9, 12)
        ]
        runs += [
            Run(f"sway {a} {n}", "pure_sway", SPEED, frequency=OMEGA, sway_amplitude=a) for a in (0.06, 0.2, 0.32)
        ]
        runs += [
            Run(f"yaw {a} {n}", "pure_yaw", SPEED, frequency=OMEGA, sway_amplitude=a) for a in (0.1, 0.2, 0.3, 0.4)
        ]
        runs += [
            Run(
                f"both {b} {n}",
                "yaw_drift",
                SPEED,
                frequency=OMEGA,
                sway_amplitude=0.3,
                drift_angle=math.radians(b),
            )
            for b in (-10, -5, 5, 10)
        ]
    return runs


def fits(noise, campaigns, bias=None, repeats=1):
    virtual = virtual_campaign(TRUTH, programme(repeats), LABORATORY)
    settings = Fit(terms=list(VALUES), shared_bias=bias or SharedBias())
    plan = ReductionPlan(Reduction(skip_cycles=0), SHIP, Conventions())
    for seed in range(campaigns):
        records = virtual.records(Noise(**noise, seed=seed))
        reduced = [reduce_run(record, run, plan) for run, record in records]
        yield fit_hull(reduced, settings, SHIP, name="virtual").derivatives


def covered(found):
    interval = found.conf_int()
    truth = np.array([VALUES[name] for name in found.names])
    return (interval["lower"].to_numpy() <= truth) & (truth <= interval["upper"].to_numpy())


@pytest.mark.slow
def test_intervals_cover_with_autocorrelated_noise():
    hits = np.mean([covered(found) for found in fits({"ar1": 0.02, "rho": 0.9}, 300)], axis=0)
    assert 0.92 <= hits.mean() <= 0.97
    # one coefficient: three standard deviations of a proportion over 300 campaigns beyond the band
    spread = 3 * math.sqrt(0.92 * 0.08 / 300)
    assert hits.min() >= 0.92 - spread
    assert hits.max() <= 1.0


@pytest.mark.slow
def test_a_gain_that_all_runs_share_is_not_averaged_away():
    noise = {"ar1": 0.005, "rho": 0.9, "gain_bias": 0.02}
    declared = SharedBias(gain={"X": 0.02, "Y": 0.02, "N": 0.02})
    with_bias = np.mean([covered(found) for found in fits(noise, 120, declared)])
    without = np.mean([covered(found) for found in fits(noise, 120)])
    assert 0.91 <= with_bias <= 0.985
    assert without < 0.80


def test_repeats_average_the_scatter_and_leave_the_bias():
    noise = {"ar1": 0.02, "rho": 0.9}
    bias = SharedBias(gain={"Y": 0.02, "N": 0.02})
    once, often = (np.mean([f.bse["Yv"] for f in fits(noise, 4, repeats=n)]) for n in (1, 4))
    assert often == pytest.approx(once / 2, rel=0.2)
    biased = next(iter(fits(noise, 1, bias, repeats=4)))
    assert biased.bse["Yv"] > 0.02 * 0.3 * 0.99


@pytest.mark.parametrize("domain", ["harmonic", "time"])
def test_without_noise_every_coefficient_comes_back(domain):
    virtual = virtual_campaign(TRUTH, programme(), LABORATORY)
    settings = Fit(terms=list(VALUES), domain=domain)
    plan = ReductionPlan(
        Reduction(skip_cycles=0), SHIP, Conventions(), terms=TRUTH.terms, time_domain=domain == "time"
    )
    reduced = [reduce_run(record, run, plan) for run, record in virtual.records(Noise())]
    found = fit_hull(reduced, settings, SHIP, name="virtual").derivatives
    for name, value in VALUES.items():
        assert found[name] == pytest.approx(value, abs=1e-8)
