"""What a damping fit keeps of its records, and how well it explains them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..core.findings import Finding


@dataclass(frozen=True, eq=False)
class FittedRun:
    """One record beside the motion that the fitted coefficients give.

    Attributes
    ----------
    name : str
    time, measured, fitted : ndarray, shape (n,)
        Time in s; measured and re-simulated coordinate in rad or m, both with the offset.
    start : tuple of float
        Coordinate without its offset, and velocity, at the first sample.
    offset : float
        Rest position in rad or m.
    speed : float
        Forward speed in m/s.
    """

    name: str
    time: np.ndarray
    measured: np.ndarray
    fitted: np.ndarray
    start: tuple[float, float]
    offset: float = 0.0
    speed: float = 0.0

    @property
    def residual(self) -> np.ndarray:
        """Measured minus fitted, shape (n,)."""
        return self.measured - self.fitted


@dataclass(frozen=True, eq=False)
class FitDiagnostics:
    """How well a damping fit explains its records.

    Attributes
    ----------
    samples : int
    half_cycles : int
        Half cycles in all records.
    r2 : float
        Part of the variance of the measured coordinate that the re-simulated one explains; nan when not simulated.
    noise : float
        Standard deviation of the residual in rad or m.
    noise_time : float
        Integrated autocorrelation time of the residual in s.
    amplitudes : tuple of float
        Smallest and largest amplitude in rad or m.
    converged : bool
    condition : float
        Condition number of the scaled problem.
    findings : tuple of Finding
        What the user should know about the fit.
    details : mapping
        Numbers that only this method has.
    """

    samples: int
    half_cycles: int
    r2: float
    noise: float
    noise_time: float
    amplitudes: tuple[float, float]
    converged: bool = True
    condition: float = float("nan")
    findings: tuple[Finding, ...] = ()
    details: Mapping[str, Any] = field(default_factory=dict)
