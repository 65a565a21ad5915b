"""Relative wind, wind coefficients by table and by type of ship."""

import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ConventionError, DatasetError, ReadError, TowtankError
from towtank.datasets import load_set, load_table
from towtank.simulate.wind import (
    AIR_DENSITY,
    Wind,
    WindCoefficients,
    blendermann_coefficients,
    relative_wind,
    wind_at_height,
)

SHIP = load_set("kvlcc2-full").ship
AREAS = {"frontal_area": 1161.0, "lateral_area": 3813.0, "length": 320.0}


def frame():
    angles = np.arange(0.0, 181.0, 30.0)
    a = np.radians(angles)
    return pd.DataFrame(
        {
            "angle [deg]": angles,
            "CX": -0.6 * np.cos(a),
            "CY": [0, *(-0.8 * np.sin(a[1:-1])), 0],
            "CN": [0, *(-0.1 * np.sin(2 * a[1:-1])), 0],
        }
    )


@pytest.mark.parametrize(
    ("direction", "psi", "u", "v", "speed", "angle"),
    [
        (0, 0, 5, 0, 15, 0),
        (180, 0, 5, 0, 5, 180),
        (90, 0, 10, 0, math.hypot(10, 10), 45),
        (90, 90, 10, 0, 20, 0),
        (-90, 0, 0, 10, 0, None),
        (0, 90, 0, 0, 10, -90),
    ],
)
def test_relative_wind_of_a_10_m_s_wind(direction, psi, u, v, speed, angle):
    found, off_bow = relative_wind(10.0, math.radians(direction), math.radians(psi), u, v)
    assert found == pytest.approx(speed, abs=1e-9)
    if angle is not None:
        assert abs(math.degrees(off_bow)) == pytest.approx(abs(angle))
        assert angle in (0, 180) or np.sign(off_bow) == np.sign(angle)


def test_table_is_read_from_csv(tmp_path):
    path = tmp_path / "wind.csv"
    frame().to_csv(path, index=False)
    found = WindCoefficients.from_csv(path, **AREAS)
    assert found.source == "wind.csv"
    assert found.at(math.radians(60)) == pytest.approx(
        [-0.3, -0.8 * math.sin(math.pi / 3), 0, -0.1 * math.sin(2 * math.pi / 3)]
    )


def test_missing_column_names_the_file(tmp_path):
    path = tmp_path / "wind.csv"
    frame().drop(columns="CN").to_csv(path, index=False)
    with pytest.raises(ReadError, match=r"wind\.csv: the table has no column 'CN'"):
        WindCoefficients.from_csv(path, **AREAS)
    with pytest.raises(ReadError, match="not a table of coefficients"):
        WindCoefficients.from_csv(tmp_path / "none.csv", **AREAS)


def test_words_in_a_column_are_named():
    wrong = frame().astype({"CX": object})
    wrong.loc[2, "CX"] = "?"
    with pytest.raises(ReadError, match="'CX' is not of numbers"):
        WindCoefficients.from_frame(wrong, **AREAS)


@pytest.mark.parametrize("column", ["CX", "CY"])
def test_other_axes_are_seen(column):
    wrong = frame()
    wrong[column] *= -1
    with pytest.raises(ConventionError, match=f"{column} of a .*wind.* is positive"):
        WindCoefficients.from_frame(wrong, **AREAS)


def test_areas_follow_the_scale_of_the_ship():
    coefficients = WindCoefficients.from_frame(frame(), **AREAS)
    full = coefficients.units(SHIP, AIR_DENSITY)
    model = coefficients.units(SHIP.at_scale(50.0), AIR_DENSITY)
    assert full / model == pytest.approx([50.0**2, 50.0**2, 50.0**3, 50.0**3])
    assert full[0] == pytest.approx(0.5 * AIR_DENSITY * 1161.0)
    assert full[2] == pytest.approx(0.5 * AIR_DENSITY * 3813.0**2 / 320.0)


def test_blendermann_at_the_angles_of_his_formula():
    found = blendermann_coefficients(
        "research vessel",
        SHIP,
        frontal_area=160.7,
        lateral_area=434.8,
        centroid_forward=1.48,
        centroid_height=5.1,
        overall_length=335.0,
    )
    row = load_table("blendermann-ship-types").frame.set_index("type").loc["research vessel"]
    for degrees, along in ((40.0, row["CD_l_bow"]), (140.0, row["CD_l_stern"])):
        g = math.radians(degrees)
        shape = 1 - 0.5 * 0.60 * (1 - along * 160.7 / 434.8 / 0.85) * math.sin(2 * g) ** 2
        cx, cy, ck, cn = found.at(g)
        assert cx == pytest.approx(-along * math.cos(g) / shape)
        assert cy == pytest.approx(-0.85 * math.sin(g) / shape)
        # moments in newton-metres do not depend on the length that made them non-dimensional
        assert cn * SHIP.L == pytest.approx((1.48 / 335.0 - 0.18 * (g - math.pi / 2)) * cy * 335.0)
        assert ck * 434.8 / SHIP.L == pytest.approx(1.4 * 5.1 * cy)


def test_unknown_type_lists_the_known():
    with pytest.raises(DatasetError, match="car carrier"):
        blendermann_coefficients("junk", SHIP, frontal_area=1.0, lateral_area=1.0)


def test_step_must_divide_the_half_circle():
    with pytest.raises(ReadError, match="divisor of 180"):
        blendermann_coefficients("ferry", SHIP, frontal_area=1.0, lateral_area=2.0, step=7.0)


def test_wind_blows_from_its_direction():
    wind = Wind(10.0, math.radians(90), WindCoefficients.from_frame(frame(), **AREAS))
    assert wind.velocity == pytest.approx((0.0, -10.0))


def test_power_law():
    assert wind_at_height(10.0, 40.0, 10.0, 7.0) == pytest.approx(10.0 * 4 ** (1 / 7))
    assert wind_at_height(10.0, 10.0) == 10.0
    with pytest.raises(TowtankError, match="heights must be positive"):
        wind_at_height(10.0, 0.0)


def test_areas_must_be_positive():
    with pytest.raises(TowtankError, match="frontal_area = 0"):
        WindCoefficients.from_frame(frame(), frontal_area=0.0, lateral_area=1.0, length=1.0)
