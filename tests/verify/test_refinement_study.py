"""Grids, time steps and iterations of one quantity."""

import math

import numpy as np
import pytest

from towtank.verify.refinement_study import Refinement, RefinementStudy, study_uncertainty

H = np.array([1.0, 1.5, 2.0])


def second_order(size):
    return Refinement(1.0 + size * H**2, H)


def test_one_part_counts_alone():
    found = study_uncertainty(RefinementStudy("X", "N", second_order(0.1)))
    assert [one.method for one in found.chosen] == ["factor of safety"]
    assert found.chosen[0].uncertainty == pytest.approx(0.16)


def test_parts_combine_in_squares():
    found = study_uncertainty(RefinementStudy("X", "N", second_order(0.3), second_order(0.4), 0.0))
    (chosen,) = found.chosen
    assert chosen.method == "combined"
    assert chosen.uncertainty == pytest.approx(1.6 * 0.5)
    assert {one.quantity for one in found.estimates} == {"X", "X (time step)"}
    assert found.estimates[-1] is chosen


def test_iterative_part_joins_and_is_named():
    found = study_uncertainty(RefinementStudy("X", "N", second_order(0.1), None, 0.12), method="GCI Celik")
    assert found.chosen[0].uncertainty == pytest.approx(math.hypot(0.125, 0.12))
    assert "iterative 0.12" in found.chosen[0].note


def test_phases_are_unwrapped():
    found = study_uncertainty(
        RefinementStudy("heave_phase", "deg", Refinement(np.array([179.0, -180.0, -178.0]), H))
    )
    assert found.grid.values == pytest.approx([179.0, 180.0, 182.0])


def test_curves_have_a_row_a_point_and_pooled_rows():
    x = np.tile([2.0, 4.0], 3)
    h = np.repeat(H, 2)
    found = study_uncertainty(RefinementStudy("Y", "N", Refinement(x * (1.0 + 0.1 * h**2), h, x)))
    assert [one.quantity for one in found.chosen] == ["Y at 2", "Y at 4"]
    assert [one.method for one in found.estimates[-2:]] == ["pooled change", "mean order"]
    assert len(found.curves) == 1
