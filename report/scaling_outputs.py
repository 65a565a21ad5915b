"""The folder of results of a model held against its ship, and what a terminal shows of it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from ..core.provenance import program_versions
from ..squat.code_scores import plain_rows
from ..squat.scaling_error import ScalingErrors
from ..squat.tabled_curve import TabledCurve
from .aligned_text import aligned_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

SCALING_FORMAT = "towtank scaling provenance 1"
SCALING_SIGNS = "error: ship less model by Froude's law; sinkage positive down, trim by the bow"


@dataclass(frozen=True, eq=False)
class Scaling:
    """A model's curve held against the ship's.

    Attributes
    ----------
    model, ship : TabledCurve
    errors : ScalingErrors
    """

    model: TabledCurve
    ship: TabledCurve
    errors: ScalingErrors

    def to_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return {
            "format": "towtank scaling 1",
            "signs": SCALING_SIGNS,
            "scale": self.model.curve.scale,
            "depth": self.ship.curve.depth,
            "draught": self.ship.curve.draught,
            "outside": self.errors.outside,
            "errors": plain_rows(self.errors.frame),
            "clearance": plain_rows(self.errors.clearance),
            "findings": [vars(item) for item in (*self.model.findings, *self.ship.findings)],
        }


def require_scaling_folder(out: str | Path) -> None:
    """Refuse a place that cannot take scaling errors, before anything is computed.

    Raises
    ------
    TowtankError
        When `out` is a file, or holds results of another kind.
    """
    require_folder(Path(out), SCALING_FORMAT)


def write_scaling(scaling: Scaling, out: str | Path, *, progress: Progress | None = None) -> list[Path]:
    """Write ``scaling_errors.csv``, ``scaling_clearance.csv``, ``scaling.json`` and the provenance.

    Parameters
    ----------
    scaling : Scaling
    out : str or Path
        Folder of the results; made when it is missing.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("scaling_errors.csv", csv_writer(lambda: scaling.errors.frame)),
        ("scaling.json", lambda path: write_json(scaling.to_dict(), path)),
    ]
    if not scaling.errors.clearance.empty:
        writers.insert(1, ("scaling_clearance.csv", csv_writer(lambda: scaling.errors.clearance)))
    return write_folder(Path(out), writers, scaling_provenance(scaling), progress)


def scaling_provenance(scaling: Scaling, created: datetime | None = None) -> dict[str, Any]:
    """Files, scale, water, versions, as plain data."""
    return {
        "format": SCALING_FORMAT,
        "created": timestamp(created),
        "versions": program_versions(),
        "signs": SCALING_SIGNS,
        "scale": scaling.model.curve.scale,
        "depth": scaling.ship.curve.depth,
        "draught": scaling.ship.curve.draught,
        "inputs": {one.path: one.sha256 for one in (scaling.model, scaling.ship)},
        "findings": [vars(item) for item in (*scaling.model.findings, *scaling.ship.findings)],
    }


def scaling_text(scaling: Scaling) -> str:
    """What a terminal shows: errors by quantity and speed, what they do to the clearance, the signs."""
    import pandas as pd

    found, ship = scaling.errors, scaling.ship.curve
    rows = [
        {
            "quantity": of["quantity"],
            "speed [m/s]": f"{of['speed']:.4g}",
            "model, scaled": f"{of['model']:.4g}",
            "ship": f"{of['ship']:.4g}",
            "error": f"{of['error']:+.3g}",
            "unit": of["unit"],
            "of the ship's [%]": _percent(of["percent"]),
            "of the clearance at rest [%]": _percent(of["percent_of_clearance"]),
        }
        for of in found.frame.to_dict("records")
    ]
    lines = [
        f"{Path(scaling.model.path).name} at 1:{scaling.model.curve.scale:g} against {Path(scaling.ship.path).name}: "
        f"depth {ship.depth:.4g} m, h/T {ship.depth / ship.draught:.3g}",
        "",
        aligned_text(pd.DataFrame(rows), list(rows[0])),
    ]
    if not found.clearance.empty:
        clearance = [
            {
                "under the keel at [m/s]": f"{of['speed']:.4g}",
                "at rest [m]": f"{of['static']:.3f}",
                "by the model [m]": f"{of['model']:.3f}",
                "ship [m]": f"{of['ship']:.3f}",
                "change [m]": f"{of['change']:+.3f}",
                "of that at rest [%]": _percent(of["percent_of_static"]),
            }
            for of in found.clearance.to_dict("records")
        ]
        lines += ["", aligned_text(pd.DataFrame(clearance), list(clearance[0]))]
    if found.outside:
        lines += ["", f"{found.outside} speed(s) of the ship lie outside the model's; nothing is extrapolated"]
    return "\n".join([*lines, "", SCALING_SIGNS])


def _percent(value: float) -> str:
    return "" if value != value else f"{value:+.1f}"
