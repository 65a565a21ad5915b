"""Whole cases, from folders as solvers leave them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats import EmptyLogError, read_solver_case, read_solver_log

LABELS = "\t(total_x total_y total_z)\t(pressure_x pressure_y pressure_z)\t(viscous_x viscous_y viscous_z)"


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def history(what: str, first: int, last: int, level: float, tail: str = "") -> str:
    """A force.dat or moment.dat of one row a tenth of a second."""
    rows = [f"{i / 10:g}\t({level + 1} 2 3)\t({level} 1 1)\t(1 1 2)\n" for i in range(first, last + 1)]
    return f"# {what}\n# CofR          : (1.0e+00 0 2.0e-01)\n#\n# Time          {LABELS}\n{''.join(rows)}{tail}"


@pytest.fixture
def case(tmp_path):
    """An OpenFOAM case with a restart at 8 s whose last line is cut."""
    folder = tmp_path / "drift_06"
    for name in ("system/controlDict", "constant/g", "0/U", "8/U"):
        write(folder, name, "FoamFile")
    for what in ("force", "moment"):
        write(folder, f"postProcessing/hull/0/{what}.dat", history(what.title(), 1, 100, 5))
        tail = "12.1\t(7 2 3)\t(6" if what == "force" else ""
        write(folder, f"postProcessing/hull/8/{what}.dat", history(what.title(), 81, 120, 6, tail))
    coefficients = "# Force coefficients\n# Aref : 2\n# Time\tCd\tCl\n1\t0.4\t0.1\n2\t0.4\t0.1\n"
    write(folder, "postProcessing/coefficients/0/coefficient.dat", coefficients)
    probes = "# Probe 0 (0 0 1)\n# Time 0\n0.1 {}\n"
    write(folder, "postProcessing/gauges/0/p", probes.format("5"))
    write(folder, "postProcessing/gauges/0/U", probes.format("(1 2 3)"))
    write(folder, "postProcessing/cut/0/patch.dat", "hello there\n")
    return folder


@pytest.mark.parametrize("below", ["", "postProcessing"])
def test_an_openfoam_case(case, below):
    found = read_solver_case(case / below)
    assert found.name == "drift_06"
    assert {name: log.kind for name, log in found.logs.items()} == {
        "coefficients": "coefficients",
        "gauges/U": "probes",
        "gauges/p": "probes",
        "hull": "forces",
    }
    assert [note.partition(":")[0] for note in found.notes] == ["cut/patch"]


def test_restarts_are_joined_and_told(case):
    log = read_solver_case(case).log("forces")
    time = log.frame["time"].to_numpy()
    assert np.allclose(time, np.arange(1, 121) / 10)
    assert log.frame["Fx_total"].tolist() == [6.0] * 80 + [7.0] * 40
    assert log.frame["Mz_viscous"].tolist() == [2.0] * 120
    (restart,) = log.restarts
    assert (restart.start, restart.previous_end, restart.rows_dropped) == (8.1, 10.0, 20)
    assert "force.dat: the last line (45) is cut off and was left out" in log.notes
    assert log.vector("CofR") == (1.0, 0.0, 0.2)
    assert [file.parent.name for file in log.files] == ["0", "8", "0", "8"]


def test_chosen_objects_columns_and_times(case):
    found = read_solver_case(case, objects=["hull"], columns=["Fx_total", "Mz_total"], start=2, stop=3)
    log = found.log("forces")
    assert list(log.frame.columns) == ["time", "Fx_total", "Mz_total"]
    assert len(log) == 11
    assert list(read_solver_case(case, objects=["gauges/U"]).logs) == ["gauges/U", "gauges/p"]
    with pytest.raises(ReadError, match=r"no object 'keel' -> the case has coefficients, cut, gauges, hull"):
        read_solver_case(case, objects=["keel"])


def test_a_channel_map_is_not_for_a_case(case):
    with pytest.raises(ReadError, match="a channel map is for monitor files"):
        read_solver_case(case, channels={"X": "Fx"})


def test_block_means(case):
    log = read_solver_case(case, objects=["hull"], block=1.0).log("forces")
    assert len(log) == 12
    assert log.frame["Fx_total"].tolist() == [6.0] * 8 + [7.0] * 4
    assert "means over blocks of 1: 12 blocks of 10 to 10 rows" in log.notes


def test_forces_without_moments(case):
    for file in case.glob("postProcessing/hull/*/moment.dat"):
        file.unlink()
    log = read_solver_case(case).log("forces")
    assert not any(name.startswith("M") for name in log.frame)
    assert log.notes[-1] == "there is no file of moments"


def test_a_restart_that_wrote_a_header_only(case):
    write(case, "postProcessing/hull/12/force.dat", history("Force", 1, 0, 0))
    log = read_solver_case(case).log("forces")
    assert len(log) == 120
    assert "hull/12/force.dat: there are no data rows" in log.notes


def test_an_object_that_cannot_be_read_is_told_or_refused_if_it_is_named(case):
    for file in case.glob("postProcessing/hull/*/*.dat"):
        file.write_text("# Force\n# Time (total_x total_y total_z)\n")
    found = read_solver_case(case)
    assert "hull/force: not read, there are no data rows" in found.notes
    with pytest.raises(ReadError, match=r"no forces -> .*hull/force: not read, there are no data rows"):
        found.log("forces")
    with pytest.raises(EmptyLogError, match=r"force.dat: there are no data rows"):
        read_solver_case(case, objects=["hull"])


def test_nested_forces_get_totals(tmp_path):
    text = "# Forces\n# Time forces(pressure viscous) moment(pressure viscous)\n"
    text += "0.1 ((1 2 3) (4 5 6)) ((7 8 9) (1 1 1))\n0.2 ((1 2 3) (4 5 6)) ((7 8 9) (1 1 1))\n"
    write(tmp_path, "forces/0/forces.dat", text)
    log = read_solver_case(tmp_path, columns=["Fx_total", "Mz_pressure"]).log("forces")
    assert log.frame[["Fx_total", "Mz_pressure"]].to_numpy().tolist() == [[5, 9], [5, 9]]
    assert {"Fy_total", "Fy_pressure"}.isdisjoint(log.frame)


def test_nan_after_a_divergence(tmp_path):
    rows = [f"{i} ((1 2 3) (4 5 6)) ((7 8 9) (1 1 1))\n" for i in range(1, 6)]
    rows += [f"{i} ((nan nan -nan) (4 5 6)) ((7 8 9) (1 1 1))\n" for i in range(6, 9)]
    text = "# Forces\n# Time forces(pressure viscous) moment(pressure viscous)\n" + "".join(rows)
    path = write(tmp_path, "forces.dat", text)
    log = read_solver_log(path)
    assert (len(log), log.diverged_at) == (5, 6.0)
    assert log.notes[0].startswith("diverged: Fx_pressure is nan or inf from time 6 on; 3 row(s)")


def test_a_folder_of_monitors(tmp_path):
    write(
        tmp_path, "force.csv", '"Physical Time: Physical Time (s)","Force X Monitor: Force X (N)"\n0.1,5\n0.2,6\n'
    )
    write(tmp_path, "drag.out", '"d"\n"Iteration" "d etc.."\n("Iteration" "d")\n1 2\n2 3\n')
    write(tmp_path, "readme.txt", "how this was run\n")
    write(tmp_path, "mesh.sim", "not looked at")
    found = read_solver_case(tmp_path)
    assert {name: log.index_name for name, log in found.logs.items()} == {"drag": "iteration", "force": "time"}
    assert [note.partition(":")[0] for note in found.notes] == ["readme.txt"]
    assert list(read_solver_case(tmp_path, objects=["force"]).logs) == ["force"]
    with pytest.raises(ReadError, match=r"readme.txt"):
        read_solver_case(tmp_path, objects=["readme"])


def test_monitors_through_the_channel_map(tmp_path):
    path = write(tmp_path, "f.csv", '"Iteration","Fx Monitor: Fx (kN)","Mz Monitor: Mz (kN-m)"\n1,5,2\n2,6,3\n')
    channels = {"Fx_total": {"column": "Fx", "sign": -1}, "Mz_total": "Mz"}
    log = read_solver_case(path, channels=channels).log("forces")
    assert log.frame.to_numpy().tolist() == [[1, -5000, 2000], [2, -6000, 3000]]
    assert log.index_name == "iteration"


FINE_MARINE = "#  Time[s]   Fx_p[N]  Fx_v[N]\n 0.1  -10.0  -2.0\n 0.2  -11.0  -2.5\n 0.3  -11.0  -2.5\n"
REFRESCO = 'TITLE = "forces"\nVARIABLES = "timestep" "outerloop" "FXP" "FXF"\n' + "ZONE T='hull'\n"


def test_columns_in_the_style_of_fine_marine(tmp_path):
    path = write(tmp_path, "Effort.dat", FINE_MARINE)
    log = read_solver_log(path, channels={"time": "Time", "Fx_pressure": "Fx_p", "Fx_viscous": "Fx_v"})
    assert log.frame["Fx_total"].tolist() == [-12.0, -13.5, -13.5]
    assert log.units["Fx_total"] == "N"


def test_columns_in_the_style_of_refresco(tmp_path):
    path = write(tmp_path, "forces.dat", REFRESCO + "1 5 -10. -2.\n2 7 -11. -2.5\n3 6 -11. -2.5\n")
    channels = {
        name: {"column": column, "unit": "N"} for name, column in (("Fx_pressure", "FXP"), ("Fx_viscous", "FXF"))
    }
    log = read_solver_log(path, channels=channels)
    assert (log.kind, log.index_name) == ("forces", "iteration")
    assert log.frame["Fx_total"].tolist() == [-12.0, -13.5, -13.5]


def test_nothing_to_read(tmp_path):
    with pytest.raises(ReadError, match=r"holds no histories that can be read"):
        read_solver_case(tmp_path)
    with pytest.raises(ReadError, match=r"there is no such file"):
        read_solver_case(tmp_path / "gone")
    with pytest.raises(ReadError, match=r"no column 'Fq'"):
        read_solver_log(write(tmp_path, "a.dat", "time Fx\n1 2\n2 3\n"), columns=["Fq"])
