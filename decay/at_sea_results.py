"""What records at sea yield, and their tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.findings import Finding
from .at_sea import AtSeaFit
from .damping_models import TERMS, term_unit
from .decay_campaign import DISCRETE_SEARCH, JOINT_FIT, RANDOM_DECREMENT, DecayCampaign
from .decay_record import DecayRecord
from .discrete_search import DiscreteSearch
from .equivalent_damping import EquivalentDamping, equivalent_linear
from .random_decrement import BLOCKS, RandomDecrement

if TYPE_CHECKING:
    import pandas as pd

PUBLISHED = f"{DISCRETE_SEARCH}, as published"
OWN_UNITS = {"f": "rad/s2", "we": "rad/s", "phase": "rad", "f0": "rad/s2"}
_LEVEL = 0.95


@dataclass(frozen=True, eq=False)
class Searched:
    """The discrete search on one oscillation.

    Attributes
    ----------
    start : float
        Time in s at which the oscillation begins.
    amplitude : float
        rad.
    determines : int
        Numbers that the shape of the oscillation can determine; the search asks for nine.
    found : DiscreteSearch
    """

    start: float
    amplitude: float
    determines: int
    found: DiscreteSearch


@dataclass(frozen=True, eq=False)
class AtSeaRecord:
    """One record at sea.

    Attributes
    ----------
    record : DecayRecord
    guess : dict of str to float
        Rough terms that the searches began with, SI.
    guessed_from : str
    noise : float
        Standard deviation of the noise in rad, for the count of what an oscillation determines.
    decrements : tuple of RandomDecrement
        One a trigger level.
    joint : AtSeaFit, optional
    searched : Searched, optional
    failures : mapping of str to str
        Methods that gave no result, with the reason.
    findings : tuple of Finding
    """

    record: DecayRecord
    guess: dict[str, float]
    guessed_from: str
    noise: float
    decrements: tuple[RandomDecrement, ...]
    joint: AtSeaFit | None
    searched: Searched | None
    failures: Mapping[str, str]
    findings: tuple[Finding, ...]

    def terms(self) -> pd.DataFrame:
        """Rows ``method, model, name, value, std, lower95, upper95, unit`` of all methods."""
        import pandas as pd

        return pd.DataFrame([*self._decrement_rows(), *self._joint_rows(), *self._searched_rows()])

    def _decrement_rows(self) -> Iterator[dict[str, Any]]:
        for one in self.decrements:
            model = f"linear at {math.degrees(one.level):.3g} deg"
            alpha_sd = math.hypot(one.zeta_sd * one.omega, one.zeta * one.omega_sd)
            for name, value, sd, unit in (
                ("alpha_e", one.alpha, alpha_sd, "1/s"),
                ("zeta", one.zeta, one.zeta_sd, "-"),
                ("omega", one.omega, one.omega_sd, "rad/s"),
            ):
                yield _row(RANDOM_DECREMENT, model, name, value, sd, _jackknife_half(sd), unit)

    def _joint_rows(self) -> Iterator[dict[str, Any]]:
        fit = self.joint
        if fit is None:
            return
        model = f"{joined_terms(fit.names)}, one excitation an oscillation"
        for name, value, sd, (low, high) in zip(fit.names, fit.params, fit.bse, fit.conf_int(_LEVEL)):
            yield _row(JOINT_FIT, model, name, float(value), float(sd), 0.5 * float(high - low), term_unit(name))

    def _searched_rows(self) -> Iterator[dict[str, Any]]:
        if self.searched is None:
            return
        model = f"nine numbers of the oscillation at {self.searched.start:.4g} s"
        for name, value in self.searched.found.values.items():
            unit = OWN_UNITS.get(name) or term_unit(name)
            yield _row(PUBLISHED, model, name, value, math.nan, math.nan, unit)

    def equivalent(self, points: int = 25) -> dict[str, EquivalentDamping]:
        """Equivalent damping by method: along the amplitudes of the oscillations, or at the trigger levels."""
        from scipy.special import stdtrit

        found = {}
        if self.decrements:
            ordered = sorted(self.decrements, key=lambda one: one.level)
            alpha = np.array([one.alpha for one in ordered])
            sd = np.array([math.hypot(one.zeta_sd * one.omega, one.zeta * one.omega_sd) for one in ordered])
            half = _jackknife_half(sd)
            found[RANDOM_DECREMENT] = EquivalentDamping(
                np.array([one.level for one in ordered]),
                np.array([one.omega for one in ordered]),
                alpha,
                sd,
                alpha - half,
                alpha + half,
                np.ones(alpha.size, dtype=bool),
                _LEVEL,
                "roll",
            )
        fit = self.joint
        if fit is not None:
            amplitudes = np.radians(fit.excitations["amplitude_deg"].to_numpy())
            a = np.linspace(float(amplitudes.min()), float(amplitudes.max()), points)
            values = np.array([self.guess.get(name, 0.0) for name in TERMS])
            places = [TERMS.index(name) for name in fit.names]
            values[places] = fit.params
            alpha, omega, gradient = equivalent_linear(values, a)
            rows = gradient[:, places]
            sd = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", rows, fit.cov, rows), 0.0))
            half = float(stdtrit(float(np.min(fit.t_dof)), 0.5 + 0.5 * _LEVEL)) * sd
            found[JOINT_FIT] = EquivalentDamping(
                a, omega, alpha, sd, alpha - half, alpha + half, np.ones(a.size, dtype=bool), _LEVEL, "roll"
            )
        return found

    @property
    def all_findings(self) -> list[Finding]:
        """Those of the record and of the methods, each once."""
        return list(dict.fromkeys([*self.record.findings, *self.findings]))

    def to_dict(self) -> dict[str, Any]:
        """Everything but the series, for JSON; what is not known is None."""
        fit, one = self.joint, self.record
        return {
            "name": one.name,
            "file": one.source,
            "sha256": one.sha256,
            "steps": list(one.steps),
            "guess": self.guess,
            "guess from": self.guessed_from,
            "noise [rad]": self.noise,
            "terms": _plain(self.terms()),
            "joint fit": None
            if fit is None
            else {
                "names": list(fit.names),
                "values": fit.params.tolist(),
                "covariance": fit.cov.tolist(),
                "own_share": fit.own_share,
                "condition": fit.condition_number,
                "r2": fit.r2,
                "oscillations": len(fit.excitations),
                "converged": fit.converged,
            },
            "discrete search": None
            if self.searched is None
            else {
                "oscillation at [s]": self.searched.start,
                "numbers it determines": self.searched.determines,
                "moves": self.searched.found.moves,
                "error [rad/s2]": self.searched.found.error,
                "local minimum": self.searched.found.local_minimum,
            },
            "failures": dict(self.failures),
            "findings": [vars(item) for item in self.all_findings],
        }


@dataclass(frozen=True, eq=False)
class AtSeaAnalysis:
    """What a campaign at sea yields.

    Attributes
    ----------
    campaign : DecayCampaign
    path : Path, optional
        Of the campaign file.
    records : tuple of AtSeaRecord
    """

    campaign: DecayCampaign
    path: Path | None
    records: tuple[AtSeaRecord, ...]

    def terms_frame(self) -> pd.DataFrame:
        """Terms of all methods; with several records also ``record``."""
        return self._stacked([one.terms() for one in self.records])

    def excitations_frame(self) -> pd.DataFrame:
        """Excitation of each oscillation of the joint fit, units in the names; with several records also ``record``."""
        import pandas as pd

        names = {
            "start": "start [s]",
            "period": "period [s]",
            "amplitude_deg": "amplitude [deg]",
            "f": "f [rad/s2]",
            "we": "we [rad/s]",
            "phase": "phase [rad]",
            "f0": "f0 [rad/s2]",
        }
        empty = pd.DataFrame(columns=list(names.values()))
        return self._stacked(
            [empty if one.joint is None else one.joint.excitations.rename(columns=names) for one in self.records]
        )

    def equivalent_frame(self) -> pd.DataFrame:
        """Equivalent damping against amplitude of each method; with several records also ``record``."""
        import pandas as pd

        frames = []
        for one in self.records:
            parts = []
            for method, found in one.equivalent(self.campaign.output.points).items():
                frame = found.to_frame()
                frame.insert(0, "method", method)
                parts.append(frame)
            frames.append(pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=["method"]))
        return self._stacked(frames)

    def _stacked(self, frames: list[pd.DataFrame]) -> pd.DataFrame:
        import pandas as pd

        if len(frames) == 1:
            return frames[0]
        named = [frame.assign(record=one.record.name) for one, frame in zip(self.records, frames)]
        return pd.concat([frame for frame in named if len(frame)] or named, ignore_index=True)

    def to_dict(self) -> dict[str, Any]:
        """Everything but the series, for JSON."""
        return {
            "format": "towtank damping at sea 1",
            "name": self.campaign.decay.name,
            "virtual": self.campaign.decay.virtual,
            "truth": dict(self.campaign.decay.truth),
            "records": [one.to_dict() for one in self.records],
        }


def joined_terms(names: tuple[str, ...]) -> str:
    """Terms as in the label of a model: ``b1+b3, c1+c3``."""
    damping = "+".join(name for name in names if name.startswith("b"))
    restoring = "+".join(name for name in names if name.startswith("c"))
    return ", ".join(part for part in (damping, restoring) if part)


def _jackknife_half(sd: Any) -> Any:
    """Half of the interval of a random decrement, whose errors come from leaving out one of its blocks at a time."""
    from scipy.special import stdtrit

    return float(stdtrit(BLOCKS - 1.0, 0.5 + 0.5 * _LEVEL)) * sd


def _row(method: str, model: str, name: str, value: float, sd: float, half: float, unit: str) -> dict[str, Any]:
    row = {"method": method, "model": model, "name": name, "value": value, "std": sd}
    return row | {"lower95": value - half, "upper95": value + half, "unit": unit}


def _plain(frame: pd.DataFrame) -> list[dict[str, Any]]:
    """Rows for JSON, which knows no nan."""
    rows = frame.to_dict("records")
    return [
        {str(key): None if isinstance(value, float) and math.isnan(value) else value for key, value in row.items()}
        for row in rows
    ]
