"""Scaling errors between model and ship."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import FitError, TowtankError
from towtank.squat.scaling_error import clearance_with_allowance, scale_allowance, scaling_errors
from towtank.squat.squat_curve import SquatCurve

SCALE, DEPTH, DRAUGHT = 40.0, 20.0, 16.0


def curve(speed, bow, stern, trim, scale=1.0, depth=DEPTH, draught=DRAUGHT, name="PPM52"):
    points = pd.DataFrame({"speed": speed, "sinkage_bow": bow, "sinkage_stern": stern, "trim": trim})
    points["sinkage_bow_se"] = 0.001
    return SquatCurve(points, depth / scale, draught / scale, name, scale)


MODEL = curve(
    np.array([4.0, 6.0, 8.0]) / np.sqrt(SCALE),
    np.array([0.40, 0.90, 1.60]) / SCALE,
    np.array([0.30, 0.70, 1.30]) / SCALE,
    np.array([3e-4, 6e-4, 9e-4]),
    SCALE,
)
SHIP = curve([5.0, 7.0, 9.0], [0.70, 1.35, 2.2], [0.50, 1.05, 1.8], [5e-4, 8e-4, 1e-3])


def test_errors_are_ship_less_scaled_model_at_the_speeds_of_the_ship():
    found = scaling_errors(MODEL, SHIP)
    bow = found.frame[found.frame["quantity"] == "sinkage_bow"]
    np.testing.assert_allclose(bow["speed"], [5.0, 7.0])
    np.testing.assert_allclose(bow["model"], [0.65, 1.25])
    np.testing.assert_allclose(bow["error"], [0.05, 0.10])
    np.testing.assert_allclose(bow["error_as_printed"], [-0.05, -0.10])
    np.testing.assert_allclose(bow["percent"], [100 * 0.05 / 0.70, 100 * 0.10 / 1.35])
    np.testing.assert_allclose(bow["percent_of_clearance"], [1.25, 2.5])
    assert found.outside == 1
    assert found.largest("sinkage_bow") == pytest.approx(0.10)


def test_trim_keeps_its_sign_and_has_no_clearance():
    frame = scaling_errors(MODEL, SHIP).frame
    trim = frame[frame["quantity"] == "trim"]
    np.testing.assert_allclose(trim["error"], trim["error_as_printed"])
    np.testing.assert_allclose(trim["error"], [5e-4 - 4.5e-4, 8e-4 - 7.5e-4])
    assert trim["percent_of_clearance"].isna().all()
    assert set(frame["quantity"]) == {"sinkage_bow", "sinkage_stern", "trim"}


def test_clearance_that_the_error_takes():
    clearance = scaling_errors(MODEL, SHIP).clearance
    np.testing.assert_allclose(clearance["static"], 4.0)
    np.testing.assert_allclose(clearance["ship"], [3.30, 2.65])
    np.testing.assert_allclose(clearance["change"], [-0.05, -0.10])
    np.testing.assert_allclose(clearance["percent_of_static"], [-1.25, -2.5])


def test_a_perfect_model_has_no_error():
    same = scaling_errors(MODEL, MODEL.full_scale())
    np.testing.assert_allclose(same.frame["error"], 0.0, atol=1e-15)
    assert same.outside == 0


def test_allowance_takes_from_the_clearance():
    assert [scale_allowance(ratio) for ratio in (2.0, 1.25, 1.24, 1.15)] == [0.10, 0.10, 0.15, 0.15]
    table = clearance_with_allowance(MODEL)
    np.testing.assert_allclose(table["speed"], [4.0, 6.0, 8.0])
    np.testing.assert_allclose(table["clearance"], [3.6, 3.1, 2.4])
    np.testing.assert_allclose(table["least"], [3.56, 3.01, 2.24])
    with pytest.raises(TowtankError, match=r"known down to h/T 1.15, not at 1.1"):
        scale_allowance(1.1)


def test_curves_that_do_not_belong_together_are_refused():
    with pytest.raises(FitError, match="ship's curve is at scale 40"):
        scaling_errors(MODEL, MODEL)
    deeper = curve([5.0], [0.7], [0.5], [5e-4], depth=25.0)
    with pytest.raises(FitError, match="PPM52: the depth is 20 m by the model and 25 m by the ship"):
        scaling_errors(MODEL, deeper)
    fast = curve([10.0], [0.7], [0.5], [5e-4])
    with pytest.raises(FitError, match="nothing is extrapolated"):
        scaling_errors(MODEL, fast)
    bare = SquatCurve(pd.DataFrame({"speed": [5.0], "resistance": [1.0]}), DEPTH, DRAUGHT)
    with pytest.raises(FitError, match="share no sinkage"):
        scaling_errors(MODEL, bare)
    with pytest.raises(TowtankError, match="no scaling error of 'heel' -> there are sinkage_bow"):
        scaling_errors(MODEL, SHIP).largest("heel")


def test_without_both_ends_the_clearance_is_left_out():
    one = SquatCurve(SHIP.points.drop(columns="sinkage_stern"), DEPTH, DRAUGHT)
    assert scaling_errors(MODEL, one).clearance.empty
