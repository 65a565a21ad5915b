from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.cfd.grid_study import GridStudy
from towtank.cfd.shipped_sweep import run_virtual_sweep
from towtank.cfd.virtual_sweep import Histories
from towtank.report.cfd_grid_figures import derivative_convergence_figure
from towtank.report.cfd_grid_outputs import render_grid_study, write_grid_study
from towtank.report.cfd_grid_tables import grid_derivatives_table, grid_study_text, grids_table

DRIFT = tuple((beta, 0.0) for beta in (-4.0, 0.0, 4.0, 8.0, 12.0))


@pytest.fixture(scope="module")
def study(tmp_path_factory) -> GridStudy:
    return run_virtual_sweep(tmp_path_factory.mktemp("sweep"), histories=Histories(duration=30.0), motions=DRIFT)


def test_figure_shows_grids_limit_truth_and_measurement(study):
    axes = derivative_convergence_figure(study, "Yv")
    lines = [(line.get_xdata(), line.get_ydata()) for line in axes.lines]
    points = next(y for x, y in lines if np.array_equal(x, study.spacings))
    np.testing.assert_allclose(points, [one["Yv"] for one in study.sets])
    cross = next(y for x, y in lines if len(x) == 1 and x[0] == 0.0)
    row = study.uncertainty.table.set_index("name").loc["Yv"]
    assert cross[0] == pytest.approx(row["extrapolated"])
    assert any(np.allclose(y, -0.315) for _, y in lines)
    assert axes.get_ylabel() == "Yv"


def test_figure_of_a_real_study_has_no_truth(study):
    real = replace(study, truth=None, reference=None)
    assert len(derivative_convergence_figure(real, "Yv").lines) < len(
        derivative_convergence_figure(study, "Yv").lines
    )


def test_tables(study):
    derivatives = grid_derivatives_table(study)
    assert len(derivatives.rows) == len(study.derivatives.terms)
    assert [column.title for column in derivatives.columns][:4] == ["derivative", "value", "truth", "inside"]
    real = grid_derivatives_table(replace(study, truth=None))
    assert "truth" not in [column.title for column in real.columns]
    grids = grids_table(study)
    assert [row[0] for row in grids.rows] == ["1", "2", "3"]
    assert {row[-1].strip() for row in grids.rows} == {"5"}


def test_text_for_a_terminal(study):
    said = grid_study_text(study)
    assert "spacings 1, 1.41, 2" in said
    assert "against virtual tank, 2 % a derivative:" in said
    assert "truth" not in grid_study_text(replace(study, truth=None, validation=None)).replace("truths", "")


def test_page_without_experiment_and_truth(study):
    page = render_grid_study(replace(study, truth=None, reference=None, validation=None))
    assert "Virtual data" not in page
    assert 'id="validation"' not in page
    assert page.count("<svg") == len(study.derivatives.terms) + 6


def test_folder_without_a_page(study, tmp_path):
    written = write_grid_study(study, tmp_path / "out", report=False)
    assert [path.name for path in written] == [
        "derivatives.csv",
        "derivatives.json",
        "grid_derivatives.csv",
        "uncertainty.csv",
        "settled.csv",
        "validation.csv",
        "comparison.csv",
        "provenance.json",
    ]
