"""A log that is still written is read on from where it stopped."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats.growing_log import GrowingLog

HEAD = "# Force\n# Time (total_x total_y total_z)\n"


def append(path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a") as file:
        file.write(text)


def times(log: GrowingLog) -> list[float]:
    return log.read()["time"].tolist()


def test_only_new_rows_come(tmp_path):
    path = tmp_path / "force.dat"
    append(path, HEAD + "1\t(1 2 3)\n2\t(1 2 3)\n")
    log = GrowingLog(path)
    assert log.read().to_numpy().tolist() == [[1, 1, 2, 3], [2, 1, 2, 3]]
    assert log.names == ["time", "Fx_total", "Fy_total", "Fz_total"]
    assert times(log) == []
    append(path, "3\t(4 5 6)\n")
    assert log.read().to_numpy().tolist() == [[3, 4, 5, 6]]


def test_a_half_written_line_waits_for_its_end(tmp_path):
    path = tmp_path / "force.dat"
    append(path, HEAD + "1\t(1 2 3)\n2\t(1 2 ")
    log = GrowingLog(path)
    assert times(log) == [1]
    append(path, "3)")
    assert times(log) == []
    append(path, "\n3\t(1 2 3)\n")
    assert times(log) == [2, 3]


def test_every_byte_on_its_own(tmp_path):
    path = tmp_path / "force.dat"
    text = HEAD + "".join(f"{i}\t({i}.5 2 3)\n" for i in range(1, 6))
    log = GrowingLog(path)
    path.touch()
    rows = []
    for letter in text:
        append(path, letter)
        rows += log.read().to_numpy().tolist()
    assert rows == [[i, i + 0.5, 2, 3] for i in range(1, 6)]


@pytest.mark.parametrize("text", ["", "# Force\n", HEAD, HEAD + "0.1\t(1"])
def test_no_rows_yet(tmp_path, text):
    path = tmp_path / "force.dat"
    append(path, text)
    log = GrowingLog(path)
    assert len(log.read()) == 0
    assert log.names == []


def test_monitors_of_other_solvers_grow_too(tmp_path):
    path = tmp_path / "force.csv"
    append(path, '"Physical Time: Physical Time (s)","Fx Monitor: Fx (N)"\n0.1,5')
    log = GrowingLog(path)
    assert times(log) == []
    append(path, ".5\n0.2,6.5\n")
    assert log.read().to_numpy().tolist() == [[0.1, 5.5], [0.2, 6.5]]


def test_a_restart_in_a_new_folder_is_found(tmp_path):
    objects = tmp_path / "postProcessing" / "forces"
    append(objects / "0" / "force.dat", HEAD + "1\t(1 2 3)\n2\t(1 2 3)\n3\t(1 2 3)\n")
    log = GrowingLog(objects / "force.dat", columns=["Fy_total"])
    assert times(log) == [1, 2, 3]
    append(objects / "2" / "force.dat", HEAD + "2.5\t(1 7 3)\n")
    assert log.read().to_numpy().tolist() == [[2.5, 7]]
    (restart,) = log.restarts
    assert (restart.start, restart.previous_end, restart.file.parent.name) == (2.5, 3.0, "2")


def test_a_file_that_was_written_anew(tmp_path):
    path = tmp_path / "force.dat"
    append(path, HEAD + "1\t(1 2 3)\n2\t(1 2 3)\n")
    log = GrowingLog(path)
    assert times(log) == [1, 2]
    path.write_text(HEAD + "0.5\t(1 2 3)\n")
    assert times(log) == [0.5]
    assert [restart.start for restart in log.restarts] == [0.5]


def test_a_printed_nan_is_a_missing_value(tmp_path):
    path = tmp_path / "force.dat"
    append(path, HEAD + "1\t(nan 2 3)\n")
    assert np.isnan(GrowingLog(path).read()["Fx_total"]).all()


def test_columns_that_change(tmp_path):
    objects = tmp_path / "forces"
    append(objects / "0" / "force.dat", HEAD + "1\t(1 2 3)\n")
    log = GrowingLog(objects / "force.dat")
    assert times(log) == [1]
    append(
        objects / "2" / "force.dat",
        "# Force\n# Time (total_x total_y total_z) (pressure_x pressure_y pressure_z)\n",
    )
    append(objects / "2" / "force.dat", "2 (1 2 3) (1 2 3)\n")
    with pytest.raises(ReadError, match="not those of the run before"):
        log.read()


def test_a_path_that_is_not_there(tmp_path):
    with pytest.raises(ReadError, match="there is no such file"):
        GrowingLog(tmp_path / "force.dat").read()
