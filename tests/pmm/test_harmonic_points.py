"""Reduced harmonics as input of a fit."""

import math

import numpy as np
import pytest

from towtank.core import Conventions, DerivativeSet, Ship
from towtank.core.errors import CampaignError
from towtank.core.scales import force_unit
from towtank.identify.harmonics import HarmonicProjector
from towtank.pmm import Campaign, Run, prescribed_motion

SHIP = Ship("hull", L=3.048, B=0.41, T=0.136, volume=0.086, kzz=0.76, rho=1000.0)
TRUTH = {
    "R0": 0.0153, "Xvv": -0.142, "Xrr": -0.028, "Yv": -0.3, "Yvvv": -1.79, "Yvdot": -0.111, "Yr": -0.0485,
    "Yrrr": -0.45, "Yrdot": -0.009, "Nv": -0.163, "Nvvv": -0.33, "Nvdot": -0.013, "Nr": -0.0485, "Nrrr": -0.05,
    "Nrdot": -0.007,
}  # fmt: skip
HOME = """
[campaign]
name = "harmonics"
[ship]
name = "hull"
L = 3.048
B = 0.41
T = 0.136
volume = 0.086
kzz = 0.76
rho = 1000.0
scale = 46.6
[conventions]
angle_unit = "deg"
[reduction]
nondimensional_speed = "approach"
[points]
harmonics = "harmonics.csv"
scaling = "{scaling}"
[fit]
terms = [{terms}]
"""


def write(folder, scaling="LT", spoil=None):
    conventions = Conventions(velocity_scale="approach", added_mass_coriolis="inside")
    hull = DerivativeSet.from_values("truth", SHIP, TRUTH, conventions)
    runs = [Run(f"sway {a}", "pure_sway", 1.531, frequency=0.841, sway_amplitude=a) for a in (0.06, 0.13, 0.32)]
    runs += [Run(f"yaw {a}", "pure_yaw", 1.531, frequency=0.841, sway_amplitude=a) for a in (0.06, 0.2, 0.33)]
    names = [f"{c}{k}" for c in "XYN" for k in ("0", "c1", "s1", "c2", "s2", "c3", "s3")]
    lines = ["name,type,speed,frequency,sway_amplitude," + ",".join(names)]
    for run in runs:
        t = np.arange(512) * run.period / 512
        forces = hull.forces(prescribed_motion(run).at(t), approach_speed=run.speed)
        project = HarmonicProjector(t, run.frequency, 3).project
        values = []
        for c in "XYN":
            values += (project(forces[c]) / force_unit(c, scaling, SHIP, run.speed)).tolist()
        cells = [run.name, run.kind, run.speed, run.frequency, run.sway_amplitude, *values]
        lines.append(",".join(str(cell) for cell in cells))
    text = "\n".join(lines)
    (folder / "harmonics.csv").write_text(spoil(text) if spoil else text)
    terms = ", ".join(f'"{name}"' for name in TRUTH)
    (folder / "campaign.toml").write_text(HOME.format(scaling=scaling, terms=terms))
    return folder / "campaign.toml"


@pytest.mark.parametrize("scaling", ["LT", "L2", "dimensional"])
def test_harmonics_return_the_derivatives(tmp_path, scaling):
    found = Campaign.load(write(tmp_path, scaling)).run(compare=False).derivatives
    for name, value in TRUTH.items():
        assert found[name] == pytest.approx(value, abs=1e-8)


def test_harmonics_are_hashed_into_the_provenance(tmp_path):
    found = Campaign.load(write(tmp_path)).run(compare=False).derivatives
    assert len(found.provenance.inputs["harmonics.csv"]) == 64


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (
            lambda text: text.replace("pure_sway", "static_drift").replace("frequency", "drift_angle"),
            "no harmonics",
        ),
        (lambda text: text.replace("Yc1", "Yq1"), "not a parameter"),
        (lambda text: text.replace("0.841", "", 1), "frequency"),
    ],
)
def test_faults_are_named(tmp_path, spoil, said):
    with pytest.raises(CampaignError, match=said):
        Campaign.load(write(tmp_path, spoil=spoil)).run(compare=False)


def test_uncertainties_weigh_the_rows(tmp_path):
    path = write(tmp_path)
    path.write_text(
        path.read_text().replace('scaling = "LT"', 'scaling = "LT"\nsd = { X = 1e-4, Y = 1e-4, N = 1e-5 }')
    )
    found = Campaign.load(path).run(compare=False).derivatives
    assert math.isfinite(found.bse["Yv"])
    assert found["Yv"] == pytest.approx(-0.3, abs=1e-8)
