"""One time series of a run: channels in SI, where they came from and what was done to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from .errors import ReadError

if TYPE_CHECKING:
    import pandas as pd

FloatArray = np.ndarray


@dataclass(frozen=True, eq=False)
class Record:
    """Channels of one run in SI units.

    Attributes
    ----------
    channels : mapping of str to ndarray, shape (n,)
        Columns by their standard name (``time``, ``X``, ``Y``, ``N``, ``K``, ``u``, ``v``, ``r``, ...), in
        SI: seconds, metres, newtons, newton-metres, radians.
    units : mapping of str to str
        Unit of each channel before the conversion to SI.
    source : str
        Path of the file, or a description of the generator.
    sha256 : str
        Hash of the file's bytes; empty for generated records.
    steps : tuple of str
        What was done to the channels, in order.
    """

    channels: Mapping[str, FloatArray]
    units: Mapping[str, str] = field(default_factory=dict)
    source: str = ""
    sha256: str = ""
    steps: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        lengths = {len(values) for values in self.channels.values()}
        if len(lengths) > 1:
            raise ReadError("channels differ in length", file=self.source or None)

    def __len__(self) -> int:
        return len(next(iter(self.channels.values()))) if self.channels else 0

    def __contains__(self, name: str) -> bool:
        return name in self.channels

    def __getitem__(self, name: str) -> FloatArray:
        try:
            return self.channels[name]
        except KeyError:
            raise ReadError(
                f"there is no channel '{name}'",
                cure=f"map one in [channels]; this file has {', '.join(self.channels)}",
                file=self.source or None,
            ) from None

    @property
    def time(self) -> FloatArray:
        """Time in seconds, shape (n,)."""
        return self["time"]

    @property
    def time_step(self) -> float:
        """Median sampling interval in seconds."""
        if len(self) < 2:
            raise ReadError(
                f"a record of {len(self)} sample(s) has no sampling rate",
                cure="give at least two rows",
                file=self.source or None,
            )
        return float(np.median(np.diff(self.time)))

    @property
    def frame(self) -> pd.DataFrame:
        """All channels as a DataFrame."""
        import pandas as pd

        return pd.DataFrame(dict(self.channels))

    def with_channels(self, step: str, **channels: FloatArray) -> Record:
        """Copy with `channels` replaced or added, and `step` noted."""
        return replace(self, channels={**self.channels, **channels}, steps=(*self.steps, step))

    def cut(self, window: slice, step: str) -> Record:
        """Copy restricted to the rows of `window`, and `step` noted."""
        channels = {name: values[window] for name, values in self.channels.items()}
        return replace(self, channels=channels, steps=(*self.steps, step))
