"""Multiple-run method: curves against the amplitude, MRL and MRH, steady polynomials, what is left out."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import FitError
from towtank.core.hull_models import hull_model
from towtank.core.ship import Ship
from towtank.core.terms import parse_terms
from towtank.identify.harmonics import HarmonicProjector
from towtank.pmm.multiple_run import multiple_run_curves, multiple_run_derivatives
from towtank.pmm.reduced_run import ReducedRun
from towtank.pmm.reduction import point_run
from towtank.pmm.run_types import Run
from towtank.pmm.sinusoid_motion import ACCELERATION, COS1, COS2, MEAN, SIN1, sinusoid_motion

SPEED = 1.2
W = 0.9
INSIDE = HOME.but(added_mass_coriolis="inside")


def sway(v_max: float, **more: float) -> Run:
    return Run(f"sway {v_max}", "pure_sway", speed=SPEED, frequency=W, sway_amplitude=v_max * SPEED / W, **more)


def yaw(r_max: float, length: float, beta: float = 0.0) -> Run:
    """Yaw with the non-dimensional amplitude r'max and a drift angle in degrees."""
    return Run(
        f"yaw {r_max} {beta}",
        "yaw_drift" if beta else "pure_yaw",
        speed=SPEED,
        frequency=W,
        sway_amplitude=r_max * SPEED**2 / (W**2 * length),
        drift_angle=math.radians(beta),
    )


def drift(beta: float, **more: float) -> Run:
    return Run(f"drift {beta}", "static_drift", speed=SPEED, drift_angle=math.radians(beta), **more)


def on_sinusoid(run: ReducedRun, hull: DerivativeSet, sd: float = 1e-4) -> ReducedRun:
    """The run with the forces of `hull` on the textbook's sinusoid instead of the exact motion."""
    if run.run.kind == "static_drift":
        return run
    motion = sinusoid_motion(run)
    angle = run.motion.omega * run.window.times + motion.phase
    cosine = motion.amplitude * np.cos(angle)
    state = {name: np.zeros(len(angle)) for name in ("v", "r", "u", "vdot", "rdot", "udot")}
    state["v"] = np.full(len(angle), motion.drift)
    state[motion.velocity] = cosine
    state[ACCELERATION[motion.velocity]] = -motion.frequency * motion.amplitude * np.sin(angle)
    series = dict.fromkeys(run.scaled, 0.0)
    for term in hull.terms:
        series[term.component] = series[term.component] + hull[term.name] * term.column(state)
    projector = HarmonicProjector(run.window.times, run.motion.omega, run.order)
    scaled = {name: projector.project(values) for name, values in series.items()}
    return replace(run, scaled=scaled, scaled_sd={name: np.full(2 * run.order + 1, sd) for name in scaled})


def with_harmonics(run: ReducedRun, values: dict[tuple[str, int], float], sd: float = math.nan) -> ReducedRun:
    """The run with given means and harmonics about the phase of its velocity."""
    motion = sinusoid_motion(run)
    back = replace(motion, phase=-motion.phase)
    size = 2 * run.order + 1
    scaled = {}
    for component in run.scaled:
        wanted = np.zeros(size)
        for (name, row), value in values.items():
            if name == component:
                wanted[row] = value
        scaled[component] = back.turned(wanted, np.zeros(size))[0]
    return replace(run, scaled=scaled, scaled_sd={name: np.full(size, sd) for name in scaled})


def test_synthetic_planar_motion_returns_its_inputs(reduced, hull) -> None:
    """Forces of equation 8 of the DTC paper on r' = r'max sin(w t) come back through equation 9."""
    length = hull.ship.L
    tests = [drift(b) for b in (-9, -3, 0, 3, 6, 12)] + [sway(v) for v in (0.05, 0.1, 0.15)]
    tests += [yaw(r, length) for r in (0.2, 0.3, 0.35)] + [yaw(0.2, length, b) for b in (2, 4, 8, 12)]
    runs = [on_sinusoid(run, hull) for run in reduced(hull, tests)]
    frame = multiple_run_derivatives(runs, hull.terms)
    assert frame.attrs["left_out"] == []
    assert set(frame["name"]) == set(hull.names)
    assert list(frame.columns) == ["name", "value", "std", "method", "n"]
    for row in frame.itertuples():
        assert row.value == pytest.approx(hull[row.name], rel=1e-7), row.method
    counts = frame.set_index(["name", "method"])["n"]
    assert counts["Yvrr", "yaw with drift, cos 2 (MRH)"] == 4
    # one pure-yaw run has the amplitude of the runs with drift, and it counts
    assert counts["Yvvr", "yaw with drift, cos 1 (MRL)"] == 5
    assert counts["Yvdot", "pure sway, sin 1"] == 3


def test_yaw_runs_go_by_their_drift_angle(reduced, hull) -> None:
    length = hull.ship.L
    tests = [drift(b) for b in (-6, 0, 3, 9)] + [yaw(0.2, length), yaw(0.2, length, 4), yaw(0.2, length, 8)]
    swapped = {"yaw_drift": "pure_yaw", "pure_yaw": "yaw_drift", "static_drift": "static_drift"}
    runs = reduced(hull, tests)
    renamed = reduced(hull, [replace(run, kind=swapped[run.kind]) for run in tests])
    a, b = (multiple_run_derivatives(group, hull.terms) for group in (runs, renamed))
    assert list(a["method"]) == list(b["method"])
    np.testing.assert_allclose(a["value"], b["value"], rtol=1e-12)


def test_static_and_mrh_come_first(reduced, hull) -> None:
    length = hull.ship.L
    tests = [drift(b) for b in (-9, 0, 3, 6, 12)] + [sway(v) for v in (0.05, 0.1, 0.15)]
    tests += [yaw(r, length) for r in (0.2, 0.3)] + [yaw(0.2, length, b) for b in (4, 8)]
    frame = multiple_run_derivatives(reduced(hull, tests), hull.terms).drop_duplicates("name").set_index("name")
    assert frame.loc["Yv", "method"] == "static drift, mean"
    assert frame.loc["Yvdot", "method"] == "pure sway, sin 1"
    assert frame.loc["Yr", "method"] == "pure yaw, cos 1"
    assert frame.loc["Yvrr", "method"] == "yaw with drift, cos 2 (MRH)"
    assert frame.loc["Yvvr", "method"] == "yaw with drift, cos 1 (MRL)"


def test_static_drift_of_dtc_gives_the_printed_derivatives() -> None:
    """MASHCON 2019, DTC: model tests of Table 5 into Table 7, 1 % (X 2 %)."""
    ship = Ship("DTC", L=5.577, B=0.801, T=0.228, rho=998.0)
    table = [
        (0.0, -0.01714, 0.0, 0.0),
        (-0.087, -0.01836, 0.015179, 0.008569),
        (-0.174, -0.01959, 0.030359, 0.017113),
        (-0.259, -0.02079, 0.045538, 0.025707),
        (-0.342, -0.02306, 0.108948, 0.032807),
    ]
    runs = [
        point_run(
            Run(f"{v}", "static_drift", speed=0.8, drift_angle=-math.asin(v)), ship, {"X": x, "Y": y, "N": n}, {}
        )
        for v, x, y, n in table
    ]
    frame = multiple_run_derivatives(runs, hull_model("mmg-drift")).set_index("name")
    printed = {"R0": 0.0176, "Yv": -0.0903, "Yvvv": -1.86, "Nv": -0.1005, "Nvvv": 0.0359}
    for name, value in printed.items():
        assert frame.loc[name, "value"] == pytest.approx(value, rel=0.01)
    for name, value in {"Xvv": -0.0617, "Xvvvv": 0.1304}.items():
        assert frame.loc[name, "value"] == pytest.approx(value, rel=0.02)
    # the points carry no uncertainty: the scatter about the curve gives it
    assert (frame["std"] > 0).all()


def test_pure_yaw_of_dtc_gives_four_thirds_and_twice(reduced, hull) -> None:
    """Curves of figure 4 into Tables 9 and 10: Yrrr = 4/3 of the cubic, Xrr = 2 of the quadratic coefficient."""
    runs = []
    for run in reduced(hull, [yaw(r, hull.ship.L) for r in (0.25, 0.30, 0.35)]):
        r = sinusoid_motion(run).amplitude
        runs.append(
            with_harmonics(
                run,
                {
                    ("X", MEAN): -0.0229 - 0.0035 * r**2,
                    ("Y", COS1): 0.0167 * r - 0.0805 * r**3,
                    ("N", COS1): -0.0256 * r - 0.0408 * r**3,
                },
            )
        )
    terms = parse_terms(["R0", "Xrr", "Yr", "Yrrr", "Nr", "Nrrr"])
    frame = multiple_run_derivatives(runs, terms).drop_duplicates("name").set_index("name")
    assert frame.loc["R0", "value"] == pytest.approx(0.0229, rel=1e-9)
    assert frame.loc["Xrr", "value"] == pytest.approx(-0.0070, rel=1e-9)
    assert frame.loc["Yr", "value"] == pytest.approx(0.0167, rel=1e-9)
    assert frame.loc["Yrrr", "value"] == pytest.approx(-0.1074, rel=1e-3)
    assert frame.loc["Nr", "value"] == pytest.approx(-0.0256, rel=1e-9)
    assert frame.loc["Nrrr", "value"] == pytest.approx(-0.0544, rel=1e-3)


def test_straight_line_of_ratios_on_the_exact_motion(reduced, hull) -> None:
    runs = reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15, 0.2)])
    runs = [on_sinusoid(run, hull) for run in runs]
    amplitude = np.array([sinusoid_motion(run).amplitude for run in runs])
    first = np.array([sinusoid_motion(r).turned(r.scaled["Y"], r.scaled_sd["Y"])[0][COS1] for r in runs])
    first += 1e-4 * np.array([1.0, -1.0, 0.5, 0.0])
    noisy = [
        with_harmonics(run, {("Y", COS1): float(value)}, sd=1e-4) for run, value in zip(runs, first, strict=True)
    ]
    slope, intercept = np.polyfit(amplitude**2, first / amplitude, 1)
    ratio = multiple_run_derivatives(noisy, parse_terms(["Yv", "Yvvv"]), ordinate="ratio").set_index("name")
    ratio = ratio[ratio["method"] == "pure sway, cos 1"]
    assert ratio.loc["Yv", "value"] == pytest.approx(intercept, rel=1e-9)
    assert ratio.loc["Yvvv", "value"] == pytest.approx(4 / 3 * slope, rel=1e-9)
    plain = multiple_run_derivatives(noisy, parse_terms(["Yv", "Yvvv"])).set_index("name")
    plain = plain[plain["method"] == "pure sway, cos 1"]
    assert plain.loc["Yv", "value"] != pytest.approx(intercept, rel=1e-6)


def test_weights_follow_the_uncertainty_of_each_point(reduced, hull) -> None:
    """A bad run with a large uncertainty does not move the curve."""
    runs = [on_sinusoid(run, hull) for run in reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15, 0.2)])]
    bad = replace(
        runs[1],
        scaled={name: 1.5 * values for name, values in runs[1].scaled.items()},
        scaled_sd={name: 1e4 * sd for name, sd in runs[1].scaled_sd.items()},
    )
    frame = multiple_run_derivatives([runs[0], bad, *runs[2:]], hull.terms).set_index(["name", "method"])
    assert frame.loc[("Yv", "pure sway, cos 1"), "value"] == pytest.approx(hull["Yv"], rel=1e-5)


def test_standard_errors_are_those_of_the_noise(reduced, hull) -> None:
    runs = [on_sinusoid(run, hull, sd=2e-4) for run in reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15)])]
    curves, _ = multiple_run_curves(runs, parse_terms(["Yv", "Yvvv"]))
    (curve,) = [c for c in curves if c.method == "pure sway, cos 1"]
    v = np.array([sinusoid_motion(run).amplitude for run in runs])
    design = np.column_stack([v, 0.75 * v**3])
    np.testing.assert_allclose(curve.cov, 4e-8 * np.linalg.inv(design.T @ design), rtol=1e-9)
    assert curve.names == ("Yv", "Yvvv")
    assert curve.n == 3


def test_scatter_beyond_the_noise_enlarges_the_standard_errors(reduced, hull) -> None:
    runs = [on_sinusoid(run, hull) for run in reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15, 0.2, 0.25)])]
    scattered = [
        replace(run, scaled={n: (1 + 0.05 * s) * x for n, x in run.scaled.items()})
        for run, s in zip(runs, (1, -1, 1, -1, 1), strict=True)
    ]
    key = ("Yv", "pure sway, cos 1")
    calm = multiple_run_derivatives(runs, hull.terms).set_index(["name", "method"]).loc[key, "std"]
    wild = multiple_run_derivatives(scattered, hull.terms).set_index(["name", "method"]).loc[key, "std"]
    assert wild > 5 * calm


def test_circular_motion_with_drift(reduced, hull) -> None:
    tests = [drift(b) for b in (-10, -4, 0, 4, 10)]
    tests += [Run(f"turn {r}", "steady_yaw", speed=SPEED, yaw_rate=r) for r in (-0.15, 0.08, 0.15)]
    tests += [
        Run(f"turn {r} {b}", "steady_yaw_drift", speed=SPEED, yaw_rate=r, drift_angle=math.radians(b))
        for r in (0.08, 0.15)
        for b in (-8, 4, 10)
    ]
    frame = multiple_run_derivatives(reduced(hull, tests), hull_model("mmg-steady"))
    for row in frame.itertuples():
        assert row.value == pytest.approx(hull[row.name], rel=1e-7), row.method
    first = frame.drop_duplicates("name").set_index("name")["method"]
    assert first["Yv"] == "static drift, mean"
    assert first["Yr"] == "steady yaw, mean"
    assert first["Yvrr"] == "steady yaw with drift, mean"


def test_rudder_and_heel_have_curves_of_their_own(reduced, ship) -> None:
    values = {"X0": -0.02, "Xdd": -0.03, "Yd": 0.06, "Yv": -0.3, "Yvvv": -1.5, "Yphi": 0.01, "Nd": -0.03}
    hull = DerivativeSet.from_values("rudder", ship, values, INSIDE)
    tests = [drift(b) for b in (-6, 0, 3, 6)]
    tests += [
        Run(f"rudder {d}", "static_rudder", speed=SPEED, rudder_angle=math.radians(d)) for d in (-20, 10, 20)
    ]
    tests += [Run(f"heel {p}", "static_heel", speed=SPEED, heel=math.radians(p)) for p in (-5, 5)]
    tests.append(drift(4, rudder_angle=0.3))
    frame = multiple_run_derivatives(reduced(hull, tests), hull.terms)
    table = frame.drop_duplicates("name").set_index("name")
    for name, value in values.items():
        assert table.loc[name, "value"] == pytest.approx(value, rel=1e-8)
    assert table.loc["Yd", "method"] == "static rudder, mean"
    assert table.loc["Yphi", "method"] == "static heel, mean"
    assert "all steady runs, mean" in set(frame["method"])
    # the drift run with rudder is no point of the drift curve
    counts = frame[frame["method"] == "static drift, mean"].set_index("name")["n"]
    assert counts["X0"] == 4
    assert counts["Yv"] == 3


def test_terms_of_a_bank_come_from_all_steady_runs(reduced, ship) -> None:
    terms = hull_model("bank")
    values = dict(zip((term.name for term in terms), np.linspace(-0.5, 0.5, len(terms)), strict=True))
    hull = DerivativeSet.from_values("bank", ship, values, INSIDE)
    tests = [drift(b, bank_position=eta) for b in (-8, -4, 0, 4, 8, 12) for eta in (-0.6, 0.0, 0.4, 0.8)]
    tests = [replace(run, name=f"{run.name} {run.bank_position}") for run in tests]
    frame = multiple_run_derivatives(reduced(hull, tests), terms).drop_duplicates("name").set_index("name")
    assert set(frame.index) == set(values)
    for name, value in values.items():
        assert frame.loc[name, "value"] == pytest.approx(value, rel=1e-8)
    assert frame.loc["Yvveta", "method"] == "all steady runs, mean"
    assert frame.loc["Yv", "method"] == "static drift, mean"


def test_modulus_model(reduced, ship) -> None:
    values = {"X0": -0.02, "Yv": -0.2, "Yv|v|": -0.6, "Yvdot": -0.12, "Nv": -0.1, "Nv|v|": 0.05, "Nvdot": -0.01}
    hull = DerivativeSet.from_values("modulus", ship, values, INSIDE)
    runs = [on_sinusoid(r, hull) for r in reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15)], samples=2000)]
    table = multiple_run_derivatives(runs, hull.terms).drop_duplicates("name").set_index("name")
    for name, value in values.items():
        assert table.loc[name, "value"] == pytest.approx(value, rel=1e-5)


def test_what_the_runs_cannot_give_is_said(reduced, hull) -> None:
    length = hull.ship.L
    runs = reduced(hull, [sway(0.1), yaw(0.2, length, 6), yaw(0.3, length), yaw(0.2, length)])
    frame = multiple_run_derivatives(runs, hull.terms)
    left = frame.attrs["left_out"]
    assert "pure sway, cos 1 of Y: 1 point(s) cannot give Yv, Yvvv" in left
    assert "pure sway, mean of X: 1 point(s) cannot give R0, Xvv, Xvvvv" in left
    assert any(text.startswith("yaw with drift, mean (MRL) of Y: 1 point(s)") for text in left)
    assert "Yv" not in set(frame["name"])
    # one amplitude is enough for what stands alone in its harmonic
    names = frame.set_index(["name", "method"])["n"]
    assert names["Yvdot", "pure sway, sin 1"] == 1
    assert names["Yvrr", "yaw with drift, cos 2 (MRH)"] == 1
    assert names["Yvvr", "yaw with drift, cos 1 (MRL)"] == 2


def test_equal_amplitudes_cannot_separate_the_powers(reduced, hull) -> None:
    runs = reduced(hull, [sway(0.1), replace(sway(0.1), name="again"), replace(sway(0.1), name="third")])
    left = multiple_run_derivatives(runs, hull.terms).attrs["left_out"]
    assert any("pure sway, cos 1 of Y: the data cannot separate" in text and "Yvvv" in text for text in left)


def test_runs_with_heel_do_not_enter_the_level_curves(reduced, hull) -> None:
    runs = reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15)] + [sway(0.2, heel=0.1)])
    frame = multiple_run_derivatives(runs, hull.terms).set_index(["name", "method"])
    assert frame.loc[("Yvdot", "pure sway, sin 1"), "n"] == 3


def test_motion_that_does_not_oscillate_is_left_out(reduced, hull) -> None:
    runs = reduced(hull, [sway(v) for v in (0.05, 0.1)])
    still = Run("still", "pure_surge", speed=SPEED, frequency=W, sway_amplitude=0.1)
    frame = multiple_run_derivatives([*runs, *reduced(hull, [still])], hull.terms)
    assert frame.attrs["left_out"][0] == "still: the motion of this pure_surge run does not oscillate"
    assert "Yv" in set(frame["name"])


def test_unknown_ordinate_is_refused() -> None:
    with pytest.raises(FitError, match="no ordinate 'log'"):
        multiple_run_derivatives([], ordinate="log")


def test_second_harmonic_of_surge_is_a_mrh_row(reduced, hull) -> None:
    runs = [on_sinusoid(run, hull) for run in reduced(hull, [sway(v) for v in (0.05, 0.1, 0.15)])]
    mine = [sinusoid_motion(r).turned(r.scaled["X"], r.scaled_sd["X"])[0] for r in runs]
    v = np.array([sinusoid_motion(run).amplitude for run in runs])
    # Xc2 = 1/2 Xvv V^2 + 1/2 Xvvvv V^4
    expected = np.linalg.lstsq(np.column_stack([v**2, v**4]) / 2, np.array([f[COS2] for f in mine]), rcond=None)[0]
    frame = multiple_run_derivatives(runs, hull.terms).set_index(["name", "method"])
    assert frame.loc[("Xvv", "pure sway, cos 2 (MRH)"), "value"] == pytest.approx(expected[0], rel=1e-8)
    assert abs(mine[0][SIN1]) < 1e-12
