"""Motions scored as phasors: rotations across 360 degrees, known errors, units."""

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.squat.code_scores import score_tables
from towtank.squat.curve_table import read_curve_table
from towtank.squat.motion_scores import MOTION_COLUMNS, motion_scores, motions_of


@pytest.fixture
def table(tmp_path):
    def made(name, text, **more):
        (tmp_path / name).write_text(text)
        return read_curve_table(tmp_path / name, "speed", **more)

    return made


MEASURED = (
    "speed,bow_amplitude [mm],bow_phase [deg],stern_amplitude [mm],stern_phase [deg]\n1,10,359,8,20\n2,12,1,9,30\n"
)


def test_a_turn_across_the_full_circle_is_small(table):
    measured = table("D.csv", MEASURED)
    code = table("S.csv", MEASURED.replace("10,359", "10,3").replace("12,1,", "12,5,"))
    found = score_tables(measured, [code])
    rows = found.motions.set_index("motion")
    assert tuple(found.motions.columns) == MOTION_COLUMNS
    assert rows.loc["bow", "phase_difference [deg]"] == pytest.approx(4.0)
    assert rows.loc["bow", "complex_error"] == pytest.approx(2.0 * np.sin(np.radians(2.0)))
    assert rows.loc["bow", "amplitude_error [%]"] == pytest.approx(0.0, abs=1e-12)
    assert rows.loc["stern", "complex_error"] == 0.0
    bow, all_of = 100 + 144, 100 + 144 + 64 + 81
    assert rows.loc["all", "complex_error"] == pytest.approx(2.0 * np.sin(np.radians(2.0)) * np.sqrt(bow / all_of))
    # the phase itself has no Q, the amplitude has one
    assert set(found.details["quantity"]) == {"bow_amplitude", "stern_amplitude"}


def test_units_interpolation_and_points_outside(table):
    measured = table("D.csv", "speed,x_amplitude [m],x_phase [rad]\n1,0.010,0\n2,0.010,0\n9,0.010,0\n")
    code = table("S.csv", "speed,x_amplitude [mm],x_phase [deg]\n1,10,90\n3,30,90\n")
    (row,) = score_tables(measured, [code]).motions.to_dict("records")
    # i and 2i against 1 and 1
    assert row["complex_error"] == pytest.approx(np.sqrt((2.0 + 5.0) / 2.0))
    assert (row["n"], row["phase_difference [deg]"]) == (2, pytest.approx(90.0))
    assert row["amplitude_error [%]"] == pytest.approx(50.0)


def test_no_phase_no_motion(table):
    measured = table("D.csv", "speed,x_amplitude\n1,1\n2,2\n")
    assert motions_of(measured) == []
    assert motion_scores(measured, [measured]).empty


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "speed,x_amplitude,x_phase\n1,1,10\n2,2,20\n",
            "column x_phase: has no unit: degrees and radians look alike",
        ),
        ("speed,x_amplitude,x_phase [mm]\n1,1,10\n2,2,20\n", "column x_phase: is in mm, which is no angle"),
        ("speed,x_amplitude,x_phase [deg]\n1,-1,10\n2,2,20\n", "column x_amplitude: the amplitude -1 is negative"),
    ],
)
def test_what_is_no_phasor_is_named(table, text, said):
    measured = table("D.csv", text)
    with pytest.raises(ReadError, match=rf"D\.csv, {said}"):
        motion_scores(measured, [measured])
