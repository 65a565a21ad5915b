"""Satellite antennas and attitude sensors on a ship under way: how deep its keel is, and how it trims and heels.

The altitude of an antenna tells the depth of the keel when the attitude is known: 50 m above the keel and 150 m from
midship, a trim of 0.1 degrees moves it by 26 cm and a heel of 3 degrees by 7 cm. The rotation is exact for that
reason, not linear. Signs are those of the house: trim positive by the bow, heel positive to starboard.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import CampaignError
from ..core.findings import Finding, accept, stop_on_error
from ..formats.read import read_table
from ..formats.units import conversion
from .audit_sinkage import FEWEST_SAMPLES, heading_findings, time_findings, value_findings
from .si_channel import require_channels, si_channel

if TYPE_CHECKING:
    from ..formats.raw_table import RawTable

LARGEST_ANGLE = 0.5
"""Trim or heel in rad beyond which the channel is in degrees."""
LARGEST_MISFIT = 0.10
"""Root mean square in m by which antennas may disagree."""
_ANGLES = ("angle", "slope", "dimensionless")
_PASSES = 6
"""The cosines follow from the sines; each pass squares what is left of their error."""


@dataclass(frozen=True)
class Antenna:
    """Place of an antenna in m: x forward and y to starboard of midship, z above the keel."""

    x: float
    y: float = 0.0
    z: float = 0.0


@dataclass(frozen=True)
class AntennaLayout:
    """What a ship carries, and which channels it is in.

    Attributes
    ----------
    length, breadth : float
        Between perpendiculars, and moulded, in m.
    antennas : mapping of str to Antenna
        Channel of the altitude (m above the datum, positive up) and the place of its antenna.
    pitch, roll : str
        Channels of the attitude, angles or slopes; what is not named follows from the antennas.
    pitch_positive : {"bow-down", "bow-up"}
    roll_positive : {"starboard-down", "port-down"}
    time, speed, position : str
        Channels of time, of the speed over ground and of the place along the fairway; the latter two may be empty.
    extra : tuple of str
        Further channels to be read along, e.g. the charted depth.
    xG : float
        Centre of gravity forward of midship in m.

    Raises
    ------
    CampaignError
        When the antennas and sensors do not tell the trim.
    """

    length: float
    breadth: float
    antennas: Mapping[str, Antenna]
    pitch: str = ""
    roll: str = ""
    pitch_positive: Literal["bow-down", "bow-up"] = "bow-down"
    roll_positive: Literal["starboard-down", "port-down"] = "starboard-down"
    time: str = "time"
    speed: str = ""
    position: str = ""
    extra: tuple[str, ...] = ()
    xG: float = 0.0

    def __post_init__(self) -> None:
        if not (self.length > 0.0 and self.breadth > 0.0):
            raise CampaignError(
                f"a ship of {self.length:g} m by {self.breadth:g} m is impossible", cure="give both in m"
            )
        if not self.antennas:
            raise CampaignError("no antenna is declared", cure="name an altitude channel and its place")
        if self.pitch_positive not in ("bow-down", "bow-up") or self.roll_positive not in (
            "starboard-down",
            "port-down",
        ):
            raise CampaignError(
                "the sense of an angle is unknown",
                cure="pitch: bow-down or bow-up; roll: starboard-down or port-down",
            )
        if np.linalg.matrix_rank(self.design) < self.design.shape[1]:
            raise CampaignError(
                f"{len(self.antennas)} antenna(s) do not tell {' and '.join(self._unknown)}",
                cure="name the attitude channels, or add antennas at other places",
            )

    @property
    def _unknown(self) -> list[str]:
        """Angles that must come from the antennas."""
        beside = any(antenna.y != 0.0 for antenna in self.antennas.values())
        return [
            name for name, channel in (("trim", self.pitch), ("heel", self.roll if beside else "-")) if not channel
        ]

    @property
    def design(self) -> np.ndarray:
        """Effect of the depth of the keel, and of each unknown angle, on the depth of the antennas."""
        places = list(self.antennas.values())
        arms = {"trim": [a.x for a in places], "heel": [a.y for a in places]}
        return np.column_stack([np.ones(len(places)), *(arms[name] for name in self._unknown)])

    @property
    def knows_heel(self) -> bool:
        """Whether the heel is measured; an antenna on the centre line alone does not feel it."""
        return bool(self.roll) or "heel" in self._unknown

    @property
    def channels(self) -> tuple[str, ...]:
        """All channels that are read, time first."""
        names = (self.time, *self.antennas, self.pitch, self.roll, self.speed, self.position, *self.extra)
        return tuple(dict.fromkeys(name for name in names if name))


@dataclass(frozen=True, eq=False)
class AntennaRecord:
    """Keel and attitude of a voyage, SI.

    Attributes
    ----------
    time : ndarray, shape (n,)
        In s.
    keel : ndarray, shape (n,)
        Depth of the keel at midship below the datum of the altitudes in m; nan where an antenna was silent.
    trim : ndarray, shape (n,)
        Slope, positive by the bow: the keel at x is ``keel + trim x`` deep.
    heel : ndarray, shape (n,), or None
        Slope, positive to starboard; None when nothing tells it.
    speed : ndarray, shape (n,), or None
        Over ground in m/s.
    position : ndarray, shape (n,), or None
        Along the fairway in m.
    layout : AntennaLayout
    misfit : float
        Root mean square in m by which the antennas move against each other; 0 when they just suffice.
    findings : tuple of Finding
        What the audit said.
    extra : mapping of str to ndarray, shape (n,)
        Further channels in SI.
    name, sha256 : str
        File and its digest.
    """

    time: np.ndarray
    keel: np.ndarray
    trim: np.ndarray
    heel: np.ndarray | None
    speed: np.ndarray | None
    position: np.ndarray | None
    layout: AntennaLayout
    misfit: float = 0.0
    findings: tuple[Finding, ...] = ()
    extra: Mapping[str, np.ndarray] = field(default_factory=dict)
    name: str = ""
    sha256: str = ""


def read_antennas(
    path: str | Path,
    layout: AntennaLayout,
    *,
    accepted: Iterable[str] = (),
    units: Mapping[str, str] | None = None,
) -> AntennaRecord:
    """Read a voyage, audit it, and bring it to the keel.

    Parameters
    ----------
    path : str or Path
    layout : AntennaLayout
    accepted : iterable of str
        Rules of :func:`audit_antennas` that are waived.
    units : mapping of str to str, optional
        Units that the file does not give or gives wrongly.

    Raises
    ------
    ReadError
        When the file or a channel cannot be read, or a unit is not that of its quantity.
    AuditError
        For the first fault that nobody accepted, named by its rule.
    """
    table = read_table(path)
    require_channels(table, layout.channels)
    table = replace(table, units={**table.units, **(units or {})})
    findings = accept([*table.findings, *audit_antennas(table, layout)], accepted)
    stop_on_error(findings)
    altitudes = np.column_stack([si_channel(table, name, ("length",)) for name in layout.antennas])
    record = keel_from_antennas(
        si_channel(table, layout.time, ("time",)),
        altitudes,
        layout,
        trim=_sine(table, layout.pitch, layout.pitch_positive == "bow-down"),
        roll=_sine(table, layout.roll, layout.roll_positive == "starboard-down"),
        speed=si_channel(table, layout.speed, ("velocity",)) if layout.speed else None,
        position=si_channel(table, layout.position, ("length",)) if layout.position else None,
    )
    if record.misfit > LARGEST_MISFIT:
        disagreement = Finding(
            "antennas-disagree",
            "error",
            f"the altitudes move against one rigid ship by {record.misfit:.2f} m",
            table.path,
            "antennas",
            "check the places of the antennas, the signs of the angles and the units",
        )
        findings = [*findings, *accept([disagreement], accepted)]
        stop_on_error(findings)
    extra = {name: si_channel(table, name) for name in layout.extra}
    return replace(record, findings=tuple(findings), extra=extra, name=table.path, sha256=table.sha256)


def keel_from_antennas(
    time: np.ndarray,
    altitudes: np.ndarray,
    layout: AntennaLayout,
    *,
    trim: np.ndarray | None = None,
    roll: np.ndarray | None = None,
    speed: np.ndarray | None = None,
    position: np.ndarray | None = None,
) -> AntennaRecord:
    """Depth of the keel, trim and heel from altitudes and, where measured, the attitude.

    Parameters
    ----------
    time : ndarray, shape (n,)
        In s.
    altitudes : ndarray, shape (n, k)
        Of the antennas in the order of the layout, m above the datum.
    layout : AntennaLayout
    trim : ndarray, shape (n,), optional
        Sine of the trim angle, positive by the bow, as far as the layout names a pitch sensor.
    roll : ndarray, shape (n,), optional
        Sine of the roll angle, positive to starboard, as far as the layout names a roll sensor.
    speed : ndarray, shape (n,), optional
        Over ground in m/s.
    position : ndarray, shape (n,), optional
        Along the fairway in m.

    Notes
    -----
    An antenna at (x, y, z) is ``keel + x sin(trim) + y cos(trim) sin(roll) - z cos(trim) cos(roll)`` deep. Unknown
    angles are found by least squares, the cosines of the last pass being kept in the next.
    """
    places = np.array([(a.x, a.y, a.z) for a in layout.antennas.values()], dtype=float)
    depth = -np.asarray(altitudes, dtype=float)
    solve = np.linalg.pinv(layout.design)
    n = depth.shape[0]
    slope = np.zeros(n) if trim is None else np.asarray(trim, dtype=float)
    sine = np.zeros(n) if roll is None else np.asarray(roll, dtype=float)
    unknown_trim, unknown_heel = trim is None, roll is None and layout.knows_heel
    for _ in range(_PASSES):
        flat = np.sqrt(1.0 - slope**2)
        heel = flat * sine
        upright = flat * np.sqrt(1.0 - sine**2)
        left = depth + upright[:, None] * places[:, 2]
        if not unknown_trim:
            left = left - slope[:, None] * places[:, 0]
        if not unknown_heel:
            left = left - heel[:, None] * places[:, 1]
        found = left @ solve.T
        if not (unknown_trim or unknown_heel):
            break
        if unknown_trim:
            slope = found[:, 1]
        if unknown_heel:
            sine = found[:, -1] / np.sqrt(1.0 - slope**2)
    spare = places.shape[0] > layout.design.shape[1]
    rest = left - found @ layout.design.T
    # What a gyro mounted askew or a mast measured wrongly adds is the same at rest, and leaves with the reference.
    rest = rest[np.isfinite(rest).all(axis=1)]
    misfit = float(np.sqrt(np.mean((rest - rest.mean(axis=0)) ** 2))) if spare and rest.size else 0.0
    heel_slope = np.sqrt(1.0 - slope**2) * sine if layout.knows_heel else None
    return AntennaRecord(
        np.asarray(time, dtype=float), found[:, 0], slope, heel_slope, speed, position, layout, misfit
    )


def audit_antennas(table: RawTable, layout: AntennaLayout) -> list[Finding]:
    """Faults of a file of altitudes and attitude.

    Rules: those of the heading, ``too-short``, ``time-not-increasing``, ``gap`` (a warning: the parts beside it
    count), ``all-missing``, ``missing-values`` (a warning but for the time), ``constant-channel``,
    ``angle-in-degrees``, ``no-unit``.
    """
    found = [*heading_findings(table), *time_findings(table, layout.time, gaps="warning")]
    if len(table) < FEWEST_SAMPLES:
        return found
    sensors = {*layout.antennas, layout.pitch, layout.roll}
    for name in layout.channels[1:]:
        found.extend(value_findings(table, name, varies=name in sensors, holes="warning"))
        place, unit = f"channel {name}", table.units.get(name, "")
        if not unit:
            found.append(
                Finding("no-unit", "warning", "has no unit; taken as SI", table.path, place, "declare the unit")
            )
        if name in (layout.pitch, layout.roll):
            size = float(np.nanmax(np.abs(si_channel(table, name, _ANGLES)), initial=0.0))
            if size > LARGEST_ANGLE:
                message = f"reaches {size:.3g} rad: no ship lies like that"
                cure = "declare the unit (deg for rad?)"
                found.append(Finding("angle-in-degrees", "error", message, table.path, place, cure))
    return found


def _sine(table: RawTable, name: str, positive: bool) -> np.ndarray | None:
    """Sine of an angle in the sign of the house; None where no sensor is named."""
    if not name:
        return None
    values = si_channel(table, name, _ANGLES)
    unit = table.units.get(name, "")
    is_slope = unit != "" and conversion(unit).dimension != "angle"
    sine = np.sin(np.arctan(values) if is_slope else values)
    return sine if positive else -sine
