"""Figures, tables, page and folder of a decay campaign."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from towtank.core.errors import TowtankError
from towtank.decay.decay_analysis import analyse_decays, run_decay_campaign
from towtank.decay.decay_results import DecayAnalysis
from towtank.decay.shipped_decay import write_decay_campaign
from towtank.report.damping_drawings import draw_group, true_damping
from towtank.report.damping_figures import (
    coefficient_ellipse,
    decay_record_figure,
    decay_residual_figure,
    equivalent_damping_figure,
    extinction_figure,
    ikeda_figure,
    shown_unit,
)
from towtank.report.damping_outputs import damping_text, write_damping
from towtank.report.damping_report import SECTIONS, render_damping_report
from towtank.report.damping_tables import equivalent_table, method_table, models_table, terms_table


@pytest.fixture(scope="module")
def analysis(tmp_path_factory: pytest.TempPathFactory) -> DecayAnalysis:
    """The shipped virtual decay by two methods."""
    path = write_decay_campaign(tmp_path_factory.mktemp("decay"))
    path.write_text(path.read_text().replace('methods = ["all"]', 'methods = ["integration", "extinction curve"]'))
    return run_decay_campaign(path)


@pytest.mark.parametrize("name", ["record", "extinction", "equivalent", "residual", "ellipse", "ikeda"])
def test_figures_take_and_return_axes(name: str, analysis: DecayAnalysis) -> None:
    (group,) = analysis.groups
    fit, truth = group.preferred, analysis.truth
    assert group.ikeda is not None
    draw = {
        "record": lambda ax: decay_record_figure(group.records[0], fit, ax=ax),
        "extinction": lambda ax: extinction_figure(group.records, fit, ax=ax),
        "equivalent": lambda ax: equivalent_damping_figure(
            group.comparisons["linear+quadratic"].equivalent(), truth=true_damping(group, truth), ax=ax
        ),
        "residual": lambda ax: decay_residual_figure(fit, ax=ax),
        "ellipse": lambda ax: coefficient_ellipse(fit, ("b1", "b2"), truth=truth, ax=ax),
        "ikeda": lambda ax: ikeda_figure(group.ikeda, ax=ax),
    }[name]
    ax = Figure().add_subplot()
    assert draw(ax) is ax
    assert ax.lines
    assert "[" in ax.get_xlabel()
    assert "[" in ax.get_ylabel()
    assert isinstance(draw(None), Axes)


def test_envelope_runs_over_the_peaks(analysis: DecayAnalysis) -> None:
    (group,) = analysis.groups
    ax = decay_record_figure(group.records[0], group.preferred)
    envelope = next(line for line in ax.lines if line.get_label() == "envelope")
    own = group.preferred.runs[0]
    peaks = np.degrees(group.records[0].extremes.value)
    times = group.records[0].extremes.time
    top = peaks > 0.0
    wanted = np.interp(times[top], *map(np.asarray, envelope.get_data()))
    np.testing.assert_allclose(peaks[top], wanted, atol=0.25)
    assert float(np.max(np.degrees(own.fitted))) <= float(np.max(envelope.get_ydata())) + 0.05


def test_curve_of_the_coefficients_is_that_of_the_half_cycles(analysis: DecayAnalysis) -> None:
    """Loss of a half cycle of mean amplitude m for b1 and b2, to first order, in degrees."""
    (group,) = analysis.groups
    fit = group.preferred
    ax = extinction_figure(group.records, fit)
    line = next(line for line in ax.lines if line.get_label() == "integration")
    mean, loss = (np.radians(np.asarray(values)) for values in line.get_data())
    first_order = 0.5 * np.pi * fit["b1"] / fit.omega_n * mean + 4.0 / 3.0 * fit["b2"] * mean**2
    np.testing.assert_allclose(loss, first_order, rtol=0.02)


def test_heave_is_shown_in_mm() -> None:
    assert shown_unit("heave") == (1000.0, "mm")
    assert shown_unit("roll")[1] == "deg"


def test_page_is_self_contained_and_names_everything(analysis: DecayAnalysis) -> None:
    page = render_damping_report(analysis)
    for anchor, title in SECTIONS.items():
        if anchor in ("speeds", "memory"):
            assert f'id="{anchor}"' not in page
            continue
        assert f'<section id="{anchor}">' in page
        assert title in page
    assert "Virtual data." in page
    assert not re.search(r'(src|href)="(?!#)', page)
    identifiers = re.findall(r'<clipPath id="([^"]+)"', page)
    assert identifiers
    assert len(identifiers) == len(set(identifiers))
    assert "reduction.offset" in page


def test_page_without_a_ship_has_no_ikeda(analysis: DecayAnalysis) -> None:
    record = analysis.groups[0].records[0].whole
    bare = analysis.campaign.model_copy(update={"ship": None, "ikeda": None})
    other = analyse_decays(bare, [type(record)(record.time, record.value, name="<one> & two", scale=record.scale)])
    page = render_damping_report(other)
    assert 'id="ikeda"' not in page
    assert "B44 [N m s]" not in page
    assert "&lt;one&gt; &amp; two" in page


def test_tables(analysis: DecayAnalysis) -> None:
    (group,) = analysis.groups
    methods = method_table(group, analysis.truth)
    assert [row[0] for row in methods.rows] == ["truth", "integration", "extinction curve"]
    assert "B44 [N m s]" in [column.title for column in equivalent_table(group).columns]
    models = models_table(group)
    assert models is not None
    said = {row[0]: row[-1] for row in models.rows}
    assert said["linear"] == "contradicted"
    assert said["linear+quadratic"] == "supported, with the fewest terms"
    assert [row[0] for row in terms_table(group).rows] == ["b1", "b2", "c1"]


def test_terminal_text_is_aligned(analysis: DecayAnalysis) -> None:
    lines = damping_text(analysis).splitlines()
    head = next(line for line in lines if line.startswith("method"))
    truth, integration = (
        next(line for line in lines if line.startswith(word)) for word in ("truth", "integration")
    )
    place = head.index("b1 [1/s]")
    assert truth[place:].startswith("0.0042")
    assert integration[place - 2 : place] == "  "
    assert "±" in integration


def test_folder_is_complete_and_tables_hold_every_digit(analysis: DecayAnalysis, tmp_path: Path) -> None:
    written = write_damping(analysis, tmp_path / "out", report=False)
    assert [path.name for path in written] == [
        "damping.csv", "equivalent_damping.csv", "damping.json", "provenance.json",
    ]  # fmt: skip
    table = pd.read_csv(tmp_path / "out" / "damping.csv")
    np.testing.assert_array_equal(table["value"][:3], analysis.groups[0].preferred.params)
    provenance = json.loads((tmp_path / "out" / "provenance.json").read_text(encoding="utf-8"))
    assert provenance["format"] == "towtank damping provenance 1"
    assert provenance["files"] == [path.name for path in written]
    assert provenance["campaign_file"] == "campaign.toml"


def test_folder_of_another_kind_is_refused(analysis: DecayAnalysis, tmp_path: Path) -> None:
    (tmp_path / "provenance.json").write_text('{"format": "towtank provenance 1"}')
    with pytest.raises(TowtankError, match="results of another kind"):
        write_damping(analysis, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["provenance.json"]


def test_drawings_of_a_group(analysis: DecayAnalysis) -> None:
    drawn = draw_group(analysis.groups[0], "g1", analysis.truth)
    assert len(drawn.records) == len(drawn.residuals) == 1
    assert drawn.ellipse is not None
    assert drawn.ellipse.caption.startswith("Correlation of b1 and b2: -0.9")
    assert "truth" in drawn.equivalent.svg
