import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import damping_model
from towtank.decay.energy_method import fit_energy_method
from towtank.decay.restoring_curve import RestoringCurve
from towtank.decay.virtual_decay import demo_plan, virtual_decay


@pytest.mark.parametrize("b1", [0.02, 0.06, 0.15])
def test_holds_at_any_level_of_damping(make_decay, b1):
    record = make_decay((b1, 0.2, 0.0, 0.36, 0.0, 0.0), step=0.05, duration=50.0)
    result = fit_energy_method(record)
    np.testing.assert_allclose(result.values, [b1, 0.2, 0.36], rtol=0.03)
    assert result.equivalent(0.15).alpha[0] == pytest.approx(
        0.5 * b1 + 4.0 / (3.0 * np.pi) * 0.6 * 0.15 * 0.2, rel=2e-3
    )


def test_offset_is_fitted(make_decay):
    record = make_decay((0.04, 0.2, 0.0, 0.36, 0.0, 0.0), step=0.05, offset=0.02)
    np.testing.assert_allclose(fit_energy_method(record).values, [0.04, 0.2, 0.36], rtol=0.02)


def test_nonlinear_restoring(make_decay):
    record = make_decay((0.05, 0.0, 0.0, 0.36, -0.3, 0.0), step=0.05, degrees=30.0)
    result = fit_energy_method(record, damping_model("linear", "cubic"))
    np.testing.assert_allclose(result.values, [0.05, 0.36, -0.3], rtol=0.03)


def test_lever_curve(make_decay):
    angle = np.radians(np.arange(0.0, 61.0, 5.0))
    # Nearly straight levers: the same decay as linear restoring.
    curve = RestoringCurve.from_levers(angle, angle)
    record = make_decay((0.05, 0.0, 0.0, 0.36, 0.0, 0.0), step=0.05)
    result = fit_energy_method(record, damping_model("linear", curve=curve))
    np.testing.assert_allclose(result.values, [0.05, 0.36], rtol=2e-3)


def test_too_short(make_decay, literature):
    with pytest.raises(FitError):
        fit_energy_method(make_decay(literature, duration=8.0))


def test_noisy_velocities_are_told():
    """The shipped record: honest errors, but a set of coefficients that does not reproduce the motion."""
    record = virtual_decay(demo_plan()).record.free_part().centred("drift")
    result = fit_energy_method(record)
    assert "motion-missed" in [item.rule for item in result.findings]
    assert not result.trusted
    low, high = result.conf_int()[result.position("b1")]
    assert low < 0.0042 < high
