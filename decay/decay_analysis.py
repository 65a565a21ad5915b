"""From decay campaigns to damping: records cut and centred, models judged, methods compared, Ikeda beside them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import CampaignError, FitError, TowtankError
from ..core.findings import Finding
from ..core.ship import Ship
from .compare import DEFAULT_METHOD, METHODS, DecayComparison, compare_methods
from .damping_models import MOTION_UNITS
from .decay_campaign import AUTO, DecayCampaign, RecordEntry, load_decay_campaign
from .decay_input import read_decay
from .decay_record import DecayRecord
from .heave_pitch import DecayRatio, decay_ratio
from .ikeda import IkedaHull
from .ikeda_comparison import IkedaComparison, beside_ikeda
from .model_verdict import ModelVerdict, judge_models
from .roll_damping import RollDamping

if TYPE_CHECKING:
    import pandas as pd

Progress = Callable[[str, int, int], None]

DISAGREES = "methods-disagree"
DISAGREEING, DISAGREEING_PART = 3.0, 0.05
"""Standard errors, and part of the damping, by which a method must differ from the preferred one to be told."""
_COMPARED = 9


@dataclass(frozen=True, eq=False)
class DecayGroup:
    """Records of one motion, scale, speed and depth, fitted together.

    Attributes
    ----------
    label : str
    records : tuple of DecayRecord
        Free parts, centred; each keeps the whole of its record.
    comparisons : mapping of str to DecayComparison
        By damping model in words.
    verdict : ModelVerdict, optional
        None when no model could be judged.
    ratio : DecayRatio, optional
        Damping ratio and natural frequency of the first record for a simulator.
    ikeda : IkedaComparison, optional
    findings : tuple of Finding
        About the group beside those of the single fits.
    """

    label: str
    records: tuple[DecayRecord, ...]
    comparisons: Mapping[str, DecayComparison]
    verdict: ModelVerdict | None
    ratio: DecayRatio | None
    ikeda: IkedaComparison | None
    findings: tuple[Finding, ...] = ()

    @property
    def results(self) -> list[RollDamping]:
        """Every fit, by model and method."""
        return [one for comparison in self.comparisons.values() for one in comparison.results.values()]

    @property
    def failures(self) -> dict[str, str]:
        """Methods that raised, with the reason, by ``method (model)``."""
        return {
            f"{method} ({words})": reason
            for words, comparison in self.comparisons.items()
            for method, reason in comparison.failures.items()
        }

    @property
    def preferred(self) -> RollDamping:
        """The fit to quote: the integration fit of the first model, or else the trusted one with the highest R2."""
        first = next(iter(self.comparisons.values())).results
        if DEFAULT_METHOD in first:
            return first[DEFAULT_METHOD]
        return max(first.values(), key=lambda one: (one.trusted, one.diagnostics.r2))

    def doubts(self, fit: RollDamping) -> tuple[str, ...]:
        """Rules that warn against one of the fits; empty when it may be trusted."""
        rules = [item.rule for item in fit.findings if item.severity != "info"]
        rules += [item.rule for item in self.findings if item.rule == DISAGREES and item.place == fit.method]
        return tuple(dict.fromkeys(rules)) or (() if fit.trusted else ("not-converged",))

    @property
    def all_findings(self) -> list[Finding]:
        """Those of the records, of the group and of the fits, each once."""
        found = [item for one in self.records for item in one.findings]
        found += [*self.findings, *(self.ikeda.findings if self.ikeda is not None else ())]
        for one in self.results:
            found += [replace(item, place=one.method) for item in one.findings]
        return list(dict.fromkeys(found))


@dataclass(frozen=True, eq=False)
class DecayAnalysis:
    """What a decay campaign yields.

    Attributes
    ----------
    campaign : DecayCampaign
    path : Path, optional
        Of the campaign file.
    groups : tuple of DecayGroup
    """

    campaign: DecayCampaign
    path: Path | None
    groups: tuple[DecayGroup, ...]

    @property
    def truth(self) -> Mapping[str, float]:
        """True coefficients of virtual records; empty for measured ones."""
        return self.campaign.decay.truth

    def damping_frame(self) -> pd.DataFrame:
        """Columns ``method, model, name, value, std, lower95, upper95, unit``; with several groups also ``group``."""
        return self._stacked(lambda group: [one.table() for one in group.results])

    def equivalent_frame(self) -> pd.DataFrame:
        """Equivalent damping against amplitude of every method, units in the column names.

        B44 and B44-hat are there where the ship's volume and GM are known.
        """
        points = self.campaign.output.points

        def frames(group: DecayGroup) -> list[pd.DataFrame]:
            return [equivalent_rows(one, points, group.records[0].speed) for one in group.results]

        return self._stacked(frames)

    def _stacked(self, frames: Callable[[DecayGroup], list[pd.DataFrame]]) -> pd.DataFrame:
        import pandas as pd

        tables = []
        for group in self.groups:
            for frame in frames(group):
                tables.append(frame.assign(group=group.label) if len(self.groups) > 1 else frame)
        return pd.concat(tables, ignore_index=True)

    def to_dict(self) -> dict[str, Any]:
        """Everything but the series, for JSON."""
        return {
            "format": "towtank damping 1",
            "name": self.campaign.decay.name,
            "virtual": self.campaign.decay.virtual,
            "truth": dict(self.truth),
            "groups": [_group_dict(group) for group in self.groups],
        }


def equivalent_rows(fit: RollDamping, points: int, speed: float) -> pd.DataFrame:
    """Equivalent damping of one fit over the amplitudes of its records, with B44 where the ship is known."""
    low, high = fit.diagnostics.amplitudes
    at = np.linspace(low, high, points)
    frame = fit.equivalent(at, speed=speed).to_frame()
    if is_dimensional(fit):
        more = fit.dimensional(at, speed=speed)
        frame = frame.assign(**{name: more[name] for name in more.columns if name.startswith("B44")})
    frame.insert(0, "method", fit.method)
    frame.insert(1, "model", fit.model.label)
    return frame


def is_dimensional(fit: RollDamping) -> bool:
    """Whether B44 can be given: roll of a ship whose volume and GM are known."""
    ship = fit.ship
    return (
        fit.motion == "roll"
        and ship is not None
        and ship.displacement_mass is not None
        and ship.GM is not None
        and ship.GM > 0.0
    )


def _group_dict(group: DecayGroup) -> dict[str, Any]:
    verdict, ratio, ikeda = group.verdict, group.ratio, group.ikeda
    return {
        "label": group.label,
        "records": [
            {"name": one.name, "file": one.source, "sha256": one.sha256, "steps": list(one.steps)}
            for one in group.records
        ],
        "preferred": {"method": group.preferred.method, "model": group.preferred.model.label},
        "models": None
        if verdict is None
        else {"supported": verdict.supported, "table": verdict.to_frame().to_dict("records")},
        "damping_ratio": None
        if ratio is None
        else {
            "zeta": ratio.zeta,
            "zeta_std": ratio.zeta_sd,
            "zeta_light": ratio.zeta_light,
            "omega_n [rad/s]": ratio.omega_n,
            "omega_n_std [rad/s]": ratio.omega_n_sd,
        },
        "ikeda": None if ikeda is None else ikeda.table.to_dict("list"),
        "results": [one.to_dict() for one in group.results],
        "failures": group.failures,
        "findings": [vars(item) for item in group.all_findings],
    }


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
    path = None
    if not isinstance(campaign, DecayCampaign):
        path = Path(campaign)
        campaign = load_decay_campaign(path)
    start = Path(folder) if folder is not None else path.parent if path is not None else Path()
    waived = (*campaign.accept, *accept)
    records = []
    for number, entry in enumerate(campaign.records):
        if progress:
            progress("reading", number, len(campaign.records))
        records.append(_read(campaign, entry, start, waived))
    if progress:
        progress("reading", len(records), len(records))
    return analyse_decays(campaign, records, path=path, progress=progress)


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
    progress : callable, optional
    """
    groups: dict[str, list[DecayRecord]] = {}
    for entry, record in zip(campaign.records, records, strict=True):
        label = _label(campaign, entry)
        groups.setdefault(label, []).append(_free(campaign, entry, record))
    work = _Work(progress, len(groups) * (1 + len(campaign.fit.models) * len(campaign.fit.chosen_methods)))
    done = [_analyse(campaign, label, free, work) for label, free in groups.items()]
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


def _analyse(campaign: DecayCampaign, label: str, records: list[DecayRecord], work: _Work) -> DecayGroup:
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
                    "model-contradicted",
                    "warning",
                    f"the records contradict {words} damping; the fewest terms they support are {verdict.supported}",
                    place=label,
                    cure="see the table of models; the equivalent damping inside the record suffers least",
                )
            )
    group = DecayGroup(label, tuple(records), comparisons, verdict, _ratio(records[0], found), None)
    found.extend(disagreements(group))
    ikeda = _beside_ikeda(campaign, group, found)
    return replace(group, ikeda=ikeda, findings=tuple(found))


def _verdict(campaign: DecayCampaign, records: Sequence[DecayRecord], found: list[Finding]) -> ModelVerdict | None:
    fit = campaign.fit
    if fit.speed_terms or fit.fixed:
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


def ship_of(analysis: DecayAnalysis) -> Ship | None:
    """The ship of the first group at the scale of its records."""
    return analysis.groups[0].records[0].ship
