"""Reduced runs computed from a known derivative set, for the tests of this room."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.record import Record
from towtank.core.ship import Ship
from towtank.pmm.campaign_file import Reduction
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.reduced_run import ReducedRun
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.run_types import Run

SHIP = Ship("DTMB 5512", L=3.048, B=0.41, T=0.136, mass=86.0, Izz=49.99, rho=1000.0)

MakeRuns = Callable[..., list[ReducedRun]]


@pytest.fixture(scope="session")
def ship() -> Ship:
    """Model of DTMB 5512."""
    return SHIP


@pytest.fixture(scope="session")
def hull() -> DerivativeSet:
    """MMG set of a ship with added-mass terms inside, as a fit to measured forces returns it."""
    values = {"R0": 0.018, "Xvv": -0.12, "Xvr": 0.03, "Xrr": -0.02, "Xvvvv": 0.2}
    values |= {"Yv": -0.3, "Yr": -0.05, "Yvvv": -1.7, "Yvvr": -1.2, "Yvrr": -0.9, "Yrrr": -0.08}
    values |= {"Nv": -0.16, "Nr": -0.05, "Nvvv": -0.4, "Nvvr": -0.55, "Nvrr": -0.3, "Nrrr": -0.05}
    values |= {"Yvdot": -0.12, "Yrdot": -0.01, "Nvdot": -0.014, "Nrdot": -0.007}
    return DerivativeSet.from_values("hull", SHIP, values, HOME.but(added_mass_coriolis="inside"))


@pytest.fixture(scope="session")
def reduced() -> MakeRuns:
    """Synthesise forces of a set on the exact motion of each run, and reduce the records.

    ``reduced(derivatives, runs, noise=0.0, seed=0, cycles=3, samples=240, reference=0.0, **reduction)``: white
    noise in parts of the largest force of each channel; `samples` a cycle, and for a steady run.
    """

    def make(
        derivatives: DerivativeSet,
        runs: Sequence[Run],
        *,
        noise: float = 0.0,
        seed: int = 0,
        cycles: int = 3,
        samples: int = 240,
        reference: float = 0.0,
        **reduction: Any,
    ) -> list[ReducedRun]:
        random = np.random.default_rng(seed)
        settings = Reduction(skip_cycles=0, position_x=reference, **reduction)
        plan = ReductionPlan(settings, derivatives.ship, HOME)
        records = []
        for run in runs:
            step = run.period / samples if run.harmonic else 0.02
            time = step * np.arange(samples * cycles if run.harmonic else samples)
            motion = prescribed_motion(run, reference).at(time)
            forces = derivatives.forces(motion, approach_speed=run.speed)
            records.append((run, {"time": time, "y": motion["y"], "psi": motion["psi"]}, forces))
        largest = {
            name: max(float(np.abs(forces[name]).max()) for _, _, forces in records) for name in records[0][2]
        }
        results = []
        for run, channels, forces in records:
            for name, force in forces.items():
                channels[name] = force + noise * largest[name] * random.standard_normal(len(force))
            results.append(reduce_run(Record(channels), run, plan))
        return results

    return make
