import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.ship import Ship
from towtank.decay.equivalent_damping import (
    equivalent_linear,
    extinction_from_damping,
    lever_describing_function,
    nondimensional_factor,
    total_inertia,
)
from towtank.decay.restoring_curve import RestoringCurve

KVLCC2 = Ship("KVLCC2", 320.0, 58.0, 20.8, volume=312653.0, GM=5.73, rho=1000.0)


def test_formula_of_the_literature():
    amplitude = 0.25
    alpha, omega, _ = equivalent_linear(np.array([0.04, 0.15, 0.3, 0.36, 0.0, 0.0]), np.array([amplitude]))
    expected = 0.02 + 4.0 / (3.0 * math.pi) * 0.6 * amplitude * 0.15 + 0.375 * (0.6 * amplitude) ** 2 * 0.3
    assert alpha[0] == pytest.approx(expected, rel=1e-12)
    assert omega[0] == pytest.approx(0.6)


def test_energy_of_a_cycle_is_that_of_the_linear_damping():
    b, omega, amplitude = np.array([0.04, 0.15, 0.3]), 0.6, 0.3
    phase = np.linspace(0.0, 2.0 * np.pi, 20001)
    v = -amplitude * omega * np.sin(phase)
    moment = b[0] * v + b[1] * np.abs(v) * v + b[2] * v**3
    work = np.trapezoid(moment * v, phase / omega)
    alpha = equivalent_linear(np.array([*b, omega**2, 0.0, 0.0]), np.array([amplitude]))[0][0]
    assert work == pytest.approx(2.0 * alpha * np.trapezoid(v**2, phase / omega), rel=1e-6)


def test_gradient():
    c = np.array([0.04, 0.15, 0.3, 0.36, 0.1, -0.2])
    a = np.array([0.1, 0.3])
    gradient = equivalent_linear(c, a)[2]
    for k in range(6):
        step = np.zeros(6)
        step[k] = 1e-6
        numeric = (equivalent_linear(c + step, a)[0] - equivalent_linear(c - step, a)[0]) / 2e-6
        np.testing.assert_allclose(gradient[:, k], numeric, atol=1e-9)


def test_no_restoring_gives_nan():
    omega = equivalent_linear(np.array([0.1, 0.0, 0.0, 0.3, -10.0, 0.0]), np.array([0.5]))[1]
    assert np.isnan(omega[0])


def test_describing_function_of_a_cubic_lever():
    x = np.radians(np.arange(0.0, 61.0, 2.0))
    curve = RestoringCurve.from_levers(x, x - 0.2 * x**3)
    amplitude = np.array([0.0, 0.3, 0.8])
    np.testing.assert_allclose(lever_describing_function(curve, amplitude), 1.0 - 0.15 * amplitude**2, atol=1e-4)


def test_extinction_coefficients_of_the_literature():
    np.testing.assert_allclose(extinction_from_damping(0.04, 0.15, 0.3, 0.6), [0.10472, 0.2, 0.2121], atol=6e-5)


def test_inertia_and_factor():
    assert total_inertia(KVLCC2, 0.3) == pytest.approx(1000.0 * 312653.0 * 9.80665 * 5.73 / 0.09, rel=1e-3)
    assert total_inertia(KVLCC2, 0.3, inertia=5.0) == 5.0
    assert nondimensional_factor(KVLCC2) == pytest.approx(
        math.sqrt(58.0 / (2.0 * 9.80665)) / (1000.0 * 312653.0 * 58.0**2), rel=1e-3
    )
    with pytest.raises(FitError, match="has no GM"):
        total_inertia(Ship("x", 1.0, 1.0, 1.0, volume=1.0), 1.0)
    with pytest.raises(FitError, match="not positive"):
        total_inertia(KVLCC2, 0.3, inertia=-1.0)
