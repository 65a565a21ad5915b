"""Which figures the manoeuvres of a ship get: tracks with definitions, zig-zags, fans, histograms, elasticities."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from matplotlib.axes import Axes

from ..simulate.ensembles import Ensemble
from ..simulate.manoeuvring_results import ManoeuvringResults
from ..simulate.trajectory import Trajectory
from .figure_style import PANEL, new_axes
from .manoeuvre_figures import elasticity_bars, index_histogram, manoeuvre_fan
from .manoeuvre_outputs import file_part
from .turning_figure import track, turning_circle
from .zigzag_figure import heading_and_rudder, speed_and_yaw_rate, spiral, zigzag

FAN = 40
"""Tracks of a fan."""

DRIVEN = {
    "turning": ("advance", "tactical diameter"),
    "zigzag": ("overshoot 1", "overshoot 2"),
    "initial turning": ("initial turning track",),
    "crash stop": ("track reach",),
}
"""Indices whose distribution and elasticities are drawn: those of the IMO standards."""


@dataclass(frozen=True)
class Figure:
    """One figure of a manoeuvre.

    Attributes
    ----------
    kind : {"track", "time", "fan", "histogram", "elasticity"}
    name : str
        Part of a file name, unique.
    caption : str
    draw : callable
        Gives the axes.
    """

    kind: str
    name: str
    caption: str
    draw: Callable[[], Axes]


def manoeuvre_drawings(results: ManoeuvringResults) -> list[Figure]:
    """Every figure of some manoeuvres, in the order of the page."""
    found = [figure for one in results.trajectories for figure in _of_trajectory(one)]
    if results.ensemble is not None:
        found += _of_ensemble(results.ensemble)
    return found


def _of_trajectory(trajectory: Trajectory) -> Iterator[Figure]:
    name, manoeuvre = file_part(trajectory.manoeuvre), trajectory.manoeuvre

    def time(draw: Callable[[Trajectory], Axes], what: str, ending: str = "") -> Figure:
        return Figure("time", f"{name}{ending}", f"{manoeuvre}: {what}", lambda: draw(trajectory))

    if manoeuvre.startswith("turning"):
        lengths = f"{manoeuvre}: track of midship, lengths in L, the ship at every 90° of heading"
        yield Figure("track", name, lengths, lambda: turning_circle(trajectory))
        yield time(speed_and_yaw_rate, "speed and yaw rate", "_motion")
    elif manoeuvre.startswith("zigzag"):
        yield time(zigzag, "heading, rudder and overshoots")
    elif manoeuvre.startswith(("spiral", "reverse spiral")):
        yield time(spiral, "steady yaw rates")
    elif manoeuvre.startswith("initial turning"):
        yield time(heading_and_rudder, "heading and rudder")
    elif manoeuvre.startswith("pull-out"):
        yield time(speed_and_yaw_rate, "speed and yaw rate; the rudder is put amidships in the steady turn")
    else:
        yield Figure("track", name, f"{manoeuvre}: track of midship", lambda: track(trajectory))
        yield time(heading_and_rudder, "heading and rudder", "_heading")
        yield time(speed_and_yaw_rate, "speed and yaw rate", "_motion")


def _of_ensemble(ensemble: Ensemble) -> Iterator[Figure]:
    def fan(manoeuvre: str) -> Axes:
        size = (PANEL[0], PANEL[0]) if manoeuvre.startswith("turning") else PANEL
        return manoeuvre_fan(ensemble.fan(manoeuvre, FAN), ax=new_axes(size))

    def elasticities(manoeuvre: str, index: str) -> Axes:
        ax = elasticity_bars(ensemble, manoeuvre, index)
        ax.set_xlabel("per cent per per cent")  # the caption names the index
        return ax

    for manoeuvre in ensemble.manoeuvres:
        if manoeuvre.startswith(("turning", "zigzag")) and _completed(ensemble, manoeuvre):
            caption = f"{manoeuvre}: {FAN} draws, band of 5 to 95 %"
            yield Figure("fan", f"{file_part(manoeuvre)}_fan", caption, lambda m=manoeuvre: fan(m))  # type: ignore[misc]
    shown = [
        (manoeuvre, index)
        for manoeuvre in ensemble.manoeuvres
        for kind, names in DRIVEN.items()
        for index in names
        if manoeuvre.startswith(kind) and _completed(ensemble, manoeuvre)
    ]
    for manoeuvre, index in shown:
        name = f"{file_part(manoeuvre)}_{index.replace(' ', '_')}"
        caption = f"{manoeuvre}: {index} over {ensemble.draws} draws"
        yield Figure(
            "histogram",
            f"{name}_draws",
            caption,
            lambda m=manoeuvre, i=index: index_histogram(ensemble, m, i),  # type: ignore[misc]
        )
    for manoeuvre, index in shown:
        if "-" in manoeuvre.partition(" ")[2]:
            continue  # the other side says the same
        name = f"{file_part(manoeuvre)}_{index.replace(' ', '_')}"
        yield Figure(
            "elasticity",
            f"{name}_elasticities",
            f"{manoeuvre}: what drives the {index}",
            lambda m=manoeuvre, i=index: elasticities(m, i),  # type: ignore[misc]
        )


def _completed(ensemble: Ensemble, manoeuvre: str) -> bool:
    """True when some draw completed the manoeuvre."""
    return any(ending == "completed" for ending in ensemble.endings[manoeuvre])
