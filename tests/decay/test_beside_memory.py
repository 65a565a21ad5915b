"""Memory beside the fits without it: what is known of inertia and restoring, at any scale."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.ship import Ship
from towtank.core.variables import GRAVITY
from towtank.decay.beside_memory import beside_memory
from towtank.decay.damping_models import DampingModel
from towtank.decay.decay_input import decay_from_table
from towtank.decay.fluid_memory import simulate_memory_decay
from towtank.decay.radiation_table import RadiationTable
from towtank.decay.transfer_function import TransferFunction

MEMORY = TransferFunction(np.array([6e8, 0.0]), np.array([1.0, 0.6, 0.5]))
OMEGA = np.linspace(0.05, 6.0, 80)
INFINITE, INERTIA = 2e10, 8e10
TABLE = RadiationTable(OMEGA, MEMORY.damping(OMEGA), INFINITE + MEMORY.added_mass_difference(OMEGA))
RESTORING = INERTIA * (2.0 * math.pi / 20.0) ** 2
TRUTH = {"b1": 0.0075, "b2": 0.03, "c1": RESTORING / INERTIA}
TIME = np.arange(0.0, 200.0, 0.25)
ANGLE = simulate_memory_decay(TIME, (math.radians(7.0), 0.0), TRUTH, MEMORY, INERTIA)[:, 0]

VOLUME = 40000.0
MASS = 1025.0 * VOLUME
HULL = {"name": "hull", "L": 180.0, "B": 30.0, "T": 10.0, "volume": VOLUME}
GYRATION = math.sqrt((INERTIA - INFINITE) / MASS)
METACENTRE = RESTORING / (MASS * GRAVITY)


def record(ship: Ship | None = None, scale: float = 1.0):
    return decay_from_table(
        {"time": TIME / math.sqrt(scale), "phi": ANGLE}, unit="rad", scale=scale, ship=ship, name="decay"
    )


@pytest.mark.parametrize(
    ("ship", "options", "known"),
    [
        ({}, {"inertia": INERTIA}, "inertia given, restoring moment fitted"),
        ({}, {"inertia": INERTIA, "restoring": RESTORING}, "inertia given, restoring moment given"),
        (
            {"kxx": GYRATION},
            {},
            "inertia from the ship's gyration and the added mass of the table, restoring moment fitted",
        ),
        ({"GM": METACENTRE}, {}, "restoring moment of the ship's GM, inertia fitted"),
        ({"GM": METACENTRE}, {"inertia": 6e10, "free": ["inertia"]}, "inertia fitted, restoring moment fitted"),
    ],
)
@pytest.mark.parametrize("scale", [1.0, 50.0])
def test_what_is_known_gives_the_terms_back(ship, options, known, scale):
    hull = Ship(**HULL, **ship)
    found = beside_memory([record(hull, scale)], DampingModel(), TABLE, **options)
    assert found.known == known
    assert found.identified.order == 2
    assert found.fit["b1"] == pytest.approx(TRUTH["b1"] * math.sqrt(scale), rel=2e-3)
    assert found.fit["b2"] == pytest.approx(TRUTH["b2"], rel=2e-3)
    assert found.fit.inertia == pytest.approx(INERTIA / scale**5, rel=2e-3)
    assert found.findings == ()


def test_damping_alone_with_the_metacentric_height():
    bare = RadiationTable(OMEGA, MEMORY.damping(OMEGA))
    found = beside_memory([record(Ship(**HULL, GM=METACENTRE))], DampingModel(), bare)
    assert found.fit.inertia == pytest.approx(INERTIA, rel=0.01)
    assert found.fit["b1"] == pytest.approx(TRUTH["b1"], rel=0.02)
    assert "A" not in found.to_frame()


def test_table_and_retardation_function_beside_what_was_fitted():
    found = beside_memory([record()], DampingModel(), TABLE, inertia=INERTIA)
    frame = found.to_frame()
    np.testing.assert_allclose(frame["B fitted"], frame["B"], rtol=1e-6)
    np.testing.assert_allclose(frame["A fitted"], frame["A"], rtol=1e-8)
    kernel = found.retardation()
    assert kernel["fitted"][0] == pytest.approx(6e8)
    assert np.abs(kernel["table"] - kernel["fitted"]).max() < 0.02 * 6e8


def test_order_can_be_given():
    assert beside_memory([record()], DampingModel(), TABLE, inertia=INERTIA, order=3).identified.order == 3


def test_a_metacentric_height_that_does_not_fit_is_told():
    found = beside_memory([record(Ship(**HULL, GM=0.5 * METACENTRE))], DampingModel(), TABLE, inertia=INERTIA)
    assert [item.rule for item in found.findings] == ["restoring-against-ship"]


def test_added_mass_that_does_not_belong_to_the_damping_is_told():
    wrong = RadiationTable(OMEGA, TABLE.damping, INFINITE - 3.0 * (TABLE.added_mass - INFINITE))
    found = beside_memory([record()], DampingModel(), wrong, inertia=INERTIA, order=2)
    assert "added-mass-disagrees" in [item.rule for item in found.findings]


def test_nothing_known_is_refused():
    with pytest.raises(FitError, match="neither the inertia I \\+ A_inf nor the restoring moment is known"):
        beside_memory([record()], DampingModel(), TABLE)
