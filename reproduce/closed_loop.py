"""The closed loop: a published set through a virtual captive test, the reduction and the fit, and back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from ..core.conventions import HOME
from ..core.derivative_set import DerivativeSet
from ..core.scales import force_unit
from ..pmm.campaign_file import Fit, Reduction
from ..pmm.hull_fit import fit_hull
from ..pmm.laboratory import Laboratory
from ..pmm.planar_motion import prescribed_motion
from ..pmm.reduced_run import ReducedRun
from ..pmm.reduction import ReductionPlan, point_run, reduce_run
from ..pmm.run_types import Run
from ..pmm.virtual_records import synthesize_records

ROUND_TRIP = 1e-9
"""Largest difference that counts as the same number after a round trip in double precision."""

# Without noise two cycles of an oscillation say all.
_LABORATORY = Laboratory(cycles=2)


def mean_forces(derivatives: DerivativeSet, run: Run) -> dict[str, float]:
    """Forces of a steady run about midship in home axes, over ``0.5 rho L T U^2`` (moments with another L)."""
    at = {name: float(value[0]) for name, value in prescribed_motion(run).at(np.zeros(1)).items()}
    newtons = derivatives.forces(at, approach_speed=run.speed)
    return {
        name: float(value) / force_unit(name, "LT", derivatives.ship, run.speed) for name, value in newtons.items()
    }


def virtual_runs(derivatives: DerivativeSet, matrix: Sequence[Run]) -> list[ReducedRun]:
    """Runs of a test matrix with exact kinematics and without noise, reduced.

    Steady runs are points with their mean force; oscillating runs are records that go through the reduction.
    Forces are scaled by the speed that the conventions of the set name.
    """
    by_carriage = derivatives.conventions.velocity_scale == "approach"
    scale: Literal["instantaneous", "approach"] = "approach" if by_carriage else "instantaneous"
    settings = Reduction(nondimensional_speed=scale, skip_cycles=0)
    plan = ReductionPlan(settings, derivatives.ship, HOME)
    runs = []
    for run in matrix:
        if run.harmonic:
            ((_, record),) = synthesize_records(derivatives, [run], _LABORATORY)
            runs.append(reduce_run(record, run, plan))
        else:
            forces = mean_forces(derivatives, run)
            unknown = dict.fromkeys(forces, math.nan)
            runs.append(point_run(run, derivatives.ship, forces, unknown, scale))
    return runs


def refitted(derivatives: DerivativeSet, matrix: Sequence[Run], *, staged: bool = False) -> DerivativeSet:
    """The set that a fit with its own terms finds from its virtual runs, in the conventions of a fit.

    Parameters
    ----------
    derivatives : DerivativeSet
        With the added-mass Coriolis terms inside, as a balance feels them.
    matrix : sequence of Run
    staged : bool
        Drift, then yaw, then coupling, each stage with the earlier ones held.
    """
    runs = virtual_runs(derivatives, matrix)
    settings = Fit(terms=list(derivatives.names), staged=staged)
    return fit_hull(runs, settings, derivatives.ship, name=f"refit of {derivatives.name}").derivatives


def largest_difference(a: DerivativeSet, b: DerivativeSet) -> float:
    """Largest difference between two sets, over the names of the first."""
    return max(abs(a[name] - b[name]) for name in a.names)
