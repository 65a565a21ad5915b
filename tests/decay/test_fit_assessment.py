import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import damping_model
from towtank.decay.extinction_curve import fit_extinction_curve
from towtank.decay.fit_assessment import as_records, assess_influences
from towtank.decay.integration_fit import fit_integration


def outcome(record, values, **changes):
    influence = np.zeros((3, len(record)))
    return assess_influences(
        "trial", [record], damping_model(), values, [influence], again=lambda clean: changes.get("again", values)
    )


def test_what_does_not_explain_the_record_raises(make_decay, literature):
    record = make_decay(literature)
    with pytest.raises(FitError, match="does not explain the record: R2"):
        outcome(record, {"b1": 0.04, "b2": 0.15, "c1": 1.0})
    with pytest.raises(FitError, match="does not restore"):
        outcome(record, {"b1": 0.04, "b2": 0.15, "c1": -0.36})


def test_a_poor_fit_is_flagged(make_decay, literature):
    result = outcome(make_decay(literature), {"b1": 0.04, "b2": 0.15, "c1": 0.33})
    assert "poor-fit" in [item.rule for item in result.findings]
    assert not result.trusted


def test_negative_damping_is_flagged(make_decay, literature):
    result = outcome(make_decay(literature), {"b1": -0.05, "b2": 0.8, "c1": 0.36})
    assert "negative-damping" in [item.rule for item in result.findings]


def test_bias_of_the_method_is_flagged(make_decay, literature):
    values = {"b1": 0.04, "b2": 0.2, "c1": 0.36}
    result = outcome(make_decay(literature), values, again={**values, "b1": 0.05})
    assert "method-bias" in [item.rule for item in result.findings]
    assert result.diagnostics.details["bias of the method"]["b1"] == pytest.approx(0.01)


def test_a_set_of_coefficients_that_misses_the_motion_is_flagged(make_decay):
    """A phase that runs away by more than the same terms need: told, though R2 would pass."""
    coefficients = (0.04, 0.2, 0.0, 0.36, 0.0, 0.0)
    record = make_decay(coefficients, noise=0.1)
    off = outcome(record, {"b1": 0.04, "b2": 0.2, "c1": 0.365})
    assert off.diagnostics.r2 > 0.95
    (said,) = [item for item in off.findings if item.rule == "motion-missed"]
    assert "times as far from the record" in said.message
    assert not off.trusted
    right = outcome(record, {"b1": 0.04, "b2": 0.2, "c1": 0.36})
    assert "motion-missed" not in [item.rule for item in right.findings]


def test_a_motion_that_is_good_enough_is_not_missed(make_decay):
    record = make_decay((0.04, 0.2, 0.0, 0.36, 0.0, 0.0))
    near = outcome(record, {"b1": 0.04, "b2": 0.2, "c1": 0.3602})
    assert near.diagnostics.r2 > 0.999
    assert "motion-missed" not in [item.rule for item in near.findings]


def test_few_cycles_are_flagged(make_decay, literature):
    result = fit_integration(make_decay(literature, duration=24.0))
    assert "few-cycles" in [item.rule for item in result.findings]


def test_provenance_names_file_and_choices(make_decay, literature):
    result = fit_extinction_curve(make_decay(literature))
    assert result.provenance.choices["method"] == "extinction curve"
    assert result.provenance.choices["conventions"] == result.conventions
    assert "run 0" in result.provenance.choices["records"]
    assert result.provenance.versions["numpy"]


def test_no_record():
    with pytest.raises(FitError, match="no decay record"):
        as_records([])
