"""Propagated uncertainty: reading of runs, figures, text, page and folder."""

import json

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.report.uncertainty_figures import distribution_figure, sobol_figure
from towtank.report.uncertainty_outputs import (
    UncertaintyHeading,
    render_uncertainty,
    uncertainty_records,
    uncertainty_text,
    write_uncertainty,
)
from towtank.report.uncertainty_table import read_sampled_runs
from towtank.verify.input_distribution import UncertainInput
from towtank.verify.propagation import propagate_samples
from towtank.verify.sampling import latin_hypercube

INPUTS = (UncertainInput("speed", "normal", (1.2, 0.05)), UncertainInput("depth", "uniform", (0.3, 0.4)))
MEASURED = {"force": 13.0}


@pytest.fixture(scope="module")
def propagation():
    samples = latin_hypercube(INPUTS, 20, seed=2)
    values = pd.DataFrame({"force": 3.0 * samples["speed"] ** 2 / samples["depth"], "still": 2.0})
    return propagate_samples(INPUTS, samples, values, order=2)


def test_runs_are_read_with_their_names_left_out(tmp_path):
    path = tmp_path / "runs.csv"
    path.write_text("case,speed,depth,force,note\nA,1.2,0.3,5,ok\nB,1.3,0.4,6,\n", encoding="utf-8")
    runs = read_sampled_runs(path, ["depth", "speed"])
    assert runs.inputs.columns.tolist() == ["depth", "speed"]
    assert runs.outputs.columns.tolist() == ["force"]
    assert runs.left_out == ("case", "note")
    assert runs.inputs.iloc[1].tolist() == [0.4, 1.3]


@pytest.mark.parametrize(
    ("text", "outputs", "message"),
    [
        ("speed,force\n1,2\n", [], "no column 'depth'"),
        ("speed,depth\n1,2\n", [], "no column of outputs"),
        ("speed,depth,force\n", [], "no rows"),
        ("speed,depth,force\n1,x,2\n", [], "line 2: depth = 'x' is not a number"),
        ("speed,depth,force\n1,2,3\n1,2,failed\n", [], "line 3: force = 'failed' is not a number"),
        ("speed,depth,force\n1,2,3\n", ["moment"], "no column 'moment'"),
    ],
)
def test_faults_of_a_table_of_runs_are_named(tmp_path, text, outputs, message):
    path = tmp_path / "runs.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ReadError, match=message):
        read_sampled_runs(path, ["speed", "depth"], outputs)


def test_the_density_has_the_area_one_and_the_lines_stand_at_the_means(propagation):
    ax = distribution_figure(propagation, "force", measured=13.0)
    (steps,) = ax.patches[:1]
    data = steps.get_data()
    assert np.sum(data.values * np.diff(data.edges)) == pytest.approx(1.0)
    at = {line.get_label(): line.get_xdata()[0] for line in ax.lines}
    assert at["its mean ± sd"] == pytest.approx(propagation.expansion.mean[0])
    assert at["mean of the runs"] == pytest.approx(propagation.values["force"].mean())
    assert at["measured"] == 13.0


def test_an_output_that_does_not_vary_is_drawn_without_a_density(propagation):
    assert len(distribution_figure(propagation, "still").lines) == 3


def test_bars_of_the_shares_end_at_one(propagation):
    ax = sobol_figure(propagation)
    ends = [max(bar.get_x() + bar.get_width() for bar in group) for group in ax.containers]
    assert max(ends) == pytest.approx(1.0)
    assert [text.get_text() for text in ax.get_yticklabels()] == ["force", "still"]


def test_the_text_has_both_methods_and_the_error_against_the_measurement(propagation):
    text = uncertainty_text(propagation, MEASURED)
    assert "speed normal(1.2, 0.05) -> Hermite, depth uniform(0.3, 0.4) -> Legendre" in text
    assert "order 2: 6 coefficients from 20 runs (oversampling 3.33333)" in text
    assert "Monte Carlo" in text
    assert "(D-S)/D [%]" in text
    assert "(D-S)/D" not in uncertainty_text(propagation, {})


def test_plain_data_hold_no_nan(propagation):
    data = json.loads(json.dumps(uncertainty_records(propagation), allow_nan=False))
    assert data["order"] == 2
    assert data["statistics"][1]["method"] == "Monte Carlo"
    assert data["statistics"][1]["r2"] is None


def test_page_and_folder_are_complete(propagation, tmp_path):
    heading = UncertaintyHeading("runs & more", {"runs.csv": "1" * 64}, MEASURED)
    page = render_uncertainty(propagation, heading)
    assert page.count("<svg") == 3
    assert "runs &amp; more" in page
    written = write_uncertainty(propagation, tmp_path / "uq", heading)
    names = [path.name for path in written]
    assert names == ["statistics.csv", "sobol.csv", "coefficients.csv", "report.html", "provenance.json"]
    frame = pd.read_csv(tmp_path / "uq" / "statistics.csv")
    np.testing.assert_array_equal(frame["mean"], propagation.statistics()["mean"])
    provenance = json.loads((tmp_path / "uq" / "provenance.json").read_text())
    assert provenance["distributions"] == {"speed": "normal(1.2, 0.05)", "depth": "uniform(0.3, 0.4)"}
