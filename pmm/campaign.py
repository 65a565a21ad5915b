"""A captive-test campaign from its file to its result: the default pipeline of the package."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

from ..core.conventions import Conventions, preset
from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, TowtankError
from ..core.findings import Finding, accept, stop_on_error
from ..core.provenance import Provenance, file_hash, program_versions
from ..core.record import Record
from ..core.ship import Ship
from ..core.terms import Term
from ..formats.channels import ChannelMap
from ..formats.dialect import Dialect
from ..formats.read import read_table
from ..formats.stream import iter_records
from .audit_campaign import audit_campaign
from .audit_record import audit_record, audit_table
from .campaign_file import CampaignFile, candidate_terms, load_campaign_file
from .campaign_result import CampaignResult
from .hull_fit import HullFit, default_terms, fit_hull
from .planar_motion import prescribed_motion
from .points import read_points
from .reduced_run import ReducedRun
from .reduction import ReductionPlan, home_axes, reduce_run, zero_level
from .rigid_body import RigidBody, identify_rigid_body
from .run_summary import run_summary
from .run_types import Run
from .test_matrix import expand_runs

_BYTES_WORTH_PROCESSES = 200e6
"""Campaigns with more bytes are read in processes, which start slowly but share no interpreter lock."""

Progress = Callable[[str, int, int], None]
"""Called with what is being done, how many are done, how many there are."""


@dataclass(frozen=True, eq=False)
class Campaign:
    """A campaign file and the folder it lives in.

    Examples
    --------
    >>> campaign = Campaign.load("campaign.toml")        # doctest: +SKIP
    >>> result = campaign.run()                          # doctest: +SKIP
    >>> print(result.derivatives.summary())              # doctest: +SKIP
    """

    file: CampaignFile
    path: Path

    @classmethod
    def load(cls, path: str | Path) -> Campaign:
        """Read and validate a campaign file.

        Raises
        ------
        CampaignError
            Naming the file and the key at fault.
        """
        return cls(load_campaign_file(path), Path(path))

    @property
    def folder(self) -> Path:
        """Folder that file names start from."""
        return self.path.parent

    @cached_property
    def ship(self) -> Ship:
        """The ship tested."""
        return self.file.make_ship()

    @cached_property
    def conventions(self) -> Conventions:
        """Conventions of the data and of the test matrix."""
        return self.file.make_conventions()

    @cached_property
    def runs(self) -> tuple[Run, ...]:
        """All runs with files, in the order of the campaign file."""
        return tuple(expand_runs(self.file.runs, self.folder, self.conventions, self.path))

    @cached_property
    def _dialects(self) -> dict[str, Dialect]:
        """How the text files of each ending were understood: the next file is read faster with it."""
        return {}

    def run(
        self,
        *,
        accept_rules: Iterable[str] = (),
        progress: Progress | None = None,
        workers: int = 2,
        compare: bool = True,
    ) -> CampaignResult:
        """Read, audit, reduce and fit the campaign.

        Parameters
        ----------
        accept_rules : iterable of str
            Audit rules that the user waives.
        progress : callable, optional
            ``progress(what, done, total)``.
        workers : int
            Threads that read and reduce.
        compare : bool
            Also fit the single-run and multiple-run ways, the candidates and the range limits.

        Returns
        -------
        CampaignResult

        Raises
        ------
        TowtankError
            For bad input; nothing is written here.
        """
        waived = frozenset(accept_rules) | set(self.file.accept)
        reduced, body, digests = self.reduce(waived, progress=progress, workers=workers)
        findings = [finding for run in reduced for finding in run.findings]
        groups = self._grouped(reduced)
        prior = self._prior()
        fits: list[HullFit] = []
        for number, (label, runs) in enumerate(groups.items(), start=1):
            if progress:
                progress("fitting", number - 1, len(groups))
            fits.append(self._fit(label, runs, prior, digests, waived, body))
            findings += self._cross_audit(fits[-1], waived)
        if progress:
            progress("fitting", len(groups), len(groups))
        stop_on_error(findings)
        fits = [self._finished(fit, findings, waived) for fit in fits]
        comparisons = self._comparisons(fits, progress) if compare else {}
        return CampaignResult(
            campaign=self.file.campaign,
            path=self.path,
            settings=self.file,
            fits=tuple(fits),
            runs=tuple(reduced),
            findings=tuple(findings),
            rigid_body=body,
            comparisons=comparisons,
        )

    # -- reading ---------------------------------------------------------------------------------------------

    def reduce(
        self, waived: frozenset[str] = frozenset(), *, progress: Progress | None = None, workers: int = 2
    ) -> tuple[list[ReducedRun], RigidBody | None, dict[str, str]]:
        """Read, audit and reduce every run.

        Returns
        -------
        runs : list of ReducedRun
        body : RigidBody or None
            What hangs on the balance, when its inertia was subtracted.
        digests : dict of str to str
            sha256 of every input file.
        """
        settings = self.file.reduction
        digests = {self.path.name: file_hash(self.path)}
        plan = ReductionPlan(settings, self.ship, self.conventions)
        plan = replace(plan, tare=self._tare(plan))
        body = self._rigid_body(plan, waived)
        wet = [run for run in self.runs if not run.dry]
        plan = replace(
            plan,
            inertia=body,
            terms=self._terms_wanted(),
            keep_series=self._shown(wet),
            time_domain=self.file.fit.domain == "time",
        )
        reduced: list[ReducedRun] = []
        work = partial(self._read_and_reduce, plan=plan, waived=waived)
        report = partial(progress, "reading runs") if progress else None
        many = sum(run.file.stat().st_size for run in wet if run.file) > _BYTES_WORTH_PROCESSES
        if many and wet[0].file is not None:
            # Learns the dialect of the files, which then travels to every process.
            self._read(wet[0].file, wet[0], waived)
        for result in iter_records(wet, work, workers=workers, processes=many, progress=report):
            digests[str(result.run.file.name if result.run.file else result.name)] = result.sha256
            reduced.append(result)
        if self.file.points is not None:
            points, digest = read_points(
                self.file.points,
                self.ship,
                self.conventions,
                self.folder,
                self.path,
                settings.nondimensional_speed,
            )
            if digest and self.file.points.file:
                digests[self.file.points.file] = digest
            reduced += points
        return reduced, body, digests

    def _read(self, path: Path, run: Run | None, waived: frozenset[str]) -> tuple[Record, tuple[Finding, ...]]:
        assert self.file.channels is not None
        reader = self.file.reader
        channels = self.file.channels
        table = read_table(
            path,
            dialect=self._dialects.get(path.suffix),
            format=reader.format,
            sheet=reader.sheet,
            group=reader.group,
            columns=channels.expected_columns(),
        )
        if table.dialect is not None:
            self._dialects[path.suffix] = table.dialect
        findings = accept(audit_table(table, run), waived)
        stop_on_error(findings)
        psi = None
        if run is not None and channels.forces == "carriage-fixed" and "psi" not in channels.channels:
            clock = ChannelMap.model_validate({"time": channels.channels["time"]})
            psi = _heading(run, self.file.reduction.position_x, clock.apply(table).time)
        record = channels.apply(table, psi=psi)
        return record, tuple(findings)

    def _read_and_reduce(self, run: Run, *, plan: ReductionPlan, waived: frozenset[str]) -> ReducedRun:
        assert run.file is not None
        record, findings = self._read(run.file, run, waived)
        turned = home_axes(record, plan.conventions)
        more = accept(audit_record(turned, run, plan.ship, reference=plan.settings.position_x), waived)
        stop_on_error(more)
        return reduce_run(record, run, plan, (*findings, *more))

    def _tare(self, plan: ReductionPlan) -> dict[str, Mapping[str, float]]:
        levels: dict[str, Mapping[str, float]] = {}
        by_name = {run.name: run.file for run in self.runs}
        for run in self.runs:
            if not run.tare or run.tare in levels:
                continue
            path = by_name.get(run.tare) or self.folder / run.tare
            if not path.is_file():
                raise CampaignError(
                    f"zero run '{run.tare}' not found",
                    cure="name a run or a file of the campaign",
                    file=self.path,
                    place=f"run '{run.name}', tare",
                )
            record, _ = self._read(path, None, frozenset())
            levels[run.tare] = zero_level(record, plan)
        return levels

    def _rigid_body(self, plan: ReductionPlan, waived: frozenset[str]) -> RigidBody | None:
        inertia = self.file.inertia
        if not inertia.inside:
            return None
        if not inertia.dry_runs:
            assert inertia.mass is not None
            assert inertia.Izz is not None
            return RigidBody(inertia.mass + inertia.mount_mass, inertia.xG, inertia.Izz)
        pairs = []
        for run in self.runs:
            if not run.dry or run.file is None:
                continue
            record, _ = self._read(run.file, run, waived)
            result = reduce_run(record, run, replace(plan, keep_series=frozenset({run.name})))
            pairs.append((result.motion.at(result.window.times), result.series))
        if not pairs:
            raise CampaignError(
                "inertia.dry_runs is true but there is no dry run",
                cure="add runs of type dry_sway and dry_yaw",
                file=self.path,
            )
        return identify_rigid_body(pairs)

    def _terms_wanted(self) -> tuple[Term, ...]:
        """Every term that some fit of this campaign will ask for, once each."""
        lists: list[Sequence[Term]] = [self.file.fit.hull_terms() or default_terms(self.runs)]
        lists += [candidate_terms(name) for name in self.file.fit.candidates]
        unique = {term.factors: term for terms in lists for term in terms}
        return tuple(unique.values())

    def _shown(self, runs: Sequence[Run]) -> frozenset[str]:
        """Names of the runs whose series the report draws: the largest motion of each kind first."""
        wanted = self.file.output.series_in_report
        by_kind: dict[str, list[Run]] = {}
        for run in runs:
            by_kind.setdefault(run.kind, []).append(run)
        for same in by_kind.values():
            same.sort(key=lambda run: -abs(run.sway_amplitude) - abs(run.drift_angle) - abs(run.yaw_rate))
        shown: list[str] = []
        while len(shown) < wanted and any(by_kind.values()):
            for same in by_kind.values():
                if same and len(shown) < wanted:
                    shown.append(same.pop(0).name)
        return frozenset(shown)

    # -- fitting ---------------------------------------------------------------------------------------------

    def _grouped(self, runs: Sequence[ReducedRun]) -> dict[str, list[ReducedRun]]:
        by = self.file.fit.group_by
        groups: dict[tuple[float, ...], list[ReducedRun]] = {}
        for run in runs:
            key = tuple(
                round(
                    {
                        "depth": min(run.ship.depth_ratio, 1e9),
                        "speed": run.ship.froude_number(run.run.speed),
                        "heel": float(np.degrees(run.run.heel)),
                    }[name],
                    3,
                )
                for name in by
            )
            groups.setdefault(key, []).append(run)
        if len(groups) == 1:
            return {"": next(iter(groups.values()))}
        text = {"depth": "h/T {:g}", "speed": "Fn {:g}", "heel": "heel {:g} deg"}

        def label(key: tuple[float, ...]) -> str:
            parts = (
                "deep water" if name == "depth" and value >= 1e9 else text[name].format(value)
                for name, value in zip(by, key, strict=True)
            )
            return ", ".join(parts)

        return {label(key): groups[key] for key in sorted(groups)}

    def _prior(self) -> DerivativeSet | None:
        name = self.file.fit.prior
        if name is None:
            return None
        from .empirical_derivatives import empirical_set

        return empirical_set(self.ship, name)

    def _fit(
        self,
        label: str,
        runs: Sequence[ReducedRun],
        prior: DerivativeSet | None,
        digests: Mapping[str, str],
        waived: frozenset[str],
        body: RigidBody | None,
    ) -> HullFit:
        name = self.file.campaign.name + (f", {label}" if label else "")
        provenance = Provenance(
            source=self.file.campaign.source or self.path.name,
            inputs=digests,
            choices=self._choices(runs, waived, body),
            versions=program_versions(),
        )
        terms = self.file.fit.hull_terms() or default_terms([run.run for run in runs])
        if prior is not None:
            drift = any("beta" in term.variables for term in terms)
            prior = prior.to(
                Conventions(
                    sway_variable="beta" if drift else "v",
                    added_mass_coriolis=prior.conventions.added_mass_coriolis,
                )
            )
        try:
            return fit_hull(
                runs,
                self.file.fit,
                runs[0].ship,
                name=name,
                label=label,
                terms=terms,
                provenance=provenance,
                prior=prior,
            )
        except TowtankError as error:
            raise type(error)(
                error.cause, cure=error.cure, file=error.file or self.path, place=error.place
            ) from None

    def _choices(
        self, runs: Sequence[ReducedRun], waived: frozenset[str], body: RigidBody | None
    ) -> dict[str, Any]:
        """Every choice of the pipeline, for the report and the provenance."""
        settings = self.file.reduction
        steps: list[str] = []
        for run in runs:
            steps += [step for step in run.steps if step not in steps and not step.startswith("window")]
        return {
            "reduction": settings.model_dump(),
            "fit": self.file.fit.model_dump(),
            "inertia": body.describe() if body else "not in the measured forces",
            "steps seen": steps[:60],
            "accepted rules": sorted(waived),
            "conventions of the data": self.conventions.to_dict(),
        }

    def _cross_audit(self, fit: HullFit, waived: frozenset[str]) -> list[Finding]:
        summaries = [run_summary(run) for run in fit.runs]
        return accept(
            audit_campaign(
                summaries,
                fit.runs[0].ship,
                self.conventions,
                fit.derivatives,
                inertia_inside=self.file.inertia.inside,
            ),
            waived,
        )

    def _finished(self, fit: HullFit, findings: Sequence[Finding], waived: frozenset[str]) -> HullFit:
        """The fit in the scaling that was asked for, with all findings in its provenance."""
        derivatives = replace(
            fit.derivatives, provenance=replace(fit.derivatives.provenance, findings=tuple(findings))
        )
        return replace(fit, derivatives=derivatives)

    def _comparisons(self, fits: Sequence[HullFit], progress: Progress | None) -> dict[str, Any]:
        from .model_comparison import compare_models, range_sensitivity
        from .three_ways import three_ways

        tables: dict[str, Any] = {}
        for number, fit in enumerate(fits):
            if progress:
                progress("comparing", number, len(fits))
            tables[f"three ways|{fit.label}"] = three_ways(fit)
            names = self.file.fit.candidates
            if names:
                candidates = {name: candidate_terms(name) for name in names}
                candidates = {"as fitted": fit.derivatives.terms, **candidates}
                tables[f"candidates|{fit.label}"] = compare_models(fit.runs, candidates, self.file.fit)
            if self.file.fit.range_limits:
                tables[f"range|{fit.label}"] = range_sensitivity(
                    fit.runs, fit.derivatives.terms, self.file.fit, self.file.fit.range_limits
                )
        if progress:
            progress("comparing", len(fits), len(fits))
        return tables

    def output_conventions(self, fit: HullFit) -> Conventions:
        """Conventions in which the result is written."""
        return preset(self.file.output.scaling, fit.derivatives.conventions)


def _heading(run: Run, reference: float, time: np.ndarray) -> np.ndarray:
    """Prescribed heading against the carriage at the given times, rad."""
    return prescribed_motion(run, reference).at(time)["psi"] - run.yaw_rate * time
