"""A ship parallel to a bank: equilibrium, check helm, and course stability with an autopilot.

The analysis of the pure car carrier paper (5th MASHCON 2019, equations 8 to 27). The bank is to starboard, eta is
the deviation of midship towards it over L, phi and speed are held, forces are over ``0.5 rho L T U^2``. The
autopilot orders ``delta = -G1 psi - G2 r'`` about the check helm.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError
from ..core.scales import mass_coefficient
from .autopilot import Autopilot
from .routh_hurwitz import is_hurwitz

Form = Literal["corrected", "printed"]

_NO_AUTOPILOT = Autopilot(0.0)


@dataclass(frozen=True)
class ShipNearBank:
    """Linear and bank coefficients of a ship at one water depth, in prime form at midship.

    Attributes
    ----------
    m, mx, my : float
        Mass and added masses over ``0.5 rho L^2 T``.
    xG : float
        Centre of gravity forward of midship over L.
    yaw_inertia : float
        Izz about the centre of gravity with the added Jzz, over ``0.5 rho L^4 T``.
    Yv, Yr, Nv, Nr : float
        Yr with the added mass inside, ``Yr - mx``, as circular motion tests find it.
    Yd, Nd : float
        Of the rudder, positive to starboard.
    Yeta, Yetaetaeta, Yvetaeta, Neta, Netaetaeta, Nvetaeta : float
    """

    m: float
    mx: float
    my: float
    xG: float
    yaw_inertia: float
    Yv: float
    Yr: float
    Nv: float
    Nr: float
    Yd: float
    Nd: float
    Yeta: float
    Yetaetaeta: float
    Yvetaeta: float
    Neta: float
    Netaetaeta: float
    Nvetaeta: float

    @classmethod
    def from_sets(
        cls, drift: DerivativeSet, bank: DerivativeSet, *, Yd: float, Nd: float, yaw_inertia: float
    ) -> ShipNearBank:
        """From a set of the open water at the same depth and one with the bank terms.

        Parameters
        ----------
        drift : DerivativeSet
            With Yv, Yr, Nv, Nr and the added masses Xudot, Yvdot; in any conventions.
        bank : DerivativeSet
            With the bank terms, over ``0.5 rho L T U^2``.
        Yd, Nd : float
            Rudder derivatives over ``0.5 rho L T U^2``.
        yaw_inertia : float
            Iz' + Jz'.

        Raises
        ------
        ConventionError
            When a coefficient or the ship's mass is missing.
        """
        linear = drift.subset(
            [name for name in ("Xudot", "Yvdot", "Yv", "Yr", "Nv", "Nr") if name in drift.names]
        ).to("mmg,added-mass-inside")
        near = bank.to("mmg,added-mass-inside")
        wanted = ("Yeta", "Yetaetaeta", "Yvetaeta", "Neta", "Netaetaeta", "Nvetaeta")
        for one, names in ((linear, ("Xudot", "Yvdot", "Yv", "Yr", "Nv", "Nr")), (near, wanted)):
            missing = [name for name in names if name not in one.names]
            if missing:
                raise ConventionError(f"'{one.name}' has no {missing[0]}", cure="a ship near a bank needs it")
        return cls(
            m=mass_coefficient(drift.ship),
            mx=-linear["Xudot"],
            my=-linear["Yvdot"],
            xG=drift.ship.xG / drift.ship.L,
            yaw_inertia=yaw_inertia,
            Yd=Yd,
            Nd=Nd,
            **{name: linear[name] for name in ("Yv", "Yr", "Nv", "Nr")},
            **{name: near[name] for name in wanted},
        )

    def sway_slopes(self, eta: float) -> tuple[float, float]:
        """Yv* and Nv* at a deviation `eta` (equation 14)."""
        return self.Yv + self.Yvetaeta * eta**2, self.Nv + self.Nvetaeta * eta**2

    def bank_slopes(self, eta: float, cubic: float = 3.0) -> tuple[float, float]:
        """Yeta* and Neta* at a deviation `eta`: with 3 the slope of the bank force, with 1 its ratio to eta."""
        return self.Yeta + cubic * self.Yetaetaeta * eta**2, self.Neta + cubic * self.Netaetaeta * eta**2


@dataclass(frozen=True)
class BankEquilibrium:
    """Steady state parallel to the bank.

    Attributes
    ----------
    eta : float
        Deviation towards the bank over L.
    sway, heading, helm : float
        v' = v/U; heading to starboard of the bank's direction and check helm, rad.
    """

    eta: float
    sway: float
    heading: float
    helm: float


def bank_equilibrium(ship: ShipNearBank, eta: float, *, form: Form = "corrected") -> BankEquilibrium:
    """Drift and check helm that hold a ship parallel to the bank (equations 12 to 16).

    Parameters
    ----------
    ship : ShipNearBank
    eta : float
        Deviation towards the bank over L.
    form : {"corrected", "printed"}
        Equation 14 is printed with three times the cubic bank term, which is the slope that belongs to the
        stability; the balance of forces has it once.
    """
    yv, nv = ship.sway_slopes(eta)
    ye, ne = ship.bank_slopes(eta, 3.0 if form == "printed" else 1.0)
    scale = eta / (yv * ship.Nd - nv * ship.Yd)
    helm = scale * (ye * nv - ne * yv)
    sway = -scale * (ye * ship.Nd - ne * ship.Yd)
    return BankEquilibrium(eta, sway, -sway, helm)


def characteristic_coefficients(
    ship: ShipNearBank, eta: float, autopilot: Autopilot = _NO_AUTOPILOT, *, form: Form = "corrected"
) -> np.ndarray:
    """D4 to D0 of the disturbed motion along the bank (equations 20 to 25).

    Parameters
    ----------
    ship : ShipNearBank
    eta : float
        Deviation of the equilibrium over L.
    autopilot : Autopilot
        Its proportional and derivative gains are G1 and G2.
    form : {"corrected", "printed"}
        D2 is printed with ``Yr - m - my``; equations 17 and 18 give ``Yr - mx - m``.

    Returns
    -------
    ndarray, shape (5,)
        Coefficients of the polynomial in U/L, from the fourth power down to the constant.

    Raises
    ------
    ConventionError
        For an autopilot with an integral term, which adds a power.
    """
    if autopilot.integral:
        raise ConventionError("the bank analysis has no integral gain", cure="use a PD autopilot")
    g1, g2 = autopilot.proportional, autopilot.derivative
    yv, nv = ship.sway_slopes(eta)
    ye, ne = ship.bank_slopes(eta)
    moment = ship.m * ship.xG
    sway_mass = ship.m + ship.my
    turn_mass = ship.yaw_inertia + moment * ship.xG
    # equation 17: with v' = eta' - psi the Coriolis force (m + mx) r and the inertia (m + my) v' leave this
    by_yaw = ship.Yr + ship.my - ship.Yd * g2
    turning = ship.Nr - moment - ship.Nd * g2
    coupled = (
        ship.Yr - ship.m - ship.Yd * g2
        if form == "corrected"
        else (ship.Yr + ship.mx) - ship.m - ship.my - ship.Yd * g2
    )
    return np.array(
        [
            sway_mass * turn_mass - moment**2,
            -sway_mass * turning - turn_mass * yv + moment * (nv + by_yaw),
            yv * turning
            - coupled * nv
            - ye * turn_mass
            + ship.Nd * g1 * sway_mass
            + moment * (ne - yv - ship.Yd * g1),
            ye * turning - by_yaw * ne - g1 * (yv * ship.Nd - nv * ship.Yd),
            (yv + ship.Yd * g1) * ne - ye * (nv + ship.Nd * g1),
        ]
    )


@dataclass(frozen=True, eq=False)
class BankStability:
    """Course stability along a bank.

    Attributes
    ----------
    coefficients : ndarray, shape (5,)
        D4 to D0.
    D5 : float
        ``D3 D2 D1 - D3^2 D0 - D4 D1^2`` (equation 27).
    roots : ndarray, shape (4,), complex
        In U/L, the largest real part first.
    stable : bool
        By Routh and Hurwitz: D0 to D5 are positive.
    """

    coefficients: np.ndarray
    D5: float
    roots: np.ndarray
    stable: bool


def bank_stability(
    ship: ShipNearBank, eta: float, autopilot: Autopilot = _NO_AUTOPILOT, *, form: Form = "corrected"
) -> BankStability:
    """Course stability along a bank (equations 20 to 27); parameters as :func:`characteristic_coefficients`."""
    coefficients = characteristic_coefficients(ship, eta, autopilot, form=form)
    d4, d3, d2, d1, d0 = map(float, coefficients)
    roots = np.roots(coefficients).astype(complex)
    return BankStability(
        coefficients=coefficients,
        D5=d3 * d2 * d1 - d3**2 * d0 - d4 * d1**2,
        roots=roots[np.argsort(-roots.real, kind="stable")],
        stable=is_hurwitz(coefficients),
    )


def helm_limit(ship: ShipNearBank, limit: float, *, form: Form = "corrected", farthest: float = 0.5) -> float:
    """Smallest deviation towards the bank at which the check helm reaches `limit`.

    Parameters
    ----------
    ship : ShipNearBank
    limit : float
        In rad.
    form : {"corrected", "printed"}
        See :func:`bank_equilibrium`.
    farthest : float
        Where the search ends, over L.

    Returns
    -------
    float
        Over L; NaN when the helm stays smaller.
    """
    from scipy.optimize import brentq

    def excess(eta: float) -> float:
        return abs(bank_equilibrium(ship, eta, form=form).helm) - limit

    places = np.linspace(0.0, farthest, 201)
    beyond = np.flatnonzero([excess(float(eta)) >= 0.0 for eta in places])
    if not len(beyond):
        return math.nan
    first = int(beyond[0])
    return 0.0 if first == 0 else float(brentq(excess, places[first - 1], places[first], xtol=1e-12))
