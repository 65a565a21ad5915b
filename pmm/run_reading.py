"""Files of a campaign read, audited and reduced: runs, zero runs, runs in air."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import CampaignError, ReadError, TowtankError
from ..core.findings import Finding, accept, stop_on_error
from ..core.record import Record
from ..core.ship import Ship
from ..formats.channels import ChannelMap, rotate_to_model
from ..formats.dialect import Dialect
from ..formats.raw_table import RawTable
from ..formats.read import read_table
from ..identify.autocorrelation import mean_with_error
from .audit_record import audit_record, audit_table
from .campaign_file import CampaignFile
from .planar_motion import prescribed_motion
from .reduced_run import FORCES, ReducedRun
from .reduction import ReductionPlan, home_axes, reduce_run, zero_level
from .rigid_body import RigidBody, identify_rigid_body
from .run_types import Run


@dataclass(frozen=True, eq=False)
class RunReader:
    """Reads the files of one campaign.

    Attributes
    ----------
    settings : CampaignFile
    path : Path
        The campaign file; names of files are kept relative to its folder.
    ship : Ship
    conventions : Conventions
        Axes and signs of the data.
    waived : frozenset of str
        Audit rules that the user accepts.
    large : bool
        The campaign holds so much text that compiled code is worth its start.
    digests : dict of str to str
        sha256 of every file read so far.
    findings : list of Finding
        What was seen in files that are no runs to fit: zero runs and runs in air.
    zero_sd : dict of str to dict
        Standard errors of the zero levels in N and N m, by name of the zero run.
    """

    settings: CampaignFile
    path: Path
    ship: Ship
    conventions: Conventions
    waived: frozenset[str] = frozenset()
    large: bool = False
    digests: dict[str, str] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    zero_sd: dict[str, dict[str, float]] = field(default_factory=dict)
    # How the text files of each ending were understood: the next file is read faster with it.
    _dialects: dict[str, Dialect] = field(default_factory=dict)
    # Zero levels in the axes of the carriage, by name of the zero run, to be turned with the model.
    _carriage_zeros: dict[str, Mapping[str, float]] = field(default_factory=dict)

    @property
    def channels(self) -> ChannelMap:
        """The channel map of the campaign."""
        assert self.settings.channels is not None
        return self.settings.channels

    # -- runs ------------------------------------------------------------------------------------------------

    def read_and_reduce(self, run: Run, plan: ReductionPlan) -> ReducedRun:
        """One run from its file to its means or harmonics.

        Raises
        ------
        TowtankError
            For bad input, or an error of the audit that is not waived.
        """
        record, findings = self._record(run)
        accepted = tuple(accept(findings, self.waived))
        stop_on_error(accepted)
        result = reduce_run(record, self._without_tare(run), plan, accepted)
        return replace(result, run=replace(result.run, tare=run.tare), zero_sd=self.zero_sd.get(run.tare, {}))

    def look_at(self, run: Run, plan: ReductionPlan) -> tuple[tuple[Finding, ...], ReducedRun | None]:
        """All findings about one run, and what it reduces to when no error among them makes that senseless."""
        record, seen = self._record(run)
        findings = tuple(accept(seen, self.waived))
        if any(item.severity == "error" and not item.accepted for item in findings):
            return findings, None
        return findings, reduce_run(record, self._without_tare(run), plan, findings)

    def _record(self, run: Run) -> tuple[Record, list[Finding]]:
        """Record in SI in the axes of the data, with the findings about header and channels."""
        assert run.file is not None
        table = self._table(run.file)
        findings = list(audit_table(table, run, ship=self.ship))
        psi = None
        if self.channels.forces == "carriage-fixed" and "psi" not in self.channels.channels:
            psi = self._heading(run, self.channels.only("time").apply(table).time)
        record = self.channels.apply(table, psi=psi)
        if run.tare in self._carriage_zeros:
            record = self._turned_zero_taken_off(record, run, psi)
        turned = home_axes(record, self.conventions)
        findings += audit_record(turned, run, self.ship, reference=self.settings.reduction.position_x)
        return record, findings

    def _without_tare(self, run: Run) -> Run:
        """The run as the reduction sees it: a zero in the axes of the carriage is off already."""
        return replace(run, tare="") if run.tare in self._carriage_zeros else run

    def _table(self, path: Path, channels: ChannelMap | None = None) -> RawTable:
        reader, channels = self.settings.reader, channels or self.channels
        try:
            table = read_table(
                path,
                dialect=self._dialects.get(path.suffix),
                format=reader.format,
                sheet=reader.sheet,
                group=reader.group,
                columns=channels.expected_columns(),
                compiled=self.large,
            )
        except ReadError as error:
            named = (
                key for key, one in channels.channels.items() if error.cause.endswith(f"column {one.column!r}")
            )
            place = error.place or next((f"channel {key}" for key in named), "")
            raise ReadError(error.cause, cure=error.cure, file=error.file or path, place=place) from None
        if table.dialect is not None:
            self._dialects[path.suffix] = table.dialect
        self.digests[self.name_of(path)] = table.sha256
        return table

    def name_of(self, path: Path) -> str:
        """Name of a file relative to the campaign file."""
        return Path(os.path.relpath(path, self.path.parent)).as_posix()

    def _heading(self, run: Run, time: np.ndarray) -> np.ndarray:
        """Prescribed heading against the carriage at the given times in rad, in the axes of the data."""
        psi = prescribed_motion(run, self.settings.reduction.position_x).at(time)["psi"] - run.yaw_rate * time
        return -psi if self.conventions.axes == "forward-port-up" else psi

    # -- zero runs -------------------------------------------------------------------------------------------

    def zero_levels(self, runs: Sequence[Run], plan: ReductionPlan) -> dict[str, Mapping[str, float]]:
        """Zero levels of the forces in N and N m, home axes, by name of the zero run.

        Levels in the axes of the carriage are kept apart: they are turned with the model and taken off when a run is
        read.

        Raises
        ------
        CampaignError
            For a zero run that does not exist.
        """
        levels: dict[str, Mapping[str, float]] = {}
        if not any(run.tare for run in runs):
            return levels
        by_name = {run.name: run.file for run in runs}
        fixed = self.channels.forces == "carriage-fixed"
        channels = self.channels.model_copy(update={"forces": "model-fixed"})
        for run in runs:
            if not run.tare or run.tare in levels or run.tare in self._carriage_zeros:
                continue
            path = by_name.get(run.tare) or self.path.parent / run.tare
            if not path.is_file():
                raise CampaignError(
                    f"zero run '{run.tare}' not found",
                    cure="name a run or a file of the campaign",
                    file=self.path,
                    place=f"run '{run.name}', tare",
                )
            table = self._table(path, channels)
            findings = accept(audit_table(table, None, ship=self.ship), self.waived)
            stop_on_error(findings)
            self.findings.extend(findings)
            record = channels.apply(table)
            if fixed:
                self._carriage_zeros[run.tare] = _means(record)
            else:
                levels[run.tare] = zero_level(record, plan)
            for name, level in (self._carriage_zeros if fixed else levels)[run.tare].items():
                if not np.isfinite(level):
                    raise ReadError(
                        f"{name} holds values that are missing",
                        cure="cut or fill them, or name another zero run",
                        file=path,
                        place=f"channel {name}",
                    )
            self.zero_sd[run.tare] = {
                name: float(mean_with_error(record[name]).se) for name in FORCES if name in record
            }
        return levels

    def _turned_zero_taken_off(self, record: Record, run: Run, psi: np.ndarray | None) -> Record:
        level = self._carriage_zeros[run.tare]
        along, across = rotate_to_model(level["X"], level["Y"], record["psi"] if psi is None else psi)
        zero = {**level, "X": along, "Y": across}
        changed = {name: record[name] - value for name, value in zero.items()}
        return record.with_channels(
            f"zero level of '{run.tare}' subtracted in the axes of the carriage", **changed
        )

    # -- runs in air -----------------------------------------------------------------------------------------

    def rigid_body(self, runs: Sequence[Run], plan: ReductionPlan) -> RigidBody | None:
        """What hangs on the balance: as given, or identified from the runs in air; None when it is not felt.

        Raises
        ------
        CampaignError
            When there is no run in air to identify it from.
        """
        inertia = self.settings.inertia
        if not inertia.inside:
            return None
        if not inertia.dry_runs:
            assert inertia.mass is not None
            assert inertia.Izz is not None
            return RigidBody(inertia.mass + inertia.mount_mass, inertia.xG, inertia.Izz)
        dry = [run for run in runs if run.dry]
        if not dry:
            raise CampaignError(
                "inertia.dry_runs is true but there is no run in air",
                cure="add runs of type dry_sway and dry_yaw",
                file=self.path,
                place="[inertia]",
            )
        plan = replace(plan, keep_series=frozenset(run.name for run in dry))
        pairs = []
        for run in dry:
            result = self.read_and_reduce(run, plan)
            self.findings.extend(result.findings)
            pairs.append((result.motion.at(result.window.times), result.series))
        try:
            return identify_rigid_body(pairs)
        except TowtankError as error:
            raise type(error)(
                error.cause, cure=error.cure, file=error.file or self.path, place=error.place or "runs in air"
            ) from None


def _means(record: Record) -> dict[str, float]:
    return {name: float(np.mean(record[name])) for name in FORCES if name in record}
