"""A published derivative set put through a virtual captive test and the package's own reduction and fit."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.conventions import HOME
from ..core.derivative_set import DerivativeSet
from ..pmm.campaign_file import Fit, Reduction
from ..pmm.hull_fit import fit_hull
from ..pmm.laboratory import Laboratory
from ..pmm.reduced_run import ReducedRun
from ..pmm.reduction import ReductionPlan, reduce_run
from ..pmm.run_types import Run
from ..pmm.virtual_records import synthesize_records

# Without noise a record need not be long: four seconds of a steady run, two cycles of an oscillation.
_LABORATORY = Laboratory(duration=10.0, cycles=2)


def virtual_runs(derivatives: DerivativeSet, matrix: Sequence[Run]) -> list[ReducedRun]:
    """Runs of a test matrix with exact kinematics and without noise, made from a set and reduced.

    Forces are scaled by the speed that the conventions of the set name.
    """
    records = synthesize_records(derivatives, matrix, _LABORATORY)
    scale = "approach" if derivatives.conventions.velocity_scale == "approach" else "instantaneous"
    settings = Reduction(nondimensional_speed=scale, skip_cycles=0)
    plan = ReductionPlan(settings, derivatives.ship, HOME)
    return [reduce_run(record, run, plan) for run, record in records]


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


def largest_difference(a: DerivativeSet, b: DerivativeSet) -> tuple[str, float]:
    """Name and size of the largest difference between two sets, over the names of the first."""
    differences = {name: abs(a[name] - b[name]) for name in a.names}
    worst = max(differences, key=lambda name: differences[name])
    return worst, differences[worst]
