"""Restricted water and squat formulas in the gallery: the corrections behind the verdicts."""

import pytest

from towtank.reproduce import paper_rescue_cruiser, paper_resquat, paper_shallow_water, paper_squat_formulas
from towtank.reproduce.paper_resquat import grid_uncertainty


def one(module, quantity, case=""):
    found = [item for item in module.cases() if quantity in item.quantity and case in item.case]
    assert len(found) == 1
    return found[0]


def test_series_60_and_the_missing_root_at_17_knots():
    assert one(paper_shallow_water, "overspeed in %").computed == pytest.approx(11.38, abs=0.005)
    assert one(paper_shallow_water, "Kreitner at 17 kn").computed == "no root"
    assert one(paper_shallow_water, "critical speed in the tank").computed == pytest.approx(16.81, abs=0.005)


@pytest.mark.parametrize(
    ("numbers", "percent"),
    [
        # trim of the fine grid unrounded within its print: the paper's own 4.37
        ((0.0662, 2.59e-3, 1.17e-3), 4.37),
        ((-1.162, 2.61e-2, 5.45e-3), 0.371),
        ((-0.028, 4.30e-5, 9.94e-5), 1.526),
        ((0.067, 1.22e-2, -9.27e-5), 11.38),
    ],
)
def test_grid_uncertainties_of_resquat(numbers, percent):
    assert grid_uncertainty(*numbers) == pytest.approx(percent, abs=6e-3 if percent > 1 else 6e-4)


def test_copied_uncertainties_do_not_reproduce():
    kept = {item.quantity for item in paper_resquat.cases() if item.verdict == "not-reproducible"}
    assert kept == {"uncertainty of trim in %", "uncertainty of sinkage in %"}


def test_lackenby_takes_four_times_what_the_ship_lost():
    case = "22 kn"
    own = one(paper_rescue_cruiser, "own correction", case).computed
    assert one(paper_rescue_cruiser, "Lackenby", case).computed * 22 / 100 == pytest.approx(2.76 * own, rel=0.01)


def test_only_roemisch_in_the_canal_differs():
    differing = [item for item in paper_squat_formulas.cases() if item.verdict != "reproduced"]
    assert {item.quantity.split()[0] for item in differing} == {"roemisch"}
    assert all("canal" in item.case for item in differing)
