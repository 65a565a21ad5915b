"""From coefficients to a RollDamping: re-simulation, diagnostics, and what makes a fit unfit for use."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..core.provenance import Provenance, program_versions
from .coloured_noise import ColouredNoise
from .damping_models import DampingModel
from .decay_record import DecayRecord
from .equivalent_damping import equivalent_linear
from .fit_diagnostics import FitDiagnostics, FittedRun
from .resimulation import Simulated, explained, resimulate
from .roll_damping import CONVENTIONS, RollDamping, roll_damping

#: Below this R2 of the re-simulated motion the coefficients do not explain the record: an error.
UNEXPLAINED = 0.5
#: Below this R2 a warning stands in the result.
POOR = 0.95
#: Above this R2 a re-simulated motion is good enough, whatever the noise.
EXPLAINED = 0.999
#: Residual of the re-simulated motion over that of the same terms fitted to the motion, above which it is told.
MISSED = 2.0
#: Correlation of two coefficients above which they are not to be quoted singly.
INSEPARABLE = 0.95
FEW_HALF_CYCLES = 6
#: Initial coordinate and velocity, and rest position: what belongs to each record.
OWN_VALUES = 3
#: A bias beyond this part of a standard error and this part of the equivalent damping is told.
TOLD_BIAS = 0.5
TOLD_PART = 0.005


def as_records(records: DecayRecord | Sequence[DecayRecord]) -> list[DecayRecord]:
    """One or several records of one motion at one scale, as a list.

    Raises
    ------
    FitError
        If there is none, or they differ in motion or scale.
    """
    runs = [records] if isinstance(records, DecayRecord) else list(records)
    if not runs:
        raise FitError("there is no decay record to fit", cure="give at least one")
    for one in runs[1:]:
        if one.motion != runs[0].motion or one.scale != runs[0].scale:
            raise FitError(
                f"'{one.name}' is {one.motion} at scale {one.scale:g}, '{runs[0].name}' {runs[0].motion} at "
                f"{runs[0].scale:g}",
                cure="fit one motion at one scale; use at_scale(...)",
            )
    return runs


def require_speeds(records: Sequence[DecayRecord], model: DampingModel) -> None:
    """Raise FitError when a dependence on speed is asked for and the speeds do not vary enough."""
    if not model.speed:
        return
    highest = max(int("".join(filter(str.isdigit, name.split("U")[1])) or "1") for name in model.speed)
    speeds = {round(one.speed, 6) for one in records}
    if len(speeds) <= highest:
        raise FitError(
            f"the records have {len(speeds)} speed(s), too few for {', '.join(model.speed)}",
            cure=f"give records at {highest + 1} speeds or more",
        )


def record_noise(
    records: Sequence[DecayRecord],
    runs: Sequence[FittedRun],
    gradients: Sequence[np.ndarray],
    *,
    left_over: bool = True,
) -> ColouredNoise:
    """Noise of the records from the residuals of their simulated motion.

    Parameters
    ----------
    records : sequence of DecayRecord
    runs : sequence of FittedRun
    gradients : sequence of ndarray, shape (n, q)
        Gradients of each simulated record by everything that was fitted.
    left_over : bool
        Whether the residuals still hold what a least-squares fit of the angle would take away: the error of the
        coefficients would be counted as noise.
    """
    cycles = [one.time_step / one.period for one in records]
    residuals = [run.residual for run in runs]
    if left_over:
        residuals = [
            residual - gradient @ np.linalg.lstsq(gradient, residual, rcond=None)[0]
            for residual, gradient in zip(residuals, gradients)
        ]
    fitted = float(np.mean([gradient.shape[1] for gradient in gradients])) - 1.0
    if not left_over:
        # A decay spreads over the lines beside its own, from which the level is read: virtual records (AR(1), 12 half
        # cycles) show that two lines more must be put back for the intervals of the shooting fit to hold.
        fitted += 2.0
    return ColouredNoise.of_residuals(residuals, cycles, fitted)


def fitted_gradient(record: DecayRecord, model: DampingModel, simulated: Simulated) -> np.ndarray:
    """Gradient of a simulated record by the free terms, the initial values and the offset, shape (n, q + 3)."""
    free = [i for i, name in enumerate(model.names) if name not in model.fixed]
    terms = simulated.gradient[:, :6] @ model.spread(record.speed)[:, free]
    return np.hstack([terms, simulated.gradient[:, 6:9]])


def assess_influences(
    method: str,
    records: Sequence[DecayRecord],
    model: DampingModel,
    values: Mapping[str, float],
    influences: Sequence[np.ndarray],
    *,
    again: Callable[[Sequence[DecayRecord]], Mapping[str, float]],
    details: Mapping[str, Any] | None = None,
    choices: Mapping[str, Any] | None = None,
) -> RollDamping:
    """RollDamping of an estimator that is linear in small errors of the samples.

    The estimator is run once more on the re-simulated motion, which its coefficients describe exactly: what it finds
    there besides is its own bias.

    Parameters
    ----------
    method : str
    records : sequence of DecayRecord
    model : DampingModel
    values : mapping of str to float
        Free terms.
    influences : sequence of ndarray, shape (q, n)
        What a unit error of each sample of a record does to the free terms.
    again : callable
        Free terms that the estimator finds in other records.
    details, choices
        For the diagnostics and the provenance.

    Raises
    ------
    FitError
        If nothing restores, or the result does not explain the records.
    """
    everything = model.complete(values)
    spring = everything[model.names.index("c1")]
    if not (np.isfinite(everything).all() and spring > 0.0):
        raise FitError(
            f"the {method} fit gives c1 = {spring:.4g}, which does not restore",
            cure="check that the record is a free decay about its rest position",
            file=records[0].source or None,
            place=records[0].name,
        )
    fitted = [resimulate(one, model, model.spread(one.speed) @ everything) for one in records]
    runs = [run for run, _ in fitted]
    gradients = [fitted_gradient(one, model, sim) for one, (_, sim) in zip(records, fitted)]
    noise = record_noise(records, runs, gradients)
    covariance = noise.covariance(influences)
    clean = [
        replace(one, value=run.fitted, rate=None, acceleration=None, whole=None) for one, run in zip(records, runs)
    ]
    without_noise = again(clean)
    bias = {name: without_noise[name] - values[name] for name in model.free}
    return assess(
        method,
        records,
        model,
        values,
        covariance,
        runs,
        noise,
        findings=[
            *_bias_findings(method, records, model, everything, bias, covariance),
            *missed_motion(method, records, runs, gradients),
        ],
        details={"bias of the method": bias, **(details or {})},
        choices=choices,
    )


def missed_motion(
    method: str, records: Sequence[DecayRecord], runs: Sequence[FittedRun], gradients: Sequence[np.ndarray]
) -> list[Finding]:
    """Whether the coefficients together leave the motion further off than the same terms need to.

    The standard errors may be honest and the equivalent damping right; but an estimator that does not look at the
    phase, or is at the mercy of noisy velocities, gives a set that does not reproduce the record.

    Parameters
    ----------
    method : str
    records : sequence of DecayRecord
    runs : sequence of FittedRun
        Re-simulated with the coefficients.
    gradients : sequence of ndarray, shape (n, q)
        Gradients of each by the terms, its initial values and its rest position.
    """
    left = np.concatenate([run.residual for run in runs])
    shared = gradients[0].shape[1] - OWN_VALUES
    wide = np.zeros((left.size, shared + OWN_VALUES * len(runs)))
    begin = 0
    for k, gradient in enumerate(gradients):
        rows = slice(begin, begin + gradient.shape[0])
        wide[rows, :shared] = gradient[:, :shared]
        wide[rows, shared + OWN_VALUES * k : shared + OWN_VALUES * (k + 1)] = gradient[:, shared:]
        begin += gradient.shape[0]
    length = np.linalg.norm(wide, axis=0)
    wide = wide / np.where(length > 0.0, length, 1.0)
    least = left - wide @ np.linalg.lstsq(wide, left, rcond=None)[0]
    ratio = float(np.linalg.norm(left) / max(float(np.linalg.norm(least)), 1e-300))
    if ratio < MISSED or explained(runs) > EXPLAINED:
        return []
    return [
        Finding(
            "motion-missed",
            "warning",
            f"the motion that the coefficients of the {method} give is {ratio:.1f} times as far from the record as "
            "the same terms can come",
            records[0].source,
            records[0].name,
            "quote its equivalent damping at most; use the integration fit",
        )
    ]


def _bias_findings(
    method: str,
    records: Sequence[DecayRecord],
    model: DampingModel,
    everything: np.ndarray,
    bias: Mapping[str, float],
    covariance: np.ndarray,
) -> list[Finding]:
    """Whether the equivalent damping is off by more than half a standard error and half a per cent."""
    record = records[0]
    swings = record.extremes.half_swing
    amplitude = np.array([swings.min(), np.median(swings), swings.max()])
    spread = model.spread(record.speed)
    moved = everything + np.array([bias.get(name, 0.0) for name in model.names])
    alpha, _, gradient = equivalent_linear(spread @ everything, amplitude, model.curve)
    other = equivalent_linear(spread @ moved, amplitude, model.curve)[0]
    free = [i for i, name in enumerate(model.names) if name not in model.fixed]
    rows = gradient @ spread[:, free]
    sd = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", rows, covariance, rows), 0.0))
    off = other - alpha
    told = (np.abs(off) > TOLD_BIAS * sd) & (np.abs(off) > TOLD_PART * np.abs(alpha))
    if not told.any():
        return []
    worst = int(np.argmax(np.abs(off) * told))
    return [
        Finding(
            "method-bias",
            "warning",
            f"the {method} is off by {100.0 * off[worst] / alpha[worst]:+.1f} % of the equivalent damping at the "
            f"amplitude {amplitude[worst]:.3g} in a motion that its own coefficients describe",
            record.source,
            record.name,
            "use the integration fit",
        )
    ]


def assess(
    method: str,
    records: Sequence[DecayRecord],
    model: DampingModel,
    values: Mapping[str, float],
    covariance: np.ndarray,
    runs: Sequence[FittedRun],
    noise: ColouredNoise,
    *,
    dof: float | None = None,
    converged: bool = True,
    condition: float = float("nan"),
    findings: Sequence[Finding] = (),
    details: Mapping[str, Any] | None = None,
    choices: Mapping[str, Any] | None = None,
    confidence: float = 0.95,
) -> RollDamping:
    """RollDamping with diagnostics.

    Parameters
    ----------
    method : str
    records : sequence of DecayRecord
    model : DampingModel
    values : mapping of str to float
        Free terms.
    covariance : ndarray, shape (q, q)
    runs : sequence of FittedRun
        The re-simulated records.
    noise : ColouredNoise
    dof : float, optional
        Of the intervals; those of the noise density when not given.
    converged, condition, findings, details, choices, confidence
        For the diagnostics and the provenance.

    Raises
    ------
    FitError
        If the re-simulated motion explains less than half of the variance of the records.
    """
    r2 = explained(runs)
    if not r2 >= UNEXPLAINED:
        raise FitError(
            f"the {method} fit does not explain the record: R2 of the re-simulated motion is {r2:.3g}",
            cure="check that it is a free decay and its window, or use another start, method or model",
            file=records[0].source or None,
            place=records[0].name,
        )
    swings = np.concatenate([one.extremes.half_swing for one in records])
    residual = np.concatenate([run.residual for run in runs])
    first = records[0]
    draft = roll_damping(
        method,
        model,
        values,
        covariance,
        diagnostics=FitDiagnostics(
            samples=sum(len(one) for one in records),
            half_cycles=int(swings.size),
            r2=r2,
            noise=float(np.sqrt(np.mean(residual**2))),
            noise_time=float(
                np.mean([tau * one.time_step for tau, one in zip(noise.correlation_samples, records)])
            ),
            amplitudes=(float(swings.min()), float(swings.max())),
            converged=converged,
            condition=condition,
            details=dict(details or {}),
        ),
        dof=noise.dof if dof is None else dof,
        motion=first.motion,
        scale=first.scale,
        ship=first.ship,
        runs=runs,
        confidence=confidence,
    )
    return _with_findings(draft, records, list(findings), choices or {})


def _with_findings(
    draft: RollDamping, records: Sequence[DecayRecord], findings: list[Finding], choices: Mapping[str, Any]
) -> RollDamping:
    file = records[0].source
    fit = draft.diagnostics

    def say(rule: str, severity: Any, message: str, cure: str = "") -> None:
        findings.append(Finding(rule, severity, message, file, records[0].name, cure))

    if fit.r2 < POOR:
        say("poor-fit", "warning", f"R2 of the re-simulated motion is {fit.r2:.4g}", "see the residuals")
    if not fit.converged:
        say("not-converged", "warning", f"the {draft.method} fit did not converge", "use another start")
    if fit.half_cycles < FEW_HALF_CYCLES:
        say("few-cycles", "warning", f"{fit.half_cycles} half cycle(s) only", "give a longer record")
    if not draft.model.memory:
        speeds = sorted({one.speed for one in records})
        for speed in speeds:
            at = draft.equivalent(speed=speed)
            wrong = ~(at.alpha > 0.0)
            if wrong.any():
                say(
                    "negative-damping",
                    "warning",
                    f"the equivalent damping is not positive at {wrong.sum()} of {wrong.size} amplitudes of the "
                    f"record, at {speed:g} m/s",
                    "use fewer terms",
                )
    free = list(draft.model.free)
    places = [draft.position(name) for name in free]
    between = np.abs(draft.correlation[np.ix_(places, places)])
    pairs = [
        (free[i], free[j], float(draft.correlation[places[i], places[j]]))
        for i in range(len(free))
        for j in range(i)
        if between[i, j] > INSEPARABLE
    ]
    if pairs:
        said = ", ".join(f"{a} and {b} ({r:+.3f})" for a, b, r in pairs)
        say("inseparable", "info", f"strongly correlated: {said}", "quote the equivalent damping, not these")
    provenance = Provenance(
        source=file,
        inputs={one.source: one.sha256 for one in records if one.source},
        choices={
            "method": draft.method,
            "model": draft.model.label,
            "conventions": CONVENTIONS,
            "records": {one.name or f"record {i + 1}": list(one.steps) for i, one in enumerate(records)},
            **choices,
        },
        findings=tuple(item for one in records for item in one.findings),
        versions=program_versions(),
    )
    return replace(draft, diagnostics=replace(fit, findings=tuple(findings)), provenance=provenance)
