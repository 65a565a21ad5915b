"""Turning circles and zig-zags a second: towtank's kernel, scipy on its plain-Python twin, and shipmmg.

Usage: python benchmarks/simulator_speed.py [--draws 8000] [--repeat 9] [--peer-python PATH]

The ship is the KVLCC2 L7 model, the manoeuvres are the 35 deg turning circle to 540 deg of heading and the 10/10
zig-zag with two overshoots. Printed:

* the coarsest tolerance at which advance and tactical diameter are within 1e-3 L of the converged values, and the
  overshoots within 0.02 deg, with circles and zig-zags a second at that tolerance on one core and on two;
* time of the first call with an empty cache of compiled code, and with a full one;
* circles a second of ``scipy.integrate.solve_ivp`` on the twin, at its own coarsest such tolerance;
* circles a second of shipmmg, same ship, manoeuvre and accuracy, and the ratio. It runs in this interpreter, or in
  that of ``--peer-python`` where it is installed; left out when it is in neither.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from unicodedata import normalize

import numpy as np

LADDER = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 1e-6, 1e-7)
ADVANCE_ERROR = 1e-3
OVERSHOOT_ERROR = 0.02

_IMPORT = f"import json, sys; sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})\n"

_FIRST_CALL = """
import time
start = time.perf_counter()
from towtank.simulate.manoeuvres import turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
sail(named_ship("kvlcc2"), turning(35))
print(time.perf_counter() - start)
"""


def turning_numbers(events, length):
    """Advance and tactical diameter over L, of each draw."""
    advance = events.at("heading 90", "x") / length
    return np.column_stack([advance, events.at("heading 180", "y") / length])


def overshoots(events):
    """First and second overshoot in degrees, of each draw."""
    return np.column_stack([np.abs(np.degrees(events.at(f"extreme {k}", "psi"))) - 10.0 for k in (1, 2)])


def coarsest(evaluate, allowed):
    """First tolerance of the ladder at which all numbers are within `allowed` of the converged ones, and there on."""
    truth = evaluate(1e-10)
    good = [bool(np.all(np.abs(evaluate(tolerance) - truth) <= allowed)) for tolerance in LADDER]
    first = next(i for i in range(len(LADDER)) if all(good[i:]))
    return LADDER[first]


def throughputs(vessel, programme, tolerance, draws, repeat):
    """Manoeuvres a second on one core, best of `repeat`, and how many times as fast two threads are.

    One thread and two take turns, so that what else the machine does meets both; the ratio is the median of theirs.
    """
    from towtank.simulate.sailing import sail_events

    rng = np.random.default_rng(1)
    values = vessel.hull.values * (1.0 + 0.01 * rng.standard_normal((draws, len(vessel.hull))))
    halves = np.array_split(values, 2)

    def sail(part):
        sail_events(vessel, programme, part, tolerance=tolerance)

    def seconds(function):
        start = time.perf_counter()
        function()
        return time.perf_counter() - start

    with ThreadPoolExecutor(2) as pool:
        pairs = [
            (seconds(lambda: sail(values)), seconds(lambda: list(pool.map(sail, halves)))) for _ in range(repeat)
        ]
    return draws / min(one for one, _ in pairs), float(np.median([one / two for one, two in pairs]))


def first_calls():
    """Seconds of the first call in a new process: with an empty cache of compiled code, then with a full one."""
    times = []
    with tempfile.TemporaryDirectory() as cache:
        environment = os.environ | {"NUMBA_CACHE_DIR": cache}
        for _ in range(2):
            run = subprocess.run(
                [sys.executable, "-c", _FIRST_CALL], env=environment, capture_output=True, text=True, check=True
            )
            times.append(float(run.stdout))
    return times


def scipy_circle(vessel, rate, tolerance):
    """One circle by solve_ivp on the plain-Python right-hand side; advance and tactical diameter over L."""
    from scipy.integrate import solve_ivp

    from towtank.simulate import parameters as place
    from towtank.simulate.equations import derivative
    from towtank.simulate.packing import pack

    packed = pack(vessel)
    control, environment = np.zeros(place.CONTROLS), np.zeros(4)
    value = np.zeros(place.NODES + len(packed.products))
    slope = np.zeros(place.STATES)
    order, gear = math.radians(35.0), vessel.gear.rate
    control[place.Control.SLEW] = gear

    def right_hand_side(t, state):
        control[place.Control.SLEW] = gear if state[place.State.DELTA] < order else 0.0
        arrays = (packed.shape, packed.products, packed.nodes, packed.parameters[0], packed.tables)
        derivative(state, control, *arrays, environment, value, slope)
        return slope.copy()

    def turned(angle):
        def event(t, state):
            return state[place.State.PSI] - math.radians(angle)

        event.terminal = angle == 540
        return event

    start = np.zeros(place.STATES)
    start[place.State.U], start[place.State.N] = vessel.speed, rate
    scale = np.ones(place.STATES)
    scale[[0, 1]] = vessel.ship.L
    found = solve_ivp(
        right_hand_side,
        (0.0, 1000.0),
        start,
        rtol=tolerance,
        atol=tolerance * scale,
        events=[turned(angle) for angle in (90, 180, 540)],
    )
    return np.array([found.y_events[0][0][0], found.y_events[1][0][1]]) / vessel.ship.L


def twin_circles():
    """Tolerance and circles a second of solve_ivp; meant for a process without compilation."""
    from towtank.simulate.packing import pack
    from towtank.simulate.self_propulsion import self_propulsion_rates
    from towtank.simulate.ships import named_ship

    vessel = named_ship("kvlcc2")
    rate = float(self_propulsion_rates(pack(vessel), vessel.speed)[0])
    tolerance = coarsest(lambda t: scipy_circle(vessel, rate, t), ADVANCE_ERROR)
    return tolerance, timed(lambda: scipy_circle(vessel, rate, tolerance))


def run_twin():
    """Numbers of :func:`twin_circles` from a process in which nothing is compiled."""
    script = _IMPORT + "from simulator_speed import twin_circles\nprint(json.dumps(twin_circles()))"
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    run = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    return json.loads(run.stdout)


def timed(function, seconds=3.0):
    """Calls a second of `function`, over about `seconds`."""
    function()
    start, calls = time.perf_counter(), 0
    while time.perf_counter() - start < seconds:
        function()
        calls += 1
    return calls / (time.perf_counter() - start)


def peer_case(vessel, rate, duration):
    """Ship and manoeuvre for shipmmg, in its names, as plain numbers."""
    ship, p, r = vessel.ship, vessel.propeller, vessel.rudder
    L, mass = ship.L, ship.displacement_mass
    unit = 0.5 * ship.rho * L**2 * ship.T
    basic = {
        "L_pp": L, "B": ship.B, "d": ship.T, "x_G": ship.xG, "D_p": p.D, "m": mass, "I_zG": ship.yaw_inertia,
        "A_R": r.area, "η": r.eta, "m_x": -vessel.hull["Xudot"] * unit, "m_y": -vessel.hull["Yvdot"] * unit,
        "J_z": -vessel.hull["Nrdot"] * unit * L**2, "f_α": r.f_alpha, "ϵ": r.eps, "t_R": r.tR, "x_R": r.xR * L,
        "a_H": r.aH, "x_H": r.xH * L, "γ_R_minus": r.gammaR_negative, "γ_R_plus": r.gammaR_positive, "l_R": r.lR,
        "κ": r.kappa, "t_P": p.tP, "w_P0": p.wP0, "x_P": p.xP,
    }  # fmt: skip
    names = ["vv", "vr", "rr", "vvvv"]
    forms = {f"X_{name}_dash": vessel.hull[f"X{name}"] for name in names}
    for force in "YN":
        forms |= {
            f"{force}_{name}_dash": vessel.hull[force + name] for name in ["v", "r", "vvv", "vvr", "vrr", "rrr"]
        }
    forms |= {"R_0_dash": vessel.hull["R0"], "k_0": p.KT[0], "k_1": p.KT[1], "k_2": p.KT[2]}
    return {
        "basic": basic, "forms": forms, "rho": ship.rho, "u0": vessel.speed, "rate": rate, "gear": vessel.gear.rate,
        "order": math.radians(35.0), "duration": duration,
    }  # fmt: skip


def peer_circles(case):
    """Advance, tactical diameter and circles a second of shipmmg at the coarsest of its tolerances that holds.

    Runs in the interpreter that has shipmmg; `case` is that of :func:`peer_case`.
    """
    from shipmmg.mmg_3dof import Mmg3DofBasicParams, Mmg3DofManeuveringParams, simulate_mmg_3dof

    t = np.linspace(0.0, case["duration"], 2000)
    delta = np.minimum(case["gear"] * t, case["order"])
    # Python spells identifiers in normal form KC, keywords of a mapping it leaves alone
    basic = Mmg3DofBasicParams(**{normalize("NFKC", name): value for name, value in case["basic"].items()})
    forms = Mmg3DofManeuveringParams(**case["forms"])

    def circle(tolerance):
        found = simulate_mmg_3dof(
            basic, forms, t, delta, np.full(len(t), case["rate"]), u0=case["u0"], ρ=case["rho"],
            rtol=tolerance, atol=tolerance,
        )  # fmt: skip
        state = found.sol(t)
        x, y, psi = state[3], state[4], state[5]
        numbers = np.interp(math.pi / 2, psi, x), np.interp(math.pi, psi, y)
        return np.array(numbers) / case["basic"]["L_pp"]

    tolerance = coarsest(circle, ADVANCE_ERROR)
    return *circle(1e-8).tolist(), tolerance, timed(lambda: circle(tolerance))


def run_peer(case, python):
    """Numbers of :func:`peer_circles`, from this interpreter or another; None when shipmmg is in neither."""
    script = _IMPORT + "from simulator_speed import peer_circles\n"
    script += "print(json.dumps(peer_circles(json.loads(sys.stdin.read()))))"
    run = subprocess.run(
        [python, "-c", script], input=json.dumps(case), capture_output=True, text=True, check=False
    )
    if run.returncode:
        print(run.stderr.strip().splitlines()[-1])
        return None
    return json.loads(run.stdout)


def main():
    """Measure and print."""
    from towtank.simulate.manoeuvres import turning, zigzag
    from towtank.simulate.sailing import sail_events
    from towtank.simulate.ships import named_ship

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=8000)
    parser.add_argument("--repeat", type=int, default=9)
    parser.add_argument("--peer-python", default=sys.executable)
    options = parser.parse_args()

    vessel = named_ship("kvlcc2")
    circle, weave = turning(35), zigzag(10, overshoots=2)
    converged = sail_events(vessel, circle, tolerance=1e-10)
    rate = float(converged.rates[0])
    vessel = replace(vessel, rate=rate)
    L = vessel.ship.L
    advance, diameter = turning_numbers(converged.events, L)[0]
    print(f"converged: advance {advance:.5f} L, tactical diameter {diameter:.5f} L, {rate:.4f} rps")

    circle_tolerance = coarsest(
        lambda t: turning_numbers(sail_events(vessel, circle, tolerance=t).events, L), ADVANCE_ERROR
    )
    weave_tolerance = coarsest(
        lambda t: overshoots(sail_events(vessel, weave, tolerance=t).events), OVERSHOOT_ERROR
    )
    circles = throughputs(vessel, circle, circle_tolerance, options.draws, options.repeat)
    weaves = throughputs(vessel, weave, weave_tolerance, options.draws, options.repeat)
    for name, tolerance, programme, (one, on_two) in (
        ("turning circle", circle_tolerance, circle, circles),
        ("10/10 zig-zag", weave_tolerance, weave, weaves),
    ):
        steps = int(sail_events(vessel, programme, tolerance=tolerance).steps[0])
        print(
            f"{name}: tolerance {tolerance:g}, {steps} steps, {one:.0f} a second and core, {on_two:.2f} x on two"
        )
    print(f"zig-zag over circle: {weaves[0] / circles[0]:.2f}")

    empty, full = first_calls()
    print(f"first call: {empty:.1f} s with compilation, {full:.2f} s from the cache")

    tolerance, plain = run_twin()
    print(
        f"solve_ivp on the twin: tolerance {tolerance:g}, {plain:.2f} circles a second, ratio {circles[0] / plain:.0f}"
    )

    end = float(converged.events.at("end", "time")[0])
    peer = run_peer(peer_case(vessel, rate, end), options.peer_python)
    if peer is None:
        print("shipmmg is not installed in this interpreter: give --peer-python")
        return
    peer_advance, peer_diameter, tolerance, rate_of_peer = peer
    print(f"shipmmg: advance {peer_advance:.5f} L, tactical diameter {peer_diameter:.5f} L at its finest")
    print(
        f"shipmmg: tolerance {tolerance:g}, {rate_of_peer:.2f} circles a second, ratio {circles[0] / rate_of_peer:.0f}"
    )


if __name__ == "__main__":
    main()
