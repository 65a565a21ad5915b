"""Figures, tables, pages and text of squat: records, scores, predictions."""

from __future__ import annotations

import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from towtank.core.ship import Ship
from towtank.report.figure_style import CYCLE, MUTED
from towtank.report.formula_figures import formula_clearance_figure, formula_figure
from towtank.report.score_figures import (
    mean_error_figure,
    quality_figure,
    score_curve_figure,
    score_error_figure,
    shown_units,
)
from towtank.report.score_outputs import score_text
from towtank.report.score_page import case_table, full_scale_table, render_scores
from towtank.report.squat_figures import (
    clearance_figure,
    corrected_figure,
    squat_curve_figure,
    squat_record_figure,
    squat_residual_figure,
)
from towtank.report.squat_outputs import squat_text
from towtank.report.squat_prediction_outputs import prediction_text
from towtank.report.squat_prediction_page import formula_table, limit_lines, render_prediction
from towtank.report.squat_report import render_squat_report
from towtank.report.squat_tables import (
    clearance_table,
    fits_table,
    formula_scores_table,
    means_table,
    waves_table,
    windows_table,
)
from towtank.report.squat_units import quantity_title, shown_length, shown_quantity, with_error
from towtank.squat.code_scores import CodeScores, score_tables
from towtank.squat.curve_table import read_curve_table
from towtank.squat.fairway import Fairway
from towtank.squat.forecast import SquatForecast, forecast
from towtank.squat.shipped_squat import write_squat_campaign
from towtank.squat.squat_analysis import SquatAnalysis, run_squat_campaign

WHEN = datetime(2026, 1, 2, tzinfo=UTC)
SHIP = Ship("container ship", L=230.0, B=32.2, T=10.8, volume=52030.0)


@pytest.fixture(scope="module")
def analysis(tmp_path_factory: pytest.TempPathFactory) -> SquatAnalysis:
    """The shipped virtual squat in a tank 4 m wide, corrected."""
    path = write_squat_campaign(tmp_path_factory.mktemp("squat"))
    text = path.read_text().replace("depth = 0.2025", "depth = 0.2025\nwidth = 4.0")
    path.write_text(text + '\n[correction]\nname = "kreitner"\n')
    return run_squat_campaign(path)


@pytest.fixture(scope="module")
def scores(tmp_path_factory: pytest.TempPathFactory) -> CodeScores:
    folder = tmp_path_factory.mktemp("scores")
    texts = {
        "tank": "speed [m/s],sinkage_bow [m],trim [deg],sinkage_bow_se [m]\n1,0.01,0.1,0.001\n2,0.04,0.2,0.001\n",
        "rans": "speed [m/s],sinkage_bow [m],trim [deg]\n1,0.011,0.12\n2,0.042,0.25\n",
        "panel": "speed [m/s],sinkage_bow [m]\n1,0.009\n1.9,0.03\n",
    }
    for name, text in texts.items():
        (folder / f"{name}.csv").write_text(text)
    measured, *codes = (read_curve_table(folder / f"{name}.csv") for name in texts)
    return score_tables(measured, codes, scale=80.0)


@pytest.fixture(scope="module")
def passage() -> SquatForecast:
    speeds = np.arange(6.0, 15.0, 2.0) * 1852 / 3600
    return forecast(SHIP, Fairway.canal(16.2, 100.0, 3.0), speeds)


SQUAT_FIGURES = ("record", "curve", "trim", "residual", "clearance", "corrected", "formula")


@pytest.mark.parametrize("name", SQUAT_FIGURES)
def test_squat_figures_take_and_return_axes(name: str, analysis: SquatAnalysis) -> None:
    (group,) = analysis.groups
    assert group.corrected is not None
    assert group.comparison is not None
    curve, fits, length = group.curve, group.fits, analysis.campaign.length
    draw = {
        "record": lambda ax: squat_record_figure(analysis.runs[0], ax=ax),
        "curve": lambda ax: squat_curve_figure(curve, fits, length, truth=analysis.truth, ax=ax),
        "trim": lambda ax: squat_curve_figure(curve, fits, length, ("trim",), ax=ax),
        "residual": lambda ax: squat_residual_figure(curve, fits, length, ax=ax),
        "clearance": lambda ax: clearance_figure(curve, length, ax=ax),
        "corrected": lambda ax: corrected_figure(curve, group.corrected, length, ax=ax),
        "formula": lambda ax: formula_figure(group.comparison.prediction, length, ax=ax),
    }[name]
    ax = Figure().add_subplot()
    assert draw(ax) is ax
    assert ax.lines
    assert re.search(r"\[(mm|s|m/s|mm/m)\]", ax.get_xlabel())
    assert re.search(r"\[(mm|mm/m)\]", ax.get_ylabel())
    assert isinstance(draw(None), Axes)


def test_curve_figure_shows_the_fit_inside_its_speeds(analysis: SquatAnalysis) -> None:
    (group,) = analysis.groups
    ax = squat_curve_figure(group.curve, group.fits, analysis.campaign.length, ("sinkage_bow",))
    solid = next(line for line in ax.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 20)
    speed, value = (np.asarray(of, dtype=float) for of in solid.get_data())
    known = np.isfinite(value)
    fit = group.fits["sinkage_bow"]["depth-froude"]
    assert speed[known].min() >= fit.speed_range[0]
    assert speed[known].max() <= fit.speed_range[1]
    np.testing.assert_allclose(value[known], 1000.0 * fit.predict(speed[known]))


def test_deeper_is_lower_in_a_record(analysis: SquatAnalysis) -> None:
    low, high = squat_record_figure(analysis.runs[0]).get_ylim()
    assert low > high


def test_formulas_outside_their_limits_are_grey(passage: SquatForecast) -> None:
    ax = formula_figure(passage.prediction, SHIP.L, knots=True)
    legend = ax.get_legend()
    assert legend is not None
    colours = {line.get_label(): line.get_color() for line in ax.lines}
    assert colours["icorels (outside)"] == MUTED
    assert colours["huuska"] in CYCLE
    assert "kn" in ax.get_xlabel()
    # a formula has one colour in every figure of a page
    bow = {line.get_label(): line.get_color() for line in formula_figure(passage.prediction, SHIP.L, "bow").lines}
    assert bow["huuska"] == colours["huuska"]
    applicable = passage.prediction.table[passage.prediction.table["applicable"]]["maximum"]
    assert ax.get_ylim()[1] <= 2.2 * applicable.max()


def test_clearance_of_a_forecast_stays_readable(passage: SquatForecast) -> None:
    ax = formula_clearance_figure(passage)
    still = 16.2 - 10.8
    low, high = ax.get_ylim()
    assert -still < low < still < high


@pytest.mark.parametrize("name", ["curve", "error", "quality", "mean"])
def test_score_figures_take_and_return_axes(name: str, scores: CodeScores) -> None:
    draw = {
        "curve": lambda ax: score_curve_figure(scores, "sinkage_bow", ax=ax),
        "error": lambda ax: score_error_figure(scores, "trim", ax=ax),
        "quality": lambda ax: quality_figure(scores, ax=ax),
        "mean": lambda ax: mean_error_figure(scores, "mm", ax=ax),
    }[name]
    ax = Figure().add_subplot()
    assert draw(ax) is ax
    assert "[" in ax.get_ylabel()
    assert isinstance(draw(None), Axes)


def test_bars_are_the_scores(scores: CodeScores) -> None:
    ax = quality_figure(scores)
    heights = {
        str(bars.get_label()): [float(bar.get_height()) for bar in bars.patches]  # type: ignore[attr-defined]
        for bars in ax.containers
        if len(getattr(bars, "patches", ()))
    }
    totals = scores.totals.set_index(["code", "quantity"])["Q"]
    assert heights["rans"][0] == pytest.approx(100.0 * float(totals["rans", "sinkage_bow"]))
    assert shown_units(scores) == {"sinkage_bow": (1000.0, "mm"), "trim": (1.0, "deg")}
    means = mean_error_figure(scores, "mm").containers[0]
    expected = 1000.0 * float(scores.details.iloc[0]["bias"])
    assert float(means[0].get_height()) == pytest.approx(expected)


def test_squat_page_is_self_contained(analysis: SquatAnalysis) -> None:
    page = render_squat_report(analysis, created=WHEN)
    for anchor in (
        "means",
        "waves",
        "curves-0",
        "residuals-0",
        "corrected-0",
        "formulas-0",
        "clearance-0",
        "records",
    ):
        assert f'<section id="{anchor}">' in page
        assert f'<a href="#{anchor}">' in page
    assert "Virtual data." in page
    assert "Correction kreitner" in page
    assert "2026-01-02" in page
    assert not re.search(r'(src|href)="(?!#)', page)
    identifiers = re.findall(r'<clipPath id="([^"]+)"', page)
    assert len(identifiers) == len(set(identifiers)) > 5
    assert "fairway.depth" in page
    assert '<tr class="grey">' in page


def test_score_page_names_signs_and_codes(scores: CodeScores) -> None:
    page = render_scores(scores, created=WHEN)
    for word in ("rans, panel against tank", "S − D", "BS sums the signs", "Ranking", "1 of 2 points"):
        assert word in page
    assert not re.search(r'(src|href)="(?!#)', page)
    identifiers = re.findall(r'<clipPath id="([^"]+)"', page)
    assert len(identifiers) == len(set(identifiers))


def test_prediction_page_greys_and_warns(passage: SquatForecast) -> None:
    page = render_prediction(passage, created=WHEN)
    assert "above-schijf" in page
    assert "canal of" in page
    assert '<tr class="grey">' in page
    assert "Kreitner overspeed" in page


def test_tables(analysis: SquatAnalysis, scores: CodeScores, passage: SquatForecast) -> None:
    (group,) = analysis.groups
    assert group.comparison is not None
    length = analysis.campaign.length
    means = means_table(analysis)
    assert means.columns[1].title == "bow [mm]"
    assert [row[0] for row in means.rows][:2] == ["run_06kn", "run_08kn"]
    windows = windows_table(analysis)
    assert [column.title for column in windows.columns] == ["run", "window [s]", "n eff"]
    (run,) = [run for run in analysis.runs if run.waves is not None]
    assert run.waves is not None
    harmonics = waves_table(analysis, run.waves)
    bow = harmonics.rows[0]
    assert bow[0] == "bow [mm]"
    assert bow[2].strip().startswith("2.08")
    assert " ± " in bow[2]
    # virtual waves have no second harmonic, and what is not there has no phase
    assert bow[5].strip() == "–"
    fits = fits_table(analysis, group)
    assert fits.columns[-1].title == "true c"
    assert fits.rows[0][-1].strip().startswith("19.00")
    clearance = clearance_table(group.curve, length)
    assert "with allowance [m]" in [column.title for column in clearance.columns]
    full = [float(row[-2].strip()) for row in clearance.rows]
    least = [float(row[-1].strip()) for row in clearance.rows]
    assert all(b < a for a, b in zip(full, least, strict=True))
    formulas = formula_scores_table(group.comparison, length)
    greyed = {row[0] for mark, row in formulas.marked_rows if mark == "grey"}
    assert {"icorels", "yoshimura"} <= greyed
    numbers = formula_table(group.comparison.prediction, length, knots=False)
    # three runs of one speed make one column
    assert len(numbers.columns) == 1 + 5
    assert dict(limit_lines(group.comparison.prediction))["norrbin"] == "not for a canal"
    assert [column.title for column in case_table(scores).columns][-3:] == ["max", "unit", "note"]
    full_scale = full_scale_table(scores)
    assert full_scale.rows[0][-1] == "m"
    assert float(full_scale.rows[0][3].strip()) == pytest.approx(scores.details["rms_full_scale"][0], rel=5e-3)
    assert formula_table(passage.prediction, SHIP.L, knots=True).rows[0][0] == "huuska"


def test_terminal_text(analysis: SquatAnalysis, scores: CodeScores, passage: SquatForecast) -> None:
    text = squat_text(analysis)
    assert "channels: speed = speed, bow = bow, stern = stern" in text
    assert "± standard error" in text
    assert "true c" in text
    assert "run in waves" in text
    said = score_text(scores)
    assert "ranked by rms:" in said
    assert "totals over cases" in said
    lines = prediction_text(passage, inapplicable=lambda line: f"~{line}").splitlines()
    assert any(line.startswith("~icorels ") and "not for a canal" in line for line in lines)
    assert any(line.startswith("huuska") and "(" in line for line in lines)


def test_units_are_those_of_the_size_of_the_ship() -> None:
    assert shown_length(4.0) == (1000.0, "mm")
    assert shown_length(230.0) == (1.0, "m")
    assert shown_quantity("m/m", 230.0) == (1000.0, "mm/m")
    assert shown_quantity("", 4.0) == (1.0, "-")
    assert quantity_title("sinkage_cog") == "sinkage at CoG"
    assert with_error(7.0612, 0.0123) == "7.061 ± 0.012"
    assert with_error(3.0, 0.0) == "3"


def test_a_page_without_ship_or_curve(analysis: SquatAnalysis, tmp_path: Path) -> None:
    from towtank.squat.squat_campaign import command_line_squat

    file = tmp_path / "<one> & two.csv"
    file.write_text((Path(str(analysis.path)).parent / "run_06kn.csv").read_text())
    sections = {"ship": {"name": "s", "L": 2.875}, "channels": {"bow": "bow", "stern": "stern"}}
    page = render_squat_report(run_squat_campaign(command_line_squat([file], record={}, sections=sections)))
    assert "&lt;one&gt; &amp; two" in page
    assert 'id="curves-0"' not in page
    assert "no-curve" in page
