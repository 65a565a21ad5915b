"""The command line in process, and a small campaign of run files to be spoilt."""

from __future__ import annotations

import functools
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
import typer.main

from towtank.cli.main import main
from towtank.core.conventions import Conventions
from towtank.core.derivative_set import DerivativeSet
from towtank.core.ship import Ship
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.standard_matrices import pure_sway, pure_yaw, static_drift
from towtank.pmm.virtual_campaign import synthesize

SHIP = Ship("a model", L=3.048, B=0.41, T=0.136, mass=86.0, Izz=49.99, rho=1000.0, scale=46.6)
TRUTH = {"R0": 0.018, "Xvv": -0.12, "Xrr": -0.02, "Yv": -0.3, "Yvvv": -1.7, "Yr": -0.05, "Yrrr": -0.08}
TRUTH |= {"Nv": -0.16, "Nvvv": -0.4, "Nr": -0.05, "Nrrr": -0.05, "Yvdot": -0.12, "Nvdot": -0.014}
TRUTH |= {"Yrdot": -0.01, "Nrdot": -0.007}


class Ended(NamedTuple):
    """How a command ended."""

    status: int
    out: str
    err: str


@pytest.fixture(scope="session", autouse=True)
def _commands_built_once() -> Iterator[None]:
    """Build the tree of commands from their signatures once, not for each run of a command."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(typer.main, "get_command", functools.cache(typer.main.get_command))
        yield


@pytest.fixture
def towtank(capsys) -> Callable[..., Ended]:
    """Run a command with words of any type."""

    def run(*words: object) -> Ended:
        with pytest.raises(SystemExit) as ended:
            main([str(word) for word in words])
        out, err = capsys.readouterr()
        return Ended(ended.value.code or 0, out, err)

    return run


@pytest.fixture(scope="session")
def made(tmp_path_factory) -> Path:
    """Folder of a campaign of ten runs with noise and a zero run."""
    conventions = Conventions(added_mass_coriolis="inside")
    truth = DerivativeSet.from_values("truth", SHIP, TRUTH, conventions)
    runs = [
        *static_drift((-12, -8, -4, 0, 4, 8, 12), 1.5),
        *pure_sway((0.3,), 0.9, 1.5),
        *pure_yaw((0.15, 0.3), 0.9, 1.5),
    ]
    laboratory = Laboratory(
        conventions=Conventions(angle_unit="deg"),
        sampling_rate=20.0,
        duration=20.0,
        cycles=3,
        rest=1.0,
        ramp=2.0,
        startup_cycles=1,
        balance_zero={"Y": 3.0},
    )
    folder = tmp_path_factory.mktemp("made") / "campaign"
    noise = Noise(ar1=0.01, seed=1)
    return synthesize(truth, runs, folder, name="ten runs", laboratory=laboratory, noise=noise, digits=6).parent


@pytest.fixture
def campaign(made, tmp_path) -> Path:
    """Campaign file of a copy that a test may spoil."""
    return Path(shutil.copytree(made, tmp_path / "campaign")) / "campaign.toml"
