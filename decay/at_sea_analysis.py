"""From records of a ship at sea to roll damping: random decrement, joint fit, and the published search beside them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError, TowtankError
from ..core.findings import Finding
from ..identify.low_pass import low_pass
from .at_sea import AtSeaFit, fit_roll_at_sea, term_sizes
from .at_sea_results import AtSeaAnalysis, AtSeaRecord, Searched
from .damping_models import TERMS
from .decay_analysis import Progress, opened, read_records
from .decay_campaign import (
    DISCRETE_SEARCH,
    JOINT_FIT,
    RANDOM_DECREMENT,
    AtSeaSettings,
    DecayCampaign,
)
from .decay_record import DecayRecord
from .discrete_search import search_on_grid
from .dominant_frequency import CUTOFF_OVER_DECAY
from .excited_roll import harmonic_motion, needed_excitation
from .oscillations import Oscillation, split_oscillations
from .random_decrement import BLOCKS, RandomDecrement, random_decrement

if TYPE_CHECKING:
    from collections.abc import Callable

ROUGH_ZETA = 0.05
"""Damping ratio of the first guess when nothing else is known."""

LEVELS = (0.7, 1.0, math.sqrt(2.0), 2.0)
"""Trigger levels of the random decrement over the standard deviation of the record."""

_SEARCH_SAMPLES = 64
_SEARCH_MOVES = 300
_SEARCH_STEPS = {"b1": 0.002, "b3": 0.01, "c1": 0.005, "c3": 0.01, "c5": 0.02}
"""Steps of the discrete search over the sizes of the terms; the paper prints none."""


def run_at_sea_campaign(
    campaign: DecayCampaign | str | Path,
    *,
    folder: str | Path | None = None,
    accept: Sequence[str] = (),
    progress: Progress | None = None,
) -> AtSeaAnalysis:
    """Read and analyse the records of a campaign with a section ``[at_sea]``.

    Parameters
    ----------
    campaign : DecayCampaign, str or Path
        Campaign, or its file.
    folder : str or Path, optional
        Where the names of the record files start; that of the campaign file, or the present one.
    accept : sequence of str
        Audit rules that the user waives beside those of the campaign.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    TowtankError
        When a file or key is wrong, or no method gives a result for a record, with the reasons.
    """
    campaign, path, start = opened(campaign, folder)
    records = read_records(campaign, start, accept=accept, progress=progress)
    settings = campaign.at_sea or AtSeaSettings()
    done = []
    for number, (entry, record) in enumerate(zip(campaign.records, records, strict=True)):
        if progress:
            progress("fitting", number, len(records))
        cut = record
        if entry.start is not None or entry.end is not None:
            cut = record.free_part(
                start=record.time[0] if entry.start is None else entry.start,
                end=record.time[-1] if entry.end is None else entry.end,
            )
        done.append(analyse_at_sea(cut, settings))
    if progress:
        progress("fitting", len(records), len(records))
    return AtSeaAnalysis(campaign, path, tuple(done))


def analyse_at_sea(record: DecayRecord, settings: AtSeaSettings | None = None) -> AtSeaRecord:
    """Roll damping from one record at sea by the chosen methods.

    Parameters
    ----------
    record : DecayRecord
        Of roll; no release is looked for.
    settings : AtSeaSettings, optional

    Raises
    ------
    FitError
        When no method gives a result, with the reasons.
    """
    chosen = settings or AtSeaSettings()
    failures: dict[str, str] = {}
    methods = chosen.chosen_methods
    decrements: list[RandomDecrement] = []
    _tried(failures, RANDOM_DECREMENT, lambda: decrements.extend(_decrements(record, chosen)))
    guess, said = first_guess(record, chosen, decrements)
    noise = _noise(record, guess) if chosen.noise is None else math.radians(chosen.noise)
    joint: list[AtSeaFit] = []
    searches: list[Searched] = []
    if JOINT_FIT in methods:
        _tried(failures, JOINT_FIT, lambda: joint.append(_joint(record, chosen, guess, noise)))
    if DISCRETE_SEARCH in methods:
        _tried(failures, DISCRETE_SEARCH, lambda: searches.append(_searched(record, chosen, guess, noise)))
    if RANDOM_DECREMENT not in methods:
        decrements = []
        failures.pop(RANDOM_DECREMENT, None)
    if not (joint or decrements or searches):
        method, reason = next(iter(failures.items()))
        raise FitError(
            f"no method gives a result; {method}: {reason}", file=record.source or None, place=record.name
        )
    return AtSeaRecord(
        record,
        guess,
        said,
        noise,
        tuple(decrements),
        joint[0] if joint else None,
        searches[0] if searches else None,
        failures,
        tuple(_doubts(record, decrements, joint)),
    )


def _tried(failures: dict[str, str], method: str, work: Callable[[], None]) -> None:
    """Run a method; what it refuses is kept with its reason."""
    try:
        work()
    except TowtankError as error:
        failures[method] = error.cause + (f" -> {error.cure}" if error.cure else "")


def first_guess(
    record: DecayRecord, settings: AtSeaSettings, decrements: Sequence[RandomDecrement]
) -> tuple[dict[str, float], str]:
    """Rough terms, and where they come from: given, a given period, the random decrement, or the record's period."""
    guess = dict(settings.guess)
    sound = [one for one in decrements if not one.findings]
    if "c1" in guess:
        said = "given"
    elif settings.period is not None:
        guess["c1"] = (2.0 * math.pi / settings.period) ** 2
        said = f"period {settings.period:g} s given"
    elif sound:
        guess["c1"] = float(sound[0].omega) ** 2
        guess.setdefault("b1", float(2.0 * sound[0].alpha))
        said = "random decrement"
    else:
        periods = [one.period for one in split_oscillations(record.time, record.value)]
        guess["c1"] = (2.0 * math.pi / float(np.mean(periods))) ** 2
        said = "mean period of the record"
    guess.setdefault("b1", 2.0 * ROUGH_ZETA * math.sqrt(guess["c1"]))
    return guess, said


def _decrements(record: DecayRecord, settings: AtSeaSettings) -> Iterator[RandomDecrement]:
    """Signatures at the levels asked for, or at several around the best one; levels without enough pieces are left."""
    if settings.levels:
        for degrees in settings.levels:
            yield random_decrement(record.time, record.value, level=math.radians(degrees))
        return
    deviation = float(np.std(record.value))
    found, reason = [], None
    for share in LEVELS:
        try:
            found.append(random_decrement(record.time, record.value, level=share * deviation))
        except FitError as error:
            reason = error
    if not found and reason is not None:
        raise reason
    # A level that hardly any piece begins at says nothing and hides what the others say.
    yield from [one for one in found if one.pieces >= BLOCKS] or found


def _noise(record: DecayRecord, guess: Mapping[str, float]) -> float:
    """Standard deviation in rad of what lies above five times the roll frequency."""
    cutoff = CUTOFF_OVER_DECAY * math.sqrt(guess["c1"]) / (2.0 * math.pi)
    return float(np.std(record.value - low_pass(record.value, record.time_step, cutoff)))


def _joint(record: DecayRecord, settings: AtSeaSettings, guess: Mapping[str, float], noise: float) -> AtSeaFit:
    least = math.radians(settings.least_amplitude)
    oscillations = split_oscillations(record.time, record.value, least_amplitude=least)
    if len(oscillations) > settings.most:
        largest = sorted((one.amplitude for one in oscillations), reverse=True)
        least = largest[settings.most - 1]
    return fit_roll_at_sea(
        record.time, record.value, guess=guess, terms=settings.terms, noise=noise, least_amplitude=least
    )


def _searched(record: DecayRecord, settings: AtSeaSettings, guess: Mapping[str, float], noise: float) -> Searched:
    """The discrete search as published, on the largest oscillation alone, with its nine numbers."""
    oscillations = split_oscillations(record.time, record.value)
    item = max(oscillations, key=lambda one: one.amplitude)
    start, steps, columns = _search_problem(record, item, guess)
    found = search_on_grid(*columns, start=start, steps=steps | settings.steps, most_moves=_SEARCH_MOVES)
    return Searched(float(record.time[item.rows.start]), item.amplitude, item.determines(noise), found)


def _search_problem(
    record: DecayRecord, item: Oscillation, guess: Mapping[str, float]
) -> tuple[dict[str, float], dict[str, float], list[np.ndarray]]:
    time = record.time[item.rows] - record.time[item.rows.start]
    omega = 2.0 * math.pi / item.period
    motion = harmonic_motion(time, record.value[item.rows], omega)
    terms = np.array([guess.get(name, 0.0) for name in TERMS])
    # The published equation has no quadratic term.
    terms[1] = 0.0
    sine, cosine, bias = needed_excitation(time, motion, terms, omega)
    force = max(math.hypot(sine, cosine), 1e-3 * guess["c1"] * item.amplitude)
    start = {name: guess.get(name, 0.0) for name in _SEARCH_STEPS}
    start |= {"f": force, "we": omega, "phase": math.atan2(cosine, sine), "f0": bias}
    sizes = term_sizes(guess["c1"], item.amplitude)
    steps = {name: part * sizes[name] for name, part in _SEARCH_STEPS.items()}
    steps |= {"f": 0.02 * force, "we": 0.005 * omega, "phase": 0.02, "f0": 0.01 * force}
    every = max(time.size // _SEARCH_SAMPLES, 1)
    return start, steps, [column[::every] for column in (time, *motion)]


def _doubts(
    record: DecayRecord, decrements: Sequence[RandomDecrement], joint: Sequence[AtSeaFit]
) -> Iterator[Finding]:
    """Findings of the methods, with file and method."""
    for method, fits in ((RANDOM_DECREMENT, decrements), (JOINT_FIT, joint)):
        for one in fits:
            for item in one.findings:
                at = f" at {math.degrees(one.level):.3g} deg" if isinstance(one, RandomDecrement) else ""
                place = f"{method}{at}" + (f", {item.place}" if item.place else "")
                yield Finding(item.rule, item.severity, item.message, record.source, place, item.cure)
