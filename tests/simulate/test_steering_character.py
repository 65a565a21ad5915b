"""Course stability and Nomoto's indices of a ship in one table."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.nomoto import fit_nomoto
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.stability import straight_line_stability
from towtank.simulate.steering_character import COLUMNS, steering_frame


def test_hull_and_zigzags_stand_in_the_table():
    vessel = named_ship("kvlcc2")
    tracks = [sail(vessel, zigzag(10)), sail(vessel, turning(35))]
    frame = steering_frame(vessel, tracks)
    assert list(frame.columns) == list(COLUMNS)
    assert frame["subject"].unique().tolist() == ["hull", "zigzag +10/10"]
    values = frame.set_index(["subject", "quantity"])["value"]
    expected = straight_line_stability(vessel.hull)
    assert values["hull", "criterion C"] == expected.criterion
    assert values["hull", "root 1, real part"] == expected.roots[0].real
    fit = fit_nomoto(tracks[0]).scaled(vessel.ship, vessel.speed)
    assert values["zigzag +10/10", "K'"] == fit["K'"]
    assert values["zigzag +10/10", "T'"] == fit["T'"]
    assert 0.5 < values["zigzag +10/10", "R2 of the heading"] <= 1.0
    assert frame.attrs["left_out"] == []


def test_what_a_set_cannot_tell_is_said():
    vessel = named_ship("dtc")
    hull = vessel.hull.subset([name for name in vessel.hull.names if not name.startswith("N")])
    frame = steering_frame(vessel.with_hull(hull), [])
    assert len(frame) == 0
    (said,) = frame.attrs["left_out"]
    assert said.startswith("course stability of the hull: ")


@pytest.mark.parametrize("name", ["kvlcc2", "kcs", "mariner", "s175-3dof"])
def test_named_ships_have_a_verdict(name):
    frame = steering_frame(named_ship(name), [])
    assert np.isfinite(frame.loc[frame["quantity"] == "criterion C", "value"]).all()
