"""Long histories: block means and rows in pieces, from one file or all runs of an object."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.formats import log_rows
from towtank.formats.log_files import iter_solver_log, read_log_blocks, runs_at, runs_with_layouts
from towtank.formats.solver_log import EmptyLogError

HEAD = "# Force\n# Time (total_x total_y total_z)\n"


@pytest.fixture
def objects(tmp_path):
    """A function object with two runs of which the second begins before the end of the first."""
    for start, first, last in (("0", 1, 60), ("40", 41, 100)):
        folder = tmp_path / "postProcessing" / "forces" / start
        folder.mkdir(parents=True)
        rows = "".join(f"{i}\t({start} {i} 0)\n" for i in range(first, last + 1))
        (folder / "force.dat").write_text(HEAD + rows)
    return tmp_path / "postProcessing" / "forces"


def test_all_runs_of_an_object(objects):
    found = runs_at(objects / "force.dat")
    assert [file.parent.name for file in found] == ["0", "40"]
    assert runs_at(objects / "0" / "force.dat") == [objects / "0" / "force.dat"]
    with pytest.raises(ReadError, match="there is no such file"):
        runs_at(objects / "moment.dat")


def test_runs_without_rows_are_left_out(objects):
    (objects / "90").mkdir()
    (objects / "90" / "force.dat").write_text(HEAD)
    assert len(runs_with_layouts(objects / "force.dat")) == 2
    for start in ("0", "40"):
        (objects / start / "force.dat").write_text(HEAD)
    with pytest.raises(EmptyLogError, match="none of the runs wrote rows"):
        runs_with_layouts(objects / "force.dat")


def test_rows_in_pieces(objects, monkeypatch):
    monkeypatch.setattr(log_rows, "PIECE", 100)
    frames = list(iter_solver_log(objects / "force.dat", columns=["Fx_total"], start=30, stop=50))
    assert len(frames) > 3
    whole = pd.concat(frames)
    assert list(whole.columns) == ["time", "Fx_total"]
    assert whole["time"].tolist() == list(range(30, 51))
    assert whole["Fx_total"].tolist() == [0.0] * 11 + [40.0] * 10


def test_block_means_of_all_runs(objects):
    found = read_log_blocks(objects / "force.dat", 25, columns=["Fy_total"])
    assert found.counts.tolist() == [25] * 4
    assert found.log.frame["Fy_total"].tolist() == [13, 38, 63, 88]
    assert np.allclose(found.deviations["Fy_total"], np.sqrt((25**2 - 1) / 12))
    assert [restart.start for restart in found.log.restarts] == [41]
