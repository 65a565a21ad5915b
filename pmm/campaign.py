"""A captive-test campaign from its file to its result: the default pipeline of the package."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any, NamedTuple

from ..core.conventions import Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, TowtankError
from ..core.findings import Finding, accept, stop_on_error
from ..core.processes import Later, can_fork
from ..core.provenance import Provenance, file_hash, program_versions
from ..core.ship import Ship
from ..core.terms import Term
from ..formats.stream import iter_records
from .audit_campaign import audit_campaign
from .audit_rules import RULES, require_rules
from .campaign_file import CampaignFile, candidate_terms, load_campaign_file
from .campaign_result import CampaignResult
from .hull_fit import HullFit, default_terms, fit_hull
from .points import PointTable, read_points
from .reduced_run import ReducedRun
from .reduction import ReductionPlan
from .rigid_body import RigidBody
from .run_groups import group_runs, shown_runs
from .run_matrix import expand_runs
from .run_reading import RunReader
from .run_summary import run_summary
from .run_types import Run

_LARGE = 200e6
"""Campaigns with more bytes are read by compiled code in processes, which start slowly."""

_MANY_RUNS = 200
"""Runs from which on comparisons are made in a process of their own."""

Progress = Callable[[str, int, int], None]
"""Called with what is being done, how many are done, how many there are."""


class Reduced(NamedTuple):
    """Runs of a campaign after reading, audit and reduction.

    Attributes
    ----------
    runs : list of ReducedRun
        Runs in water and points.
    rigid_body : RigidBody or None
        What hangs on the balance, when its inertia was subtracted.
    digests : dict of str to str
        sha256 of every input file, by its name from the folder of the campaign.
    findings : list of Finding
        Of all files, zero runs and runs in air included.
    """

    runs: list[ReducedRun]
    rigid_body: RigidBody | None
    digests: dict[str, str]
    findings: list[Finding]


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
        runs = expand_runs(self.file.runs, self.folder, self.conventions, self.path)
        for run in runs:
            if run.file is None:
                raise CampaignError(
                    "the run has no file",
                    cure="add a column 'file' to the matrix",
                    file=self.path,
                    place=f"run '{run.name}'",
                )
        return tuple(runs)

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
        waived = self._waived(accept_rules)
        reduced, body, digests, findings = self.reduce(waived, progress=progress, workers=workers)
        groups = group_runs(reduced, self.file.fit.group_by)
        prior = self._prior()
        fits: list[HullFit] = []
        for number, (label, runs) in enumerate(groups.items(), start=1):
            if progress:
                progress("fitting", number - 1, len(groups))
            fits.append(self._fit(label, runs, prior, digests, waived, body))
            findings += self._cross_audit(fits[-1].runs, fits[-1].derivatives, waived)
        if progress:
            progress("fitting", len(groups), len(groups))
        stop_on_error(findings)
        fits = [self._finished(fit, findings, waived) for fit in fits]
        comparisons: Mapping[str, Any] = {}
        if compare and len(reduced) > _MANY_RUNS and workers > 1 and can_fork():
            comparisons = Later(partial(self._comparisons, fits, None))
        elif compare:
            comparisons = self._comparisons(fits, progress)
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

    def audit(
        self, *, accept_rules: Iterable[str] = (), progress: Progress | None = None, workers: int = 2
    ) -> list[Finding]:
        """Every finding about the files and across the runs, without stopping at the first and without a fit.

        Parameters
        ----------
        accept_rules, progress, workers
            As in :meth:`run`.

        Raises
        ------
        TowtankError
            For a file that cannot be read at all.
        """
        waived = self._waived(accept_rules)
        # Zero and dry runs must not stop the look at the others.
        reader = RunReader(self.file, self.path, self.ship, self.conventions, waived | set(RULES))
        plan = self._plan(reader)
        reader = replace(reader, waived=waived)
        report = partial(progress, "auditing") if progress else None
        wet = [run for run in self.runs if not run.dry]
        results = list(iter_records(wet, partial(reader.look_at, plan=plan), workers=workers, progress=report))
        findings = [item for found, _ in results for item in found]
        runs = [run for _, run in results if run is not None]
        if self.file.points is not None:
            points = self._points()
            findings += points.findings
            runs += points.runs
        findings = [*(replace(item, accepted=False) for item in reader.findings), *findings]
        for group in group_runs(runs, self.file.fit.group_by).values() if runs else ():
            findings += self._cross_audit(group, None, waived)
        return accept(findings, waived)

    def _waived(self, accept_rules: Iterable[str]) -> frozenset[str]:
        rules = frozenset(accept_rules)
        require_rules(rules)
        return rules | set(self.file.accept)

    # -- reading ---------------------------------------------------------------------------------------------

    def reduce(
        self, waived: frozenset[str] = frozenset(), *, progress: Progress | None = None, workers: int = 2
    ) -> Reduced:
        """Read, audit and reduce every run.

        Raises
        ------
        TowtankError
            For bad input, or an error of the audit that is not in `waived`.
        """
        wet = [run for run in self.runs if not run.dry]
        large = sum(run.file.stat().st_size for run in wet if run.file) > _LARGE
        reader = RunReader(self.file, self.path, self.ship, self.conventions, waived, large)
        plan = self._plan(reader)
        report = partial(progress, "reading runs") if progress else None
        work = partial(reader.read_and_reduce, plan=plan)
        many = large and workers > 1 and (can_fork() or workers > 2)
        if many:
            # What one run teaches and compiles is there for every process.
            work(wet[0])
        reduced = list(iter_records(wet, work, workers=workers, processes=many, progress=report))
        findings = [*reader.findings, *(item for run in reduced for item in run.findings)]
        digests = {self.path.name: file_hash(self.path)}
        digests |= {
            group.matrix: file_hash(self.folder / group.matrix) for group in self.file.runs if group.matrix
        }
        if self.file.points is not None:
            points = self._points()
            noticed = accept(points.findings, waived)
            stop_on_error(noticed)
            findings += noticed
            if points.sha256:
                digests[str(self.file.points.file)] = points.sha256
            if self.file.points.harmonics is not None:
                digests[self.file.points.harmonics] = file_hash(self.folder / self.file.points.harmonics)
            reduced += points.runs
        # Threads finish in any order, and processes keep their readers to themselves.
        read = {reader.name_of(run.run.file): run.sha256 for run in reduced if run.run.file}
        digests |= dict(sorted((reader.digests | read).items()))
        return Reduced(reduced, plan.inertia, digests, findings)

    def _plan(self, reader: RunReader) -> ReductionPlan:
        """How runs are reduced, zero levels and inertia found."""
        plan = ReductionPlan(self.file.reduction, self.ship, self.conventions)
        plan = replace(plan, tare=reader.zero_levels(self.runs, plan))
        return replace(
            plan,
            inertia=reader.rigid_body(self.runs, plan),
            terms=self._terms_wanted(),
            keep_series=shown_runs([run for run in self.runs if not run.dry], self.file.output.series_in_report),
            time_domain=self.file.fit.domain == "time",
        )

    def _points(self) -> PointTable:
        assert self.file.points is not None
        return read_points(
            self.file.points, self.ship, self.conventions, self.folder, self.path, self.file.reduction
        )

    def _terms_wanted(self) -> tuple[Term, ...]:
        """Every term that some fit of this campaign will ask for, once each."""
        lists: list[Sequence[Term]] = [self.file.fit.hull_terms() or default_terms(self.runs)]
        lists += [candidate_terms(name) for name in self.file.fit.candidates]
        unique = {term.factors: term for terms in lists for term in terms}
        return tuple(unique.values())

    # -- fitting ---------------------------------------------------------------------------------------------

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
        self._require_terms(terms)
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

    def _require_terms(self, terms: Sequence[Term]) -> None:
        """Refuse a constraint on a term that is not fitted: misspelt, it would constrain nothing."""
        fit = self.file.fit
        known = [term.name for term in terms]
        wishes = [("fixed", name) for name in fit.fixed] + [("bounds", name) for name in fit.bounds]
        wishes += [("equalities", name) for item in fit.equalities for name in item.terms]
        for key, name in wishes:
            if name not in known:
                close = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
                raise CampaignError(
                    f"'{name}' is not a fitted term",
                    cure=f"closest: {', '.join(close)}" if close else f"fitted are {', '.join(known)}",
                    file=self.path,
                    place=f"key 'fit.{key}'",
                )

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

    def _cross_audit(
        self, runs: Sequence[ReducedRun], fitted: DerivativeSet | None, waived: frozenset[str]
    ) -> list[Finding]:
        found = audit_campaign(
            [run_summary(run) for run in runs],
            runs[0].ship,
            self.conventions,
            fitted,
            inertia_inside=self.file.inertia.inside,
        )
        return accept([replace(item, file=item.file or str(self.path)) for item in found], waived)

    def _finished(self, fit: HullFit, findings: Sequence[Finding], waived: frozenset[str]) -> HullFit:
        """The fit in the scaling that was asked for, with all findings in its provenance."""
        derivatives = replace(
            fit.derivatives, provenance=replace(fit.derivatives.provenance, findings=tuple(findings))
        )
        return replace(fit, derivatives=derivatives)

    def _comparisons(self, fits: Sequence[HullFit], progress: Progress | None) -> dict[str, Any]:
        from .beside_least_squares import beside_least_squares
        from .model_comparison import compare_models, range_sensitivity
        from .three_ways import three_ways

        tables: dict[str, Any] = {}
        for number, fit in enumerate(fits):
            if progress:
                progress("comparing", number, len(fits))
            tables[f"three ways|{fit.label}"] = three_ways(fit)
            if self.file.fit.estimator not in ("wls", "ols"):
                tables[f"estimators|{fit.label}"] = beside_least_squares(fit)
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
