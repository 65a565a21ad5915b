from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.lssvm_weights import suykens_weights


def test_weights_of_the_paper() -> None:
    # Median 0 and median absolute deviation 1, so that one deviation is 1.483.
    residual = np.array([-1.0, 1.0, -1.0, 1.0, 0.0, 0.0, 2.5 * 1.483, -2.75 * 1.483, 3.0 * 1.483, -40.0])
    assert np.median(residual) == 0.0
    assert np.median(np.abs(residual)) == 1.0
    np.testing.assert_allclose(suykens_weights(residual)[:6], 1.0)
    np.testing.assert_allclose(suykens_weights(residual)[6:], [1.0, 0.5, 1e-4, 1e-4], atol=1e-12)


def test_normal_errors_keep_their_weight_whatever_their_size() -> None:
    residual = np.random.default_rng(0).standard_normal(2000)
    weights = suykens_weights(residual)
    assert 0.97 < weights.mean() < 1.0
    np.testing.assert_allclose(suykens_weights(1e-9 * residual), weights)


def test_exact_fit_has_no_outliers() -> None:
    assert np.all(suykens_weights(np.zeros(5)) == 1.0)
    assert np.all(suykens_weights(np.array([0.0, 0.0, 0.0, 7.0])) == 1.0)


def test_misfit_is_not_taken_for_outliers() -> None:
    residual = np.concatenate([0.01 * np.random.default_rng(0).standard_normal(60), np.ones(20), -np.ones(20)])
    with pytest.raises(FitError, match="40 of 100 rows would count as outliers"):
        suykens_weights(residual)
