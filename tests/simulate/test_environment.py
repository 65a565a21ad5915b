"""Packing of current, wind and waves; each is off unless it is given."""

import math
import warnings

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError, TowtankWarning
from towtank.datasets import load_set
from towtank.simulate.environment import CALM, Current, Environment
from towtank.simulate.environment_forces import current_velocity, wave_drift_forces, wind_forces
from towtank.simulate.environment_layout import HEADER
from towtank.simulate.manoeuvres import turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.wave_drift import DriftTable, Waves
from towtank.simulate.wind import Wind, blendermann_coefficients

SHIP = load_set("kvlcc2-full").ship
COEFFICIENTS = blendermann_coefficients("tanker, loaded", SHIP, frontal_area=1161.0, lateral_area=3813.0)


def drift_table(lengths=(0.5, 1.0)):
    angles = np.arange(0.0, 181.0, 30.0)
    rows = [
        {
            "encounter angle [deg]": angle,
            "wavelength/L": length,
            "CX": length * math.cos(math.radians(angle)),
            "CY": 3 * math.sin(math.radians(angle)),
            "CN": -0.1 * math.sin(2 * math.radians(angle)) if angle not in (0, 180) else 0.0,
        }
        for angle in angles
        for length in lengths
    ]
    return DriftTable.from_frame(pd.DataFrame(rows))


def test_everything_is_off_by_default():
    packed = CALM.packed(SHIP)
    assert packed.tolist() == [0.0] * HEADER
    assert wind_forces(packed, 0.3, 8.0, -1.0) == (0, 0, 0, 0)
    assert wave_drift_forces(packed, 0.3) == (0, 0, 0)


def test_packed_is_what_the_kernel_takes():
    environment = Environment(Current(0.5, 1.0), Wind(15.0, 0.3, COEFFICIENTS), Waves(4.0, 2.0))
    packed = environment.packed(SHIP)
    assert packed.dtype == np.float64
    assert packed.flags.c_contiguous
    assert np.isfinite(packed).all()


def test_blocks_do_not_disturb_each_other():
    wind, waves = Wind(15.0, 0.3, COEFFICIENTS), Waves(4.0, 2.0, 320.0, drift_table())
    both = Environment(wind=wind, waves=waves).packed(SHIP)
    assert wind_forces(both, 0.2, 7.0, 0.5) == wind_forces(Environment(wind=wind).packed(SHIP), 0.2, 7.0, 0.5)
    assert wave_drift_forces(both, 0.2) == wave_drift_forces(Environment(waves=waves).packed(SHIP), 0.2)


def test_current_is_turned_into_the_axes_of_the_ship():
    packed = Environment(current=Current(2.0, math.radians(30))).packed(SHIP)
    along, across = current_velocity(packed, math.radians(120))
    assert (along, across) == pytest.approx((0.0, -2.0), abs=1e-12)


def test_waves_beyond_the_table_are_told():
    environment = Environment(waves=Waves(2.0, math.pi, 2.0 * SHIP.L, drift_table()))
    assert "2 L leave the range 0.5 to 1 L" in environment.doubts(SHIP)[0]
    with pytest.warns(TowtankWarning, match="leave the range"):
        packed = environment.packed(SHIP)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        edge = Environment(waves=Waves(2.0, math.pi, SHIP.L, drift_table())).packed(SHIP)
    assert wave_drift_forces(packed, 0.4) == wave_drift_forces(edge, 0.4)


def test_mirrored_twice_is_the_same():
    environment = Environment(Current(0.5, 1.0), Wind(15.0, 0.3, COEFFICIENTS), Waves(4.0, 2.0))
    assert np.array_equal(environment.mirrored().mirrored().packed(SHIP), environment.packed(SHIP))
    assert not np.array_equal(environment.mirrored().packed(SHIP), environment.packed(SHIP))


def test_speed_is_a_size():
    with pytest.raises(TowtankError, match="the sign is a direction"):
        Current(-1.0, 0.0)


def test_track_in_a_current_is_the_calm_track_carried_along():
    vessel, circle = named_ship("kvlcc2"), turning(35.0)
    calm = sail(vessel, circle).frame
    carried = sail(vessel, circle, environment=Environment(Current(0.1, 2.0))).frame
    time = calm["time"].to_numpy()
    assert carried["x"].to_numpy() == pytest.approx(calm["x"] + 0.1 * math.cos(2.0) * time, abs=1e-9)
    assert carried["y"].to_numpy() == pytest.approx(calm["y"] + 0.1 * math.sin(2.0) * time, abs=1e-9)
    for column in ("psi", "u", "v", "r"):
        assert carried[column].to_numpy() == pytest.approx(calm[column].to_numpy(), abs=1e-12)


def test_mirrored_environment_mirrors_the_track():
    vessel = named_ship("dtc")
    areas = {"frontal_area": 0.18, "lateral_area": 0.9}
    coefficients = blendermann_coefficients("container ship, loaded", vessel.ship, **areas)
    environment = Environment(Current(0.03, 0.5), Wind(1.5, 1.0, coefficients), Waves(0.02, 2.0))
    starboard = sail(vessel, turning(35.0, 200.0), environment=environment).frame.iloc[-1]
    port = sail(vessel, turning(-35.0, 200.0), environment=environment.mirrored()).frame.iloc[-1]
    assert port["x"] == pytest.approx(starboard["x"], abs=1e-7)
    assert port["y"] == pytest.approx(-starboard["y"], abs=1e-7)
    calm = sail(vessel, turning(35.0, 200.0)).frame.iloc[-1]
    assert abs(calm["y"] - starboard["y"]) > 0.1 * vessel.ship.L


def test_head_wind_and_head_sea_shorten_the_advance():
    vessel, circle = named_ship("kvlcc2-full"), turning(35.0, 120.0)
    against = (Environment(wind=Wind(20.0, 0.0, COEFFICIENTS)), Environment(waves=Waves(4.0, math.pi)))
    advances = [sail(vessel, circle, environment=environment).frame["x"].max() for environment in (CALM, *against)]
    assert advances[1] < advances[0]
    assert advances[2] < advances[0]
