"""From decay campaigns to damping: records cut and centred, models judged, methods compared, Ikeda beside them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.errors import CampaignError, FitError, TowtankError
from ..core.findings import Finding
from .beside_memory import MemoryComparison, beside_memory
from .compare import METHODS, DecayComparison, compare_methods
from .damping_models import MOTION_UNITS, DampingModel
from .decay_campaign import AUTO, DecayCampaign, RecordEntry, load_decay_campaign
from .decay_input import read_decay
from .decay_record import DecayRecord
from .decay_results import CONTRADICTED, DISAGREES, DecayAnalysis, DecayGroup
from .heave_pitch import DecayRatio, decay_ratio
from .ikeda import IkedaHull
from .ikeda_comparison import IkedaComparison, beside_ikeda
from .model_verdict import ModelVerdict, judge_models
from .radiation_table import RadiationTable, read_radiation
from .roll_damping import RollDamping

Progress = Callable[[str, int, int], None]

DISAGREEING, DISAGREEING_PART = 3.0, 0.05
"""Standard errors, and part of the damping, by which a method must differ from the preferred one to be told."""
_COMPARED = 9


def run_decay_campaign(
    campaign: DecayCampaign | str | Path,
    *,
    folder: str | Path | None = None,
    accept: Sequence[str] = (),
    progress: Progress | None = None,
) -> DecayAnalysis:
    """Read and analyse a decay campaign.

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
        When a file or key is wrong, a record holds no decay, or no method can fit it.
    """
    campaign, path, start = opened(campaign, folder)
    records = read_records(campaign, start, accept=accept, progress=progress)
    table = None if campaign.memory is None else _radiation(campaign, start)
    return analyse_decays(campaign, records, path=path, radiation=table, progress=progress)


def opened(
    campaign: DecayCampaign | str | Path, folder: str | Path | None
) -> tuple[DecayCampaign, Path | None, Path]:
    """A campaign or its file, that file, and the folder where the names of its files start."""
    if isinstance(campaign, DecayCampaign):
        return campaign, None, Path(folder or "")
    path = Path(campaign)
    return load_decay_campaign(path), path, path.parent if folder is None else Path(folder)


def read_records(
    campaign: DecayCampaign,
    folder: Path,
    *,
    accept: Sequence[str] = (),
    progress: Progress | None = None,
) -> list[DecayRecord]:
    """Whole records of a campaign, one for each entry.

    Parameters
    ----------
    campaign : DecayCampaign
    folder : Path
        Where the names of the record files start.
    accept : sequence of str
        Audit rules that the user waives beside those of the campaign.
    progress : callable, optional
        ``progress(what, done, total)``.
    """
    waived = (*campaign.accept, *accept)
    records = []
    for number, entry in enumerate(campaign.records):
        if progress:
            progress("reading", number, len(campaign.records))
        records.append(_read(campaign, entry, folder, waived))
    if progress:
        progress("reading", len(records), len(records))
    return records


def _radiation(campaign: DecayCampaign, folder: Path) -> RadiationTable:
    """The table of radiation, at the scale that it is given at."""
    wanted = campaign.memory
    assert wanted is not None
    own = campaign.make_ship()
    return read_radiation(
        folder / wanted.table,
        motion=campaign.records[0].motion,
        frequency=wanted.frequency,
        damping=wanted.damping,
        added_mass=wanted.added_mass,
        infinite=wanted.infinite,
        scale=wanted.scale if wanted.scale is not None else 1.0 if own is None else own.scale,
    )


def _read(campaign: DecayCampaign, entry: RecordEntry, folder: Path, waived: Sequence[str]) -> DecayRecord:
    shared = campaign.channels
    ship = campaign.make_ship()
    if ship is not None and entry.depth is not None:
        # The depth is given at the scale of the record, the ship at its own.
        ship = replace(ship.at_scale(entry.scale), depth=entry.depth)
    return read_decay(
        folder / entry.file,
        time=entry.time or shared.time,
        angle=entry.angle or shared.angle,
        unit=entry.unit or shared.unit,
        motion=entry.motion,
        rate=entry.rate or shared.rate,
        acceleration=entry.acceleration or shared.acceleration,
        name=entry.name or Path(entry.file).stem,
        speed=entry.speed,
        scale=entry.scale,
        ship=ship,
        accepted=waived,
    )


def analyse_decays(
    campaign: DecayCampaign,
    records: Sequence[DecayRecord],
    *,
    path: Path | None = None,
    radiation: RadiationTable | None = None,
    progress: Progress | None = None,
) -> DecayAnalysis:
    """Analyse records that are in memory by the settings of a campaign.

    Parameters
    ----------
    campaign : DecayCampaign
    records : sequence of DecayRecord
        Whole records, one for each entry of the campaign.
    path : Path, optional
        Of the campaign file.
    radiation : RadiationTable, optional
        For the fit with memory beside the others.
    progress : callable, optional
    """
    groups: dict[str, list[DecayRecord]] = {}
    for entry, record in zip(campaign.records, records, strict=True):
        label = _label(campaign, entry)
        groups.setdefault(label, []).append(_free(campaign, entry, record))
    work = _Work(progress, len(groups) * (1 + len(campaign.fit.models) * len(campaign.fit.chosen_methods)))
    done = [_analyse(campaign, label, free, radiation, work) for label, free in groups.items()]
    return DecayAnalysis(campaign, path, tuple(done))


@dataclass
class _Work:
    """Counts the fits that are done."""

    progress: Progress | None
    total: int
    done: int = 0

    def step(self) -> None:
        self.done += 1
        if self.progress:
            self.progress("fitting", self.done, self.total)


def _label(campaign: DecayCampaign, entry: RecordEntry) -> str:
    parts: list[str] = [entry.motion]
    if entry.scale != 1.0:
        parts.append(f"1:{entry.scale:g}")
    if not campaign.fit.speed_terms:
        parts.append(f"{entry.speed:g} m/s")
    if entry.depth is not None:
        parts.append(f"depth {entry.depth:g} m")
    return ", ".join(parts)


def _free(campaign: DecayCampaign, entry: RecordEntry, record: DecayRecord) -> DecayRecord:
    """Free part of a record about its rest position."""
    choices = campaign.reduction
    try:
        return record.free_part(
            first_amplitude=_amplitude(choices.first_amplitude, record),
            last_amplitude=_amplitude(choices.last_amplitude, record),
            skip=choices.skip,
            start=entry.start,
            end=entry.end,
        ).centred(choices.offset)
    except FitError as error:
        raise FitError(
            error.cause, cure=error.cure, file=error.file or record.source or None, place=error.place
        ) from None


def _amplitude(value: float | None, record: DecayRecord) -> float | None:
    """An amplitude of the campaign, degrees or m, in the unit of the record."""
    return value if value is None or MOTION_UNITS[record.motion] == "m" else math.radians(value)


def _analyse(
    campaign: DecayCampaign,
    label: str,
    records: list[DecayRecord],
    radiation: RadiationTable | None,
    work: _Work,
) -> DecayGroup:
    found: list[Finding] = []
    fit = campaign.fit
    verdict = _verdict(campaign, records, found)
    work.step()
    restoring = fit.restoring
    if restoring == AUTO:
        restoring = verdict.restoring if verdict is not None else "linear"
    comparisons: dict[str, DecayComparison] = {}
    for place, words in enumerate(fit.models):
        methods = [one for one in fit.chosen_methods if place == 0 or not METHODS[one].linear_only]
        if not methods:
            continue
        comparisons[words] = _compare(campaign, records, words, restoring, methods, work)
        if verdict is not None and verdict.contradicts(words):
            found.append(
                Finding(
                    CONTRADICTED,
                    "warning",
                    f"the records contradict {words} damping; the fewest terms they support are {verdict.supported}",
                    place=label,
                    cure="see the table of models; the equivalent damping inside the record suffers least",
                )
            )
    memory = None
    if radiation is not None:
        first = next(iter(comparisons))
        memory = _with_memory(campaign, records, fit.make_model(first, restoring), radiation)
        results = {**comparisons[first].results, memory.fit.method: memory.fit}
        comparisons[first] = replace(comparisons[first], results=results)
    ratio = _ratio(records[0], found)
    group = DecayGroup(label, tuple(records), comparisons, verdict, ratio, None, memory=memory)
    found.extend(disagreements(group))
    ikeda = _beside_ikeda(campaign, group, found)
    return replace(group, ikeda=ikeda, findings=tuple(found))


def _with_memory(
    campaign: DecayCampaign, records: Sequence[DecayRecord], model: DampingModel, radiation: RadiationTable
) -> MemoryComparison:
    wanted = campaign.memory
    assert wanted is not None
    if records[0].motion != radiation.motion:
        raise CampaignError(
            f"the table of radiation is of {radiation.motion}, '{records[0].name}' is {records[0].motion}",
            cure="one campaign with memory holds one motion",
            place="[memory]",
        )
    return beside_memory(
        records,
        model,
        radiation,
        inertia=wanted.inertia,
        restoring=wanted.restoring,
        free=wanted.free,
        order=wanted.order,
    )


def _verdict(campaign: DecayCampaign, records: Sequence[DecayRecord], found: list[Finding]) -> ModelVerdict | None:
    fit = campaign.fit
    if fit.speed_terms or fit.fixed or fit.gz:
        return None
    try:
        return judge_models(records, restoring=None if fit.restoring == AUTO else fit.restoring)
    except TowtankError as error:
        found.append(Finding("models-not-judged", "warning", error.cause, records[0].source, cure=error.cure))
        return None


def _compare(
    campaign: DecayCampaign,
    records: Sequence[DecayRecord],
    words: str,
    restoring: str,
    methods: Sequence[str],
    work: _Work,
) -> DecayComparison:
    """One method after the other, so that progress can be told."""
    model = campaign.fit.make_model(words, restoring)
    cutoff = campaign.reduction.cutoff
    options = {} if cutoff is None else {"derivation": {"cutoff": cutoff}}
    results: dict[str, RollDamping] = {}
    failures: dict[str, str] = {}
    for method in methods:
        try:
            results.update(compare_methods(records, model, methods=[method], options=options).results)
        except FitError as error:
            failures[method] = f"{error.cause}" + (f" -> {error.cure}" if error.cure else "")
        work.step()
    if not results:
        method, reason = next(iter(failures.items()))
        raise FitError(
            f"no method could fit {words} damping; {method}: {reason}",
            file=records[0].source or None,
            place=records[0].name,
        )
    return DecayComparison(results, failures)


def disagreements(group: DecayGroup) -> Iterator[Finding]:
    """Fits whose equivalent damping leaves that of the preferred fit by more than both errors explain."""
    reference = group.preferred
    speed = group.records[0].speed
    for fit in group.results:
        if fit is reference or fit.model.names != reference.model.names:
            continue
        low = max(fit.diagnostics.amplitudes[0], reference.diagnostics.amplitudes[0])
        high = min(fit.diagnostics.amplitudes[1], reference.diagnostics.amplitudes[1])
        at = np.linspace(low, high, _COMPARED)
        one, other = fit.equivalent(at, speed=speed), reference.equivalent(at, speed=speed)
        off = one.alpha - other.alpha
        far = np.abs(off) > DISAGREEING * np.hypot(one.alpha_sd, other.alpha_sd)
        far &= np.abs(off) > DISAGREEING_PART * np.abs(other.alpha)
        if far.any():
            worst = int(np.argmax(np.abs(off / other.alpha) * far))
            yield Finding(
                DISAGREES,
                "warning",
                f"{100.0 * off[worst] / other.alpha[worst]:+.0f} % of the equivalent damping away from the "
                f"{reference.method} fit at the amplitude {at[worst]:.3g}, beyond the errors of both",
                place=fit.method,
                cure=f"quote the {reference.method} fit",
            )


def _ratio(record: DecayRecord, found: list[Finding]) -> DecayRatio | None:
    try:
        ratio = decay_ratio(record)
    except TowtankError as error:
        found.append(Finding("no-damping-ratio", "info", error.cause, record.source, cure=error.cure))
        return None
    found.extend(replace(item, severity="info") for item in ratio.findings)
    return ratio


def _beside_ikeda(campaign: DecayCampaign, group: DecayGroup, found: list[Finding]) -> IkedaComparison | None:
    settings, own = campaign.ikeda, campaign.make_ship()
    record = group.records[0]
    if settings is None or own is None or record.motion != "roll":
        return None
    ship = record.ship if record.ship is not None else own
    size = own.scale / ship.scale
    try:
        hull = IkedaHull.of_ship(
            ship,
            settings.midship_coefficient,
            keel_breadth=settings.keel_breadth * size,
            keel_length=settings.keel_length * size,
        )
        return beside_ikeda(
            group.preferred,
            hull,
            _within(group.preferred, campaign.output.points),
            speed=record.speed,
            viscosity=settings.viscosity,
        )
    except TowtankError as error:
        raise CampaignError(error.cause, cure=error.cure or "complete [ship]", place="[ikeda]") from None


def _within(fit: RollDamping, points: int) -> np.ndarray:
    low, high = fit.diagnostics.amplitudes
    return np.linspace(low, high, points)
