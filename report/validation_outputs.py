"""What a trial against the simulator leaves behind: tables, tracks, figures, provenance."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..core.provenance import program_versions
from ..simulate.trial_validation import CHANNELS, TrialValidation
from ..simulate.vessel import Vessel
from .aligned_text import aligned_text
from .figure_style import BLUE, INK, SKY, VERMILLION, new_axes, small_legend
from .manoeuvre_outputs import DOTS
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder

VALIDATION_FORMAT = "towtank validation 1"

_SHOWN = {
    "psi": "heading ψ [deg]",
    "r": "yaw rate r [deg/s]",
    "u": "u [m/s]",
    "v": "v [m/s]",
    "phi": "roll φ [deg]",
}


def require_validation_folder(out: str | Path) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), VALIDATION_FORMAT)


def write_validation(
    validation: TrialValidation, vessel: Vessel, out: str | Path, *, progress: Progress | None = None
) -> list[Path]:
    """Write ``validation.csv`` (indices), ``channels.csv``, both tracks, figures and ``provenance.json``.

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("validation.csv", csv_writer(lambda: validation.indices)),
        ("channels.csv", csv_writer(lambda: validation.channels)),
        ("trajectory_measured.csv", validation.measured.to_csv),
        ("trajectory_simulated.csv", validation.simulated.to_csv),
    ]
    if {"x", "y"} <= set(validation.measured.frame.columns):
        writers.append(("figure_track.png", partial(_save, lambda: compared_tracks(validation))))
    for name in _SHOWN:
        if name in validation.measured and name in validation.simulated:
            writers.append((f"figure_{name}.png", partial(_save, partial(compared_channel, validation, name))))
    return write_folder(Path(out), writers, _provenance(validation, vessel), progress)


def _save(draw: Any, path: Path) -> None:
    draw().get_figure(root=True).savefig(path, dpi=DOTS, facecolor="white", metadata={"Software": "towtank"})


def compared_tracks(validation: TrialValidation, ax: Axes | None = None) -> Axes:
    """Measured and simulated track, and the tracks of the draws, over ship lengths."""
    ax = new_axes((4.7, 4.5)) if ax is None else ax
    length = validation.measured.ship.L
    if "x" in validation.draws:
        for x, y in zip(validation.draws["x"][:60], validation.draws["y"][:60], strict=True):
            ax.plot(y / length, x / length, color=SKY, linewidth=0.4, alpha=0.5)
    simulated, measured = validation.simulated, validation.measured
    ax.plot(simulated["y"] / length, simulated["x"] / length, color=BLUE, linewidth=1.4, label="simulated")
    ax.plot(
        measured["y"] / length,
        measured["x"] / length,
        color=VERMILLION,
        linewidth=1.4,
        linestyle="--",
        label="measured",
    )
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("y / L  (to starboard)")
    ax.set_ylabel("x / L  (original course)")
    small_legend(ax, loc="best")
    return ax


def compared_channel(validation: TrialValidation, channel: str, ax: Axes | None = None) -> Axes:
    """One channel over time: measured, simulated, and the band of 5 to 95 per cent of the draws."""
    ax = new_axes((4.7, 3.0)) if ax is None else ax
    factor = math.degrees(1.0) if CHANNELS[channel].startswith("deg") else 1.0
    measured, simulated = validation.measured, validation.simulated
    band = validation.band(channel)
    if band is not None:
        ax.fill_between(
            measured["time"],
            factor * band[0],
            factor * band[1],
            color=SKY,
            alpha=0.35,
            linewidth=0.0,
            label="5 to 95 % of the draws",
        )
    ax.plot(simulated["time"], factor * simulated[channel], color=BLUE, linewidth=1.4, label="simulated")
    ax.plot(
        measured["time"],
        factor * measured[channel],
        color=VERMILLION,
        linewidth=1.2,
        linestyle="--",
        label="measured",
    )
    if channel == "psi" and "delta" in measured:
        ax.plot(
            measured["time"], np.degrees(measured["delta"]), color=INK, linewidth=0.7, label="rudder, measured"
        )
    ax.set_xlim(0.0, float(max(measured["time"][-1], simulated["time"][-1])))
    ax.set_xlabel("time [s]")
    ax.set_ylabel(_SHOWN[channel])
    small_legend(ax, loc="best")
    return ax


def _provenance(validation: TrialValidation, vessel: Vessel) -> dict[str, Any]:
    trial, current = validation.measured, validation.current
    return {
        "format": VALIDATION_FORMAT,
        "created": timestamp(),
        "versions": program_versions(),
        "vessel": vessel.name,
        "ship": vessel.ship.to_dict(),
        "sources": dict(vessel.sources),
        "trial": {"file": trial.source, "sha256": list(trial.provenance.inputs.values())}
        | {"manoeuvre": trial.manoeuvre, "steps": list(trial.provenance.history)},
        "approach speed [m/s]": validation.simulated.provenance.choices["approach speed [m/s]"],
        "current removed [m/s]": None if current is None else [current.along, current.across],
        "draws": validation.scatter or None,
        "draws that failed": validation.failed,
        "doubts": [finding.message for finding in validation.simulated.provenance.findings],
    }


def validation_text(validation: TrialValidation, vessel: Vessel) -> str:
    """The comparison as lines for a terminal."""
    choices = validation.simulated.provenance.choices
    blocks = [
        f"{vessel.name} against {validation.measured.source or 'the trial'}, approach at"
        f" {choices['approach speed [m/s]']:.4g} m/s"
    ]
    if validation.current is not None:
        one = validation.current
        blocks.append(
            f"current removed: {one.speed:.3g} m/s flowing to {math.degrees(one.direction):.0f} deg"
            f" (axes of the file), standard errors {one.along_error:.2g} and {one.across_error:.2g} m/s"
        )
    if len(validation.indices):
        columns = ["index", "unit", "measured", "simulated", "error", "error_pct", "sd", "p05", "p95", "z"]
        shown = validation.indices
        if validation.scatter:
            shown = shown.assign(
                inside=["" if one is None else "yes" if one else "no" for one in shown["covered"]]
            )
            columns.append("inside")
        blocks.append(aligned_text(shown, columns))
    blocks.append(aligned_text(validation.channels, list(validation.channels.columns)))
    if validation.scatter:
        known = [bool(one) for one in validation.indices["covered"] if one is not None]
        text = f"{validation.scatter}; band of 5 to 95 %"
        if known:
            text += f"; {sum(known)} of {len(known)} indices inside"
        if validation.failed:
            text += f"; {validation.failed} draws did not complete the manoeuvre"
        blocks.append(text)
    blocks += [f"doubt: {finding.message}" for finding in validation.simulated.provenance.findings]
    return "\n\n".join(blocks)
