"""A case run again from an earlier time while later folders of the run before are still there."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from towtank.formats import GrowingLog, iter_solver_log, read_log_blocks, read_solver_case
from towtank.formats.log_dialects import layout_of
from towtank.formats.run_order import SURELY_LATER, in_run_order

DAY = 86_400.0
START = 1.7e9


def run(case: Path, start: str, first: float, last: float, level: float, written: float) -> Path:
    """``forces/<start>/force.dat`` of one row a tenth of a second, last written at a given time."""
    folder = case / "postProcessing" / "forces" / start
    folder.mkdir(parents=True, exist_ok=True)
    at = np.arange(round(10 * first), round(10 * last) + 1) / 10
    rows = "".join(f"{time:g}\t{level:g}\t1\t2\n" for time in at)
    for name in ("force", "moment"):
        file = folder / f"{name}.dat"
        file.write_text(f"# {name.title()}\n# CofR : (0 0 0)\n# Time\ttotal_x\ttotal_y\ttotal_z\n{rows}")
        os.utime(file, (START + written, START + written))
    return folder / "force.dat"


def forces(case: Path):
    return read_solver_case(case).log("forces")


def test_a_usual_restart_says_nothing(tmp_path):
    run(tmp_path, "0", 0.1, 10, 1.0, written=0)
    run(tmp_path, "8", 8.1, 12, 2.0, written=DAY)
    log = forces(tmp_path)
    assert log.frame["Fx_total"].tolist() == [1.0] * 80 + [2.0] * 40
    assert not any("newer than" in note for note in log.notes)


@pytest.mark.parametrize(
    ("last", "how"), [(10, "reaches into it"), (5, "stops before it"), (14, "reaches into it")]
)
def test_a_rerun_from_the_start_wins_over_what_was_left(tmp_path, last, how):
    run(tmp_path, "0", 0.1, last, 1.0, written=DAY)
    stale = run(tmp_path, "8", 8.1, 12, 2.0, written=0)
    log = forces(tmp_path)
    assert set(log.frame["Fx_total"]) == {1.0}
    assert log.frame["time"].iloc[-1] == last
    (note,) = [note for note in log.notes if "newer than" in note]
    assert "run 0, written 2023-11-15" in note
    assert "run 8, written 2023-11-14" in note
    assert how in note
    assert "folder 8 is left from a run before" in note
    path = stale.parents[1] / "force.dat"
    assert sum(len(frame) for frame in iter_solver_log(path)) == 10 * last
    assert read_log_blocks(path, 1.0).counts.sum() == 10 * last


def test_a_rerun_from_the_middle_wins_over_a_later_folder_only(tmp_path):
    run(tmp_path, "0", 0.1, 6, 1.0, written=0)
    run(tmp_path, "5", 5.1, 9, 2.0, written=2 * DAY)
    run(tmp_path, "8", 8.1, 12, 3.0, written=DAY)
    log = forces(tmp_path)
    assert log.frame["Fx_total"].tolist() == [1.0] * 50 + [2.0] * 40
    assert "folder 8 is left" in " ".join(log.notes)


def test_runs_that_end_where_the_next_begins_are_joined_and_told(tmp_path):
    run(tmp_path, "0", 0.1, 8, 1.0, written=DAY)
    run(tmp_path, "8", 8.1, 12, 2.0, written=0)
    log = forces(tmp_path)
    assert len(log) == 120
    assert "ends where it begins: joined by start time" in " ".join(log.notes)


def test_copies_within_a_minute_do_not_reorder_runs(tmp_path):
    run(tmp_path, "0", 0.1, 10, 1.0, written=SURELY_LATER - 5)
    run(tmp_path, "8", 8.1, 12, 2.0, written=0)
    log = forces(tmp_path)
    assert log.frame["Fx_total"].tolist() == [1.0] * 80 + [2.0] * 40
    assert "both may be copies: joined by start time; if it is stale, move folder 8 away" in " ".join(log.notes)


def test_order_of_one_and_of_files_copied_at_once(tmp_path):
    files = [run(tmp_path, start, float(start) + 0.1, float(start) + 3, 1.0, written=1.0) for start in ("0", "2")]
    found = [(file, layout_of(file)) for file in files]
    assert in_run_order(found) == (found, ())
    assert in_run_order(found[:1]) == (found[:1], ())


def test_a_growing_rerun_is_handed_out_behind_what_was_left(tmp_path):
    newer = run(tmp_path, "0", 0.1, 5, 1.0, written=DAY)
    run(tmp_path, "8", 8.1, 12, 2.0, written=0)
    growing = GrowingLog(newer.parents[1] / "force.dat")
    assert growing.read()["time"].iloc[-1] == 5.0
    assert [restart.start for restart in growing.restarts] == [0.1]
    with open(newer, "a") as file:
        file.write("5.1\t1\t1\t2\n")
    assert growing.read()["time"].tolist() == [5.1]
    assert len(growing.restarts) == 1
