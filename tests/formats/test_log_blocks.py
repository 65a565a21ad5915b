"""Means over blocks of time are those of all rows, however the file is cut into pieces."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.formats import log_rows
from towtank.formats.log_blocks import read_block_series
from towtank.formats.log_layout import LogLayout
from towtank.formats.log_stream import Selection

LAYOUT = LogLayout("columns", "monitor", ("time", "a", "b"), {"a": "N"}, 0)


def write(path, frame: pd.DataFrame) -> None:
    path.write_text("".join(f"{t!r} {a!r} {b!r}\n" for t, a, b in frame.to_numpy().tolist()))


@pytest.mark.parametrize("piece", [40, 333, 10**6])
def test_blocks_of_all_rows(tmp_path, monkeypatch, piece):
    monkeypatch.setattr(log_rows, "PIECE", piece)
    rng = np.random.default_rng(3)
    frame = pd.DataFrame(
        {"time": np.cumsum(rng.uniform(0.01, 0.2, 300)), "a": 1e6 + rng.normal(size=300), "b": 1.0}
    )
    path = tmp_path / "log.dat"
    write(path, frame)
    found = read_block_series([(path, LAYOUT)], "log", 1.5, Selection())
    groups = frame.groupby(np.floor((frame["time"] - frame["time"][0]) / 1.5))
    assert np.allclose(found.log.frame, groups.mean(), rtol=1e-14)
    assert np.allclose(found.deviations, groups.std(ddof=0), rtol=1e-6, atol=1e-9)
    assert np.allclose(found.lows, groups.min(), rtol=1e-15)
    assert np.allclose(found.highs, groups.max(), rtol=1e-15)
    assert found.counts.tolist() == groups.size().tolist()
    assert found.log.units["a"] == "N"
    sizes = groups.size()
    assert (
        found.log.notes[0]
        == f"means over blocks of 1.5: {len(sizes)} blocks of {sizes.min()} to {sizes.max()} rows"
    )


def test_missing_values_do_not_count(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("0 1 N/A\n1 3 N/A\n2 5 N/A\n3 N/A 8\n")
    found = read_block_series([(path, LAYOUT)], "log", 2.0, Selection())
    assert np.array_equal(found.log.frame, [[0.5, 2, np.nan], [2.5, 5, 8]], equal_nan=True)
    assert np.array_equal(found.highs["b"], [np.nan, 8], equal_nan=True)
    assert found.counts.tolist() == [2, 2]


def test_the_block_in_which_it_diverged_is_left_out(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("".join(f"{i} {i} {'nan' if i > 4 else 1}\n" for i in range(8)))
    found = read_block_series([(path, LAYOUT)], "log", 2.0, Selection())
    assert found.log.frame["time"].tolist() == [0.5, 2.5]
    assert found.log.diverged_at == 5.0
    assert found.log.notes[-1] == "diverged: b is nan or inf from time 5 on; 4 row(s) from there were left out"
    with pytest.raises(ReadError, match="diverged at 5, within the first block -> take blocks shorter than 10"):
        read_block_series([(path, LAYOUT)], "log", 10.0, Selection())


def test_gaps_leave_no_blocks(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("0 1 2\n1 1 2\n50 3 4\n")
    found = read_block_series([(path, LAYOUT)], "log", 2.0, Selection())
    assert found.counts.tolist() == [2, 1]


def test_totals_have_their_own_deviations(tmp_path):
    names = ("time", "Fx_pressure", "Fx_viscous")
    path = tmp_path / "forces.dat"
    path.write_text("0 1 -1\n1 2 -2\n")
    found = read_block_series([(path, LogLayout("OpenFOAM", "forces", names, {}, 0))], "forces", 5.0, Selection())
    assert found.log.frame["Fx_total"].tolist() == [0.0]
    assert (found.deviations["Fx_total"][0], found.deviations["Fx_viscous"][0]) == (0.0, 0.5)
    assert found.log.units["Fx_total"] == "N"
    assert found.log.notes[-1] == "totals are the sum of the parts: pressure + viscous"


def test_a_length_that_is_none(tmp_path):
    with pytest.raises(ReadError, match="blocks of length 0 are no blocks"):
        read_block_series([(tmp_path / "x", LAYOUT)], "log", 0.0, Selection())
