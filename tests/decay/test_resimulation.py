import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import damping_model
from towtank.decay.resimulation import explained, first_values, resimulate, simulate_record

MODEL = damping_model("linear+quadratic+cubic")


def test_initial_values_and_offset_are_found(make_decay, literature):
    record = make_decay(literature, offset=0.01)
    run, simulated = resimulate(record, MODEL, np.array(literature))
    assert run.start == (pytest.approx(np.radians(25.0), abs=1e-8), pytest.approx(0.0, abs=1e-8))
    assert run.offset == pytest.approx(0.01, abs=1e-8)
    np.testing.assert_allclose(simulated.value, record.value, atol=1e-8)
    assert explained([run]) == pytest.approx(1.0)


def test_wrong_coefficients_leave_residuals(make_decay, literature):
    wrong = np.array(literature)
    wrong[3] *= 1.2
    run, _ = resimulate(make_decay(literature), MODEL, wrong)
    assert 0.0 < explained([run]) < 0.9
    assert np.abs(run.residual).max() > 0.02


def test_measured_start_is_not_fitted(make_decay, literature):
    record = make_decay(literature, noise=0.5, seed=1)
    run, _ = resimulate(record, MODEL, np.array(literature), start="measured", offset=False)
    assert run.start == pytest.approx(first_values(record))
    assert run.offset == 0.0


def test_gradient_by_start_and_offset(make_decay, literature):
    record = make_decay(literature)
    values = np.array(literature)
    base = simulate_record(record, MODEL, values, (0.4, 0.01), 0.02)
    moved = simulate_record(record, MODEL, values, (0.4, 0.01 + 1e-6), 0.02)
    np.testing.assert_allclose((moved.value - base.value) / 1e-6, base.gradient[:, 7], atol=1e-6)
    assert (base.gradient[:, 8] == 1.0).all()
    np.testing.assert_allclose(base.value - base.motion, 0.02)


def test_divergence(make_decay, literature):
    record = make_decay(literature)
    unstable = np.array([-1.0, 0.0, 0.0, 0.36, 0.0, 0.0])
    assert simulate_record(record, MODEL, unstable, (0.4, 0.0)) is None
    with pytest.raises(FitError, match="diverges"):
        resimulate(record, MODEL, unstable)
