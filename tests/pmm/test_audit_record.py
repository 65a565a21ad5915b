"""Clean records give no finding, and each fault of a record gives its own."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from towtank.core import Conventions, DerivativeSet, Record, Ship
from towtank.core.errors import ReadError
from towtank.pmm.audit_record import audit_record
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.run_types import Run

DTMB = Ship("DTMB 5512", 3.048, 0.41, 0.136, volume=0.086, mass=86.0, Izz=49.99, rho=1000.0, scale=46.6)
TANKER = Ship("tanker", 7.0, 1.27, 0.455, volume=3.27, xG=0.25, kzz=1.75, rho=1000.0, scale=45.714)

_FRIGATE = (
    "R0 0.0165 Xvv -0.14 Xvr 0.03 Xrr -0.028 Yv -0.296 Yvvv -1.95 Yr -0.048 Yrrr -0.45 Yvvr -1.7 Yvrr -1.37 "
)
_FRIGATE += (
    "Nv -0.167 Nvvv -0.436 Nr -0.048 Nrrr -0.05 Nvvr -0.55 Nvrr -0.4 Xudot -0.003 Yvdot -0.111 Yrdot -0.009 "
)
_FRIGATE += "Nvdot -0.013 Nrdot -0.007"
_TANKER = (
    "R0 0.022 Xvv -0.04 Xvr 0.225 Xrr 0.011 Xvvvv 0.771 Yv -0.315 Yr 0.061 Yvvv -1.607 Yvvr 0.379 Yvrr -0.391 "
)
_TANKER += (
    "Yrrr 0.008 Nv -0.137 Nr -0.049 Nvvv -0.03 Nvvr -0.294 Nvrr 0.055 Nrrr -0.013 Xudot -0.022 Yvdot -0.223 "
)
_TANKER += "Nrdot -0.011 Yd -0.05 Nd 0.025"


def hull(ship: Ship, text: str) -> DerivativeSet:
    words = text.split()
    values = {name: float(value) for name, value in zip(words[::2], words[1::2])}
    return DerivativeSet.from_values(ship.name, ship, values, Conventions(added_mass_coriolis="inside"))


HULLS = {"DTMB 5512": hull(DTMB, _FRIGATE), "tanker": hull(TANKER, _TANKER)}
SPEEDS = {"DTMB 5512": 1.5311, "tanker": 1.1766}


def runs_of(ship: Ship) -> dict[str, Run]:
    U = SPEEDS[ship.name]
    w = 2.0 * U / ship.L
    a, d = 0.08 * ship.L, math.radians
    more = {"speed": U, "frequency": w, "sway_amplitude": a}
    return {
        "straight": Run("straight", "static_drift", speed=U),
        "drift 10": Run("drift 10", "static_drift", speed=U, drift_angle=d(10)),
        "drift -2": Run("drift -2", "static_drift", speed=U, drift_angle=d(-2)),
        "rudder 20": Run("rudder 20", "static_rudder", speed=U, rudder_angle=d(20)),
        "circle": Run("circle", "steady_yaw", speed=U, yaw_rate=0.3 * U / ship.L),
        "circle drift": Run("cd", "steady_yaw_drift", speed=U, yaw_rate=-0.2 * U / ship.L, drift_angle=d(8)),
        "sway": Run("sway", "pure_sway", **more),
        "yaw": Run("yaw", "pure_yaw", **more),
        "yaw drift": Run("yaw drift", "yaw_drift", drift_angle=d(-8), **more),
        "sway yaw": Run("sway yaw", "sway_yaw", yaw_amplitude=d(6), sway_phase=0.4, **more),
        "surge": Run("surge", "pure_surge", speed=U, frequency=w, surge_amplitude=0.05 * ship.L),
    }


def record_of(ship: Ship, run: Run, *, noise: float = 0.02, seed: int = 0, cycles: int = 5, **more) -> Record:
    """Record of a run with AR(1) noise on the forces and a little on the motion."""
    rng = np.random.default_rng([seed, len(run.name)])
    length = more.get("length", cycles * run.period if run.harmonic else 30.0)
    t = np.arange(0.0, length, run.period / 240 if run.harmonic else 0.025)
    motion = prescribed_motion(run, more.get("reference", 0.0)).at(t)
    forces = HULLS[ship.name].forces(motion, approach_speed=run.speed)
    unit = 0.5 * ship.rho * ship.L * ship.T * run.speed**2

    def with_noise(values: np.ndarray, size: float, rho: float) -> np.ndarray:
        white = rng.standard_normal(len(t)) * math.sqrt(1 - rho**2)
        return values + noise * size * lfilter([1.0], [1.0, -rho], white)

    channels = {"time": t}
    for name in "XYN":
        channels[name] = with_noise(forces[name], max(np.abs(forces[name]).max(), 0.01 * unit), 0.9)
    for name, source in (
        *((n, n) for n in ("x", "y", "psi", "v", "r", "udot", "vdot", "rdot")),
        ("u", "surge"),
        ("rudder_angle", "delta"),
    ):
        swing = motion["x"] - run.speed * t if name == "x" else motion[source]
        channels[name] = with_noise(motion[source], 0.1 * float(np.ptp(swing)), 0.0)
    return Record(channels, source=f"{run.name}.txt")


def rules(findings) -> dict[str, str]:
    return {item.rule: item.severity for item in findings}


CASES = [(ship, name) for ship in (DTMB, TANKER) for name in runs_of(DTMB)]


@pytest.mark.parametrize(("ship", "name"), CASES, ids=[f"{s.name} {n}" for s, n in CASES])
def test_clean_records_give_no_finding(ship, name):
    run = runs_of(ship)[name]
    for seed in range(4):
        assert audit_record(record_of(ship, run, seed=seed), run, ship) == []
    assert audit_record(record_of(ship, run, noise=0.0), run, ship) == []


def test_two_cycles_and_a_path_of_the_centre_of_gravity_are_clean():
    run = runs_of(TANKER)["yaw"]
    assert audit_record(record_of(TANKER, run, cycles=2, length=2 * run.period), run, TANKER) == []
    moved = record_of(TANKER, run, reference=TANKER.xG)
    assert audit_record(moved, run, TANKER, reference=TANKER.xG) == []
    at_gravity = moved.with_channels("v of the centre of gravity", v=moved["v"] + TANKER.xG * moved["r"])
    assert audit_record(at_gravity, run, TANKER, reference=TANKER.xG) == []


def test_acceleration_and_braking_of_the_carriage_are_clean():
    run = runs_of(DTMB)["drift 10"]
    steady = record_of(DTMB, run)
    t = steady.time
    share = np.clip(np.minimum(t - 2.0, t[-1] - 2.0 - t) / 4.0, 0.0, 1.0)
    changed = {name: steady[name] * share**2 for name in "XYN"} | {name: steady[name] * share for name in "uv"}
    changed["x"] = np.cumsum(steady["u"] * share) * 0.025
    assert audit_record(steady.with_channels("carriage", speed=run.speed * share, **changed), run, DTMB) == []


def scaled(*names, by):
    return lambda record, run: {name: record[name] * by for name in names}


def in_tank(record, run):
    psi = record["psi"]
    u, v = record["u"], record["v"]
    return {"u": u * np.cos(psi) - v * np.sin(psi), "v": u * np.sin(psi) + v * np.cos(psi)}


def swapped(a, b):
    return lambda record, run: {a: record[b], b: record[a]}


def length_wrong(record, run):
    return {"r": record["r"] / 0.8, "rdot": record["rdot"] / 0.8**2}


FAULTS = [
    ("swapped-channels", "sway", swapped("X", "Y")),
    ("swapped-channels", "yaw", swapped("X", "Y")),
    ("swapped-channels", "drift 10", swapped("u", "v")),
    ("earth-fixed-velocities", "drift 10", in_tank),
    ("earth-fixed-velocities", "drift -2", in_tank),
    ("earth-fixed-velocities", "yaw", in_tank),
    ("earth-fixed-velocities", "yaw drift", in_tank),
    ("angle-in-degrees", "drift 10", scaled("psi", by=180 / math.pi)),
    ("angle-in-degrees", "drift 10", scaled("psi", by=math.pi / 180)),
    ("angle-in-degrees", "yaw", scaled("psi", "r", "rdot", by=180 / math.pi)),
    ("angle-in-degrees", "yaw", scaled("r", by=180 / math.pi)),
    ("angle-in-degrees", "circle", scaled("r", by=180 / math.pi)),
    ("angle-in-degrees", "rudder 20", scaled("rudder_angle", by=180 / math.pi)),
    ("length-in-millimetres", "sway", scaled("y", by=1000.0)),
    ("length-in-millimetres", "yaw", scaled("y", by=1000.0)),
    ("length-in-millimetres", "sway", scaled("y", by=100.0)),
    ("length-in-millimetres", "sway", scaled("y", by=0.001)),
    ("length-in-millimetres", "sway", scaled("v", "vdot", by=1000.0)),
    ("length-in-millimetres", "drift 10", scaled("x", by=1000.0)),
    ("speed-mismatch", "drift 10", scaled("u", "v", by=3600 / 1852)),
    ("speed-mismatch", "straight", scaled("u", by=3.6)),
    ("speed-mismatch", "yaw", scaled("u", by=math.sqrt(46.6))),
    ("speed-mismatch", "straight", scaled("x", by=1852 / 3600)),
    ("drift-sign", "drift 10", scaled("v", by=-1.0)),
    ("drift-sign", "drift -2", scaled("v", by=-1.0)),
    ("drift-sign", "drift 10", scaled("psi", by=-1.0)),
    ("drift-sign", "yaw drift", scaled("v", by=-1.0)),
    ("drift-sign", "sway", scaled("v", "vdot", by=-1.0)),
    ("drift-sign", "yaw", scaled("r", "rdot", by=-1.0)),
    ("drift-sign", "circle", scaled("r", by=-1.0)),
    ("rudder-sign", "rudder 20", scaled("rudder_angle", by=-1.0)),
    ("wrong-length", "yaw", length_wrong),
    ("wrong-length", "yaw", scaled("rdot", by=1.3)),
    ("wrong-length", "sway", scaled("vdot", by=1.3)),
    ("frequency-mismatch", "sway", scaled("time", by=0.9)),
    ("frequency-mismatch", "yaw", scaled("time", by=1000.0)),
    ("amplitude-mismatch", "sway", scaled("y", by=1.5)),
    ("phase-mismatch", "yaw", lambda record, run: {"time": record.time + 0.2 * run.period}),
]


@pytest.mark.parametrize(
    ("rule", "name", "spoil"), FAULTS, ids=[f"{n}-{f[0]} {f[1]}" for n, f in enumerate(FAULTS)]
)
@pytest.mark.parametrize("ship", [DTMB, TANKER], ids=["DTMB", "tanker"])
def test_each_fault_of_the_motion_is_found(rule, name, spoil, ship):
    run = runs_of(ship)[name]
    for seed in (1, 2):
        record = record_of(ship, run, seed=seed)
        found = audit_record(record.with_channels("spoilt", **spoil(record, run)), run, ship)
        assert rules(found).get(rule) == "error", found
        finding = next(item for item in found if item.rule == rule)
        assert finding.file == f"{run.name}.txt"
        assert run.name in finding.place
        assert finding.cure


def test_a_frequency_in_hertz_is_told():
    run = runs_of(DTMB)["sway"]
    wrong = replace(run, frequency=run.frequency / (2 * math.pi))
    record = record_of(DTMB, run, cycles=25)
    assert rules(audit_record(record_of(DTMB, run, cycles=5), wrong, DTMB)) == {"frequency-mismatch": "error"}
    assert (
        "Hz as rad/s"
        in next(f for f in audit_record(record, wrong, DTMB) if f.rule == "frequency-mismatch").message
    )
    wrong = replace(run, frequency=run.frequency * 2 * math.pi)
    assert (
        "rad/s as Hz"
        in next(f for f in audit_record(record, wrong, DTMB) if f.rule == "frequency-mismatch").message
    )


def test_a_frequency_is_checked_on_forces_alone():
    run = runs_of(TANKER)["sway"]
    record = record_of(TANKER, run, cycles=8)
    forces = Record({name: record[name] for name in ("time", "X", "Y", "N")})
    assert audit_record(forces, run, TANKER) == []
    assert rules(audit_record(forces, replace(run, frequency=1.25 * run.frequency), TANKER)) == {
        "frequency-mismatch": "error"
    }


def test_the_phase_is_free_where_the_motion_is_measured():
    run = runs_of(DTMB)["yaw"]
    record = record_of(DTMB, run)
    late = record.with_channels("", time=record.time + 0.2 * run.period)
    assert rules(audit_record(late, run, DTMB)) == {"phase-mismatch": "error"}
    assert audit_record(late, run, DTMB, measured_motion=True) == []


@pytest.mark.parametrize(("factor", "severity"), [(1.02, None), (1.08, "warning"), (0.6, "error")])
def test_the_extent_of_an_amplitude_error_decides(factor, severity):
    run = runs_of(DTMB)["sway"]
    record = record_of(DTMB, run)
    found = audit_record(record.with_channels("", y=factor * record["y"]), run, DTMB)
    assert rules(found).get("amplitude-mismatch") == severity


@pytest.mark.parametrize(("slip", "severity"), [(1.0005, None), (1.012, "warning"), (1.04, "error")])
def test_the_extent_of_a_frequency_error_decides(slip, severity):
    run = runs_of(DTMB)["yaw"]
    found = audit_record(record_of(DTMB, run, cycles=8), replace(run, frequency=slip * run.frequency), DTMB)
    assert rules(found).get("frequency-mismatch") == severity


def test_full_scale_speed_of_a_model_is_named():
    run = runs_of(DTMB)["straight"]
    record = record_of(DTMB, run)
    found = audit_record(record.with_channels("", u=math.sqrt(46.6) * record["u"]), run, DTMB)
    assert "full-scale" in next(f for f in found if f.rule == "speed-mismatch").message


@pytest.mark.parametrize(("cycles", "severity"), [(0.6, "error"), (1.5, "warning"), (2.0, None)])
def test_an_oscillation_needs_whole_cycles(cycles, severity):
    run = runs_of(DTMB)["sway"]
    found = audit_record(record_of(DTMB, run, length=cycles * run.period), run, DTMB)
    assert rules(found).get("short-of-whole-cycles") == severity


def test_faults_of_time_and_channels_come_through():
    run = runs_of(DTMB)["sway"]
    record = record_of(DTMB, run)
    broken = record["Y"].copy()
    broken[100] = np.nan
    found = audit_record(record.with_channels("", Y=broken), run, DTMB)
    assert rules(found) == {"missing-values": "error"}
    assert found[0].place == "run 'sway', channel Y"
    back = np.concatenate([record.time[:400], record.time[300:]])[: len(record)]
    assert rules(audit_record(record.with_channels("", time=back), run, DTMB)) == {"time-overlap": "error"}
    dead = audit_record(record.with_channels("", N=np.full(len(record), 0.3)), run, DTMB)
    assert rules(dead) == {"constant-channel": "error"}


def test_degrees_in_the_test_matrix_are_told_before_anything_else():
    run = runs_of(DTMB)["drift 10"]
    found = audit_record(record_of(DTMB, run), replace(run, drift_angle=10.0), DTMB)
    assert rules(found) == {"angle-in-degrees": "error"}
    assert "573 deg" in found[0].message
    assert found[0].file == "drift 10.txt"


def test_a_record_without_time_is_an_error():
    with pytest.raises(ReadError, match="time"):
        audit_record(Record({"Y": np.zeros(20)}), runs_of(DTMB)["sway"], DTMB)
