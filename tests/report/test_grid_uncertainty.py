"""Text, plain data, figures and folder of a refinement study."""

import json
import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.core.findings import Finding
from towtank.report.grid_uncertainty_figures import convergence_figure, curve_uncertainty_figure
from towtank.report.grid_uncertainty_outputs import (
    require_grid_uncertainty_folder,
    uncertainty_data,
    write_grid_uncertainty,
)
from towtank.report.grid_uncertainty_report import render_grid_uncertainty
from towtank.report.grid_uncertainty_tables import methods_table, uncertainty_records, uncertainty_text
from towtank.verify import METHODS, UNCERTAINTY_COLUMNS, curve_uncertainty, numerical_uncertainty
from towtank.verify.refinement_study import Refinement, RefinementStudy, study_uncertainty

H = np.array([1.0, 1.5, 2.0])


def study(values, name="X", unit="N", time_step=None):
    part = None if time_step is None else Refinement(np.array(time_step), H)
    return study_uncertainty(RefinementStudy(name, unit, Refinement(np.array(values), H), part))


def test_text_names_class_methods_and_choice():
    text = uncertainty_text([study([1.1, 1.225, 1.4])])
    assert text.startswith(
        "X [N]: monotone convergent; R = 0.7143, refinement 1.5, 1.333, e_a 11.36 %, e_ext 10 %"
    )
    assert all(method in text for method in METHODS)
    assert text.endswith("-> factor of safety: U = 0.16, 14.5 % of 1.1")


def test_text_of_a_fine_value_of_zero_and_of_a_phase_has_no_percentage():
    assert "-> factor of safety: U = 0.16 about 0" in uncertainty_text([study([0.0, 0.125, 0.3])])
    assert "%" not in uncertainty_text([study([1.1, 1.225, 1.4], "heave_phase", "deg")]).splitlines()[-1]


def test_text_of_parts_ends_with_the_combination():
    text = uncertainty_text([study([1.1, 1.225, 1.4], time_step=[1.1, 1.225, 1.4])])
    assert "X (time step) [N]" in text
    assert text.splitlines()[-1].startswith("X, all parts: U = 0.2263 N")


def test_plain_data_has_no_nan():
    results = [study([1.0, 1.0, 1.0]), study([1.1, 1.225, 1.4])]
    text = json.dumps(
        uncertainty_data(results, [Finding("small-refinement", "info", "r21 is 1.2")]), allow_nan=False
    )
    equal, converging = json.loads(text)["quantities"]
    assert equal["class"] == "equal solutions"
    assert equal["order"] is None
    assert converging["order"] == pytest.approx(2.0)
    assert converging["gci_percent"] == pytest.approx(12.5 / 1.1)
    assert [one["method"] for one in converging["methods"]] == list(METHODS)
    assert converging["chosen"]["method"] == "factor of safety"


def test_relative_numbers_of_celik_are_in_the_data():
    h = [1.0, 1.5, 2.0]
    (record,) = uncertainty_records(
        [study_uncertainty(RefinementStudy("x", "", Refinement([6.063, 5.972, 5.863], h)))]
    )
    assert record["relative_change_percent"] == pytest.approx(1.501, abs=5e-4)
    assert record["relative_extrapolation_percent"] == pytest.approx(1.710, abs=5e-4)
    assert record["gci_percent"] == pytest.approx(2.175, abs=5e-4)


def test_convergence_plot_shows_law_band_and_limit():
    result = numerical_uncertainty([1.1, 1.225, 1.4], H, quantity="X", unit="N")
    ax = convergence_figure(result)
    labels = ax.get_legend_handles_labels()[1]
    assert set(labels) == {"h^2.00", "computed", "extrapolated", "U, factor of safety"}
    law = next(line for line in ax.lines if line.get_label() == "h^2.00")
    assert np.interp(H, law.get_xdata(), law.get_ydata()) == pytest.approx(result.values, abs=1e-3)
    assert ax.get_ylabel() == "X [N]"


@pytest.mark.parametrize("values", [[1.0, 1.1, 0.9], [1.0, 1.3, 1.35], [1.0, 1.0, 1.0]])
def test_no_law_is_drawn_where_there_is_none(values):
    ax = convergence_figure(numerical_uncertainty(values, H, quantity="X"))
    assert not any(label.startswith(("h^", "fit")) for label in ax.get_legend_handles_labels()[1])


def test_a_low_order_is_drawn_with_its_limit():
    ax = convergence_figure(numerical_uncertainty([1.0, 1.1, 1.18], H, quantity="X"))
    assert "h^0.50" in ax.get_legend_handles_labels()[1]


def test_least_squares_are_drawn_through_many_grids():
    h = np.array([1, 1.5, 2, 2.5, 3])
    ax = convergence_figure(numerical_uncertainty([1.0102, 1.0231, 1.0405, 1.0629, 1.0885], h, quantity="C"))
    assert "fit, h^1.88" in ax.get_legend_handles_labels()[1]


def test_curve_plot_has_a_line_a_grid_and_a_band():
    x = np.linspace(1.0, 4.0, 4)
    found = curve_uncertainty([x] * 3, [x * (1.0 + 0.01 * h**2) for h in H], H, quantity="Y", unit="N")
    ax = curve_uncertainty_figure(found, name="beta")
    assert len(ax.lines) == 3
    assert ax.get_xlabel() == "beta"
    assert ax.get_ylabel() == "Y [N]"


def test_folder_is_complete_and_reads_back(tmp_path):
    out = tmp_path / "out"
    files = write_grid_uncertainty(
        [study([1.1, 1.225, 1.4]), study([1.0, 1.1, 0.9], "Y")], out, title="two forces"
    )
    names = ["uncertainty.csv", "chosen_uncertainty.csv", "uncertainty.json", "report.html", "provenance.json"]
    assert [path.name for path in files] == names
    table = pd.read_csv(out / "uncertainty.csv")
    assert list(table.columns) == list(UNCERTAINTY_COLUMNS)
    assert len(table) == 2 * len(METHODS)
    chosen = pd.read_csv(out / "chosen_uncertainty.csv")
    assert list(chosen["method"]) == ["factor of safety", "data range"]
    assert list(chosen["uncertainty"]) == pytest.approx([0.16, 0.1])
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 2
    assert "oscillatory convergent" in page
    assert "http" not in page.replace("http://www.w3.org", "")


def test_no_report_when_not_wanted(tmp_path):
    write_grid_uncertainty([study([1.1, 1.225, 1.4])], tmp_path / "out", title="x", report=False)
    assert not (tmp_path / "out" / "report.html").exists()


def test_page_shows_curves_findings_and_choices():
    x, h = np.tile([2.0, 4.0], 3), np.repeat(H, 2)
    curve = study_uncertainty(RefinementStudy("Y", "N", Refinement(x * (1.0 + 0.1 * h**2), h, x)))
    warning = Finding("refinement-ratio", "warning", "r21 is 1.2, not the assumed 1.4")
    page = render_grid_uncertainty(
        [curve], title="curve", findings=[warning], choices={"method": "default"}, over="beta"
    )
    assert 'id="curves"' in page
    assert "not the assumed 1.4" in page
    assert page.count("<svg") == 3


def test_methods_table_marks_the_one_that_counts():
    part = numerical_uncertainty([1.1, 1.225, 1.4], H)
    table = methods_table(part, "GCI Celik")
    assert table.marks[METHODS.index("GCI Celik")] == "first"
    assert sum(mark == "first" for mark in table.marks) == 1
    assert math.isnan(part["Eca-Hoekstra"].uncertainty)


def test_a_folder_of_other_results_is_refused(tmp_path):
    (tmp_path / "provenance.json").write_text('{"format": "towtank validation 1"}', encoding="utf-8")
    with pytest.raises(TowtankError, match="results of another kind"):
        require_grid_uncertainty_folder(tmp_path)
