"""Distributions of uncertain inputs."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.verify.input_distribution import UncertainInput, check_inputs, parse_input

FAMILIES = [
    ("normal", (62.35, 0.64), 62.35, 0.64),
    ("uniform", (1.0, 4.0), 2.5, 3.0 / np.sqrt(12.0)),
    ("gamma", (2.5, 1.5), 3.75, 1.5 * np.sqrt(2.5)),
    ("gamma", (2.5, 1.5, -2.0), 1.75, 1.5 * np.sqrt(2.5)),
    ("beta", (2.0, 3.0, -1.0, 4.0), 1.0, 5.0 * np.sqrt(6.0 / (25.0 * 6.0))),
]


@pytest.mark.parametrize(("family", "parameters", "mean", "sd"), FAMILIES)
def test_mean_and_sd_are_those_of_the_textbook(family, parameters, mean, sd):
    one = UncertainInput("x", family, parameters)
    assert one.mean == pytest.approx(mean, rel=1e-12)
    assert one.sd == pytest.approx(sd, rel=1e-12)


@pytest.mark.parametrize(("family", "parameters", "mean", "sd"), FAMILIES)
def test_germ_value_quantile_and_probability_agree(family, parameters, mean, sd):
    one = UncertainInput("x", family, parameters)
    at = np.linspace(0.05, 0.95, 7)
    x = one.quantile(at)
    np.testing.assert_allclose(one.probability(x), at, rtol=1e-10)
    np.testing.assert_allclose(one.value(one.germ(x)), x, rtol=1e-12)
    assert np.all(np.diff(x) > 0)


def test_polynomials_are_those_of_the_askey_scheme():
    names = [UncertainInput("x", family, parameters).polynomial for family, parameters, _, _ in FAMILIES]
    assert names == ["Hermite", "Legendre", "Laguerre", "Laguerre", "Jacobi"]


def test_an_input_is_read_as_it_is_written():
    one = parse_input(" wave height = Normal( 62.35 , 0.64 )")
    assert one == UncertainInput("wave height", "normal", (62.35, 0.64))
    assert str(one) == "normal(62.35, 0.64)"
    assert parse_input("g=gamma(2,3)").parameters == (2.0, 3.0, 0.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("height", "is not an input with its distribution"),
        ("h=normal(1, x)", "are not numbers"),
        ("h=cauchy(0, 1)", "unknown distribution 'cauchy'"),
        ("h=normal(1)", "normal needs 2 finite numbers"),
        ("h=normal(1, 0)", "no positive spread"),
        ("h=normal(1, -2)", "no positive spread"),
        ("h=uniform(2, 1)", "no positive spread"),
        ("h=beta(0, 1, 0, 1)", "no positive spread"),
        ("h=normal(nan, 1)", "finite numbers"),
    ],
)
def test_what_is_no_distribution_is_named(text, message):
    with pytest.raises(TowtankError, match=message):
        parse_input(text)


def test_samples_outside_the_distribution_are_refused():
    one = UncertainInput("speed", "uniform", (1.0, 2.0))
    with pytest.raises(TowtankError, match=r"speed = 2.5 cannot come from uniform\(1, 2\)"):
        one.germ([1.5, 2.5])
    with pytest.raises(TowtankError, match="speed = nan"):
        one.germ([np.nan])
    assert one.germ([1.0, 2.0]).tolist() == [-1.0, 1.0]


def test_no_input_and_a_repeated_one_are_refused():
    with pytest.raises(TowtankError, match="no uncertain input"):
        check_inputs(())
    one = UncertainInput("speed", "uniform", (1.0, 2.0))
    with pytest.raises(TowtankError, match="speed is given twice"):
        check_inputs((one, one))
