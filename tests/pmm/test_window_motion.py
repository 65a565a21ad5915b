"""Functions of a motion over a window: from one cycle, the same as from every sample."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.identify.harmonics import HarmonicProjector, whole_cycle_window
from towtank.pmm.cycle_functions import CycleFunctions
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.run_types import Run
from towtank.pmm.window_motion import WindowMotion


def window(omega, step=0.013, start=3.7):
    t = start + step * np.arange(4000)
    return t[whole_cycle_window(t, omega)]


@pytest.mark.parametrize("omega", [0.31, 0.9, 2.0])
@pytest.mark.parametrize("order", [1, 3, 6])
@pytest.mark.parametrize("phase", [0.0, 0.7])
def test_smooth_functions_project_the_same_from_one_cycle(omega, order, phase):
    times = window(omega)
    projector = HarmonicProjector(times, omega, order, phase=phase)

    def functions(t):
        a = omega * t
        return np.column_stack([np.exp(np.cos(a)), np.sin(a + 0.3) ** 3 / (2.5 + np.cos(a)), np.ones_like(t)])

    cycle = CycleFunctions(projector, float(times[0]), 0.013)
    np.testing.assert_allclose(
        cycle.project(functions(cycle.times)), projector.project(functions(times)), atol=1e-12
    )
    for column in functions(cycle.times).T[:1]:
        np.testing.assert_allclose(cycle.at_samples(column), np.exp(np.cos(omega * times)), atol=1e-13)


def test_functions_with_corners_are_refused():
    times = window(0.9)
    cycle = CycleFunctions(HarmonicProjector(times, 0.9, 3), float(times[0]), 0.013)
    corner = np.abs(np.sin(0.9 * cycle.times))
    assert cycle.project(corner[:, None]) is None
    assert cycle.at_samples(corner) is None


@pytest.mark.parametrize("kind", ["pure_sway", "pure_yaw", "yaw_drift", "static_drift", "steady_yaw"])
def test_window_motion_agrees_with_every_sample(kind):
    harmonic = kind in ("pure_sway", "pure_yaw", "yaw_drift")
    drift = math.radians(8.0) if kind in ("yaw_drift", "static_drift") else 0.0
    run = Run(
        "a", kind, 1.5, drift, frequency=0.9 if harmonic else 0.0, sway_amplitude=0.3 if harmonic else 0.0,
        yaw_rate=0.1 if kind == "steady_yaw" else 0.0,
    )  # fmt: skip
    motion = prescribed_motion(run, 0.2)
    times = window(0.9)
    projector = HarmonicProjector(times, 0.9, 3) if harmonic else None
    over = WindowMotion(motion, times, projector)

    def functions(at):
        return {"U2": at["surge"] ** 2 + at["v"] ** 2, "vvr": at["v"] ** 2 * at["r"], "corner": np.abs(at["v"])}

    exact = functions(motion.at(times))
    samples, projections = over.samples(functions), over.projections(functions)
    for name, values in exact.items():
        np.testing.assert_allclose(samples[name], values, atol=1e-12)
        expected = projector.project(values) if projector else values[:1]
        np.testing.assert_allclose(projections[name], expected, atol=1e-12)
    assert over.projections(lambda at: {}) == {}
