"""Validation of derivatives."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import TowtankError
from towtank.core.ship import Ship
from towtank.datasets import load_set
from towtank.verify.derivative_validation import validate_derivatives

SHIP = Ship("model", L=4.0, B=0.6, T=0.25, mass=200.0, rho=1000.0)


def made(values, covariance=None, **choices):
    derivatives = DerivativeSet.from_values("made", SHIP, values, HOME.but(**choices))
    return derivatives if covariance is None else replace(derivatives, covariance=np.asarray(covariance))


DATA = made({"Yv": -0.30, "Nv": -0.10}, np.diag([0.01, 0.004]) ** 2)
COMPUTED = made({"Yv": -0.32, "Nv": -0.13}, np.diag([0.02, 0.003]) ** 2)


def test_the_covariances_give_the_uncertainties():
    frame = validate_derivatives(COMPUTED, DATA).set_index("quantity")
    assert frame.loc["Yv", "U_V"] == pytest.approx(2.0 * math.hypot(0.01, 0.02))
    assert frame.loc["Yv", "verdict"] == "validated"
    assert frame.loc["Nv", "verdict"] == "not validated"
    assert frame.loc["Nv", "model_error_low"] == pytest.approx(-0.03 - 0.01)
    assert frame["U_input"].tolist() == [0.0, 0.0]


def test_scales_of_forces_do_not_matter():
    plain, turned = validate_derivatives(COMPUTED, DATA), validate_derivatives(COMPUTED.to("prime"), DATA)
    np.testing.assert_allclose(turned["z"], plain["z"], rtol=1e-10)
    np.testing.assert_allclose(turned["S"], plain["S"], rtol=1e-12)


def test_numerical_uncertainty_stands_beside_the_fit():
    frame = validate_derivatives(COMPUTED, DATA, numerical={"Yv": 0.06}).set_index("quantity")
    assert frame.loc["Yv", "U_SN"] == 0.06
    assert frame.loc["Yv", "U_input"] == pytest.approx(0.04)
    assert frame.loc["Yv", "U_V"] == pytest.approx(math.sqrt(0.06**2 + 0.04**2 + 0.02**2))
    assert frame.loc["Nv", "verdict"] == "not judged"
    with pytest.raises(TowtankError, match="belong to no shared derivative"):
        validate_derivatives(COMPUTED, DATA, numerical={"Yr": 0.06})


def test_all_together_counts_correlated_derivatives_once():
    frame = validate_derivatives(COMPUTED, DATA)
    expected = 0.02**2 / 0.0005 + 0.03**2 / 2.5e-5
    assert frame.attrs["chi2"] == pytest.approx(expected)
    assert frame.attrs["degrees_of_freedom"] == 2
    # two copies of one measurement: one degree of freedom
    same = made({"Yv": -0.30, "Nv": -0.30}, 1e-4 * np.ones((2, 2)))
    other = made({"Yv": -0.32, "Nv": -0.32}, np.zeros((2, 2)))
    attrs = validate_derivatives(other, same).attrs
    assert attrs["degrees_of_freedom"] == 1
    assert attrs["chi2"] == pytest.approx(4.0)
    assert attrs["p_value"] == pytest.approx(0.0455, abs=1e-4)


def test_joint_probability_is_uniform_when_the_uncertainties_are_right():
    rng = np.random.default_rng(5)
    root = np.array([[0.01, 0.0, 0.0], [0.008, 0.003, 0.0], [0.1, 0.0, 0.2]])
    values = []
    for _ in range(200):
        drawn = np.array([-0.3, -0.1, 2.0]) + root @ rng.standard_normal(3)
        names = dict(zip(("Yv", "Nv", "Yvvv"), drawn.tolist(), strict=True))
        data = made(names, root @ root.T)
        exact = made({"Yv": -0.3, "Nv": -0.1, "Yvvv": 2.0}, np.zeros((3, 3)))
        values.append(validate_derivatives(exact, data).attrs["p_value"])
    inside = np.mean(np.array(values) > 0.05)
    assert 0.91 < inside < 0.985


def test_published_sets_without_uncertainty_are_not_judged():
    frame = validate_derivatives(load_set("dtc-drift-cfd-63"), load_set("dtc-drift-efd"))
    assert set(frame["verdict"]) == {"not judged"}
    assert frame.set_index("quantity").loc["Yv", "(S-D)/D [%]"] == pytest.approx(60.02, abs=0.01)
    assert math.isnan(frame.attrs["chi2"])


def test_data_that_had_to_be_converted_and_missing_fits_are_said():
    data = made({"Yv": -0.3, "Yr": 0.05, "Yvdot": -0.1, "Xudot": -0.01})
    computed = made({"Yv": -0.3, "Yr": 0.05, "Yvdot": -0.1}, added_mass_coriolis="inside")
    frame = validate_derivatives(computed, data, numerical={"Yv": 0.1})
    assert "data were converted" in frame.attrs["notes"][0]
    assert "scatter of its fit is counted as zero" in frame.attrs["notes"][1]
