"""A virtual CFD sweep on three grids with a known truth: OpenFOAM-shaped files on disk, labelled virtual.

The forces are those of a published derivative set whose every derivative carries a discretisation error
``c h^p`` of its own; the histories start with a transient and carry autocorrelated noise. What comes out of the street
can then be compared with what went in.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..datasets import load_set
from ..formats.write import atomic_path
from ..pmm.virtual_records import as_measured
from .case_loads import LoadChoices

Progress = Callable[[str, int, int], None]

PUBLISHED = "kvlcc2"
SPEED = 0.76
# beta in deg and r' of each motion.
MOTIONS: tuple[tuple[float, float], ...] = (
    (0.0, 0.0),
    (-4.0, 0.0),
    (4.0, 0.0),
    (8.0, 0.0),
    (12.0, 0.0),
    (16.0, 0.0),
    (0.0, 0.2),
    (0.0, 0.4),
    (0.0, 0.6),
    (-8.0, 0.3),
    (8.0, 0.3),
    (-8.0, 0.6),
    (8.0, 0.6),
)
# Solver coordinates: x aft from the fore perpendicular, z up from the keel; moments about this point.
COFR = (3.2, 0.0, 0.2)
MIDSHIP = (3.5, 0.0, 0.0)
RESTARTED = (8.0, 0.0)
"""The motion whose finest run was interrupted and restarted, so that two histories overlap."""


@dataclass(frozen=True)
class GridErrorLaw:
    """Discretisation error of a virtual sweep.

    Attributes
    ----------
    order : float
        p of the error ``c h^p``.
    ratio : float
        Refinement ratio between neighbouring grids.
    finest_cells : int
        Cells of the finest grid; the others follow from the ratio.
    size : tuple of float
        Smallest and largest relative error c of a derivative on the finest grid.
    grids : int
    """

    order: float = 2.0
    ratio: float = math.sqrt(2.0)
    finest_cells: int = 8_000_000
    size: tuple[float, float] = (0.015, 0.04)
    grids: int = 3

    @property
    def cells(self) -> dict[str, int]:
        """Cells of each grid; grid 1 is the finest."""
        return {str(k + 1): round(self.finest_cells / self.ratio ** (3 * k)) for k in range(self.grids)}

    def on_grid(self, truth: DerivativeSet, grid: int) -> DerivativeSet:
        """The set as grid `grid` (1 is the finest) would give it: error c_k h^p of alternating sign."""
        count = len(truth)
        size = np.linspace(*self.size, count) * np.where(np.arange(count) % 2, -1.0, 1.0)
        h = self.ratio ** (grid - 1)
        return replace(
            truth, values=truth.values * (1.0 + size * h**self.order), name=f"{truth.name}, grid {grid}"
        )


@dataclass(frozen=True)
class Histories:
    """Shape of the force histories of a virtual sweep.

    Attributes
    ----------
    time_step, duration : float
        s.
    transient : float
        Size of the start-up transient as part of the force, and its time constant as part of the duration.
    time_constant : float
    noise : float
        Standard deviation of the noise as part of the straight-ahead resistance (times L for moments).
    rho : float
        Correlation of the noise from sample to sample.
    seed : int
    """

    time_step: float = 0.2
    duration: float = 60.0
    transient: float = 0.8
    time_constant: float = 0.03
    noise: float = 0.001
    rho: float = 0.6
    seed: int = 1


def virtual_truth() -> DerivativeSet:
    """The published set behind the virtual sweep as a captive test sees it, without acceleration terms."""
    published = as_measured(load_set(PUBLISHED))
    steady = [term.name for term in published.terms if not {"udot", "vdot", "rdot", "delta"} & set(term.variables)]
    return replace(published.subset(steady), name="KVLCC2, published MMG set")


def virtual_choices(truth: DerivativeSet) -> LoadChoices:
    """What the files of a virtual sweep are: force / density, x aft and z up, moments about a point of their own."""
    return LoadChoices(axes="x-aft-z-up", density=truth.ship.rho, midship=MIDSHIP)


def case_name(motion: tuple[float, float], grid: str) -> str:
    """Folder name of a case: ``beta_-4_r_0_U_0.76_grid2``."""
    return f"beta_{motion[0]:g}_r_{motion[1]:g}_U_{SPEED:g}_grid{grid}"


def write_virtual_sweep(
    folder: str | Path,
    *,
    law: GridErrorLaw | None = None,
    histories: Histories | None = None,
    motions: Sequence[tuple[float, float]] = MOTIONS,
    progress: Progress | None = None,
) -> Path:
    """Write the cases of a virtual sweep, its truth and a virtual experiment; returns the folder of the cases.

    Parameters
    ----------
    folder : path
        Made when it is missing.
    law : GridErrorLaw, optional
    histories : Histories, optional
    motions : sequence of (float, float)
        beta in deg and r'.
    progress : callable, optional
        ``progress(what, done, total)``.
    """
    errors, shape = law or GridErrorLaw(), histories or Histories()
    root = Path(folder)
    cases = root / "cases"
    cases.mkdir(parents=True, exist_ok=True)
    truth = virtual_truth()
    total = len(motions) * errors.grids
    rng = np.random.default_rng(shape.seed)
    for number, (grid, motion) in enumerate((g, m) for g in errors.cells for m in motions):
        if progress:
            progress("writing cases", number, total)
        forces = _forces(errors.on_grid(truth, int(grid)), motion)
        resistance = abs(_forces(truth, (0.0, 0.0))["X"])
        _write_case(cases / case_name(motion, grid), forces, resistance, truth, shape, rng, grid == "1", motion)
    if progress:
        progress("writing cases", total, total)
    truth.to_json(cases / "truth.json")
    virtual_experiment(truth, seed=shape.seed).to_json(root / "efd.json")
    described = {
        "virtual": True,
        "truth": f"{truth.name}: truth.json",
        "error law": f"each derivative carries a relative error c h^{errors.order:g} on the grid of spacing h",
        "largest c on the finest grid": errors.size[1],
        "refinement ratio": errors.ratio,
        "cells": errors.cells,
        "noise": f"AR(1), rho {shape.rho:g}, {100 * shape.noise:g} % of the resistance",
        "seed": shape.seed,
    }
    with atomic_path(root / "virtual.json") as temporary:
        temporary.write_text(json.dumps(described, indent=1) + "\n", encoding="utf-8")
    return cases


def virtual_experiment(truth: DerivativeSet, *, relative_sd: float = 0.02, seed: int = 1) -> DerivativeSet:
    """A virtual tank's set: the truth with independent errors of `relative_sd`, which its covariance states."""
    rng = np.random.default_rng(1000 + seed)
    sd = relative_sd * np.abs(truth.values)
    values = truth.values + sd * rng.standard_normal(len(truth))
    return replace(truth, name="virtual tank, 2 % a derivative", values=values, covariance=np.diag(sd**2))


def _forces(derivatives: DerivativeSet, motion: tuple[float, float]) -> dict[str, float]:
    beta, rate = math.radians(motion[0]), motion[1] * SPEED / derivatives.ship.L
    state = {"surge": SPEED * math.cos(beta), "v": -SPEED * math.sin(beta), "r": rate}
    return {name: float(value) for name, value in derivatives.forces(state).items()}


def _write_case(
    case: Path,
    forces: dict[str, float],
    resistance: float,
    truth: DerivativeSet,
    shape: Histories,
    rng: np.random.Generator,
    finest: bool,
    motion: tuple[float, float],
) -> None:
    time = shape.time_step * np.arange(1, round(shape.duration / shape.time_step) + 1)
    start = shape.transient * np.exp(-time / (shape.time_constant * shape.duration))
    home = {}
    for name in ("X", "Y", "N"):
        size = shape.noise * resistance * (truth.ship.L if name == "N" else 1.0)
        reach = max(abs(forces[name]), 5.0 * size)
        home[name] = forces[name] + reach * start + size * _coloured(rng, time.size, shape.rho)
    weight = truth.ship.displacement_mass or 0.0
    home["Z"] = -9.81 * weight * (1.0 + 1e-4 * _coloured(rng, time.size, shape.rho))
    rho = truth.ship.rho
    # Home to solver axes x aft, y to starboard, z up, over the density.
    force = np.column_stack([-home["X"], home["Y"], -home["Z"]]) / rho
    moment = np.column_stack([np.zeros_like(time), np.zeros_like(time), -home["N"] / rho])
    lever = np.subtract(MIDSHIP, COFR)
    moment = moment + np.cross(lever, force)
    viscous = np.array([0.8, 0.05, 0.0])
    table = {"force": (force, viscous * force), "moment": (moment, 0.05 * moment)}
    restart = finest and motion == RESTARTED
    for stem, (whole, part) in table.items():
        if restart:
            first = time <= 0.6 * shape.duration
            second = time > 0.5 * shape.duration
            _write_history(case, stem, "0", time[first], whole[first], part[first])
            _write_history(case, stem, f"{0.5 * shape.duration:g}", time[second], whole[second], part[second])
        else:
            _write_history(case, stem, "0", time, whole, part)


def _write_history(
    case: Path, stem: str, run: str, time: np.ndarray, whole: np.ndarray, viscous: np.ndarray
) -> None:
    folder = case / "postProcessing" / "forces" / run
    folder.mkdir(parents=True, exist_ok=True)
    table = np.column_stack([time, whole, whole - viscous, viscous])
    columns = [f"{part}_{axis}" for part in ("total", "pressure", "viscous") for axis in "xyz"]
    header = [
        f"# {stem.capitalize()}",
        "# virtual: generated from a published derivative set, not computed",
        f"# CofR                : ({COFR[0]:g} {COFR[1]:g} {COFR[2]:g})",
        "#",
        "# Time\t" + "\t".join(columns),
    ]
    with atomic_path(folder / f"{stem}.dat") as temporary, open(temporary, "w", encoding="utf-8") as stream:
        stream.write("\n".join(header) + "\n")
        np.savetxt(stream, table, fmt="%.8g", delimiter="\t")


def _coloured(rng: np.random.Generator, count: int, rho: float) -> np.ndarray:
    from scipy.signal import lfilter

    white = math.sqrt(1.0 - rho**2) * rng.standard_normal(count + 100)
    return np.asarray(lfilter([1.0], [1.0, -rho], white))[100:]
