import numpy as np
import pytest

from towtank.decay.fit_diagnostics import FittedRun
from towtank.decay.integration_fit import fit_integration


def test_residual_is_measured_less_fitted():
    run = FittedRun("a", np.arange(2.0), np.array([0.3, 0.1]), np.array([0.2, 0.2]), (0.2, 0.0))
    np.testing.assert_allclose(run.residual, [0.1, -0.1])


def test_diagnostics_of_a_fit(make_decay):
    record = make_decay((0.04, 0.25, 0.0, 0.36, 0.0, 0.0), noise=0.2, seed=1)
    fit = fit_integration(record).diagnostics
    assert fit.samples == len(record)
    assert fit.half_cycles == record.extremes.half_swing.size
    assert fit.noise == pytest.approx(np.radians(0.2), rel=0.25)
    # (1 + 0.9)/(1 - 0.9) = 19 samples of 0.1 s
    assert fit.noise_time == pytest.approx(1.9, rel=0.5)
    assert fit.amplitudes[0] < fit.amplitudes[1] < np.radians(25.0)
