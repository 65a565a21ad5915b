"""Already reduced harmonics (mean, cosines and sines of the forces of oscillating runs), one run a row."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import CampaignError
from ..core.scales import force_unit
from ..core.ship import Ship
from ..identify.harmonics import HarmonicProjector
from .campaign_file import Points, Reduction, RunGroup
from .planar_motion import prescribed_motion
from .reduced_run import FORCES, ReducedRun, Window
from .run_matrix import make_run, matrix_rows

_COLUMN = re.compile(r"(?P<force>[XYNK])(?:(?P<mean>0)|(?P<kind>[cs])(?P<harmonic>[1-9]\d?))(?P<sd>_sd)?$")

_SAMPLES = 512
"""Samples of the cycle on which columns and forces are projected."""


def read_harmonic_points(
    points: Points, ship: Ship, conventions: Conventions, folder: Path, file: Path, reduction: Reduction
) -> list[ReducedRun]:
    """Runs of a table of reduced harmonics.

    The columns are those of a test matrix (``name``, ``type``, ``speed``, ``frequency``, ``sway_amplitude``, ...) and
    the harmonics about ``w t`` of the run: ``Y0`` mean, ``Yc1``, ``Ys1``, ``Yc2``, ..., with uncertainties ``Yc1_sd``
    where known. Forces are scaled as ``scaling`` says, with the approach speed.

    Parameters
    ----------
    points, ship, conventions, folder, file, reduction
        As for :func:`~towtank.pmm.points.read_points`.

    Raises
    ------
    CampaignError
        For a missing or unreadable table, a run without frequency, or no harmonic column.
    """
    group = RunGroup(matrix=points.harmonics)
    runs = []
    for row in matrix_rows(group, folder, file, "[points] harmonics"):
        numbers = {key: row.pop(key) for key in [key for key in row if _COLUMN.match(key)]}
        place = str(row.get("_place", ""))
        run = make_run(row, group, folder, conventions, file, "[points] harmonics")
        if not run.harmonic:
            raise CampaignError(
                f"a {run.kind} run has no harmonics",
                cure="put means into the file of [points]",
                file=file,
                place=place,
            )
        forces, sd = _coefficients(numbers, file, place)
        runs.append(_reduced_run(run, forces, sd, points, ship, conventions, reduction))
    return runs


def _coefficients(
    numbers: dict[str, Any], file: Path, place: str
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Mean, cos 1, sin 1, ... of each force, and their standard uncertainties (NaN where not given)."""
    read: dict[tuple[str, bool], dict[int, float]] = {}
    order = 0
    for key, text in numbers.items():
        match = _COLUMN.match(key)
        assert match is not None
        try:
            value = float(text)
        except (TypeError, ValueError):
            raise CampaignError(f"{key} = '{text}' is not a number", file=file, place=place) from None
        k = int(match["harmonic"] or 0)
        order = max(order, k)
        position = 0 if match["mean"] else 2 * k - (match["kind"] == "c")
        read.setdefault((match["force"], bool(match["sd"])), {})[position] = value
    if order == 0:
        raise CampaignError(
            "the row has no harmonic",
            cure="name columns Y0, Yc1, Ys1, ... for mean, cosine and sine",
            file=file,
            place=place,
        )
    size = 2 * order + 1
    forces: dict[str, np.ndarray] = {}
    sd: dict[str, np.ndarray] = {}
    for name in FORCES:
        if (name, False) in read:
            given = read[name, False]
            forces[name] = np.array([given.get(i, 0.0) for i in range(size)])
            errors = read.get((name, True), {})
            sd[name] = np.array([errors.get(i, math.nan) for i in range(size)])
    return forces, sd


def _reduced_run(
    run: Any,
    forces: dict[str, np.ndarray],
    sd: dict[str, np.ndarray],
    points: Points,
    ship: Ship,
    conventions: Conventions,
    reduction: Reduction,
) -> ReducedRun:
    if run.depth is not None:
        ship = replace(ship, depth=run.depth)
    step = run.period / _SAMPLES
    window = Window(0.0, step, _SAMPLES, "already reduced harmonics")
    motion = prescribed_motion(run, reduction.position_x)
    order = (len(next(iter(forces.values()))) - 1) // 2
    projector = HarmonicProjector(window.times, motion.omega, order)
    newtons: dict[str, np.ndarray] = {}
    for name, values in forces.items():
        sign = -1.0 if conventions.force_sign == "by-ship" else 1.0
        if conventions.axes == "forward-port-up" and name in ("Y", "N"):
            sign = -sign
        unit = force_unit(name, points.scaling, ship, run.speed)
        newtons[name] = sign * unit * values
        spread = np.where(np.isfinite(sd[name]), sd[name], points.sd.get(name, math.nan))
        if points.relative_sd is not None:
            spread = np.where(np.isfinite(spread), spread, points.relative_sd * np.abs(values).max())
        sd[name] = unit * spread
    if reduction.moment_x and "N" in newtons and "Y" in newtons:
        newtons["N"] = newtons["N"] + reduction.moment_x * newtons["Y"]
        sd["N"] = np.hypot(sd["N"], reduction.moment_x * sd["Y"])
    at = motion.at(window.times)
    speed = np.hypot(at["surge"], at["v"])
    if reduction.nondimensional_speed == "approach":
        speed = np.full(_SAMPLES, motion.speed)
    scaled: dict[str, np.ndarray] = {}
    scaled_sd: dict[str, np.ndarray] = {}
    for name, values in newtons.items():
        unit = force_unit(name, "LT", ship, 1.0)
        scaled[name] = projector.project(projector.reconstruct(values) / (unit * speed**2))
        scaled_sd[name] = sd[name] / (unit * float(np.mean(speed**2)))
    return ReducedRun(
        run=run,
        ship=ship,
        motion=motion,
        window=window,
        order=order,
        forces=newtons,
        scaled=scaled,
        scaled_sd=scaled_sd,
        noise_dof={name: np.full(len(values), math.inf) for name, values in scaled.items()},
        velocity_scale=reduction.nondimensional_speed,
        steps=("already reduced harmonics",),
    )
