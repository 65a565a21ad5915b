"""Equivalent speed of Yoshimura's formula in a canal."""

import pytest

from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.prediction import predict


def test_canal_counts_as_a_higher_speed():
    ship = Ship("bulk", L=216.0, B=32.2, T=12.5, volume=72160.2)
    blockage = 0.98 * 32.2 * 12.5 / (15.0 * 150.0)
    canal = predict(ship, 15.0, [4.0], channel=Fairway.canal(15.0, 150.0)).of("yoshimura", "bow")
    faster = predict(ship, 15.0, [4.0 / (1 - blockage)]).of("yoshimura", "bow")
    assert canal[0] == pytest.approx(faster[0], rel=1e-12)
