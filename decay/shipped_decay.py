"""The decay campaign that comes with the package: a virtual roll decay of a tanker, labelled as virtual."""

from __future__ import annotations

import json
from pathlib import Path

from ..formats.write import atomic_path
from .virtual_decay import demo_plan, virtual_decay

DEMO = "virtual-roll-decay"

_TEXT = """\
# A virtual roll decay: simulated with the coefficients under truth, pushed by hand, with noise and drift.
# Try restoring = "linear", other models, or less of the record: [reduction] last_amplitude = 3.0 (degrees).

[decay]
name = "Virtual tanker 1:68, roll decay"
notes = "{notes}"
virtual = true
truth = {truth}

[ship]
{ship}

[ikeda]
midship_coefficient = 0.99

[channels]
time = "time"
angle = "phi"
unit = "deg"

[[records]]
file = "roll_decay.csv"
name = "roll decay"
scale = {scale:g}

[fit]
models = ["linear+quadratic"]
restoring = "auto"
methods = ["all"]
"""


def write_decay_campaign(folder: str | Path) -> Path:
    """Write record and campaign file of the shipped virtual decay; returns the campaign file."""
    plan = demo_plan()
    made = virtual_decay(plan)
    assert plan.ship is not None
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with atomic_path(folder / "roll_decay.csv") as temporary:
        made.to_frame().to_csv(temporary, index=False, float_format="%.6f")
    noise = "white noise 0.03 deg and AR(1) noise 0.05 deg"
    truth = ", ".join(f"{name} = {value:g}" for name, value in made.truth.items())
    text = _TEXT.format(
        notes=f"{plan.pushes} pushes by hand, release, {plan.cycles:g} cycles; {noise}; seed {plan.seed}.",
        truth=f"{{ {truth} }}",
        ship="\n".join(f"{key} = {json.dumps(value)}" for key, value in plan.ship.to_dict().items()),
        scale=plan.scale,
    )
    path = folder / "campaign.toml"
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path
