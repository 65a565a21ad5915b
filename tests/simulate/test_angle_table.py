"""Tables over an angle, mirrored to the other side."""

import math

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.simulate.angle_table import AngleTable

ANGLES = np.radians(np.arange(0.0, 181.0, 10.0))


def table():
    sine = np.sin(ANGLES)
    sine[-1] = 0.0
    return AngleTable(ANGLES, np.column_stack([np.cos(ANGLES), sine]), (False, True), ("CX", "CY"))


def test_values_of_the_table_are_met_on_both_sides():
    found = table()
    assert np.allclose(found.at(ANGLES), found.values, atol=1e-14)
    assert np.allclose(found.at(-ANGLES), found.values * [1, -1], atol=1e-14)


def test_periodic():
    places = np.linspace(-9, 9, 41)
    assert np.allclose(table().at(places), table().at(places + 2 * math.pi), atol=1e-12)


def test_both_sides_are_mirror_images():
    places = np.linspace(0, math.pi, 301)
    assert np.allclose(table().at(-places), table().at(places) * [1, -1], rtol=0, atol=1e-15)


def test_follows_smooth_coefficients():
    places = np.linspace(-math.pi, math.pi, 400)
    expected = np.column_stack([np.cos(places), np.sin(places)])
    assert np.abs(table().at(places) - expected).max() < 2e-3


def test_never_leaves_the_values_beside():
    rng = np.random.default_rng(4)
    values = rng.normal(size=(len(ANGLES), 1))
    found = AngleTable(ANGLES, values, (False,), ("CX",))
    fine = np.linspace(0, math.pi, 1801)
    place = np.clip(np.searchsorted(ANGLES, fine, side="right") - 1, 0, len(ANGLES) - 2)
    low = np.minimum(values[place, 0], values[place + 1, 0])
    high = np.maximum(values[place, 0], values[place + 1, 0])
    curve = found.at(fine)[:, 0]
    assert np.all(curve >= low - 1e-12)
    assert np.all(curve <= high + 1e-12)


def test_packed_holds_count_angles_values_and_slopes():
    packed = table().packed(np.array([2.0, 3.0]))
    n = len(ANGLES)
    assert packed[0] == n
    assert len(packed) == 1 + n * (1 + 2 * 2)
    assert np.array_equal(packed[1 : n + 1], table().angles)
    assert np.array_equal(packed[1 + n : 1 + 2 * n], 2.0 * table().values[:, 0])
    assert np.array_equal(packed[1 + 3 * n : 1 + 4 * n], 3.0 * table().values[:, 1])


@pytest.mark.parametrize(
    ("angles", "values", "message"),
    [
        ([0.0, 1.0, 2.0], [1.0, 2.0, 3.0], "angles run from 0 to 114.592"),
        ([0.0, 2.0, 1.0, math.pi], [1.0] * 4, "do not ascend"),
        ([0.0, 1.0, math.pi], [1.0, math.nan, 1.0], "empty cells"),
        ([0.0, math.pi], [1.0, 1.0], "do not ascend"),
    ],
)
def test_bad_tables_are_named(angles, values, message):
    with pytest.raises(ReadError, match=message):
        AngleTable(np.array(angles), np.array(values)[:, None], (False,), ("CX",))


def test_side_force_ahead_is_refused():
    with pytest.raises(ReadError, match=r"CY is 0\.2 at 0 deg"):
        AngleTable(np.array([0, 1.5, math.pi]), np.array([[0.2], [1.0], [0.0]]), (True,), ("CY",))
