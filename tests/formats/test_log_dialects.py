"""Each file is understood by the reader of its solver, or refused by name."""

from __future__ import annotations

import pytest

from towtank.core.errors import ReadError
from towtank.formats.log_dialects import layout_of
from towtank.formats.solver_log import EmptyLogError


@pytest.mark.parametrize(
    ("name", "text", "dialect"),
    [
        ("force.dat", "# Force\n# Time (total_x total_y total_z)\n1 (1 2 3)\n", "OpenFOAM"),
        ("r.out", '"r"\n"Iteration" "r etc.."\n("Iteration" "r")\n1 2\n', "Fluent"),
        ("r.csv", '"Iteration","Fx Monitor: Fx (N)"\n1,2\n', "STAR-CCM+"),
        ("r.dat", "time Fx\n1 2\n2 3\n", "columns"),
    ],
)
def test_the_solver_is_told_by_the_file(tmp_path, name, text, dialect):
    path = tmp_path / name
    path.write_text(text)
    assert layout_of(path).dialect == dialect


def test_a_long_header_is_read_to_its_end(tmp_path):
    path = tmp_path / "p"
    count = 5000
    lines = [f"# Probe {i} ({i} 0.25 -0.125)" for i in range(count)]
    path.write_text("\n".join([*lines, "# Time " + " ".join(map(str, range(count))), "1 " + "2.5 " * count, ""]))
    layout = layout_of(path)
    assert len(layout.names) == count + 1
    assert layout.points["p_4999"] == (4999.0, 0.25, -0.125)


@pytest.mark.parametrize("text", ["", "  \n\n"])
def test_an_empty_file(tmp_path, text):
    path = tmp_path / "force.dat"
    path.write_text(text)
    with pytest.raises(EmptyLogError, match=r"force.dat: the file is empty -> the run wrote nothing"):
        layout_of(path)


def test_a_binary_file(tmp_path):
    path = tmp_path / "force.dat"
    path.write_bytes(bytes(range(256)) * 8)
    with pytest.raises(ReadError, match=r"force.dat: is a binary file"):
        layout_of(path)


@pytest.mark.parametrize(
    "text", ["hull rudder\n1 2\n3 4\n", "Dear colleague,\nthe run is done.\n", "1 2 3\n4 5 6\n"]
)
def test_an_unknown_form(tmp_path, text):
    path = tmp_path / "notes.txt"
    path.write_text(text)
    with pytest.raises(
        ReadError, match=r"notes.txt: (is no history of a known form -> give OpenFOAM|there are no data rows)"
    ):
        layout_of(path)


def test_a_missing_file_and_a_folder(tmp_path):
    with pytest.raises(ReadError, match=r"x.dat: file not found"):
        layout_of(tmp_path / "x.dat")
    with pytest.raises(ReadError, match=r"cannot be read"):
        layout_of(tmp_path)
