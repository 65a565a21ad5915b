"""The Mariner's turning circle by the rules of the textbook program: seven printed integers."""

import math

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.core.ship import Ship
from towtank.simulate.textbook_turning import textbook_turning
from towtank.simulate.trajectory import Trajectory

MARINER = Ship("Mariner", L=160.93, B=23.17, T=8.23)
SPEED, STEP = 7.7175, 0.1

# Chislett and Stroem-Tejsen (1965), times 1e5; an independent simulator, so that this test rests on no other room.
MASS = {
    "m": 798.0, "Iz": 39.2, "xG": -0.023, "Xudot": -42.0, "Yvdot": -748.0, "Nvdot": 4.646, "Yrdot": -9.354,
    "Nrdot": -43.8,
}  # fmt: skip


def forces(u: float, v: float, r: float, d: float) -> tuple[float, float, float]:
    """Forces in prime units, u being the deviation from the service speed."""
    x = -184 * u - 110 * u**2 - 215 * u**3 - 899 * v**2 + 18 * r**2 - 95 * d**2 - 190 * u * d**2 + 798 * r * v
    x += 93 * v * d + 93 * u * v * d
    y = -1160 * v - 499 * r - 8078 * v**3 + 15356 * v**2 * r - 1160 * v * u - 499 * r * u + 278 * d - 90 * d**3
    y += 556 * u * d + 278 * u**2 * d - 4 * v * d**2 + 1190 * v**2 * d - 4 - 8 * u - 4 * u**2
    n = -264 * v - 166 * r + 1636 * v**3 - 5483 * v**2 * r - 264 * v * u - 166 * r * u - 139 * d + 45 * d**3
    n += -278 * u * d - 139 * u**2 * d + 13 * v * d**2 - 489 * v**2 * d + 3 + 6 * u + 3 * u**2
    return x * 1e-5, y * 1e-5, n * 1e-5


def turn(order: float = math.radians(15.0), begin: float = 100.0, last: float = 700.0) -> Trajectory:
    """Fixed steps of 0.1 s by Euler's rule, and the order from the step whose time rounds to `begin` seconds."""
    length = MARINER.L
    count = round(last / STEP)
    m11 = (MASS["m"] - MASS["Xudot"]) * 1e-5
    m22, m23 = (MASS["m"] - MASS["Yvdot"]) * 1e-5, (MASS["m"] * MASS["xG"] - MASS["Yrdot"]) * 1e-5
    m32, m33 = (MASS["m"] * MASS["xG"] - MASS["Nvdot"]) * 1e-5, (MASS["Iz"] - MASS["Nrdot"]) * 1e-5
    det = m22 * m33 - m23 * m32
    u = v = r = x = y = psi = delta = 0.0
    out = np.zeros((count + 1, 8))
    for row in range(count + 1):
        time = row * STEP
        speed = math.hypot(SPEED + u, v)
        out[row] = time, x, y, psi, SPEED + u, v, r, delta
        command = order if math.floor(time + 0.5) >= begin else 0.0
        fx, fy, fn = forces(u / speed, v / speed, r * length / speed, delta)
        u_rate = fx / m11 * speed**2 / length
        v_rate = (m33 * fy - m23 * fn) / det * speed**2 / length
        r_rate = (m22 * fn - m32 * fy) / det * speed**2 / length**2
        north = math.cos(psi) * (SPEED + u) - math.sin(psi) * v
        east = math.sin(psi) * (SPEED + u) + math.cos(psi) * v
        slew = min(max(command - delta, -math.radians(5.0)), math.radians(5.0))
        u, v, x, y, psi = u + STEP * u_rate, v + STEP * v_rate, x + STEP * north, y + STEP * east, psi + STEP * r
        r, delta = r + STEP * r_rate, delta + STEP * slew
    names = ("time", "x", "y", "psi", "u", "v", "r", "delta")
    return Trajectory.from_columns(dict(zip(names, out.T, strict=True)), MARINER, "turning -15")


@pytest.fixture(scope="module")
def mariner() -> Trajectory:
    return turn()


def test_the_seven_integers_of_the_handbook(mariner):
    found = {name: round(value) for name, value in textbook_turning(mariner, 100.0).items()}
    assert found == {
        "rudder execute x": 769,
        "steady turning radius": 711,
        "maximum transfer": 1315,
        "maximum advance": 947,
        "transfer at 90": 534,
        "advance at 90": 943,
        "tactical diameter at 180": 1311,
    }


def test_interpolated_heading_is_reached_later(mariner):
    found = textbook_turning(mariner, 100.0)
    heading = np.degrees(np.abs(mariner["psi"]))
    assert np.interp(90.0, heading, np.abs(mariner["y"])) > found["transfer at 90"] + 1.0


def test_headings_that_were_not_reached_are_nan(mariner):
    short = Trajectory(mariner.frame[mariner["time"] < 250.0], MARINER, "turning")
    found = textbook_turning(short, 100.0)
    assert math.isnan(found["tactical diameter at 180"])


def test_order_outside_the_record(mariner):
    with pytest.raises(ReadError, match=r"execute = 800 s is outside"):
        textbook_turning(mariner, 800.0)
