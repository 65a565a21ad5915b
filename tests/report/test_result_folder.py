"""A folder of results is complete or not there, and results of different kinds do not mix."""

from __future__ import annotations

import json

import pytest

from towtank.core.errors import TowtankError
from towtank.report.result_folder import require_folder, write_folder

ONE, OTHER = {"format": "towtank one 1"}, {"format": "towtank other 1"}


def texts(**files):
    return [(name, lambda path, text=text: path.write_text(text)) for name, text in files.items()]


def test_files_are_listed_and_stale_ones_go(tmp_path):
    out = tmp_path / "out"
    write_folder(out, texts(a="1", b="2"), ONE)
    (out / "mine").write_text("kept")
    write_folder(out, texts(b="3"), ONE)
    assert {path.name: path.read_text() for path in out.iterdir() if path.suffix == ""} == {
        "b": "3",
        "mine": "kept",
    }
    assert json.loads((out / "provenance.json").read_text())["files"] == ["b", "provenance.json"]


def test_a_failure_leaves_nothing(tmp_path):
    def fail(path):
        path.write_text("half")
        raise RuntimeError("in the middle")

    with pytest.raises(RuntimeError):
        write_folder(tmp_path / "out", [*texts(a="1"), ("b", fail)], ONE)
    assert list(tmp_path.iterdir()) == []


def test_results_of_another_kind_are_not_touched(tmp_path):
    out = tmp_path / "out"
    write_folder(out, texts(a="1"), ONE)
    with pytest.raises(TowtankError, match="results of another kind"):
        write_folder(out, texts(c="1"), OTHER)
    assert {path.name for path in out.iterdir()} == {"a", "provenance.json"}
    (out / "provenance.json").write_text("not ours")
    require_folder(out, OTHER["format"])


def test_a_file_is_no_folder(tmp_path):
    (tmp_path / "out").write_text("")
    with pytest.raises(TowtankError, match="this is a file"):
        require_folder(tmp_path / "out", ONE["format"])
