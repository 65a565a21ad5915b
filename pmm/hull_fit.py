"""One derivative set from all runs of a group: components fitted, covariances joined, shared bias added."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..core.conventions import Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import FitError, TowtankError
from ..core.hull_models import hull_model
from ..core.provenance import Provenance
from ..core.ship import Ship
from ..core.terms import Term
from .campaign_file import Fit
from .component_fit import ComponentFit, default_stages, fit_component
from .force_rows import force_rows
from .reduced_run import FORCES, ReducedRun
from .run_types import Run
from .shared_bias import bias_covariance

OUTLYING = 4.0
"""A run is outlying when one of its rows misses the fit by more standard deviations than this."""


@dataclass(frozen=True, eq=False)
class HullFit:
    """Fit of one group of runs.

    Attributes
    ----------
    label : str
        Name of the group, e.g. ``h/T 1.2``; empty when there is one.
    runs : tuple of ReducedRun
    components : mapping of str to ComponentFit
    derivatives : DerivativeSet
    """

    label: str
    runs: tuple[ReducedRun, ...]
    components: Mapping[str, ComponentFit]
    derivatives: DerivativeSet

    def reconstructed(self, run: ReducedRun, times: np.ndarray) -> dict[str, np.ndarray]:
        """Fitted forces in N of one run at `times`, home axes about midship."""
        motion = run.motion.at(times)
        return replace(self.derivatives, ship=run.ship).forces(motion, approach_speed=run.motion.speed)


def default_terms(runs: Sequence[Run]) -> tuple[Term, ...]:
    """Terms that the run types of a campaign call for: the MMG model, with heel and bank terms where varied."""
    runs = [run for run in runs if not run.dry]
    kinds = {run.kind for run in runs}
    if any(run.bank_position for run in runs):
        return hull_model("bank")
    if any(run.heel for run in runs):
        return hull_model("heel")
    turns = bool(kinds & {"steady_yaw", "steady_yaw_drift", "pure_yaw", "yaw_drift", "sway_yaw"})
    both = bool(kinds & {"steady_yaw_drift", "yaw_drift", "sway_yaw"})
    drifts = both or bool(kinds & {"static_drift", "drift_rudder", "pure_sway"})
    excited = {
        "v": drifts,
        "r": turns,
        "vdot": bool(kinds & {"pure_sway", "sway_yaw"}),
        "rdot": bool(kinds & {"pure_yaw", "yaw_drift", "sway_yaw"}),
    }
    keep = []
    for term in hull_model("mmg"):
        coupled = {"v", "r"} <= set(term.variables)
        if all(excited[variable] for variable in term.variables) and (both or not coupled):
            keep.append(term.name)
    if "pure_surge" in kinds:
        keep.append("Xudot")
    if any(run.rudder_angle for run in runs):
        keep += ["Xdd", "Yd", "Nd"]
    return tuple(Term.parse(name) for name in keep)


def fit_hull(
    runs: Sequence[ReducedRun],
    settings: Fit,
    ship: Ship,
    *,
    name: str,
    label: str = "",
    terms: Sequence[Term] | None = None,
    provenance: Provenance | None = None,
    inertia_inside: bool = False,
    prior: DerivativeSet | None = None,
) -> HullFit:
    """Fit a hull model to reduced runs.

    Parameters
    ----------
    runs : sequence of ReducedRun
        Runs of one group; dry runs are left out.
    settings : Fit
    ship : Ship
        The ship of the group (depth included).
    name : str
        Name of the set.
    label : str
        Name of the group.
    terms : sequence of Term, optional
        Overrides the model of `settings`.
    provenance : Provenance, optional
    inertia_inside : bool
        True when the model's inertia is in the forces and stays there.
    prior : DerivativeSet, optional
        Empirical set for the constrained estimator.

    Raises
    ------
    FitError
        When the data cannot support the model; the message names terms and component.
    """
    runs = tuple(run for run in runs if not run.run.dry)
    if not runs:
        raise FitError("there is no run to fit", cure="add [[runs]] or [points]")
    wanted = (
        tuple(terms) if terms is not None else settings.hull_terms() or default_terms([run.run for run in runs])
    )
    measured = [c for c in FORCES if any(c in run.scaled for run in runs)]
    used = tuple(term for term in wanted if term.component in measured)
    if not used:
        raise FitError(
            "no term of the model belongs to a measured force", cure=f"measured are {', '.join(measured)}"
        )
    conventions = fit_conventions(runs, used, inertia_inside)
    wish = None
    if prior is not None:
        wish = dict(zip(prior.names, prior.values, strict=True))
    components: dict[str, ComponentFit] = {}
    for component in measured:
        own = [term for term in used if term.component == component]
        if not own:
            continue
        try:
            rows = force_rows(runs, own, component)
            stages = default_stages(own) if settings.staged else None
            components[component] = fit_component(rows, settings, stages, wish)
        except TowtankError as error:
            where = f"{label}, {component}" if label else f"component {component}"
            raise type(error)(error.cause, cure=error.cure, file=error.file or None, place=where) from None
    order = [term for component in components for term in components[component].rows.terms]
    values = np.concatenate([fit.params for fit in components.values()])
    covariance = _joint_covariance(components)
    bias, bias_parts = bias_covariance(runs, components, settings.shared_bias)
    diagnostics = _diagnostics(runs, components)
    diagnostics["shared_bias"] = bias_parts
    known = all(run.speed_given for run in runs)
    speed = float(np.mean([run.motion.speed for run in runs])) if known else None
    derivatives = DerivativeSet(
        name=name,
        ship=ship,
        terms=tuple(order),
        values=values,
        conventions=conventions,
        covariance=covariance + bias,
        reference_speed=speed,
        validity=_validity(runs, order),
        diagnostics=diagnostics,
        dof=min(fit.dof for fit in components.values()),
        provenance=provenance or Provenance(),
    )
    return HullFit(label, runs, components, derivatives)


def fit_conventions(runs: Sequence[ReducedRun], terms: Sequence[Term], inertia_inside: bool) -> Conventions:
    """Conventions of a fit: home, with what the forces hold inside the derivatives.

    The fit sees the whole hydrodynamic force, so the added-mass Coriolis terms are inside its derivatives
    (Yr - mx', Xvr + my').
    """
    drift = any("beta" in term.variables for term in terms)
    return Conventions(
        velocity_scale=runs[0].velocity_scale,
        sway_variable="beta" if drift else "v",
        rigid_body_inertia="inside" if inertia_inside else "outside",
        added_mass_coriolis="inside",
        scale="full" if runs[0].ship.scale == 1 else "model",
    )


def _joint_covariance(components: Mapping[str, ComponentFit]) -> np.ndarray:
    """Blocks of the components, and between them the correlation of their residuals on the rows they share."""
    sizes = [len(fit.params) for fit in components.values()]
    start = np.concatenate([[0], np.cumsum(sizes)])
    joint = np.zeros((start[-1], start[-1]))
    fits = list(components.values())
    for i, a in enumerate(fits):
        joint[start[i] : start[i + 1], start[i] : start[i + 1]] = a.cov
        for j in range(i):
            b = fits[j]
            block = _cross_covariance(a, b)
            joint[start[i] : start[i + 1], start[j] : start[j + 1]] = block
            joint[start[j] : start[j + 1], start[i] : start[i + 1]] = block.T
    return _positive(joint)


def _cross_covariance(a: ComponentFit, b: ComponentFit) -> np.ndarray:
    key_a = {(int(run), int(k)): row for row, (run, k) in enumerate(zip(a.rows.run, a.rows.harmonic, strict=True))}
    pairs = [
        (key_a[key], row)
        for row, key in enumerate(zip(b.rows.run.tolist(), b.rows.harmonic.tolist(), strict=True))
        if key in key_a
    ]
    if len(pairs) < 4:
        return np.zeros((len(a.params), len(b.params)))
    in_a, in_b = (np.array(index) for index in zip(*pairs, strict=True))
    x, y = _standardised(a)[in_a], _standardised(b)[in_b]
    size = math.sqrt(float(x @ x) * float(y @ y))
    correlation = float(x @ y) / size if size > 0 else 0.0
    both = a.row_sd[in_a] * b.row_sd[in_b]
    return correlation * (a.influence[:, in_a] * both) @ b.influence[:, in_b].T


def _standardised(fit: ComponentFit) -> np.ndarray:
    """Residuals in standard deviations; 0 where the data follow the fit exactly."""
    return np.divide(fit.residual, fit.row_sd, out=np.zeros(len(fit.row_sd)), where=fit.row_sd > 0)


def _positive(matrix: np.ndarray) -> np.ndarray:
    """The matrix, its off-diagonal part shrunk just enough to be a covariance."""
    sd = np.sqrt(np.clip(np.diag(matrix), 0.0, None))
    safe = np.where(sd > 0, sd, 1.0)
    lowest = float(np.linalg.eigvalsh(matrix / np.outer(safe, safe)).min()) if len(sd) else 1.0
    if lowest >= -1e-12:
        return matrix
    shrink = 1.0 / (1.0 - lowest)
    return shrink * matrix + (1.0 - shrink) * np.diag(np.diag(matrix))


def _validity(runs: Sequence[ReducedRun], terms: Sequence[Term]) -> dict[str, tuple[float, float]]:
    used = {variable for term in terms for variable in term.variables} | {"v", "r"}
    low: dict[str, float] = {}
    high: dict[str, float] = {}
    for run in runs:
        ranges = run.reach()
        for variable in (used | {"Fn"}) & set(ranges):
            least, most = ranges[variable]
            low[variable] = min(low.get(variable, math.inf), least)
            high[variable] = max(high.get(variable, -math.inf), most)
    return {variable: (low[variable], high[variable]) for variable in sorted(low)}


def _diagnostics(runs: Sequence[ReducedRun], components: Mapping[str, ComponentFit]) -> dict[str, Any]:
    table: dict[str, Any] = {}
    for component, result in components.items():
        fit = result.fit
        if fit is None:
            continue
        size = np.abs(result.residual) / np.where(result.row_sd > 0, result.row_sd, np.inf)
        outlying = sorted({runs[index].name for index in result.rows.run[size > OUTLYING].tolist()})
        leverage = np.zeros(len(runs))
        np.add.at(leverage, result.rows.run, np.asarray(fit.leverage))
        heaviest = np.argsort(leverage)[::-1][:3]
        table[component] = {
            "n": len(result.rows.response),
            "runs": len(set(result.rows.run.tolist())),
            "dof": result.dof,
            "R2": float(fit.r2),
            "s": math.sqrt(float(fit.scale)),
            "scatter between runs": result.scatter,
            "residual rms": float(np.sqrt(np.mean(result.residual**2))),
            "AICc": float(fit.aicc),
            "condition number": float(fit.condition_number),
            "VIF": {n: float(v) for n, v in zip(result.rows.names, np.asarray(fit.vif), strict=True)},
            "outlying runs": outlying,
            "highest leverage": {runs[i].name: float(leverage[i]) for i in heaviest},
            "inseparable": [list(group) for group in fit.inseparable()],
            "notes": list(result.notes),
        }
    return table
