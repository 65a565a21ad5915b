"""Fans of tracks: common grids, bands, ends."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.parameter_scatter import scatter_of, vessel_of_draw
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.track_fan import TrackFan, sail_fan

KVLCC2 = named_ship("kvlcc2")
SCATTER = scatter_of(KVLCC2, percent=5)
DRAWS = [vessel_of_draw(KVLCC2, SCATTER.names, row) for row in SCATTER.draws(12, seed=1)]


@pytest.mark.parametrize("rudder", [35, -35])
def test_circles_are_compared_at_equal_headings(rudder):
    fan = sail_fan(KVLCC2, turning(rudder, 360), DRAWS)
    assert fan.along == "heading"
    assert fan.grid[[0, -1]] == pytest.approx([0.0, 360.0], abs=1e-3)
    assert fan.tracks["x"].shape == (12, len(fan.grid))
    assert "time" in fan.tracks
    turned = np.degrees(np.sign(rudder) * fan.tracks["psi"])
    np.testing.assert_allclose(turned, np.tile(fan.grid, (12, 1)), atol=0.01)
    alone = sail(DRAWS[3], turning(rudder, 360)).events
    half = np.argmin(np.abs(fan.grid - 180.0))
    assert fan.tracks["y"][3, half] == pytest.approx(alone.at("heading 180", "y")[0], abs=0.01 * KVLCC2.ship.L)


def test_zigzags_are_compared_at_equal_times_while_most_still_sail():
    programme = zigzag(10, overshoots=2)
    fan = sail_fan(KVLCC2, programme, DRAWS, np.arange(100, 112))
    assert fan.along == "time"
    assert fan.numbers.tolist() == list(range(100, 112))
    ends = np.array([sail(vessel, programme)["time"][-1] for vessel in DRAWS])
    assert np.sum(ends >= fan.grid[-1]) >= 11
    beyond = fan.grid[None] > ends[:, None]
    np.testing.assert_array_equal(np.isnan(fan.tracks["psi"]), beyond)
    lower, upper = fan.band("psi")
    assert np.all(upper >= lower)
    assert np.all((lower <= fan.unperturbed["psi"] + 1e-9)[: len(lower) // 2])


def test_the_vessel_itself_is_a_band_without_width():
    fan = sail_fan(KVLCC2, turning(35, 180), [KVLCC2, KVLCC2])
    left, right = fan.track_band()
    np.testing.assert_allclose(left, right, atol=1e-12)
    np.testing.assert_allclose(left[:, 0], fan.unperturbed["x"], atol=1e-12)
    np.testing.assert_allclose(left[:, 1], fan.unperturbed["y"], atol=1e-12)


def test_band_of_circles_about_one_centre_is_a_ring():
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    radii = np.linspace(90.0, 110.0, 21)
    fan = TrackFan(
        "turning +35",
        100.0,
        "heading",
        np.degrees(angle),
        {"x": 100.0 * np.sin(angle), "y": -100.0 * np.cos(angle)},
        {"x": radii[:, None] * np.sin(angle), "y": -radii[:, None] * np.cos(angle)},
        np.arange(21),
    )
    left, right = fan.track_band(0.05, 0.95)
    assert sorted([np.linalg.norm(left[300]), np.linalg.norm(right[300])]) == pytest.approx(
        [91.0, 109.0], abs=0.01
    )
    np.testing.assert_allclose(np.linalg.norm(left, axis=1), np.linalg.norm(left[300]), atol=0.01)


def test_no_draw_makes_no_fan():
    with pytest.raises(SimulationError, match=r"no draw completed turning \+35"):
        sail_fan(KVLCC2, turning(35), [])
