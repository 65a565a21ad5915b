"""Estimators beside least squares on the same rows, from a campaign to its table."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.pmm.beside_least_squares import COLUMNS, beside_least_squares
from towtank.pmm.campaign_file import Fit, Reduction
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.standard_matrices import pure_sway, pure_yaw, static_drift
from towtank.pmm.virtual_records import virtual_campaign

MATRIX = [
    *static_drift((-12, -8, -4, 0, 4, 8, 12), 1.5),
    *pure_sway((0.1, 0.2, 0.3), 0.9, 1.5),
    *pure_yaw((0.1, 0.2, 0.3), 0.9, 1.5),
    *pure_yaw((0.15, 0.3), 0.9, 1.5, (-8.0, 6.0)),
]


@pytest.fixture(scope="module")
def runs(hull):
    campaign = virtual_campaign(hull, MATRIX, Laboratory(sampling_rate=10.0, duration=20.0, cycles=3))
    plan = ReductionPlan(Reduction(skip_cycles=0), hull.ship, HOME, terms=hull.terms)
    return [reduce_run(record, run, plan) for run, record in campaign.records(Noise(ar1=0.02, seed=4))]


@pytest.mark.parametrize("estimator", ["lssvm", "ridge", "huber"])
def test_least_squares_stands_beside_the_estimator(runs, hull, estimator):
    fit = fit_hull(runs, Fit(estimator=estimator), hull.ship, name="twin", terms=hull.terms)
    plain = fit_hull(runs, Fit(), hull.ship, name="twin", terms=hull.terms).derivatives
    table = beside_least_squares(fit)
    assert list(table.columns) == list(COLUMNS)
    assert set(table["name"]) == set(hull.names)
    for row in table.itertuples():
        assert row.fit == fit.derivatives[row.name]
        assert row.least_squares == pytest.approx(plain[row.name], rel=1e-9, abs=1e-12)
        assert row.least_squares_std == pytest.approx(plain.bse[row.name], rel=1e-6)
        assert row.fit_minus_least_squares == pytest.approx(row.fit - row.least_squares)
    # With data that separate the terms, estimators agree within a few standard errors.
    assert np.abs(table["difference_in_std"]).max() < 4.0
    assert np.abs(table["fit_minus_least_squares"]).max() > 0.0
