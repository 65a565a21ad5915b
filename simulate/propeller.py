"""Propeller models: what is known about the thrust behind the hull."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core.errors import TowtankError

WAKES = ("constant", "C1C2", "exponential", "sway and yaw")

ASTERN_SHARE = 0.65
"""Thrust of a reversed propeller over its bollard thrust ahead at the same rate, where nothing is known about it.

Assumed: blade sections of a fixed pitch that run on their trailing edges lose about a third of their thrust.
"""


@dataclass(frozen=True, eq=False)
class Propeller:
    """A propeller with an open-water diagram, a wake and a thrust deduction.

    Attributes
    ----------
    D : float
        Diameter in m.
    KT : sequence of float, shape (k,) with k <= 5, or ndarray, shape (n, 2)
        Coefficients of the thrust coefficient as a polynomial of J, constant first; or a table of J and KT,
        interpolated by a monotone cubic.
    wP0 : float
        Wake fraction in straight motion.
    tP : float
        Thrust deduction fraction.
    xP : float
        Longitudinal position over L, negative aft.
    wake : {"constant", "C1C2", "exponential", "sway and yaw"}
        How the wake changes with the drift angle at the propeller, ``betaP = beta - xP r'``:
        ``C1C2``: ``1-wP = (1-wP0) (1 + (1 - exp(-C1 |betaP|)) (C2 - 1))`` (Yasukawa and Yoshimura 2015);
        ``exponential``: ``wP = wP0 exp(-C1 betaP**2)`` (Hirano 1980: C1 = 4);
        ``sway and yaw``: ``uP = u ((1-wP0) + tau ((v' + xP r')**2 + cPv v' + cPr r'))`` (Son and Nomoto 1981).
    C1 : float
    C2_positive, C2_negative : float
        C2 for positive and negative betaP.
    tau, cPv, cPr : float
        Of the wake of Son and Nomoto.
    KQ : sequence of float
        Torque coefficient as a polynomial of J; for engines of constant torque.
    astern_KT : float, optional
        Thrust coefficient at negative rates, as a positive number: ``T = -astern_KT rho n**2 D**4`` beside the drag
        of the polynomial's quadratic term where that is negative. None: :data:`ASTERN_SHARE` of KT at J = 0 is
        assumed.
    number : int
        Propellers of the ship, all with the thrust of the centre.
    """

    D: float
    KT: Sequence[float] | np.ndarray
    wP0: float = 0.0
    tP: float = 0.0
    xP: float = -0.48
    wake: str = "constant"
    C1: float = 0.0
    C2_positive: float = 1.0
    C2_negative: float = 1.0
    tau: float = 0.0
    cPv: float = 0.0
    cPr: float = 0.0
    KQ: Sequence[float] = ()
    astern_KT: float | None = None
    number: int = 1

    def __post_init__(self) -> None:
        if not self.D > 0.0:
            raise TowtankError(f"propeller: D = {self.D} m is not positive")
        if self.wake not in WAKES:
            raise TowtankError(f"wake '{self.wake}' is not known", cure=f"use one of {', '.join(WAKES)}")
        thrust = np.array(self.KT, dtype=float)
        if thrust.ndim == 2 and (thrust.shape[1] != 2 or len(thrust) < 3 or np.any(np.diff(thrust[:, 0]) <= 0.0)):
            raise TowtankError("a table of KT needs rows (J, KT) with ascending J, three or more")
        if thrust.ndim not in (1, 2) or (thrust.ndim == 1 and not 1 <= len(thrust) <= 5):
            raise TowtankError(
                "KT is neither a polynomial of J nor a table",
                cure="give one to five coefficients, or rows of J and KT",
            )
        object.__setattr__(self, "KT", thrust)

    @property
    def tabulated(self) -> bool:
        """True when KT is a table."""
        return np.ndim(self.KT) == 2

    @property
    def coefficients(self) -> dict[str, float]:
        """Coefficients ``k0``, ``k1``, ... of the polynomial; empty for a table."""
        return {} if self.tabulated else {f"k{power}": float(value) for power, value in enumerate(self.KT)}

    @property
    def thrust_astern(self) -> float:
        """Thrust coefficient at negative rates as a positive number, given or assumed."""
        if self.astern_KT is not None:
            return self.astern_KT
        table = np.asarray(self.KT)
        bollard = float(np.interp(0.0, table[:, 0], table[:, 1])) if self.tabulated else self.coefficients["k0"]
        return ASTERN_SHARE * max(bollard, 0.0)

    def enlarged(self, k: float) -> Propeller:
        """The propeller of a ship `k` times as long."""
        return replace(self, D=self.D * k)


@dataclass(frozen=True)
class ThrustSurface:
    """Thrust and rudder flow as quadratic forms of speed and rate (van Berlekom and Goddard 1972).

    ``T/m = Tuu u**2 / L + Tun u n + Tnn L |n| n``; flow at the rudder ``c**2 = cun u n + cnn n**2``.

    Attributes
    ----------
    Tuu, Tun, Tnn : float
        Thrust over the mass of the ship.
    cun, cnn : float
        Flow at the rudder, m and m2.
    tP : float
        Thrust deduction fraction.
    """

    Tuu: float
    Tun: float
    Tnn: float
    cun: float = 0.0
    cnn: float = 0.0
    tP: float = 0.0

    def enlarged(self, k: float) -> ThrustSurface:
        """The surface of a ship `k` times as long."""
        return replace(self, cun=self.cun * k, cnn=self.cnn * k**2)
