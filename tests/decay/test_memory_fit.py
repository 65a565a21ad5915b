"""Fit of a decay with memory: closed loop with known and free inertia, noise, what cannot be identified."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.ship import Ship
from towtank.decay.damping_models import damping_model
from towtank.decay.decay_input import decay_from_table
from towtank.decay.fluid_memory import simulate_memory_decay
from towtank.decay.integration_fit import fit_integration
from towtank.decay.memory_damping import MemoryDamping
from towtank.decay.memory_fit import fit_memory_decay
from towtank.decay.transfer_function import TransferFunction

INERTIA = 8e10
RESTORING = INERTIA * (2.0 * math.pi / 20.0) ** 2
MEMORY = TransferFunction(np.array([6e8, 0.0]), np.array([1.0, 0.6, 0.5]))
TRUTH = {"b1": 6e8 / INERTIA, "b2": 4e7 * 180.0 / math.pi / INERTIA, "c1": RESTORING / INERTIA}
TIME = np.arange(0.0, 200.0, 0.25)
CLEAN = simulate_memory_decay(TIME, (math.radians(7.0), 0.0), TRUTH, MEMORY, INERTIA)[:, 0]

KNOWN = {"inertia": INERTIA, "restoring": RESTORING}
FREE = {"inertia": 1.3 * INERTIA, "free_inertia": True}


def record(angle: np.ndarray = CLEAN, time: np.ndarray = TIME):
    return decay_from_table({"time": time, "phi": angle}, unit="rad", name="with waves")


@pytest.mark.parametrize(
    "options",
    [
        pytest.param(KNOWN, id="known"),
        pytest.param({"inertia": INERTIA}, id="restoring free"),
        pytest.param({"inertia": 0.8 * INERTIA, "restoring": RESTORING, "free_inertia": True}, id="inertia free"),
        pytest.param(FREE, id="all free"),
    ],
)
def test_noise_free_record_gives_back_what_made_it(options):
    fit = fit_memory_decay(record(), MEMORY, **options)
    assert fit.diagnostics.converged
    assert dict(zip(fit.names, fit.params)) == pytest.approx(TRUTH | {"inertia": INERTIA}, rel=1e-6)
    assert fit.dimensional_terms()["b1"][0] == pytest.approx(6e8, rel=1e-6)
    assert fit.dimensional_terms()["c1"][0] == pytest.approx(RESTORING, rel=1e-6)


def noisy(seed: int = 1, degrees: float = 0.05):
    return record(CLEAN + math.radians(degrees) * np.random.default_rng(seed).standard_normal(TIME.size))


def test_intervals_of_a_noisy_record_hold_the_truth():
    fit = fit_memory_decay(noisy(), MEMORY, inertia=INERTIA)
    for name, value in TRUTH.items():
        low, high = fit.conf_int(0.99)[fit.position(name)]
        assert low < value < high
        assert fit.bse[fit.position(name)] > 0.0
    assert fit.bse[fit.position("inertia")] == 0.0
    assert fit.diagnostics.r2 > 0.999
    # The two damping terms trade against each other; their sum at an amplitude does not.
    assert fit.correlation[0, 1] < -0.9
    at = fit.equivalent(math.radians(5.0))
    assert at.alpha_sd[0] / at.alpha[0] < 0.2 * fit.bse[1] / abs(fit.params[1])


@pytest.mark.slow
def test_intervals_of_the_equivalent_damping_cover(make_noise):
    """150 records with AR(1) noise: the 95 % intervals hold the truth in 92 to 98 % (two standard errors: 3.6 %)."""
    amplitude = np.radians([2.0, 4.0, 6.0])
    true = fit_memory_decay(record(), MEMORY, inertia=INERTIA).equivalent(amplitude).alpha
    hits = []
    for seed in range(150):
        noise = make_noise(TIME.size, math.radians(0.1), 0.9, seed)
        at = fit_memory_decay(record(CLEAN + noise), MEMORY, inertia=INERTIA).equivalent(amplitude)
        hits.append((at.alpha_lower <= true) & (true <= at.alpha_upper))
    assert 0.92 <= np.mean(hits) <= 0.98


def test_free_inertia_is_said_not_to_be_identified():
    fit = fit_memory_decay(noisy(), MEMORY, **FREE)
    assert ("not-identified", "inertia") in [(finding.rule, finding.place) for finding in fit.findings]


def test_restoring_that_is_known_moves_with_the_inertia():
    fit = fit_memory_decay(noisy(), MEMORY, inertia=0.9 * INERTIA, restoring=RESTORING, free_inertia=True)
    c1, last = fit.position("c1"), fit.position("inertia")
    assert fit["c1"] * fit.inertia == pytest.approx(RESTORING)
    assert fit.correlation[c1, last] == pytest.approx(-1.0)
    value, error = fit.dimensional_terms()["c1"]
    assert value == pytest.approx(RESTORING)
    assert error < 1e-6 * RESTORING


def test_equivalent_damping_is_that_of_the_slowest_eigenvalue():
    terms = {"b1": TRUTH["b1"], "c1": TRUTH["c1"]}
    path = simulate_memory_decay(TIME, (0.1, 0.0), terms, MEMORY, INERTIA)[:, 0]
    fit = fit_memory_decay(record(path), MEMORY, damping_model("linear"), **KNOWN)
    a, b, c = MEMORY.state_space()
    whole = np.zeros((4, 4))
    whole[0, 1] = 1.0
    whole[1] = [-terms["c1"], -terms["b1"], *(-c / INERTIA)]
    whole[2:, 1], whole[2:, 2:] = b, a
    eigenvalues = np.linalg.eigvals(whole)
    slow = eigenvalues[np.argmax(eigenvalues.real)]
    at = fit.equivalent(0.05)
    assert at.alpha[0] == pytest.approx(-slow.real, rel=2e-3)
    assert at.omega[0] == pytest.approx(abs(slow), rel=2e-3)
    assert fit.omega_n == pytest.approx(at.omega[0], rel=1e-9)
    assert fit.zeta == pytest.approx(float(at.zeta[0]), rel=1e-9)
    waves = MEMORY.damping(at.omega)[0]
    assert fit.radiation_share(0.05)[0] == pytest.approx(waves / (waves + terms["b1"] * INERTIA))
    # Without memory the same motion has all of it in b1.
    plain = fit_integration(record(path), damping_model("linear"))
    assert plain.equivalent(0.05).alpha[0] == pytest.approx(at.alpha[0], rel=2e-3)


def test_waves_from_before_the_free_part_are_in_the_memory():
    whole = record()
    cut = replace(record(CLEAN[90:], TIME[90:]), whole=whole)
    fit = fit_memory_decay(cut, MEMORY, inertia=INERTIA)
    assert dict(zip(fit.names, fit.params))["b1"] == pytest.approx(TRUTH["b1"], rel=1e-3)
    forgetful = fit_memory_decay(replace(cut, whole=None), MEMORY, inertia=INERTIA)
    assert abs(forgetful["b1"] / TRUTH["b1"] - 1.0) > 0.01


def test_repeats_share_the_terms():
    short = TIME[:500]
    second = simulate_memory_decay(short, (math.radians(4.0), 0.0), TRUTH, MEMORY, INERTIA)[:, 0] + 0.002
    fit = fit_memory_decay([record(), record(second, short)], MEMORY, inertia=INERTIA)
    assert fit["b2"] == pytest.approx(TRUTH["b2"], rel=1e-5)
    assert [run.offset for run in fit.runs] == pytest.approx([0.0, 0.002], abs=1e-7)


def test_table_and_dictionary_name_the_inertia():
    fit = fit_memory_decay(record(), MEMORY, inertia=INERTIA)
    assert isinstance(fit, MemoryDamping)
    table = fit.table().set_index("name")
    assert table.loc["inertia", "unit"] == "kg m2"
    assert table["model"].unique().tolist() == ["b1+b2, c1, memory of order 2"]
    assert fit.to_dict()["memory"]["denominator"] == [1.0, 0.6, 0.5]


def test_dimensional_damping_takes_the_inertia_at_the_frequency():
    ship = Ship("hull", 100.0, 20.0, 8.0, volume=9000.0, GM=1.0)
    fit = replace(fit_memory_decay(record(), MEMORY, inertia=INERTIA), ship=ship)
    at = fit.equivalent(0.1)
    inertia = INERTIA + MEMORY.added_mass_difference(at.omega)[0]
    frame = fit.dimensional(0.1)
    assert frame["B44 [N m s]"][0] == pytest.approx(2.0 * at.alpha[0] * inertia)
    with pytest.raises(FitError, match="its ship"):
        replace(fit, ship=None).dimensional(0.1)


@pytest.mark.parametrize("form", ["extinction", "in_degrees"])
def test_forms_without_memory_are_not_given(form):
    fit = fit_memory_decay(record(), MEMORY, inertia=INERTIA)
    with pytest.raises(FitError, match="memory"):
        getattr(fit, form)()
    with pytest.raises(FitError, match="not scaled"):
        fit.at_scale(2.0)


def test_record_of_another_motion_is_no_decay():
    wild = 0.1 * np.sin(0.3 * TIME) * (1.0 + np.sin(0.05 * TIME))
    with pytest.raises(FitError, match="does not explain"):
        fit_memory_decay(record(wild), MEMORY, **KNOWN)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"inertia": -1.0}, "not positive"),
        ({"model": damping_model(fixed={"c1": 0.1})}, "both the restoring"),
        ({"inertia": 1e4}, r"ask for an inertia I \+ A_inf of 8.002e\+10, 1e\+04 is given"),
    ],
)
def test_bad_requests_are_refused(change, message):
    with pytest.raises(FitError, match=message):
        fit_memory_decay(record(), MEMORY, **{**KNOWN, **change})
