from __future__ import annotations

from pathlib import Path

import pytest

from towtank.cfd.case_history import histories_table, history_names, history_of
from towtank.core.errors import ReadError
from towtank.formats import SolverCase, read_solver_case


@pytest.fixture
def solver(tmp_path: Path) -> SolverCase:
    """A case with forces, two fields at a probe, residuals of which one column is empty."""
    files = {
        "hull/0/force.dat": "# Force\n# Time\ttotal_x\ttotal_y\ttotal_z\n0.1\t1\t2\t3\n0.2\t1\t2\t3\n",
        "gauges/0/p": "# Probe 0 (0 0 1)\n# Time 0\n0.1 5\n0.2 6\n",
        "gauges/0/U": "# Probe 0 (0 0 1)\n# Time 0\n0.1 (1 2 3)\n0.2 (1 2 4)\n",
        "solver/0/residuals.dat": "# Residuals\n# Time Ux k\n0.1 1e-3 N/A\n0.2 1e-4 N/A\n",
    }
    for name, text in files.items():
        file = tmp_path / "drift" / "postProcessing" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return read_solver_case(tmp_path / "drift")


@pytest.mark.parametrize(
    ("wanted", "names"),
    [
        ("all", ("gauges/U", "gauges/p", "hull", "solver")),
        ("probes", ("gauges/U", "gauges/p")),
        ("gauges/p", ("gauges/p",)),
        ("forces", ("hull",)),
    ],
)
def test_names_by_name_kind_or_all(solver, wanted, names):
    assert history_names(solver, wanted) == names


def test_columns_keep_their_names_and_units(solver):
    found = history_of(solver, "gauges/U", "beta_4")
    assert (found.name, found.history, found.loads) == ("beta_4", "gauges/U", ("U_0_x", "U_0_y", "U_0_z"))
    assert found.channels["U_0_z"].tolist() == [3.0, 4.0]
    assert history_of(solver, "hull").labelled("Fx_total") == "Fx_total [N]"
    assert list(history_of(solver, "residuals").to_frame().columns) == ["time [s]", "Ux [-]"]


def test_columns_without_numbers_are_told(solver):
    found = history_of(solver, "residuals")
    assert found.loads == ("Ux",)
    assert "column(s) without numbers are left out: k" in found.notes


def test_several_or_none_is_an_error(solver):
    with pytest.raises(ReadError, match=r"2 histories 'probes' -> name one of gauges/U, gauges/p"):
        history_of(solver, "probes")
    with pytest.raises(ReadError, match=r"no history 'motion' -> the case has gauges/U \(probes\)"):
        history_names(solver, "motion")


def test_overview(solver):
    table = histories_table(solver).set_index("history")
    assert dict(table["kind"]) == {
        "gauges/U": "probes",
        "gauges/p": "probes",
        "hull": "forces",
        "solver": "residuals",
    }
    assert table.loc["gauges/p", "points"] == "p_0 (0 0 1)"
    assert (table.loc["hull", "rows"], table.loc["hull", "end"]) == (2, 0.2)
