"""Sound campaigns give no finding across their runs, and each fault gives its own."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core import HOME, Conventions, DerivativeSet, Ship
from towtank.pmm.audit_campaign import RunSummary, audit_campaign
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.run_types import Run

DTMB = Ship("DTMB 5512", 3.048, 0.41, 0.136, volume=0.086, mass=86.0, Izz=49.99, rho=1000.0, scale=46.6)
TANKER = Ship("tanker", 7.0, 1.27, 0.455, volume=3.27, xG=0.25, kzz=1.75, rho=1000.0, scale=45.714)
FORM = Conventions(added_mass_coriolis="inside")

FRIGATE = {"R0": 0.0165, "Xvv": -0.14, "Xrr": -0.028, "Yv": -0.296, "Yvvv": -1.95, "Yr": -0.048, "Yrrr": -0.45}
FRIGATE |= {"Nv": -0.167, "Nvvv": -0.436, "Nr": -0.048, "Nrrr": -0.05, "Yvdot": -0.111, "Yrdot": -0.009}
FRIGATE |= {"Nvdot": -0.013, "Nrdot": -0.007, "Yd": -0.058, "Nd": 0.029}
FULL_FORM = {"R0": 0.022, "Xvv": -0.04, "Xrr": 0.011, "Xvvvv": 0.771, "Yv": -0.315, "Yr": 0.061, "Yvvv": -1.607}
FULL_FORM |= {"Yrrr": 0.008, "Nv": -0.137, "Nr": -0.049, "Nvvv": -0.03, "Nrrr": -0.013, "Yvdot": -0.223}
FULL_FORM |= {"Nrdot": -0.011, "Yd": -0.05, "Nd": 0.025}
HULLS = {
    "DTMB 5512": DerivativeSet.from_values("DTMB 5512", DTMB, FRIGATE, FORM),
    "tanker": DerivativeSet.from_values("tanker", TANKER, FULL_FORM, FORM),
}
SHIPS = [DTMB, TANKER]


def runs_of(ship: Ship) -> list[Run]:
    U = 0.28 * math.sqrt(9.81 * ship.L) if ship is DTMB else 0.142 * math.sqrt(9.81 * ship.L)
    w = 2.0 * U / ship.L
    runs = [
        Run(f"drift {a}", "static_drift", speed=U, drift_angle=math.radians(a))
        for a in (-16, -10, -4, 0, 4, 10, 16)
    ]
    runs += [Run(f"rudder {a}", "static_rudder", speed=U, rudder_angle=math.radians(a)) for a in (-20, 20)]
    runs += [Run(f"sway {a}", "pure_sway", speed=U, frequency=w, sway_amplitude=a * ship.L) for a in (0.03, 0.08)]
    runs += [Run(f"yaw {a}", "pure_yaw", speed=U, frequency=w, sway_amplitude=a * ship.L) for a in (0.03, 0.08)]
    return runs


def summaries(ship: Ship, *, inertia: int = 0, noise: float = 0.0, seed: int = 0) -> list[RunSummary]:
    """Summaries after reduction; `inertia` counts how often the ship's own inertia is still in the forces."""
    rng = np.random.default_rng(seed)
    unit = 0.5 * ship.rho * ship.L * ship.T
    mass, Izz = ship.displacement_mass, ship.yaw_inertia
    result = []
    for run in runs_of(ship):
        t = np.arange(64) / 64 * (run.period if run.harmonic else 1.0)
        m = prescribed_motion(run).at(t)
        force = HULLS[ship.name].forces(m, approach_speed=run.speed)
        force["Y"] = force["Y"] - inertia * mass * (m["vdot"] + m["surge"] * m["r"] + ship.xG * m["rdot"])
        force["N"] = force["N"] - inertia * (
            (Izz + mass * ship.xG**2) * m["rdot"] + mass * ship.xG * (m["vdot"] + m["surge"] * m["r"])
        )
        size = {name: noise * unit * run.speed**2 * (ship.L if name == "N" else 1.0) for name in force}
        mean = {name: float(value.mean() + size[name] * rng.standard_normal()) for name, value in force.items()}
        if not run.harmonic:
            result.append(RunSummary(run, mean))
            continue
        velocity = m["v"] if run.kind == "pure_sway" else m["r"]
        rate = m["vdot"] if run.kind == "pure_sway" else m["rdot"]
        V, A = float(np.sqrt(2.0) * velocity.std()), float(np.sqrt(2.0) * rate.std())
        first = {
            name: (
                float(2.0 * np.mean(value * velocity) / V + size[name] * rng.standard_normal()),
                float(2.0 * np.mean(value * rate) / A + size[name] * rng.standard_normal()),
            )
            for name, value in force.items()
        }
        result.append(RunSummary(run, mean, first, V, A))
    return result


def turned(given, factor_of):
    """Summaries with forces multiplied by ``factor_of(run)[name]``."""

    def times(one):
        factors = factor_of(one.run)
        mean = {name: value * factors.get(name, 1.0) for name, value in one.mean_force.items()}
        first = {
            name: (a * factors.get(name, 1.0), b * factors.get(name, 1.0))
            for name, (a, b) in one.first_harmonic.items()
        }
        return replace(one, mean_force=mean, first_harmonic=first)

    return [times(one) for one in given]


def rules(given, ship, *, fitted=None, inside=False):
    found = audit_campaign(given, ship, HOME, fitted, inertia_inside=inside)
    return {item.rule: item.severity for item in found}


@pytest.mark.parametrize("ship", SHIPS, ids=lambda ship: ship.name)
def test_sound_campaigns_give_no_finding(ship):
    assert rules(summaries(ship), ship) == {}
    for seed in range(5):
        noisy = summaries(ship, noise=0.0004, seed=seed)
        assert rules(noisy, ship, fitted=HULLS[ship.name]) == {}
        assert rules(noisy, ship, inside=True) == {}
    for kind in ("static_drift", "static_rudder", "pure_sway", "pure_yaw"):
        part = [one for one in summaries(ship) if one.run.kind == kind]
        assert rules(part, ship) == {}, kind
    assert rules([], ship) == {}


def every(*names, by=-1.0):
    return lambda run: dict.fromkeys(names, by)


def steady_only(*names):
    return lambda run: {} if run.harmonic else dict.fromkeys(names, -1.0)


@pytest.mark.parametrize("ship", SHIPS, ids=lambda ship: ship.name)
@pytest.mark.parametrize(
    ("rule", "factors"),
    [
        ("force-sign", every("X", "Y", "N")),
        ("force-sign", every("Y", "N")),
        ("force-sign", every("Y")),
        ("drift-sign", lambda run: {"Y": -1.0, "N": -1.0} if run.kind == "static_drift" else {}),
        ("rudder-sign", lambda run: {"Y": -1.0, "N": -1.0} if run.kind == "static_rudder" else {}),
        ("l2-against-lt", lambda run: dict.fromkeys("XYN", 1.0 / 22.4)),
        ("force-unit", every("X", "Y", "N", by=1000.0)),
        ("force-unit", every("X", "Y", "N", by=0.001)),
    ],
)
def test_signs_and_scaling(ship, rule, factors):
    assert rules(turned(summaries(ship, noise=0.0004), factors), ship) == {rule: "error"}


@pytest.mark.parametrize("ship", SHIPS, ids=lambda ship: ship.name)
def test_divided_by_l_squared(ship):
    slender = ship.L / ship.T
    drift = [one for one in summaries(ship) if one.run.kind == "static_drift"]
    for factor in (slender, 1.0 / slender):
        scaled = turned(drift, every("X", "Y", "N", by=factor))
        found = audit_campaign(scaled, ship, HOME, None, inertia_inside=False)
        assert [item.rule for item in found] == ["l2-against-lt"]
        assert f"{slender:.3g}" in found[0].message


def test_a_fitted_set_is_judged_where_no_run_shows_the_derivative():
    right = HULLS["tanker"]
    wrong = DerivativeSet.from_values("wrong", TANKER, {k: v / 15.4 for k, v in FULL_FORM.items()}, FORM)
    assert rules([], TANKER, fitted=right) == {}
    assert rules([], TANKER, fitted=wrong) == {"l2-against-lt": "error"}


@pytest.mark.parametrize("ship", SHIPS, ids=lambda ship: ship.name)
def test_inertia_inside_or_outside(ship):
    for seed in range(3):
        held = summaries(ship, inertia=1, noise=0.0004, seed=seed)
        assert rules(held, ship) == {"inertia-inside": "error"}
        assert rules(held, ship, inside=True) == {"inertia-inside": "error"}
        lost = summaries(ship, inertia=-1, noise=0.0004, seed=seed)
        assert rules(lost, ship, inside=True) == {"inertia-outside": "error"}


def test_inertia_is_told_from_sway_alone():
    sway = [one for one in summaries(TANKER, inertia=1) if one.run.kind == "pure_sway"]
    assert rules(sway, TANKER) == {"inertia-inside": "error"}
    unknown = replace(TANKER, volume=None)
    assert rules(sway, unknown) == {}, "without volume there is no mass to compare with"


@pytest.mark.parametrize("ship", SHIPS, ids=lambda ship: ship.name)
@pytest.mark.parametrize("x", [-0.5, 0.5])
def test_the_reference_point_of_the_moment(ship, x):
    moved = [
        replace(one, mean_force={**one.mean_force, "N": one.mean_force["N"] - x * ship.L * one.mean_force["Y"]})
        for one in summaries(ship)
        if one.run.kind == "static_drift"
    ]
    found = audit_campaign(moved, ship, HOME, None, inertia_inside=False)
    assert [item.rule for item in found] == ["moment-reference"]
    assert ("aft" if x < 0 else "fore") in found[0].message


def test_shallow_water_is_no_fault_of_scaling():
    shallow = replace(TANKER, depth=1.2 * TANKER.T)
    deep = [one for one in summaries(TANKER) if one.run.kind in ("static_drift", "pure_sway")]
    assert rules(turned(deep, every("X", "Y", "N", by=4.5)), shallow) == {}


def test_exchanged_forces_are_told_alone():
    crossed = [
        replace(one, mean_force={**one.mean_force, "X": one.mean_force["Y"], "Y": one.mean_force["X"]})
        for one in summaries(DTMB)
        if not one.run.harmonic
    ]
    assert rules(crossed, DTMB) == {"swapped-channels": "error"}


def test_faults_of_the_matrix_come_through():
    fast = [replace(one, run=replace(one.run, speed=12.0)) for one in summaries(DTMB) if not one.run.harmonic]
    assert rules(fast, DTMB)["scale-label"] == "error"


def test_runs_in_air_are_left_out():
    dry = RunSummary(
        Run("dry", "dry_sway", frequency=1.0, sway_amplitude=0.1), {"Y": 1e9}, {"Y": (0.0, 1e9)}, 0.1, 0.1
    )
    assert rules([*summaries(DTMB), dry], DTMB) == {}
