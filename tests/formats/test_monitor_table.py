"""Any table of histories with a line of names."""

from __future__ import annotations

from pathlib import Path

import pytest

from towtank.formats.monitor_table import monitor_layout
from towtank.formats.solver_log import EmptyLogError


def layout(text: str, index: str | int | None = None):
    return monitor_layout(text.encode(), Path("table.dat"), index)


ROWS = "1 0.1 2.5 3\n2 0.2 2.5 4\n3 0.3 2.5 5\n"


def test_a_marked_line_of_names_with_units():
    text = "# Iteration Time[s] Fx[N] Mz[N.m]\n" + ROWS
    found = layout(text)
    assert found.names == ("iteration", "time", "Fx", "Mz")
    assert found.units == {"iteration": "", "time": "s", "Fx": "N", "Mz": "N.m"}
    assert text.encode()[found.first_byte :] == ROWS.encode()
    assert (found.kind, found.delimiter, found.comment) == ("monitor", " ", "#")


@pytest.mark.parametrize("zone", ["", 'ZONE T="hull"\n', 'ZONE T="t = 2", I=3\n'])
def test_a_tecplot_header(zone):
    text = f'TITLE = "forces"\nVARIABLES = "Iteration" "Time" "FX pressure"\n"FY"\n{zone}' + ROWS
    found = layout(text)
    assert found.names == ("iteration", "time", "FX pressure", "FY")
    assert text.encode()[found.first_byte :] == ROWS.encode()


def test_a_tecplot_header_without_quotes():
    assert layout("VARIABLES = iter, time, Fx, Mz\n" + ROWS).names == ("iteration", "time", "Fx", "Mz")


@pytest.mark.parametrize(("delimiter", "expected"), [(",", ","), (";", ";"), ("\t", " ")])
def test_delimiters(delimiter, expected):
    text = ("iter time Fx My\n" + ROWS).replace(" ", delimiter)
    found = layout(text)
    assert (found.names, found.delimiter) == (("iteration", "time", "Fx", "My"), expected)


def test_tabs_with_empty_cells_stay_tabs():
    found = layout("time\ta\tb\n1\t2\t3\n2\t\t4\n3\t5\t6\n4\t5\t6\n")
    assert found.delimiter == "\t"


def test_columns_of_text_are_passed_over():
    found = layout("time,state,Fx\n1,ok,2\n2,ok,2\n3,ok,4\n")
    assert found.names == ("time", "", "Fx")


@pytest.mark.parametrize("index", ["simulated", 1])
def test_the_channel_map_knows_the_time(index):
    text = "simulated,Fx\n1,2\n2,2\n3,2\n"
    assert layout(text) is None
    assert layout(text, index).names == ("time", "Fx")


def test_a_header_only():
    with pytest.raises(EmptyLogError, match="there are no data rows"):
        layout("time,Fx,Fy\n")


def test_decimal_commas_are_left_to_the_reader_of_runs():
    assert layout("time;Fx\n0,1;2,5\n0,2;2,5\n0,3;2,75\n") is None
