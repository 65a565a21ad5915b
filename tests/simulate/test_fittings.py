"""Propeller, rudder and steering gear in the spellings of different papers."""

import math

import numpy as np
import pytest

from towtank.core.errors import DatasetError
from towtank.core.ship import Ship
from towtank.simulate.fittings import gear_from, notes_of, propeller_from, rudder_from
from towtank.simulate.propeller import ThrustSurface

SHIP = Ship("box", 100.0, 20.0, 8.0)


def test_complements_are_turned_into_values():
    propeller = propeller_from({"D": 5.0, "k0": 0.5, "k1": -0.4, "one_minus_w": 0.645, "one_minus_t": 0.793})
    assert propeller.wP0 == pytest.approx(0.355)
    assert propeller.tP == pytest.approx(0.207)
    np.testing.assert_array_equal(propeller.KT, [0.5, -0.4])


def test_an_exponential_wake_loses_its_printed_sign():
    printed = {"D": 5.0, "k0": 0.5, "wake": "exponential", "C1": -8.0, "wp0": 0.17}
    assert propeller_from(printed).C1 == 8.0
    assert propeller_from(printed).wP0 == 0.17


def test_a_thrust_surface_is_known_by_its_coefficients():
    printed = {"Tuu": -0.007, "Tun": -0.0006, "Tnn": 3.5e-5, "cun": 0.6, "cnn": 38.0, "t": 0.22}
    assert propeller_from(printed) == ThrustSurface(-0.007, -0.0006, 3.5e-5, 0.6, 38.0, 0.22)


def test_a_propeller_without_diagram_is_refused():
    with pytest.raises(DatasetError, match="thrust coefficients"):
        propeller_from({"D": 5.0})


@pytest.mark.parametrize(
    ("printed", "area"), [({"area": 12.0}, 12.0), ({"area_over_LT": 0.02}, 16.0), ({"LT_over_area": 40.0}, 20.0)]
)
def test_areas_in_three_spellings(printed, area):
    assert rudder_from({**printed, "f_alpha": 2.7}, SHIP).area == pytest.approx(area)


def test_slope_from_the_aspect_ratio_and_side_from_the_spelling():
    rudder = rudder_from(
        {"area": 1.0, "aspect_ratio": 2.25, "gammaR_betaP_positive": 0.5, "gammaR_betaP_negative": 0.3}, SHIP
    )
    assert rudder.f_alpha == pytest.approx(6.13 / 2)
    assert (rudder.switch, rudder.gammaR_positive, rudder.gammaR_negative) == ("betaP", 0.5, 0.3)
    assert rudder_from({"area": 1.0, "f_alpha": 2.7, "gamma": 0.1}, SHIP).switch == "betaR"


def test_steering_gear_alone_is_no_rudder():
    printed = {"rate_deg_s": 2.5, "limit_deg": 40.0, "lag_s": 1.0}
    assert rudder_from(printed, SHIP) is None
    gear = gear_from(printed)
    assert (gear.rate, gear.limit, gear.lag) == (math.radians(2.5), math.radians(40.0), 1.0)
    assert gear_from({"rate_rad_s": 0.04}).rate == 0.04
    assert gear_from({"limit_deg": 40.0}) is None


def test_notes_by_subject():
    assert notes_of({"rudder": {"note": "assumed"}, "propeller": {"D": 1.0}}) == {"rudder": "assumed"}
