"""Single-run relations: closed loops, the bias of the sinusoid assumption in pure yaw, averages."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import FitError
from towtank.pmm.campaign_file import Fit
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.reduced_run import ReducedRun
from towtank.pmm.run_types import Run
from towtank.pmm.single_run import average_over_runs, single_run_derivatives, single_run_table
from towtank.pmm.sinusoid_motion import sinusoid_motion

SPEED = 1.5311
APPROACH = HOME.but(velocity_scale="approach", added_mass_coriolis="inside")
SWAY_CFD = {
    "Xvv": -0.1177,
    "Yv": -0.2531,
    "Yvvv": -1.6411,
    "Nv": -0.1731,
    "Nvvv": -0.2837,
    "Yvdot": -0.1361,
    "Nvdot": -0.0153,
}
YAW_CFD = {
    "Xrr": -0.0264,
    "Yr": -0.0482,
    "Yrrr": -0.4169,
    "Nr": -0.0504,
    "Nrrr": -0.0473,
    "Yrdot": -0.0102,
    "Nrdot": -0.0068,
}


def dtmb(ship, values: dict[str, float]) -> DerivativeSet:
    """Set of the virtual captive tests of DTMB 5512, Fn 0.28, forces over the approach speed."""
    return DerivativeSet.from_values("DTMB 5512", ship, values, APPROACH, reference_speed=SPEED)


def pure_sway(v_max: float, w: float = 0.841, **more: float) -> Run:
    return Run(f"sway {v_max}", "pure_sway", speed=SPEED, frequency=w, sway_amplitude=v_max / w, **more)


def pure_yaw(r_max: float, w: float, kind: str = "pure_yaw", **more: float) -> Run:
    """Pure yaw with the printed r_max = eps w in rad/s."""
    name = f"{kind} {r_max} {more.get('drift_angle', 0.0):.3f}"
    return Run(name, kind, speed=SPEED, frequency=w, sway_amplitude=r_max * SPEED / w**2, **more)


def with_forces(run: ReducedRun, series: dict[str, np.ndarray]) -> ReducedRun:
    """The run with other scaled force series over its window."""
    from towtank.identify.harmonics import HarmonicProjector

    projector = HarmonicProjector(run.window.times, run.motion.omega, run.order)
    scaled = {name: projector.project(values) for name, values in series.items()}
    return replace(run, scaled=scaled, scaled_sd={name: np.full(7, 1e-4) for name in scaled})


@pytest.mark.parametrize("v_max", [0.053, 0.107, 0.266])
def test_pure_sway_of_dtmb_closes_the_loop(reduced, ship, v_max: float) -> None:
    """Table 16 into forces and back through the Fourier relations."""
    truth = dtmb(ship, SWAY_CFD)
    (run,) = reduced(truth, [pure_sway(v_max)], nondimensional_speed="approach")
    found = single_run_derivatives(run)
    for name, value in SWAY_CFD.items():
        assert found[name].value == pytest.approx(value, rel=1e-10)


@pytest.mark.parametrize(("amplitude", "phase"), [(-0.15, 0.0), (0.15, 0.9), (0.15, -2.2)])
def test_any_phase_and_sign_of_the_motion(reduced, ship, amplitude: float, phase: float) -> None:
    truth = dtmb(ship, SWAY_CFD)
    run = pure_sway(0.15, sway_phase=phase)
    run = replace(run, sway_amplitude=math.copysign(run.sway_amplitude, amplitude))
    (result,) = reduced(truth, [run], nondimensional_speed="approach")
    found = single_run_derivatives(result)
    for name, value in SWAY_CFD.items():
        assert found[name].value == pytest.approx(value, rel=1e-9)


def test_textbook_formulas(reduced, hull) -> None:
    """Yv = (c1 - 3 c3)/V, Yvvv = 4 c3/V^3, Yvdot = -s1/(w' V), Xvv = 2 c2/V^2, X0 = mean - c2."""
    (run,) = reduced(hull, [pure_sway(0.2, sway_phase=-math.pi / 2)])
    motion = sinusoid_motion(run)
    size = motion.amplitude
    force, sd = motion.turned(run.scaled["Y"], np.full(7, 2e-4))
    _, c1, s1, _, _, c3, _ = force
    found = single_run_derivatives(replace(run, scaled_sd=dict.fromkeys(run.scaled_sd, np.full(7, 2e-4))))
    assert found["Yv"].value == pytest.approx((c1 - 3 * c3) / size, rel=1e-12)
    assert found["Yvvv"].value == pytest.approx(4 * c3 / size**3, rel=1e-12)
    assert found["Yvdot"].value == pytest.approx(-s1 / (motion.frequency * size), rel=1e-12)
    assert found["Yv"].std == pytest.approx(2e-4 * math.sqrt(10) / size, rel=1e-12)
    assert found["Yvvv"].std == pytest.approx(4 * 2e-4 / size**3, rel=1e-12)
    assert found["Yvdot"].std == pytest.approx(2e-4 / (motion.frequency * size), rel=1e-12)
    surge, _ = motion.turned(run.scaled["X"], sd)
    assert found["Xvv"].value == pytest.approx(2 * surge[3] / size**2, rel=1e-12)
    assert found["X0"].value == pytest.approx(surge[0] - surge[3], rel=1e-12)


def test_modulus_form(reduced, ship) -> None:
    values = {"Yv": -0.2, "Yv|v|": -0.6, "Yvdot": -0.12, "X0": -0.02, "Nv": -0.1, "Nv|v|": 0.05, "Nvdot": -0.01}
    (run,) = reduced(dtmb(ship, values), [pure_sway(0.2)], samples=4000, cycles=1, nondimensional_speed="approach")
    found = single_run_derivatives(run, form="modulus")
    for name, value in values.items():
        assert found[name].value == pytest.approx(value, rel=1e-5)
    motion = sinusoid_motion(run)
    c1, c3 = motion.turned(run.scaled["Y"], run.scaled["Y"])[0][[1, 5]]
    assert found["Yv|v|"].value == pytest.approx(15 * math.pi * c3 / (8 * motion.amplitude**2), rel=1e-12)
    assert found["Yv"].value == pytest.approx((c1 - 5 * c3) / motion.amplitude, rel=1e-12)


def test_pure_yaw_of_dtmb_is_biased_by_the_sinusoid(reduced, ship) -> None:
    """Table 17, r_max 0.375 rad/s at 1.08 rad/s: the sinusoid relations miss Yr by more than half."""
    truth = dtmb(ship, YAW_CFD)
    (run,) = reduced(truth, [pure_yaw(0.375, 1.08)], nondimensional_speed="approach")
    found = single_run_derivatives(run)
    assert round(found["Yr"].value, 4) == -0.0199
    assert round(found["Yrrr"].value, 3) == -0.458
    assert round(found["Yrdot"].value, 5) == -0.00991


def test_exact_kinematics_recover_what_the_sinusoid_misses(reduced, ship) -> None:
    truth = dtmb(ship, YAW_CFD)
    runs = reduced(truth, [pure_yaw(0.375, 1.08)], nondimensional_speed="approach")
    fit = fit_hull(runs, Fit(), ship, name="exact", terms=truth.terms)
    for name, value in YAW_CFD.items():
        assert abs(fit.derivatives[name] - value) < 1e-9
    assert fit.derivatives.conventions == APPROACH.but(scale=fit.derivatives.conventions.scale)


def test_instantaneous_speed_makes_the_sinusoid_worse(reduced, ship) -> None:
    truth = DerivativeSet.from_values("x", ship, YAW_CFD, APPROACH.but(velocity_scale="instantaneous"))
    (run,) = reduced(truth, [pure_yaw(0.375, 1.08)])
    found = single_run_derivatives(run)
    assert found["Yr"].value == pytest.approx(-0.0076, abs=1e-4)
    assert found["Yrdot"].value == pytest.approx(-0.00912, abs=1e-5)


def test_gentle_pure_yaw_is_nearly_unbiased(reduced, ship) -> None:
    (run,) = reduced(dtmb(ship, YAW_CFD), [pure_yaw(0.025, 0.841)], nondimensional_speed="approach")
    found = single_run_derivatives(run)
    for name in ("Yr", "Nr", "Yrdot", "Nrdot", "Xrr"):
        assert found[name].value == pytest.approx(YAW_CFD[name], rel=2e-3)


def test_yaw_with_drift_on_sinusoids(reduced, hull) -> None:
    """Equations 8 and 9 of the DTC paper, inverted run by run."""
    r_max, beta = 0.1, math.radians(6)
    runs = reduced(
        hull,
        [
            pure_yaw(r_max, 0.841, "yaw_drift", drift_angle=beta),
            pure_yaw(r_max, 0.841),
            Run("static", "static_drift", speed=SPEED, drift_angle=beta),
        ],
    )
    series = []
    for run in runs[:2]:
        motion = sinusoid_motion(run)
        angle = run.motion.omega * run.window.times + motion.phase
        state = {"v": np.full(len(angle), motion.drift), "r": motion.amplitude * np.cos(angle)}
        state["rdot"] = -motion.frequency * motion.amplitude * np.sin(angle)
        state["vdot"] = np.zeros(len(angle))
        forces = {"X": 0.0, "Y": 0.0, "N": 0.0}
        for term in hull.terms:
            forces[term.component] = forces[term.component] + hull[term.name] * term.column(state)
        series.append(with_forces(run, forces))
    found = single_run_derivatives(series[0], companions=[*series, runs[2]])
    for name in ("Yvrr", "Yvvr", "Nvrr", "Nvvr", "Xvr"):
        assert found[name].value == pytest.approx(hull[name], rel=1e-10)
    for name in ("Yvrr", "Nvrr"):
        assert found[f"{name} from mean"].value == pytest.approx(hull[name], rel=1e-9)
    v0, size = sinusoid_motion(series[0]).drift, sinusoid_motion(series[0]).amplitude
    assert found["Yvrr"].std == pytest.approx(2 * 1e-4 / abs(v0 * size**2), rel=1e-12)
    assert found["Yvvr"].std == pytest.approx(math.sqrt(2) * 1e-4 / (v0**2 * size), rel=1e-12)
    assert set(single_run_derivatives(series[0])) == {"Yvrr", "Nvrr", "Xvr"}


def test_companions_must_be_the_same_test(reduced, hull) -> None:
    beta = math.radians(6)
    runs = reduced(
        hull,
        [
            pure_yaw(0.1, 0.841, "yaw_drift", drift_angle=beta),
            pure_yaw(0.11, 0.841),
            Run("other angle", "static_drift", speed=SPEED, drift_angle=-beta),
            Run("slower", "static_drift", speed=0.9 * SPEED, drift_angle=beta),
        ],
    )
    assert set(single_run_derivatives(runs[0], companions=runs)) == {"Yvrr", "Nvrr", "Xvr"}


def test_yaw_run_without_drift_angle_is_pure_yaw(reduced, hull) -> None:
    named, pure = reduced(hull, [pure_yaw(0.1, 0.841, "yaw_drift"), pure_yaw(0.1, 0.841)])
    assert single_run_derivatives(named) == single_run_derivatives(pure)


def test_pure_surge(reduced, ship) -> None:
    values = {"X0": -0.02, "Xu": -0.05, "Xuu": -0.03, "Xudot": -0.01}
    run = Run("surge", "pure_surge", speed=SPEED, frequency=0.841, surge_amplitude=0.1)
    (result,) = reduced(dtmb(ship, values), [run], nondimensional_speed="approach")
    found = single_run_derivatives(result)
    assert set(found) == set(values)
    for name, value in values.items():
        assert found[name].value == pytest.approx(value, rel=1e-10)


def test_static_runs_give_a_ratio_and_no_derivative(reduced, hull) -> None:
    beta = math.radians(8)
    drift, straight, steady = reduced(
        hull,
        [
            Run("drift", "static_drift", speed=SPEED, drift_angle=beta),
            Run("straight", "static_drift", speed=SPEED, drift_angle=0.0),
            Run("turn", "steady_yaw", speed=SPEED, yaw_rate=0.1),
        ],
    )
    found = single_run_derivatives(drift)
    v = -math.sin(beta)
    assert set(found) == {"Y/v", "N/v"}
    assert found["Y/v"].value == pytest.approx(hull["Yv"] + hull["Yvvv"] * v**2, rel=1e-12)
    assert single_run_derivatives(straight)["X0"].value == pytest.approx(-hull["R0"], rel=1e-12)
    r = 0.1 * hull.ship.L / SPEED
    assert single_run_derivatives(steady)["N/r"].value == pytest.approx(hull["Nr"] + hull["Nrrr"] * r**2)
    table = single_run_table([drift, straight, steady])
    ratios = table[table["note"] != ""]
    assert set(ratios["name"]) == {"Y/v", "N/v", "Y/r", "N/r"}
    assert set(average_over_runs([drift, straight, steady])["name"]) == {"X0"}


def test_runs_without_relations_are_said_so(reduced, hull) -> None:
    runs = reduced(
        hull,
        [
            Run("both", "sway_yaw", speed=SPEED, frequency=0.9, sway_amplitude=0.2, yaw_amplitude=0.1),
            pure_sway(0.1, heel=0.05),
            pure_sway(0.12),
        ],
    )
    table = single_run_table(runs)
    assert set(table["run"]) == {"sway 0.12"}
    assert table.attrs["left_out"] == [
        "1 sway_yaw run(s): no textbook relation",
        "1 pure_sway run(s) with rudder, heel or bank: no textbook relation",
    ]


def test_fewer_than_three_harmonics_are_refused(reduced, hull) -> None:
    (run,) = reduced(hull, [pure_sway(0.1)], harmonics=2)
    with pytest.raises(FitError, match="need 3 harmonics, this run has 2"):
        single_run_derivatives(run)
    assert single_run_table([run]).attrs["left_out"] == [
        "sway 0.1: single-run relations need 3 harmonics, this run has 2"
    ]


def test_averages_over_runs(reduced, hull) -> None:
    runs = reduced(hull, [pure_sway(v) for v in (0.1, 0.18, 0.26)], noise=0.01, seed=3)
    table = single_run_table(runs).set_index("name")
    mean = average_over_runs(runs).set_index("name")
    rms = average_over_runs(runs, kind="rms").set_index("name")
    for name in ("Yv", "Yvdot", "Nv"):
        values = table.loc[name, "value"].to_numpy()
        assert mean.loc[name, "value"] == pytest.approx(values.mean(), rel=1e-12)
        assert rms.loc[name, "value"] == pytest.approx(-np.sqrt(np.mean(values**2)), rel=1e-12)
        assert abs(rms.loc[name, "value"]) >= abs(mean.loc[name, "value"])
        assert mean.loc[name, "n"] == 3
        noise = np.sqrt((table.loc[name, "std"].to_numpy() ** 2).sum()) / 3
        assert mean.loc[name, "std"] == pytest.approx(max(noise, values.std(ddof=1) / math.sqrt(3)), rel=1e-12)


def test_runs_that_differ_in_sign_are_noted(reduced, hull) -> None:
    runs = reduced(hull, [pure_sway(v) for v in (0.02, 0.03, 0.04, 0.05)], noise=0.2, seed=1)
    averages = average_over_runs(runs, kind="rms").set_index("name")
    assert averages.loc["Yvvv", "note"] == "the runs differ in sign"
    assert averages.loc["Yvdot", "note"] == ""


def test_unknown_average_is_refused(reduced, hull) -> None:
    with pytest.raises(FitError, match="no average 'median'"):
        average_over_runs([], kind="median")
