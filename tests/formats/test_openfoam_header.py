"""Files of OpenFOAM's function objects, in the forms of both lines and several versions."""

from __future__ import annotations

from pathlib import Path

import pytest

from towtank.core.errors import ReadError
from towtank.formats.openfoam_header import openfoam_layout
from towtank.formats.solver_log import EmptyLogError

XYZ = ("x", "y", "z")


def layout(text: str, name: str = "force.dat"):
    return openfoam_layout(text.encode(), Path(name))


def parts(letter: str, *names: str) -> list[str]:
    return [f"{letter}{axis}_{part}" for part in names for axis in XYZ]


GROUPED = (
    "# Force         \n# CofR          : (1.000000e+00 0.0e+00 2.0e-01)\n#\n"
    "# Time          \t(total_x total_y total_z)\t(pressure_x pressure_y pressure_z)\t(viscous_x viscous_y viscous_z)\n"
    "1               \t(2.4e+02 1.4e+01 -7.8e+01)\t(2.4e+02 1.4e+01 -7.8e+01)\t(4.1e+00 1.0e-02 1.6e-01)\n"
)
FLAT = (
    "# Force\n# CofR : (0 0 0)\n#\n# Time\ttotal_x\ttotal_y\ttotal_z\tpressure_x\tpressure_y\tpressure_z"
    "\tviscous_x\tviscous_y\tviscous_z\n0.1\t1\t2\t3\t4\t5\t6\t7\t8\t9\n"
)
NESTED = "# Forces\n# CofR : (0 0 0)\n# Time forces(pressure viscous porous) moment(pressure viscous porous)\n"


@pytest.mark.parametrize("text", [GROUPED, FLAT], ids=["parentheses", "plain"])
@pytest.mark.parametrize(("name", "letter"), [("force.dat", "F"), ("moment.dat", "M"), ("force_0.5.dat", "F")])
def test_total_pressure_viscous_columns(text, name, letter):
    found = layout(text, name)
    assert found.kind == "forces"
    assert found.names == ("time", *parts(letter, "total", "pressure", "viscous"))
    assert found.units[f"{letter}x_total"] == {"F": "N", "M": "N m"}[letter]
    assert found.notes == ()
    assert text.encode()[found.first_byte :].lstrip().startswith((b"1", b"0.1"))


def test_header_entries():
    found = layout(GROUPED)
    assert found.header == {"title": "Force", "CofR": "(1.000000e+00 0.0e+00 2.0e-01)"}


def test_the_porous_part_and_its_later_name():
    porous = GROUPED.replace("viscous_z)\n", "viscous_z)\t(porous_x porous_y porous_z)\n", 1)
    found = layout(porous.replace("1.6e-01)\n", "1.6e-01)\t(0 0 0)\n"))
    assert found.names[-3:] == tuple(parts("F", "porous"))
    internal = layout(porous.replace("porous", "internal").replace("1.6e-01)\n", "1.6e-01)\t(0 0 0)\n"))
    assert internal.names == found.names
    assert internal.notes == ("the part that the solver calls internal is named porous",)


@pytest.mark.parametrize(
    ("label", "row", "expected"),
    [
        (
            "Time forces(pressure viscous porous) moment(pressure viscous porous)",
            "0.1 ((1 2 3) (4 5 6) (0 0 0)) ((7 8 9) (10 11 12) (0 0 0))",
            ["pressure", "viscous", "porous"],
        ),
        (
            "Time       \tforces(pressure, viscous) moment(pressure, viscous)",
            "0.1 \t(((1 2 3) (4 5 6)) ((7 8 9) (10 11 12)))",
            ["pressure", "viscous"],
        ),
        (
            "Time forces((pressure) (viscous)) (moments)",
            "1 ((1 2 3) (4 5 6)) ((7 8 9) (1 1 1))",
            ["pressure", "viscous"],
        ),
        ("Time forces(pressure) moment(pressure)", "0.1 ((1 2 3)) ((4 5 6))", ["pressure"]),
    ],
)
def test_nested_parentheses(label, row, expected):
    found = layout(f"# Forces\n# {label}\n{row}\n", "forces.dat")
    assert found.names == ("time", *parts("F", *expected), *parts("M", *expected))


def test_nested_rows_under_a_header_that_does_not_fit():
    found = layout(NESTED + "0.1 ((1 2 3) (4 5 6)) ((7 8 9) (10 11 12))\n", "forces.dat")
    assert found.names == ("time", *parts("F", "pressure", "viscous"), *parts("M", "pressure", "viscous"))


def test_a_missing_viscous_part_is_told():
    assert layout(
        "# Forces\n# Time forces(pressure) moment(pressure)\n1 ((1 2 3)) ((4 5 6))\n", "forces.dat"
    ).notes == ("the file has no viscous part",)
    assert layout("# Force\n# Time (total_x total_y total_z)\n1 (1 2 3)\n").notes == (
        "the file has no viscous part and no pressure part",
    )


def test_rows_that_are_no_vectors():
    with pytest.raises(ReadError, match=r"force.dat: the rows have 4 values behind the time"):
        layout("# Force\n# Time (total_x total_y total_z)\n1 (1 2 3) 4\n")


def test_bins_are_no_history():
    with pytest.raises(ReadError, match=r"holds forces by bins"):
        layout("# Force bins\n# bins : 20\n# Time total_x\n1 2\n", "forceBin.dat")


@pytest.mark.parametrize(
    ("labels", "name"),
    [
        (
            "Time              Cm              Cd              Cl              Cl(f)           Cl(r)",
            "forceCoeffs.dat",
        ),
        (
            "Time          \tCd            \tCs            \tCl            \tCmRoll        \tCd(f)",
            "coefficient.dat",
        ),
    ],
)
def test_force_coefficients(labels, name):
    head = "# Force coefficients\n# dragDir : (1 0 0)\n# magUInf   : 1.0e+01\n# lRef : 1\n# Aref : 2.5e-01\n"
    found = layout(f"{head}# {labels}\n0.1 1 2 3 4 5\n", name)
    assert (found.kind, found.header["Aref"], found.header["magUInf"]) == ("coefficients", "2.5e-01", "1.0e+01")
    assert found.names == ("time", *labels.split()[1:])


@pytest.mark.parametrize(
    "labels",
    [
        "Time          \tcentreOfRotation\tcentreOfMass\trotation\tvelocity\tomega",
        "Time\tCentre of rotation\tCentre of mass\tRotation\tLinear velocity\tAngular velocity",
        "Time centreOfRotation centreOfMass rotation velocity omega",
    ],
)
@pytest.mark.parametrize(("angle", "unit"), [("degrees", "deg"), ("radians", "rad")])
def test_rigid_body_state(labels, angle, unit):
    text = f"# Motion State\n# Angle Units   : {angle}\n# {labels}\n0.1\t(0 0 1)\t(0 0 2)\t(1 2 3)\t(0 0 0)\t(4 5 6)\n"
    found = layout(text, "sixDoFRigidBodyState.dat")
    stems = ("centre_of_rotation", "centre_of_mass", "rotation", "velocity", "angular_velocity")
    assert found.kind == "motion"
    assert found.names == ("time", *(f"{stem}_{axis}" for stem in stems for axis in XYZ))
    assert (found.units["rotation_y"], found.units["angular_velocity_z"]) == (unit, f"{unit}/s")
    assert (found.units["centre_of_mass_z"], found.units["velocity_x"]) == ("m", "m/s")


PROBES = (
    "# Probe 0 (0.1 0.2 0)\n# Probe 1 (0.3 0.2 -1e-3)  # Not Found\n#       Probe             0             1\n"
)


def test_scalar_probes():
    found = layout(PROBES + "#        Time\n        0.1     -1.23e+00     -1e+300\n", "p_rgh")
    assert (found.kind, found.names) == ("probes", ("time", "p_rgh_0", "p_rgh_1"))
    assert found.points == {"p_rgh_0": (0.1, 0.2, 0.0), "p_rgh_1": (0.3, 0.2, -1e-3)}
    assert found.notes == ("some probes were not found in the mesh",)


def test_vector_probes_with_the_labels_of_newer_versions():
    text = "# Probe 0 (0 0 6)\n# Probe 1 (0 0 7)\n# Time        0             1\n9  (1 2 3) (4 5 6)\n"
    found = layout(text, "U")
    assert found.names == ("time", *(f"U_{i}_{axis}" for i in (0, 1) for axis in XYZ))


def test_probes_that_do_not_fit():
    with pytest.raises(ReadError, match=r"lists 2 points and the rows have 1 values"):
        layout(PROBES + "#        Time\n        0.1     -1.23e+00\n", "p")


LOCATIONS = "# Location 0          : (1 0 0)\n# Location 1          : (2 0 0)\n"


def test_height_of_the_interface():
    text = LOCATIONS + "# hB : Interface height above the boundary\n# hL : Interface height above the location\n"
    text += "# Location            0                  1\n# Time               hB     hL     hB     hL\n"
    text += "0.1 1 0 2 0\n"
    found = layout(text, "height.dat")
    assert (found.kind, found.names) == ("surface", ("time", "hB_0", "hL_0", "hB_1", "hL_1"))
    assert found.points["hL_1"] == (2.0, 0.0, 0.0)
    assert set(found.units.values()) == {"s", "m"}


def test_position_of_the_interface():
    text = LOCATIONS + "# p : Interface position\n# Location  0  1\n# Time  p  p\n0.1 ( 1 0 0.5) ( 2 0 0.25) \n"
    found = layout(text, "position.dat")
    assert found.names == ("time", "p_0_x", "p_0_y", "p_0_z", "p_1_x", "p_1_y", "p_1_z")


def test_heights_without_a_header_of_their_own():
    found = layout("# Time hB hL hB hL\n0.1 1 0 2 0\n", "height.dat")
    assert found.names == ("time", "hB_0", "hL_0", "hB_1", "hL_1")


def test_wave_gauges():
    text = "Time\tgauge_0\tgauge_1\n-1\t1\t2\n-2\t0\t0\n-3\t0.5\t0.5\n0.1\t0.01\t0.02\n"
    found = layout(text, "surfaceElevation.dat")
    assert (found.kind, found.names) == ("surface", ("time", "gauge_0", "gauge_1"))
    assert found.points == {"gauge_0": (1.0, 0.0, 0.5), "gauge_1": (2.0, 0.0, 0.5)}
    assert text.encode()[found.first_byte :] == b"0.1\t0.01\t0.02\n"


def test_residuals_pass_over_names_of_solvers():
    text = (
        "# Solver information\n# Time\tU_solver\tUx_initial\tUx_iters\tU_converged\n1\tGAMG\t1.0e+00\t3\tfalse\n"
    )
    found = layout(text, "solverInfo.dat")
    assert (found.kind, found.names) == ("residuals", ("time", "", "Ux_initial", "Ux_iters", ""))


def test_residuals_that_are_not_available():
    found = layout(
        "# Residuals\n# Time          \tp             \tUx            \n1 \t1.0e+00 \tN/A\n", "residuals.dat"
    )
    assert found.names == ("time", "p", "Ux")


def test_any_other_object_is_a_monitor():
    text = "# Region type : patch\n# Faces : 12\n# Time \tsum(p) \tareaAverage(U)\n1 \t2.5 \t(1 0 0)\n"
    found = layout(text, "surfaceFieldValue.dat")
    assert found.kind == "monitor"
    assert found.names == ("time", "sum(p)", "areaAverage(U)_x", "areaAverage(U)_y", "areaAverage(U)_z")
    assert found.header["Faces"] == "12"


def test_labels_that_do_not_fit_are_told():
    found = layout("# Something\n# Time a\n1 2 3\n", "thing.dat")
    assert found.names == ("time", "column_2", "column_3")
    assert found.notes == ("the header labels 2 of 3 columns; they are numbered",)


@pytest.mark.parametrize("text", [NESTED, NESTED + "0.1 ((1 2"])
def test_a_header_only(text):
    with pytest.raises(EmptyLogError, match=r"forces.dat: there are no data rows"):
        layout(text, "forces.dat")


@pytest.mark.parametrize("text", ["a,b\n1,2\n", '"Iteration","Cd"\n1,2\n', "# a comment\n1 2 3\n"])
def test_other_files_are_left_to_others(text):
    assert layout(text, "table.txt") is None
