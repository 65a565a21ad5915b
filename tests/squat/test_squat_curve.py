"""Squat curves: fits, bands, full scale, clearance."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import FitError
from towtank.core.variables import GRAVITY
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord, read_sinkage
from towtank.squat.squat_curve import SquatCurve
from towtank.squat.steady_squat import reduce_steady

DEPTH, DRAUGHT, LENGTH = 0.326, 0.163, 3.984
SPEEDS = np.array([0.872, 0.3, 0.45, 0.6, 0.75])
LAYOUT = SinkageLayout(
    length=LENGTH, points={"z_VF": (LENGTH / 2, 0.0), "z_VA": (-LENGTH / 2, 0.0)}, speed="u", extra=("X",)
)


def _curve(noise=0.0, seed=1, c=0.03):
    square = SPEEDS**2 / (GRAVITY * DEPTH)
    bow = c * square / np.sqrt(1 - square) + noise * np.random.default_rng(seed).standard_normal(SPEEDS.size)
    points = pd.DataFrame({"speed": SPEEDS, "sinkage_bow": bow, "sinkage_stern": 0.6 * bow, "trim": 0.1 * bow})
    return SquatCurve(points, DEPTH, DRAUGHT, "DTC", scale=89.11)


def test_depth_froude_curve_recovers_its_coefficient():
    fit = _curve().fit()
    assert fit.params == pytest.approx([0.03])
    assert fit.residual_sd < 1e-12
    assert fit.speed_range == (0.3, 0.872)
    assert fit.extrapolated([0.29, 0.5, 0.9]).tolist() == [True, False, True]


def test_power_law_recovers_coefficient_and_exponent():
    points = pd.DataFrame({"speed": SPEEDS, "sinkage_bow": 0.0109 * SPEEDS**2.3})
    fit = SquatCurve(points, DEPTH, DRAUGHT).fit(model="power")
    assert fit.params == pytest.approx([0.0109, 2.3], rel=1e-6)
    assert fit.predict(1.0) == pytest.approx([0.0109])


@pytest.mark.parametrize("model", ["depth-froude", "power"])
def test_bands_cover_as_they_say(model):
    inside = 0
    truth = _curve().fit(model=model).predict(0.6)
    for seed in range(400):
        lower, upper = _curve(noise=1e-4, seed=seed).fit(model=model).band(0.6)
        inside += bool(lower[0] <= truth[0] <= upper[0])
    assert inside / 400 == pytest.approx(0.95, abs=0.035)


def test_full_scale_keeps_depth_froude_number_trim_and_the_share_of_clearance():
    model = _curve()
    full = model.full_scale()
    np.testing.assert_allclose(full.depth_froude_number, model.depth_froude_number)
    np.testing.assert_allclose(full.points["trim"], model.points["trim"])
    np.testing.assert_allclose(full.points["sinkage_bow"], 89.11 * model.points["sinkage_bow"])
    np.testing.assert_allclose(full.clearance() / full.draught, model.clearance() / model.draught)
    assert full.scale == 1.0


def test_clearance_is_that_of_the_deeper_end():
    curve = _curve()
    deepest = curve.points["sinkage_bow"].max()
    assert curve.clearance().min() == pytest.approx(DEPTH - DRAUGHT - deepest)
    with pytest.raises(FitError, match="sinkage at bow and stern"):
        SquatCurve(curve.points[["speed", "trim"]], DEPTH, DRAUGHT).clearance()


def test_curve_of_the_benchmark_runs(benchmark_run):
    runs = [reduce_steady(read_sinkage(benchmark_run(run), LAYOUT), depth=DEPTH) for run in ("C2", "C1")]
    curve = SquatCurve.from_runs(runs, DRAUGHT, name="DTC", scale=89.11)
    assert curve.points["speed"].is_monotonic_increasing
    # Printed in metres full scale: 0.081 and 0.737 at the bow, 0.049 and 0.438 at the stern.
    full = curve.full_scale().points
    assert full["sinkage_bow"].tolist() == pytest.approx([0.081, 0.737], rel=0.04)
    assert full["sinkage_stern"].tolist() == pytest.approx([0.049, 0.438], rel=0.07)
    assert "X" not in full
    assert (curve.points["sinkage_bow_se"] > 0).all()
    assert curve.fit().residual_sd < 2e-4


def test_impossible_curves_are_named():
    points = pd.DataFrame({"speed": SPEEDS, "sinkage_bow": SPEEDS**2})
    with pytest.raises(FitError, match=r"water depth of -0\.3 m is impossible"):
        SquatCurve(points, -0.3, 0.1)
    with pytest.raises(FitError, match="leaves no clearance"):
        SquatCurve(points, 0.1, 0.163)
    with pytest.raises(FitError, match="no column 'speed'"):
        SquatCurve(points[["sinkage_bow"]], DEPTH, DRAUGHT)
    with pytest.raises(FitError, match="speed is missing or negative"):
        SquatCurve(points.assign(speed=-SPEEDS), DEPTH, DRAUGHT)
    with pytest.raises(FitError, match="no run makes no curve"):
        SquatCurve.from_runs([], DRAUGHT)


def test_fits_that_the_points_cannot_carry_are_named():
    curve = _curve()
    fast = SquatCurve(curve.points.assign(speed=curve.points["speed"] * 2.1), DEPTH, DRAUGHT)
    with pytest.raises(FitError, match=r"1\.8312 m/s is not below the critical speed 1\.788 m/s"):
        fast.fit()
    with pytest.raises(FitError, match="no 'sinkage_keel'"):
        curve.fit("sinkage_keel")
    with pytest.raises(FitError, match=r"1 point\(s\) carry no depth-froude curve"):
        SquatCurve(curve.points.head(1), DEPTH, DRAUGHT).fit()
    with pytest.raises(FitError, match="no curve 'spline'"):
        curve.fit(model="spline")
    with pytest.raises(FitError, match="does not change its sign"):
        SquatCurve(curve.points.assign(trim=curve.points["trim"] - 1e-4), DEPTH, DRAUGHT).fit("trim", "power")
    with pytest.raises(FitError, match="no point at rest"):
        SquatCurve(curve.points.assign(speed=curve.points["speed"] - 0.3), DEPTH, DRAUGHT).fit(model="power")


def test_runs_of_two_depths_make_no_curve():
    time = np.arange(0.0, 20.0, 0.05)
    noise = 1e-5 * np.random.default_rng(0).standard_normal((2, time.size))
    record = SinkageRecord(time, 0.006 + noise[0], 0.0008 + noise[1], LAYOUT, speed=np.full_like(time, 0.5))
    one, two = (reduce_steady(record, rule="mser", depth=depth) for depth in (0.326, 0.1956))
    with pytest.raises(FitError, match="need one water depth"):
        SquatCurve.from_runs([one, two], DRAUGHT)
