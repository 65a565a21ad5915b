import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.compare import METHODS, compare_methods, fit_decay
from towtank.decay.damping_models import damping_model
from towtank.decay.equivalent_damping import equivalent_linear

QUADRATIC = (0.04, 0.2, 0.0, 0.36, 0.0, 0.0)


@pytest.fixture(scope="module")
def comparison(make_decay):
    return compare_methods(make_decay(QUADRATIC, noise=0.05))


def test_all_methods_stand_in_one_table(comparison):
    table = comparison.table()
    assert comparison.failures == {}
    assert set(table["method"]) == set(METHODS)
    assert list(table.columns) == ["method", "model", "name", "value", "std", "lower95", "upper95", "unit"]
    assert (table["std"] > 0.0).all()


def test_all_methods_agree_on_the_equivalent_damping(comparison):
    amplitude = np.array([0.15])
    true = equivalent_linear(np.array(QUADRATIC), amplitude)[0][0]
    for method, at in comparison.equivalent(amplitude).items():
        tolerance = 0.25 if METHODS[method].linear_only else 0.05
        assert at.alpha[0] == pytest.approx(true, rel=tolerance), method


def test_summary_and_equivalent_table(comparison):
    assert comparison.summary()["R2"].min() > 0.99
    frame = comparison.equivalent_table()
    assert len(frame) == 25 * len(METHODS)
    assert frame["inside the record"].all()


def test_a_method_that_fails_is_listed_with_its_reason(make_decay):
    record = make_decay(QUADRATIC, duration=12.0)
    result = compare_methods(
        record,
        damping_model("linear+quadratic+cubic", "quintic"),
        methods=["extinction curve", "integration"],
    )
    assert "turning point" in result.failures["extinction curve"]
    with pytest.raises(FitError, match="turning point"):
        result["extinction curve"]
    assert "integration" in result.results


def test_options_reach_their_method(make_decay):
    result = compare_methods(
        make_decay(QUADRATIC), methods=["integration"], options={"integration": {"starts": 1}}
    )
    assert result["integration"].diagnostics.details["starts"] == 1


def test_unknown_and_impossible(make_decay):
    with pytest.raises(FitError, match="method 'guess' is unknown"):
        fit_decay(make_decay(QUADRATIC), method="guess")
    with pytest.raises(FitError, match="no method could fit"):
        compare_methods(
            make_decay(QUADRATIC, duration=14.0),
            damping_model("linear+quadratic+cubic", "quintic"),
            methods=["extinction curve"],
        )
