from __future__ import annotations

import numpy as np
import pytest

from towtank.cfd.case_loads import CaseLoads, LoadChoices
from towtank.cfd.case_sweep import CaseSweep, SweepCase
from towtank.cfd.settled_loads import SettledCase, settle_case, settling_findings
from towtank.core.conventions import Conventions
from towtank.report.cfd_settling_figures import cycle_figure, phase_figure, running_mean_figure
from towtank.report.cfd_settling_outputs import drawn_cases, render_settling_report, settling_row, write_settled
from towtank.report.cfd_settling_tables import (
    load_table,
    settled_records,
    settled_text,
    settling_facts,
    verdict_table,
)

TIME = 0.1 * np.arange(400)
NOISE = np.random.default_rng(0).standard_normal(400)


def settled(tmp_path, name: str, x: np.ndarray, y: np.ndarray, **more) -> SettledCase:
    (tmp_path / name).mkdir(exist_ok=True)
    loads = CaseLoads(name, TIME, "time", {"X": x, "Y": y}, Conventions(force_scaling="dimensional"))
    return settle_case(SweepCase(name, tmp_path / name, grid="1"), loads, **more)


@pytest.fixture
def cases(tmp_path) -> list[SettledCase]:
    steady, start = -10.0 + 0.1 * NOISE, np.exp(-TIME / 2.0)
    wave = np.cos(2.0 * np.pi * TIME / 4.0)
    return [
        settled(tmp_path, "good", steady + 5.0 * start, 2.0 + 0.05 * NOISE),
        settled(tmp_path, "waves", steady, 3.0 * wave + 2.0 * start + 0.01 * NOISE),
        settled(tmp_path, "slow", steady + 6.0 * np.exp(-TIME / 30.0), 2.0 + 0.05 * NOISE),
        settled(tmp_path, "blown", np.where(TIME > 30.0, np.nan, steady), 2.0 + 0.05 * NOISE),
    ]


def test_running_mean_ends_at_the_mean(cases):
    axes = running_mean_figure(cases[0], "X")
    running = axes.lines[-1].get_ydata()
    assert running[-1] == pytest.approx(cases[0]["X"].mean)
    assert axes.lines[1].get_xdata()[0] == pytest.approx(cases[0].settling.cut_time)
    assert axes.get_ylabel() == "X [N]"


def test_diverged_run_shows_its_history_alone(cases):
    assert len(running_mean_figure(cases[3], "X").lines) == 1


def test_cycles_of_a_periodic_load(cases):
    axes = cycle_figure(cases[1], "Y")
    first = axes.lines[0]
    assert len(first.get_xdata()) == cases[1]["Y"].cycles.cycles
    assert first.get_ydata()[-1] == pytest.approx(3.0, abs=0.02)


def test_mean_cycle_of_a_periodic_load(cases):
    axes = phase_figure(cases[1], "Y")
    degrees, mean = axes.lines[0].get_data()
    omega = cases[1]["Y"].cycles.omega
    assert (degrees[0], degrees[-1]) == (0.0, 360.0)
    np.testing.assert_allclose(mean, 3.0 * np.cos(np.radians(degrees)), atol=0.1)
    assert omega == pytest.approx(2.0 * np.pi / 4.0, rel=1e-3)
    kept = cases[1]["Y"].cycles.cycles - cases[1]["Y"].cycles.drop
    assert axes.get_xlabel() == f"phase ωt [deg], {kept} cycles"


def test_unsettled_cases_are_drawn_first(cases):
    assert [item.case.name for item in drawn_cases(cases, 2)] == ["blown", "slow"]


def test_verdict_table_marks_what_stops_a_fit(cases):
    table = verdict_table(cases)
    assert table.marks == ("", "", "weak", "bad")
    assert [row[1] for row in table.rows] == ["settled", "periodic", "still drifting", "diverged"]
    assert len(load_table(cases[1]).rows) == 2
    assert ("settled", "1", "") in settling_facts(cases)


def test_waived_case_is_not_shaded(tmp_path):
    item = settled(tmp_path, "slow", -10.0 + 6.0 * np.exp(-TIME / 30.0) + 0.1 * NOISE, NOISE, waive=["slow"])
    assert verdict_table([item]).marks == ("",)
    assert verdict_table([item]).rows[0][1] == "still drifting, waived"


def test_text_and_records(cases):
    said = settled_text(cases)
    assert "4 case(s): 1 settled, 1 periodic, 1 still drifting, 1 diverged" in said
    records = settled_records(cases[3].to_frame())
    assert records[0]["mean"] is None


def test_page_shows_a_panel_for_each_load_and_its_cycles(cases):
    page = render_settling_report(cases, settling_findings(cases))
    # History of two loads of four cases, and the cycles and the mean cycle of the periodic one.
    assert page.count("<svg") == 2 * 4 + 2
    assert "Virtual data" not in page
    assert "still-drifting" in page
    assert len(settling_row(cases[1], "a").drawings) == 4


def test_points_are_left_out_while_a_case_stops_a_fit(cases, tmp_path):
    sweep = CaseSweep(tuple(item.case for item in cases))
    written = write_settled(sweep, cases, LoadChoices(), tmp_path / "out", report=False)
    assert [path.name for path in written] == ["settled.csv", "cycles.csv", "provenance.json"]
    good = write_settled(CaseSweep(sweep.cases[:1]), cases[:1], LoadChoices(), tmp_path / "good", report=False)
    assert [path.name for path in good] == ["settled.csv", "points.csv", "provenance.json"]
