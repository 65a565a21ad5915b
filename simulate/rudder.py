"""Rudder models: normal force, inflow and interaction with the hull."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..core.errors import TowtankError

_LATERAL = ("MMG", "Son-Nomoto")


@dataclass(frozen=True)
class Rudder:
    """A rudder behind the propeller.

    ``FN = 0.5 rho area UR**2 f_alpha sin(alphaR)``, ``X = -(1-tR) FN sin(delta)``, ``Y = -(1+aH) FN cos(delta)``,
    ``N = -(xR + aH xH) FN cos(delta)``, ``K = zR (1+aH) FN cos(delta)`` (Yasukawa and Yoshimura 2015;
    K: Son and Nomoto 1981).

    Attributes
    ----------
    area : float
        Area in m2.
    f_alpha : float
        Slope of the normal force; see :func:`fujii_slope`.
    tR, aH : float
        Steering resistance deduction, rudder force increase.
    xR, xH : float
        Positions of rudder and of the added force over L, negative aft.
    zR : float
        Height of the rudder force below the roll axis over L.
    eps : float
        Inflow at the rudder over that at the propeller.
    kappa : float
        Share of the propeller's acceleration in the inflow.
    eta : float
        Propeller diameter over rudder height; the part of the rudder in the slipstream.
    gammaR_positive, gammaR_negative : float
        Flow straightening for positive and negative drift angle at the switching place.
    lR : float
        Effective position of the flow straightening over L, ``betaR = beta - lR r'``.
    switch : {"betaR", "betaP"}
        Whose sign chooses gammaR.
    inflow : {"MMG", "Son-Nomoto"}
        Lateral inflow ``U gammaR betaR``, or
        ``-U (gammaR v' + cRr r' + cRrrr r'**3 + cRrrv r'**2 v')``.
    cRr, cRrrr, cRrrv : float
        Of the inflow of Son and Nomoto.
    number : int
        Rudders of the ship, all with the inflow of the centre.

    Notes
    -----
    ``uR = eps sqrt(eta (uP + kappa (sqrt(uP**2 + 8 T/(rho pi D**2)) - uP))**2 + (1-eta) uP**2)``; with the inflow of
    Son and Nomoto ``uR = eps sqrt(uP**2 + 8 kappa T/(rho pi D**2))``.
    """

    area: float
    f_alpha: float
    tR: float = 0.0
    aH: float = 0.0
    xR: float = -0.5
    xH: float = -0.45
    zR: float = 0.0
    eps: float = 1.0
    kappa: float = 0.5
    eta: float = 1.0
    gammaR_positive: float = 0.5
    gammaR_negative: float = 0.5
    lR: float = -0.9
    switch: str = "betaR"
    inflow: str = "MMG"
    cRr: float = 0.0
    cRrrr: float = 0.0
    cRrrv: float = 0.0
    number: int = 1

    def __post_init__(self) -> None:
        if not self.area > 0.0:
            raise TowtankError(f"rudder: area = {self.area} m2 is not positive")
        if self.inflow not in _LATERAL:
            raise TowtankError(
                f"rudder inflow '{self.inflow}' is not known", cure=f"use one of {', '.join(_LATERAL)}"
            )
        if self.switch not in ("betaR", "betaP"):
            raise TowtankError(f"gammaR cannot switch on '{self.switch}'", cure="use 'betaR' or 'betaP'")

    def enlarged(self, k: float) -> Rudder:
        """The rudder of a ship `k` times as long."""
        return replace(self, area=self.area * k**2)


def fujii_slope(aspect_ratio: float) -> float:
    """Slope of the rudder's normal force, ``6.13 A / (A + 2.25)`` (Fujii and Tsuda 1961)."""
    return 6.13 * aspect_ratio / (aspect_ratio + 2.25)
