import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import DampingModel, damping_model, damping_words, split_speed_term, term_unit


def test_words_of_the_field():
    model = damping_model("linear+cubic", "quintic")
    assert model.names == ("b1", "b3", "c1", "c3", "c5")
    assert damping_model("b1+b2", "c1+c5").names == ("b1", "b2", "c1", "c5")
    assert damping_model().label == "b1+b2, c1"


def test_columns_are_the_terms_of_the_equation():
    x, v = np.array([0.1, -0.2]), np.array([0.5, -0.4])
    columns = damping_model("linear+quadratic+cubic", "quintic").columns(x, v)
    np.testing.assert_allclose(columns[1], [-0.4, -0.16, -0.064, -0.2, -0.008, -0.00032])


def test_speed_enters_as_a_power():
    model = damping_model(speed=["b1*U", "b2*U2"])
    np.testing.assert_allclose(model.spread(3.0) @ [1.0, 2.0, 5.0, 0.1, 0.01], [1.3, 2.09, 0.0, 5.0, 0.0, 0.0])
    columns = model.columns(np.array([0.1]), np.array([0.5]), 3.0)
    np.testing.assert_allclose(columns[0], [0.5, 0.25, 0.1, 1.5, 2.25])


@pytest.mark.parametrize(
    ("name", "motion", "unit"),
    [
        ("b1", "roll", "1/s"),
        ("b2", "roll", "1/rad"),
        ("b3", "roll", "s/rad2"),
        ("c3", "pitch", "1/(s2 rad2)"),
        ("c1", "heave", "1/s2"),
        ("b2", "heave", "1/m"),
        ("b1*U2", "roll", "1/s/(m/s)2"),
    ],
)
def test_units(name, motion, unit):
    assert term_unit(name, motion) == unit


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"damping": ("b1", "b1")}, "different"),
        ({"damping": ("b4",)}, "different"),
        ({"restoring": ("c3",)}, "needs the restoring term c1"),
        ({"speed": ("b3*U",)}, "no dependence"),
        ({"fixed": {"c5": 1.0}}, "fixed but no term"),
    ],
)
def test_bad_models_are_named(arguments, message):
    with pytest.raises(FitError, match=message):
        DampingModel(**arguments)


def test_bad_speed_term():
    with pytest.raises(FitError, match="no dependence on speed"):
        split_speed_term("b1*V")


def test_fixed_terms_are_not_free():
    model = damping_model(fixed={"c1": 0.36})
    assert model.free == ("b1", "b2")
    np.testing.assert_allclose(model.complete({"b1": 1.0, "b2": 2.0}), [1.0, 2.0, 0.36])
    with pytest.raises(FitError, match="b2 is not given"):
        model.complete({"b1": 1.0})
    assert model.with_fixed(b2=0.1).free == ("b1",)


@pytest.mark.parametrize("words", ["linear", "quadratic", "linear+cubic", "linear+quadratic+cubic"])
def test_damping_in_words(words):
    assert damping_words(damping_model(words)) == words
