"""The kinds of captive tests, and what each must say about itself."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path

from ..core.errors import CampaignError


@dataclass(frozen=True)
class RunType:
    """One kind of captive test.

    Attributes
    ----------
    name : str
    harmonic : bool
        True for oscillating tests.
    required : tuple of str
        Parameters of :class:`Run` that the test matrix must give.
    meaning : str
    """

    name: str
    harmonic: bool
    required: tuple[str, ...]
    meaning: str


_ALL = (
    RunType("static_drift", False, ("speed", "drift_angle"), "oblique towing (OTT)"),
    RunType("static_rudder", False, ("speed", "rudder_angle"), "straight towing with rudder angle"),
    RunType("drift_rudder", False, ("speed", "drift_angle", "rudder_angle"), "oblique towing with rudder"),
    RunType("static_heel", False, ("speed", "heel"), "straight towing at a heel angle"),
    RunType("steady_yaw", False, ("speed", "yaw_rate"), "circular motion (CMT) or rotating arm"),
    RunType("steady_yaw_drift", False, ("speed", "yaw_rate", "drift_angle"), "circular motion with drift"),
    RunType("pure_sway", True, ("speed", "frequency", "sway_amplitude"), "sway oscillation, heading fixed"),
    RunType("pure_yaw", True, ("speed", "frequency", "sway_amplitude"), "yaw oscillation along the path"),
    RunType(
        "yaw_drift",
        True,
        ("speed", "frequency", "sway_amplitude", "drift_angle"),
        "yaw oscillation along the path with constant drift",
    ),
    RunType(
        "sway_yaw",
        True,
        ("speed", "frequency", "sway_amplitude", "yaw_amplitude"),
        "combined sway and yaw oscillation with any phase between them",
    ),
    RunType("pure_surge", True, ("speed", "frequency", "surge_amplitude"), "surge oscillation"),
    RunType("dry_sway", True, ("frequency", "sway_amplitude"), "sway oscillation in air, for the inertia"),
    RunType("dry_yaw", True, ("frequency", "yaw_amplitude"), "yaw oscillation in air, for the inertia"),
    RunType("dry_surge", True, ("frequency", "surge_amplitude"), "surge oscillation in air, for the inertia"),
)

RUN_TYPES: dict[str, RunType] = {kind.name: kind for kind in _ALL}

ANGLES = ("drift_angle", "rudder_angle", "heel", "yaw_amplitude", "sway_phase", "yaw_phase")
"""Parameters of a run that are angles and follow the campaign's angle unit."""


@dataclass(frozen=True)
class Run:
    """One run of a test matrix, in SI, radians and home signs.

    Attributes
    ----------
    name : str
        Name in tables; the file's stem when there is a file.
    kind : str
        Key of :data:`RUN_TYPES`.
    speed : float
        Carriage speed in m/s; for circular motion the speed along the path.
    drift_angle : float
        atan(-v/u) in rad at the reference point of the motion.
    yaw_rate : float
        Steady yaw rate in rad/s.
    rudder_angle : float
        In rad, positive when it turns the ship to starboard.
    heel : float
        In rad, positive with starboard side down.
    bank_position : float
        Lateral deviation towards a bank to starboard in m.
    frequency : float
        Circular frequency of oscillation in rad/s.
    sway_amplitude, surge_amplitude : float
        In m: y = y_a sin(w t + sway_phase), x = U t + x_a sin(w t).
    yaw_amplitude : float
        In rad: psi = psi_a cos(w t + yaw_phase); for runs along the path the heading follows the path instead.
    sway_phase, yaw_phase : float
        In rad.
    depth : float or None
        Water depth in m where it differs from the ship's.
    propeller_rate : float
        In 1/s.
    file : Path or None
    tare : str
        Name of the zero run that is subtracted; empty for none.
    series : str
        Free label of the series.
    """

    name: str
    kind: str
    speed: float = 0.0
    drift_angle: float = 0.0
    yaw_rate: float = 0.0
    rudder_angle: float = 0.0
    heel: float = 0.0
    bank_position: float = 0.0
    frequency: float = 0.0
    sway_amplitude: float = 0.0
    surge_amplitude: float = 0.0
    yaw_amplitude: float = 0.0
    sway_phase: float = 0.0
    yaw_phase: float = 0.0
    depth: float | None = None
    propeller_rate: float = 0.0
    file: Path | None = None
    tare: str = ""
    series: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        kind = run_type(self.kind, self.name)
        if self.speed <= 0 and not self.kind.startswith("dry_"):
            raise CampaignError(f"speed {self.speed} m/s is not positive", place=f"run '{self.name}'")
        if kind.harmonic and self.frequency <= 0:
            raise CampaignError(
                f"a {self.kind} run needs a frequency", cure="give it in rad/s", place=f"run '{self.name}'"
            )
        if kind.harmonic and not (self.sway_amplitude or self.yaw_amplitude or self.surge_amplitude):
            raise CampaignError(
                f"a {self.kind} run needs an amplitude",
                cure=f"give {', '.join(kind.required)}",
                place=f"run '{self.name}'",
            )

    @property
    def harmonic(self) -> bool:
        """True for oscillating runs."""
        return RUN_TYPES[self.kind].harmonic

    @property
    def dry(self) -> bool:
        """True for runs in air."""
        return self.kind.startswith("dry_")

    @property
    def period(self) -> float:
        """Period of oscillation in s."""
        return 6.283185307179586 / self.frequency


RUN_PARAMETERS: tuple[str, ...] = tuple(
    item.name for item in fields(Run) if item.name not in ("name", "kind", "file")
)


def run_type(kind: str, run: str = "") -> RunType:
    """The run type of that name.

    Raises
    ------
    CampaignError
        For an unknown name.
    """
    try:
        return RUN_TYPES[kind]
    except KeyError:
        raise CampaignError(
            f"'{kind}' is not a run type",
            cure=f"use one of {', '.join(RUN_TYPES)}",
            place=f"run '{run}'" if run else "",
        ) from None
