"""Folders with one file for each monitor: one history of forces, or a named error."""

from __future__ import annotations

from pathlib import Path

import pytest

from towtank.core.errors import ReadError
from towtank.formats import read_solver_case

TIME = '"Physical Time: Physical Time (s)"'


def star(folder: Path, name: str, unit: str, rows: dict[float, float], index: str = TIME) -> Path:
    """``name.csv`` as STAR-CCM+ exports one monitor."""
    body = "".join(f"{at!r},{value!r}\n" for at, value in rows.items())
    file = folder / f"{name}.csv"
    file.write_text(f'{index},"{name} Monitor: {name} ({unit})"\n{body}')
    return file


def fluent(folder: Path, name: str, rows: dict[float, float], column: str | None = None) -> Path:
    """``name.out`` as Fluent writes one report."""
    said = column or name
    body = "".join(f"{step} {value!r} {at!r}\n" for step, (at, value) in enumerate(rows.items(), 1))
    file = folder / f"{name}.out"
    file.write_text(f'"{said}-rfile"\n"Time Step" "{said} etc.."\n("Time Step" "{said}" "flow-time")\n{body}')
    return file


def rows(first: float, count: int = 4, step: float = 0.1) -> dict[float, float]:
    return {round(step * (k + 1), 6): first + k for k in range(count)}


def test_one_monitor_a_file_is_one_history(tmp_path):
    star(tmp_path, "Force X", "kN", rows(1.0))
    star(tmp_path, "Force X Pressure", "kN", rows(0.5))
    star(tmp_path, "Shear Force X", "N", rows(7.0))
    star(tmp_path, "Moment Z", "N-m", rows(30.0))
    star(tmp_path, "Sinkage", "m", rows(0.0))
    case = read_solver_case(tmp_path)
    log = case.log("forces")
    assert set(log.frame.columns) == {"time", "Fx_total", "Fx_pressure", "Fx_viscous", "Mz_total"}
    assert log.frame["Fx_total"].tolist() == [1000.0, 2000.0, 3000.0, 4000.0]
    assert log.frame["Fx_viscous"].tolist() == [7.0, 8.0, 9.0, 10.0]
    assert (log.units["Fx_total"], log.units["Mz_total"]) == ("N", "N m")
    assert {file.name for file in log.files} == {
        "Force X.csv",
        "Force X Pressure.csv",
        "Shear Force X.csv",
        "Moment Z.csv",
    }
    assert "Fx_viscous from Shear Force X of Shear Force X.csv" in log.notes[0]
    assert [one.name for one in case.of_kind("monitor")] == ["Sinkage"]


def test_reports_without_units_wait_for_a_map(tmp_path):
    fluent(tmp_path, "force-x", rows(1.0))
    fluent(tmp_path, "moment-z", rows(30.0), column="report-def-1")
    assert not read_solver_case(tmp_path).of_kind("forces")
    # The name of the file stands for its only monitor.
    log = read_solver_case(tmp_path, channels={"Fx_total": "force-x [N]", "Mz_total": "moment-z [kN m]"}).log(
        "forces"
    )
    assert log.frame.to_numpy().tolist()[0] == [0.1, 1.0, 30000.0]
    with pytest.raises(
        ReadError, match=r"force-x.out, channel Fx_total: column 'force-x' has no unit.*force-x \[N\]"
    ):
        read_solver_case(tmp_path, channels={"Fx_total": "force-x", "Mz_total": "moment-z [N m]"})


def test_signs_and_columns_of_two_files_by_a_map(tmp_path):
    star(tmp_path, "Drag", "N", rows(1.0))
    star(tmp_path, "Yaw", "N-m", rows(2.0))
    channels = {"Fx_total": {"column": "Drag", "sign": -1}, "Mz_total": "Yaw"}
    case = read_solver_case(tmp_path, channels=channels)
    assert case.log("forces").frame.to_numpy().tolist()[1] == [0.2, -2.0, 3.0]
    assert list(case.logs) == ["forces"]


def test_a_monitor_exported_later_has_more_rows(tmp_path):
    star(tmp_path, "Force X", "N", rows(1.0, count=6))
    star(tmp_path, "Force Y", "N", rows(1.0, count=4))
    log = read_solver_case(tmp_path).log("forces")
    assert log.frame["time"].tolist() == [0.1, 0.2, 0.3, 0.4]
    assert "2 row(s) that only some of Force X, Force Y have were left out" in log.notes


def test_times_printed_with_other_digits_are_the_same(tmp_path):
    star(tmp_path, "Force X", "N", {0.1: 1.0, 0.2: 2.0, 0.3: 3.0})
    star(tmp_path, "Force Y", "N", {0.1: 1.0, 0.2: 2.0, 0.30000000000000004: 3.0})
    assert len(read_solver_case(tmp_path).log("forces")) == 3


@pytest.mark.parametrize(
    ("other", "cause"),
    [
        (
            rows(1.0, count=8, step=0.05),
            r"'Force X' \(steps of 0.1\) and 'Force Y' \(steps of 0.05\) have other times",
        ),
        ({5.0: 1.0, 5.1: 2.0}, r"have other times"),
    ],
)
def test_other_times_are_an_error(tmp_path, other, cause):
    star(tmp_path, "Force X", "N", rows(1.0))
    star(tmp_path, "Force Y", "N", other)
    with pytest.raises(ReadError, match=cause) as raised:
        read_solver_case(tmp_path)
    assert "at the same steps" in raised.value.cure
    assert "Force Y.csv" in str(raised.value)


def test_time_and_iterations_are_an_error(tmp_path):
    star(tmp_path, "Force X", "N", rows(1.0))
    star(tmp_path, "Force Y", "N", {1: 1.0, 2: 2.0}, index='"Iteration: Iteration"')
    with pytest.raises(ReadError, match=r"'Force X' counts time and 'Force Y' iterations -> export all monitors"):
        read_solver_case(tmp_path)


@pytest.mark.parametrize(
    ("channels", "cause"),
    [
        (
            {"Fx_total": "Force X", "Fy_total": "Force Q"},
            r"no file has the column 'Force Q' -> .*Force X \(Force X.csv",
        ),
        ({"Fx_total": "Force X", "Mz_total": "Yaw"}, r"unit 'N' of column 'Yaw' is no moment"),
        (
            {"Fx_total": "Force X", "Fy_total": "Side"},
            r"the column 'Side' stands in 2 files -> name the file instead: a, b",
        ),
    ],
)
def test_maps_that_do_not_fit(tmp_path, channels, cause):
    star(tmp_path, "Force X", "N", rows(1.0))
    star(tmp_path, "Yaw", "N", rows(1.0))
    for name in ("a", "b"):
        star(tmp_path, "Side", "N", rows(1.0)).rename(tmp_path / f"{name}.csv")
    with pytest.raises(ReadError, match=cause):
        read_solver_case(tmp_path, channels=channels)


def test_names_that_two_monitors_claim_or_that_say_something_else_are_left(tmp_path):
    star(tmp_path, "Fx", "N", rows(1.0))
    star(tmp_path, "Force X", "N", rows(2.0))
    star(tmp_path, "Force Y", "deg", rows(2.0))
    star(tmp_path, "Rudder Force Y", "N", rows(2.0))
    assert not read_solver_case(tmp_path).of_kind("forces")


def test_one_file_of_named_forces_keeps_its_name(tmp_path):
    file = tmp_path / "hull.csv"
    file.write_text(
        f'{TIME},"Force X Monitor: Force X (N)","Moment Z Monitor: Moment Z (N-m)"\n0.1,5,2\n0.2,6,3\n'
    )
    for path in (file, tmp_path):
        log = read_solver_case(path).log("forces")
        assert log.name == "hull"
        assert log.frame["Mz_total"].tolist() == [2.0, 3.0]


def test_cross_talk_over_files_is_refused(tmp_path):
    star(tmp_path, "Drag", "N", rows(1.0))
    star(tmp_path, "Side", "N", rows(2.0))
    channels = {
        "Fx_total": "Drag",
        "Fy_total": "Side",
        "crosstalk": [[1.0, 0.1], [0.1, 1.0]],
        "crosstalk_channels": ["Fx_total", "Fy_total"],
    }
    with pytest.raises(ReadError, match=r"cross-talk .* several files -> export the monitors into one file"):
        read_solver_case(tmp_path, channels=channels)
