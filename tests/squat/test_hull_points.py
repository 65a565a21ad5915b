"""Largest sinkage along, across and at the corners."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.squat.hull_points import corner_sinkage, lateral_sinkage, longitudinal_sinkage


def test_largest_of_the_points_themselves():
    rng = np.random.default_rng(1)
    midship, trim, heel = rng.normal(size=(3, 50)) * np.array([[1.0], [0.001], [0.02]])
    ends = np.maximum(midship + trim * 100.0, midship - trim * 100.0)
    sides = np.maximum(midship + heel * 16.0, midship - heel * 16.0)
    corners = np.max([midship + a * trim * 100.0 + b * heel * 16.0 for a in (-1, 1) for b in (-1, 1)], axis=0)
    np.testing.assert_allclose(longitudinal_sinkage(midship, trim, 200.0), ends)
    np.testing.assert_allclose(lateral_sinkage(midship, heel, 32.0), sides)
    np.testing.assert_allclose(corner_sinkage(midship, trim, heel, 200.0, 32.0), corners)


def test_a_ship_without_extent_is_an_error():
    with pytest.raises(TowtankError, match="a breadth of -2 m is impossible"):
        lateral_sinkage(np.ones(2), np.ones(2), -2.0)
