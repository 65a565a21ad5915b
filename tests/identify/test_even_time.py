from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.even_time import MOST_SAMPLES, even_record


def test_an_even_record_is_left_alone() -> None:
    t = np.round(0.1 * np.arange(100) + 5.0, 4)
    x = np.arange(200.0).reshape(100, 2)
    result = even_record(t, x)
    assert not result.interpolated
    assert result.channels is x


def test_the_mean_is_that_over_time_not_over_samples() -> None:
    # Small steps while the force is high: the mean over samples is far off.
    t = np.concatenate([np.arange(0.0, 10.0, 0.1), np.arange(10.0, 11.0, 0.01)])
    x = np.where(t < 10.0, 1.0, 5.0)[:, None]
    result = even_record(t, x)
    assert result.interpolated
    np.testing.assert_allclose(np.diff(result.time), result.time[1] - result.time[0])
    assert result.channels.mean() == pytest.approx((10.0 * 1.0 + 1.0 * 5.0) / 11.0, abs=0.05)
    assert x.mean() == pytest.approx(3.0)


def test_tiny_steps_do_not_make_an_endless_grid() -> None:
    t = np.concatenate([1e-9 * np.arange(60), np.linspace(1.0, 100.0, 50)])
    assert even_record(t, t[:, None]).time.size <= MOST_SAMPLES + 1


def test_repeated_time_is_refused() -> None:
    with pytest.raises(FitError, match="does not increase"):
        even_record(np.array([0.0, 1.0, 1.0]), np.zeros((3, 1)))
