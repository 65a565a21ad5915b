"""Test programmes of the literature as ready-made test matrices, and test matrices as tables.

A programme is kept in the SI values of the model that it was made for. For another ship it is scaled to equal
drift angle, r', omega' and amplitude over length; the speed follows Froude's law unless it is given.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.conventions import HOME, Conventions
from ..core.errors import CampaignError
from ..core.ship import Ship
from .campaign_file import RunGroup
from .run_matrix import expand_runs
from .run_types import ANGLES, RUN_PARAMETERS, Run, run_type

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class StandardMatrix:
    """A test programme.

    Attributes
    ----------
    meaning : str
        What it is and where it is printed; what is not printed there is said.
    length, speed : float
        Length in m of the model that it was made for, and the speed in m/s that it is scaled by.
    runs : callable
        Runs of that model; takes the depth-to-draught ratios' draught in m.
    """

    meaning: str
    length: float
    speed: float
    runs: Callable[[float], list[Run]]


def standard_matrix(kind: str, ship: Ship, speed: float | None = None) -> list[Run]:
    """Test matrix of a standard programme for a ship.

    Parameters
    ----------
    kind : str
        Key of :data:`STANDARD_MATRICES`.
    ship : Ship
        Gives the length, and the draught for programmes with several depths.
    speed : float, optional
        Speed in m/s that takes the place of the programme's main speed; by Froude's law when not given.

    Returns
    -------
    list of Run

    Raises
    ------
    CampaignError
        For an unknown name.
    """
    try:
        programme = STANDARD_MATRICES[kind]
    except KeyError:
        raise CampaignError(
            f"'{kind}' is not a standard test matrix", cure=f"use one of {', '.join(STANDARD_MATRICES)}"
        ) from None
    length = ship.L / programme.length
    pace = math.sqrt(length) if speed is None else speed / programme.speed
    return [
        replace(
            run,
            speed=run.speed * pace,
            yaw_rate=run.yaw_rate * pace / length,
            frequency=run.frequency * pace / length,
            sway_amplitude=run.sway_amplitude * length,
            surge_amplitude=run.surge_amplitude * length,
            bank_position=run.bank_position * length,
        )
        for run in programme.runs(ship.T)
    ]


def static_drift(angles: Sequence[float], speed: float) -> list[Run]:
    """Oblique towing at drift angles in degrees."""
    return [
        Run(f"drift {angle:+g} deg", "static_drift", speed, drift_angle=math.radians(angle)) for angle in angles
    ]


def circular(angles: Sequence[float], rates: Sequence[float], speed: float, length: float) -> list[Run]:
    """Circular motion at drift angles in degrees and non-dimensional yaw rates; oblique towing where r' = 0."""
    runs = []
    for rate in rates:
        if rate == 0:
            runs += static_drift(angles, speed)
            continue
        for angle in angles:
            kind = "steady_yaw_drift" if angle else "steady_yaw"
            name = f"yaw r' {rate:+g}" + (f" drift {angle:+g} deg" if angle else "")
            yaw = rate * speed / length
            runs.append(Run(name, kind, speed, drift_angle=math.radians(angle), yaw_rate=yaw))
    return runs


def pure_sway(velocities: Sequence[float], frequency: float, speed: float) -> list[Run]:
    """Sway oscillations with maximum sway velocities in m/s."""
    return [
        Run(f"sway v {v:g} m/s", "pure_sway", speed, frequency=frequency, sway_amplitude=v / frequency)
        for v in velocities
    ]


def pure_yaw(rates: Sequence[float], frequency: float, speed: float, drift: Sequence[float] = (0.0,)) -> list[Run]:
    """Yaw oscillations along the path with maximum yaw rates in rad/s, and drift angles in degrees.

    On the path y = y_a sin(w t) the largest yaw rate is y_a w^2 / U.
    """
    runs = []
    for angle in drift:
        for rate in rates:
            amplitude = rate * speed / frequency**2
            name = f"yaw r {rate:g} rad/s" + (f" drift {angle:+g} deg" if angle else "")
            kind = "yaw_drift" if angle else "pure_yaw"
            runs.append(
                Run(
                    name,
                    kind,
                    speed,
                    drift_angle=math.radians(angle),
                    frequency=frequency,
                    sway_amplitude=amplitude,
                )
            )
    return runs


def _dtmb5512(draught: float) -> list[Run]:
    speed = 1.5311
    steps = (2, 6, 9, 10, 11, 12, 16, 20)
    return [
        *static_drift([*(-step for step in reversed(steps)), 0, *steps], speed),
        *pure_sway((0.053, 0.107, 0.266), 0.841, speed),
        *pure_yaw((0.025, 0.075, 0.150), 0.841, speed),
        *pure_yaw((0.225, 0.300, 0.375), 1.08, speed),
        *pure_yaw((0.150,), 0.841, speed, (-10.0, -5.0, 5.0, 10.0)),
        *pure_yaw((0.300,), 1.08, speed, (-10.0, -5.0, 5.0, 10.0)),
    ]


def _dtc(draught: float) -> list[Run]:
    length, speed = 3.55, 0.3086
    omega = 2.5 * speed / length

    def yaw(name: str, amplitude: float, drift: float = 0.0) -> Run:
        return Run(
            name,
            "yaw_drift" if drift else "pure_yaw",
            speed,
            drift_angle=math.radians(drift),
            frequency=omega,
            sway_amplitude=amplitude * length,
        )

    pure = [
        yaw(f"yaw r' {rate:g}", amplitude) for rate, amplitude in ((0.25, 0.040), (0.30, 0.048), (0.35, 0.056))
    ]
    coupled = [yaw(f"yaw r' 0.2 drift {angle:+g} deg", 0.032, angle) for angle in (0, 2, 4, 6, 8, 12)]
    return [*static_drift((12, 9, 6, 3, 0), speed), *pure, *coupled]


def _pcc(draught: float) -> list[Run]:
    runs = []
    for heel in (0, 5, 10):
        for run in circular(range(-20, 21, 5), [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3], 0.651, 2.0):
            runs.append(replace(run, name=f"heel {heel} deg {run.name}", heel=math.radians(heel)))
    return runs


def _pcc_bank(draught: float) -> list[Run]:
    places = [(angle, eta) for eta in (0.09, 0.18, 0.27) for angle in range(-10, 11, 5)]
    places += [(0, 0.31), (0, 0.36)]
    return [
        replace(
            static_drift([angle], 0.325)[0], name=f"bank {eta:g} L drift {angle:+d} deg", bank_position=2.0 * eta
        )
        for angle, eta in places
    ]


def _inland(draught: float) -> list[Run]:
    # Drift angles of the paper are atan(v/u), ours atan(-v/u).
    speed, length = 3.5, 110.0
    rates = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    small = static_drift([-float(angle) if angle else 0.0 for angle in range(0, 21, 2)], speed)
    return [*small, *circular((0, 10, 20), rates, speed, length)]


def _kcs_depths(draught: float) -> list[Run]:
    runs = []
    for ratio in (1.2, 1.5, 2.0, 32.0):
        speed = 1.4 if ratio > 3 else 0.55
        for name, kind, omega, drift in (
            ("pure sway", "pure_sway", 0.628, 0.0),
            ("pure yaw", "pure_yaw", 0.785, 0.0),
            ("yaw drift +3 deg", "yaw_drift", 0.785, math.radians(3)),
        ):
            runs.append(
                Run(
                    f"h/T {ratio:g} {name}",
                    kind,
                    speed,
                    drift_angle=drift,
                    frequency=omega,
                    sway_amplitude=0.3,
                    depth=ratio * draught,
                )
            )
    return runs


def _cmt(draught: float) -> list[Run]:
    return circular((-20, -15, -10, -5, 0, 5, 10, 15, 20), [0, 0.2, 0.4, 0.6, 0.8], 1.0, 1.0)


def _general(draught: float) -> list[Run]:
    speed, omega = 1.0, 2.0
    phases = [
        Run(
            f"sway-yaw phase {phase} deg",
            "sway_yaw",
            speed,
            frequency=omega,
            sway_amplitude=0.08,
            yaw_amplitude=0.2,
            sway_phase=math.radians(phase),
        )
        for phase in (0, 90, 180)
    ]
    surge = [Run(f"surge {a:g} L", "pure_surge", speed, frequency=omega, surge_amplitude=a) for a in (0.03, 0.06)]
    return [
        *static_drift((-16, -12, -8, -4, 0, 4, 8, 12, 16), speed),
        *pure_sway((0.05, 0.12, 0.2), omega, speed),
        *pure_yaw((0.15, 0.3, 0.45, 0.6), omega, speed),
        *pure_yaw((0.2, 0.4), omega, speed, (-12.0, -6.0, 6.0, 12.0)),
        *phases,
        *surge,
    ]


STANDARD_MATRICES: dict[str, StandardMatrix] = {
    "dtmb5512": StandardMatrix(
        "IIHR programme for DTMB 5512 at Fn 0.28 (virtual captive tests of DTMB 5512, Tables 10 and 11): static "
        "drift, pure sway, pure yaw; yaw with drift of 5 and 10 deg to both sides is added by this package",
        3.048,
        1.5311,
        _dtmb5512,
    ),
    "dtc-cfd": StandardMatrix(
        "virtual captive tests of the Duisburg Test Case 1:100 (MASHCON 2019, Table 2): static drift, pure yaw, "
        "yaw with drift",
        3.55,
        0.3086,
        _dtc,
    ),
    "pcc": StandardMatrix(
        "pure car carrier (MASHCON 2019): circular motion at 9 drift angles x 7 yaw rates x 3 heel angles",
        2.0,
        0.651,
        _pcc,
    ),
    "pcc-bank": StandardMatrix(
        "pure car carrier near a bank (MASHCON 2019): static drift at three distances, straight at two more",
        2.0,
        0.325,
        _pcc_bank,
    ),
    "inland": StandardMatrix(
        "virtual captive matrix for inland ships (MASHCON 2019, Table 3, series 1, 3, 4 and 5)",
        110.0,
        3.5,
        _inland,
    ),
    "kcs-depths": StandardMatrix(
        "KCS 1:75.5 in four depths (MASHCON 2019): pure sway, pure yaw, yaw with 3 deg of drift; too few runs for "
        "a complete cubic model at one depth",
        3.0464,
        1.4,
        _kcs_depths,
    ),
    "cmt": StandardMatrix(
        "circular motion tests of 9 drift angles x 5 yaw rates up to r' = 0.8 (of this package)", 1.0, 1.0, _cmt
    ),
    "general": StandardMatrix(
        "planar motion mechanism programme that separates every term of the MMG and the Abkowitz model (of this "
        "package): static drift, pure sway, pure yaw, yaw with drift, sway and yaw combined, surge",
        1.0,
        1.0,
        _general,
    ),
}
"""Ready-made test matrices by name."""


def matrix_frame(runs: Sequence[Run], conventions: Conventions = HOME) -> pd.DataFrame:
    """Test matrix as a table, in the angle unit and the signs of `conventions`.

    Returns
    -------
    DataFrame
        Columns ``name``, ``type`` and each parameter that some run has; empty cells where it does not apply.
    """
    import pandas as pd

    sides = -1.0 if conventions.axes == "forward-port-up" else 1.0
    sign = dict.fromkeys(("drift_angle", "yaw_rate", "sway_amplitude", "yaw_amplitude"), sides)
    sign["drift_angle"] *= -1.0 if conventions.drift_sign == "+v" else 1.0
    sign["rudder_angle"] = -1.0 if conventions.rudder_sign == "port" else 1.0
    rows = []
    for run in runs:
        row: dict[str, object] = {"name": run.name, "type": run.kind}
        needed = run_type(run.kind).required
        for key in RUN_PARAMETERS:
            value = getattr(run, key)
            if isinstance(value, str):
                row[key] = value or None
            elif value is not None and (value or key in needed):
                value = math.degrees(value) if key in ANGLES and conventions.angle_unit == "deg" else value
                row[key] = sign.get(key, 1.0) * value + 0.0
        rows.append(row)
    frame = pd.DataFrame(rows, columns=["name", "type", *RUN_PARAMETERS])
    return frame.dropna(axis="columns", how="all")


def matrix_from_csv(path: str | Path, conventions: Conventions = HOME) -> list[Run]:
    """Runs of a test matrix, a table with the columns of a campaign's matrix.

    Parameters
    ----------
    path : str or Path
        Columns ``name`` (or ``file``), ``type`` and one a parameter of :class:`Run`.
    conventions : Conventions
        Give the unit of angles and the signs of drift and rudder in the table.

    Raises
    ------
    CampaignError
        For a missing file, or a parameter that is missing or unknown, with its row.
    """
    path = Path(path)
    if not path.is_file():
        raise CampaignError("test matrix not found", cure="give the path of a table of runs", file=path)
    runs = expand_runs([RunGroup(matrix=path.name)], path.parent, conventions, path)
    return [replace(run, file=None) for run in runs]
