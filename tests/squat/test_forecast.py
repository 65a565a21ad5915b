"""Squat, clearance and the water of a passage."""

import json

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.forecast import SCHIJF, forecast
from towtank.squat.prediction import FORMULAS

SHIP = Ship("container ship", L=230.0, B=32.2, T=10.8, volume=52030.0)
KNOT = 1852 / 3600
SPEEDS = np.array([6.0, 10.0, 14.0]) * KNOT


def test_every_formula_is_there_and_the_clearance_follows():
    found = forecast(SHIP, Fairway(16.2), SPEEDS)
    frame = found.frame
    assert set(frame["formula"]) == set(FORMULAS)
    assert len(frame) == 3 * len(FORMULAS)
    np.testing.assert_allclose(frame["clearance [m]"], 16.2 - 10.8 - frame["maximum [m]"])
    # 16.2 / 10.8 is 1.5 but for the last bit: inside the limit of Barrass
    assert frame.set_index("formula").loc["barrass-3", "applicable"].all()
    spread = found.spread
    inside = frame[frame["applicable"] & np.isclose(frame["full-scale speed [kn]"], 10.0)]
    row = spread.iloc[1]
    assert row["least clearance [m]"] == pytest.approx(inside["clearance [m]"].min())
    assert row["median [m]"] == pytest.approx(inside["maximum [m]"].median())
    assert found.water["critical speed [m/s]"] == pytest.approx(np.sqrt(9.80665 * 16.2))


def test_above_schijf_no_formula_applies():
    found = forecast(SHIP, Fairway.canal(16.2, 100.0, 3.0), SPEEDS)
    above = found.frame["speed [m/s]"] > found.water[SCHIJF]
    assert above.any()
    assert not above.all()
    assert not found.frame.loc[above, "applicable"].any()
    assert found.frame.loc[above, "flag"].str.endswith("above Schijf's critical speed").all()
    assert "above-schijf" in [item.rule for item in found.findings]
    spread = found.spread
    assert spread["overspeed [-]"].isna().tolist() == (found.water[SCHIJF] < SPEEDS).tolist()
    assert spread["applicable"].iloc[-1] == 0


def test_a_model_squats_by_its_scale():
    full = forecast(SHIP, Fairway(16.2), SPEEDS)
    model = forecast(SHIP.at_scale(80.0), Fairway(16.2 / 80), SPEEDS / np.sqrt(80.0))
    np.testing.assert_allclose(80.0 * model.frame["maximum [m]"], full.frame["maximum [m]"], rtol=1e-9)
    np.testing.assert_allclose(
        model.frame["full-scale speed [kn]"], full.frame["full-scale speed [kn]"], rtol=1e-9
    )


def test_restoring_gives_the_stern_of_icorels():
    matrix = {"waterplane_area": 6500.0, "flotation": -8.0, "longitudinal_GM": 280.0}
    frame = forecast(SHIP, Fairway(16.2), SPEEDS, restoring=matrix).frame.set_index("formula")
    plain, both = frame.loc["icorels"], frame.loc["icorels-restored"]
    np.testing.assert_allclose(plain["bow [m]"], both["bow [m]"])
    assert plain["stern [m]"].isna().all()
    # the force acts forward of the centre of flotation, so that the stern sinks less
    assert (both["stern [m]"] < both["bow [m]"]).all()


def test_running_aground_is_said():
    found = forecast(SHIP, Fairway(11.5), np.array([6.0, 12.0]) * KNOT)
    said = {item.rule: item.message for item in found.findings}
    assert "no-clearance" in said
    assert json.loads(json.dumps(found.to_dict()))["water"]["S"] == pytest.approx(found.water["S"])


def test_impossible_passages():
    with pytest.raises(TowtankError, match=r"not below the critical 12\.604 m/s"):
        forecast(SHIP, Fairway(16.2), np.array([30.0 * KNOT]))
    with pytest.raises(TowtankError, match=r"9.0 m is not more than the draught .* -> give more depth"):
        forecast(SHIP, Fairway(9.0), SPEEDS)
    bare = Ship("bare", L=230.0, B=32.2, T=10.8)
    with pytest.raises(TowtankError, match="no displaced volume"):
        forecast(bare, Fairway(16.2), SPEEDS)
