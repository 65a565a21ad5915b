"""Squat over speed: measured points, a fitted curve with its band, and what it means at full scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import FitError
from ..core.variables import GRAVITY
from .steady_squat import SteadySquat

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

CurveModel = Literal["depth-froude", "power"]


@dataclass(frozen=True, eq=False)
class CurveFit:
    """A squat curve through measured points.

    Attributes
    ----------
    model : {"depth-froude", "power"}
        ``c Fh^2 / sqrt(1 - Fh^2)`` with c in m (the form of Tuck and ICORELS), or ``c V^p``.
    params : ndarray, shape (1,) or (2,)
        c, or (c, p).
    cov : ndarray
        Covariance of `params`.
    residual_sd : float
        Scatter of the points about the curve, in their unit.
    dof : int
        Points less parameters.
    speed_range : (float, float)
        Speeds between which the curve stands on points, m/s.
    depth : float
        Water depth in m.
    """

    model: CurveModel
    params: np.ndarray
    cov: np.ndarray
    residual_sd: float
    dof: int
    speed_range: tuple[float, float]
    depth: float

    def predict(self, speed: ArrayLike) -> np.ndarray:
        """Value of the curve at speeds in m/s.

        Raises
        ------
        FitError
            For the depth Froude form at or above the critical speed.
        """
        v = np.atleast_1d(np.asarray(speed, dtype=float))
        if self.model == "power":
            return np.asarray(self.params[0] * v ** self.params[1])
        return np.asarray(self.params[0] * _tuck_factor(v, self.depth))

    def band(self, speed: ArrayLike, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limit of the curve itself (not of single runs) at speeds in m/s, Student-t.

        Raises
        ------
        FitError
            When no degree of freedom is left to know the scatter.
        """
        from scipy.special import stdtrit

        if self.dof < 1:
            raise FitError("as many parameters as points leave no band", cure="give more speeds")
        v = np.atleast_1d(np.asarray(speed, dtype=float))
        middle = self.predict(v)
        if self.model == "power":
            c, p = self.params
            gradient = np.column_stack([v**p, c * v**p * np.log(v)])
        else:
            gradient = _tuck_factor(v, self.depth)[:, None]
        half = stdtrit(self.dof, 0.5 + 0.5 * level) * np.sqrt(
            np.einsum("ij,jk,ik->i", gradient, self.cov, gradient)
        )
        return middle - half, middle + half

    def extrapolated(self, speed: ArrayLike) -> np.ndarray:
        """True at speeds outside those of the points."""
        v = np.atleast_1d(np.asarray(speed, dtype=float))
        return np.asarray((v < self.speed_range[0]) | (v > self.speed_range[1]))


@dataclass(frozen=True, eq=False)
class SquatCurve:
    """Steady squat of one ship at one depth over speed.

    Attributes
    ----------
    points : DataFrame
        Column ``speed`` (m/s), then a column a quantity (``sinkage_bow``, ``trim``, ...), and ``<quantity>_se`` for
        its standard error; ascending speed.
    depth : float
        Water depth in m.
    draught : float
        In m, for the clearance under the keel.
    name : str
    scale : float
        Full-scale length over that of the points: 1 for full scale.
    """

    points: pd.DataFrame
    depth: float
    draught: float
    name: str = ""
    scale: float = 1.0

    def __post_init__(self) -> None:
        if not self.depth > 0.0:
            raise FitError(
                f"a water depth of {self.depth:g} m is impossible", cure="give the depth in m, positive"
            )
        if not 0.0 < self.draught < self.depth:
            raise FitError(
                f"a draught of {self.draught:g} m in {self.depth:g} m of water leaves no clearance",
                cure="give both in m at the same scale",
            )
        if "speed" not in self.points:
            raise FitError("the points have no column 'speed'", cure="give it in m/s", place=self.name)
        speed = self.points["speed"].to_numpy(dtype=float)
        if not np.isfinite(speed).all() or (speed < 0.0).any():
            raise FitError("a speed is missing or negative", cure="give speeds through the water in m/s")
        object.__setattr__(self, "points", self.points.sort_values("speed", ignore_index=True))

    @classmethod
    def from_runs(
        cls, runs: Sequence[SteadySquat], draught: float, *, name: str = "", scale: float = 1.0
    ) -> SquatCurve:
        """Curve of reduced runs, one point a run.

        Raises
        ------
        FitError
            When a run has no speed or no depth, or the depths differ.
        """
        import pandas as pd

        if not runs:
            raise FitError("no run makes no curve", cure="give reduced runs")
        depths = {run.depth for run in runs}
        if len(depths) != 1 or None in depths:
            raise FitError(
                "the runs of a curve need one water depth",
                cure="reduce them with depth=..., and make one curve a depth",
                place=name,
            )
        rows = []
        for run in runs:
            if "speed" not in run.means:
                raise FitError("has no speed", cure="name its speed channel in the layout", place=run.run)
            row: dict[str, float] = {"speed": float(run.means["speed"].mean)}
            for quantity, of in run.means.items():
                if quantity != "speed":
                    row[quantity], row[f"{quantity}_se"] = float(of.mean), float(of.se)
            rows.append(row)
        depth = runs[0].depth
        assert depth is not None
        return cls(pd.DataFrame(rows), depth, draught, name, scale)

    @property
    def depth_froude_number(self) -> np.ndarray:
        """V / sqrt(g h) of the points, shape (n,)."""
        return self.points["speed"].to_numpy(dtype=float) / float(np.sqrt(GRAVITY * self.depth))

    def fit(self, quantity: str = "sinkage_bow", model: CurveModel = "depth-froude") -> CurveFit:
        """Curve through the points of one quantity, by least squares.

        Parameters
        ----------
        quantity : str
        model : {"depth-froude", "power"}
            See :class:`CurveFit`. The power law is fitted to the values, not to their logarithms.

        Raises
        ------
        FitError
            For an unknown quantity or model, too few points, a point at or above the critical speed (depth-froude),
            or a speed of zero or a change of sign (power).
        """
        if quantity not in self.points:
            raise FitError(
                f"the points have no '{quantity}'", cure=f"name one of {', '.join(self.points.columns)}"
            )
        kept = self.points[["speed", quantity]].dropna()
        v, y = kept["speed"].to_numpy(dtype=float), kept[quantity].to_numpy(dtype=float)
        parameters = 1 if model == "depth-froude" else 2
        if len(v) <= parameters:
            raise FitError(f"{len(v)} point(s) carry no {model} curve with a scatter", cure="give more speeds")
        if model == "depth-froude":
            design = _tuck_factor(v, self.depth)[:, None]
            params = np.array([float(design[:, 0] @ y / (design[:, 0] @ design[:, 0]))])
            left = y - design @ params
        elif model == "power":
            params, left, design = _fit_power(v, y)
        else:
            raise FitError(f"there is no curve '{model}'", cure="use depth-froude or power")
        dof = len(v) - parameters
        variance = float(left @ left) / dof
        cov = variance * np.linalg.inv(design.T @ design)
        return CurveFit(
            model, params, cov, float(np.sqrt(variance)), dof, (float(v.min()), float(v.max())), self.depth
        )

    def full_scale(self) -> SquatCurve:
        """The curve at full scale by Froude's law: lengths times the scale, speeds times its root, trim as it is.

        Sinkage follows Froude's law but for viscosity: the thicker boundary layer of a model makes it squat
        slightly differently, which this scaling does not know.
        """
        import pandas as pd

        columns = {}
        for name in self.points.columns:
            of = str(name)
            factor = 1.0
            if of == "speed":
                factor = float(np.sqrt(self.scale))
            elif of.startswith("sinkage_"):
                factor = self.scale
            elif not of.startswith("trim"):
                continue
            columns[of] = self.points[name].to_numpy(dtype=float) * factor
        return SquatCurve(
            pd.DataFrame(columns), self.depth * self.scale, self.draught * self.scale, self.name, scale=1.0
        )

    def clearance(self) -> np.ndarray:
        """Water left under the keel at the deeper end in m, shape (n,): depth less draught less the larger sinkage.

        Raises
        ------
        FitError
            When bow or stern was not reported.
        """
        if not {"sinkage_bow", "sinkage_stern"} <= set(self.points.columns):
            raise FitError("the clearance needs the sinkage at bow and stern", cure="report both places")
        deepest = self.points[["sinkage_bow", "sinkage_stern"]].max(axis=1).to_numpy(dtype=float)
        return self.depth - self.draught - deepest


def _tuck_factor(speed: np.ndarray, depth: float) -> np.ndarray:
    """Fh^2 / sqrt(1 - Fh^2), which ends at the critical speed."""
    square = speed**2 / (GRAVITY * depth)
    if np.any(square >= 1.0):
        worst = float(speed[np.argmax(square)])
        raise FitError(
            f"{worst:g} m/s is not below the critical speed {np.sqrt(GRAVITY * depth):.4g} m/s of {depth:g} m of water",
            cure="leave such speeds out, or use the power law",
        )
    return np.asarray(square / np.sqrt(1.0 - square))


def _fit_power(v: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """c and p of c V^p by Gauss-Newton with c eliminated, the residual and the gradient."""
    from scipy.optimize import minimize_scalar

    if (v <= 0.0).any():
        raise FitError("a power law has no point at rest", cure="leave the speed 0 out")
    if not ((y > 0.0).all() or (y < 0.0).all()):
        raise FitError("a power law does not change its sign", cure="use depth-froude, or another quantity")
    unit = float(v.max())
    r = v / unit

    def misfit(p: float) -> float:
        column = r**p
        return float(np.sum((y - column * (column @ y) / (column @ column)) ** 2)) / float(y @ y)

    p = float(minimize_scalar(misfit, bounds=(0.0, 12.0), method="bounded", options={"xatol": 1e-10}).x)
    column = r**p
    c = float(column @ y / (column @ column)) / unit**p
    gradient = np.column_stack([v**p, c * v**p * np.log(v)])
    return np.array([c, p]), y - c * v**p, gradient
