"""Stern from bow through the restoring matrix."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.core.ship import Ship
from towtank.squat.prediction import FORMULAS, predict
from towtank.squat.restoring_squat import restoring_matrix, stern_over_bow, with_stern

DTC = Ship("DTC", L=355.0, B=51.0, T=14.5, volume=171800.0)
MATRIX = restoring_matrix(14000.0, -8.0, 171800.0, 480.0)


def test_bow_is_the_formula_and_stern_the_same_share_at_every_speed():
    both = with_stern(FORMULAS["icorels"], MATRIX, 355.0)
    found = predict(DTC, 29.0, [3.0, 6.0, 8.0], formulas=(FORMULAS["icorels"], both))
    bow, stern, middle = (found.of("icorels-restored", place) for place in ("bow", "stern", "middle"))
    np.testing.assert_array_equal(bow, found.of("icorels", "bow"))
    np.testing.assert_allclose(stern / bow, stern_over_bow(MATRIX, 355.0), rtol=1e-14)
    np.testing.assert_allclose(middle, 0.5 * (bow + stern), rtol=1e-14)


def test_force_down_at_the_origin_gives_these_ends():
    heave, pitch = np.linalg.solve(MATRIX, [-1e6, 0.0])
    bow, stern = -heave + 177.5 * pitch, -heave - 177.5 * pitch
    assert bow > stern > 0
    assert stern_over_bow(MATRIX, 355.0) == pytest.approx(stern / bow, rel=1e-12)


def test_flotation_at_midship_sinks_evenly():
    assert stern_over_bow(restoring_matrix(14000.0, 0.0, 171800.0, 480.0), 355.0) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("matrix", "said"),
    [
        (np.array([[1.0, 2.0], [0.0, 1.0]]), "symmetric"),
        (np.array([[1.0, 2.0], [2.0, 1.0]]), "positive"),
        (restoring_matrix(14000.0, 60.0, 171800.0, 500.0), "lifts the bow"),
    ],
)
def test_impossible_matrices(matrix, said):
    with pytest.raises(TowtankError, match=said):
        stern_over_bow(matrix, 355.0)


def test_formula_without_bow():
    with pytest.raises(TowtankError, match="does not give the bow"):
        predict(DTC, 29.0, [3.0], formulas=(with_stern(FORMULAS["barrass-2"], MATRIX, 355.0),))
