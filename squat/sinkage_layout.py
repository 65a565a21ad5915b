"""How a run measures sinkage and trim: which channels, at which places, with which sign.

Home convention: sinkage positive down, places x forward and y to starboard of midship, trim positive by the bow as
a slope ``(s_bow - s_stern) / L``. Whatever a laboratory does otherwise is declared here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from ..core.errors import CampaignError

TrimSense = Literal["bow-down", "bow-up"]


@dataclass(frozen=True)
class SinkageLayout:
    """Channels of sinkage and trim.

    Attributes
    ----------
    points : mapping of str to (float, float)
        Channels of sinkage with their place (x, y) in m; two or more at different x give the trim, three or more
        that also differ in y give the heel.
    heave, heave_x : str, float
        Channel of the sinkage at one place, and its x in m: instead of `points`, with `trim`.
    trim : str
        Channel of the trim, an angle, a slope, or a length over `trim_base`.
    trim_positive : {"bow-down", "bow-up"}
        What a positive trim channel means.
    trim_base : float, optional
        Length in m over which a trim in m is measured.
    sinkage_positive : {"down", "up"}
        What a positive sinkage channel means.
    time, speed : str
        Channels of time and speed; `speed` may be empty.
    extra : tuple of str
        Further channels to be reduced along, e.g. the resistance.
    length : float
        Length between perpendiculars in m: bow and stern are at +L/2 and -L/2.
    xG : float
        Centre of gravity forward of midship in m.

    Raises
    ------
    CampaignError
        When the channels do not determine sinkage and trim.
    """

    length: float
    points: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    heave: str = ""
    heave_x: float = 0.0
    trim: str = ""
    trim_positive: TrimSense = "bow-down"
    trim_base: float | None = None
    sinkage_positive: Literal["down", "up"] = "down"
    time: str = "time"
    speed: str = ""
    extra: tuple[str, ...] = ()
    xG: float = 0.0

    def __post_init__(self) -> None:
        if not self.length > 0.0:
            raise CampaignError(f"a length of {self.length:g} m is impossible", cure="give Lpp in m")
        if self.points and self.heave:
            raise CampaignError("sinkage is given both by points and by heave", cure="declare one of them")
        if self.heave and not self.trim:
            raise CampaignError("heave alone gives no trim", cure="name the trim channel", place=self.heave)
        if not self.heave:
            if self.trim:
                raise CampaignError("a trim channel beside points says it twice", cure="leave it out or use heave")
            places = {round(x, 9) for x, _ in self.points.values()}
            if len(places) < 2:
                raise CampaignError(
                    f"{len(self.points)} sinkage channel(s) at {len(places)} place(s) along the ship give no trim",
                    cure="name channels at two different x",
                )
        if self.trim_positive not in ("bow-down", "bow-up") or self.sinkage_positive not in ("down", "up"):
            raise CampaignError(
                "the sense of a channel is unknown", cure="trim: bow-down or bow-up; sinkage: down or up"
            )

    @property
    def sinkage_channels(self) -> tuple[str, ...]:
        """Channels that sinkage and trim come from."""
        return (self.heave, self.trim) if self.heave else tuple(self.points)

    @property
    def channels(self) -> tuple[str, ...]:
        """All channels that are read, time first."""
        names = (self.time, *self.sinkage_channels, self.speed, *self.extra)
        return tuple(dict.fromkeys(name for name in names if name))

    @property
    def places(self) -> dict[str, float]:
        """The places reported by default: name to x in m."""
        return {"bow": 0.5 * self.length, "stern": -0.5 * self.length, "midship": 0.0, "cog": self.xG}
