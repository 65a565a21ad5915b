"""Speed trials in shallow or narrow water: what the depth took from the speed, or added to the power.

Each correction refuses conditions outside those that its authors named, unless told ``guarded=False``.
Sources: Lackenby 1963; ITTC 7.5-04-01-01.1 (2017) after Raven; Schuster 1952; Tamura 1972; Scott 1966; all as in the
5th MASHCON papers on shallow-water trials.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..core.errors import TowtankError
from ..core.variables import GRAVITY
from .viscous_depth import viscous_ratio

LACKENBY_LEAST_SECTION = 0.05
"""Least midship section over depth squared."""

RAVEN_LARGEST_DEPTH_FROUDE = 0.65
"""The trial paper's limit; Raven's own paper of the same year says 0.70."""

RAVEN_LARGEST_VOLUME_CHANGE = 0.05

SCHUSTER_LARGEST_DEPTH_FROUDE = 0.70

SCOTT_LARGEST_FROUDE = 0.38


def lackenby_speed_loss(speed: float, depth: float, midship_area: float, *, guarded: bool = True) -> float:
    """Relative speed loss dV/V (Lackenby).

    Parameters
    ----------
    speed : float
        m/s.
    depth : float
        m.
    midship_area : float
        m2.
    guarded : bool
        Refuse a section below 0.05 h^2, where the formula over-corrects.

    Raises
    ------
    TowtankError
        For water that is too deep for the formula, when guarded.
    """
    section = midship_area / depth**2
    if guarded and section < LACKENBY_LEAST_SECTION:
        raise TowtankError(
            f"Lackenby: midship section over depth squared is {section:.3f}, less than {LACKENBY_LEAST_SECTION}",
            cure="apply no depth correction, or the one of ITTC 2017",
        )
    return 0.1242 * (section - 0.05) + 1.0 - math.sqrt(math.tanh(GRAVITY * depth / speed**2))


def schuster_speed_loss(
    depth_froude: float, blockage: float, viscous_share: float, *, guarded: bool = True
) -> float:
    """Relative speed loss dV/V (Schuster): ``m/(1 - m - Fh^2) + (1 - RV/RT) 2/3 Fh^10``.

    Parameters
    ----------
    depth_froude, blockage : float
    viscous_share : float
        Viscous over total resistance in deep water.
    guarded : bool
        Refuse depth Froude numbers above 0.7.

    Raises
    ------
    TowtankError
        Above the limit when guarded, and where ``1 - m - Fh^2`` is not positive.
    """
    if guarded and depth_froude > SCHUSTER_LARGEST_DEPTH_FROUDE:
        raise TowtankError(
            f"Schuster: depth Froude number {depth_froude:.3f} above {SCHUSTER_LARGEST_DEPTH_FROUDE}",
            cure="use a test in deeper or wider water",
        )
    free = 1.0 - blockage - depth_froude**2
    if free <= 0.0:
        raise TowtankError(f"Schuster: no flow at depth Froude number {depth_froude:.3f}, blockage {blockage:.3f}")
    return blockage / free + (1.0 - viscous_share) * 2.0 / 3.0 * depth_froude**10


def tamura_speed_loss(depth_froude: float, blockage: float, length_ratio: float) -> float:
    """Relative speed loss dV/V in a channel (Tamura): ``0.67 m ratio^(3/4) / (1 - Fh^2)``.

    Parameters
    ----------
    depth_froude, blockage : float
    length_ratio : float
        Ship length over the width of the channel as the 5th MASHCON paper prints it [S]; over the breadth of the
        ship in the form of the ITTC [?]. The two differ by a factor of several.

    Raises
    ------
    TowtankError
        At and above the critical speed of the depth.
    """
    if not depth_froude < 1.0:
        raise TowtankError(f"Tamura: depth Froude number {depth_froude:.3f} is not below 1")
    return 0.67 * blockage * length_ratio**0.75 / (1.0 - depth_froude**2)


def scott_speed_loss(
    froude: float,
    *,
    volume: float,
    breadth: float,
    length: float,
    section: float,
    volume_coefficient: float,
    wave_coefficient: float,
    guarded: bool = True,
) -> float:
    """Relative speed loss dV/V in a tank (Scott): ``(K1 volume + K2 B L^2) / section^(3/2)``.

    Parameters
    ----------
    froude : float
        Of the length.
    volume, breadth, length, section : float
        Displacement in m3, ship's breadth and length in m, section of the water in m2.
    volume_coefficient, wave_coefficient : float
        K1, by Reynolds number, and K2, by Froude number, from Scott's curves.
    guarded : bool
        Refuse Froude numbers above 0.38, where the curve of K2 ends.

    Raises
    ------
    TowtankError
        Above the limit when guarded.
    """
    if guarded and froude > SCOTT_LARGEST_FROUDE:
        raise TowtankError(
            f"Scott: Froude number {froude:.3f} above {SCOTT_LARGEST_FROUDE}", cure="use Kreitner or Tamura"
        )
    return (volume_coefficient * volume + wave_coefficient * breadth * length**2) / section**1.5


@dataclass(frozen=True)
class TrialCorrection:
    """Power that shallow water cost (ITTC 2017, Raven), in W, and the quantities on the way.

    Attributes
    ----------
    viscous_power : float
        For the larger viscous resistance.
    sinkage_power : float
        For the displacement that the additional sinkage brings.
    additional_sinkage : float
        In m, against deep water.
    volume_change : float
        Displacement of that sinkage over displacement.
    """

    viscous_power: float
    sinkage_power: float
    additional_sinkage: float
    volume_change: float

    @property
    def power(self) -> float:
        """Both parts together in W: to be taken from the measured power."""
        return self.viscous_power + self.sinkage_power


def raven_trial_correction(
    *,
    speed: float,
    depth: float,
    length: float,
    draught: float,
    volume: float,
    waterplane_area: float,
    deep_viscous_resistance: float,
    deep_power: float,
    propulsive_efficiency: float,
) -> TrialCorrection:
    """Power correction of a trial in shallow water, without a change of wave resistance.

    Parameters
    ----------
    speed, depth, length, draught, volume, waterplane_area : float
        SI.
    deep_viscous_resistance : float
        At this speed in deep water, N.
    deep_power : float
        W.
    propulsive_efficiency : float

    Returns
    -------
    TrialCorrection

    Raises
    ------
    TowtankError
        Outside the limits of the method: Fh above 0.65, T/h of 0.5, displacement change of 5 %, or a speed
        whose deep-water reference ``V / sqrt(0.3 g L)`` is 1 or more.

    Notes
    -----
    The additional sinkage is Tuck's, ``1.46 volume/L^2 (F(Fh) - F(FHD))`` with ``F(x) = x^2/sqrt(1 - x^2)``, power
    goes with displacement to 2/3: ``P ((1 + change)^(2/3) - 1)``. The trial paper prints ``P change^(2/3)``, which for
    a change of 1 % would be 4.6 % of the power and not 0.7 %.
    """
    sinkage = additional_sinkage(speed=speed, depth=depth, length=length, volume=volume)
    change = sinkage * waterplane_area / volume
    if change >= RAVEN_LARGEST_VOLUME_CHANGE:
        raise TowtankError(
            f"trial correction: displacement changes by {100 * change:.1f} %, the method ends at 5 %",
            cure="sail the trial in deeper water or more slowly",
        )
    resistance = deep_viscous_resistance * (viscous_ratio(draught, depth) - 1.0)
    return TrialCorrection(
        viscous_power=resistance * speed / propulsive_efficiency,
        sinkage_power=deep_power * ((1.0 + change) ** (2.0 / 3.0) - 1.0),
        additional_sinkage=sinkage,
        volume_change=change,
    )


def additional_sinkage(*, speed: float, depth: float, length: float, volume: float) -> float:
    """Sinkage in m that shallow water adds to that in deep (ITTC 2017): ``1.46 volume/L^2 (F(Fh) - F(FHD))``.

    Parameters
    ----------
    speed, depth, length, volume : float
        SI.

    Raises
    ------
    TowtankError
        For Fh above 0.65, or a speed whose deep-water reference ``V / sqrt(0.3 g L)`` is 1 or more.
    """
    froude = speed / math.sqrt(GRAVITY * depth)
    deep_froude = speed / math.sqrt(0.3 * GRAVITY * length)
    if froude > RAVEN_LARGEST_DEPTH_FROUDE:
        raise TowtankError(
            f"trial correction: depth Froude number {froude:.3f} above {RAVEN_LARGEST_DEPTH_FROUDE}",
            cure="sail the trial in deeper water or more slowly",
        )
    if deep_froude >= 1.0:
        raise TowtankError(
            f"trial correction: V / sqrt(0.3 g L) = {deep_froude:.3f}, the sinkage formula ends at 1",
            cure="the method is not for fast ships",
        )
    # Deeper than 0.3 L counts as deep: a difference below zero would be a gain from shallow water.
    excess = max(0.0, _tuck_factor(froude) - _tuck_factor(deep_froude))
    return 1.46 * volume / length**2 * excess


def _tuck_factor(froude: float) -> float:
    return froude**2 / math.sqrt(1.0 - froude**2)
