"""A squat curve from a table: units, names, depth, and what makes no curve."""

import numpy as np
import pytest

from towtank.core.errors import FitError, ReadError
from towtank.squat.tabled_curve import read_squat_curve

TABLE = """speed [kn],bow [mm],sinkage_stern [m],trim [deg],depth [m],clearance [m]
10,200,0.15,0.1,18,3
8,100,,0.05,18,3
12,300,0.2,0.2,18,3
"""


@pytest.fixture
def read(tmp_path):
    def made(text, draught=14.5, **more):
        file = tmp_path / "curve.csv"
        file.write_text(text)
        return read_squat_curve(file, draught, **more)

    return made


def test_units_names_and_missing_rows(read):
    found = read(TABLE)
    points = found.curve.points
    assert list(points.columns) == ["speed", "sinkage_bow", "sinkage_stern", "trim"]
    np.testing.assert_allclose(points["speed"], np.array([10.0, 12.0]) * 1852 / 3600)
    np.testing.assert_allclose(points["sinkage_bow"], [0.2, 0.3])
    np.testing.assert_allclose(points["trim"], np.tan(np.radians([0.1, 0.2])))
    assert (found.curve.depth, found.curve.draught, found.curve.scale) == (18.0, 14.5, 1.0)
    assert [finding.rule for finding in found.findings] == ["missing-values"]
    assert len(found.sha256) == 64


def test_columns_without_units_are_si_and_said(read):
    found = read("speed,bow,trim\n5,0.2,0.001\n6,0.3,0.002\n", depth=18.0, scale=2.0)
    np.testing.assert_allclose(found.curve.points["trim"], [0.001, 0.002])
    assert found.curve.scale == 2.0
    (finding,) = found.findings
    assert "speed, bow, trim without a unit" in finding.message
    told = read("speed,bow\n5,200\n6,300\n", depth=18.0, units={"bow": "mm"})
    np.testing.assert_allclose(told.curve.points["sinkage_bow"], [0.2, 0.3])


@pytest.mark.parametrize(
    ("text", "more", "error", "said"),
    [
        ("V,bow\n5,0.2\n6,0.3\n", {"depth": 18.0}, ReadError, "no channel 'speed'"),
        ("speed,heave\n5,0.2\n6,0.3\n", {"depth": 18.0}, ReadError, "there is no sinkage and no trim"),
        ("speed,bow\n5,0.2\n6,0.3\n", {}, ReadError, "the water depth is not known"),
        ("speed,bow,depth\n5,0.2,18\n6,0.3,20\n", {}, ReadError, "empty or has several depths"),
        ("speed,bow\n5,0.2\n6,\n", {"depth": 18.0}, ReadError, r"1 whole row\(s\) make no curve"),
        ("speed,bow [N]\n5,0.2\n6,0.3\n", {"depth": 18.0}, ReadError, "channel bow: is in N, a force"),
        ("speed,bow\n-5,0.2\n6,0.3\n", {"depth": 18.0}, FitError, "a speed is missing or negative"),
        ("speed,bow\n5,0.2\n6,0.3\n", {"depth": -18.0}, FitError, "a water depth of -18 m is impossible"),
        ("speed,bow\n5,0.2\n6,0.3\n", {"depth": 14.0}, FitError, "leaves no clearance"),
    ],
)
def test_what_makes_no_curve_is_named(read, text, more, error, said):
    with pytest.raises(error, match=rf"curve\.csv.*{said}"):
        read(text, **more)
