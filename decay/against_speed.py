"""Damping against forward speed: the quoted fits of groups that differ in nothing but their speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .decay_results import DecayGroup

if TYPE_CHECKING:
    import pandas as pd


def speed_series(groups: Sequence[DecayGroup]) -> list[list[DecayGroup]]:
    """Groups of one motion, scale and depth at two speeds or more, each series by rising speed."""
    series: dict[tuple[str, float, float | None], list[DecayGroup]] = {}
    for group in groups:
        first = group.records[0]
        depth = None if first.ship is None else first.ship.depth
        series.setdefault((first.motion, first.scale, depth), []).append(group)
    return [
        sorted(members, key=lambda one: one.records[0].speed)
        for members in series.values()
        if len({one.records[0].speed for one in members}) > 1
    ]


def common_amplitude(members: Sequence[DecayGroup]) -> float:
    """Amplitude in rad (heave: m) in the middle of what all groups held; of the first when they share none."""
    ranges = [one.preferred.diagnostics.amplitudes for one in members]
    low, high = max(low for low, _ in ranges), min(high for _, high in ranges)
    if not low < high:
        low, high = ranges[0]
    return float(np.sqrt(low * high))


def against_speed(groups: Sequence[DecayGroup]) -> pd.DataFrame:
    """Coefficients and equivalent damping of the quoted fits against speed.

    Parameters
    ----------
    groups : sequence of DecayGroup

    Returns
    -------
    DataFrame
        Columns ``motion, scale, depth [m], speed [m/s], Fn [-], method, model, name, value, std, lower95, upper95,
        unit``; ``alpha_e``, ``zeta`` and ``omega`` stand at one amplitude that all speeds held, given in ``at`` (deg,
        heave: mm). Empty without two speeds.
    """
    import pandas as pd

    rows = []
    for members in speed_series(groups):
        amplitude = common_amplitude(members)
        for group in members:
            fit, first = group.preferred, group.records[0]
            ship = first.ship
            about = {
                "motion": first.motion,
                "scale": first.scale,
                "depth [m]": np.inf if ship is None else ship.depth,
                "speed [m/s]": first.speed,
                "Fn [-]": np.nan if ship is None else ship.froude_number(first.speed),
                "method": fit.method,
                "model": fit.model.label,
            }
            limits = fit.conf_int()
            for place, name in enumerate(fit.names):
                value = {"name": name, "value": fit.params[place], "std": fit.bse[place]}
                value |= {"lower95": limits[place, 0], "upper95": limits[place, 1], "unit": fit.units[name]}
                rows.append({**about, **value, "at": np.nan})
            at = fit.equivalent([amplitude], speed=first.speed)
            shown = 1000.0 * amplitude if first.motion == "heave" else float(np.degrees(amplitude))
            omega = float(at.omega[0])
            alpha = [float(one[0]) for one in (at.alpha, at.alpha_sd, at.alpha_lower, at.alpha_upper)]
            found = (
                ("alpha_e", *alpha, "1/s"),
                ("zeta", *(one / omega for one in alpha), "-"),
                ("omega", omega, np.nan, np.nan, np.nan, "rad/s"),
            )
            names = ("name", "value", "std", "lower95", "upper95", "unit")
            rows += [{**about, **dict(zip(names, one)), "at": shown} for one in found]
    return pd.DataFrame(rows)
