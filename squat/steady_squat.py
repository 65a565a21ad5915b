"""Steady squat of a run: window, means and standard errors at the bow, the stern and any other place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import FitError
from ..core.variables import GRAVITY
from ..identify.autocorrelation import MeanEstimate, mean_with_error
from ..identify.steady_window import WindowChoice, speed_plateau, steady_window
from .sinkage_record import SinkageRecord

if TYPE_CHECKING:
    import pandas as pd

WindowRule = Literal["fraction", "plateau", "mser", "key-times"]

SQUAT_COLUMNS = ("run", "quantity", "mean", "se", "n_eff", "window_start", "window_end", "unit")


@dataclass(frozen=True, eq=False)
class SteadySquat:
    """Means of one run over its steady window.

    Attributes
    ----------
    run : str
    means : mapping of str to MeanEstimate
        ``sinkage_<place>`` in m, positive down; ``trim`` as a slope, positive by the bow; ``speed`` in m/s; extra
        channels in SI. The standard error knows that neighbouring samples say the same.
    units : mapping of str to str
    window : WindowChoice
        The window, why it was chosen, and whether a channel still drifts in it.
    depth : float or None
        Water depth in m.
    """

    run: str
    means: Mapping[str, MeanEstimate]
    units: Mapping[str, str]
    window: WindowChoice
    depth: float | None = None

    @property
    def depth_froude_number(self) -> float:
        """V / sqrt(g h).

        Raises
        ------
        FitError
            When the speed was not recorded or no depth was given.
        """
        if self.depth is None or "speed" not in self.means:
            raise FitError(
                "the depth Froude number needs speed and depth", cure="name the speed channel and give the depth"
            )
        return float(self.means["speed"].mean) / float(np.sqrt(GRAVITY * self.depth))

    @property
    def trim_degrees(self) -> float:
        """Trim in degrees, positive by the bow."""
        return float(np.degrees(np.arctan(self.means["trim"].mean)))

    @property
    def frame(self) -> pd.DataFrame:
        """One row a quantity, columns :data:`SQUAT_COLUMNS`."""
        import pandas as pd

        rows = [
            (
                self.run,
                name,
                of.mean,
                of.se,
                of.n_eff,
                self.window.start_time,
                self.window.stop_time,
                self.units[name],
            )
            for name, of in self.means.items()
        ]
        return pd.DataFrame(rows, columns=list(SQUAT_COLUMNS))


def reduce_steady(
    record: SinkageRecord,
    *,
    rule: WindowRule = "fraction",
    fraction: tuple[float, float] = (0.30, 0.95),
    start: float | None = None,
    stop: float | None = None,
    places: Mapping[str, float] | None = None,
    depth: float | None = None,
    run: str = "",
) -> SteadySquat:
    """Steady means of a run.

    Parameters
    ----------
    record : SinkageRecord
    rule : {"fraction", "plateau", "mser", "key-times"}
        ``fraction``: 30 to 95 % of what is steady on the plateau of the carriage speed. ``plateau``: the same part
        of the plateau itself. ``mser``: all that is steady. ``key-times``: between `start` and `stop`.
    fraction : tuple of float
        Begin and end as parts of the steady stretch.
    start, stop : float, optional
        In s.
    places : mapping of str to float, optional
        Name and x in m of the places to report; bow, stern, midship and centre of gravity when not given.
    depth : float, optional
        Water depth in m.
    run : str
        Name; that of the file when empty.

    Raises
    ------
    FitError
        When the depth is not positive, too few samples are left, or ``plateau`` has no speed to go by.
    """
    if depth is not None and not depth > 0.0:
        raise FitError(
            f"a water depth of {depth:g} m is impossible",
            cure="give the depth in m, positive",
            file=record.name or None,
        )
    where = dict(places) if places is not None else record.layout.places
    columns = {f"sinkage_{name}": record.sinkage_at(x) for name, x in where.items()}
    units = dict.fromkeys(columns, "m")
    columns["trim"], units["trim"] = record.trim, "m/m"
    judged = np.column_stack([record.midship, record.trim])
    speed = record.speed
    try:
        if rule == "plateau":
            window = _part_of_plateau(record, judged, fraction)
        else:
            chosen = None if rule == "key-times" else speed
            window = steady_window(
                record.time, judged, rule=rule, fraction=fraction, start=start, stop=stop, speed=chosen
            )
    except FitError as error:
        raise FitError(error.cause, cure=error.cure, file=record.name or None, place=error.place) from error
    if speed is not None:
        columns["speed"], units["speed"] = speed, "m/s"
    for name, values in record.extra.items():
        columns[name], units[name] = values, record.extra_units.get(name, "")
    means = {name: mean_with_error(values[window.slice]) for name, values in columns.items()}
    return SteadySquat(run or record.name, means, units, window, depth)


def _part_of_plateau(record: SinkageRecord, judged: np.ndarray, fraction: tuple[float, float]) -> WindowChoice:
    if record.speed is None:
        raise FitError("the plateau rule needs the carriage speed", cure="name the speed channel in the layout")
    lower, upper = fraction
    if not 0.0 <= lower < upper <= 1.0:
        raise FitError(f"the fraction {lower} to {upper} is no window", cure="use 0 <= begin < end <= 1")
    first, last = speed_plateau(record.speed)
    begin, end = record.time[first], record.time[last - 1]
    return steady_window(
        record.time,
        judged,
        rule="key-times",
        start=float(begin + lower * (end - begin)),
        stop=float(begin + upper * (end - begin)),
    )
