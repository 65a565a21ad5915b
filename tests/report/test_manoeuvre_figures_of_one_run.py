"""Figures of single manoeuvres: what is drawn is what the indices say."""

from __future__ import annotations

import pytest

from towtank.report.turning_figure import track, turning_circle
from towtank.report.zigzag_figure import heading_and_rudder, speed_and_yaw_rate, spiral, zigzag
from towtank.simulate import manoeuvres
from towtank.simulate.manoeuvre_indices import indices
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship

SHIP = named_ship("kvlcc2")


def texts(ax) -> list[str]:
    return [text.get_text() for text in ax.texts if text.get_text()]


@pytest.mark.parametrize("rudder", [35.0, -35.0])
def test_the_lengths_of_a_turning_circle_are_written(rudder):
    circle = sail(SHIP, manoeuvres.turning(rudder))
    found = indices(circle).set_index("index")["value"]
    said = texts(turning_circle(circle))
    for name in ("advance", "transfer", "tactical diameter"):
        assert f"{name} {found[name]:.2f}" in said
    assert f"steady diameter\n{found['steady diameter']:.2f}" in said


def test_a_short_turn_has_no_tactical_diameter():
    said = texts(turning_circle(sail(SHIP, manoeuvres.turning(35.0, 120.0))))
    assert [text.split()[0] for text in said] == ["advance", "transfer"]


def test_each_overshoot_is_written():
    run = sail(SHIP, manoeuvres.zigzag(10.0))
    found = indices(run).set_index("index")["value"]
    assert texts(zigzag(run)) == [f"{found[f'overshoot {number}']:.1f}°" for number in (1, 2, 3)]


def test_other_figures_have_axes_with_units():
    run = sail(SHIP, manoeuvres.williamson())
    assert track(run).get_xlabel().startswith("y / L")
    for draw in (heading_and_rudder, speed_and_yaw_rate):
        assert draw(run).get_xlabel() == "time [s]"
    loop = spiral(sail(SHIP, manoeuvres.spiral()))
    assert [line.get_label() for line in loop.lines[-2:]] == ["out", "back"]
