"""The drawings of the decay report: every figure of a group of records as inline SVG with its caption."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..decay.decay_results import DecayGroup
from ..decay.equivalent_damping import EquivalentDamping, equivalent_linear
from ..decay.term_values import term_values
from .damping_figures import (
    coefficient_ellipse,
    decay_record_figure,
    decay_residual_figure,
    drawn,
    equivalent_damping_figure,
    extinction_figure,
    ikeda_figure,
)
from .damping_memory import draw_memory
from .drawings import Drawing
from .figure_style import Sheet, new_axes

if TYPE_CHECKING:
    pass

MOST_RECORDS = 12
"""Records of a group that are drawn one by one."""

WIDE, LARGE = (7.2, 2.5), (6.4, 4.0)


@dataclass(frozen=True)
class DampingDrawings:
    """The drawings of one group by their place in the page."""

    records: tuple[Drawing, ...]
    residuals: tuple[Drawing, ...]
    extinction: Drawing
    equivalent: Drawing
    others: tuple[Drawing, ...]
    ellipse: Drawing | None
    ikeda: Drawing | None
    memory: tuple[Drawing, ...] = ()


def draw_group(group: DecayGroup, prefix: str, truth: Mapping[str, float]) -> DampingDrawings:
    """Every drawing of a group.

    Parameters
    ----------
    group : DecayGroup
    prefix : str
        Unique in the page.
    truth : mapping of str to float
        True coefficients of virtual records; empty for measured ones.
    """
    fit = group.preferred
    count = min(len(group.records), MOST_RECORDS)
    records = tuple(
        drawn(
            decay_record_figure(record, fit, number, ax=new_axes(WIDE)),
            f"{prefix}-record-{number}",
            f"{record.name}. Dotted: start of the free part.",
        )
        for number, record in enumerate(group.records[:count])
    )
    residuals = tuple(
        drawn(
            decay_residual_figure(fit, number, ax=new_axes((7.2, 1.9))),
            f"{prefix}-residual-{number}",
            f"{fit.runs[number].name}: residual of the {fit.method} fit; band: two standard deviations.",
        )
        for number in range(count)
    )
    free = [name for name in fit.model.damping if name in fit.model.free]
    ellipse = None
    if len(free) >= 2:
        pair = (free[-2], free[-1])
        ellipse = drawn(
            coefficient_ellipse(fit, pair, truth=truth),
            f"{prefix}-ellipse",
            f"Correlation of {pair[0]} and {pair[1]}: {fit.linear_quadratic_correlation:+.3f}.",
        )
    ikeda = None
    if group.ikeda is not None:
        ikeda = drawn(
            ikeda_figure(group.ikeda, ax=Sheet(LARGE).axes),
            f"{prefix}-ikeda",
            "Equivalent damping of the decay with its 95 % band beside the components of the simplified Ikeda formula.",
        )
    return DampingDrawings(
        records=records,
        residuals=residuals,
        extinction=drawn(
            extinction_figure(group.records, fit),
            f"{prefix}-extinction",
            "Loss of each half cycle; dotted: below the smallest amplitude of the records.",
        ),
        equivalent=drawn(
            equivalent_damping_figure(
                _equivalents(group, 0), truth=true_damping(group, truth), ax=new_axes(LARGE)
            ),
            f"{prefix}-equivalent",
            f"{next(iter(group.comparisons))} damping; bands: 95 % intervals.",
        ),
        others=tuple(
            drawn(
                equivalent_damping_figure(
                    _equivalents(group, place), truth=true_damping(group, truth), ax=new_axes(LARGE)
                ),
                f"{prefix}-equivalent-{place}",
                f"{words} damping; bands: 95 % intervals.",
            )
            for place, words in enumerate(group.comparisons)
            if place
        ),
        ellipse=ellipse,
        ikeda=ikeda,
        memory=() if group.memory is None else draw_memory(group.memory, prefix),
    )


def _equivalents(group: DecayGroup, place: int) -> dict[str, EquivalentDamping]:
    comparison = list(group.comparisons.values())[place]
    return comparison.equivalent(speed=group.records[0].speed)


def true_damping(group: DecayGroup, truth: Mapping[str, float]) -> EquivalentDamping | None:
    """Equivalent damping of the true coefficients of a virtual record over its amplitudes; None without truth."""
    if not truth:
        return None
    at = np.linspace(*group.preferred.diagnostics.amplitudes, 40)
    alpha, omega, _ = equivalent_linear(term_values(truth), at)
    none = np.zeros_like(at)
    return EquivalentDamping(
        at, omega, alpha, none, alpha, alpha, np.ones(at.size, dtype=bool), 0.95, group.preferred.motion
    )
