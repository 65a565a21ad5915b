"""The squat campaign that comes with the package: virtual sinkage records of a container ship, labelled as virtual."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..formats.write import atomic_path
from .virtual_squat import DEMO_CODES, KNOT, VirtualWave, demo_squat

if TYPE_CHECKING:
    import pandas as pd

DEMO = "virtual-squat"

_SPEEDS = {
    "06kn": 6.0,
    "08kn": 8.0,
    "10kn": 10.0,
    "12kn": 12.0,
    "12kn_again": 12.0,
    "12kn_third": 12.0,
    "14kn": 14.0,
}
_WAVE = VirtualWave(omega=6.8, bow=(2.1e-3, 0.9), stern=(1.6e-3, -0.7))
_COMPUTED = np.linspace(5.0, 14.5, 8)

_TEXT = """\
# Virtual sinkage records: made with the coefficients under truth (c of c Fh^2/sqrt(1 - Fh^2) in m, trim in m/m).
# Try [window] rule = "mser", or depth = 0.18: the curve and the formulas change.

[squat]
name = "Virtual container ship 1:80, h/T = 1.5"
notes = "{notes}"
scale = {scale:g}
virtual = true
truth = {truth}

[ship]
{ship}

[fairway]
depth = {depth:g}

[channels]
time = "time"
speed = "speed"
bow = "bow"
stern = "stern"

[window]
rule = "fraction"
begin = 0.30
end = 0.95

{records}
"""


def write_squat_campaign(folder: str | Path) -> Path:
    """Write records, computed curves and campaign file of the shipped virtual squat; returns the campaign file."""
    plan = demo_squat()
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    root = float(np.sqrt(plan.ship.scale))
    entries = []
    for number, (name, knots) in enumerate(_SPEEDS.items()):
        _write(plan.make(knots * KNOT / root, number), folder / f"run_{name}.csv")
        entries.append(f'[[records]]\nfile = "run_{name}.csv"\n')
    _write(plan.make(10.0 * KNOT / root, len(_SPEEDS), _WAVE), folder / "run_10kn_waves.csv")
    entries.append('[[records]]\nfile = "run_10kn_waves.csv"\nwaves = true\nstart = 20.0\nstop = 55.0\n')
    for name, code in DEMO_CODES.items():
        _write(code.table(plan, _COMPUTED * KNOT / root), folder / f"{name}.csv")
    truth = ", ".join(f"{name} = {value:.6g}" for name, value in plan.truth.items())
    text = _TEXT.format(
        notes=f"Sensor noise {1e3 * plan.noise:g} mm with a memory of {plan.memory:g} s, "
        f"{1e3 * plan.between_runs:g} mm between runs; 12 kn three times, 10 kn in waves too; seed {plan.seed}.",
        scale=plan.ship.scale,
        truth=f"{{ {truth} }}",
        ship="\n".join(f"{key} = {json.dumps(value)}" for key, value in plan.ship.at_scale(1.0).to_dict().items()),
        depth=plan.depth,
        records="\n".join(entries).strip(),
    )
    path = folder / "campaign.toml"
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path


def computed_files(campaign: Path) -> list[Path]:
    """The virtual computations beside the campaign file."""
    return [campaign.parent / f"{name}.csv" for name in DEMO_CODES]


def _write(frame: pd.DataFrame, path: Path) -> None:
    with atomic_path(path) as temporary:
        frame.to_csv(temporary, index=False, float_format="%.7g")
