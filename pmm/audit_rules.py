"""Every rule of the import audit: its name, how grave it is, what it means and what to do."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..core.errors import CampaignError
from ..core.findings import Finding, Severity

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Rule:
    """One rule of the audit.

    Attributes
    ----------
    name : str
        Name in findings and for ``--accept``.
    severity : {"error", "warning", "info"}
        The gravest that the rule gives; a slight case may be a warning where a gross one is an error.
    stage : {"reading", "header", "record", "campaign"}
        When it is checked: by the reader, against the header of a file, in the record of a run, or across runs.
        Rules that are checked more than once name the first.
    meaning : str
        What is wrong, in one line.
    cure : str
        What to do about it.
    """

    name: str
    severity: Severity
    stage: str
    meaning: str
    cure: str


_ALL = (
    # -- by the reader ---------------------------------------------------------------------------------------
    Rule("ragged-last-line", "warning", "reading", "the last line of the file is cut off",
         "check that the run was recorded to its end"),
    Rule("blank-rows", "warning", "reading", "there are blank rows between the data",
         "check that no samples are missing there"),
    Rule("comment-in-data", "warning", "reading", "there are comment lines between the data",
         "check that the run is one continuous record"),
    Rule("units-fewer-than-columns", "warning", "reading", "the unit row is shorter than the row of names",
         "give the units in the channel map"),
    Rule("names-fewer-than-columns", "warning", "reading", "some columns have no name",
         "name them in the header, or map them by their number"),
    Rule("duplicate-columns", "warning", "reading", "a column name is used more than once",
         "rename the columns, or map them by their new names"),
    Rule("text-column", "warning", "reading", "a column holds text and is left out",
         "export numbers if they are needed"),
    Rule("left-out", "warning", "reading", "arrays that are no columns are left out",
         "export them as columns of one length if they are needed"),
    Rule("numbers-as-text", "warning", "reading", "a spreadsheet stores numbers as text",
         "check the decimal sign of the export"),
    Rule("first-sheet", "info", "reading", "a workbook has several sheets and the first was read",
         "name the sheet in [reader]"),
    Rule("time-stamps", "info", "reading", "time was taken from the recorder's stamps",
         "map a time channel if there is a better one"),
    Rule("no-condition-file", "warning", "reading", "there is no model or condition file beside the run",
         "put it beside the run, or check the particulars by hand"),
    # -- in the header ---------------------------------------------------------------------------------------
    Rule("decimal-comma", "info", "header", "numbers are written with decimal commas and were read so",
         "nothing, if the values look right"),
    Rule("header-encoding", "info", "header", "the header is not utf-8 and was read as latin-1 or cp1252",
         "nothing, if names and units look right"),
    Rule("wrong-length", "error", "header",
         "the length behind the velocities or in the header is not that of the ship: rdot'/r' must be omega L/U",
         "correct the length in the header or in [ship], and convert the channels with it"),
    Rule("density", "error", "header", "the water density differs from what the file or the ship's mass says",
         "set ship.rho to the density of the tank: about 1000 for fresh, 1025 for salt water"),
    Rule("scale-label", "error", "header", "length, speed and scale of the ship do not belong to one scale",
         "set ship.L, ship.scale and the speeds of the runs to the scale of the measurement"),
    # -- in the record of a run: time ------------------------------------------------------------------------
    Rule("too-short", "error", "record", "the record has too few samples", "export the whole run"),
    Rule("time-not-increasing", "error", "record", "time runs backwards in several places",
         "sort or export the record again, and check the time column"),
    Rule("time-duplicated", "error", "record", "time stamps are repeated",
         "remove repeated rows, or export more decimals of time"),
    Rule("time-rounded", "error", "record", "time stamps are rounded more coarsely than the sampling needs",
         "export more decimals of time"),
    Rule("time-overlap", "error", "record", "time jumps back: a restarted run overlaps the one before",
         "cut the earlier part where the restart begins"),
    Rule("gap", "error", "record", "samples are missing", "fill the gap from the raw data, or cut the run there"),
    Rule("non-uniform-sampling", "warning", "record", "the sampling interval varies",
         "resample the record, or write it with a constant time step"),
    # -- in the record of a run: channels --------------------------------------------------------------------
    Rule("missing-values", "error", "record", "a channel holds NaN or infinite values",
         "cut or fill these samples, or leave the channel out"),
    Rule("constant-channel", "error", "record", "a channel that must vary does not",
         "check the cable, the gain and the channel map"),
    Rule("saturated-channel", "warning", "record", "a force channel has flat tops: the amplifier was at its limit",
         "repeat the run with a larger range; do not use the clipped harmonics"),
    Rule("spikes", "warning", "record", "single samples stand far off their neighbours",
         "filter them, and check the cable"),
    Rule("transient-only", "error", "record", "a steady run never becomes steady",
         "record longer, or cut out the steady part"),
    Rule("short-of-whole-cycles", "error", "record", "an oscillating run holds too few cycles",
         "record at least two whole cycles, or check the frequency"),
    # -- in the record of a run: motion ----------------------------------------------------------------------
    Rule("swapped-channels", "error", "record", "two channels are exchanged", "exchange them in the channel map"),
    Rule("earth-fixed-velocities", "error", "record",
         "u and v are the velocities along and across the tank, not along and across the ship",
         "map them as speeds of the carriage, or leave them out: the motion is computed from the test matrix"),
    Rule("angle-in-degrees", "error", "record", "an angle in degrees is taken for radians, or the other way round",
         "give the unit in the channel map, or conventions.angle_unit for the test matrix"),
    Rule("length-in-millimetres", "error", "record", "a length in millimetres or centimetres is taken for metres",
         "give the unit in the channel map, or metres in the test matrix"),
    Rule("speed-mismatch", "error", "record", "the measured speed is not the speed of the test matrix",
         "check the unit of the speed and the run it belongs to"),
    Rule("drift-sign", "error", "record", "drift, sway or yaw has the wrong sign",
         "check conventions.drift_sign and conventions.axes, and the sign of v in the channel map"),
    Rule("rudder-sign", "error", "record", "the rudder angle has the wrong sign",
         "check conventions.rudder_sign and the sign of the rudder channel"),
    Rule("frequency-mismatch", "error", "record", "the motion has another frequency than the test matrix says",
         "check rad/s against Hz and the run it belongs to, or set reduction.frequency = 'found'"),
    Rule("amplitude-mismatch", "error", "record", "a motion is larger or smaller than the test matrix says",
         "correct the test matrix or the calibration of the channel"),
    Rule("phase-mismatch", "error", "record", "the motion is ahead of or behind the test matrix",
         "give sway_phase and yaw_phase of the run, or set reduction.motion = 'measured'"),
    # -- across runs -----------------------------------------------------------------------------------------
    Rule("force-sign", "error", "campaign", "forces are those by the model on the balance, not on the model",
         "set conventions.force_sign = 'by-ship', or the sign of the channel in the channel map"),
    Rule("inertia-inside", "error", "campaign", "the measured forces hold the inertia of the model",
         "set inertia.inside = true and give mass and Izz of all that hangs on the balance"),
    Rule("inertia-outside", "error", "campaign",
         "inertia was taken out of forces that do not hold it (or more of it than they hold)",
         "set inertia.inside = false, or correct inertia.mass and inertia.Izz"),
    Rule("moment-reference", "error", "campaign", "the yaw moment seems to be about another point",
         "set reduction.moment_x to the point of the balance, in m forward of midship; check the sign of N"),
    Rule("l2-against-lt", "error", "campaign", "forces are off by L/T: divided by L^2 and read as L T, or reverse",
         "set the scaling of the points to 'L2' or 'LT' as the source has it"),
    Rule("force-unit", "error", "campaign", "forces are off by a power of ten from any ship of this size",
         "check the unit and the gain of X, Y and N in the channel map (kN against N)"),
)  # fmt: skip

RULES: dict[str, Rule] = {rule.name: rule for rule in _ALL}
"""All rules by name."""


def finding(
    name: str,
    message: str,
    *,
    severity: Severity | None = None,
    place: str = "",
    file: str = "",
    cure: str = "",
) -> Finding:
    """Finding of a rule, with the rule's own severity and cure unless others are given."""
    rule = RULES[name]
    return Finding(name, severity or rule.severity, message, file, place, cure or rule.cure)


def require_rules(names: Iterable[str]) -> None:
    """Raise :class:`CampaignError` for a name that is not a rule: a misspelt waiver would waive nothing.

    Parameters
    ----------
    names : iterable of str
        Rules that somebody wants to accept.
    """
    for name in names:
        if name not in RULES:
            import difflib

            close = difflib.get_close_matches(name, RULES, n=3, cutoff=0.4)
            guess = f"closest: {', '.join(close)}" if close else "towtank audit --list names all rules"
            raise CampaignError(f"'{name}' is not an audit rule", cure=guess)


def rules_frame() -> pd.DataFrame:
    """Table of all rules: name, severity, stage, meaning, cure."""
    import pandas as pd

    return pd.DataFrame([vars(rule) for rule in _ALL])
