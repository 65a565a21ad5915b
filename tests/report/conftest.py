"""Small campaigns for the tests of this room: published drift points, and oscillation runs of a known set."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.ship import Ship
from towtank.formats.write import write_table
from towtank.pmm import Campaign, CampaignResult, prescribed_motion
from towtank.pmm.run_types import Run

SHIP = Ship("DTMB 5512 model", L=3.048, B=0.41, T=0.136, mass=86.0, Izz=49.99, rho=1000.0, scale=46.6)

POINTS = """beta,X,Y,N
0,-0.01714,0,0
5,-0.01836,0.015179,0.008569
10,-0.01959,0.030359,0.017113
15,-0.02079,0.045538,0.025707
20,-0.02306,0.108948,0.032807
"""
"""DTC static drift, model tests: MASHCON 2019, planar motion of the Duisburg Test Case, Table 5."""

DRIFT = """
[campaign]
name = "DTC <static> drift"
source = "Papanikolaou et al. 2016 & others"
[ship]
name = "DTC model"
L = 5.577
B = 0.801
T = 0.228
volume = 0.671
rho = 998.8
scale = 63.65
[conventions]
angle_unit = "deg"
[points]
file = "points.csv"
[fit]
model = "mmg-drift"
"""

PMM = """
[campaign]
name = "DTMB 5512 PMM"
source = "a test"
virtual = true
[ship]
name = "DTMB 5512 model"
L = 3.048
B = 0.41
T = 0.136
mass = 86.0
Izz = 49.99
rho = 1000.0
scale = 46.6
[channels]
time = "time [s]"
X = "X [N]"
Y = "Y [N]"
N = "N [N m]"
y = "y [m]"
psi = "psi [rad]"
[reduction]
skip_cycles = 0
[fit]
model = "mmg"
candidates = ["modulus"]
range_limits = [0.25]
shared_bias = { gain = { X = 0.01, Y = 0.01, N = 0.01 } }
[output]
series_in_report = 2
[[runs]]
matrix = "matrix.csv"
"""


UNITS = {"time": "s", "X": "N", "Y": "N", "N": "N m", "y": "m", "psi": "rad"}


def pmm_runs() -> list[Run]:
    """Oblique towing, sway and yaw oscillation, yaw with drift."""
    speed, frequency = 1.531, 0.84
    runs = [
        Run(f"drift {angle:+d}", "static_drift", speed, drift_angle=math.radians(angle))
        for angle in (-16, -8, 0, 4, 12, 20)
    ]
    runs += [
        Run(f"sway {size}", "pure_sway", speed, frequency=frequency, sway_amplitude=size)
        for size in (0.1, 0.3, 0.5)
    ]
    for drift in (0, -8, 8):
        runs += [
            Run(
                f"yaw {size} drift {drift}",
                "yaw_drift" if drift else "pure_yaw",
                speed,
                drift_angle=math.radians(drift),
                frequency=2.0,
                sway_amplitude=size,
            )
            for size in (0.1, 0.2, 0.3)
        ]
    return runs


def known_hull() -> DerivativeSet:
    """The set behind the oscillation runs: MMG, added-mass terms inside."""
    values = {"R0": 0.018, "Xvv": -0.12, "Xvr": 0.03, "Xrr": -0.02, "Xvvvv": 0.2}
    values |= {"Yv": -0.3, "Yr": -0.05, "Yvvv": -1.7, "Yvvr": -1.2, "Yvrr": -0.9, "Yrrr": -0.08}
    values |= {"Nv": -0.16, "Nr": -0.05, "Nvvv": -0.4, "Nvvr": -0.55, "Nvrr": -0.3, "Nrrr": -0.05}
    values |= {"Yvdot": -0.12, "Yrdot": -0.01, "Nvdot": -0.014, "Nrdot": -0.007}
    return DerivativeSet.from_values("hull", SHIP, values, HOME.but(added_mass_coriolis="inside"))


def write_pmm_campaign(folder: Path) -> Path:
    """Run files with white noise, test matrix and campaign file."""
    hull, random = known_hull(), np.random.default_rng(5)
    lines = ["file,name,type,speed,drift_angle,frequency,sway_amplitude"]
    for number, run in enumerate(pmm_runs()):
        time = np.arange(0.0, 4 * run.period if run.harmonic else 12.0, 0.05)
        motion = prescribed_motion(run).at(time)
        forces = hull.forces(motion, approach_speed=run.speed)
        channels = {"time": time, "y": motion["y"], "psi": motion["psi"]}
        for name, sd in (("X", 0.05), ("Y", 0.3), ("N", 0.3)):
            channels[name] = np.broadcast_to(forces[name], time.shape) + sd * random.standard_normal(len(time))
        write_table(folder / f"{number}.txt", channels, UNITS)
        lines.append(
            f"{number}.txt,{run.name},{run.kind},{run.speed},{run.drift_angle},{run.frequency},{run.sway_amplitude}"
        )
    (folder / "matrix.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / "campaign.toml").write_text(PMM, encoding="utf-8")
    return folder / "campaign.toml"


@pytest.fixture(scope="session")
def hull() -> DerivativeSet:
    """The set behind the oscillation runs."""
    return known_hull()


@pytest.fixture(scope="session")
def drift_result(tmp_path_factory: pytest.TempPathFactory) -> CampaignResult:
    """Published points of one depth."""
    folder = tmp_path_factory.mktemp("drift")
    (folder / "points.csv").write_text(POINTS, encoding="utf-8")
    (folder / "campaign.toml").write_text(DRIFT, encoding="utf-8")
    return Campaign.load(folder / "campaign.toml").run()


@pytest.fixture(scope="session")
def depths_result(tmp_path_factory: pytest.TempPathFactory) -> CampaignResult:
    """The same points at two water depths: two groups."""
    folder = tmp_path_factory.mktemp("depths")
    head, *rows = POINTS.split()
    lines = [f"{head},depth", *(f"{row},0.342" for row in rows), *(f"{row},0.456" for row in rows)]
    (folder / "points.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / "campaign.toml").write_text(DRIFT, encoding="utf-8")
    return Campaign.load(folder / "campaign.toml").run()


@pytest.fixture(scope="session")
def pmm_result(tmp_path_factory: pytest.TempPathFactory) -> CampaignResult:
    """Oscillation runs of a known set, with candidates, range limits and a shared bias."""
    return Campaign.load(write_pmm_campaign(tmp_path_factory.mktemp("pmm"))).run()
