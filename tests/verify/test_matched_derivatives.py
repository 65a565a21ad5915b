"""Two sets in one convention."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError
from towtank.core.ship import Ship
from towtank.verify.matched_derivatives import match_derivatives

SHIP = Ship("model", L=4.0, B=0.6, T=0.25, mass=200.0, rho=1000.0)


def made(values, **choices):
    return DerivativeSet.from_values("made", SHIP, values, HOME.but(**choices))


def test_values_and_covariances_come_into_the_convention_of_the_first():
    covariance = np.array([[4.0, 1.0], [1.0, 9.0]]) * 1e-6
    a = replace(made({"Yv": -0.30, "Nv": -0.10}), covariance=covariance)
    matched = match_derivatives(a, a.to("prime"))
    np.testing.assert_allclose(matched.b, matched.a, rtol=1e-12)
    np.testing.assert_allclose(matched.b_covariance, covariance, rtol=1e-12)
    assert matched.turned_because == ""


def test_resistance_meets_the_longitudinal_force_with_its_sign():
    a = made({"R0": 0.02, "Yv": -0.3, "Nv": -0.1})
    b = replace(made({"Yv": -0.31, "X0": -0.022, "Yr": 0.05}), covariance=np.diag([1.0, 4.0, 9.0]) * 1e-6)
    b = replace(b, covariance=b.covariance + 1e-7 * (np.ones((3, 3)) - np.eye(3)))
    matched = match_derivatives(a, b)
    assert matched.names == ("R0", "Yv")
    assert matched.b.tolist() == [0.022, -0.31]
    np.testing.assert_allclose(matched.b_covariance, [[4e-6, -1e-7], [-1e-7, 1e-6]])
    assert np.isnan(matched.a_covariance).all()
    assert matched.only_a == ("Nv",)
    assert matched.only_b == ("Yr",)


def test_the_first_is_converted_when_the_second_cannot_be():
    a = made({"Yv": -0.3, "Yr": 0.05, "Yvdot": -0.1, "Xudot": -0.01})
    matched = match_derivatives(a, made({"Yv": -0.3, "Yr": 0.05, "Yvdot": -0.1}, added_mass_coriolis="inside"))
    assert matched.a[1] == pytest.approx(0.04)
    assert matched.turned_because


def test_strangers_are_refused():
    with pytest.raises(ConventionError, match="no derivative in common"):
        match_derivatives(made({"Yv": -0.3}), made({"Nv": -0.1}))
