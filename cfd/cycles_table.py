"""Periodic loads of settled cases cycle by cycle, as one table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .settled_loads import SettledCase

if TYPE_CHECKING:
    import pandas as pd


def cycles_table(cases: Sequence[SettledCase]) -> pd.DataFrame:
    """Periodic loads cycle by cycle: case, load, unit, cycle, start, kept, mean, amplitude and phase of each harmonic.

    Parts of a load are there too. Phases are those of ``A cos(k omega t + phase)``, in rad; empty without a periodic
    case.
    """
    import pandas as pd

    frames = []
    for item in cases:
        for name, channel in zip(item.names, item.settling.channels):
            if channel.cycles is None:
                continue
            frame = channel.cycles.to_frame()
            for place, (key, value) in enumerate(
                (("case", item.case.name), ("load", name), ("unit", item.loads.unit(name)))
            ):
                frame.insert(place, key, value)
            frames.append(frame)
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame()
