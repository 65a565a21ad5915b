"""Derivatives from single runs by the textbook's Fourier relations: one estimate a run.

This is what towing tanks did before all runs were fitted at once, and what older derivative tables hold. The
relations assume sinusoidal velocities; where the motion is none the estimates are biased, which
:mod:`.three_ways` shows beside the fit with exact kinematics. Relations for v' = V cos a, r' = R cos a:

* pure sway: Yv = (c1 - 3 c3)/V, Yvvv = 4 c3/V^3, Yvdot = -s1/(w' V), Xvv = 2 c2/V^2, X0 = mean - c2;
  with Yv|v| in place of Yvvv: Yv|v| = 15 pi c3/(8 V^2), Yv = (c1 - 5 c3)/V
* pure yaw: the same with R for V
* yaw with drift v0: Yvrr = 2 c2/(v0 R^2), Yvvr = (c1 - c1 of pure yaw)/(v0^2 R), Xvr = c1/(v0 R)
* pure surge: Xu = c1/A, Xudot = -s1/(w' A), Xuu = 2 c2/A^2, X0 = mean - c2
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ..core.errors import FitError
from ..core.terms import Term
from .reduced_run import ReducedRun
from .sinusoid_motion import (
    ACCELERATION,
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

Form = Literal["cubic", "modulus"]

LATERAL = ("Y", "N", "K")

FROM_MEAN = " from mean"
"""Ending of the name of a second estimate that stands on the mean instead of a harmonic."""

_SAME = 0.01
_YAW_TEST, _DRIFT_TEST = ("speed", "frequency", "sway_amplitude"), ("speed", "drift_angle")


class Estimate(NamedTuple):
    """One estimate of one derivative, scaled (LT), and its standard error (NaN when unknown)."""

    value: float
    std: float


def single_run_derivatives(
    run: ReducedRun, *, form: Form = "cubic", companions: Sequence[ReducedRun] = ()
) -> dict[str, Estimate]:
    """Derivatives that one run gives by the textbook relations.

    Parameters
    ----------
    run : ReducedRun
        Oscillating runs need three harmonics.
    form : {"cubic", "modulus"}
        Non-linear term of the lateral forces: Yvvv or Yv|v|.
    companions : sequence of ReducedRun
        Runs at the same speed that yaw with drift is compared with: pure yaw of the same amplitude (for Yvvr)
        and static drift of the same angle (for the estimate of Yvrr from the mean).

    Returns
    -------
    dict of str to Estimate
        Scaled as the forces of the run are (LT), added-mass terms inside. A steady run gives no derivative but the
        ratio of force to motion, named ``Y/v`` or ``Y/r``; a straight run gives ``X0``. Types without textbook
        relations (combined sway and yaw, runs with rudder) give nothing.

    Raises
    ------
    FitError
        When the run has fewer than three harmonics, or its motion does not oscillate.
    """
    return _derivatives(run, form, _Companions(companions))


def _derivatives(run: ReducedRun, form: Form, companions: _Companions) -> dict[str, Estimate]:
    if not conditions_are_zero(run):
        return {}
    if run.run.kind not in OSCILLATING:
        return _steady(run)
    if run.order < 3:
        raise FitError(
            f"single-run relations need 3 harmonics, this run has {run.order}",
            cure="set reduction.harmonics = 3",
            place=f"run '{run.name}'",
        )
    motion = sinusoid_motion(run)
    if motion.drift and motion.velocity == "r":
        return _yaw_with_drift(run, motion, companions)
    return {} if motion.drift else _pure(run, motion, form)


def _steady(run: ReducedRun) -> dict[str, Estimate]:
    if run.run.kind not in ("static_drift", "steady_yaw"):
        return {}
    state = run.state()
    variable = "v" if run.run.kind == "static_drift" else "r"
    if abs(state[variable]) < 1e-9:
        return (
            {"X0": Estimate(float(run.scaled["X"][0]), float(run.scaled_sd["X"][0]))} if "X" in run.scaled else {}
        )
    return {
        f"{name}/{variable}": Estimate(
            float(run.scaled[name][0]) / state[variable], float(run.scaled_sd[name][0]) / abs(state[variable])
        )
        for name in LATERAL
        if name in run.scaled
    }


def _pure(run: ReducedRun, motion: SinusoidMotion, form: Form) -> dict[str, Estimate]:
    """Sway, yaw or surge alone: as many coefficients as there are harmonics, solved exactly."""
    x = motion.velocity
    square = (["0", x * 2], [MEAN, COS2])
    if x == "u":
        relations = {"X": (["0", x, x * 2, ACCELERATION[x]], [MEAN, COS1, COS2, SIN1])}
    else:
        third = x * 3 if form == "cubic" else f"{x}|{x}|"
        relations = {name: ([x, third, ACCELERATION[x]], [COS1, COS3, SIN1]) for name in LATERAL} | {"X": square}
    estimates: dict[str, Estimate] = {}
    for component, (endings, rows) in relations.items():
        if component not in run.scaled:
            continue
        names = [component + ending for ending in endings]
        columns = np.column_stack([motion.column(Term.parse(name), run.order)[rows] for name in names])
        inverse = np.linalg.inv(columns)
        force, sd = motion.turned(run.scaled[component], run.scaled_sd[component])
        values = inverse @ force[rows]
        spread = np.sqrt(inverse**2 @ sd[rows] ** 2)
        estimates |= {name: Estimate(float(v), float(s)) for name, v, s in zip(names, values, spread, strict=True)}
    return estimates


def _yaw_with_drift(run: ReducedRun, motion: SinusoidMotion, companions: _Companions) -> dict[str, Estimate]:
    estimates: dict[str, Estimate] = {}
    pure_yaw, drift = companions.pure_yaw(run), companions.static_drift(run)
    for component in LATERAL:
        if component not in run.scaled:
            continue
        force, sd = motion.turned(run.scaled[component], run.scaled_sd[component])
        vrr, vvr = (motion.column(Term.parse(component + ending), run.order) for ending in ("vrr", "vvr"))
        estimates[f"{component}vrr"] = _quotient(force[COS2], sd[COS2], vrr[COS2])
        if drift is not None and component in drift.scaled:
            estimates[f"{component}vrr{FROM_MEAN}"] = _quotient(
                force[MEAN] - drift.scaled[component][0],
                math.hypot(sd[MEAN], drift.scaled_sd[component][0]),
                vrr[MEAN],
            )
        if pure_yaw is not None and component in pure_yaw.scaled:
            other, other_sd = sinusoid_motion(pure_yaw).turned(
                pure_yaw.scaled[component], pure_yaw.scaled_sd[component]
            )
            estimates[f"{component}vvr"] = _quotient(
                force[COS1] - other[COS1], math.hypot(sd[COS1], other_sd[COS1]), vvr[COS1]
            )
    if "X" in run.scaled:
        force, sd = motion.turned(run.scaled["X"], run.scaled_sd["X"])
        estimates["Xvr"] = _quotient(force[COS1], sd[COS1], motion.column(Term.parse("Xvr"), run.order)[COS1])
    return estimates


def _quotient(value: float, sd: float, divisor: float) -> Estimate:
    return Estimate(float(value / divisor), float(sd / abs(divisor)))


class _Companions:
    """Level runs that yaw with drift may be compared with.

    Parameters
    ----------
    runs : sequence of ReducedRun
    """

    def __init__(self, runs: Sequence[ReducedRun]) -> None:
        level = [run for run in runs if conditions_are_zero(run)]
        self._yaw = [
            run
            for run in level
            if run.run.kind in ("pure_yaw", "yaw_drift") and not run.run.drift_angle and run.order >= 1
        ]
        self._drift = [run for run in level if run.run.kind == "static_drift"]
        # As arrays: a large campaign asks for each of its runs.
        self._yaw_tests = _parameters(self._yaw, _YAW_TEST)
        self._drift_tests = _parameters(self._drift, _DRIFT_TEST)

    def pure_yaw(self, run: ReducedRun) -> ReducedRun | None:
        """The first pure yaw run of the same speed, depth, frequency and amplitude."""
        return _first_like(self._yaw, self._yaw_tests, _parameters([run], _YAW_TEST)[0])

    def static_drift(self, run: ReducedRun) -> ReducedRun | None:
        """The first static drift run of the same speed, depth and drift angle."""
        return _first_like(self._drift, self._drift_tests, _parameters([run], _DRIFT_TEST)[0])


def _parameters(runs: Sequence[ReducedRun], names: Sequence[str]) -> np.ndarray:
    """Parameters of the test matrix and the inverse of the water depth, shape (n, p + 1)."""
    rows = [[*(getattr(run.run, name) for name in names), 1.0 / run.ship.depth] for run in runs]
    return np.array(rows, dtype=float).reshape(len(runs), len(names) + 1)


def _first_like(runs: Sequence[ReducedRun], tests: np.ndarray, wanted: np.ndarray) -> ReducedRun | None:
    same = np.abs(tests - wanted) <= _SAME * np.maximum(np.abs(tests), np.abs(wanted))
    rows = np.flatnonzero(same.all(axis=1))
    return runs[rows[0]] if rows.size else None


def single_run_table(runs: Sequence[ReducedRun], *, form: Form = "cubic") -> pd.DataFrame:
    """Every single-run estimate.

    Parameters
    ----------
    runs : sequence of ReducedRun
        Runs of one group; they also serve as companions of each other.
    form : {"cubic", "modulus"}

    Returns
    -------
    DataFrame
        Columns run, kind, name, value, std, note. ``attrs["left_out"]`` says which runs gave nothing, and why.
    """
    import pandas as pd

    rows: list[tuple[str, str, str, float, float, str]] = []
    left_out: list[str] = []
    without: Counter[str] = Counter()
    companions = _Companions(runs)
    for run in runs:
        try:
            estimates = _derivatives(run, form, companions)
        except FitError as error:
            left_out.append(f"{run.name}: {error.cause}")
            continue
        if not estimates:
            more = "" if conditions_are_zero(run) else " with rudder, heel or bank"
            without[f"{run.run.kind} run(s){more}"] += 1
        for name, (value, std) in estimates.items():
            note = "ratio of force to motion, not a derivative" if "/" in name else ""
            rows.append((run.name, run.run.kind, name, value, std, note))
    frame = pd.DataFrame(rows, columns=["run", "kind", "name", "value", "std", "note"])
    frame.attrs["left_out"] = left_out + [f"{n} {what}: no textbook relation" for what, n in without.items()]
    return frame


def average_over_runs(
    runs: Sequence[ReducedRun], *, kind: Literal["mean", "rms"] = "mean", form: Form = "cubic"
) -> pd.DataFrame:
    """Single-run estimates averaged over the runs that give them.

    Parameters
    ----------
    runs : sequence of ReducedRun
    kind : {"mean", "rms"}
        The root mean square, which some papers quote, loses the sign; that of the sum is put back, as in the
        virtual captive tests of DTMB 5512 (Tables 16 and 17).
    form : {"cubic", "modulus"}

    Returns
    -------
    DataFrame
        Columns name, value, std, n, spread, note. ``std`` is the larger of what the noise within the runs and
        what the scatter between them give for the average; ``spread`` is the standard deviation over the runs.
        Ratios of steady runs are not averaged: they vary with the motion. ``attrs["left_out"]`` as in
        :func:`single_run_table`.

    Raises
    ------
    FitError
        For an unknown `kind`.
    """
    import pandas as pd

    if kind not in ("mean", "rms"):
        raise FitError(f"there is no average '{kind}'", cure="use mean or rms")
    table = single_run_table(runs, form=form)
    rows: list[tuple[str, float, float, int, float, str]] = []
    for name, group in table[table["note"] == ""].groupby("name", sort=False):
        values, sds = group["value"].to_numpy(float), group["std"].to_numpy(float)
        n = len(values)
        mean = float(values.mean())
        spread = float(values.std(ddof=1)) if n > 1 else math.nan
        average, share = mean, np.full(n, 1.0 / n)
        if kind == "rms":
            size = math.sqrt(float(np.mean(values**2)))
            average = math.copysign(size, mean)
            share = values / (n * size) if size > 0 else share
        std = float(np.sqrt(share**2 @ sds**2))
        between = spread * float(np.sqrt(share @ share))
        finite = [value for value in (std, between) if math.isfinite(value)]
        mixed = bool((values > 0).any() and (values < 0).any())
        note = "the runs differ in sign" if mixed else ""
        rows.append((str(name), average, max(finite, default=math.nan), n, spread, note))
    frame = pd.DataFrame(rows, columns=["name", "value", "std", "n", "spread", "note"])
    frame.attrs |= {"kind": kind, "left_out": table.attrs["left_out"]}
    return frame
