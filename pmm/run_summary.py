"""What the audit of a whole campaign needs to know of each run."""

from __future__ import annotations

import math

import numpy as np

from .audit_campaign import RunSummary
from .reduced_run import ReducedRun


def run_summary(run: ReducedRun) -> RunSummary:
    """Mean forces, and first harmonics in phase with velocity and acceleration of the run's main motion."""
    mean = {name: float(values[0]) for name, values in run.forces.items()}
    if not run.order:
        return RunSummary(run=run.run, mean_force=mean)
    times = run.window.start + run.run.period * np.arange(64) / 64
    motion = run.motion.at(times)
    main = {"pure_surge": "surge", "pure_sway": "v", "sway_yaw": "v"}.get(run.run.kind, "r")
    phase = run.motion.omega * times
    velocity = motion[main]
    a, b = 2 * np.mean(velocity * np.cos(phase)), 2 * np.mean(velocity * np.sin(phase))
    amplitude = math.hypot(a, b)
    if amplitude == 0.0:
        return RunSummary(run=run.run, mean_force=mean)
    cos, sin = a / amplitude, b / amplitude
    first = {}
    for name, values in run.forces.items():
        c, s = float(values[1]), float(values[2])
        # velocity ~ cos(wt - e) with e = atan2(b, a); acceleration leads by 90 degrees: -sin(wt - e)
        first[name] = (c * cos + s * sin, c * sin - s * cos)
    return RunSummary(
        run=run.run,
        mean_force=mean,
        first_harmonic=first,
        velocity_amplitude=amplitude,
        acceleration_amplitude=amplitude * run.motion.omega,
    )
