"""Page, folder and text of a voyage."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure

from towtank.core.errors import TowtankError
from towtank.report.voyage_outputs import Voyage, voyage_text, write_voyage
from towtank.report.voyage_page import (
    render_voyage,
    summary_table,
    voyage_clearance_figure,
    voyage_figure,
    voyage_speed_figure,
)
from towtank.squat.virtual_voyage import virtual_voyage
from towtank.squat.voyage_file import load_voyage
from towtank.squat.voyage_reduction import reduce_voyage, voyage_provenance


@pytest.fixture(scope="module")
def analysis(tmp_path_factory: pytest.TempPathFactory) -> Voyage:
    path = virtual_voyage().write_folder(tmp_path_factory.mktemp("voyage"))
    path.write_text(path.read_text().replace('name = "virtual', 'name = "<virtual>', 1))
    found = reduce_voyage(path)
    return Voyage(load_voyage(path), tuple(found), voyage_provenance(path, found))


@pytest.mark.parametrize("draw", [voyage_figure, voyage_speed_figure, voyage_clearance_figure])
def test_figures_take_and_return_axes(draw, analysis: Voyage) -> None:  # type: ignore[no-untyped-def]
    ax = Figure().add_subplot()
    assert draw(analysis.runs[0], ax=ax) is ax
    assert ax.lines
    assert ax.get_xlabel() == "time [s]"
    assert "[m" in ax.get_ylabel()


def test_page_is_self_contained(analysis: Voyage) -> None:
    page = render_voyage(analysis)
    assert "&lt;virtual&gt; voyage" in page
    assert "Virtual data." in page
    for anchor in ("sinkage", "extremes", "clearance", "budget", "choices"):
        assert f'<section id="{anchor}">' in page
    assert not re.search(r'(src|href)="(?!#)', page)
    assert summary_table(analysis).rows[0][1] == "largest steady sinkage, longitudinal"


def test_folder_is_written_whole(analysis: Voyage, tmp_path: Path) -> None:
    write_voyage(analysis, tmp_path / "out")
    names = ["provenance.json", "report.html", "sensor_budget.csv", "voyage.csv", "voyage.json"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [*names, "voyage_summary.csv"]
    table = pd.read_csv(tmp_path / "out" / "voyage.csv")
    assert list(table.columns[:3]) == ["run", "time [s]", "speed [m/s]"]
    summary = pd.read_csv(tmp_path / "out" / "voyage_summary.csv").set_index("quantity")
    # 0.012 V^2 at 9 m/s and 4 cm/m of heel at 25.6 m, of which the mean over a minute takes 1 %
    expected = 0.972 + 0.04 * 25.6 * 0.99
    assert summary.loc["largest steady sinkage, lateral", "value"] == pytest.approx(expected, abs=0.03)
    assert json.loads((tmp_path / "out" / "provenance.json").read_text())["campaign"]["static"]["stop"] > 0.0
    (tmp_path / "file").write_text("")
    with pytest.raises(TowtankError, match="this is a file"):
        write_voyage(analysis, tmp_path / "file")


def test_text_names_the_extremes(analysis: Voyage) -> None:
    text = voyage_text(analysis)
    assert "largest steady sinkage, corner" in text
    assert "u_linear: all err to one side" in text
    assert "note: outbound:" in text
