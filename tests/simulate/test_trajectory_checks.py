"""Contradicting channels of a trajectory."""

import numpy as np
import pytest

from towtank.core.errors import AuditError, ReadError
from towtank.simulate.trajectory import Trajectory
from towtank.simulate.trajectory_checks import audit_channels, check_samples


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_consistent_channels_pass(circle, zigzag, side):
    turn = circle(side=side).trajectory()
    assert audit_channels(turn) is None
    assert audit_channels(zigzag(side=side).trajectory(noise=0.002)) is None
    assert check_samples(turn, ("x", "y", "psi")) is None


def test_current_is_no_fault(circle):
    assert audit_channels(circle(current=(0.6, -0.4)).trajectory()) is None


def test_velocities_along_the_earth_axes_are_seen(circle):
    turn = circle().trajectory()
    north, east = turn.track_velocity()
    with pytest.raises(AuditError, match="along the earth-fixed axes -> turn them into the axes of the ship"):
        audit_channels(turn.with_columns("earth", u=north, v=east))


def test_file_is_named(circle):
    turn = circle().trajectory()
    with pytest.raises(AuditError, match=r"trial\.csv: 'r' is"):
        audit_channels(turn.with_columns("sign", r=-turn["r"]), "trial.csv")


def test_small_gaps_are_let_pass_and_wide_ones_not(circle):
    turn = circle().trajectory()
    lost = np.ones(len(turn), dtype=bool)
    lost[50:54] = False
    assert check_samples(Trajectory(turn.frame[lost], turn.ship, "turning"), ("psi",)) is None
    lost[50:90] = False
    with pytest.raises(ReadError, match="cut the record at the gap"):
        check_samples(Trajectory(turn.frame[lost], turn.ship, "turning"), ("psi",))
