"""Measured forces beside the fitted curve with its band: the numbers behind the figures of a fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.motion import Motion, scaled_state
from ..core.ship import Ship
from ..pmm.hull_fit import HullFit
from ..pmm.reduced_run import ReducedRun

SWEEP_LABELS = {
    "beta": "drift angle β [deg]",
    "r": "yaw rate r′ = r L/U [-]",
    "delta": "rudder angle δ [deg]",
    "phi": "heel angle φ [deg]",
    "eta": "deviation towards the bank η/L [-]",
}
"""Variables of steady runs that forces are drawn against, with their axis labels."""

_SYMBOLS = {"beta": "β", "r": "r′", "delta": "δ", "phi": "φ", "eta": "η/L"}
_DEGREES = ("beta", "delta", "phi")
_DECIMALS = {"beta": 3, "r": 2, "delta": 3, "phi": 3, "eta": 3}

HARMONIC_NAMES = ("mean", "cos 1", "sin 1", "cos 2", "sin 2", "cos 3", "sin 3")


@dataclass(frozen=True, eq=False)
class SweepCurve:
    """Steady runs in which one variable varies and the others stay.

    Attributes
    ----------
    label : str
        The variables that differ from curve to curve, e.g. ``r′ = 0.3``; empty for a single curve.
    runs : tuple of int
        Indices into the runs of the fit.
    x : ndarray
        The variable in each run: angles in rad, r' and eta/L non-dimensional.
    """

    label: str
    runs: tuple[int, ...]
    x: np.ndarray


@dataclass(frozen=True, eq=False)
class Sweep:
    """Curves against one variable."""

    variable: str
    curves: tuple[SweepCurve, ...]

    @property
    def label(self) -> str:
        """Axis label with unit."""
        return SWEEP_LABELS[self.variable]

    def shown(self, x: np.ndarray) -> np.ndarray:
        """The variable in the unit of the label."""
        return np.degrees(x) if self.variable in _DEGREES else x


def sweeps(fit: HullFit, most: int = 6) -> list[Sweep]:
    """The variables against which the steady runs of a fit can be drawn.

    Parameters
    ----------
    fit : HullFit
    most : int
        Curves of one sweep at most: the one nearest to straight ahead, and others spread over the rest.
    """
    steady = [(index, run.state()) for index, run in enumerate(fit.runs) if run.order == 0]
    found = []
    for variable in SWEEP_LABELS:
        others = [name for name in SWEEP_LABELS if name != variable]
        families: dict[tuple[float, ...], list[tuple[int, dict[str, float]]]] = {}
        for index, state in steady:
            key = tuple(round(state.get(name, 0.0), _DECIMALS[name]) + 0.0 for name in others)
            families.setdefault(key, []).append((index, state))
        long = {
            key: sorted(runs, key=lambda item: item[1].get(variable, 0.0))
            for key, runs in families.items()
            if len({round(state.get(variable, 0.0), 6) for _, state in runs}) >= 3
        }
        varied = [name for place, name in enumerate(others) if len({key[place] for key in long}) > 1]
        curves = [_curve(long[key], variable, varied) for key in _spread(list(long), most)]
        if curves:
            found.append(Sweep(variable, tuple(curves)))
    return found


def _spread(keys: list[tuple[float, ...]], most: int) -> list[tuple[float, ...]]:
    """At most some of the keys, in order: the smallest one, and others evenly from first to last."""
    ordered = sorted(keys)
    if len(ordered) <= most:
        return ordered
    smallest = min(range(len(ordered)), key=lambda place: sum(abs(value) for value in ordered[place]))
    places = np.linspace(0, len(ordered) - 1, most - 1).round().astype(int).tolist()
    return [ordered[place] for place in sorted({smallest, *places})]


def _curve(runs: Sequence[tuple[int, dict[str, float]]], variable: str, varied: Sequence[str]) -> SweepCurve:
    state = runs[0][1]
    label = ", ".join(_value(name, state.get(name, 0.0)) for name in varied)
    x = np.array([state.get(variable, 0.0) for _, state in runs])
    return SweepCurve(label, tuple(index for index, _ in runs), x)


def _value(name: str, value: float) -> str:
    shown = f"{np.degrees(value) + 0.0:.3g}°" if name in _DEGREES else f"{value + 0.0:.3g}"
    return f"{_SYMBOLS[name]} = {shown}"


def curve_along(
    fit: HullFit, curve: SweepCurve, variable: str, component: str, count: int = 41
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fitted scaled force along a sweep.

    Parameters
    ----------
    fit : HullFit
    curve : SweepCurve
    variable : str
    component : {"X", "Y", "N", "K"}
    count : int
        Number of points.

    Returns
    -------
    x, value, half_width : ndarray, shape (count,)
        The variable (rad or non-dimensional), force over ``0.5 rho L T U**2``, half width of its 95 % interval.
    """
    run = fit.runs[curve.runs[0]]
    state = run.state()
    x = np.linspace(min(0.0, float(curve.x.min())), max(0.0, float(curve.x.max())), count)
    motion = {name: values.copy() for name, values in run.motion.at(np.zeros(count)).items()}
    speed, length = run.motion.speed, run.ship.L
    beta = x if variable == "beta" else np.full(count, state["beta"])
    yaw = x if variable == "r" else np.full(count, state["r"])
    motion |= {"surge": speed * np.cos(beta), "v": -speed * np.sin(beta), "r": yaw * speed / length}
    if variable in ("delta", "phi"):
        motion[variable] = x
    elif variable == "eta":
        motion["eta"] = x * length
    value, half = predicted(fit, component, motion, speed, run.ship)
    return x, value, half


def predicted(
    fit: HullFit, component: str, motion: Motion, approach_speed: float, ship: Ship
) -> tuple[np.ndarray, np.ndarray]:
    """Scaled force that a fit gives for a motion, and the half width of its 95 % interval.

    The interval is that of the fitted curve (scatter and shared bias of the derivatives), not of a new
    measurement.

    Parameters
    ----------
    fit : HullFit
    component : {"X", "Y", "N", "K"}
    motion : mapping
        Motion of midship in SI, see :func:`towtank.core.motion.scaled_state`.
    approach_speed : float
        U0 in m/s.
    ship : Ship
    """
    derivatives = fit.derivatives
    rows = [i for i, term in enumerate(derivatives.terms) if term.component == component]
    state, _ = scaled_state(motion, ship, derivatives.conventions, approach_speed)
    columns = np.column_stack([derivatives.terms[i].column(state) for i in rows])
    value = columns @ derivatives.values[rows]
    if derivatives.covariance is None:
        return value, np.zeros(len(value))
    block = derivatives.covariance[np.ix_(rows, rows)]
    variance = np.einsum("ij,jk,ik->i", columns, block, columns)
    return value, interval_factor(derivatives.dof) * np.sqrt(np.maximum(variance, 0.0))


def interval_factor(dof: float, level: float = 0.95) -> float:
    """Standard errors in the half width of a two-sided interval (Student t)."""
    from scipy.special import ndtri, stdtrit

    tail = 0.5 + level / 2
    return float(stdtrit(dof, tail) if np.isfinite(dof) else ndtri(tail))


def motion_amplitude(run: ReducedRun) -> tuple[float, str]:
    """Largest v' (sway), u' (surge) or r' (yaw) of an oscillating run, and its name."""
    times = run.window.start + run.run.period * np.arange(48) / 48
    motion = run.motion.at(times)
    speed = np.hypot(motion["surge"], motion["v"])
    if run.run.kind in ("pure_sway", "sway_yaw"):
        return float(np.max(np.abs(motion["v"]) / speed)), "largest sway velocity v′ [-]"
    if run.run.kind == "pure_surge":
        return float(np.max(np.abs(motion["surge"] / run.motion.speed - 1.0))), "largest surge velocity u′ [-]"
    return float(np.max(np.abs(motion["r"]) * run.ship.L / speed)), "largest yaw rate r′ [-]"


def harmonic_name(row: int) -> str:
    """Name of a row of harmonics: mean, cos 1, sin 1, ..."""
    if row < len(HARMONIC_NAMES):
        return HARMONIC_NAMES[row]
    return f"{'cos' if row % 2 else 'sin'} {(row + 1) // 2}"
