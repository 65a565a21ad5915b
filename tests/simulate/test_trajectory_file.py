"""Trajectories in files: units in the headings, signs, and what is missing."""

import numpy as np
import pytest

from towtank.core.errors import AuditError, ReadError
from towtank.simulate.trajectory import Trajectory


def write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def turn_text(circle, header="time [s],x [m],y [m],psi [deg],delta [deg]", delta=35.0, **factors):
    columns = circle().columns(np.arange(0.0, 400.0, 2.0))
    columns["psi"] = np.degrees(columns["psi"])
    columns["delta"] = np.where(columns["time"] > 0.0, delta, 0.0)
    columns["r"] = np.degrees(columns["r"])
    names = [heading.split(" [")[0] for heading in header.split(",")]
    data = np.column_stack([columns[name] * factors.get(name, 1.0) for name in names])
    return header + "\n" + "\n".join(",".join(f"{value:.10g}" for value in row) for row in data) + "\n"


def test_written_samples_are_read_back(circle, hull, tmp_path):
    before = circle().trajectory()
    before.to_csv(tmp_path / "turn.csv")
    after = Trajectory.from_csv(tmp_path / "turn.csv", hull, "turning +35")
    assert list(after.frame.columns) == list(before.frame.columns)
    for name in before.frame.columns:
        np.testing.assert_allclose(after[name], before[name], rtol=1e-15, atol=1e-15)
    heading = (tmp_path / "turn.csv").read_text().splitlines()[0]
    assert "psi [deg]" in heading
    assert "r [deg/s]" in heading
    assert after.manoeuvre == "turning +35"
    assert after.provenance.inputs


def test_units_are_those_of_the_headings(hull, tmp_path):
    path = write(
        tmp_path / "log.csv",
        "Time [min],Heading [deg],u [kn],ROT [deg/min],rpm [rpm],Rudder [deg],Wind [m/s]\n"
        "0,350,10,0,120,0,5\n1,355,10,5,120,10,5\n2,2,10,7,120,10,5\n",
    )
    found = Trajectory.from_csv(path, hull)
    assert found["time"].tolist() == [0.0, 60.0, 120.0]
    assert np.degrees(found["psi"]) == pytest.approx([350.0, 355.0, 362.0])
    assert found["u"] == pytest.approx(10.0 * 1852.0 / 3600.0)
    assert np.degrees(found["r"]) == pytest.approx([0.0, 5.0 / 60.0, 7.0 / 60.0])
    assert found["n"] == pytest.approx(2.0)
    assert "heading made continuous across 360 degrees" in found.provenance.history
    assert "not read: Wind" in found.provenance.history


def test_columns_and_signs_of_a_laboratory(hull, tmp_path):
    path = write(tmp_path / "run.csv", "t [s],GYRO,HELM [deg]\n0,0,0\n1,0.1,-35\n2,0.2,-35\n")
    found = Trajectory.from_csv(path, hull, columns={"psi": "GYRO [rad]", "delta": "HELM"}, signs={"delta": -1})
    assert found["psi"][-1] == 0.2
    assert np.degrees(found["delta"][-1]) == pytest.approx(35.0)
    assert any("sign turned" in step for step in found.provenance.history)


def test_heading_without_a_unit_is_named(hull, tmp_path):
    path = write(tmp_path / "bare.csv", "time [s],psi\n0,0\n1,10\n2,20\n")
    with pytest.raises(ReadError, match=r"bare.csv, psi: column 'psi' has no unit -> .*'psi \[deg\]'"):
        Trajectory.from_csv(path, hull)


def test_unit_of_another_dimension_is_named(hull, tmp_path):
    path = write(tmp_path / "wrong.csv", "time [s],psi [deg],u [m]\n0,0,1\n1,10,2\n2,20,3\n")
    with pytest.raises(ReadError, match="'m' is no unit of the velocity 'u'"):
        Trajectory.from_csv(path, hull)


def test_what_is_missing_is_said(hull, tmp_path):
    path = write(tmp_path / "few.csv", "time [s],course [deg]\n0,0\n1,10\n2,20\n")
    with pytest.raises(ReadError, match=r"no column 'psi \[deg\]'; columns are time, course -> .*columns=\{'psi'"):
        Trajectory.from_csv(path, hull)


def test_two_columns_of_one_channel_are_named(hull, tmp_path):
    path = write(tmp_path / "two.csv", "time [s],psi [deg],heading [deg]\n0,0,0\n1,10,10\n2,20,20\n")
    with pytest.raises(ReadError, match="'psi' and 'heading' are both 'psi'"):
        Trajectory.from_csv(path, hull)


def test_choices_that_do_not_fit_the_file_are_named(hull, tmp_path):
    path = write(tmp_path / "run.csv", "time [s],psi [deg]\n0,0\n1,10\n2,20\n")
    with pytest.raises(ReadError, match="'speed' is no channel"):
        Trajectory.from_csv(path, hull, columns={"speed": "V"})
    with pytest.raises(ReadError, match="no column 'gyro' for 'psi'"):
        Trajectory.from_csv(path, hull, columns={"psi": "gyro [deg]"})


@pytest.mark.parametrize(
    ("header", "factors", "cause"),
    [
        ("time [s],x [m],y [m],psi [rad]", {}, r"'psi' spans 570\.1 rad, 91 turns"),
        (
            "time [s],psi [deg],r [rad/s]",
            {},
            r"'r' is 57\.\d+ times the slope of 'psi' -> the yaw rate is in degrees",
        ),
        ("time [s],psi [deg],r [deg/s]", {"r": 60.0}, "by the minute"),
        ("time [s],psi [deg],r [deg/s]", {"r": -1.0}, r"signs differ: give signs=\{'r': -1\}"),
        ("time [s],psi [deg],r [deg/s]", {"r": 7.0}, r"'r' is 7 times the slope of 'psi' -> mend the unit"),
        ("time [s],x [m],y [m],psi [deg],u [m/s],v [m/s]", {"u": 1.944, "v": 1.944}, "ratio of knots"),
        ("time [s],x [m],y [m],psi [deg],u [kn],v [kn]", {}, r"0\.51\d times that of the track"),
    ],
)
def test_channels_that_contradict_each_other(circle, hull, tmp_path, header, factors, cause):
    path = write(tmp_path / "turn.csv", turn_text(circle, header, **factors))
    with pytest.raises(AuditError, match=cause):
        Trajectory.from_csv(path, hull, "turning")
    assert len(Trajectory.from_csv(path, hull, "turning", accept=True)) == 200
