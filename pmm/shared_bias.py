"""Uncertainty that all runs share (type B): it is not averaged away by more runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..core.errors import FitError
from ..core.scales import force_unit
from ..identify.shared_bias import propagate_bias
from .campaign_file import SharedBias
from .component_fit import ComponentFit
from .planar_motion import Oscillation, PlanarMotion
from .reduced_run import ReducedRun

Change = Callable[[str, ComponentFit], np.ndarray]
"""Change of a component's response for a unit of a shared bias."""


def bias_effects(
    runs: Sequence[ReducedRun], components: Mapping[str, ComponentFit], bias: SharedBias
) -> dict[str, tuple[float, np.ndarray]]:
    """Change of all coefficients for a unit of each shared bias.

    Parameters
    ----------
    runs, components
        As fitted.
    bias : SharedBias

    Returns
    -------
    dict
        Source -> (standard uncertainty of the source, d params / d source over all components in order).
    """
    effects: dict[str, tuple[float, np.ndarray]] = {}
    if (bias.speed or bias.drift_angle or bias.moment_x) and any(run.samples is not None for run in runs):
        raise FitError(
            "a shared bias of speed, drift angle or moment place is not propagated in the time domain",
            cure="use domain = 'harmonic'",
        )

    def add(source: str, u: float, change: Change) -> None:
        if u:
            parts = [fit.influence @ change(component, fit) for component, fit in components.items()]
            effects[source] = (u, np.concatenate(parts))

    def gain(own: str) -> Change:
        return lambda c, fit: fit.rows.response * (c == own)

    def offset(own: str) -> Change:
        return lambda c, fit: _offset(runs, fit, c) * (c == own)

    for component, u in bias.gain.items():
        _check(component, components)
        add(f"gain of {component}", u, gain(component))
    for component, u in bias.offset.items():
        _check(component, components)
        add(f"offset of {component}", u, offset(component))
    _add_zero_errors(runs, components, effects)
    add(
        "carriage speed",
        bias.speed,
        lambda c, fit: _motion_change(runs, fit, _faster, 1e-4) - 2.0 * fit.rows.response,
    )
    add("drift angle", bias.drift_angle, lambda c, fit: _motion_change(runs, fit, _turned, 1e-4))
    add("place of the moment", bias.moment_x, lambda c, fit: _lever(runs, fit, components, c))
    return effects


def _add_zero_errors(
    runs: Sequence[ReducedRun],
    components: Mapping[str, ComponentFit],
    effects: dict[str, tuple[float, np.ndarray]],
) -> None:
    """Errors of zero runs: every run from which the same zero was subtracted has the same error."""
    for zero in dict.fromkeys(run.run.tare for run in runs if run.run.tare):
        shared = np.array([run.run.tare == zero for run in runs])
        sd = next((run.zero_sd for run in runs if run.run.tare == zero), {})
        for component in components:
            if sd.get(component):
                parts = [
                    fit.influence @ (_offset(runs, fit, c) * shared[fit.rows.run] * (c == component))
                    for c, fit in components.items()
                ]
                effects[f"zero run '{zero}', {component}"] = (sd[component], np.concatenate(parts))


def bias_covariance(
    runs: Sequence[ReducedRun], components: Mapping[str, ComponentFit], bias: SharedBias
) -> tuple[np.ndarray, dict[str, float]]:
    """Covariance from shared bias, ``sum b b'`` with ``b = influence @ effect * u``, and each source's share.

    Returns
    -------
    covariance : ndarray, shape (p, p)
    shares : dict of str to float
        Root sum of squares over the coefficients, by source.
    """
    size = sum(len(fit.params) for fit in components.values())
    effects = bias_effects(runs, components, bias)
    if not effects:
        return np.zeros((size, size)), {}
    uncertainty = np.array([u for u, _ in effects.values()])
    vectors = np.column_stack([vector for _, vector in effects.values()])
    shares = np.sqrt(((vectors * uncertainty) ** 2).sum(axis=0))
    covariance = propagate_bias(np.eye(size), vectors, uncertainty)
    return covariance, dict(zip(effects, shares.tolist(), strict=True))


def _check(component: str, components: Mapping[str, ComponentFit]) -> None:
    if component not in components:
        raise FitError(
            f"shared bias of '{component}', which is not fitted", cure=f"fitted are {', '.join(components)}"
        )


def _offset(runs: Sequence[ReducedRun], fit: ComponentFit, component: str) -> np.ndarray:
    """Change of the response rows for one newton (newton-metre) of zero error."""
    effect = np.zeros(len(fit.rows.response))
    for index in np.unique(fit.rows.run).tolist():
        run, own = runs[index], fit.rows.run == index
        harmonic = fit.rows.harmonic[own]
        constant = (harmonic == 0).astype(float)
        if run.samples is not None:
            constant = run.samples.constant[-1 - harmonic]
        effect[own] = constant / force_unit(component, "LT", run.ship, run.motion.speed)
    return effect


def _faster(motion: PlanarMotion, step: float) -> PlanarMotion:
    return replace(motion, speed=motion.speed * (1.0 + step))


def _turned(motion: PlanarMotion, step: float) -> PlanarMotion:
    heading = motion.heading
    return replace(motion, heading=Oscillation(heading.constant + step, heading.cosine, heading.sine))


def _motion_change(
    runs: Sequence[ReducedRun],
    fit: ComponentFit,
    change: Callable[[PlanarMotion, float], PlanarMotion],
    step: float,
) -> np.ndarray:
    """Minus the change of the fitted response per unit change of the motion."""
    moved: dict[int, np.ndarray] = {}
    effect = np.zeros(len(fit.rows.response))
    for row, (index, harmonic) in enumerate(zip(fit.rows.run.tolist(), fit.rows.harmonic.tolist(), strict=True)):
        if index not in moved:
            run = runs[index]
            other = replace(run, motion=change(run.motion, step), columns={})
            difference = other.design(fit.rows.terms) - run.design(fit.rows.terms)
            moved[index] = difference @ fit.params / step
        effect[row] = -moved[index][harmonic]
    return effect


def _lever(
    runs: Sequence[ReducedRun], fit: ComponentFit, components: Mapping[str, ComponentFit], component: str
) -> np.ndarray:
    if component != "N" or "Y" not in components:
        return np.zeros(len(fit.rows.response))
    lateral = np.array(
        [
            runs[index].scaled["Y"][harmonic] / runs[index].ship.L if "Y" in runs[index].scaled else 0.0
            for index, harmonic in zip(fit.rows.run.tolist(), fit.rows.harmonic.tolist(), strict=True)
        ]
    )
    return lateral
