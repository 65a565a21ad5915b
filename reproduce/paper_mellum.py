"""MELLUM sea trials in shallow water (BAW, MASHCON 2019): what the turning circles say, and the current's removal."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from ..simulate.current import estimate_current
from ..simulate.trajectory import Trajectory
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_rows, ship_of
from .rounding import spread_of

KEY = "mellum"

_CIRCLES = "mellum-turning-circles"

_DERIVED_DECIMALS = {
    "advance_change": 1, "tactical_diameter_change": 1, "radius_change": 1, "speed_loss": 1,
    "initial_depth_ratio": 2, "turning_depth_ratio": 2, "yaw_rate": 3, "advance": 3, "tactical_diameter": 3,
    "radius": 3, "diameter_over_steady": 3,
}  # fmt: skip

_WORDS = {
    "advance_change": "change of the advance in %",
    "tactical_diameter_change": "change of the tactical diameter in %",
    "radius_change": "change of the radius in %",
    "speed_loss": "speed loss in %",
    "initial_depth_ratio": "h/T in the approach",
    "turning_depth_ratio": "h/T in the turn",
    "yaw_rate": "rate of turn V/R in deg/s",
    "advance": "advance in L",
    "tactical_diameter": "tactical diameter in L",
    "radius": "radius in L",
    "diameter_over_steady": "tactical diameter over 2 R",
}

_TEXT = (
    ("radius", 2.0, {70: 1.0, 90: 1.0}),
    ("radius", 1.5, {70: 14.0, 90: 14.0}),
    ("tactical_diameter", 2.0, {70: 4.0, 90: 4.0}),
    ("tactical_diameter", 1.5, {70: 14.0, 90: 14.0}),
    ("advance", 2.0, {70: -5.0, 90: -5.0}),
    ("advance", 1.5, {70: -6.0, 90: -7.0}),
    ("turning_speed", 1.5, {70: 10.0, 90: 10.0}),
)
"""Changes against deep water in per cent that the text names."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _changes_of_the_text()
    yield from _speeds_of_the_text()
    yield from _derived_table()
    yield from _current()


def _circles() -> dict[tuple[int, float], dict[str, float]]:
    return {(int(row["telegraph"]), row["depth_ratio"]): row for row in printed_rows(_CIRCLES)}


def change(shallow: float, deep: float) -> float:
    """Change against deep water in per cent."""
    return 100.0 * (shallow / deep - 1.0)


def speed_loss(initial: float, turning: float) -> float:
    """Loss of speed in the turn in per cent."""
    return 100.0 * (1.0 - turning / initial)


def _changes_of_the_text() -> Iterator[Case]:
    circles = _circles()
    for quantity, depth, printed in _TEXT:
        for telegraph, value in printed.items():
            pair = circles[telegraph, depth][quantity], circles[telegraph, 5.0][quantity]
            yield Case(
                KEY,
                f"text, h/T = {depth:g} against deep water, {telegraph} % telegraph",
                f"change of the {quantity.replace('_', ' ')} in %",
                value,
                change(*pair),
                spread_of(change, (pair[0], 1), (pair[1], 1)) + half_digit(0),
            )


def _speeds_of_the_text() -> Iterator[Case]:
    circles = _circles()
    depths = (5.0, 2.0, 1.5)
    for telegraph, printed in ((70, 47.0), (90, 52.0)):
        pairs = [
            (circles[telegraph, depth]["initial_speed"], circles[telegraph, depth]["turning_speed"])
            for depth in depths
        ]
        yield _mean(f"text, {telegraph} % telegraph", "mean speed loss in %", printed, speed_loss, pairs)
    pairs = [(circles[90, depth]["initial_speed"], circles[70, depth]["initial_speed"]) for depth in depths]
    yield _mean("text, 90 against 70 % telegraph", "mean gain of the initial speed in %", 15.0, change, pairs)


def _mean(
    case: str, quantity: str, printed: float, of: Callable[[float, float], float], pairs: list[tuple[float, float]]
) -> Case:
    """Mean of a change over the depths; speeds are printed in tenths of a knot."""
    spread = float(np.mean([spread_of(of, (first, 1), (second, 1)) for first, second in pairs]))
    return Case(
        KEY, case, quantity, printed, float(np.mean([of(*pair) for pair in pairs])), spread + half_digit(0)
    )


def _derived(row: dict[str, float], deep: dict[str, float], length: float, draught: float) -> dict[str, float]:
    radius = row["radius"]
    return {
        "advance_change": change(row["advance"], deep["advance"]),
        "tactical_diameter_change": change(row["tactical_diameter"], deep["tactical_diameter"]),
        "radius_change": change(radius, deep["radius"]),
        "speed_loss": speed_loss(row["initial_speed"], row["turning_speed"]),
        "initial_depth_ratio": 1.0 + row["initial_clearance"] / draught,
        "turning_depth_ratio": 1.0 + row["turning_clearance"] / draught,
        "yaw_rate": math.degrees(row["turning_speed"] * KNOT / radius),
        "advance": row["advance"] / length,
        "tactical_diameter": row["tactical_diameter"] / length,
        "radius": radius / length,
        "diameter_over_steady": row["tactical_diameter"] / (2.0 * radius),
    }


def _derived_table() -> Iterator[Case]:
    """The recomputed table: nothing of it is printed, all of it follows from what is."""
    ship, circles = ship_of(_CIRCLES), _circles()
    for reference in printed_rows("mellum-derived"):
        telegraph, depth = int(reference["telegraph"]), reference["depth_ratio"]
        ours = _derived(circles[telegraph, depth], circles[telegraph, 5.0], ship.L, ship.T)
        for name, decimals in _DERIVED_DECIMALS.items():
            yield Case(
                KEY,
                f"from Table 3, h/T = {'> ' if depth == 5.0 else ''}{depth:g}, {telegraph} % telegraph",
                f"{_WORDS[name]} (recomputed reference)",
                reference[name],
                ours[name],
                half_digit(decimals),
            )


def drifting_circle(
    radius: float, speed: float, current: float, turns: float = 2.0, noise: float = 0.02
) -> Trajectory:
    """Track of a steady turn in a current towards 60 degrees, with position noise in m from a fixed seed."""
    rate = speed / radius
    time = np.arange(0.0, 2.0 * math.pi * turns / rate, 1.0)
    psi = rate * time
    drift = current * time
    scatter = noise * np.random.default_rng(2019).standard_normal((2, len(time)))
    columns = {
        "time": time,
        "x": radius * np.sin(psi) + drift * math.cos(math.pi / 3.0) + scatter[0],
        "y": radius * (1.0 - np.cos(psi)) + drift * math.sin(math.pi / 3.0) + scatter[1],
        "psi": psi,
    }
    return Trajectory.from_columns(columns, ship_of(_CIRCLES), "turning")


def _current() -> Iterator[Case]:
    """The criterion of the roundest path, on circles like those of the trials."""
    radius, speed = 74.0, 3.4
    for current in (0.12, 0.5, 0.9):
        track = drifting_circle(radius, speed, current)
        found = estimate_current(track, (0.0, float(track["time"][-1])))
        case = f"method of the current, two circles of 74 m, {current:g} m/s (synthetic)"
        yield Case(KEY, case, "current in m/s", current, found.speed, 1e-3)
        yield Case(KEY, case, "radius in m", radius, found.radius, 1e-2)


PAPER = Paper(
    KEY,
    "Jansch and Boettner (2019), MELLUM manoeuvring sea trials in shallow water conditions, 5th MASHCON, Ostend, "
    "pp. 152-157",
    cases,
)
