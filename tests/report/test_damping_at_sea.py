"""Folder, text, page and figures of rolls at sea."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from towtank.decay.at_sea_analysis import run_at_sea_campaign
from towtank.decay.at_sea_results import AtSeaAnalysis
from towtank.decay.excited_roll import Excitation, simulate_excited_roll
from towtank.report.damping_at_sea import at_sea_text, write_at_sea
from towtank.report.damping_at_sea_report import (
    AT_SEA_SECTIONS,
    decrement_figure,
    excitations_table,
    render_at_sea_report,
    sea_record_figure,
    sea_terms_table,
    shares_table,
)
from towtank.report.damping_figures import equivalent_damping_figure

SHIP = {"b1": 0.080, "b3": 0.256, "c1": 11.88}


@pytest.fixture(scope="module")
def analysis(tmp_path_factory: pytest.TempPathFactory) -> AtSeaAnalysis:
    """Twelve virtual oscillations by all methods, the search cut short."""
    folder = tmp_path_factory.mktemp("sea")
    rng = np.random.default_rng(4)
    rate, state = math.sqrt(SHIP["c1"]), (0.001, 1.0)
    times, angles = [np.zeros(1)], [np.array([state[0]])]
    local = np.arange(0.0, 6.0 * math.pi / rate, 0.02)
    for _ in range(12):
        wave = Excitation(1.2 * rng.uniform(0.5, 1.5), rate * rng.uniform(0.7, 1.3), rng.uniform(0.0, 6.28), 0.0)
        path = simulate_excited_roll(local, state, SHIP, wave)
        upward = np.flatnonzero((path[:-1, 0] < 0.0) & (path[1:, 0] >= 0.0)) + 1
        last = int(upward[upward > 3][0])
        times.append(times[-1][-1] + local[1 : last + 1])
        angles.append(path[1 : last + 1, 0])
        state = (float(path[last, 0]), float(path[last, 1]))
    frame = pd.DataFrame({"time [s]": np.concatenate(times), "phi [deg]": np.degrees(np.concatenate(angles))})
    frame.to_csv(folder / "voyage.csv", index=False)
    truth = ", ".join(f"{name} = {value}" for name, value in SHIP.items())
    (folder / "campaign.toml").write_text(
        f'[decay]\nname = "a voyage"\nvirtual = true\ntruth = {{ {truth} }}\n[[records]]\nfile = "voyage.csv"\n'
        '[at_sea]\nterms = ["b1", "b3", "c1"]\nperiod = 1.8\nmost = 6\nleast_amplitude = 2.0\n'
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("towtank.decay.at_sea_analysis._SEARCH_MOVES", 5)
        return run_at_sea_campaign(folder / "campaign.toml")


def test_folder_is_complete(analysis: AtSeaAnalysis, tmp_path: Path) -> None:
    written = write_at_sea(analysis, tmp_path / "out")
    assert [path.name for path in written] == [
        "at_sea.csv", "excitations.csv", "equivalent_damping.csv", "damping.json", "report.html", "provenance.json",
    ]  # fmt: skip
    terms = pd.read_csv(tmp_path / "out" / "at_sea.csv")
    assert list(terms.columns) == ["method", "model", "name", "value", "std", "lower95", "upper95", "unit"]
    joint = terms[terms["method"] == "joint fit"].set_index("name")
    assert joint.loc["c1", "value"] == pytest.approx(SHIP["c1"], rel=1e-3)
    assert len(pd.read_csv(tmp_path / "out" / "excitations.csv")) == 6
    provenance = json.loads((tmp_path / "out" / "provenance.json").read_text(encoding="utf-8"))
    assert provenance["format"] == "towtank damping provenance 1"
    assert provenance["campaign"]["at_sea"]["most"] == 6
    assert [len(digest) for digest in provenance["inputs"].values()] == [64]
    assert json.loads((tmp_path / "out" / "damping.json").read_text())["records"][0]["name"] == "voyage"


def test_page_names_everything_and_needs_nothing(analysis: AtSeaAnalysis) -> None:
    page = render_at_sea_report(analysis)
    for anchor, title in AT_SEA_SECTIONS.items():
        assert f'<section id="{anchor}">' in page
        assert title in page
    assert "Virtual data." in page
    assert not re.search(r'(src|href)="(?!#)', page)
    identifiers = re.findall(r'<clipPath id="([^"]+)"', page)
    assert len(identifiers) == len(set(identifiers))
    assert "f sin(we t + phase) + f0" in page


def test_terminal_says_what_is_not_to_be_used(analysis: AtSeaAnalysis) -> None:
    text = at_sea_text(analysis)
    assert "period 1.8 s given" in text
    assert "joint fit of 6 oscillations" in text
    assert "shown as published, not to be used" in text
    assert "±" in text


def test_tables(analysis: AtSeaAnalysis) -> None:
    (one,) = analysis.records
    table = sea_terms_table(one, SHIP)
    assert table.columns[-1].title == "truth"
    shaded = [row for mark, row in table.marked_rows if mark == "weak"]
    assert {row[0] for row in shaded} >= {"discrete search, as published"}
    assert [row[0] for row in shares_table(one).rows] == ["b1", "b3", "c1"]
    assert len(excitations_table(one).rows) == 6


@pytest.mark.parametrize("name", ["record", "decrement"])
def test_figures_take_and_return_axes(name: str, analysis: AtSeaAnalysis) -> None:
    (one,) = analysis.records
    draw = {
        "record": lambda ax: sea_record_figure(one, ax=ax),
        "decrement": lambda ax: decrement_figure(one.decrements, ax=ax),
    }[name]
    ax = Figure().add_subplot()
    assert draw(ax) is ax
    assert ax.lines
    assert "[" in ax.get_xlabel()
    assert "[" in ax.get_ylabel()
    assert isinstance(draw(None), Axes)


def test_few_levels_are_points_with_intervals(analysis: AtSeaAnalysis) -> None:
    (one,) = analysis.records
    ax = equivalent_damping_figure(one.equivalent())
    assert len(ax.containers) == 1
    assert [line.get_label() for line in ax.lines if not line.get_label().startswith("_")] == ["joint fit"]
