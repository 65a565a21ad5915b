"""Water level and current tables: straight lines inside, nothing outside."""

import numpy as np
import pytest

from towtank.core.errors import FitError, ReadError
from towtank.squat.tide import TideTable, read_current, read_water_level


def test_straight_lines_between_entries():
    table = TideTable([0.0, 1800.0, 3600.0], [1.0, 2.0, 1.0])
    np.testing.assert_allclose(table.at([0.0, 900.0, 2700.0, 3600.0]), [1.0, 1.5, 1.5, 1.0])


def test_a_constant_holds_always():
    np.testing.assert_allclose(TideTable.constant(0.7).at([-1e9, 1e9]), [0.7, 0.7])


def test_between_stations_and_times():
    table = TideTable([0.0, 100.0], [[0.0, 2.0, 3.0], [1.0, 3.0, 6.0]], positions=[-1000.0, 0.0, 500.0])
    np.testing.assert_allclose(table.at([0.0, 100.0, 50.0], [-500.0, 0.0, 500.0]), [1.0, 3.0, 4.5])
    np.testing.assert_allclose(table.at([50.0, 50.0], -1000.0), [0.5, 0.5])
    only = TideTable([0.0, 100.0], [[1.0], [2.0]], positions=[10.0])
    np.testing.assert_allclose(only.at([50.0], 10.0), [1.5])


@pytest.mark.parametrize(
    ("when", "where", "said"),
    [
        ([3601.0], None, "time 3601 s is outside its 0 to 3600 s"),
        ([-1.0], None, "nothing is extrapolated"),
        ([np.nan], None, "outside"),
    ],
)
def test_nothing_is_extrapolated_in_time(when, where, said):
    with pytest.raises(FitError, match=said):
        TideTable([0.0, 3600.0], [1.0, 2.0]).at(when, where)


def test_stations_need_a_position_inside():
    table = TideTable([0.0, 1.0], [[0.0, 2.0], [1.0, 3.0]], positions=[0.0, 1000.0])
    with pytest.raises(FitError, match="several places -> give the position"):
        table.at([0.5])
    with pytest.raises(FitError, match="position 1200 m is outside its 0 to 1000 m"):
        table.at([0.5], 1200.0)


@pytest.mark.parametrize(
    ("time", "level", "said"),
    [
        ([0.0, 0.0], [1.0, 2.0], "times do not increase"),
        ([0.0, 1.0], [1.0, np.nan], "a value is missing"),
        ([0.0, 1.0], [1.0, 2.0, 3.0], "values of shape"),
    ],
)
def test_faults_of_a_table_are_named(time, level, said):
    with pytest.raises(FitError, match=f"table of the water level: .*{said}"):
        TideTable(np.array(time), np.array(level))


def test_files_with_units_stations_and_a_correction(tmp_path):
    file = tmp_path / "tide.csv"
    file.write_text("time,sea,port,flow\nmin,cm,cm,kn\n0,100,200,2\n30,160,260,-2\n", encoding="utf-8")
    one = read_water_level(file, level="sea", correction=0.05)
    np.testing.assert_allclose(one.at([900.0]), [1.35])
    both = read_water_level(file, level={"port": 0.0, "sea": -65_000.0})
    np.testing.assert_allclose(both.at([0.0], -32_500.0), [1.5])
    np.testing.assert_allclose(read_current(file, current="flow").at([0.0]), [2 * 1852 / 3600])
    with pytest.raises(ReadError, match=r"channel flow: is in kn, a velocity, and should be a length"):
        read_water_level(file, level="flow")
    with pytest.raises(ReadError, match="no channel 'tide' -> the file has time, sea"):
        read_water_level(file, level="tide")
