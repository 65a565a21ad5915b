"""The objects that readers of solvers return."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.formats.solver_log import Restart, SolverCase, SolverLog


def log(name: str, kind: str) -> SolverLog:
    frame = pd.DataFrame({"time": [0.0, 0.1, 0.3, 0.4], "a": 1.0})
    return SolverLog(name, kind, frame, {}, (), header={"CofR": "(1.5e+00 -2 .25)", "title": "Forces"})


CASE = SolverCase(
    "run", Path("run"), {one.name: one for one in (log("f", "forces"), log("g", "forces"), log("m", "motion"))}
)


def test_a_history():
    one = log("f", "forces")
    assert (len(one), one.index_name) == (4, "time")
    assert one.dt == pytest.approx(0.1)
    assert one.vector("CofR") == (1.5, -2.0, 0.25)
    assert one.vector("Aref") is None


def test_histories_of_a_case_by_kind_and_name():
    assert [one.name for one in CASE.of_kind("forces")] == ["f", "g"]
    assert CASE.log("motion").name == "m"
    assert CASE.log("forces", "g").name == "g"


def test_none_and_several():
    with pytest.raises(ReadError, match=r"2 histories of kind forces -> name one of f, g"):
        CASE.log("forces")
    with pytest.raises(ReadError, match=r"no probes -> .* it has f \(forces\), g \(forces\), m \(motion\)"):
        CASE.log("probes")
    with pytest.raises(ReadError, match="no forces named 'h'"):
        CASE.log("forces", "h")


def test_what_was_not_read_is_said_where_it_is_missed():
    case = SolverCase(
        "run", Path("run"), {"m": log("m", "motion")}, ("forces/force: not read, the file is empty",)
    )
    with pytest.raises(ReadError, match="forces/force: not read, the file is empty"):
        case.log("forces")


def test_a_restart_in_words():
    assert (
        "restarted at 2 (a.dat); the run before ended at 3.5, 4 of its" in Restart(Path("a.dat"), 2, 3.5, 4).text
    )
