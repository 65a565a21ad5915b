"""Damping at another scale by Froude's law."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .damping_models import split_speed_term, term_powers

if TYPE_CHECKING:
    from .roll_damping import RollDamping


def damping_at_scale(fit: RollDamping, scale: float) -> RollDamping:
    """Coefficients, covariance, records and noise of a fit at another scale; viscous scale effects stay in them.

    Parameters
    ----------
    fit : RollDamping
    scale : float
        New scale; 1 for full scale.

    Raises
    ------
    FitError
        If the scale is not positive.
    """
    if not scale > 0.0:
        raise FitError(f"the scale {scale} is not positive", cure="give 1 for full scale, 68 for a model 1:68")
    length = fit.scale / scale
    time = np.sqrt(length)
    x = length if fit.motion == "heave" else 1.0
    factor = np.empty(len(fit.names))
    for i, name in enumerate(fit.names):
        angle_power, time_power = term_powers(name)
        factor[i] = x**angle_power * time**time_power / time ** split_speed_term(name)[1]
    runs = tuple(
        replace(
            run,
            time=run.time * time,
            measured=run.measured * x,
            fitted=run.fitted * x,
            start=(run.start[0] * x, run.start[1] * x / time),
            offset=run.offset * x,
            speed=run.speed * time,
        )
        for run in fit.runs
    )
    old = fit.diagnostics
    fixed = {name: value * factor[fit.names.index(name)] for name, value in fit.model.fixed.items()}
    return replace(
        fit,
        params=fit.params * factor,
        cov=fit.cov * np.outer(factor, factor),
        model=replace(fit.model, fixed=fixed),
        scale=scale,
        ship=None if fit.ship is None else fit.ship.at_scale(scale),
        runs=runs,
        diagnostics=replace(
            old,
            noise=old.noise * x,
            noise_time=old.noise_time * time,
            amplitudes=(old.amplitudes[0] * x, old.amplitudes[1] * x),
        ),
        provenance=fit.provenance.and_then(f"Froude's law from scale {fit.scale:g} to {scale:g}"),
    )
