"""Shape of a restoring moment from a curve of levers (GZ), for the equation of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError

# Intervals of the table that the kernel reads, from upright to the last angle.
TABLE_INTERVALS = 256


@dataclass(frozen=True, eq=False)
class RestoringCurve:
    """Odd curve g(x) with slope 1 at the origin, tabulated on a uniform grid as cubic polynomials.

    Attributes
    ----------
    last : float
        Largest angle of the table in rad; the curve is continued along its tangent beyond.
    cubic : ndarray, shape (m, 4)
        Coefficients of 1, s, s^2, s^3 in each interval, s counted from its start in rad.
    metacentric_height : float
        Slope of the lever at the origin in m: the GM that the levers were divided by.
    """

    last: float
    cubic: np.ndarray
    metacentric_height: float

    @classmethod
    def from_levers(
        cls, angle: np.ndarray, lever: np.ndarray, *, metacentric_height: float | None = None
    ) -> RestoringCurve:
        """Curve from a table of righting levers.

        Parameters
        ----------
        angle : ndarray, shape (k,)
            Heel in rad, rising from zero or above.
        lever : ndarray, shape (k,)
            GZ in m.
        metacentric_height : float, optional
            GM in m; the slope at the origin of the interpolated levers when not given.

        Raises
        ------
        FitError
            For fewer than three angles, angles that do not rise, or a lever that does not rise from the origin.
        """
        from scipy.interpolate import CubicSpline

        x, y = np.asarray(angle, dtype=float), np.asarray(lever, dtype=float)
        if x.shape != y.shape or x.ndim != 1 or not (np.isfinite(x).all() and np.isfinite(y).all()):
            raise FitError("angles and levers of the GZ curve do not pair", cure="give one lever for each angle")
        x, y = x[x > 0.0], y[x > 0.0]
        if x.size < 2 or not (np.diff(x) > 0.0).all():
            raise FitError(
                "a GZ curve needs at least two rising angles above zero", cure="give the table from upright"
            )
        if x[-1] > 2.0:
            raise FitError(f"the GZ curve runs to {x[-1]:.3g} rad", cure="give its angles in radians")
        mirrored = np.concatenate([-x[::-1], [0.0], x])
        spline = CubicSpline(mirrored, np.concatenate([-y[::-1], [0.0], y]))
        slope = float(spline(0.0, 1)) if metacentric_height is None else float(metacentric_height)
        if not slope > 0.0:
            raise FitError(f"the GZ curve has the slope {slope:.3g} m at the origin", cure="check its signs")
        grid = np.linspace(0.0, x[-1], TABLE_INTERVALS + 1)
        values, slopes = spline(grid) / slope, spline(grid, 1) / slope
        step = grid[1]
        rise = np.diff(values)
        cubic = np.column_stack(
            [
                values[:-1],
                slopes[:-1],
                (3.0 * rise / step - 2.0 * slopes[:-1] - slopes[1:]) / step,
                (slopes[:-1] + slopes[1:] - 2.0 * rise / step) / step**2,
            ]
        )
        return cls(float(x[-1]), np.ascontiguousarray(cubic), slope)

    def __call__(self, angle: np.ndarray) -> np.ndarray:
        """g at the angles, shape as given."""
        size = np.abs(np.asarray(angle, dtype=float))
        step = self.last / len(self.cubic)
        row = np.minimum((size / step).astype(int), len(self.cubic) - 1)
        # Beyond the last angle the tangent continues.
        s = np.minimum(size, self.last) - row * step
        a, b, c, d = np.moveaxis(self.cubic[row], -1, 0)
        value = a + s * (b + s * (c + s * d))
        tangent = b + s * (2.0 * c + 3.0 * s * d)
        return np.sign(angle) * (value + tangent * np.maximum(size - self.last, 0.0))

    def slope(self, angle: np.ndarray) -> np.ndarray:
        """dg/dx at the angles, shape as given; constant beyond the table."""
        size = np.minimum(np.abs(np.asarray(angle, dtype=float)), self.last)
        step = self.last / len(self.cubic)
        row = np.minimum((size / step).astype(int), len(self.cubic) - 1)
        s = size - row * step
        _, b, c, d = np.moveaxis(self.cubic[row], -1, 0)
        return b + s * (2.0 * c + 3.0 * s * d)

    def potential(self, angle: np.ndarray) -> np.ndarray:
        """Integral of g from upright to the angles inside the table."""
        step = self.last / len(self.cubic)
        areas = self.cubic @ (step ** np.arange(1, 5) / np.arange(1, 5))
        below = np.concatenate([[0.0], np.cumsum(areas)])
        size = np.minimum(np.abs(np.asarray(angle, dtype=float)), self.last)
        row = np.minimum((size / step).astype(int), len(self.cubic) - 1)
        s = size - row * step
        a, b, c, d = np.moveaxis(self.cubic[row], -1, 0)
        return below[row] + s * (a + s * (b / 2.0 + s * (c / 3.0 + s * d / 4.0)))
