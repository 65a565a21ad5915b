"""Runs of one condition pooled: which runs are repeats, their mean, scatter and Student-t interval."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..verify.repeatability import Repeats, pooled_repeats
from .steady_squat import SteadySquat

if TYPE_CHECKING:
    import pandas as pd

REPEAT_COLUMNS = (
    "condition",
    "quantity",
    "n",
    "mean",
    "sd",
    "se",
    "lower95",
    "upper95",
    "single_half_width",
    "unit",
)


@dataclass(frozen=True, eq=False)
class RepeatedRuns:
    """Repeats of one condition.

    Attributes
    ----------
    condition : str
    runs : tuple of SteadySquat
        Two or more.
    pooled : mapping of str to Repeats
        By quantity; those that every run has.
    """

    condition: str
    runs: tuple[SteadySquat, ...]
    pooled: Mapping[str, Repeats]

    @property
    def frame(self) -> pd.DataFrame:
        """One row a quantity, columns :data:`REPEAT_COLUMNS`; ``single_half_width`` is for one further run."""
        import pandas as pd

        rows = [
            (
                self.condition,
                name,
                of.n,
                of.mean,
                of.sd,
                of.se,
                *of.interval,
                of.single_half_width,
                self.runs[0].units[name],
            )
            for name, of in self.pooled.items()
        ]
        return pd.DataFrame(rows, columns=list(REPEAT_COLUMNS))


def pool_repeats(
    runs: Sequence[SteadySquat], conditions: Sequence[str], same_speed: float = 0.005
) -> list[RepeatedRuns]:
    """Pool runs of one condition.

    Parameters
    ----------
    runs : sequence of SteadySquat
    conditions : sequence of str
        Name of the condition of each run; runs without a name are repeats where depth and speed agree.
    same_speed : float
        Part of the speed by which speeds of repeats may differ; 0 pools named conditions only.

    Returns
    -------
    list of RepeatedRuns
        In the order of the first run of each; conditions with one run are left out.
    """
    groups: dict[str, list[SteadySquat]] = {}
    levels: list[tuple[str, float, float | None]] = []
    for run, name in zip(runs, conditions, strict=True):
        label = name or _label_by_speed(run, levels, same_speed)
        groups.setdefault(label, []).append(run)
    return [
        RepeatedRuns(
            label,
            tuple(members),
            {
                quantity: pooled_repeats([float(member.means[quantity].mean) for member in members])
                for quantity in members[0].means
                if all(quantity in member.means for member in members)
            },
        )
        for label, members in groups.items()
        if len(members) > 1
    ]


def _label_by_speed(run: SteadySquat, levels: list[tuple[str, float, float | None]], same_speed: float) -> str:
    if "speed" not in run.means or same_speed == 0.0:
        return run.run
    speed = float(run.means["speed"].mean)
    for label, level, depth in levels:
        if depth == run.depth and abs(speed - level) <= same_speed * abs(level):
            return label
    label = f"{speed:.4g} m/s" + ("" if run.depth is None else f", depth {run.depth:g} m")
    levels.append((label, speed, run.depth))
    return label
