"""Scale effects on squat: scaling error and validation."""

import pytest

from towtank.reproduce.paper_resquat import KEY, fine_grid_errors


def test_scaling_error_of_the_fine_grids(find):
    assert find(KEY, "scaling error of the sinkage in m").computed == pytest.approx(-0.042, abs=5e-4)
    frame = fine_grid_errors().frame.set_index("quantity")
    assert frame.loc["sinkage_cog", "error"] == pytest.approx(0.042, abs=5e-4)
    assert frame.loc["sinkage_cog", "percent_of_clearance"] == pytest.approx(1.05, abs=0.01)


def test_clearance_loses_what_the_bow_sinks_more():
    clearance = fine_grid_errors().clearance.iloc[0]
    assert clearance["static"] == pytest.approx(4.0)
    # the bow of the model trims more, which nearly makes up for the sinkage
    assert clearance["change"] == pytest.approx(-0.0026, abs=5e-4)


def test_uncertainty_of_the_measurement_that_the_validation_implies(find):
    assert find(KEY, "uncertainty of the measurement", "trim").computed == pytest.approx(14.85, abs=5e-3)
    assert find(KEY, "uncertainty of the measurement", "sinkage").computed == pytest.approx(7.48, abs=5e-3)
