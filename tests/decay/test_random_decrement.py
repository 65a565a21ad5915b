"""Random decrement: a ship in white noise, its standard errors, and excitations that it cannot stand."""

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.signal import lfilter

from towtank.core.errors import FitError
from towtank.decay.random_decrement import damping_by_level, random_decrement

OMEGA, ZETA, STEP = 0.6, 0.05, 0.2


def response(seed, size=40_000):
    """Linear roll under white noise as an exact recursion of second order."""
    a = np.array([[0.0, 1.0], [-(OMEGA**2), -2.0 * ZETA * OMEGA]])
    e = expm(a * STEP)
    kicks = 0.01 * np.random.default_rng(seed).standard_normal(size)
    return STEP * np.arange(size), lfilter([0.0, e[0, 1]], [1.0, -np.trace(e), np.linalg.det(e)], kicks)


@pytest.fixture(scope="module")
def found():
    return random_decrement(*response(1))


def test_damping_and_frequency_come_back_within_their_errors(found):
    assert abs(found.zeta - ZETA) < 3.0 * found.zeta_sd
    assert abs(found.omega - OMEGA) < 3.0 * found.omega_sd
    assert found.zeta_sd < 0.2 * ZETA
    assert found.alpha == pytest.approx(found.zeta * found.omega)
    assert found.findings == ()


def test_signature_starts_at_its_level_at_rest(found):
    _, x = response(1)
    assert found.level == pytest.approx(math.sqrt(2.0) * x.std())
    assert found.signature[0] == pytest.approx(found.level, rel=0.1)
    slope = (found.signature[1] - found.signature[0]) / STEP
    assert abs(slope) < 0.15 * found.level * OMEGA
    assert found.error.shape == found.signature.shape
    assert (found.error[1:] > 0.0).all()


def test_standard_errors_are_those_of_repeated_records():
    results = [random_decrement(*response(seed, 12_000)) for seed in range(20)]
    scatter = np.std([one.zeta for one in results], ddof=1)
    told = np.sqrt(np.mean([one.zeta_sd**2 for one in results]))
    assert 0.6 < told / scatter < 1.7


def test_levels_of_a_linear_ship_agree():
    time, x = response(2)
    table = damping_by_level(time, x, np.std(x) * np.array([0.8, 1.2, 1.6]))
    assert list(table.columns) == ["level_deg", "pieces", "omega", "omega_sd", "zeta", "zeta_sd", "alpha"]
    assert (np.abs(table["zeta"] - ZETA) < 3.0 * table["zeta_sd"]).all()
    assert table["pieces"].is_monotonic_decreasing


def test_excitation_with_a_line_is_flagged():
    time = np.arange(0.0, 4000.0, STEP)
    line = 0.1 * np.sin(0.62 * time) + 0.001 * np.random.default_rng(1).standard_normal(time.size)
    found = random_decrement(time, line)
    assert found.zeta < 0.01
    assert "signature-grows" in [finding.rule for finding in found.findings] or found.zeta < 1e-3


def test_short_record_is_flagged():
    time, x = response(3)
    found = random_decrement(time[:1500], x[:1500])
    assert "few-pieces" in [finding.rule for finding in found.findings]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"level": 10.0}, "pieces of the record begin"),
        ({"level": -0.1}, "not positive"),
        ({"angle": np.linspace(0.0, 1.0, 300)}, "no roll cycles"),
        ({"time": np.cumsum(np.linspace(0.1, 0.3, 300))}, "uniform"),
        ({"angle": np.full(300, math.nan)}, "not finite"),
    ],
)
def test_bad_requests_are_refused(change, message):
    time, x = response(4, 300)
    with pytest.raises(FitError, match=message):
        random_decrement(**{"time": time, "angle": x, **change})
