"""One history in memory: cut where it diverged, and forces beside moments."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.formats.log_layout import LogLayout
from towtank.formats.log_series import merged, read_series
from towtank.formats.log_stream import Selection
from towtank.formats.solver_log import Restart, SolverLog

EVERYTHING = Selection()


def layout(*names: str) -> LogLayout:
    return LogLayout(
        "OpenFOAM", "forces", ("time", *names), {"time": "s", "a": "N"}, 0, header={"CofR": "(0 0 0)"}
    )


def log(name: str, times: list[float], **more: object) -> SolverLog:
    frame = pd.DataFrame({"time": times, name: np.arange(len(times), dtype=float)})
    return SolverLog(name, "forces", frame, {"time": "s", name: "N"}, (Path(f"{name}.dat"),), **more)


def test_a_history_is_kept_up_to_its_divergence(tmp_path):
    path = tmp_path / "force.dat"
    path.write_text("1 2 3\n2 3 4\n3 1e30 5\n4 nan 6\n5 nan nan\n")
    found = read_series([(path, layout("a", "b"))], "forces", EVERYTHING)
    assert found.frame.to_numpy().tolist() == [[1, 2, 3], [2, 3, 4], [3, 1e30, 5]]
    assert found.diverged_at == 4.0
    assert found.notes == ("diverged: a is nan or inf from time 4 on; 2 row(s) from there were left out",)
    assert (found.units, found.files, found.header) == (
        {"time": "s", "a": "N", "b": ""},
        (path,),
        {"CofR": "(0 0 0)"},
    )
    assert list(found.frame.columns) == ["time", "a", "b"]


def test_a_restart_behind_a_divergence_mends_it(tmp_path):
    old, new = tmp_path / "0.dat", tmp_path / "1.dat"
    old.write_text("1 2\n2 3\n3 nan\n4 nan\n")
    new.write_text("2.5 4\n3.5 5\n")
    found = read_series([(old, layout("a")), (new, layout("a"))], "forces", EVERYTHING)
    assert found.frame["time"].tolist() == [1, 2, 2.5, 3.5]
    assert (found.diverged_at, found.notes, len(found.restarts)) == (None, (), 1)


def test_a_run_that_diverged_at_once(tmp_path):
    path = tmp_path / "force.dat"
    path.write_text("1 nan\n2 nan\n")
    with pytest.raises(ReadError, match=r"force.dat: every value is nan or inf from the first row on"):
        read_series([(path, layout("a"))], "forces", EVERYTHING)


@pytest.mark.parametrize(
    ("selection", "cause"),
    [(EVERYTHING, "there are no whole data rows"), (Selection(start=9.0), "there are no rows in the time range")],
)
def test_no_rows(tmp_path, selection, cause):
    path = tmp_path / "force.dat"
    path.write_text("1" if selection is EVERYTHING else "1 2\n")
    with pytest.raises(ReadError, match=cause):
        read_series([(path, layout("a"))], "forces", selection)


def test_histories_side_by_side():
    found = merged([log("F", [1, 2, 3]), log("M", [1, 2, 3])], "forces")
    assert list(found.frame.columns) == ["time", "F", "M"]
    assert (found.name, found.notes) == ("forces", ())


def test_only_common_times_are_kept_and_that_is_told():
    ends = [4.0, None]
    first, second = (log(n, t, diverged_at=e) for n, t, e in zip("FM", ([1, 2, 3, 4], [2, 3, 5]), ends))
    found = merged([first, second], "forces")
    assert found.frame.to_numpy().tolist() == [[2, 1, 0], [3, 2, 1]]
    assert found.notes == ("2 row(s) that only some of F, M have were left out",)
    assert found.diverged_at == 4.0


def test_a_restart_of_both_is_told_once(tmp_path):
    one, other = (Restart(tmp_path / name, 2.0, 3.0, 1) for name in ("force.dat", "moment.dat"))
    found = merged([log("F", [1, 2], restarts=(one,)), log("M", [1, 2], restarts=(other,))], "forces")
    assert found.restarts == (one,)


def test_no_common_times():
    with pytest.raises(ReadError, match=r"no common times"):
        merged([log("F", [1, 2]), log("M", [1.5, 2.5])], "forces")
