"""Runs of a campaign in groups that are fitted by themselves, and the runs that a report shows."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .reduced_run import ReducedRun
from .run_types import Run

_DEEP = 1e9
_TEXT = {"depth": "h/T {:g}", "speed": "Fn {:g}", "heel": "heel {:g} deg"}


def group_runs(runs: Sequence[ReducedRun], by: Sequence[str]) -> dict[str, list[ReducedRun]]:
    """Runs by label of their group, in the order of depth, speed or heel.

    Parameters
    ----------
    runs : sequence of ReducedRun
    by : sequence of {"depth", "speed", "heel"}
        What the runs of one group have in common, to three decimals of h/T, Froude number and degrees.

    Returns
    -------
    dict of str to list of ReducedRun
        The label is empty when there is one group.
    """
    groups: dict[tuple[float, ...], list[ReducedRun]] = {}
    for run in runs:
        value = {
            "depth": min(run.ship.depth_ratio, _DEEP),
            "speed": run.ship.froude_number(run.run.speed),
            "heel": math.degrees(run.run.heel),
        }
        groups.setdefault(tuple(round(value[name], 3) + 0.0 for name in by), []).append(run)
    if len(groups) == 1:
        return {"": next(iter(groups.values()))}

    def label(key: tuple[float, ...]) -> str:
        return ", ".join(
            "deep water" if name == "depth" and value >= _DEEP else _TEXT[name].format(value)
            for name, value in zip(by, key, strict=True)
        )

    return {label(key): groups[key] for key in sorted(groups)}


def shown_runs(runs: Sequence[Run], wanted: int) -> frozenset[str]:
    """Names of `wanted` runs that show most: each kind in turn, the largest motion first."""
    by_kind: dict[str, list[Run]] = {}
    for run in runs:
        by_kind.setdefault(run.kind, []).append(run)
    for same in by_kind.values():
        same.sort(key=lambda run: -abs(run.sway_amplitude) - abs(run.drift_angle) - abs(run.yaw_rate))
    shown: list[str] = []
    while len(shown) < wanted and any(by_kind.values()):
        for same in by_kind.values():
            if same and len(shown) < wanted:
                shown.append(same.pop(0).name)
    return frozenset(shown)
