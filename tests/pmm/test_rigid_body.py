"""Inertia of what hangs on the balance: forces of Newton and Euler, identification from runs in air."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.errors import FitError
from towtank.core.record import Record
from towtank.pmm.campaign_file import Reduction
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.rigid_body import RigidBody, identify_rigid_body
from towtank.pmm.run_types import Run

BODY = RigidBody(mass=91.5, xG=0.07, Izz=52.3)

SWAY = Run("dry sway", "dry_sway", frequency=2.0, sway_amplitude=0.1)
YAW = Run("dry yaw", "dry_yaw", frequency=1.5, yaw_amplitude=0.15)


def oscillation(run: Run, reference: float = 0.0) -> dict[str, np.ndarray]:
    return prescribed_motion(run, reference).at(np.linspace(0.0, 2 * run.period, 400))


def readings(run: Run, body: RigidBody = BODY, reference: float = 0.0) -> tuple[dict, dict]:
    """Motion and what the balance reads in air: minus the inertia force."""
    motion = oscillation(run, reference)
    return motion, {name: -force for name, force in body.forces(motion).items()}


def test_forces_are_the_rate_of_change_of_momentum() -> None:
    """Newton and Euler in earth axes for the centre of gravity, moved to midship."""
    run = Run("both", "sway_yaw", speed=1.4, frequency=0.9, sway_amplitude=0.3, yaw_amplitude=0.2, yaw_phase=0.5)
    step = 1e-4
    t = 1.0 + step * np.arange(41)
    at = prescribed_motion(run).at(t)
    x = at["x"] + BODY.xG * np.cos(at["psi"])
    y = at["y"] + BODY.xG * np.sin(at["psi"])

    def second(values: np.ndarray) -> np.ndarray:
        return (-values[:-4] + 16 * values[1:-3] - 30 * values[2:-2] + 16 * values[3:-1] - values[4:]) / (
            12 * step**2
        )

    inner = {name: values[2:-2] for name, values in at.items()}
    ax, ay = second(x), second(y)
    cos, sin = np.cos(inner["psi"]), np.sin(inner["psi"])
    forces = BODY.forces(inner)
    np.testing.assert_allclose(forces["X"], BODY.mass * (ax * cos + ay * sin), atol=1e-4)
    np.testing.assert_allclose(forces["Y"], BODY.mass * (-ax * sin + ay * cos), atol=1e-4)
    about_gravity = BODY.Izz * second(at["psi"])
    np.testing.assert_allclose(forces["N"], about_gravity + BODY.xG * forces["Y"], atol=1e-4)


def test_steady_turn_needs_the_centripetal_force() -> None:
    run = Run("turn", "steady_yaw", speed=1.5, yaw_rate=0.2)
    forces = BODY.forces(prescribed_motion(run).at(np.zeros(1)))
    assert forces["Y"][0] == pytest.approx(BODY.mass * 1.5 * 0.2)
    assert forces["X"][0] == pytest.approx(-BODY.mass * BODY.xG * 0.2**2)
    assert forces["N"][0] == pytest.approx(BODY.mass * BODY.xG * 1.5 * 0.2)


@pytest.mark.parametrize("reference", [0.0, 0.25])
def test_dry_runs_give_the_body(reference: float) -> None:
    found = identify_rigid_body([readings(SWAY, reference=reference), readings(YAW, reference=reference)])
    assert found.mass == pytest.approx(BODY.mass, rel=1e-12)
    assert found.xG == pytest.approx(BODY.xG, rel=1e-10)
    assert found.Izz == pytest.approx(BODY.Izz, rel=1e-10)


def test_dry_runs_without_the_surge_channel() -> None:
    pairs = [
        (motion, {n: f for n, f in forces.items() if n != "X"}) for motion, forces in map(readings, (SWAY, YAW))
    ]
    assert identify_rigid_body(pairs).mass == pytest.approx(BODY.mass, rel=1e-12)


def test_noise_and_zero_of_the_balance_average_out() -> None:
    random = np.random.default_rng(2)
    pairs = []
    for motion, forces in map(readings, (SWAY, YAW)):
        noisy = {n: f + 3.0 + 0.05 * np.abs(f).max() * random.standard_normal(len(f)) for n, f in forces.items()}
        pairs.append((motion, noisy))
    found = identify_rigid_body(pairs)
    assert found.mass == pytest.approx(BODY.mass, rel=0.02)
    assert found.Izz == pytest.approx(BODY.Izz, rel=0.05)


def test_surge_oscillation_gives_the_mass_too() -> None:
    surge = Run("dry surge", "dry_surge", frequency=2.0, surge_amplitude=0.1)
    motion, forces = readings(surge)
    pairs = [(motion, {"X": forces["X"]}), readings(YAW)]
    assert identify_rigid_body(pairs).mass == pytest.approx(BODY.mass, rel=1e-12)


@pytest.mark.parametrize("run", [SWAY, YAW])
def test_one_kind_of_oscillation_is_not_enough(run: Run) -> None:
    with pytest.raises(FitError, match="do not separate mass and yaw inertia"):
        identify_rigid_body([readings(run)])


def test_wrong_sign_is_noticed() -> None:
    pairs = [(motion, {n: -f for n, f in forces.items()}) for motion, forces in map(readings, (SWAY, YAW))]
    with pytest.raises(FitError, match="a mass of -91"):
        identify_rigid_body(pairs)


def test_no_dry_run() -> None:
    with pytest.raises(FitError, match="no dry run"):
        identify_rigid_body([])


@pytest.mark.parametrize("run", [SWAY, YAW])
def test_dry_runs_can_be_reduced(ship, run: Run) -> None:
    """A model in air has no speed to scale forces with; the reduction must not need one."""
    t = run.period * np.arange(600) / 200
    motion = prescribed_motion(run).at(t)
    forces = {name: -force for name, force in BODY.forces(motion).items()}
    plan = ReductionPlan(Reduction(skip_cycles=0), ship, HOME, keep_series=frozenset({run.name}))
    result = reduce_run(Record({"time": t, **forces}), run, plan)
    np.testing.assert_allclose(result.series["N"], forces["N"], atol=1e-12)
    first = "Y" if run is SWAY else "N"
    assert np.abs(result.forces[first][1:3]).max() > 1.0
    assert np.isfinite(result.forces[first]).all()


def test_description_names_all_three() -> None:
    assert BODY.describe() == "m = 91.5 kg, xG = 0.07 m, Izz = 52.3 kg m2"


def test_inertia_inside_the_records_is_given_back(reduced, hull, ship) -> None:
    """Wet records with the body's inertia reduce to the forces without it."""
    run = Run("sway", "pure_sway", speed=1.5, frequency=0.9, sway_amplitude=0.2)
    (clean,) = reduced(hull, [run])
    t = run.period * np.arange(720) / 240
    motion = prescribed_motion(run).at(t)
    wet = hull.forces(motion, approach_speed=run.speed)
    record = {name: wet[name] - BODY.forces(motion)[name] for name in wet}
    result = reduce_run(
        Record({"time": t, **record}), run, ReductionPlan(Reduction(skip_cycles=0), ship, HOME, inertia=BODY)
    )
    for name in ("X", "Y", "N"):
        np.testing.assert_allclose(result.scaled[name], clean.scaled[name], atol=1e-13)
