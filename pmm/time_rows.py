"""Every sample of a run as rows of a fit in the time domain, condensed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from ..core.terms import Factor, Term
from ..identify.harmonics import HarmonicProjector

HARMONICS = 8
"""Harmonics of a run that have rows, and a noise density, of their own."""

_BEYOND = 1e-3
"""What a column holds beyond the harmonics, relative to its size, that has rows too."""

_ROUNDING = 1e-12
"""Non-dimensional columns below this are rounding, e.g. the sway velocity in pure yaw."""


@dataclass(frozen=True, eq=False)
class TimeRows:
    """Samples of a window on a few orthonormal directions that hold all columns of the fit.

    The rows give the normal equations of the samples. The directions are the mean, the harmonics, and what the columns
    hold beyond them, because the noise of neighbouring samples is correlated: each harmonic has a noise of its own,
    and noise is independent between them.

    Attributes
    ----------
    table : ndarray, shape (q, terms + forces)
        Columns of all terms, then the scaled forces, on each direction.
    factors : tuple
        Which term each column belongs to; the constant is always there.
    forces : tuple of str
        Forces in the last columns.
    sd : mapping of str to ndarray, shape (q,)
        Standard deviation of the noise of each force in each row.
    """

    table: np.ndarray
    factors: tuple[tuple[Factor, ...], ...]
    forces: tuple[str, ...]
    sd: Mapping[str, np.ndarray]

    @classmethod
    def condensed(
        cls,
        columns: Mapping[tuple[Factor, ...], np.ndarray],
        scaled: Mapping[str, np.ndarray],
        density: Mapping[str, np.ndarray],
        projector: HarmonicProjector | None = None,
    ) -> TimeRows:
        """Rows from the columns of all terms and the scaled forces.

        Parameters
        ----------
        columns, scaled : mapping to ndarray, shape (n,)
        density : mapping of str to ndarray, shape (order + 1,)
            Variance that the noise of each force gives to a direction of unit length which is constant, or oscillates
            at harmonic 1, 2, ...; what lies beyond counts as the last.
        projector : HarmonicProjector, optional
            Of the window of an oscillating run, with the order of `density`.
        """
        terms = np.column_stack([np.ones(len(next(iter(scaled.values())))), *columns.values()])
        forces = np.column_stack(list(scaled.values()))
        harmonic = np.linalg.qr(terms[:, :1] if projector is None else projector.basis)[0]
        size = np.sqrt(np.mean(terms**2, axis=0))
        alive = size > _ROUNDING
        rest = terms[:, alive] / (size[alive] * np.sqrt(len(terms)))
        rest -= harmonic @ (harmonic.T @ rest)
        vectors, singular, _ = np.linalg.svd(rest, full_matrices=False)
        directions = np.hstack([harmonic, vectors[:, singular > _BEYOND]])
        last = (harmonic.shape[1] - 1) // 2
        number = np.minimum((np.arange(directions.shape[1]) + 1) // 2, last)
        return cls(
            directions.T @ np.hstack([terms, forces]),
            ((), *columns),
            tuple(scaled),
            {name: np.sqrt(values[number]) for name, values in density.items()},
        )

    @property
    def constant(self) -> np.ndarray:
        """Rows of a constant force of one unit, shape (q,)."""
        return self.table[:, 0]

    def rows(self, component: str, terms: Sequence[Term]) -> tuple[np.ndarray, np.ndarray]:
        """Design and response of one component.

        Raises
        ------
        FitError
            For a term whose column was not made when the run was read.
        """
        missing = [term.name for term in terms if term.factors not in self.factors]
        if missing:
            raise FitError(
                f"the time-domain rows have no column for {', '.join(missing)}",
                cure="name the term in [fit] or its candidates, so that it is made when the runs are read",
            )
        pick = [self.factors.index(term.factors) for term in terms]
        sign = np.array([float(term.sign) for term in terms])
        force = len(self.factors) + self.forces.index(component)
        return self.table[:, pick] * sign, self.table[:, force]
