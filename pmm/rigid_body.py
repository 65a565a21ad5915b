"""Inertia of what hangs on the balance, and how to find it from oscillations in air."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError


@dataclass(frozen=True)
class RigidBody:
    """Mass, centre of gravity and yaw inertia of model and mount.

    Attributes
    ----------
    mass : float
        kg.
    xG : float
        Centre of gravity forward of midship in m.
    Izz : float
        Yaw moment of inertia about the centre of gravity in kg m2.
    """

    mass: float
    xG: float
    Izz: float

    def forces(self, motion: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Inertia force and moment about midship in N and N m: what the balance loses to the body.

        The hydrodynamic force is the reading plus this:
        ``X: m (udot - v r - xG r^2)``, ``Y: m (vdot + u r + xG rdot)``,
        ``N: (Izz + m xG^2) rdot + m xG (vdot + u r)``.
        """
        u, v, r = motion["surge"], motion["v"], motion["r"]
        sway = motion["vdot"] + u * r
        return {
            "X": self.mass * (motion["udot"] - v * r - self.xG * r * r),
            "Y": self.mass * (sway + self.xG * motion["rdot"]),
            "N": (self.Izz + self.mass * self.xG**2) * motion["rdot"] + self.mass * self.xG * sway,
        }

    def describe(self) -> str:
        """One line for the report."""
        return f"m = {self.mass:.6g} kg, xG = {self.xG:.6g} m, Izz = {self.Izz:.6g} kg m2"


def identify_rigid_body(runs: Sequence[tuple[Mapping[str, np.ndarray], Mapping[str, np.ndarray]]]) -> RigidBody:
    """Rigid body from oscillation runs in air.

    Parameters
    ----------
    runs : sequence of (motion, reading)
        Motion of midship and balance reading ``Y``, ``N`` (and ``X``), arrays of one length a run. In air the
        reading is minus the inertia force.

    Raises
    ------
    FitError
        When sway and yaw were not both oscillated.
    """
    rows: list[np.ndarray] = []
    values: list[np.ndarray] = []
    for motion, reading in runs:
        u, v, r = motion["surge"], motion["v"], motion["r"]
        sway, rdot = motion["vdot"] + u * r, motion["rdot"]
        zero = np.zeros_like(sway)
        # unknowns: m, m xG, Izz + m xG^2
        columns = {
            "X": (motion["udot"] - v * r, -r * r, zero),
            "Y": (sway, rdot, zero),
            "N": (zero, sway, rdot),
        }
        for name, parts in columns.items():
            if name in reading:
                rows.append(np.column_stack(parts))
                values.append(-np.asarray(reading[name], dtype=float))
    if not rows:
        raise FitError("no dry run to find the inertia from", cure="add dry_sway and dry_yaw runs")
    design, target = np.vstack(rows), np.concatenate(values)
    scale = np.sqrt((design**2).mean(axis=0))
    if (scale <= 1e-12 * scale.max()).any():
        raise FitError(
            "the dry runs do not separate mass and yaw inertia", cure="oscillate in air in sway and in yaw"
        )
    solution = np.linalg.lstsq(design / scale, target, rcond=None)[0] / scale
    mass, moment, inertia = (float(value) for value in solution)
    if mass <= 0:
        raise FitError(
            f"the dry runs give a mass of {mass:.4g} kg", cure="check the sign of Y and the phase of the motion"
        )
    return RigidBody(mass, moment / mass, inertia - moment**2 / mass)
