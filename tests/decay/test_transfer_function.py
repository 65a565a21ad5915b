"""Rational radiation memory: closed loop, order, added mass at infinity, stability, bad tables."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.retardation import impulse_response
from towtank.decay.transfer_function import TransferFunction, fit_transfer_function, memory_of_damping

OMEGA = np.linspace(0.06, 2.7, 50)
SECOND = TransferFunction(np.array([3e8, 0.0]), np.array([1.0, 0.5, 0.7]))
FOURTH = TransferFunction(
    np.array([2.0, 2.2, 1.2, 0.0]), np.poly([-0.3 + 0.8j, -0.3 - 0.8j, -0.5 + 1.4j, -0.5 - 1.4j]).real
)


def table(function, infinite):
    return OMEGA, function.damping(OMEGA), infinite + function.added_mass_difference(OMEGA)


@pytest.mark.parametrize("infinite", [5e9, None])
def test_closed_loop_is_exact_at_order_two(infinite):
    fit = fit_transfer_function(*table(SECOND, 5e9), infinite=infinite)
    assert fit.order == 2
    assert fit.function.numerator == pytest.approx(SECOND.numerator, rel=1e-12)
    assert fit.function.denominator == pytest.approx(SECOND.denominator, rel=1e-12)
    assert fit.infinite == pytest.approx(5e9, rel=1e-12)
    assert fit.r2_damping > 1.0 - 1e-14
    assert fit.findings == ()


@pytest.mark.parametrize("infinite", [5.0, None])
def test_order_is_raised_until_both_tables_are_explained(infinite):
    fit = fit_transfer_function(*table(FOURTH, 5.0), infinite=infinite)
    assert fit.tried["order"].tolist() == [2, 3, 4]
    assert (fit.tried[["r2_damping", "r2_added_mass"]].min(axis=1).to_numpy()[:2] < 0.99).all()
    assert fit.function.denominator == pytest.approx(FOURTH.denominator, rel=1e-8)
    assert fit.added_mass(OMEGA) == pytest.approx(5.0 + FOURTH.added_mass_difference(OMEGA), rel=1e-8)


def test_a_memory_that_is_not_rational_is_approached():
    """B = w^4 exp(-w^2) has no finite order; its added mass comes from its impulse response."""
    omega = np.linspace(0.02, 6.0, 200)
    damping = 50.0 * omega**4 * np.exp(-3.1 * omega**2)
    time = np.linspace(0.0, 60.0, 401)
    response = impulse_response(omega, damping, time, tail="none")
    fit = fit_transfer_function(omega, damping, 4.0 + response.added_mass_difference(omega), infinite=4.0)
    assert fit.order > 2
    assert min(fit.r2_damping, fit.r2_added_mass) >= 0.99
    assert fit.function.stable
    assert fit.function.impulse_response(time) == pytest.approx(
        response.kernel, abs=0.04 * np.abs(response.kernel).max()
    )


def test_damping_alone_gives_the_memory():
    omega = np.linspace(0.05, 12.0, 240)
    fit = memory_of_damping(omega, SECOND.damping(omega))
    assert fit.order == 2
    assert fit.infinite == 0.0
    assert fit.function.numerator[0] == pytest.approx(3e8, rel=0.01)
    assert fit.function.denominator == pytest.approx(SECOND.denominator, rel=0.01)


def test_short_table_of_damping_alone_is_flagged():
    fit = memory_of_damping(OMEGA, SECOND.damping(OMEGA))
    assert "radiation-table-short" in [finding.rule for finding in fit.findings]


def test_tables_with_scatter_give_a_stable_memory():
    rng = np.random.default_rng(4)
    omega, damping, mass = table(FOURTH, 5.0)
    fit = fit_transfer_function(
        omega, damping + 0.02 * rng.standard_normal(50), mass + 0.02 * rng.standard_normal(50), order=6
    )
    assert fit.function.stable
    assert fit.r2_damping > 0.98


def test_growing_poles_are_mirrored():
    growing = TransferFunction(np.array([1.0, 0.0]), np.array([1.0, -0.5, 0.7]))
    assert not growing.stable
    fit = fit_transfer_function(*table(growing, 0.0), infinite=0.0, order=2)
    assert fit.function.stable
    assert fit.function.poles.real == pytest.approx(-growing.poles.real)


def test_unexplained_tables_are_a_finding():
    rng = np.random.default_rng(5)
    fit = fit_transfer_function(
        OMEGA, np.abs(rng.standard_normal(50)), rng.standard_normal(50), infinite=0.0, highest_order=3
    )
    assert "memory-not-explained" in [finding.rule for finding in fit.findings]
    assert len(fit.tried) == 2


def test_negative_damping_of_a_fit_is_a_finding():
    bad = TransferFunction(np.array([-1.0, 0.0]), np.array([1.0, 0.5, 0.7]))
    fit = fit_transfer_function(*table(bad, 0.0), infinite=0.0, order=2)
    assert [finding.rule for finding in fit.findings] == ["radiation-not-passive"]


def test_impulse_response_belongs_to_the_damping():
    time = np.linspace(0.0, 60.0, 1201)
    omega = np.linspace(0.05, 20.0, 300)
    response = impulse_response(omega, FOURTH.damping(omega), time)
    assert FOURTH.impulse_response(time) == pytest.approx(response.kernel, abs=2e-3)


def test_state_space_is_the_same_function():
    a, b, c = FOURTH.state_space()
    at = np.array([c @ np.linalg.solve(1j * w * np.eye(4) - a, b) for w in OMEGA])
    assert at == pytest.approx(FOURTH(OMEGA))


def test_added_mass_at_rest_is_the_limit():
    assert SECOND.added_mass_difference(np.zeros(1))[0] == pytest.approx(3e8 / 0.7)
    assert SECOND.added_mass_difference(np.array([1e-6]))[0] == pytest.approx(3e8 / 0.7)


@pytest.mark.parametrize(
    ("above", "below"), [([1.0], [1.0, 1.0]), ([1.0, 0.0], [2.0, 1.0, 1.0]), ([1.0, 0.0], [1.0, 1.0])]
)
def test_what_is_no_memory_is_refused(above, below):
    with pytest.raises(FitError, match="order n >= 2"):
        TransferFunction(np.array(above), np.array(below))


def test_bad_requests_are_refused():
    omega, damping, mass = table(SECOND, 5e9)
    with pytest.raises(FitError, match="order 1"):
        fit_transfer_function(omega, damping, mass, order=1)
    with pytest.raises(FitError, match="zero frequency"):
        fit_transfer_function(omega - omega[0], damping, mass)
    with pytest.raises(FitError, match="cannot determine"):
        fit_transfer_function(omega[:4], damping[:4], mass[:4], order=5)
