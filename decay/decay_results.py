"""What a decay campaign yields: groups of records with their fits, and the tables of all of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.findings import Finding
from ..core.ship import Ship
from .beside_memory import MemoryComparison
from .compare import DEFAULT_METHOD, DecayComparison
from .damping_models import damping_words
from .decay_campaign import DecayCampaign
from .decay_record import DecayRecord
from .heave_pitch import DecayRatio
from .ikeda_comparison import IkedaComparison
from .model_verdict import ModelVerdict
from .roll_damping import RollDamping

if TYPE_CHECKING:
    import pandas as pd

DISAGREES = "methods-disagree"
CONTRADICTED = "model-contradicted"


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
    memory : MemoryComparison, optional
        The records with radiation memory; its fit stands among the results of the first model.
    """

    label: str
    records: tuple[DecayRecord, ...]
    comparisons: Mapping[str, DecayComparison]
    verdict: ModelVerdict | None
    ratio: DecayRatio | None
    ikeda: IkedaComparison | None
    findings: tuple[Finding, ...] = ()
    memory: MemoryComparison | None = None

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
        if self.verdict is not None and self.verdict.contradicts(damping_words(fit.model)):
            rules.append(CONTRADICTED)
        return tuple(dict.fromkeys(rules)) or (() if fit.trusted else ("not-converged",))

    @property
    def all_findings(self) -> list[Finding]:
        """Those of the records, of the group and of the fits, each once."""
        found = [item for one in self.records for item in one.findings]
        found += [*self.findings, *(self.ikeda.findings if self.ikeda is not None else ())]
        found += self.memory.findings if self.memory is not None else ()
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

        B44 and B44-hat are there where the ship's volume and GM are known; ``speed [m/s]`` where records of several
        speeds were fitted together.
        """
        points = self.campaign.output.points

        def frames(group: DecayGroup) -> list[pd.DataFrame]:
            speeds = sorted({one.speed for one in group.records})
            if len(speeds) == 1:
                return [equivalent_rows(one, points, speeds[0]) for one in group.results]
            return [
                equivalent_rows(one, points, speed).assign(**{"speed [m/s]": speed})
                for one in group.results
                for speed in speeds
            ]

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
        **_standard_forms(group.preferred),
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
        "memory": None if group.memory is None else _memory_dict(group.memory),
        "results": [one.to_dict() for one in group.results],
        "failures": group.failures,
        "findings": [vars(item) for item in group.all_findings],
    }


def _standard_forms(fit: RollDamping) -> dict[str, Any]:
    """Extinction coefficients for angles in degrees, and Bertin's N at the angles of IMO MSC.1/Circ.1200."""
    if fit.motion == "heave" or fit.model.curve is not None:
        return {}
    return {
        "extinction": fit.extinction(degrees=True).to_dict("index"),
        "bertin": fit.bertin().to_dict("records"),
    }


def _memory_dict(memory: MemoryComparison) -> dict[str, Any]:
    """Transfer function and what was known beside it; the fit stands among the results."""
    found = memory.identified
    return {
        "file": memory.table.source,
        "sha256": memory.table.sha256,
        "known": memory.known,
        "order": found.order,
        "numerator": found.function.numerator.tolist(),
        "denominator": found.function.denominator.tolist(),
        "added_mass_at_infinity": found.infinite,
        "r2_damping": found.r2_damping,
        "r2_added_mass": found.r2_added_mass,
        "tried": found.tried.to_dict("records"),
    }


def ship_of(analysis: DecayAnalysis) -> Ship | None:
    """The ship of the first group at the scale of its records."""
    return analysis.groups[0].records[0].ship
