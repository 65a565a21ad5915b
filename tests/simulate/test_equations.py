"""Right-hand side: hull forces against the derivative set's own, linear motion against the matrix exponential."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from towtank.core.conventions import Conventions
from towtank.core.derivative_set import DerivativeSet
from towtank.core.ship import Ship
from towtank.simulate.cross_flow import CrossFlow
from towtank.simulate.equations import cross_flow_drag, hull_forces
from towtank.simulate.manoeuvres import schedule, turning
from towtank.simulate.packing import pack
from towtank.simulate.parameters import NODES, Node, Parameter
from towtank.simulate.sailing import sail, sail_events
from towtank.simulate.ships import named_ship
from towtank.simulate.vessel import SteeringGear, Vessel


def kernel_forces(vessel, motion):
    """X, Y, N, K of the hull terms at midship as the kernel computes them."""
    packed = pack(vessel)
    p = packed.parameters[0]
    value = np.zeros(NODES + len(packed.products))
    u, v, r = motion["surge"], motion["v"] + p[Parameter.ORIGIN] * motion["r"], motion["r"]
    scale = vessel.speed if vessel.hull.conventions.velocity_scale == "approach" else math.hypot(u, v)
    value[Node.V], value[Node.R], value[Node.P] = v / scale, r / scale, motion["p"] / scale
    value[Node.PHI], value[Node.DELTA] = motion["phi"], motion["delta"]
    value[Node.DU], value[Node.SURGE] = (u - vessel.speed) / scale, u / scale
    value[Node.BETA] = math.atan2(-v, u)
    x, y, n, k = (f * scale**2 for f in hull_forces(packed.shape, packed.products, packed.nodes, p, value))
    return {"X": x, "Y": y, "N": n + p[Parameter.ORIGIN] * y, "K": k}


@pytest.mark.parametrize("name", ["kvlcc2", "kcs", "mariner", "s175-4dof", "s175-3dof", "dtc"])
@pytest.mark.parametrize(
    "changes", [{}, {"axes": "forward-port-up"}, {"angle_unit": "deg"}, {"rudder_sign": "port"}]
)
def test_kernel_evaluates_the_forces_of_the_set(name, changes):
    vessel = named_ship(name)
    vessel = vessel.with_hull(vessel.hull.to(vessel.hull.conventions, **changes))
    rng = np.random.default_rng(1)
    U, L = vessel.speed, vessel.ship.L
    for _ in range(5):
        motion = dict(zip(("v", "r", "p", "phi", "delta"), rng.uniform(-0.3, 0.3, 5), strict=True))
        motion |= {"surge": 0.9 * U, "v": motion["v"] * U, "r": motion["r"] * U / L, "p": motion["p"] * U / L}
        motion |= {"udot": 0.0, "vdot": 0.0, "rdot": 0.0, "pdot": 0.0}
        wanted = vessel.hull.forces(motion, approach_speed=U)
        found = kernel_forces(vessel, motion)
        size = max(abs(float(force)) for force in wanted.values())
        for component, force in wanted.items():
            assert found[component] == pytest.approx(float(force), rel=1e-10, abs=1e-12 * size)


def test_origin_at_the_centre_of_gravity_gives_the_forces_at_midship():
    vessel = named_ship("kvlcc2")
    moved = vessel.hull.to(vessel.hull.conventions.but(origin="cog", velocity_scale="approach"))
    vessel = vessel.with_hull(moved)
    motion = {"surge": 1.0, "v": 0.1, "r": 0.03, "p": 0.0, "phi": 0.0, "delta": 0.0}
    wanted = moved.forces(motion | {"udot": 0.0, "vdot": 0.0, "rdot": 0.0}, approach_speed=vessel.speed)
    found = kernel_forces(vessel, motion)
    for component, force in wanted.items():
        assert found[component] == pytest.approx(float(force), rel=1e-12)


def linear_vessel():
    """A ship with linear sway and yaw forces at constant surge velocity."""
    ship = Ship("linear", L=100.0, B=15.0, T=5.0, volume=5000.0, kzz=25.0, rho=1000.0)
    choices = Conventions(
        velocity_scale="approach", rigid_body_inertia="inside", added_mass_coriolis="inside", scale="full"
    )
    values = {
        "Xudot": -0.25, "Yvdot": -0.40, "Yrdot": -0.005, "Nvdot": -0.004, "Nrdot": -0.022,
        "Yv": -0.35, "Yr": -0.12, "Nv": -0.08, "Nr": -0.06, "Yd": -0.06, "Nd": 0.03,
    }  # fmt: skip
    hull = DerivativeSet.from_values("linear", ship, values, choices)
    return Vessel("linear", hull, 5.0, SteeringGear(rate=math.radians(3.0)))


def test_linear_ship_follows_the_matrix_exponential():
    vessel = linear_vessel()
    delta, length, speed = math.radians(10.0), 100.0, 5.0
    end = 60.0
    track = sail(vessel, schedule([0.0, end], [10.0, 10.0]), tolerance=1e-11)
    d = dict(zip(vessel.hull.names, vessel.hull.values, strict=True))
    inertia = -np.array([[d["Yvdot"], d["Yrdot"]], [d["Nvdot"], d["Nrdot"]]])
    damping = np.array([[d["Yv"], d["Yr"]], [d["Nv"], d["Nr"]]])
    rudder = np.array([d["Yd"], d["Nd"]]) * delta
    a = np.zeros((3, 3))
    a[:2, :2] = np.linalg.solve(inertia, damping) * speed / length
    a[:2, 2] = np.linalg.solve(inertia, rudder) * speed / length
    sway, yaw, _ = expm(a * end) @ [0.0, 0.0, 1.0]
    assert track["u"][-1] == 5.0
    assert track["v"][-1] == pytest.approx(sway * speed, rel=1e-9)
    assert track["r"][-1] == pytest.approx(yaw * speed / length, rel=1e-9)


_TWIN = """
import numpy as np
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.sailing import sail_events
from towtank.simulate.ships import named_ship
for name, programme in (("kvlcc2", turning(35, heading=70.0)), ("s175-4dof", zigzag(10, 3, overshoots=1))):
    events = sail_events(named_ship(name), programme, tolerance=1e-3).events
    for event in events.names:
        print(event, *(float(x).hex() for x in events[event][0]))
"""


def test_plain_python_twin_sails_the_same():
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    run = subprocess.run(
        [sys.executable, "-c", _TWIN], env=environment, capture_output=True, text=True, check=True
    )
    rows = iter(run.stdout.splitlines())
    from towtank.simulate.manoeuvres import zigzag

    for name, programme in (("kvlcc2", turning(35, heading=70.0)), ("s175-4dof", zigzag(10, 3, overshoots=1))):
        vessel = named_ship(name)
        events = sail_events(vessel, programme, tolerance=1e-3).events
        for event in events.names:
            row = next(rows)
            assert row.startswith(event)
            twin = np.array([float.fromhex(x) if x != "nan" else math.nan for x in row.split()[-11:]])
            scale = np.maximum(np.abs(events[event][0]), 1e-6 * vessel.ship.L)
            assert np.allclose(twin / scale, events[event][0] / scale, atol=1e-9, equal_nan=True)


def test_cross_flow_drag_slows_a_drifting_ship_as_its_integral_says():
    # a constant sectional drag in pure sway: Y = -0.5 rho L T C_D |v| v, and no moment
    vessel = named_ship("kvlcc2").but(cross_flow=CrossFlow.uniform(0.8))
    ship = vessel.ship
    packed = pack(vessel)
    force, moment = cross_flow_drag.py_func(packed.shape, packed.tables, 0.3, 0.0)
    assert force == pytest.approx(-0.5 * ship.rho * ship.L * ship.T * 0.8 * 0.09, rel=1e-12)
    assert moment == pytest.approx(0.0, abs=1e-9)
    free, dragged = (sail_events(one, turning(35)).events for one in (named_ship("kvlcc2"), vessel))
    drift = [np.arctan2(-e.at("end", "v")[0], e.at("end", "u")[0]) for e in (free, dragged)]
    assert drift[1] < drift[0]


def test_table_of_a_polynomial_sails_like_the_polynomial():
    vessel = named_ship("kvlcc2")
    advance_ratio = np.linspace(-0.1, 1.0, 221)
    thrust = np.polynomial.polynomial.polyval(advance_ratio, vessel.propeller.KT)
    tabulated = vessel.but(propeller=replace(vessel.propeller, KT=np.column_stack([advance_ratio, thrust])))
    polynomial, table = (sail_events(one, turning(35), tolerance=1e-7) for one in (vessel, tabulated))
    assert table.rates[0] == pytest.approx(polynomial.rates[0], rel=1e-5)
    for name in ("heading 90", "heading 180", "end"):
        assert table.events[name][0, :3] == pytest.approx(polynomial.events[name][0, :3], rel=1e-4)
