"""Loads of a case to means or harmonics with their errors; a run that has not settled stops a fit unless waived."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError, ReadError
from ..core.findings import Finding, stop_on_error
from ..formats import read_solver_case
from ..formats.run_order import tells_run_order
from ..identify.autocorrelation import mean_with_error
from ..identify.batch_means import batch_means
from ..identify.settling import ChannelSettling, Settling, settle
from ..identify.transient import MIN_SAMPLES
from .case_history import history_of
from .case_loads import LOADS, CaseLoads, LoadChoices, case_loads
from .case_sweep import CaseSweep, SweepCase

if TYPE_CHECKING:
    import pandas as pd

OWN_SHARE = 0.01
"""Drift that does not matter, as part of the load's own root mean square ..."""

GROUP_SHARE = 0.002
"""... or of the largest of X, Y (of K, M, N for moments), so that the sway force at zero drift can settle at all."""

GROUPS = (("X", "Y"), ("K", "M", "N"))
STOPPING = {"still drifting": "still-drifting", "too short": "too-short", "diverged": "diverged"}
"""Verdicts that stop a fit, and the rules they come under."""

FITTED = ("X", "Y", "N")
"""Loads that a manoeuvring model is fitted to, and whose verdicts count."""

PART_NOTE = "as the whole load"
"""Pressure, viscous and porous parts have the window and the verdict of their load."""

SETTLED_COLUMNS = (
    "case",
    "load",
    "unit",
    "mean",
    "se",
    "U95",
    "n_eff",
    "batch_se",
    "cut_time",
    "end_time",
    "verdict",
    "remaining_drift",
    "drift_se",
    "amplitude",
    "amplitude_se",
    "period",
    "cycles_dropped",
    "standard_uncertainty",
    "note",
)


@dataclass(frozen=True, eq=False)
class SettledCase:
    """Verdict and means of one case.

    Attributes
    ----------
    case : SweepCase
    loads : CaseLoads
        Histories behind the means.
    names : tuple of str
        Loads and their parts, in the order of `settling.channels`.
    settling : Settling
    waived : bool
        True when the user waived the verdict of this case by name.
    """

    case: SweepCase
    loads: CaseLoads
    names: tuple[str, ...]
    settling: Settling
    waived: bool = False

    def __getitem__(self, name: str) -> ChannelSettling:
        return self.settling.channels[self.names.index(name)]

    @property
    def fitted(self) -> tuple[str, ...]:
        """Loads whose verdict counts: X, Y and N as far as they are there, else all totals or columns."""
        if self.loads.history:
            return self.names
        present = tuple(name for name in FITTED if name in self.names)
        return present or tuple(name for name in LOADS if name in self.names)

    @property
    def verdict(self) -> str:
        """The worst verdict of the loads that are fitted."""
        found = {self[name].verdict for name in self.fitted}
        for verdict in ("diverged", "still drifting", "too short", "periodic"):
            if verdict in found:
                return verdict
        return "settled"

    def to_frame(self) -> pd.DataFrame:
        """One row a load: :data:`SETTLED_COLUMNS`."""
        import pandas as pd

        rows = [_row(self, name, channel) for name, channel in zip(self.names, self.settling.channels)]
        return pd.DataFrame(rows, columns=list(SETTLED_COLUMNS))


def read_case(case: SweepCase, choices: LoadChoices, *, history: str = "") -> CaseLoads:
    """Loads of one case of a sweep, or another history of it.

    Parameters
    ----------
    case : SweepCase
    choices : LoadChoices
    history : str
        Name of a history (motion, probes, surface elevation, residuals, monitor) to take instead of the loads.

    Raises
    ------
    ReadError
        Naming the file, the place and the cure.
    """
    if history:
        return history_of(read_solver_case(case.path), history, case.name)
    objects = None if choices.object is None else [choices.object]
    read = read_solver_case(case.path, objects=objects, channels=dict(choices.columns) or None)
    return case_loads(read, choices, drift_angle=math.radians(case.drift_angle))


def settle_case(
    case: SweepCase,
    loads: CaseLoads,
    *,
    omega: float | None = None,
    start: float | None = None,
    waive: Iterable[str] = (),
) -> SettledCase:
    """Cut the transient of a case, judge it, and give means with errors.

    The cut is the latest that X, Y, Z, K, M and N ask for; pressure and viscous parts use the same. Drift within 1 % of
    a load, or 0.2 % of the largest of its group, does not matter.

    Parameters
    ----------
    case : SweepCase
    loads : CaseLoads
    omega : float, optional
        Frequency of a forced motion in rad/s.
    start : float, optional
        Cut here instead, s.
    waive : iterable of str
        Cases whose verdict the user waives, by name.

    Raises
    ------
    FitError
        If time does not increase or `start` leaves nothing.
    """
    totals = list(loads.loads)
    parts = [name for name in loads.channels if name not in totals]
    table = np.column_stack([loads.channels[name] for name in totals])
    if loads.diverged_at is not None:
        # The reader left the rows behind the divergence out; the verdict must not forget them.
        table = np.vstack([table, np.full((1, table.shape[1]), np.nan)])
        time = np.append(loads.time, max(loads.diverged_at, np.nextafter(loads.time[-1], np.inf)))
        return SettledCase(case, loads, tuple(totals), settle(time, table), False)
    try:
        judged = settle(loads.time, table, omega=omega, start=start, tolerance=_tolerances(totals, table))
    except FitError as error:
        raise FitError(error.cause, cure=error.cure, file=case.path, place=error.place) from None
    settled = SettledCase(case, loads, tuple(totals), judged, case.name in set(waive))
    if not parts or judged.verdict == "diverged" or not math.isfinite(judged.cut_time):
        return settled
    kept = loads.time >= judged.cut_time
    of_total = dict(zip(totals, judged.channels))
    shares = [
        _part_mean(loads.channels[name][kept], of_total[name[0]])
        if of_total[name[0]].cycles is None
        else _part_cycles(loads.time, loads.channels[name], of_total[name[0]], judged.cut_time)
        for name in parts
    ]
    both = replace(judged, channels=(*judged.channels, *shares))
    return SettledCase(case, loads, (*totals, *parts), both, settled.waived)


def _part_mean(values: np.ndarray, total: ChannelSettling) -> ChannelSettling:
    """Mean of a pressure, viscous or porous part over the window of its load, with the verdict of the load."""
    found = mean_with_error(values)
    return replace(
        total,
        mean=float(found.mean),
        se=float(found.se),
        dof=float(found.dof),
        n_eff=float(found.n_eff),
        batch_se=batch_means(values).se if values.size >= MIN_SAMPLES else math.nan,
        drift=math.nan,
        drift_se=math.nan,
        time_constant=math.nan,
        cycles=None,
        amplitude=math.nan,
        amplitude_se=math.nan,
        note=PART_NOTE,
    )


def _part_cycles(time: np.ndarray, values: np.ndarray, total: ChannelSettling, cut: float) -> ChannelSettling:
    """Mean and harmonics of a part of a periodic load over the same whole cycles, with the verdict of the load."""
    assert total.cycles is not None
    (own,) = settle(time, values, omega=total.cycles.omega, start=cut).channels
    return replace(own, verdict=total.verdict, note=PART_NOTE)


def _tolerances(names: Sequence[str], table: np.ndarray) -> list[float]:
    later = table[table.shape[0] // 2 :]
    if not np.isfinite(later).all():
        return [0.0] * len(names)
    level = dict(zip(names, np.sqrt((later**2).mean(axis=0)).tolist()))
    largest = {
        name: max(level[other] for other in group if other in level)
        for group in GROUPS
        for name in group
        if name in level
    }
    return [max(OWN_SHARE * level[name], GROUP_SHARE * largest.get(name, 0.0)) for name in names]


def settling_findings(cases: Iterable[SettledCase]) -> list[Finding]:
    """Errors for cases that have not settled, accepted where the user waived the case; warnings on doubtful run orders.

    A diverged case has no mean and cannot be waived.
    """
    findings = []
    for item in cases:
        findings += _run_order_findings(item)
        rule = STOPPING.get(item.verdict)
        if rule is None:
            continue
        worst = next(name for name in item.fitted if item[name].verdict == item.verdict)
        cure = {
            "still-drifting": f"run longer, or waive it knowingly with --waive {item.case.name}",
            "too-short": f"run longer, or waive it knowingly with --waive {item.case.name}",
            "diverged": "mend the computation, or leave the case out",
        }[rule]
        findings.append(
            Finding(
                rule,
                "error",
                f"{worst} of case '{item.case.name}': {item.verdict}: {item[worst].note}",
                file=str(item.case.path),
                place=item.case.name,
                cure=cure,
                accepted=item.waived and rule != "diverged",
            )
        )
    return findings


def _run_order_findings(item: SettledCase) -> list[Finding]:
    """Warnings where a case was run again and folders of the run before were left in place."""
    return [
        Finding(
            "run-order",
            "warning",
            note,
            file=str(item.case.path),
            place=item.case.name,
            cure="move folders of another run away",
        )
        for note in item.loads.notes
        if tells_run_order(note)
    ]


def require_settled(cases: Sequence[SettledCase]) -> None:
    """Refuse to go on with cases that have not settled and are not waived.

    Raises
    ------
    FitError
        Naming the case, the load, the remaining drift and the cure.
    """
    findings = settling_findings(cases)
    waiting = [item for item in findings if item.severity == "error" and not item.accepted]
    if waiting:
        first = waiting[0]
        more = f" (and {len(waiting) - 1} more cases)" if len(waiting) > 1 else ""
        raise FitError(f"[{first.rule}] {first.message}{more}", cure=first.cure, file=first.file)


def settle_sweep(
    sweep: CaseSweep,
    choices: LoadChoices | None = None,
    *,
    omega: float | None = None,
    start: float | None = None,
    waive: Iterable[str] = (),
    history: str = "",
    progress: Any = None,
) -> tuple[SettledCase, ...]:
    """Read and settle all cases of a sweep, one after the other.

    Parameters
    ----------
    sweep : CaseSweep
        Double cases stop here.
    choices, omega, start, waive
        As in :func:`settle_case`.
    history : str
        As in :func:`read_case`.
    progress : callable, optional
        ``progress(what, done, total)``.

    Raises
    ------
    AuditError
        For a double case.
    ReadError, FitError
        For a case that cannot be read or judged; `waive` of a case that is not there.
    """
    stop_on_error(sweep.findings)
    waived = list(waive)
    names = [case.name for case in sweep.cases]
    strangers = [name for name in waived if name not in names]
    if strangers:
        raise ReadError(f"there is no case '{strangers[0]}' to waive", cure=f"cases are {', '.join(names[:8])}")
    settled = []
    for number, case in enumerate(sweep.cases):
        if progress:
            progress("settling", number, len(sweep.cases))
        loads = read_case(case, choices or LoadChoices(), history=history)
        settled.append(settle_case(case, loads, omega=omega, start=start, waive=waived))
    if progress:
        progress("settling", len(sweep.cases), len(sweep.cases))
    return tuple(settled)


def settled_table(cases: Sequence[SettledCase]) -> pd.DataFrame:
    """All loads of all cases, one row each: :data:`SETTLED_COLUMNS`."""
    import pandas as pd

    return pd.concat([item.to_frame() for item in cases], ignore_index=True)


def points_table(cases: Sequence[SettledCase]) -> pd.DataFrame:
    """Means as reduced points of a captive campaign: name, beta [deg], r', speed, X, Y, N and standard uncertainties.

    The ``_sd`` columns hold the standard error of the mean together with a remaining drift; home signs, N and N m at
    midship.

    Raises
    ------
    FitError
        If a case has not settled and is not waived.
    """
    import pandas as pd

    require_settled(cases)
    rows = []
    for item in cases:
        if item.loads.history:
            raise FitError(
                f"'{item.loads.history}' of case '{item.case.name}' holds no loads",
                cure="points are of forces: settle the cases without --history",
            )
        row: dict[str, Any] = {
            "name": item.case.name,
            "beta": item.case.drift_angle,
            "rprime": item.case.yaw_rate,
            "speed": item.case.speed,
        }
        for name in item.fitted:
            row[name] = item[name].mean
            row[f"{name}_sd"] = item[name].standard_uncertainty
        rows.append(row)
    return pd.DataFrame(rows)


def _row(item: SettledCase, name: str, channel: ChannelSettling) -> Mapping[str, Any]:
    cycles = channel.cycles
    values = (
        item.case.name,
        name,
        item.loads.unit(name),
        channel.mean,
        channel.se,
        channel.half_width(),
        channel.n_eff,
        channel.batch_se,
        item.settling.cut_time,
        item.settling.end_time,
        channel.verdict,
        channel.drift,
        channel.drift_se,
        channel.amplitude,
        channel.amplitude_se,
        math.nan if cycles is None else 2.0 * math.pi / cycles.omega,
        math.nan if cycles is None else float(cycles.drop),
        channel.standard_uncertainty,
        channel.note,
    )
    return dict(zip(SETTLED_COLUMNS, values, strict=True))
