"""Files of function objects are found below their start times, oldest run first."""

from __future__ import annotations

from pathlib import Path

import pytest

from towtank.formats.openfoam_case import is_time, post_processing_folder, run_files


def touch(folder: Path, *names: str) -> None:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("x")


@pytest.mark.parametrize(
    ("name", "expected"),
    [("0", True), ("12.5", True), ("1e-05", True), ("0.orig", False), ("nan", False), ("-1", False)],
)
def test_folders_named_after_a_time(name, expected):
    assert is_time(name) is expected


def test_start_times_are_numbers(tmp_path):
    touch(tmp_path, "forces/10/force.dat", "forces/9.5/force.dat", "forces/0/force.dat", "forces/0/moment.dat")
    found = run_files(tmp_path)
    assert [file.parent.name for file in found["forces"]["force"]] == ["0", "9.5", "10"]
    assert list(found["forces"]) == ["force", "moment"]


def test_a_second_run_from_the_same_time_is_newer(tmp_path):
    touch(tmp_path, "forces/0/force_0.dat", "forces/0/force.dat", "forces/2/force.dat")
    found = run_files(tmp_path)["forces"]["force"]
    assert [f"{file.parent.name}/{file.name}" for file in found] == ["0/force.dat", "0/force_0.dat", "2/force.dat"]


def test_a_field_whose_name_ends_in_a_number(tmp_path):
    touch(tmp_path, "probes/0/T_1", "probes/0/U")
    assert list(run_files(tmp_path)["probes"]) == ["T_1", "U"]


def test_regions_surfaces_and_hidden_files(tmp_path):
    touch(tmp_path, "water/forces/0/forces.dat", "surf/0/hull.vtk", "surf/0/deep/p.dat", "forces/0/.force.dat.swp")
    assert list(run_files(tmp_path)) == ["water/forces"]


def test_the_fields_of_a_case_are_no_histories(tmp_path):
    touch(tmp_path, "system/controlDict", "constant/g", "0/U", "5/U", "forces/0/forces.dat", "processor0/5/U")
    assert list(run_files(tmp_path)) == ["forces"]
    assert post_processing_folder(tmp_path) == tmp_path
    touch(tmp_path, "postProcessing/forces/0/force.dat")
    assert post_processing_folder(tmp_path) == tmp_path / "postProcessing"


def test_one_object(tmp_path):
    touch(tmp_path, "forces/0/force.dat")
    assert list(run_files(tmp_path / "forces")) == ["forces"]


def test_a_folder_of_other_files_is_no_case(tmp_path):
    touch(tmp_path, "force.csv")
    assert post_processing_folder(tmp_path) is None
