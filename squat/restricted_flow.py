"""Flow past a ship in a channel: critical speeds, overspeed, and what they do to sinkage and speed of a record.

One-dimensional theory: water that passes the ship must fit through what the ship and its own drop of level leave
free. ``gamma`` is the total speed of that water over the ship's, 1 where nothing is disturbed: an overspeed of
11 % is gamma = 1.11. Between the two critical speeds no steady flow exists; ``nan`` is the answer there.

Sources: Schijf 1949; Kreitner 1934; Raven 2018 and his paper of the 5th MASHCON, equations 1 to 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def critical_depth_froude(blockage: float) -> tuple[float, float]:
    """Depth Froude numbers between which no steady flow exists (Schijf).

    Parameters
    ----------
    blockage : float
        As/Ac, 0 to 1.

    Returns
    -------
    lower, upper : float
        End of the subcritical and beginning of the supercritical range; both are 1 without blockage.
    """
    _check_blockage(blockage)
    angle = math.asin(1.0 - blockage)
    return (2.0 * math.sin(angle / 3.0)) ** 1.5, (2.0 * math.sin((math.pi - angle) / 3.0)) ** 1.5


@dataclass(frozen=True, eq=False)
class Overspeed:
    """Flow beside the ship at each speed.

    Attributes
    ----------
    gamma : ndarray, shape (n,)
        Flow speed over ship speed; nan at and above the lower critical speed.
    critical : float
        Depth Froude number above which there is no answer.
    """

    gamma: np.ndarray
    critical: float

    @property
    def subcritical(self) -> np.ndarray:
        """Whether a steady flow exists at each speed, shape (n,)."""
        return np.isfinite(self.gamma)


def kreitner(blockage: float, depth_froude: ArrayLike) -> Overspeed:
    """Overspeed against unlimited width *and* depth, not against shallow water of infinite width.

    ``gamma (1 - m + Fh^2 (1 - gamma^2) / 2) = 1``, smallest root above 1.

    Parameters
    ----------
    blockage : float
        m = As/Ac.
    depth_froude : array_like, shape (n,)

    Raises
    ------
    TowtankError
        For a blockage outside 0 to 1 or a negative speed.
    """
    _check_blockage(blockage)
    froude = _depth_froude(depth_froude)
    critical = critical_depth_froude(blockage)[0]
    gamma = _channel_speed(blockage, froude, np.ones_like(froude))
    # Above the upper critical speed the cubic has roots again, of another kind of flow.
    return Overspeed(np.where(froude <= critical, gamma, np.nan), critical)


def raven_overspeed(blockage: float, depth_froude: ArrayLike, gamma: float, outflow: float) -> np.ndarray:
    """Overspeed that the walls add to that of infinitely wide shallow water, nan where no flow exists.

    Parameters
    ----------
    blockage : float
        m = As/Ac.
    depth_froude : array_like, shape (n,)
    gamma : float
        Flow over ship speed in shallow water of infinite width, averaged over the width of the channel.
    outflow : float
        Flow that leaves through the planes of the walls in infinitely wide water, over V Ac.

    Returns
    -------
    ndarray, shape (n,)
        Delta gamma.

    Notes
    -----
    Raven's equation 2 is the continuity in the channel with the right-hand side of the wide water; with gamma = 1
    and an outflow equal to the blockage it is Kreitner's.
    """
    _check_blockage(blockage)
    froude = _depth_froude(depth_froude)
    flow = outflow + gamma * (1.0 - blockage + 0.5 * froude**2 * (1.0 - gamma**2))
    total = _channel_speed(blockage, froude, flow)
    return np.where(total >= gamma, total - gamma, np.nan)


def level_drop(depth: float, depth_froude: ArrayLike, gamma: ArrayLike) -> np.ndarray:
    """Drop of the water level beside the ship in m, ``Fh^2 h (gamma^2 - 1) / 2``; `depth` in m."""
    return np.asarray(0.5 * _depth_froude(depth_froude) ** 2 * depth * (np.asarray(gamma, dtype=float) ** 2 - 1.0))


def wall_sinkage(
    depth: float, depth_froude: ArrayLike, waterline_gamma: ArrayLike, wall_overspeed: ArrayLike
) -> np.ndarray:
    """Sinkage in m that the walls add (Raven, equation 3): subtract it from a tank's to get wide water's.

    Parameters
    ----------
    depth : float
        In m.
    depth_froude : array_like, shape (n,)
    waterline_gamma : array_like
        Flow over ship speed along the waterline in wide water.
    wall_overspeed : array_like
        From :func:`raven_overspeed`.

    Notes
    -----
    Too large for strong effects, says its author.
    """
    along = np.asarray(waterline_gamma, dtype=float)
    return level_drop(depth, depth_froude, along + wall_overspeed) - level_drop(depth, depth_froude, along)


def equivalent_speed(speed: ArrayLike, waterline_gamma: ArrayLike, wall_overspeed: ArrayLike) -> np.ndarray:
    """Speed in wide water with the resistance that a tank shows at `speed` (Raven, equation 4).

    Good for shifts up to some 5 %. Resistance stays, points move to the higher speed.
    """
    along = np.asarray(waterline_gamma, dtype=float)
    return np.asarray(np.asarray(speed, dtype=float) * (along + wall_overspeed) / along)


def _channel_speed(blockage: float, froude: np.ndarray, flow: np.ndarray) -> np.ndarray:
    """Smallest positive g of ``g (1 - m + F^2 (1 - g^2)/2) = flow``, nan where there is none.

    With g = 2 sqrt(p/3) sin(a) the cubic g^3 - p g + q becomes sin(3 a) = q / (2 (p/3)^1.5): no iteration.
    """
    free = 1.0 - blockage + 0.5 * froude**2
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        scale = np.sqrt(2.0 * free / (3.0 * froude**2))
        root = 2.0 * scale * np.sin(np.arcsin(flow / (froude**2 * scale**3)) / 3.0)
    # Where the level hardly drops, continuity alone remains: the sine formula divides by zero at rest.
    return np.where(froude < 1e-6, flow / free, root)


def _check_blockage(blockage: float) -> None:
    if not 0.0 <= blockage < 1.0:
        raise TowtankError(
            f"blockage {blockage} is not between 0 and 1",
            cure="give ship section over water section, not its inverse",
        )


def _depth_froude(values: ArrayLike) -> np.ndarray:
    froude = np.atleast_1d(np.asarray(values, dtype=float))
    if not (np.isfinite(froude).all() and (froude >= 0).all()):
        raise TowtankError("a depth Froude number is negative or not a number", cure="give V / sqrt(g h)")
    return froude
