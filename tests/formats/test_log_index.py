"""The times of a log, found without reading the rest of the lines."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from towtank.formats import log_index, log_rows
from towtank.formats.log_index import first_index, index_blocks, last_index
from towtank.formats.log_layout import LogLayout

LAYOUT = LogLayout("OpenFOAM", "monitor", ("time", "a"), {}, 0)
TIME = st.one_of(st.integers(0, 20).map(str), st.sampled_from(["nan", "1e-310", "12345678901234567890.5", "N/A"]))
LINE = st.one_of(
    TIME.map(lambda time: f"{time}\t(2.5)"),
    TIME.map(lambda time: f"  {time} 7"),
    st.sampled_from(["", "# Time a", "3", "4 5 6", "Time a", " \t", "((8) 9)", "0.5 1# Forces"]),
)


def times(path, layout=LAYOUT) -> list[float]:
    return [float(time) for block in index_blocks(path, layout) for time in block]


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(LINE, max_size=40), st.booleans(), st.integers(20, 200))
def test_where_the_time_goes_back_is_found(tmp_path, monkeypatch, lines, ended, piece):
    path = tmp_path / "log.dat"
    path.write_text("\n".join(lines) + "\n" * ended)
    monkeypatch.setattr(log_index, "PIECE", 10**6)
    slow = times(path)
    monkeypatch.setattr(log_rows, "PIECE", piece)
    monkeypatch.setattr(log_index, "PIECE", 0)
    fast = times(path)
    # Lines that are no rows may stand between, but never at the beginning of a run.
    starts = [slow[row] for row in np.flatnonzero(np.diff(slow, prepend=np.inf) < 0)]
    found = [fast[row] for row in np.flatnonzero(np.diff(fast, prepend=np.inf) < 0)]
    remaining = iter(found)
    assert all(start in remaining for start in starts)
    assert set(slow) <= set(fast)
    assert first_index(path, LAYOUT) == (slow[0] if slow else None)


def test_a_cut_time_does_not_take_a_run_back(tmp_path, monkeypatch):
    monkeypatch.setattr(log_index, "PIECE", 0)
    path = tmp_path / "log.dat"
    path.write_text("12.3 1\n12.4 1\n1# Forces\n12.5 1\n")
    assert times(path) == [12.3, 12.4, 12.5]


@pytest.mark.parametrize("delimiter", [",", ";"])
def test_empty_times(tmp_path, monkeypatch, delimiter):
    monkeypatch.setattr(log_index, "PIECE", 0)
    path = tmp_path / "log.csv"
    path.write_text("1,5\n,6\n3,7\n".replace(",", delimiter))
    assert times(path, LogLayout("columns", "monitor", ("time", "a"), {}, 0, delimiter=delimiter)) == [1, 3]


def test_a_time_that_is_not_the_first_column(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("5 1\n6 2\n")
    assert times(path, LogLayout("columns", "monitor", ("a", "time"), {}, 0)) == [1, 2]


def test_the_first_time(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("# Time a\n\nnan 1\n2\n2.5 3\n")
    assert first_index(path, LAYOUT) == 2.5
    path.write_text("# Time a\n")
    assert first_index(path, LAYOUT) is None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.1 1\n0.2 1\n0.4 1\n", (0.2, 0.4)),
        ("0.1 1\n0.2 1\n0.4 ", (0.1, 0.2)),
        ("0.1 1\n0.2 1\n# Time a\n", (0.1, 0.2)),
        ("0.1 1\n", (np.nan, 0.1)),
        ("", (np.nan, np.nan)),
    ],
)
def test_last_two_times(tmp_path, text, expected):
    path = tmp_path / "log.dat"
    path.write_text(text)
    np.testing.assert_equal(last_index(path, LAYOUT), expected)


def test_last_times_of_a_long_file_begin_within_a_line(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("".join(f"{i} {i * 0.1:.30f}\n" for i in range(5000)))
    assert last_index(path, LAYOUT) == (4998.0, 4999.0)
