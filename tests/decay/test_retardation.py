"""Impulse response of radiation: closed form, round trip, added mass, doubtful tables."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.retardation import (
    check_added_mass,
    coefficient_of_determination,
    cosine_integral,
    impulse_response,
    sine_integral,
)

P1, Q1, Q0, INFINITE = 3.0, 0.5, 0.7, 7.0
TIME = np.linspace(0.0, 50.0, 501)


def transfer(omega):
    s = 1j * np.asarray(omega)
    return P1 * s / (s**2 + Q1 * s + Q0)


def kernel(t):
    damped = math.sqrt(Q0 - Q1**2 / 4.0)
    return P1 * np.exp(-Q1 / 2.0 * t) * (np.cos(damped * t) - Q1 / (2.0 * damped) * np.sin(damped * t))


@pytest.fixture(scope="module")
def table():
    omega = np.linspace(0.1, 15.0, 150)
    return omega, transfer(omega).real, transfer(omega).imag / omega + INFINITE


@pytest.fixture(scope="module")
def response(table):
    return impulse_response(table[0], table[1], TIME)


def test_impulse_response_of_a_known_memory(response):
    assert np.abs(response.kernel - kernel(TIME)).max() < 5e-4 * P1
    assert response.tail_share == pytest.approx(2.0 / math.pi * Q1 / 15.0, rel=0.05)
    assert response.findings == ()
    assert list(response.to_frame().columns) == ["time", "kernel"]


def test_round_trip_from_damping_to_damping(table, response):
    assert np.abs(response.damping(table[0]) - table[1]).max() < 1e-3 * table[1].max()


def test_added_mass_follows_from_damping(table, response):
    check = check_added_mass(table[0], table[2], response)
    assert check.infinite == pytest.approx(INFINITE, abs=2e-3)
    assert check.spread < 2e-3
    assert check.r2 > 0.99999
    assert check.findings == ()


def test_added_mass_of_another_ship_is_noticed(table, response):
    check = check_added_mass(table[0], 2.0 * table[2], response)
    assert [finding.rule for finding in check.findings] == ["added-mass-disagrees"]
    assert check.r2 < 0.9


def test_short_table_is_flagged_and_its_tail_matters(table):
    omega, damping, _ = (column[:40] for column in table)
    short = impulse_response(omega, damping, TIME)
    cut = impulse_response(omega, damping, TIME, tail="none")
    assert [finding.rule for finding in short.findings] == ["radiation-table-short"]
    assert cut.tail_share == 0.0
    assert abs(short.kernel[0] - P1) < 0.3 * abs(cut.kernel[0] - P1)


def test_negative_damping_is_flagged(table):
    damping = table[1].copy()
    damping[30] = -0.1 * damping.max()
    rules = [finding.rule for finding in impulse_response(table[0], damping, TIME).findings]
    assert "radiation-not-passive" in rules


def test_kernel_that_has_not_died_is_flagged(table):
    rules = [finding.rule for finding in impulse_response(table[0], table[1], TIME[:41]).findings]
    assert rules == ["impulse-response-cut"]


def test_integrals_of_a_parabola_have_closed_forms():
    """Cubic splines are exact on it, at any product of frequency and length, without aliasing."""
    x = np.array([0.0, 0.7, 1.1, 2.0, 3.0])
    s = np.array([1e-6, 0.3, 7.0, 400.0])
    cosine = (9.0 * s**2 - 2.0) * np.sin(3.0 * s) / s**3 + 6.0 * np.cos(3.0 * s) / s**2
    sine = -((9.0 * s**2 - 2.0) * np.cos(3.0 * s) / s**3) + 6.0 * np.sin(3.0 * s) / s**2 - 2.0 / s**3
    assert cosine_integral(x, x**2, s)[1:] == pytest.approx(cosine[1:], abs=1e-12)
    assert sine_integral(x, x**2, s)[1:] == pytest.approx(sine[1:], abs=1e-12)
    assert cosine_integral(x, x**2, s)[0] == pytest.approx(9.0, abs=1e-9)


def test_constant_tables_have_a_determination():
    same = np.full(4, 2.0)
    assert coefficient_of_determination(same, same) == 1.0
    assert coefficient_of_determination(same, same + 1.0) == -math.inf


@pytest.mark.parametrize(
    ("omega", "damping", "message"),
    [
        ([0.1, 0.2], [1.0, 2.0], "three rows"),
        ([0.1, 0.3, 0.2], [1.0, 2.0, 3.0], "rise"),
        ([-0.1, 0.2, 0.3], [1.0, 2.0, 3.0], "rise"),
        ([0.1, 0.2, 0.3], [1.0, math.nan, 3.0], "finite"),
        ([0.1, 0.2, 0.3], [1.0, 2.0], "pair"),
    ],
)
def test_tables_that_are_none(omega, damping, message):
    with pytest.raises(FitError, match=message):
        impulse_response(np.array(omega), np.array(damping), TIME)


def test_times_and_tails_are_checked(table):
    with pytest.raises(FitError, match="uniform from zero"):
        impulse_response(table[0], table[1], TIME + 1.0)
    with pytest.raises(FitError, match="no tail"):
        impulse_response(table[0], table[1], TIME, tail="cubic")


def test_zero_frequency_has_no_added_mass_check(response):
    with pytest.raises(FitError, match="zero frequency"):
        check_added_mass(np.array([0.0, 1.0, 2.0]), np.ones(3), response)
