"""Clearance under the keel."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.squat.under_keel import dynamic_clearance, gross_clearance


def test_static_clearance_over_draught():
    np.testing.assert_allclose(gross_clearance([18.0, 15.0], 15.0), [0.2, 0.0])


def test_way_takes_the_sinkage_and_the_uncertainties_add_in_squares():
    found = dynamic_clearance([18.0, 16.0], 15.0, [1.2, 1.1], u_depth=0.3, u_draught=0.04, u_sinkage=0.0)
    np.testing.assert_allclose(found.clearance, [1.8, -0.1])
    np.testing.assert_allclose(found.percent_of_draught, [12.0, -100.0 / 150.0])
    assert found.uncertainty == pytest.approx(np.hypot(0.3, 0.04))
    assert found.bound == pytest.approx(0.34)
    assert found.touches().tolist() == [False, True]
    assert found.touches(factor=6.0).tolist() == [True, True]


@pytest.mark.parametrize(
    ("depth", "draught", "u", "said"),
    [
        (-5.0, 10.0, 0.0, "a water depth of -5 m is impossible"),
        (12.0, 0.0, 0.0, "a draught of 0 m is impossible"),
        (12.0, 10.0, -0.1, "an uncertainty of -0.1 m is impossible"),
    ],
)
def test_impossible_numbers_are_named(depth, draught, u, said):
    with pytest.raises(TowtankError, match=said):
        dynamic_clearance(depth, draught, 0.5, u_depth=u)
