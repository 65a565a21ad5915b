"""Budget of the sensors."""

import math

import pytest

from towtank.core.errors import TowtankError
from towtank.squat.sensor_budget import Accuracies, Component, sensor_budget


def test_linear_sum_of_the_source():
    """0.12 to 0.14 m at the bow and 0.13 to 0.15 m at the stern are linear sums; squares would give half."""
    for lever, bound in ((115.0, 0.12), (229.0, 0.14), (172.0, 0.13), (286.0, 0.15)):
        assert sensor_budget(lever).linear == pytest.approx(bound, abs=1e-3)
    assert 0.06 < sensor_budget(115.0).rss < sensor_budget(286.0).rss < 0.085


def test_the_lever_has_no_sign_and_turns_the_angle_into_metres():
    assert sensor_budget(-100.0).contributions["pitch"] == pytest.approx(100.0 * math.radians(0.01))
    assert sensor_budget(-100.0).linear == sensor_budget(100.0).linear


def test_table_ends_with_both_sums():
    budget = sensor_budget(50.0, Accuracies(altitude=0.05), further=[Component("draught read", 0.03)])
    frame = budget.frame.set_index("component")["contribution"]
    assert frame["draught read"] == 0.03
    assert frame["linear sum"] == pytest.approx(frame.iloc[:5].sum())
    assert frame["root sum of squares"] == pytest.approx(math.sqrt((frame.iloc[:5] ** 2).sum()))


def test_impossible_sizes_are_named():
    with pytest.raises(TowtankError, match=r"altitude: an uncertainty of -0.1 is impossible"):
        sensor_budget(10.0, Accuracies(altitude=-0.1))
    with pytest.raises(TowtankError, match="the lever is not a number"):
        sensor_budget(math.nan)
