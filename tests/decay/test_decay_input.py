import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import AuditError, ReadError
from towtank.core.record import Record
from towtank.decay.decay_input import decay_from_table, read_decay


def table(**changes: np.ndarray) -> dict[str, np.ndarray]:
    time = np.arange(0.0, 40.0, 0.1)
    return {"time": time, "phi": 0.3 * np.exp(-0.02 * time) * np.cos(0.6 * time), **changes}


def test_degrees_and_radians_are_the_same_record():
    radians = decay_from_table(table(), unit="rad")
    degrees = decay_from_table(table(phi=np.degrees(table()["phi"])), unit="deg")
    np.testing.assert_allclose(degrees.value, radians.value)
    assert degrees.steps == ("phi: deg -> rad",)


def test_sources_of_a_record():
    data = table()
    frame = pd.DataFrame(data)
    record = Record(data, source="run 7.csv", sha256="abc")
    for source in (frame, record):
        made = decay_from_table(source, unit="rad")
        np.testing.assert_array_equal(made.value, data["phi"])
    assert decay_from_table(record).name == "run 7"


def test_unit_must_be_declared():
    with pytest.raises(ReadError, match="not declared"):
        decay_from_table(table())
    with pytest.raises(ReadError, match="does not measure heave"):
        decay_from_table(table(), unit="rad", motion="heave")
    with pytest.raises(ReadError, match="no column 'psi'"):
        decay_from_table(table(), angle="psi", unit="rad")
    with pytest.raises(ReadError, match="motion 'yaw' is unknown"):
        decay_from_table(table(), unit="rad", motion="yaw")
    with pytest.raises(ReadError, match="holds text"):
        decay_from_table({"time": np.arange(3), "phi": np.array(["a", "b", "c"])}, unit="rad")


def test_degrees_for_radians_are_caught_both_ways():
    large = table(phi=np.degrees(table()["phi"]))
    with pytest.raises(AuditError, match=r"\[angle-in-degrees\].*57\.3"):
        decay_from_table(large, unit="rad")
    with pytest.raises(AuditError, match=r"\[angle-in-radians\].*57\.3"):
        decay_from_table(table(), unit="deg")
    accepted = decay_from_table(table(), unit="deg", accepted=["angle-in-radians"])
    assert accepted.findings[0].accepted


def test_file_without_a_unit(tmp_path):
    path = tmp_path / "run.csv"
    pd.DataFrame(table()).to_csv(path, index=False)
    with pytest.raises(ReadError, match="the file prints none"):
        read_decay(path)
    assert len(read_decay(path, unit="rad").sha256) == 64


def test_a_unit_that_nobody_knows_names_file_and_channel(tmp_path):
    path = tmp_path / "run.csv"
    pd.DataFrame(table()).to_csv(path, index=False)
    with pytest.raises(ReadError, match=r"run\.csv, channel phi: unit 'dge' is unknown -> "):
        read_decay(path, unit="dge")


def test_printed_unit_is_used_and_a_contradiction_told(tmp_path):
    path = tmp_path / "run.csv"
    data = table()
    pd.DataFrame({"time [s]": data["time"], "phi [deg]": np.degrees(data["phi"])}).to_csv(path, index=False)
    np.testing.assert_allclose(read_decay(path).value, data["phi"])
    with pytest.raises(AuditError, match="angle-in-degrees"):
        read_decay(path, unit="rad")
