"""Fit of a decay with memory: closed loop with known and free inertia, noise, what cannot be identified."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.fluid_memory import simulate_memory_decay
from towtank.decay.memory_fit import fit_memory_decay
from towtank.decay.transfer_function import TransferFunction

INERTIA = 8e10
RESTORING = INERTIA * (2.0 * math.pi / 20.0) ** 2
MEMORY = TransferFunction(np.array([6e8, 0.0]), np.array([1.0, 0.6, 0.5]))
TRUTH = {"b1": 6e8 / INERTIA, "b2": 4e7 * 180.0 / math.pi / INERTIA, "c1": RESTORING / INERTIA}
TIME = np.arange(0.0, 200.0, 0.25)
CLEAN = simulate_memory_decay(TIME, (math.radians(7.0), 0.0), TRUTH, MEMORY, INERTIA)[:, 0]

KNOWN = {"inertia": INERTIA, "restoring": RESTORING}
FREE = {"inertia": 1.3 * INERTIA, "restoring": 1.2 * RESTORING, "free_inertia": True, "free_restoring": True}


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
    fit = fit_memory_decay(TIME, CLEAN, MEMORY, **options)
    assert fit.converged
    assert fit.coefficients() == pytest.approx(TRUTH, rel=1e-6)
    assert fit.inertia == pytest.approx(INERTIA, rel=1e-6)
    assert fit.dimensional()["b1"][0] == pytest.approx(6e8, rel=1e-6)
    assert fit.dimensional()["c1"][0] == pytest.approx(RESTORING, rel=1e-6)


@pytest.fixture(scope="module")
def noisy():
    return CLEAN + math.radians(0.05) * np.random.default_rng(1).standard_normal(TIME.size)


def test_intervals_of_a_noisy_record_hold_the_truth(noisy):
    fit = fit_memory_decay(TIME, noisy, MEMORY, inertia=INERTIA)
    for name, value in TRUTH.items():
        low, high = fit.conf_int(0.99)[fit.position(name)]
        assert low < value < high
        assert fit.bse[fit.position(name)] > 0.0
    assert fit.bse[fit.position("inertia")] == 0.0
    assert fit.r2 > 0.999
    # The two damping terms trade against each other; their sum at an amplitude does not.
    assert fit.correlation[0, 1] < -0.9
    at = fit.equivalent(math.radians(5.0))
    assert at["alpha_sd"][0] / at["alpha"][0] < 0.2 * fit.bse[1] / abs(fit.params[1])


def test_free_inertia_is_said_not_to_be_identified(noisy):
    fit = fit_memory_decay(TIME, noisy, MEMORY, **FREE)
    assert ("not-identified", "inertia") in [(finding.rule, finding.place) for finding in fit.findings]


def test_restoring_that_is_known_moves_with_the_inertia(noisy):
    fit = fit_memory_decay(TIME, noisy, MEMORY, inertia=0.9 * INERTIA, restoring=RESTORING, free_inertia=True)
    c1, last = fit.position("c1"), fit.position("inertia")
    assert fit["c1"] * fit.inertia == pytest.approx(RESTORING)
    assert fit.correlation[c1, last] == pytest.approx(-1.0)
    value, error = fit.dimensional()["c1"]
    assert value == pytest.approx(RESTORING)
    assert error < 1e-6 * RESTORING


def test_equivalent_damping_is_that_of_the_slowest_eigenvalue():
    terms = {"b1": TRUTH["b1"], "c1": TRUTH["c1"]}
    path = simulate_memory_decay(TIME, (0.1, 0.0), terms, MEMORY, INERTIA)[:, 0]
    fit = fit_memory_decay(TIME, path, MEMORY, terms=("b1",), **KNOWN)
    a, b, c = MEMORY.state_space()
    whole = np.zeros((4, 4))
    whole[0, 1] = 1.0
    whole[1] = [-terms["c1"], -terms["b1"], *(-c / INERTIA)]
    whole[2:, 1], whole[2:, 2:] = b, a
    eigenvalues = np.linalg.eigvals(whole)
    slow = eigenvalues[np.argmax(eigenvalues.real)]
    at = fit.equivalent(0.05)
    assert at["alpha"][0] == pytest.approx(-slow.real, rel=2e-3)
    assert at["omega"][0] == pytest.approx(abs(slow), rel=2e-3)
    waves = MEMORY.damping(at["omega"])[0]
    assert at["radiation"][0] == pytest.approx(waves / (waves + terms["b1"] * INERTIA))


def test_record_of_another_motion_is_flagged():
    wild = 0.1 * np.sin(0.3 * TIME) * (1.0 + np.sin(0.05 * TIME))
    fit = fit_memory_decay(TIME, wild, MEMORY, **KNOWN)
    assert "fit-poor" in [finding.rule for finding in fit.findings]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"terms": ("b1", "c1")}, "no free term"),
        ({"inertia": -1.0}, "not positive"),
        ({"angle": np.abs(CLEAN) + 0.1}, "two cycles"),
        ({"angle": CLEAN[:-1]}, "do not pair"),
        ({"angle": np.where(TIME == 5.0, math.nan, CLEAN)}, "not finite"),
    ],
)
def test_bad_requests_are_refused(change, message):
    arguments = {"time": TIME, "angle": CLEAN, "memory": MEMORY, **KNOWN, **change}
    with pytest.raises(FitError, match=message):
        fit_memory_decay(**arguments)
