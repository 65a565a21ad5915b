import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError, TowtankError
from towtank.core.record import Record
from towtank.formats.channels import ChannelMap
from towtank.formats.simman import SIMMAN_CHANNELS, SIMMAN_UNITS, find_condition, read_simman, write_simman

PARTICULARS = {"Lpp": 4.3671, "mass": 742.0, "scale": "1:58", "U": 1.1}


@pytest.fixture
def record():
    rng = np.random.default_rng(1)
    names = ["time" if name == "Time" else name for name in SIMMAN_UNITS]
    return Record({name: rng.normal(size=7) for name in names})


def test_round_trip(tmp_path, record):
    path = tmp_path / "run1.dat"
    write_simman(record, path, PARTICULARS)
    table = read_simman(path)
    assert table.metadata == {**PARTICULARS, "condition_file": str(tmp_path / "run1.cond")}
    assert table.units == {**SIMMAN_UNITS}
    again = ChannelMap.model_validate(SIMMAN_CHANNELS).apply(table)
    for name, values in record.channels.items():
        np.testing.assert_array_equal(again[name], values)


def test_frame_with_the_printed_names(tmp_path):
    frame = pd.DataFrame({name: [0.0, 1.0] for name in SIMMAN_UNITS})
    write_simman(frame, tmp_path / "run.dat")
    assert read_simman(tmp_path / "run.dat").columns["Time"].tolist() == [0.0, 1.0]
    assert not (tmp_path / "run.cond").exists()


def test_si_is_taken_where_no_unit_is_printed(tmp_path):
    path = tmp_path / "run.txt"
    path.write_text("Time X Y N x y psi u v r udot vdot rdot\n" + " ".join("1" * 13) + "\n")
    table = read_simman(path)
    assert table.units == SIMMAN_UNITS
    assert [finding.rule for finding in table.findings] == ["no-condition-file"]


def test_printed_units_are_kept(tmp_path):
    path = tmp_path / "run.txt"
    units = " ".join(["s", "N", "N", "Nm", "m", "m", "deg", "m/s", "m/s", "deg/s", "m/s2", "m/s2", "deg/s2"])
    path.write_text(f"Time X Y N x y psi u v r udot vdot rdot\n{units}\n" + " ".join("1" * 13) + "\n")
    assert read_simman(path, columns=["psi", "Time"]).units == {"psi": "deg", "Time": "s"}


@pytest.mark.parametrize("name", ["run1.cond", "run1.inf", "run1.txt", "condition.txt", "model.txt"])
def test_condition_file_is_found(tmp_path, name):
    (tmp_path / name).write_text("Lpp 4.3671\n")
    assert find_condition(tmp_path / "run1.dat") == tmp_path / name


def test_the_run_is_not_its_own_condition_file(tmp_path):
    (tmp_path / "run1.txt").write_text("0 1\n")
    assert find_condition(tmp_path / "run1.txt") is None


def test_named_condition_file(tmp_path, record):
    write_simman(record, tmp_path / "run.dat")
    (tmp_path / "ship.ini").write_text("Lpp = 7\n")
    assert read_simman(tmp_path / "run.dat", tmp_path / "ship.ini").metadata["Lpp"] == 7.0


def test_missing_column(tmp_path):
    path = tmp_path / "run.txt"
    path.write_text("Time X Y\n0 1 2\n1 2 3\n")
    with pytest.raises(ReadError, match=r"is not in the SIMMAN form: there is no column N, x, y, psi"):
        read_simman(path)


def test_missing_channel_is_not_written(tmp_path, record):
    channels = {name: values for name, values in record.channels.items() if name != "rdot"}
    with pytest.raises(TowtankError, match="the SIMMAN form needs rdot"):
        write_simman(Record(channels), tmp_path / "run.dat")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("value", ["", "a\nb", "a = b", "50 # knots"])
def test_entry_that_would_not_come_back(tmp_path, record, value):
    with pytest.raises(TowtankError, match=r"entry 'remark' = .* cannot be written in one line"):
        write_simman(record, tmp_path / "run.dat", {"remark": value})
    assert list(tmp_path.iterdir()) == []
