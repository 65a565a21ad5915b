"""Width factor of Eryuzlu 1994."""

import pytest

from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.prediction import predict

SHIP = Ship("bulk", L=216.0, B=32.2, T=12.5, volume=72160.2)


def bow(channel=None):
    return predict(SHIP, 15.0, [4.0], channel=channel).of("eryuzlu", "bow")[0]


@pytest.mark.parametrize(("breadths", "factor"), [(4.0, 3.1 / 2.0), (9.0, 3.1 / 3.0), (10.0, 1.0)])
def test_channels_narrower_than_9_61_breadths(breadths, factor):
    channel = Fairway.canal(15.0, breadths * SHIP.B)
    assert bow(channel) / bow() == pytest.approx(factor, rel=1e-12)
