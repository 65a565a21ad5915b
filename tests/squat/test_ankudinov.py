"""What propellers, bulb, transom, static trim and banks do in Ankudinov's formula."""

import pytest

from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.prediction import predict

SHIP = Ship("bulk", L=216.0, B=32.2, T=12.5, volume=72160.2)


def at(place, **options):
    return predict(SHIP, 15.0, [4.0], **options).of("ankudinov", place)[0]


def test_middle_is_the_mean_of_the_ends():
    assert at("middle") == pytest.approx(0.5 * (at("bow") + at("stern")), rel=1e-12)


def test_second_propeller_sinks_less():
    assert at("middle", propellers=2) / at("middle") == pytest.approx(1.13 / 1.15, rel=1e-12)


@pytest.mark.parametrize("without", [{"bulb": False}, {"transom": False}, {"static_trim": -0.1}])
def test_bulb_and_transom_keep_the_bow_up_as_trim_by_the_stern_does(without):
    assert at("bow", **without) > at("bow")
    assert at("middle", **without) == pytest.approx(at("middle"), rel=1e-12)


def test_trench_lies_between_open_water_and_canal():
    trench = at("middle", channel=Fairway.trench(15.0, 150.0, 7.5))
    canal = at("middle", channel=Fairway.canal(15.0, 150.0))
    assert at("middle") < canal
    assert trench < canal
