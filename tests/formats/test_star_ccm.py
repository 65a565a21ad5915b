"""Monitors and reports of STAR-CCM+."""

from __future__ import annotations

from pathlib import Path

import pytest

from towtank.formats.solver_log import EmptyLogError
from towtank.formats.star_ccm import star_layout


def layout(text: str, name: str = "forces.csv"):
    return star_layout(text.encode("utf-8-sig" if name == "bom.csv" else "utf-8"), Path(name))


HEADING = '"Physical Time: Physical Time (s)","Force X Monitor: Force X (N)","Pitch Monitor: Pitch (deg)"'


@pytest.mark.parametrize("name", ["forces.csv", "bom.csv"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_monitors_with_units_in_parentheses(name, end):
    found = layout(f"{HEADING}{end}0.01,1.5,0.2{end}", name)
    assert (found.dialect, found.kind, found.delimiter) == ("STAR-CCM+", "monitor", ",")
    assert found.names == ("time", "Force X", "Pitch")
    assert found.units == {"time": "s", "Force X": "N", "Pitch": "deg"}


def test_iterations_and_names_without_units():
    found = layout(
        '"Iteration","Drag Coefficient Monitor: Drag Coefficient","Continuity Monitor: Continuity"\n1,2,3\n'
    )
    assert found.names == ("iteration", "Drag Coefficient", "Continuity")
    assert set(found.units.values()) == {""}


def test_both_counts():
    found = layout('"Iteration: Iteration","Physical Time: Physical Time (s)","Fx Monitor: Fx (kN)"\n1,0.1,3\n')
    assert (found.names, found.index_name) == (("iteration", "time", "Fx"), "time")


def test_a_time_step_alone_counts():
    assert layout('"Time Step","Fx Monitor: Fx (N)"\n1,3\n').names == ("iteration", "Fx")


def test_monitors_of_one_name_are_told_apart():
    found = layout('"Iteration","Force Plot: Hull (N)","Force Plot: Rudder (N)"\n1,2,3\n')
    assert found.names == ("iteration", "Force: Hull", "Force: Rudder")


def test_units_with_a_slash_and_a_minus():
    found = layout(
        '"Physical Time: Physical Time (s)","w Monitor: w (radian/s)","m Monitor: Mass Flow (kg/s)"\n0,1,2\n'
    )
    assert found.units == {"time": "s", "w": "radian/s", "m": "kg/s"}


def test_residuals():
    assert layout('"Iteration","Continuity","X-momentum"\n1,2,3\n', "Residuals.csv").kind == "residuals"


def test_a_header_only():
    with pytest.raises(EmptyLogError, match=r"forces.csv: there are no data rows"):
        layout(HEADING + "\n")


@pytest.mark.parametrize("text", ["time,Fx\n1,2\n", "# Time a\n1 2\n", '"a Monitor: a","b Monitor: b"\n1,2\n', ""])
def test_other_files_are_left_to_others(text):
    assert layout(text) is None
