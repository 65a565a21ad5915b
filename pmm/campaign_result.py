"""The result of a campaign: derivative sets, runs, harmonics, comparisons, findings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import TowtankError
from ..core.findings import Finding, findings_frame
from .campaign_file import CampaignFile, Heading
from .hull_fit import OUTLYING, HullFit
from .reduced_run import ReducedRun
from .rigid_body import RigidBody

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class CampaignResult:
    """Everything that a campaign yields.

    Attributes
    ----------
    campaign : Heading
    path : Path
        The campaign file.
    settings : CampaignFile
    fits : tuple of HullFit
        One a group (water depth, speed, ...).
    runs : tuple of ReducedRun
    findings : tuple of Finding
    rigid_body : RigidBody or None
    comparisons : mapping of str to DataFrame
        ``three ways|LABEL``, ``candidates|LABEL``, ``range|LABEL``.
    """

    campaign: Heading
    path: Path
    settings: CampaignFile
    fits: tuple[HullFit, ...]
    runs: tuple[ReducedRun, ...]
    findings: tuple[Finding, ...] = ()
    rigid_body: RigidBody | None = None
    comparisons: Mapping[str, Any] = field(default_factory=dict)

    @property
    def derivatives(self) -> DerivativeSet:
        """The derivative set of a campaign with one group, as written out.

        Raises
        ------
        TowtankError
            When there are several groups; use :meth:`sets`.
        """
        if len(self.fits) != 1:
            raise TowtankError(
                f"the campaign has {len(self.fits)} derivative sets",
                cure="choose one of sets(): " + ", ".join(self.sets()),
            )
        return self.written(self.fits[0])

    def sets(self) -> dict[str, DerivativeSet]:
        """Derivative sets by group label, as written out."""
        return {fit.label: self.written(fit) for fit in self.fits}

    def written(self, fit: HullFit) -> DerivativeSet:
        """The set of a fit in the conventions that ``[output] scaling`` asks for."""
        return fit.derivatives.to(self.settings.output.scaling)

    def derivatives_frame(self) -> pd.DataFrame:
        """Table name, value, std, lower95, upper95, scaling; with the group when there are several."""
        import pandas as pd

        frames = []
        for label, derivatives in self.sets().items():
            frame = derivatives.to_frame()
            if len(self.fits) > 1:
                frame["group"] = label
            frames.append(frame)
        return pd.concat(frames, ignore_index=True)

    def runs_frame(self) -> pd.DataFrame:
        """One row a run: type, parameters, window, noise, quality, findings."""
        import pandas as pd

        quality = self._quality()
        rows = []
        for run in self.runs:
            test = run.run
            rows.append(
                {
                    "run": test.name,
                    "type": test.kind,
                    "speed [m/s]": test.speed,
                    "drift angle [deg]": math.degrees(test.drift_angle),
                    "yaw rate [rad/s]": test.yaw_rate,
                    "frequency [rad/s]": test.frequency,
                    "sway amplitude [m]": test.sway_amplitude,
                    "yaw amplitude [deg]": math.degrees(test.yaw_amplitude),
                    "rudder angle [deg]": math.degrees(test.rudder_angle),
                    "heel [deg]": math.degrees(test.heel),
                    "h/T": run.ship.depth_ratio,
                    "window start [s]": run.window.start,
                    "window stop [s]": run.window.stop,
                    "samples": run.window.count,
                    "window": run.window.note,
                    **{
                        f"noise sd {name} [{'N' if name in 'XY' else 'N m'}]": sd
                        for name, sd in run.residual_sd.items()
                    },
                    "largest residual [sd]": quality.get(id(run), math.nan),
                    "quality": _verdict(quality.get(id(run), math.nan), run),
                    "findings": "; ".join(sorted({f.rule for f in run.findings if f.severity != "info"})),
                }
            )
        return pd.DataFrame(rows)

    def _quality(self) -> dict[int, float]:
        """Largest standardised residual of each run over the components."""
        worst: dict[int, float] = {}
        for fit in self.fits:
            for component in fit.components.values():
                size = np.abs(component.residual) / np.where(component.row_sd > 0, component.row_sd, np.inf)
                for row, index in enumerate(component.rows.run.tolist()):
                    key = id(fit.runs[index])
                    worst[key] = max(worst.get(key, 0.0), float(size[row]))
        return worst

    def harmonics_frame(self) -> pd.DataFrame:
        """One row a run, force and harmonic: dimensional and scaled coefficients with standard errors."""
        import pandas as pd

        rows = []
        for run in self.runs:
            for name, forces in run.forces.items():
                scaled, sd = run.scaled[name], run.scaled_sd[name]
                for k in range(run.order + 1):
                    c = 0 if k == 0 else 2 * k - 1
                    rows.append(
                        {
                            "run": run.name,
                            "type": run.run.kind,
                            "force": name,
                            "harmonic": k,
                            "omega [rad/s]": k * run.motion.omega,
                            "cos [SI]": forces[c],
                            "sin [SI]": forces[c + 1] if k else 0.0,
                            "cos'": scaled[c],
                            "sin'": scaled[c + 1] if k else 0.0,
                            "cos' std": sd[c],
                            "sin' std": sd[c + 1] if k else 0.0,
                        }
                    )
        return pd.DataFrame(rows)

    def findings_frame(self) -> pd.DataFrame:
        """Audit findings, worst first."""
        return findings_frame(self.findings)

    def comparison(self, kind: str, label: str = "") -> pd.DataFrame | None:
        """Table of a comparison (``three ways``, ``candidates``, ``range``) of one group."""
        return self.comparisons.get(f"{kind}|{label}")

    def summary(self) -> str:
        """Text tables of all sets."""
        return "\n\n".join(derivatives.summary() for derivatives in self.sets().values())


def _verdict(residual: float, run: ReducedRun) -> str:
    if any(f.severity == "error" for f in run.findings):
        return "accepted with errors"
    if math.isfinite(residual) and residual > OUTLYING:
        return "outlying"
    if any(f.severity == "warning" for f in run.findings):
        return "with warnings"
    return "good"
