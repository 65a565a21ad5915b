"""Derivatives from several runs of one kind: harmonic amplitudes against the amplitude of the motion.

The multiple-run method fits, for each kind of test apart, the curve that the textbook relations give:

* pure sway: c1 = Yv V + 3/4 Yvvv V^3 and s1 = -Yvdot w' V over the amplitudes V, the mean of X over V^2; pure yaw
  likewise
* yaw with drift: low order (MRL) from the means, Yv v0 + Yvvv v0^3 + 1/2 Yvrr v0 R^2 together with static drift,
  and from c1 = B + Yvvr v0^2 R with one intercept B an amplitude; high order (MRH) from c2 = 1/2 Yvrr v0 R^2
* steady tests: polynomials of the mean in v', r', rudder angle, heel or bank distance

The relations are those of the DTC planar-motion paper of MASHCON 2019 (equations 7 to 9) for any list of terms.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import FitError
from ..core.terms import Term
from ..identify.regression import fit_linear
from .hull_fit import default_terms
from .reduced_run import FORCES, ReducedRun
from .sinusoid_motion import (
    COS1,
    COS2,
    COS3,
    MEAN,
    OSCILLATING,
    SIN1,
    SinusoidMotion,
    conditions_are_zero,
    sinusoid_motion,
)

if TYPE_CHECKING:
    import pandas as pd

Ordinate = Literal["amplitude", "ratio"]

STEADY_CURVES: dict[str, tuple[tuple[str, ...], frozenset[str]]] = {
    "static drift": (("static_drift",), frozenset({"v", "beta"})),
    "static rudder": (("static_rudder",), frozenset({"delta"})),
    "static heel": (("static_heel",), frozenset({"phi"})),
    "steady yaw": (("steady_yaw",), frozenset({"r"})),
    "drift and rudder": (("static_drift", "static_rudder", "drift_rudder"), frozenset({"v", "beta", "delta"})),
    "steady yaw with drift": (
        ("static_drift", "steady_yaw", "steady_yaw_drift"),
        frozenset({"v", "beta", "r"}),
    ),
}
"""Curve -> (types of runs whose means it goes through, variables of its terms); the last type must be there."""

STEADY_VARIABLES = frozenset({"v", "beta", "r", "delta", "phi", "eta"})
"""Variables that steady runs hold constant."""

_ROW_NAMES = {
    MEAN: "mean",
    COS1: "cos 1",
    SIN1: "sin 1",
    COS2: "cos 2 (MRH)",
    COS3: "cos 3 (MRH)",
}

_SAME = 0.01


@dataclass(frozen=True, eq=False)
class AmplitudeCurve:
    """One fitted curve of a mean or a harmonic against the amplitude of the motion.

    Attributes
    ----------
    method : str
        Kind of test and harmonic, e.g. ``pure sway, cos 1``.
    component : {"X", "Y", "N", "K"}
    names : tuple of str
        Derivatives; intercepts that are none of them are left out.
    params : ndarray, shape (p,)
        Scaled (LT), added-mass terms inside.
    cov : ndarray, shape (p, p)
        From the noise within the runs, enlarged when the points scatter more about the curve; NaN when neither is
        known.
    n : int
        Number of points.
    """

    method: str
    component: str
    names: tuple[str, ...]
    params: np.ndarray
    cov: np.ndarray
    n: int


def multiple_run_curves(
    runs: Sequence[ReducedRun],
    terms: Sequence[Term] | None = None,
    *,
    ordinate: Ordinate = "amplitude",
) -> tuple[list[AmplitudeCurve], list[str]]:
    """All curves that the runs allow, those that the field trusts most first.

    Parameters
    ----------
    runs : sequence of ReducedRun
        Runs of one group; runs with rudder, heel or a bank serve the curves over these alone.
    terms : sequence of Term, optional
        Terms of the curves; those that the run types call for when not given. A curve takes the terms that its
        kind of test excites.
    ordinate : {"amplitude", "ratio"}
        First harmonics of pure motions as they are, c1 against V, each point with weight 1/u^2; or the straight
        line of c1/V against V^2 as drawn on paper, all points alike, which draws more on small amplitudes.

    Returns
    -------
    curves : list of AmplitudeCurve
    left_out : list of str
        Curves that the runs cannot give, and why.
    """
    if ordinate not in ("amplitude", "ratio"):
        raise FitError(f"there is no ordinate '{ordinate}'", cure="use amplitude or ratio")
    wanted = tuple(terms) if terms is not None else default_terms([run.run for run in runs])
    left_out: list[str] = []
    wet = [_Test(run, _motion(run, left_out)) for run in runs if not run.run.dry]
    curves: list[AmplitudeCurve] = []
    for component in FORCES:
        own = tuple(term for term in wanted if term.component == component)
        tests = [test for test in wet if component in test.run.scaled]
        if own and tests:
            fitter = _CurveFitter(component, own, curves, left_out)
            fitter.steady(tests)
            fitter.pure(tests, ordinate)
            fitter.yaw_with_drift(tests)
    return curves, left_out


@dataclass(frozen=True, eq=False)
class _Test:
    """A run with its textbook motion; None for steady runs and motions without one."""

    run: ReducedRun
    motion: SinusoidMotion | None
    known: dict[str, np.ndarray] = field(default_factory=dict)
    forces: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)

    @property
    def kind(self) -> str:
        """Type of the run; yaw runs by their drift angle, whatever they are called."""
        if self.motion is None or self.motion.velocity != "r":
            return self.run.run.kind
        return "yaw_drift" if self.motion.drift else "pure_yaw"

    @property
    def straight(self) -> bool:
        """True for a straight run at the carriage speed without rudder and heel."""
        return self.kind == "static_drift" and not self.run.run.drift_angle and conditions_are_zero(self.run)

    def point(self, component: str, row: int) -> tuple[float, float]:
        """Mean or harmonic about the phase of the motion, and its standard error."""
        if component not in self.forces:
            force, sd = self.run.scaled[component], self.run.scaled_sd[component]
            self.forces[component] = (force, sd) if self.motion is None else self.motion.turned(force, sd)
        force, sd = self.forces[component]
        return float(force[row]), float(sd[row])

    def columns(self, terms: Sequence[Term], row: int) -> np.ndarray:
        """Textbook columns of `terms` at the mean or a harmonic, shape (p,)."""
        if self.motion is None:
            return self.run.design(terms)[row]
        for term in terms:
            if term.name not in self.known:
                self.known[term.name] = self.motion.column(term, self.run.order)
        return np.array([self.known[term.name][row] for term in terms])


def _motion(run: ReducedRun, left_out: list[str]) -> SinusoidMotion | None:
    if run.run.kind not in OSCILLATING:
        return None
    try:
        return sinusoid_motion(run)
    except FitError as error:
        left_out.append(f"{run.name}: {error.cause}")
        return None


@dataclass(frozen=True)
class _CurveFitter:
    """Fits the curves of one component and notes what worked and what did not."""

    component: str
    terms: tuple[Term, ...]
    curves: list[AmplitudeCurve]
    left_out: list[str]

    def steady(self, tests: Sequence[_Test]) -> None:
        """Polynomials of the means of steady runs."""
        for label, (kinds, variables) in STEADY_CURVES.items():
            if any(test.kind == kinds[-1] for test in tests):
                used = [
                    test
                    for test in tests
                    if test.straight or (test.kind in kinds and conditions_are_zero(test.run, variables))
                ]
                self._mean_fit(f"{label}, mean", variables, used)
        # Terms that combine heel or a bank with drift and yaw need all steady runs at once.
        steady = [test for test in tests if not test.run.run.harmonic]
        if any(not conditions_are_zero(test.run) for test in steady):
            self._mean_fit("all steady runs, mean", STEADY_VARIABLES, steady)

    def _mean_fit(self, method: str, variables: frozenset[str], tests: Sequence[_Test]) -> None:
        """Polynomial of the means in `variables`."""
        terms = [term for term in self.terms if set(term.variables) <= variables]
        self._fit(method, terms, tests, [test.columns(terms, MEAN) for test in tests], MEAN)

    def pure(self, tests: Sequence[_Test], ordinate: Ordinate) -> None:
        """Mean and harmonics of pure sway, yaw and surge against the amplitude."""
        for kind in ("pure_sway", "pure_yaw", "pure_surge"):
            same = [test for test in tests if test.kind == kind and _pure(test)]
            for row, name in _ROW_NAMES.items():
                used = [test for test in same if row <= 2 * test.run.order]
                columns = [test.columns(self.terms, row) for test in used]
                ratio = ordinate == "ratio" and row == COS1
                self._fit(f"{kind.replace('_', ' ')}, {name}", self.terms, used, columns, row, ratio=ratio)

    def yaw_with_drift(self, tests: Sequence[_Test]) -> None:
        """Coupling from yaw with drift: second harmonic, first harmonic, mean."""
        level = [test for test in tests if conditions_are_zero(test.run)]
        drifting = [test for test in level if test.kind == "yaw_drift"]
        if not drifting:
            return
        used = [test for test in drifting if test.run.order >= 2]
        columns = [test.columns(self.terms, COS2) for test in used]
        self._fit("yaw with drift, cos 2 (MRH)", self.terms, used, columns, COS2)
        yaw = drifting + [test for test in level if test.kind == "pure_yaw" and _pure(test)]
        self._first_harmonic(drifting, yaw)
        static = [test for test in level if test.kind == "static_drift"]
        self._mean_fit("yaw with drift, mean (MRL)", STEADY_CURVES["steady yaw with drift"][1], [*static, *yaw])

    def _first_harmonic(self, drifting: Sequence[_Test], yaw: Sequence[_Test]) -> None:
        """Coupling from cos 1: what yaw alone gives is one unknown for each yaw amplitude."""
        levels = _yaw_levels(drifting)
        belongs = _same_yaw(yaw, levels)
        # A run that is alone at its level settles the intercept there and tells nothing else.
        levels, belongs = levels[belongs.sum(axis=0) > 1], belongs[:, belongs.sum(axis=0) > 1]
        member = np.flatnonzero(belongs.any(axis=1)).tolist()
        used, belongs = [yaw[index] for index in member], belongs[member]
        coupled = [term for term in self.terms if "v" in term.variables]
        alone = [term for term in self.terms if "v" not in term.variables]
        columns = []
        for test, own in zip(used, belongs, strict=True):
            amplitude = test.motion.amplitude if test.motion else 0.0
            yaws = any(test.columns(alone, COS1))
            intercepts = amplitude * own if yaws else np.zeros(len(levels))
            columns.append(np.concatenate([test.columns(coupled, COS1), intercepts]))
        self._fit("yaw with drift, cos 1 (MRL)", coupled, used, columns, COS1)

    def _fit(
        self,
        method: str,
        terms: Sequence[Term],
        tests: Sequence[_Test],
        columns: Sequence[np.ndarray],
        row: int,
        ratio: bool = False,
    ) -> None:
        """Fit one curve; columns beyond those of `terms` are intercepts, which are no derivatives."""
        if not tests or not terms:
            return
        response, sd = np.array([test.point(self.component, row) for test in tests]).T
        design = np.array(columns)
        if ratio:
            amplitude = np.array([test.motion.amplitude if test.motion else math.nan for test in tests])
            design, response, sd = design / amplitude[:, None], response / amplitude, np.full_like(sd, math.nan)
        excited = np.flatnonzero((design != 0).any(axis=0)).tolist()
        names = [terms[i].name for i in excited if i < len(terms)]
        if not names:
            return
        labels = names + [f"intercept {i + 1}" for i in range(len(excited) - len(names))]
        telling = (design != 0).any(axis=1)
        n = int(telling.sum())
        place = f"{method} of {self.component}"
        if n < len(labels):
            self.left_out.append(f"{place}: {n} point(s) cannot give {', '.join(labels)}")
            return
        try:
            params, cov = _weighted_fit(design[np.ix_(telling, excited)], response[telling], sd[telling], labels)
        except FitError as error:
            self.left_out.append(f"{place}: {error.cause}")
            return
        p = len(names)
        self.curves.append(AmplitudeCurve(method, self.component, tuple(names), params[:p], cov[:p, :p], n))


def _weighted_fit(
    design: np.ndarray, response: np.ndarray, sd: np.ndarray, names: Sequence[str]
) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients and covariance of points with weights 1/u^2, or of equal ones when some u is unknown."""
    weights = None
    if np.isfinite(sd).all():
        # Noise-free points have no spread; rounding then sets the floor.
        floor = max(1e-10 * float(np.abs(response).max()), math.sqrt(np.finfo(float).tiny))
        weights = 1.0 / np.maximum(sd, floor) ** 2
    fit = fit_linear(design, response, names, weights=weights)
    if weights is None:
        return fit.params, fit.cov
    # Birge (1932): scatter about the curve beyond the noise within the runs enlarges the covariance.
    ratio = fit.scale if fit.dof > 0 else 1.0
    return fit.params, max(1.0, ratio) * (fit.back @ fit.back.T)


def _pure(test: _Test) -> bool:
    return test.motion is not None and not test.motion.drift and conditions_are_zero(test.run)


def _yaw_levels(tests: Sequence[_Test]) -> np.ndarray:
    """Amplitudes and frequencies of yaw that occur, each once, shape (k, 2)."""
    found = np.empty((0, 2))
    for test in tests:
        if not _same_yaw([test], found).any():
            found = np.vstack([found, _yaw_of(test)])
    return found


def _yaw_of(test: _Test) -> tuple[float, float]:
    return (test.motion.amplitude, test.motion.frequency) if test.motion else (math.nan, math.nan)


def _same_yaw(tests: Sequence[_Test], levels: np.ndarray) -> np.ndarray:
    """Whether each test has the yaw amplitude and frequency of each level, shape (n, k)."""
    own = np.array([_yaw_of(test) for test in tests])[:, None, :]
    near = np.abs(own - levels) <= _SAME * np.maximum(np.abs(own), np.abs(levels))
    return np.asarray(near.all(axis=2))


def multiple_run_derivatives(
    runs: Sequence[ReducedRun],
    terms: Sequence[Term] | None = None,
    *,
    ordinate: Ordinate = "amplitude",
) -> pd.DataFrame:
    """Derivatives of all curves as a table.

    Parameters
    ----------
    runs, terms, ordinate
        As in :func:`multiple_run_curves`.

    Returns
    -------
    DataFrame
        Columns name, value, std, method, n, with one row for each curve that gives a derivative: static tests
        first, then first harmonics and means (MRL), then higher harmonics (MRH); for Yvrr of yaw with drift the
        second harmonic comes before the mean, as in the DTC paper. ``attrs["left_out"]`` says which curves the
        runs cannot give.
    """
    import pandas as pd

    curves, left_out = multiple_run_curves(runs, terms, ordinate=ordinate)
    rows = [
        (name, float(value), float(std), curve.method, curve.n)
        for curve in curves
        for name, value, std in zip(curve.names, curve.params, np.sqrt(np.diag(curve.cov)), strict=True)
    ]
    frame = pd.DataFrame(rows, columns=["name", "value", "std", "method", "n"])
    frame.attrs["left_out"] = left_out
    return frame
