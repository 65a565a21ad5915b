"""Chain from cells to verdict for KVLCC2 in shallow water."""

import pytest

from towtank.reproduce.paper_kvlcc2_cemt import cases, drag_triplet

CASES = {case.quantity: case for case in cases()}


def test_drags_follow_from_the_changes():
    grids = drag_triplet()
    assert (grids.fine, grids.medium, grids.coarse) == pytest.approx((2.91, 3.05, 2.89))
    assert (grids.r21, grids.r32) == pytest.approx((1.41, 1.46), abs=5e-3)


def test_two_convergence_ratios():
    assert CASES["convergence ratio of the percentages"].computed == pytest.approx(-0.923, abs=5e-4)
    assert CASES["convergence ratio of the drags"].computed == pytest.approx(-0.875)


def test_uncertainty_and_verdict():
    assert CASES["half the range of the drags in N"].computed == pytest.approx(0.08)
    assert CASES["verdict"].computed == "validated"
    assert {case.verdict for case in CASES.values()} == {"reproduced"}
