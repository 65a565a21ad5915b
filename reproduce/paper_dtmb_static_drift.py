"""DTMB 5512 and 5415M in CFD (Gatin, Vukcevic and Jasak, MASHCON 2019): errors, scaling of forces, kinematics."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.scales import force_unit
from ..datasets import load_set
from ..pmm.planar_motion import prescribed_motion
from ..pmm.run_types import Run
from ..verify import relative_errors
from .case import Case, Paper, half_digit
from .closed_loop import mean_forces
from .printed_numbers import KNOT, printed_by, printed_rows, ship_of
from .rounding import spread_of

KEY = "dtmb-static-drift"

SPEED = 1.531
"""Carriage speed in m/s of the captive runs (Table 3)."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _errors()
    yield from _reference_area()
    yield from _particulars()
    yield from _pure_sway()
    yield from _self_propulsion()
    yield from _immersed_boundary()


def _errors() -> Iterator[Case]:
    sources = printed_by("dtmb5512-drift-errors", "source")
    for force in ("X", "Y", "N"):
        computed, measured = sources["CFD"][force], sources["EFD"][force]
        yield Case(
            KEY,
            "Table 3, static drift at 10 deg",
            f"(S - D)/D of {force} in %",
            sources["CFD"][f"{force}_error"],
            float(relative_errors([computed], [measured]).s_minus_d[0]),
            half_digit(1),
        )


def _reference_area() -> Iterator[Case]:
    """Which area makes newtons of the printed forces: that of the oblique towing tests of the same model."""
    ship = ship_of("dtmb5512-drift-errors")
    measured = printed_by("dtmb5512-drift-errors", "source")["EFD"]
    other = load_set("dtmb5512-drift-fn0.280-efd")
    run = Run("drift 10 deg", "static_drift", SPEED, drift_angle=math.radians(10))
    known = mean_forces(other, run)["Y"] * force_unit("Y", "LT", other.ship, SPEED)
    newtons = {
        scaling: {f: 1e-3 * measured[f] * force_unit(f, scaling, ship, SPEED) for f in ("X", "Y")}
        for scaling in ("LT", "L2")
    }
    nearest = min(newtons, key=lambda scaling: abs(math.log(newtons[scaling]["Y"] / known)))
    note = (
        f"the paper prints 0.5 rho V^2 L^2: Y of the measurement would be {newtons['L2']['Y']:.0f} N for a model "
        f"of {ship.displacement_mass:g} kg; 0.5 rho V^2 L T gives {newtons['LT']['Y']:.1f} N, and the oblique "
        f"towing derivatives of the same model at the same speed give {known:.1f} N"
    )
    yield Case(
        KEY,
        "equations 3 to 5",
        "reference area of X and Y",
        "L^2",
        {"LT": "L T", "L2": "L^2"}[nearest],
        0.0,
        "L T",
        note,
    )
    for scaling, force, value, decimals in (
        ("LT", "X", -9.25, 2),
        ("LT", "Y", 27.6, 1),
        ("L2", "X", -214.0, 0),
        ("L2", "Y", 637.0, 0),
    ):
        area = "L T" if scaling == "LT" else "L^2"
        yield Case(
            KEY,
            "equations 3 to 5",
            f"measured {force} in N with {area} (recomputed reference)",
            value,
            newtons[scaling][force],
            half_digit(decimals),
        )


def _particulars() -> Iterator[Case]:
    ship = ship_of("dtmb5512-drift-errors")
    block = float(ship.block_coefficient or math.nan)
    printed, draught = 0.506, 0.136
    yield Case(
        KEY,
        "Table 2, DTMB 5512",
        "block coefficient",
        printed,
        block * ship.T / draught,
        spread_of(lambda t: block * ship.T / t, (draught, 3)) + half_digit(3),
        expected=printed,
        note=f"with the printed draught of {ship.T:g} m the block coefficient is {block:.3f}; 0.136 m is the "
        "draught of this model in other papers",
    )


def _pure_sway() -> Iterator[Case]:
    (row,) = printed_rows("dtmb5512-sway-run")
    speed, amplitude, period = row["speed"], row["amplitude"], row["period"]
    run = Run("pure sway", "pure_sway", speed, frequency=2 * math.pi / period, sway_amplitude=amplitude)
    # sin(w t) passes through zero at t = 0 with the largest velocity.
    largest = float(prescribed_motion(run).at(np.zeros(1))["v"][0])
    yield Case(
        KEY,
        "text, pure sway",
        "largest drift angle in deg",
        row["beta_max"],
        math.degrees(math.atan(largest / speed)),
        half_digit(0),
    )
    yield Case(
        KEY,
        "text, pure sway",
        "largest sway velocity in m/s (recomputed reference)",
        0.27075,
        largest,
        half_digit(5),
    )
    yield Case(
        KEY,
        "text, pure sway",
        "omega L/U (recomputed reference)",
        2.026,
        run.frequency * ship_of("dtmb5512-drift-errors").L / speed,
        half_digit(3),
    )


def _self_propulsion() -> Iterator[Case]:
    """DTMB 5415M, 1:35.48: 23.6 knots, propeller of 6.10 m at 14.32 1/s in the model (Tables 4 and 5, text)."""
    scale, length, knots, diameter, rate = 35.48, 142.0, 23.6, 6.10, 14.32
    speed = knots * KNOT / math.sqrt(scale)
    for quantity, printed, computed, decimals in (
        ("speed of the model in m/s", 2.038, speed, 3),
        ("length of the model in m (recomputed reference)", 4.002, length / scale, 3),
        ("propeller rate of the ship in 1/s (recomputed reference)", 2.404, rate / math.sqrt(scale), 3),
        ("apparent advance ratio (recomputed reference)", 0.828, speed / (rate * diameter / scale), 3),
    ):
        yield Case(KEY, "Table 4, DTMB 5415M", quantity, printed, computed, half_digit(decimals))


def _immersed_boundary() -> Iterator[Case]:
    """Resistance of the ONR Tumblehome on an immersed boundary, 92 kN, and on a body-fitted grid, 98 kN (text)."""
    yield Case(
        KEY,
        "text, immersed boundary",
        "difference of resistance in %",
        -6.0,
        float(relative_errors([92.0], [98.0]).s_minus_d[0]),
        half_digit(0),
    )


PAPER = Paper(
    KEY,
    "Gatin, Vukcevic and Jasak (2019), Predicting manoeuvring capabilities of a DTMB ship in CFD with dynamically "
    "controlled surfaces, 5th MASHCON, Ostend",
    cases,
)
