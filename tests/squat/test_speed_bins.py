"""Squat of a voyage by speed."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.speed_bins import squat_by_speed
from towtank.squat.virtual_voyage import virtual_voyage
from towtank.squat.voyage_reduction import reduce_voyage


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    return reduce_voyage(virtual_voyage(step=1.0, noise=0.0).write_folder(tmp_path_factory.mktemp("voyage")))[0]


def test_sinkage_goes_with_the_square_of_the_speed(found):
    table = squat_by_speed(found, width=1.0)
    assert table["speed"].is_monotonic_increasing
    middle = table["longitudinal_mean"] - table["trim_mean"] * 175.0
    fast = table["speed"] > 3.0
    np.testing.assert_allclose(middle[fast], 0.012 * table["speed"][fast] ** 2, rtol=0.03)
    assert (table["longitudinal_max"] >= table["longitudinal_mean"]).all()
    assert (table["corner_max"] >= table["lateral_max"]).all()


def test_all_steady_time_is_in_some_range(found):
    table = squat_by_speed(found)
    steady = np.isfinite(found.steady.midship)
    assert table["duration"].sum() == pytest.approx(np.count_nonzero(steady) * 1.0)
    assert table["clearance_min"].min() == pytest.approx(found.clearance.clearance[steady].min())
    assert set(table.attrs["units"]) == set(table.columns)


def test_what_has_no_ranges_is_named(found):
    with pytest.raises(FitError, match="ranges of 0 m/s are impossible"):
        squat_by_speed(found, width=0.0)
    with pytest.raises(FitError, match="speed was not recorded"):
        squat_by_speed(replace(found, record=replace(found.record, speed=None)))
    blind = replace(found.steady, midship=np.full_like(found.steady.midship, np.nan))
    with pytest.raises(FitError, match="no sample has a steady value"):
        squat_by_speed(replace(found, steady=blind))
