"""The campaigns that come with the package: published points, and virtual PMM campaigns that it generates."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from ..core.conventions import Conventions
from ..core.errors import CampaignError
from ..datasets import load_set, load_table
from ..formats.write import atomic_path
from .laboratory import Laboratory
from .noise import Noise
from .rigid_body import RigidBody
from .standard_matrices import standard_matrix
from .virtual_campaign import synthesize

POINTS = "dtc-static-drift"
PMM = "dtmb5512-virtual-pmm"
MANOEUVRES = "kvlcc2-virtual-manoeuvres"

_TABLE = "dtc-drift-points-63"

_POINTS_TEXT = """\
# Static drift forces of the Duisburg Test Case as published (model test).
# Try another model: [fit] model = "modulus", or terms = ["R0", "Xvv", "Yv", "Yv|v|", "Nv", "Nv|v|"].

[campaign]
name = "DTC static drift, measured points"
source = "{source}"

[ship]
{ship}

[points]
table = "{table}"
scaling = "LT"

[points.columns]
v = "v"
X = "X_EFD"
Y = "Y_EFD"
N = "N_EFD"

[fit]
model = "mmg-drift"
candidates = ["R0 Xvv Yv Yvvv Nv", "R0 Xvv Yv Yv|v| Nv Nv|v|"]
"""


_SAIL_TEXT = """
# The fitted set is sailed with the propeller, the rudder and the steering gear of the named ship.
# Draws: of the fitted covariance, and of the coefficients of propeller and rudder with this scatter.
[simulate]
ship_from = "kvlcc2"
manoeuvres = ["turning 35", "zigzag 10/10", "zigzag 20/20"]
draws = 200
percent = 5
seed = 2

[output]
series_in_report = 2
"""


def write_points_campaign(folder: Path) -> Path:
    """Campaign of the published DTC static-drift points; returns the campaign file."""
    published = load_table(_TABLE)
    if published.ship is None:
        raise CampaignError(f"the shipped table '{_TABLE}' has no ship", cure="reinstall the package")
    ship = "\n".join(f"{key} = {json.dumps(value)}" for key, value in published.ship.to_dict().items())
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "campaign.toml"
    with atomic_path(path) as temporary:
        text = _POINTS_TEXT.format(table=_TABLE, ship=ship, source=published.source.replace('"', "'"))
        temporary.write_text(text, encoding="utf-8")
    return path


def write_pmm_campaign(
    folder: Path, *, seed: int = 5512, progress: Callable[[str, int, int], None] | None = None
) -> Path:
    """Virtual PMM campaign of DTMB 5512 at Fn 0.28 after the published programme; returns the campaign file.

    The derivatives behind it are the published EFD values without the terms that one speed and no rudder cannot
    show (surge and rudder terms). Forces carry 2 % AR(1) noise, the inertia of the model and a zero of the
    balance, so that every step of the reduction has work to do.
    """
    published = load_set("dtmb5512-efd")
    names = [term.name for term in published.terms if not {"u", "delta", "surge", "udot"} & set(term.variables)]
    truth = replace(published.subset(names), name="DTMB 5512, published EFD values")
    ship = truth.ship
    mass, inertia = ship.displacement_mass, ship.yaw_inertia
    if mass is None or inertia is None:
        raise CampaignError("the shipped DTMB 5512 has no mass", cure="reinstall the package")
    laboratory = Laboratory(
        conventions=Conventions(angle_unit="deg"),
        inertia=RigidBody(mass, ship.xG, inertia),
        balance_zero={"X": 0.4, "Y": -0.7, "N": 0.3},
        sampling_rate=50.0,
        duration=30.0,
        rest=2.0,
        ramp=4.0,
        startup_cycles=1,
    )
    return synthesize(
        truth,
        standard_matrix("dtmb5512", ship),
        folder,
        name="DTMB 5512 PMM, Fn 0.28 (virtual)",
        noise=Noise(ar1=0.02, rho=0.9, seed=seed),
        laboratory=laboratory,
        fit_terms=names,
        digits=6,
        overwrite=True,
        progress=progress,
    )


def write_manoeuvres_campaign(
    folder: Path, *, seed: int = 2, progress: Callable[[str, int, int], None] | None = None
) -> Path:
    """Virtual campaign of the KVLCC2 model whose fitted set is sailed; returns the campaign file.

    The derivatives behind it are the published MMG set (Yasukawa and Yoshimura 2015). Forces carry 4 % AR(1) noise.
    A fit of all runs, draws from its covariance, a turning circle and two zig-zags to starboard follow.
    """
    truth = load_set("kvlcc2")
    file = synthesize(
        truth,
        standard_matrix("general", truth.ship, 1.18),
        folder,
        name="KVLCC2 model L7, sailed (virtual)",
        noise=Noise(ar1=0.04, rho=0.9, seed=seed),
        laboratory=Laboratory(conventions=Conventions(angle_unit="deg"), sampling_rate=10.0),
        digits=6,
        overwrite=True,
        progress=progress,
    )
    with atomic_path(file) as temporary:
        temporary.write_text(file.read_text(encoding="utf-8") + _SAIL_TEXT, encoding="utf-8")
    return file
