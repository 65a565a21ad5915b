"""Split into steady and unsteady part."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.steady_unsteady import split_steady

TIME = np.arange(0.0, 300.0, 0.5)


def test_both_parts_make_the_whole_and_the_ends_stay_open():
    values = np.sin(0.3 * TIME) + 0.01 * TIME
    steady, unsteady = split_steady(TIME, values)
    inside = (TIME >= 30.0) & (TIME[-1] >= TIME + 30.0)
    np.testing.assert_array_equal(np.isfinite(steady), inside)
    np.testing.assert_allclose((steady + unsteady)[inside], values[inside])


def test_a_line_is_its_own_mean_and_whole_periods_vanish():
    steady, _ = split_steady(TIME, 2.0 + 0.01 * TIME + 0.3 * np.sin(2.0 * np.pi * TIME / 12.0))
    inside = np.isfinite(steady)
    np.testing.assert_allclose(steady[inside], 2.0 + 0.01 * TIME[inside], atol=1e-6)


def test_uneven_steps_are_weighed_by_their_length():
    time = np.sort(np.concatenate([TIME, TIME[200:260] + 0.25]))
    steady, _ = split_steady(time, np.where(time < 150.0, 0.0, (time - 150.0) / 10.0), 60.0)
    at = np.searchsorted(time, 160.0)
    # the mean of max(0, t - 150)/10 from 130 to 190 s is 40^2/2/10/60
    assert steady[at] == pytest.approx(1600.0 / 20.0 / 60.0, rel=1e-3)


def test_no_mean_across_a_gap_or_a_missing_value():
    kept = (TIME < 140.0) | (TIME > 150.0)
    steady, _ = split_steady(TIME[kept], TIME[kept])
    blind = (TIME[kept] > 109.5) & (TIME[kept] < 180.5)
    assert np.isnan(steady[blind]).all()
    assert np.isfinite(steady[~blind & (TIME[kept] > 31.0) & (TIME[kept] < 268.0)]).all()
    values = np.column_stack([TIME, TIME])
    values[300, 1] = np.nan
    steady, _ = split_steady(TIME, values)
    assert np.isfinite(steady[300, 0])
    assert np.isnan(steady[245:355, 1]).all()


@pytest.mark.parametrize(
    ("time", "window", "said"),
    [
        (TIME[:100], 60.0, "a record of 49.5 s holds no mean over 60 s"),
        (TIME[::-1], 60.0, "does not increase"),
        (TIME, 3.0, "holds less than 10 samples"),
        (TIME[:2], 60.0, "holds no mean"),
        (TIME, -1.0, "holds no mean"),
    ],
)
def test_what_cannot_be_split_is_named(time, window, said):
    with pytest.raises(FitError, match=said):
        split_steady(time, time, window)


def test_values_and_times_belong_together():
    with pytest.raises(FitError, match="10 values for 600 times"):
        split_steady(TIME, TIME[:10])
