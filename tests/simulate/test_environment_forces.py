"""Laws of the compiled wind and wave-drift forces, and their plain-Python twin."""

import json
import math
import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.datasets import load_set
from towtank.simulate.environment import Current, Environment
from towtank.simulate.environment_forces import wave_drift_forces, wind_forces
from towtank.simulate.wave_drift import DriftTable, Waves
from towtank.simulate.wind import Wind, blendermann_coefficients, relative_wind

SHIP = load_set("kvlcc2-full").ship
COEFFICIENTS = blendermann_coefficients(
    "tanker, loaded", SHIP, frontal_area=1161.0, lateral_area=3813.0, centroid_forward=-20.0
)
angle = st.floats(-7.0, 7.0)
speed = st.floats(-12.0, 12.0)


def drift_table():
    angles = np.arange(0.0, 181.0, 15.0)
    a = np.radians(angles)
    frames = [
        pd.DataFrame(
            {
                "encounter angle [deg]": angles,
                "wavelength/L": length,
                "CX": length * np.cos(a) - 0.3,
                "CY": np.where(np.isin(angles, (0, 180)), 0.0, 3 * np.sin(a)),
                "CN": np.where(np.isin(angles, (0, 180)), 0.0, -0.1 * np.sin(2 * a) + 0.05 * np.sin(a)),
            }
        )
        for length in (0.5, 1.0, 1.5)
    ]
    return DriftTable.from_frame(pd.concat(frames))


TABLE = drift_table()


@given(angle, angle, speed, speed, st.floats(0.0, 40.0))
@settings(max_examples=60, deadline=None)
def test_wind_is_mirrored(psi, direction, u, v, strength):
    environment = Environment(Current(1.0, 0.7), Wind(strength, direction, COEFFICIENTS))
    x, y, k, n = wind_forces(environment.packed(SHIP), psi, u, v)
    mirror = wind_forces(environment.mirrored().packed(SHIP), -psi, u, -v)
    assert mirror == pytest.approx((x, -y, -k, -n), rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("drift", [None, TABLE])
@given(psi=angle, direction=angle)
@settings(max_examples=40, deadline=None)
def test_waves_are_mirrored(drift, psi, direction):
    waves = Waves(3.0, direction) if drift is None else Waves(3.0, direction, 0.8 * SHIP.L, drift)
    environment = Environment(waves=waves)
    x, y, n = wave_drift_forces(environment.packed(SHIP), psi)
    mirror = wave_drift_forces(environment.mirrored().packed(SHIP), -psi)
    assert mirror == pytest.approx((x, -y, -n), rel=1e-9, abs=1e-3)


@given(angle, angle, speed, speed)
@settings(max_examples=40, deadline=None)
def test_wind_force_is_that_of_the_relative_wind(psi, direction, u, v):
    wind = Wind(13.0, direction, COEFFICIENTS)
    found = wind_forces(Environment(wind=wind).packed(SHIP), psi, u, v)
    felt, off_bow = relative_wind(13.0, direction, psi, u, v)
    cx, cy, ck, cn = COEFFICIENTS.at(off_bow)
    q = 0.5 * wind.air_density * felt**2
    expected = (cx * q * 1161.0, cy * q * 3813.0, ck * q * 3813.0**2 / SHIP.L, cn * q * 3813.0 * SHIP.L)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-3)


@pytest.mark.parametrize("wind", [None, Wind(0.0, 0.4, COEFFICIENTS)])
def test_still_air_does_not_push_a_ship_at_rest(wind):
    assert wind_forces(Environment(wind=wind).packed(SHIP), 0.3, 0.0, 0.0) == (0, 0, 0, 0)


@given(angle, angle, speed, speed)
@settings(max_examples=30, deadline=None)
def test_current_and_wind_of_the_same_velocity_are_a_moving_frame(psi, direction, u, v):
    # water and air move together: the ship feels what it feels in still air and still water
    together = Environment(Current(4.0, direction), Wind(4.0, direction + math.pi, COEFFICIENTS))
    still = Environment(wind=Wind(0.0, 0.0, COEFFICIENTS))
    found = wind_forces(together.packed(SHIP), psi, u, v)
    assert found == pytest.approx(wind_forces(still.packed(SHIP), psi, u, v), rel=1e-7, abs=1e-3)


def test_wind_from_starboard_pushes_to_port_and_heels_to_port():
    x, y, k, _n = wind_forces(
        Environment(wind=Wind(20.0, math.radians(80), COEFFICIENTS)).packed(SHIP), 0.0, 0.0, 0.0
    )
    assert x < 0 > y
    assert k < 0
    head, *_ = wind_forces(Environment(wind=Wind(20.0, 0.0, COEFFICIENTS)).packed(SHIP), 0.0, 8.0, 0.0)
    assert head < x


def test_waves_push_where_they_travel():
    packed = Environment(waves=Waves(3.0, math.pi / 2)).packed(SHIP)
    x, y, _ = wave_drift_forces(packed, 0.0)
    assert y > 0
    assert x == pytest.approx(0.0, abs=1e-6 * y)
    # a ship that has turned to starboard by a quarter has them from astern
    x, y, _ = wave_drift_forces(packed, math.pi / 2)
    assert x > 0
    assert y == pytest.approx(0.0, abs=1e-9 * x)


def test_drift_forces_are_those_of_the_table():
    waves = Waves(3.0, 2.5, 1.2 * SHIP.L, TABLE)
    found = wave_drift_forces(Environment(waves=waves).packed(SHIP), 0.4)
    cx, cy, cn = TABLE.at_wavelength(1.2).at(2.1)
    unit = SHIP.rho * 9.80665 * 1.5**2 * SHIP.B**2
    assert found == pytest.approx((cx * unit / SHIP.L, cy * unit / SHIP.L, cn * unit), rel=1e-10)


_TWIN = """
import json, sys
sys.path.insert(0, sys.argv[1])
import numpy as np
from towtank.simulate.environment_forces import wave_drift_forces, wind_forces
for row in json.loads(sys.stdin.read()):
    packed = np.array(row["packed"])
    print(json.dumps([*wind_forces(packed, *row["at"]), *wave_drift_forces(packed, row["at"][0])]))
"""


def test_plain_python_gives_the_same(tmp_path):
    environments = [
        Environment(Current(1.0, 0.5), Wind(12.0, 2.0, COEFFICIENTS), Waves(3.0, 1.0)),
        Environment(wind=Wind(12.0, -2.0, COEFFICIENTS), waves=Waves(3.0, -1.0, 0.7 * SHIP.L, TABLE)),
    ]
    at = [(0.3, 7.0, -0.8), (-2.0, 3.0, 0.4), (0.0, 0.0, 0.0)]
    rows = [{"packed": env.packed(SHIP).tolist(), "at": place} for env in environments for place in at]
    run = subprocess.run(
        [sys.executable, "-c", _TWIN, str(tmp_path)],
        input=json.dumps(rows),
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
    )
    plain = [json.loads(line) for line in run.stdout.splitlines()]
    for row, values in zip(rows, plain, strict=True):
        packed = np.array(row["packed"])
        compiled = (*wind_forces(packed, *row["at"]), *wave_drift_forces(packed, row["at"][0]))
        assert values == pytest.approx(compiled, rel=1e-12, abs=1e-6)
