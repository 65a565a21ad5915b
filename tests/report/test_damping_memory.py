"""Radiation memory, and several speeds, in page and folder of decays."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from towtank.decay.decay_analysis import run_decay_campaign
from towtank.decay.decay_results import DecayAnalysis
from towtank.decay.fluid_memory import simulate_memory_decay
from towtank.decay.transfer_function import TransferFunction
from towtank.report.damping_memory import draw_memory, memory_table, radiation_figure, retardation_figure
from towtank.report.damping_outputs import damping_text, write_damping
from towtank.report.damping_report import render_damping_report
from towtank.report.damping_speeds import draw_speeds, speed_figure, speed_table

MEMORY = TransferFunction(np.array([6e8, 0.0]), np.array([1.0, 0.6, 0.5]))
INERTIA = 8e10


@pytest.fixture(scope="module")
def analysis(tmp_path_factory: pytest.TempPathFactory) -> DecayAnalysis:
    """Decays with memory at two speeds."""
    folder = tmp_path_factory.mktemp("memory")
    omega = np.linspace(0.05, 6.0, 60)
    table = {"omega": omega, "B44": MEMORY.damping(omega), "A44": 2e10 + MEMORY.added_mass_difference(omega)}
    pd.DataFrame(table).to_csv(folder / "radiation.csv", index=False)
    time = np.arange(0.0, 160.0, 0.25)
    for speed in (0, 5):
        terms = {"b1": 0.0075 + 0.002 * speed, "b2": 0.03, "c1": 0.0987}
        angle = simulate_memory_decay(time, (math.radians(9.0), 0.0), terms, MEMORY, INERTIA)[:, 0]
        angle += math.radians(0.02) * np.random.default_rng(speed).standard_normal(time.size)
        pd.DataFrame({"time": time, "phi": angle}).to_csv(folder / f"{speed}.csv", index=False)
    (folder / "campaign.toml").write_text(
        '[decay]\nname = "waves"\n[channels]\nunit = "rad"\n[[records]]\nfile = "0.csv"\n'
        '[[records]]\nfile = "5.csv"\nspeed = 5.0\n'
        '[fit]\nmethods = ["integration"]\nrestoring = "linear"\n[memory]\ntable = "radiation.csv"\ninertia = 8e10\n'
    )
    return run_decay_campaign(folder / "campaign.toml")


def test_memory_stands_beside_the_fit_without_it(analysis: DecayAnalysis) -> None:
    frame = analysis.damping_frame()
    own = frame[(frame["method"] == "integration with memory") & (frame["group"] == "roll, 0 m/s")].set_index(
        "name"
    )
    assert list(own.index) == ["b1", "b2", "c1", "inertia"]
    assert own.loc["b1", "lower95"] < 0.0075 < own.loc["b1", "upper95"]
    assert own.loc["inertia", "unit"] == "kg m2"
    curve = analysis.equivalent_frame()
    plain, memory = (
        curve[(curve["method"] == name) & (curve["group"] == "roll, 0 m/s")]["alpha_e [1/s]"].to_numpy()
        for name in ("integration", "integration with memory")
    )
    np.testing.assert_allclose(memory, plain, rtol=5e-3)
    assert analysis.to_dict()["groups"][0]["memory"]["order"] == 2


def test_folder_has_the_tables_of_memory_and_speed(analysis: DecayAnalysis, tmp_path: Path) -> None:
    written = write_damping(analysis, tmp_path / "out", report=False)
    names = [path.name for path in written]
    assert names[:5] == [
        "damping.csv", "equivalent_damping.csv", "against_speed.csv", "radiation.csv", "retardation.csv",
    ]  # fmt: skip
    speeds = pd.read_csv(tmp_path / "out" / "against_speed.csv")
    assert speeds["speed [m/s]"].unique().tolist() == [0.0, 5.0]
    radiation = pd.read_csv(tmp_path / "out" / "radiation.csv")
    assert list(radiation.columns) == ["omega [rad/s]", "B", "B fitted", "A", "A fitted"]
    assert "radiation.csv" in (tmp_path / "out" / "provenance.json").read_text(encoding="utf-8")


def test_page_and_text_name_the_memory(analysis: DecayAnalysis) -> None:
    page = render_damping_report(analysis)
    for anchor in ("memory", "speeds"):
        assert f'<section id="{anchor}">' in page
    assert "Inertia given, restoring moment fitted." in page
    assert "order 2: R² 1.0000 of B" in page
    text = damping_text(analysis)
    assert "radiation memory of order 2" in text
    assert "waves make" in text


def test_tables_and_drawings(analysis: DecayAnalysis) -> None:
    memory = analysis.groups[0].memory
    assert memory is not None
    assert [column.title for column in memory_table(memory).columns][-2:] == ["waves [%]", "I + A(ω) [kg m2]"]
    assert len(draw_memory(memory, "g1")) == 3
    assert [row[2] for row in speed_table(analysis.groups).rows] == ["0", "5"]
    assert [one.caption for one in draw_speeds(analysis.groups)][1:] == [
        "b1 with 95 % intervals.", "b2 with 95 % intervals.",
    ]  # fmt: skip
    assert speed_table(analysis.groups[:1]).rows == ()


@pytest.mark.parametrize("name", ["B", "A", "K", "speed"])
def test_figures_take_and_return_axes(name: str, analysis: DecayAnalysis) -> None:
    memory = analysis.groups[0].memory
    assert memory is not None
    draw = {
        "B": lambda ax: radiation_figure(memory, "B", ax=ax),
        "A": lambda ax: radiation_figure(memory, "A", ax=ax),
        "K": lambda ax: retardation_figure(memory, ax=ax),
        "speed": lambda ax: speed_figure(analysis.groups, ax=ax),
    }[name]
    ax = Figure().add_subplot()
    assert draw(ax) is ax
    assert ax.lines
    assert "[" in ax.get_xlabel()
    assert "[" in ax.get_ylabel()
    assert isinstance(draw(None), Axes)
