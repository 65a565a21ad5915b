"""Rudder schedules from files."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.simulate.schedule_file import read_schedule


def test_names_and_units_are_those_of_the_file(tmp_path):
    path = tmp_path / "helm.csv"
    path.write_text("t [s],rudder angle [rad],rpm [rpm],wind [m/s]\n0,0,60,3\n2,0.1,60,3\n4,-0.1,120,3\n")
    programme = read_schedule(path)
    assert programme.schedule is not None
    np.testing.assert_allclose(programme.schedule, [[0, 0, 1], [2, 0.1, 1], [4, -0.1, 2]])


def test_the_propeller_is_left_alone_where_nothing_is_said(tmp_path):
    path = tmp_path / "helm.csv"
    path.write_text("time [s],delta [deg]\n0,0\n2,10\n")
    schedule = read_schedule(path).schedule
    assert schedule is not None
    assert np.isnan(schedule[:, 2]).all()
    assert schedule[1, 1] == pytest.approx(np.radians(10.0))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time [s],psi [deg]\n0,1\n2,2\n", "no column 'delta'"),
        ("delta [deg],psi [deg]\n0,1\n2,2\n", "no column 'time'"),
        ("time [s],delta [m]\n0,1\n2,2\n", "no unit of the angle"),
        ("time [s],delta [deg]\n0,1\n2,2\n2,3\n", "row 3"),
    ],
)
def test_faults_name_file_and_place(tmp_path, text, said):
    path = tmp_path / "helm.csv"
    path.write_text(text)
    with pytest.raises(ReadError) as caught:
        read_schedule(path)
    assert said in str(caught.value)
    assert "helm.csv" in str(caught.value)
