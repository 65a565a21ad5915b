"""Report and plot files of Fluent."""

from __future__ import annotations

from pathlib import Path

import pytest

from towtank.core.errors import ReadError
from towtank.formats.fluent_report import fluent_layout
from towtank.formats.solver_log import EmptyLogError

REPORT = '"report-drag-rfile"\n"Time Step" "report-drag etc.."\n("Time Step" "report-drag" "flow-time")\n'


def layout(text: str, name: str = "report.out"):
    return fluent_layout(text.encode(), Path(name))


def test_a_transient_report_file():
    found = layout(REPORT + "1 12.5 0.001\n2 12.6 0.002\n")
    assert (found.dialect, found.kind) == ("Fluent", "monitor")
    assert found.names == ("time_step", "report-drag", "time")
    assert found.index_name == "time"
    assert (found.units["time"], found.first_byte) == ("s", len(REPORT))
    assert found.header == {"title": "report-drag-rfile"}


@pytest.mark.parametrize("word", ["Iteration", "Time Step"])
def test_a_steady_report_file_counts_iterations(word):
    found = layout(f'"lift"\n"{word}" "lift"\n("{word}" "lift" "drag")\n1 2 3\n')
    assert found.names == ("iteration", "lift", "drag")


def test_a_monitor_of_older_versions():
    found = layout('"Convergence history of cd-1"\n"Iterations" "cd-1"\n1 0.5\n2 0.6\n')
    assert found.names == ("iteration", "cd-1")


@pytest.mark.parametrize("blank", ["", "\n"])
def test_a_plot_file(blank):
    text = f'(title "Drag")\n(labels "Iteration" "Cd")\n{blank}((xy/key/label "cd-hull")\n1\t0.5\n2\t0.6\n)\n'
    found = layout(text, "drag.frp")
    assert found.names == ("iteration", "cd-hull")
    assert text.encode()[found.first_byte :] == b"1\t0.5\n2\t0.6\n)\n"


def test_residuals():
    found = layout('"Scaled Residuals"\n"Iteration" "x etc.."\n("Iteration" "continuity" "x-velocity")\n1 1 1\n')
    assert found.kind == "residuals"


def test_a_header_only():
    with pytest.raises(EmptyLogError, match=r"report.out: there are no data rows"):
        layout(REPORT)


def test_names_that_do_not_fit():
    with pytest.raises(ReadError, match=r"names 3 columns and the rows have 4 values"):
        layout(REPORT + "1 12.5 0.001 7\n")


def test_neither_time_nor_iterations():
    with pytest.raises(ReadError, match=r"none of the columns a, b counts time"):
        layout('"report"\n"a" "b etc.."\n("a" "b")\n1 2\n')


@pytest.mark.parametrize("text", ['"Iteration","Cd"\n1,2\n', "Time a\n1 2\n", "# Time a\n1 2\n", ""])
def test_other_files_are_left_to_others(text):
    assert layout(text) is None
