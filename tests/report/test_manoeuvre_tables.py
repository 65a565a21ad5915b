"""Tables and page of some manoeuvres: numbers, definitions, verdicts, what is left out."""

from __future__ import annotations

from dataclasses import replace

import pytest

from towtank.report.manoeuvre_drawings import manoeuvre_drawings
from towtank.report.manoeuvre_outputs import manoeuvres_text
from towtank.report.manoeuvre_page import render_manoeuvres
from towtank.report.manoeuvre_tables import (
    choices_table,
    criteria_table,
    failures_table,
    index_tables,
    parts_table,
    steering_table,
)
from towtank.simulate.ensembles import Ensemble
from towtank.simulate.fitted_vessel import vessel_from_set
from towtank.simulate.manoeuvring_results import ManoeuvringResults, sail_manoeuvres
from towtank.simulate.named_programmes import named_programme
from towtank.simulate.ships import named_ship

SHIP = named_ship("kvlcc2")
NAMES = ("turning 35", "turning -35", "zigzag 10/10", "crash stop")


@pytest.fixture(scope="module")
def drawn() -> ManoeuvringResults:
    return sail_manoeuvres(SHIP, [named_programme(name, 1.0) for name in NAMES], draws=20, percent=5.0, seed=1)


@pytest.fixture(scope="module")
def plain(drawn) -> ManoeuvringResults:
    return ManoeuvringResults(drawn.vessel, drawn.trajectories)


def titles(table) -> list[str]:
    return [column.title for column in table.columns]


def test_a_table_a_kind_of_manoeuvre(plain):
    tables = dict(index_tables(plain))
    assert list(tables) == ["Turning", "Zig-zag to 10°", "Crash stop"]
    turning = tables["Turning"]
    assert titles(turning) == ["index", "unit", "turning +35", "turning -35", "definition"]
    advance = next(row for row in turning.rows if row[0] == "advance")
    assert advance[1] == "L"
    assert float(advance[2]) == pytest.approx(3.08, abs=0.02)
    assert advance[4].startswith("distance of midship along the original course")


def test_with_draws_each_value_has_its_deviation_and_its_quantiles(drawn):
    tables = dict(index_tables(drawn))
    assert titles(tables["Zig-zag to 10°"]) == ["index", "unit", "zigzag +10/10", "5 to 95 %", "definition"]
    assert titles(tables["Turning"]) == ["index", "unit", "turning +35", "5 to 95 %", "turning -35", "5 to 95 %"]
    advance = tables["Turning"].rows[0]
    assert " ± " in advance[2]
    assert " to " in advance[3]
    # where columns are many the definition stands under the name
    assert str(advance[0]).startswith('advance<span class="under">distance of midship')


def test_errors_of_the_integration_are_shown_as_nothing(plain):
    stop = {row[0]: row[2].strip() for row in dict(index_tables(plain))["Crash stop"].rows}
    assert float(stop["side reach"]) == 0.0
    assert float(stop["heading change at stop"]) == 0.0
    line = next(line for line in manoeuvres_text(plain).splitlines() if "side reach" in line)
    assert line.split()[-2:] == ["0", "L"]


def test_criteria_have_limit_margin_verdict_and_probability(drawn, plain):
    table = criteria_table(plain)
    by_name = {row[0]: row for row in table.rows}
    assert by_name["turning: advance"][7] == "pass"
    assert by_name["20/20 zig-zag: first overshoot"][7] == "not tested"
    assert "scale effects" in table.caption
    assert titles(criteria_table(drawn))[-2:] == ["probability %", "margin, 5 to 95 %"]
    assert criteria_table(drawn).rows[0][8].startswith("100.0 ±")


def test_failed_draws_are_counted_by_reason(drawn):
    assert failures_table(drawn) is None
    endings = {name: one.copy() for name, one in drawn.ensemble.endings.items()}
    endings["turning +35"] = endings["turning +35"].astype(object)
    endings["turning +35"][:5] = "the motion diverges"
    ensemble = replace(drawn.ensemble, endings=endings)
    assert isinstance(ensemble, Ensemble)
    table = failures_table(replace(drawn, ensemble=ensemble))
    assert [cell.strip() for cell in table.rows[0]] == ["turning +35", "5", "25.0", "the motion diverges"]


def test_steering_says_what_is_left_out(plain):
    assert steering_table(plain).caption == ""
    assert {row[0] for row in steering_table(plain).rows} == {"hull", "zigzag +10/10"}
    hull = SHIP.hull.subset([name for name in SHIP.hull.names if name not in ("Yr",)])
    odd = ManoeuvringResults(SHIP.with_hull(hull), plain.trajectories)
    assert "course stability of the hull" in steering_table(odd).caption


def test_choices_of_several_manoeuvres_stand_in_one_row(drawn):
    rows = {(row[1], row[2]): row[0] for row in choices_table(drawn).rows}
    assert rows["approach speed [m/s]", "1.18"].count(",") == 3
    assert rows["seed", "1"] == "ensemble"


def test_lent_parts_name_the_lender():
    vessel = vessel_from_set(SHIP.hull, like="kvlcc2")
    rows = dict(parts_table(ManoeuvringResults(vessel, ())).rows)
    assert rows["propeller"] == rows["rudder"] == "kvlcc2"


def test_the_page_has_figures_tables_doubts_and_facts(drawn):
    figures = manoeuvre_drawings(drawn)
    assert {figure.kind for figure in figures} == {"track", "time", "fan", "histogram", "elasticity"}
    page = render_manoeuvres(drawn, figures=figures[:3])
    assert page.count("<svg") == 3
    assert "thrust astern is assumed to be 0.65" in page
    assert "IMO criteria passed" in page
    assert "20 draws, seed 1" in page
    for kind in ("Turning", "Zig-zag to 10°", "Crash stop"):
        assert f"<h4>{kind}</h4>" in page
    assert "<link" not in page
    assert "<script" not in page
