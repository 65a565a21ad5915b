"""Figures of ensembles: what is drawn, where limits stand, what cannot be drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.report.figure_style import BLUE, SKY, VERMILLION, inline_svg, new_axes
from towtank.report.manoeuvre_figures import (
    criterion_limit,
    elasticity_bars,
    heading_fan,
    index_histogram,
    manoeuvre_fan,
    trajectory_fan,
)
from towtank.simulate.ensembles import Ensemble, ensemble
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.ships import named_ship

TURN, ZIGZAG = "turning +35", "zigzag +10/10"


@pytest.fixture(scope="module")
def found() -> Ensemble:
    manoeuvres = [turning(35, 360), zigzag(10, overshoots=2)]
    return ensemble(named_ship("kvlcc2"), manoeuvres, n=200, percent=5, names=("Nv", "Nr", "Yv", "rudder.eps"))


def with_overshoots(found: Ensemble, values: np.ndarray) -> Ensemble:
    """The ensemble with other second overshoots."""
    changed = {**found.values, ZIGZAG: {**found.values[ZIGZAG], "overshoot 2": values}}
    return replace(found, values=changed)


def test_tracks_band_and_unperturbed_track(found):
    fan = found.fan(TURN, tracks=30)
    ax = trajectory_fan(fan)
    (lines,) = ax.collections
    assert len(lines.get_segments()) == 30
    assert len(ax.patches) == 1
    (line,) = ax.lines
    np.testing.assert_allclose(line.get_xdata(), fan.unperturbed["y"] / 7.0)
    np.testing.assert_allclose(line.get_ydata(), fan.unperturbed["x"] / 7.0)
    assert ax.get_xlabel() == "transfer y / L"
    assert not trajectory_fan(fan, tracks=False).collections


def test_headings_over_time_end_with_the_grid(found):
    fan = found.fan(ZIGZAG, tracks=20)
    ax = heading_fan(fan)
    heading, rudder = ax.lines
    np.testing.assert_allclose(heading.get_ydata(), np.degrees(fan.unperturbed["psi"]))
    assert np.nanmax(np.abs(rudder.get_ydata())) == pytest.approx(10.0)
    assert ax.get_xlim() == (0.0, fan.grid[-1])
    with pytest.raises(SimulationError, match="use trajectory_fan"):
        heading_fan(found.fan(TURN, tracks=5))


def test_a_fan_is_drawn_as_its_manoeuvre_is_usually(found):
    assert manoeuvre_fan(found.fan(ZIGZAG, tracks=5)).get_xlabel() == "time [s]"
    assert manoeuvre_fan(found.fan(TURN, tracks=5)).get_xlabel() == "transfer y / L"


def test_limits_of_the_criteria(found):
    assert criterion_limit(found, TURN, "advance") == 4.5
    assert criterion_limit(found, ZIGZAG, "overshoot 2") == pytest.approx(40.0)
    assert criterion_limit(found, ZIGZAG, "overshoot 3") is None
    assert criterion_limit(found, TURN, "transfer") is None


def test_histogram_counts_every_draw_and_tells_a_distant_limit(found):
    ax = index_histogram(found, TURN, "tactical diameter")
    assert sum(bar.get_height() for bar in ax.patches) == 200
    assert ax.lines[0].get_xdata()[0] == found.unperturbed[TURN]["tactical diameter"]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [
        "unperturbed",
        "IMO limit 5 L, passed by 100 %",
    ]
    assert ax.get_xlim()[1] < 5.0
    assert ax.get_xlabel() == "tactical diameter, turning +35 [L]"


def test_draws_beyond_the_limit_have_another_colour_and_those_without_value_do_not_pass(found):
    values = np.concatenate([np.linspace(20.0, 39.9, 120), np.linspace(40.1, 60.0, 60), np.full(20, np.nan)])
    ax = index_histogram(with_overshoots(found, values), ZIGZAG, "overshoot 2")
    beyond = [
        bar for bar in ax.patches if bar.get_facecolor()[:3] == pytest.approx((0.8353, 0.3686, 0.0), abs=1e-3)
    ]
    assert sum(bar.get_height() for bar in beyond if bar.get_width() > 0.0) == 60
    assert min(bar.get_x() for bar in beyond) == 40.0
    assert ax.get_legend().get_texts()[1].get_text() == "IMO limit 40 deg, passed by 60 %"
    assert VERMILLION in {line.get_color() for line in ax.lines}


def test_an_index_that_no_draw_has_is_an_error(found):
    with pytest.raises(SimulationError, match=r"no draw has an overshoot 2 of zigzag \+10/10"):
        index_histogram(with_overshoots(found, np.full(200, np.nan)), ZIGZAG, "overshoot 2")


def test_equal_draws_make_one_class(found):
    ax = index_histogram(with_overshoots(found, np.full(200, 14.0)), ZIGZAG, "overshoot 2")
    assert max(bar.get_height() for bar in ax.patches) == 200


def test_bars_of_elasticities_begin_with_the_largest(found):
    ax = elasticity_bars(found, ZIGZAG, "overshoot 2", most=3)
    widths = [bar.get_width() for bar in ax.patches]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["Nv", "rudder.eps", "Nr"]
    assert np.all(np.diff(np.abs(widths)) < 0.0)
    assert widths[0] > 2.0 > -1.0 > widths[1]
    assert ax.yaxis_inverted()
    colours = {bar.get_facecolor() for bar in ax.patches}
    assert len(colours) == 2
    assert BLUE != SKY


def test_without_a_regression_the_differences_are_drawn(found):
    few = ensemble(named_ship("kvlcc2"), turning(35, 360), n=4, percent=5, names=("Nv", "Nr", "Yv", "rudder.eps"))
    ax = elasticity_bars(few, TURN, "tactical diameter")
    table = few.elasticities.set_index(["index", "parameter"])
    assert ax.patches[0].get_width() == table.loc[("tactical diameter", "rudder.eps"), "first_order"]


def test_elasticities_of_an_unknown_index_are_an_error(found):
    with pytest.raises(SimulationError, match="no index 'overshot 1'"):
        elasticity_bars(found, ZIGZAG, "overshot 1")


def test_figures_take_axes_and_become_svg(found):
    ax = new_axes()
    assert index_histogram(found, ZIGZAG, "overshoot 1", ax=ax) is ax
    source = inline_svg(ax.figure, "h1", "histogram")
    assert source.startswith("<svg")
    assert "overshoot 1" in source
