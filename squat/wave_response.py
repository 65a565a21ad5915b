"""Responses of a ship to regular waves: amplitude and phase of each motion over the wave that a gauge saw."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..core.errors import FitError
from .head_waves import HeadWave, wave_of_encounter
from .squat_in_waves import SquatInWaves, harmonic_errors

if TYPE_CHECKING:
    import pandas as pd

LEAST_SHARE = 0.5
"""Part of its variance that a gauge must have at the frequency of encounter to be one that moves with the ship."""

RESPONSE_COLUMNS = (
    "run",
    "quantity",
    "ratio",
    "ratio_se",
    "phase",
    "phase_se",
    "over_slope",
    "unit",
    "wave_amplitude",
    "omega_encounter",
    "omega",
    "wave_number",
    "wave_length",
    "reference_x",
)


@dataclass(frozen=True, eq=False)
class WaveResponses:
    """First harmonics of one run over the wave.

    Attributes
    ----------
    frame : DataFrame
        Columns :data:`RESPONSE_COLUMNS`, one row a quantity: amplitude over that of the wave and its standard error in
        `unit`; phase lead over the wave crest at `reference_x` and its standard error in rad; for the trim also
        ``over_slope``, the amplitude over the wave slope k zeta; wave amplitude in m, frequencies in rad/s, wave
        number in rad/m, length and place in m.
    wave : HeadWave
        The wave that belongs to frequency of encounter, speed and depth.
    notes : tuple of str
        What is doubtful about the gauge.
    """

    frame: pd.DataFrame
    wave: HeadWave
    notes: tuple[str, ...] = ()


def wave_responses(
    waves: SquatInWaves, gauge: str, *, gauge_x: float, reference_x: float, depth: float, speed: float
) -> WaveResponses:
    """Responses of every quantity of a run to head waves.

    Parameters
    ----------
    waves : SquatInWaves
        With the gauge among its quantities.
    gauge : str
        Channel of the wave elevation in m, positive up; the gauge moves with the ship.
    gauge_x, reference_x : float
        Place of the gauge, and that which phases are told for, in m forward of midship.
    depth, speed : float
        Water depth in m and speed of the ship in m/s, which give the wave its length.

    Raises
    ------
    FitError
        When the gauge was not analysed, is no length, or saw no wave.
    TowtankError
        When the depth is not positive.

    Notes
    -----
    Sinkage is positive down and the elevation up, so that a ship that follows a long wave has a phase of 180 degrees.
    """
    import pandas as pd

    wave = wave_of_encounter(waves.omega, depth, speed)
    if waves.units.get(gauge, "m") not in ("m", ""):
        raise FitError(
            f"the wave elevation is in {waves.units[gauge]}",
            cure="name a channel of length, or declare its unit",
            place=f"channel {gauge}",
        )
    rows = []
    for quantity, fit in waves.fits.items():
        if quantity == gauge:
            continue
        found = waves.response(quantity, gauge, wave_x=gauge_x, to_x=reference_x, k=wave.wave_number)
        elevation = waves.fits[gauge]
        ratio, height = abs(found), float(elevation.amplitude[0])
        size, turn = harmonic_errors(fit)
        wave_size, wave_turn = harmonic_errors(elevation)
        unit = waves.units[quantity]
        trim = quantity == "trim"
        rows.append(
            (
                waves.run,
                quantity,
                ratio,
                math.hypot(size, ratio * wave_size) / height,
                math.atan2(found.imag, found.real),
                math.hypot(turn, wave_turn),
                ratio / wave.wave_number if trim else math.nan,
                "1/m" if trim else f"{unit or '-'}/m",
                height,
                waves.omega,
                wave.omega,
                wave.wave_number,
                wave.length,
                reference_x,
            )
        )
    share = float(waves.fits[gauge].r2)
    notes = (
        (
            f"the gauge '{gauge}' has {100.0 * share:.0f} % of its variance at the frequency of encounter: it may "
            "stand in the tank instead of moving with the ship",
        )
        if share < LEAST_SHARE
        else ()
    )
    return WaveResponses(pd.DataFrame(rows, columns=list(RESPONSE_COLUMNS)), wave, notes)
