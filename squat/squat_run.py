"""One record of a campaign reduced by its settings: steady, in steps of speed, or in waves."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.errors import FitError, TowtankError
from ..core.findings import Finding
from ..identify.autocorrelation import MeanEstimate
from ..identify.harmonics import HarmonicFit
from ..identify.steady_window import WindowChoice, speed_plateau, steady_window
from .campaign_sections import SquatRecordEntry, SquatWindow
from .noise_filter import filter_record
from .sinkage_record import SinkageRecord, read_sinkage
from .speed_steps import reduce_speed_steps
from .squat_campaign import SquatCampaign
from .squat_in_waves import SquatInWaves, reduce_in_waves
from .steady_squat import SteadySquat, reduce_steady
from .wave_response import WaveResponses, wave_responses


@dataclass(frozen=True, eq=False)
class SquatRun:
    """A record and what it gave.

    Attributes
    ----------
    name : str
    entry : SquatRecordEntry
    record : SinkageRecord
    steady : tuple of SteadySquat
        One, or one for each step of speed; of a run in waves the means of the harmonic fits.
    waves : SquatInWaves, optional
    responses : WaveResponses, optional
        Of a run in waves whose gauge is named.
    findings : tuple of Finding
        Of the audit and of the reduction.
    """

    name: str
    entry: SquatRecordEntry
    record: SinkageRecord
    steady: tuple[SteadySquat, ...]
    waves: SquatInWaves | None = None
    responses: WaveResponses | None = None
    findings: tuple[Finding, ...] = ()

    @property
    def steps(self) -> tuple[str, ...]:
        """What was done to the record, in words."""
        windows = (f"{one.run}: {one.window.note}" for one in self.steady)
        return (*self.record.history, *windows)


def reduce_run(
    campaign: SquatCampaign,
    entry: SquatRecordEntry,
    name: str,
    folder: Path,
    accepted: Iterable[str] = (),
) -> SquatRun:
    """Read and reduce one record.

    Parameters
    ----------
    campaign : SquatCampaign
    entry : SquatRecordEntry
    name : str
        Of the run in the tables.
    folder : Path
        Where the file name starts.
    accepted : iterable of str
        Audit rules that are waived.

    Raises
    ------
    TowtankError
        When the file cannot be read, the audit finds an error that nobody accepted, or nothing can be averaged.
    """
    path = folder / entry.file
    record = read_sinkage(
        path, campaign.make_layout(waves=entry.waves), accepted=accepted, units=campaign.channels.units or None
    )
    if entry.speed is not None:
        if record.speed is not None:
            raise TowtankError(
                "the speed is given and recorded", cure="leave one of the two out", file=path, place="speed"
            )
        record = replace(record, speed=np.full(len(record.time), entry.speed))
    if campaign.filter.name != "none":
        record = filter_record(record, campaign.filter.name, cutoff=campaign.filter.cutoff)
    window = _window_of(campaign.window, entry)
    depth = entry.depth if entry.depth is not None else campaign.fairway.depth
    places = record.layout.places | campaign.channels.places
    if entry.waves:
        return _in_waves(campaign, entry, name, record, window, depth, places)
    try:
        if campaign.steps is not None:
            steps = campaign.steps
            shortest = steps.last if steps.shortest is None else steps.shortest
            steady = tuple(
                reduce_speed_steps(
                    record, shortest=shortest, last=steps.last, depth=depth, places=places, run=name
                )
            )
        else:
            steady = (
                reduce_steady(
                    record,
                    rule=window.rule,
                    fraction=(window.begin, window.end),
                    start=window.start,
                    stop=window.stop,
                    places=places,
                    depth=depth,
                    run=name,
                ),
            )
    except FitError as error:
        raise FitError(error.cause, cure=error.cure, file=path, place=error.place) from None
    return SquatRun(name, entry, record, steady, findings=(*record.findings, *_about(steady, record)))


def _window_of(window: SquatWindow, entry: SquatRecordEntry) -> SquatWindow:
    """The window of a record: its own times make it one by key times."""
    if entry.start is None and entry.stop is None:
        return window
    return window.model_copy(update={"rule": "key-times", "start": entry.start, "stop": entry.stop})


def _about(steady: Iterable[SteadySquat], record: SinkageRecord) -> list[Finding]:
    found = []
    for one in steady:
        if not one.window.is_stationary:
            drift = ", ".join(
                f"{what} {value:+.3g} {unit}"
                for what, value, unit in zip(("midship", "trim"), one.window.drift, ("m", "m/m"), strict=True)
            )
            found.append(
                Finding(
                    "window-drifts",
                    "warning",
                    f"sinkage or trim still drifts between {one.window.start_time:g} and "
                    f"{one.window.stop_time:g} s: {drift} over the window",
                    record.name,
                    one.run,
                    "choose another window, or wait longer between runs",
                )
            )
    return found


def _in_waves(
    campaign: SquatCampaign,
    entry: SquatRecordEntry,
    name: str,
    record: SinkageRecord,
    window: SquatWindow,
    depth: float | None,
    places: dict[str, float],
) -> SquatRun:
    start, stop = _regular_part(record, window)
    waves = reduce_in_waves(
        record, start=start, stop=stop, omega=entry.omega, order=campaign.fit.order, places=places, run=name
    )
    judged = np.column_stack([record.midship, record.trim])
    choice = steady_window(record.time, judged, rule="key-times", start=start, stop=stop)
    aside = {campaign.channels.wave} - set(campaign.channels.extra)
    means = {quantity: _mean_of(fit) for quantity, fit in waves.fits.items() if quantity not in aside}
    units = dict(waves.units)
    if record.speed is not None:
        level = float(np.mean(record.speed[choice.slice]))
        means["speed"], units["speed"] = MeanEstimate(level, 0.0, 1.0, 1.0, 1.0, True), "m/s"
    steady = SteadySquat(name, means, units, _regular(choice), depth)
    found = [
        Finding("few-cycles", "warning", note, record.name, name, "take a longer window or a longer run")
        for note in waves.notes
    ]
    responses = _responses(campaign, waves, record, means, depth)
    found += [
        Finding("gauge-not-with-ship", "warning", note, record.name, name, "name a gauge on the carriage")
        for note in (responses.notes if responses is not None else ())
    ]
    return SquatRun(name, entry, record, (steady,), waves, responses, (*record.findings, *found))


def _responses(
    campaign: SquatCampaign,
    waves: SquatInWaves,
    record: SinkageRecord,
    means: dict[str, MeanEstimate],
    depth: float | None,
) -> WaveResponses | None:
    """Motions over the wave where the campaign names a gauge."""
    gauge, gauge_x = campaign.channels.wave, campaign.channels.wave_x
    if not gauge or gauge_x is None:
        return None
    lacking = [what for what, missing in (("depth", depth is None), ("speed", "speed" not in means)) if missing]
    if depth is None or lacking:
        raise FitError(
            f"the length of the waves needs the {' and the '.join(lacking)}",
            cure="give the water depth, and a speed channel or the speed in m/s",
            file=record.name or None,
            place=f"channel {gauge}",
        )
    try:
        return wave_responses(
            waves,
            gauge,
            gauge_x=gauge_x,
            reference_x=record.layout.xG,
            depth=depth,
            speed=float(means["speed"].mean),
        )
    except TowtankError as error:
        raise FitError(error.cause, cure=error.cure, file=record.name or None, place=error.place) from None


def _regular(choice: WindowChoice) -> WindowChoice:
    return replace(choice, note="mean of the harmonic fit over the given times")


def _regular_part(record: SinkageRecord, window: SquatWindow) -> tuple[float, float]:
    """Times between which the waves are taken as regular."""
    if window.rule == "key-times":
        first, last = float(record.time[0]), float(record.time[-1])
        return (first if window.start is None else window.start, last if window.stop is None else window.stop)
    if window.rule == "plateau" and record.speed is not None:
        begin, end = speed_plateau(record.speed)
        first, last = float(record.time[begin]), float(record.time[end - 1])
        return first + window.begin * (last - first), first + window.end * (last - first)
    raise FitError(
        f"the window rule {window.rule} finds no regular waves",
        cure="give the times of the regular part in s, or the rule plateau and a speed channel",
        file=record.name or None,
    )


def _mean_of(fit: HarmonicFit) -> MeanEstimate:
    """Mean of a harmonic fit with the number of independent residuals that its error stands for."""
    mean, se, spread = float(fit.mean), float(fit.se_mean), float(fit.residual_std)
    n_eff = float(np.clip((spread / se) ** 2, 1.0, fit.n)) if se > 0.0 else 1.0
    return MeanEstimate(mean, se, n_eff, fit.n / n_eff, float(np.min(fit.dof)), spread == 0.0)
