"""Runs are joined so that every row replaces all earlier ones of its own or a later time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from towtank.core.errors import ReadError
from towtank.formats import log_rows
from towtank.formats.log_layout import LogLayout
from towtank.formats.log_stream import LogStream, Selection

LAYOUT = LogLayout("columns", "monitor", ("time", "a"), {}, 0)
STEPS = st.lists(st.sampled_from([1, 1, 1, 1, 2, 0, -3]), min_size=0, max_size=25)
RUNS = st.lists(st.tuples(st.integers(0, 12), STEPS), min_size=1, max_size=4)


def write(folder: Path, runs: list[list[float]]) -> list[tuple[Path, LogLayout]]:
    """One file for each run; column ``a`` numbers the rows through all of them."""
    count = 0
    files = []
    for number, times in enumerate(runs):
        path = folder / f"{number}.dat"
        path.write_text("".join(f"{time} {count + i}\n" for i, time in enumerate(times)))
        files.append((path, LAYOUT))
        count += len(times)
    return files


def newest(times: np.ndarray) -> np.ndarray:
    """Rows before which no later row reaches back, by the definition."""
    return np.array([not (times[i + 1 :] <= time).any() for i, time in enumerate(times)], dtype=bool)


class Rows:
    """Keeps all blocks."""

    def __init__(self) -> None:
        self.blocks: list[np.ndarray] = [np.empty((2, 0))]

    def add(self, block: np.ndarray) -> None:
        self.blocks.append(block)


def joined(stream: LogStream) -> np.ndarray:
    return np.concatenate(stream.into(Rows).blocks, axis=1)


@settings(deadline=None, max_examples=80, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(RUNS, st.integers(3, 300))
def test_the_newest_rows_stay(tmp_path, monkeypatch, runs, piece):
    monkeypatch.setattr(log_rows, "PIECE", piece)
    times = [list(np.cumsum([first, *steps]).tolist()) for first, steps in runs]
    files = write(tmp_path, times)
    every = np.concatenate([np.array(part, dtype=float) for part in times])
    expected = np.flatnonzero(newest(every))
    stream = LogStream(files)
    assert np.array_equal(joined(stream), [every[expected], expected])
    again = np.concatenate([np.empty((2, 0)), *stream.blocks()], axis=1)
    assert np.array_equal(again[1], expected)


def test_restarts_are_told(tmp_path):
    files = write(tmp_path, [[0, 1, 2, 3, 4], [2.5, 3.5, 4.5], [5.5, 6.5]])
    stream = LogStream(files)
    assert joined(stream)[0].tolist() == [0, 1, 2, 2.5, 3.5, 4.5, 5.5, 6.5]
    (restart,) = stream.restarts
    assert (restart.file, restart.start, restart.previous_end, restart.rows_dropped) == (files[1][0], 2.5, 4.0, 2)
    assert restart.text == "restarted at 2.5 (1.dat); the run before ended at 4, 2 of its rows were replaced"


def test_a_restart_replaces_also_what_it_does_not_reach(tmp_path):
    # The run from 2 on crashed at 3; what the run before wrote up to 9 is another history.
    stream = LogStream(write(tmp_path, [list(range(10)), [2, 3]]))
    assert joined(stream)[0].tolist() == [0, 1, 2, 3]
    assert stream.restarts[0].rows_dropped == 8


def test_a_restart_before_the_range_still_replaces(tmp_path):
    stream = LogStream(write(tmp_path, [list(range(10)), [2, 3]]), Selection(start=1, stop=8))
    assert joined(stream)[0].tolist() == [1, 2, 3]


def test_rows_of_one_time_in_a_run(tmp_path):
    stream = LogStream(write(tmp_path, [[1, 1, 1, 2, 2]]))
    assert joined(stream).tolist() == [[1, 2], [2, 4]]
    assert stream.restarts == []
    assert stream.notes == ["3 row(s) repeat the time of the next one, which is kept"]


def test_a_time_that_is_none(tmp_path):
    stream = LogStream(write(tmp_path, [[3, 1] * 40]))
    with pytest.raises(ReadError, match=r"the time goes back .* name it in the channel map"):
        joined(stream)


def test_range_and_columns(tmp_path):
    files = write(tmp_path, [list(range(10))])
    assert joined(LogStream(files, Selection(start=2, stop=4)))[0].tolist() == [2, 3, 4]
    with pytest.raises(ReadError, match=r"there is no column 'b' -> the file has time, a"):
        LogStream(files, Selection(columns=("b",)))
    with pytest.raises(ReadError, match=r"from 4 to 2 is empty"):
        Selection(start=4, stop=2)


def test_the_index_comes_first_wherever_it_stands(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("7 8 0.5\n9 10 1.0\n")
    stream = LogStream(
        [(path, LogLayout("columns", "monitor", ("a", "b", "time"), {}, 0))], Selection(columns=("b",))
    )
    assert stream.names == ["time", "b"]
    assert joined(stream).tolist() == [[0.5, 1.0], [8.0, 10.0]]


def test_columns_that_only_some_runs_have(tmp_path):
    old, new = tmp_path / "0.dat", tmp_path / "1.dat"
    old.write_text("1 5 6\n")
    new.write_text("2 8 7\n")
    layouts = [LogLayout("columns", "monitor", names, {}, 0) for names in (("time", "a", "b"), ("time", "c", "a"))]
    stream = LogStream([(old, layouts[0]), (new, layouts[1])])
    assert stream.names == ["time", "a"]
    assert joined(stream).tolist() == [[1, 2], [5, 7]]
    assert stream.notes == ["column(s) that not every run wrote are left out: b, c"]


def test_a_header_that_changes_is_told(tmp_path):
    files = write(tmp_path, [[1], [2]])
    headers = ({"CofR": "(0 0 0)"}, {"CofR": "(1 0 0)"})
    files = [
        (path, LogLayout("OpenFOAM", "forces", ("time", "a"), {}, 0, header=h))
        for (path, _), h in zip(files, headers)
    ]
    stream = LogStream(files)
    joined(stream)
    assert stream.notes == [f"CofR changes from (0 0 0) to (1 0 0) at {tmp_path.name}"]


def test_runs_that_count_differently(tmp_path):
    files = write(tmp_path, [[1], [2]])
    steady = LogLayout("columns", "monitor", ("iteration", "a"), {}, 0)
    with pytest.raises(ReadError, match=r"count differently"):
        LogStream([files[0], (files[1][0], steady)])


def test_probes_outside_the_mesh_have_no_value(tmp_path):
    path = tmp_path / "p"
    path.write_text("1 -1e+300\n2 -1e+300\n")
    stream = LogStream([(path, LogLayout("OpenFOAM", "probes", ("time", "p_0"), {}, 0))])
    assert np.isnan(joined(stream)[1]).all()


def test_rows_without_a_time_are_told(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("1 5\nnan 6\n2 7\n")
    stream = LogStream([(path, LAYOUT)])
    assert joined(stream).tolist() == [[1, 2], [5, 7]]
    assert stream.notes == ["1 row(s) without a time were left out"]
