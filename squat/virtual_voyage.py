"""A made voyage of a container ship, for trying the full-scale reduction: every error that it must take out is known.

The ship lies at the berth for 400 s, gathers way to 9 m/s, leaves brackish water for the sea while the tide falls, and
heels in a turn; short swell moves it. Its antennas carry the noise of satellites, and its gyro is mounted askew.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .rtk_antennas import Antenna, AntennaLayout
from .tide import TideTable

LENGTH, BREADTH, DRAUGHT = 350.0, 51.2, 14.1
VOLUME, WATERPLANE_AREA = 172_000.0, 14_500.0
RHO_BERTH, RHO_SEA = 1005.0, 1025.0
ANTENNAS = {
    "Z_port": Antenna(60.0, -25.0, 52.0),
    "Z_starboard": Antenna(60.0, 25.0, 52.0),
    "Z_bow": Antenna(150.0, 0.0, 30.0),
}
CHARTED_DEPTH = 16.0
BERTH = (0.0, 400.0)
"""Times in s between which the ship lies still."""

_UNITS = {"time": "s", **dict.fromkeys(ANTENNAS, "m"), "pitch": "deg", "roll": "deg", "sog": "m/s"}
_MORE_UNITS = {"rho": "kg/m3", "depth": "m"}
_STATIC = 0.0004, 0.002
_ASKEW = np.radians([0.09, -0.23])
_SWELL_PERIOD = 12.0


@dataclass(frozen=True, eq=False)
class VirtualVoyage:
    """Channels of the voyage and the truth behind them.

    Attributes
    ----------
    channels : dict of str to ndarray, shape (n,)
        As the file has them: altitudes in m, pitch (bow up) and roll (port down) in deg, speed over ground in m/s.
    sinkage, density : ndarray, shape (n,)
        Sinkage at midship by squat and by density in m, positive down.
    trim, heel : ndarray, shape (n,)
        Slopes beyond those at rest, positive by the bow and to starboard.
    speed, current, rho : ndarray, shape (n,)
        Through the water and along the ship in m/s; kg/m3.
    """

    channels: dict[str, np.ndarray]
    sinkage: np.ndarray
    density: np.ndarray
    trim: np.ndarray
    heel: np.ndarray
    speed: np.ndarray
    current: np.ndarray
    rho: np.ndarray

    def write(self, path: str | Path) -> Path:
        """The channels as a text file with a row of units."""
        return _write(Path(path), self.channels, _UNITS)

    def write_folder(self, folder: str | Path) -> Path:
        """Record, tide, current and voyage file, ready to be reduced; the path of the voyage file."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        more = {"rho": self.rho, "depth": np.full(self.rho.shape, CHARTED_DEPTH)}
        _write(place / "voyage.csv", {**self.channels, **more}, {**_UNITS, **_MORE_UNITS})
        tide = virtual_tide()
        _write(place / "tide.csv", {"time": tide.time, "level": tide.values}, {"time": "s", "level": "m"})
        time = self.channels["time"]
        current = {"time": time, "current": self.current}
        _write(place / "current.csv", current, {"time": "s", "current": "m/s"})
        file = place / "voyage.toml"
        file.write_text(_FILE.format(antennas="\n".join(_antenna_sections())), encoding="utf-8")
        return file


def _write(file: Path, channels: dict[str, np.ndarray], units: dict[str, str]) -> Path:
    heading = [",".join(channels), ",".join(units[name] for name in channels)]
    lines = [",".join(f"{value:.6f}" for value in row) for row in np.column_stack(list(channels.values()))]
    file.write_text("\n".join([*heading, *lines]) + "\n", encoding="utf-8")
    return file


def _antenna_sections() -> list[str]:
    return [f"[antennas.{name}]\nx = {a.x}\ny = {a.y}\nz = {a.z}\n" for name, a in ANTENNAS.items()]


_FILE = f"""[voyage]
name = "virtual voyage of a container ship"
source = "made: every error that the reduction takes out is known"
virtual = true

[ship]
name = "container ship"
L = {LENGTH}
B = {BREADTH}
T = {DRAUGHT}
volume = {VOLUME}
rho = {RHO_BERTH}

{{antennas}}
[sensors]
pitch = "pitch"
roll = "roll"
speed = "sog"
pitch_positive = "bow-up"
roll_positive = "port-down"

[tide]
file = "tide.csv"

[current]
file = "current.csv"

[static]
start = {BERTH[0]}
stop = {BERTH[1]}

[density]
berth = {RHO_BERTH}
column = "rho"
waterplane_area = {WATERPLANE_AREA}

[bottom]
column = "depth"
uncertainty = 0.1

[draught]
forward = {DRAUGHT + 0.07}
aft = {DRAUGHT - 0.07}
uncertainty = 0.03

[[records]]
file = "voyage.csv"
name = "outbound"
"""


def virtual_layout(*, gyro: bool = True) -> AntennaLayout:
    """What the ship carries; without the gyro its three antennas tell trim and heel."""
    return AntennaLayout(
        LENGTH,
        BREADTH,
        ANTENNAS,
        pitch="pitch" if gyro else "",
        roll="roll" if gyro else "",
        pitch_positive="bow-up",
        roll_positive="port-down",
        speed="sog",
    )


def virtual_tide() -> TideTable:
    """Water level along the voyage, an entry every ten minutes."""
    time = np.arange(0.0, 3000.0, 600.0)
    return TideTable(time, 2.5 - 4e-4 * time)


def virtual_voyage(*, step: float = 0.5, noise: float = 0.01, seed: int = 3) -> VirtualVoyage:
    """Make the voyage.

    Parameters
    ----------
    step : float
        Sampling interval in s.
    noise : float
        Standard deviation of each altitude in m.
    seed : int
        Of the noise.
    """
    time = np.arange(0.0, 2400.0, step)
    way = np.clip((time - 500.0) / 600.0, 0.0, 1.0)
    speed, current = 9.0 * way, 0.8 * way
    swell = 2.0 * np.pi * time / _SWELL_PERIOD
    sinkage = 0.012 * speed**2 + 0.05 * way * np.sin(swell)
    trim = 4e-5 * speed + 1e-4 * way * np.cos(swell)
    heel = 0.04 * np.exp(-(((time - 1500.0) / 120.0) ** 2))
    rho = RHO_BERTH + (RHO_SEA - RHO_BERTH) * np.clip((time - 800.0) / 1200.0, 0.0, 1.0)
    density = VOLUME / WATERPLANE_AREA * (RHO_BERTH / rho - 1.0)
    along = trim + _STATIC[0]
    flat = np.sqrt(1.0 - along**2)
    across = heel + _STATIC[1]
    upright = np.sqrt(1.0 - along**2 - across**2)
    keel = DRAUGHT + sinkage + density - virtual_tide().at(time)
    rng = np.random.default_rng(seed)
    channels = {"time": time}
    for name, place in ANTENNAS.items():
        down = keel + place.x * along + place.y * across - place.z * upright
        channels[name] = -down + noise * rng.standard_normal(time.size)
    channels["pitch"] = -np.degrees(np.arcsin(along) + _ASKEW[0])
    channels["roll"] = -np.degrees(np.arcsin(across / flat) + _ASKEW[1])
    channels["sog"] = speed + current
    return VirtualVoyage(channels, sinkage, density, trim, heel, speed, current, rho)
