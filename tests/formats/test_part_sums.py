"""Totals of forces."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from towtank.formats.part_sums import missing_totals, with_totals
from towtank.formats.solver_log import SolverLog


def log(kind: str = "forces", **columns: list[float]) -> SolverLog:
    frame = pd.DataFrame({"time": [1.0, 2.0], **columns})
    return SolverLog("forces", kind, frame, {}, (Path("forces.dat"),))


def test_totals_are_summed_from_the_parts():
    found = with_totals(log(Fx_pressure=[1, 2], Fx_viscous=[3, 4], Fx_porous=[5, 5], Mz_pressure=[1, 1]))
    assert list(found.frame.columns)[:3] == ["time", "Fx_total", "Mz_total"]
    assert found.frame["Fx_total"].tolist() == [9, 11]
    assert found.frame["Mz_total"].tolist() == [1, 1]
    assert (found.units["Fx_total"], found.units["Mz_total"]) == ("N", "N m")
    assert found.notes == ("totals are the sum of the parts: pressure + viscous + porous",)


@pytest.mark.parametrize(
    ("total", "notes"), [([4, 6], ()), ([4, 7], ("Fx_total as printed is not the sum of its parts",))]
)
def test_printed_totals_are_kept_and_compared(total, notes):
    found = with_totals(log(Fx_total=total, Fx_pressure=[1, 2], Fx_viscous=[3, 4]))
    assert found.frame["Fx_total"].tolist() == total
    assert found.notes == notes


def test_other_histories_are_left_alone():
    monitor = log("monitor", Fx_pressure=[1, 2])
    assert with_totals(monitor) is monitor


def test_which_totals_are_missing():
    names = ("time", "Fx_pressure", "Fy_total", "Fy_pressure", "My_viscous")
    assert missing_totals(names) == {"Fx_total": ["Fx_pressure"], "My_total": ["My_viscous"]}
