"""The motion of a run over its window: functions of it at every sample, and their means and harmonics."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from functools import cached_property
from typing import TypeVar

import numpy as np

from ..identify.harmonics import HarmonicProjector
from .cycle_functions import CycleFunctions
from .planar_motion import PlanarMotion

Key = TypeVar("Key", bound=Hashable)
Function = Callable[[Mapping[str, np.ndarray]], Mapping[Key, np.ndarray]]
"""From a motion (see :meth:`PlanarMotion.at`) to quantities of the same length, none of which grows with time."""


class WindowMotion:
    """Motion over the samples of a window.

    A steady run is asked once, a periodic one over one cycle; only what has corners is evaluated at every sample.

    Parameters
    ----------
    motion : PlanarMotion
    times : ndarray, shape (n,)
        Uniform, in s.
    projector : HarmonicProjector, optional
        Of an oscillating run; None for a steady one.
    """

    def __init__(self, motion: PlanarMotion, times: np.ndarray, projector: HarmonicProjector | None) -> None:
        self.motion, self.times, self.projector = motion, times, projector
        self._cycle = None
        if projector is not None and len(times) > 2:
            step = float(times[-1] - times[0]) / (len(times) - 1)
            self._cycle = CycleFunctions(projector, float(times[0]), step)

    @cached_property
    def at(self) -> Mapping[str, np.ndarray]:
        """The motion at every sample."""
        return self.motion.at(self.times)

    @cached_property
    def in_short(self) -> Mapping[str, np.ndarray]:
        """The motion at one sample when it is steady, over one cycle when it is periodic."""
        return self.motion.at(self.times[:1] if self._cycle is None else self._cycle.times)

    def samples(self, function: Function[Key]) -> dict[Key, np.ndarray]:
        """Functions of the motion at every sample, shape (n,)."""
        values = function(self.in_short)
        if self._cycle is None:
            return {key: np.broadcast_to(value, self.times.shape) for key, value in values.items()}
        found = {}
        for key, value in values.items():
            series = self._cycle.at_samples(np.asarray(value))
            if series is None:
                return dict(function(self.at))
            found[key] = series
        return found

    def projections(self, function: Function[Key]) -> dict[Key, np.ndarray]:
        """Mean and harmonics over the window of functions of the motion, shape (2 order + 1,) or (1,)."""
        values = function(self.in_short)
        if self._cycle is None or self.projector is None:
            return {key: np.array(value[:1]) for key, value in values.items()}
        if not values:
            return {}
        short = self._cycle.project(np.column_stack(list(values.values())))
        if short is None:
            values = function(self.at)
            short = self.projector.project(np.column_stack(list(values.values())))
        return {key: short[:, column] for column, key in enumerate(values)}
