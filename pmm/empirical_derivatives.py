"""Hull derivatives from main dimensions: starting values, priors, and the yardstick of the audit.

They are worth about 30 %, not better: for KVLCC2 the sway derivative Yv' is -0.410 against -0.315 measured. All
hold for conventional displacement hulls on even keel in deep water.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from ..core.conventions import HOME
from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError, TowtankError
from ..core.provenance import Provenance
from ..core.ship import Ship

_MAX_SWAY_FACTOR = 8.0


def clarke(ship: Ship) -> DerivativeSet:
    """Linear derivatives of Clarke, Gedling and Hine 1983, about midship.

    Scaled by ``0.5 rho L^2 U^2`` (prime I). The added-mass Coriolis term is inside Yr, as in the tests that were
    regressed; ``Xudot`` (Zhou et al. 1983) is added so that the set converts to the other form.

    Validity: rotating-arm and PMM tests of merchant ships. Source: The application of manoeuvring criteria in
    hull design using linear theory, Trans. RINA 125.

    Raises
    ------
    ConventionError
        When the ship's volume or mass is not known.
    """
    b, k = _form(ship), math.pi * (ship.T / ship.L) ** 2
    bl, bt, tl, cb = 1.0 / b.lb, b.bt, ship.T / ship.L, b.cb
    values = {
        "Yv": -k * (1.0 + 0.40 * cb * bt),
        "Yr": -k * (-0.5 + 2.2 * bl - 0.080 * bt),
        "Nv": -k * (0.5 + 2.4 * tl),
        "Nr": -k * (0.25 + 0.039 * bt - 0.56 * bl),
        "Yvdot": -k * (1.0 + 0.16 * cb * bt - 5.1 * bl**2),
        "Yrdot": -k * (0.67 * bl - 0.0033 * bt**2),
        "Nvdot": -k * (1.1 * bl - 0.041 * bt),
        "Nrdot": -k * (1.0 / 12.0 + 0.017 * cb * bt - 0.33 * bl),
        "Xudot": -zhou_added_mass(ship).surge * tl,
    }
    conventions = HOME.but(force_scaling="L2", added_mass_coriolis="inside")
    return DerivativeSet.from_values(
        f"{ship.name}, Clarke 1983",
        ship,
        values,
        conventions,
        provenance=Provenance(source="Clarke, Gedling and Hine 1983; Xudot of Zhou et al. 1983"),
    )


def kijima(ship: Ship) -> DerivativeSet:
    """Derivatives of Kijima et al. 1990 in the drift angle; the linear ones are those of Inoue et al. 1981.

    Scaled by ``0.5 rho L T U^2``, second-order modulus form. The formula gives ``Yr' - (m' + mx') = -1.5 Cb B/L``;
    Yr' itself is returned, so that rigid-body and added-mass inertia are outside as in MMG. Added masses are those
    of Zhou et al. 1983.

    Validity: model tests of cargo ships, tankers, container and car carriers at even keel. Source: On the
    manoeuvring performance of a ship with the parameter of loading condition, J. Soc. Nav. Arch. Japan 168.

    Raises
    ------
    ConventionError
        When the ship's volume or mass is not known.
    """
    f = _form(ship)
    k, x, tb, cb = f.aspect, f.cb / f.lb, 1.0 / f.bt, f.cb
    added = zhou_added_mass(ship)
    values = {
        "Yb": 0.5 * math.pi * k + 1.4 * x,
        "Yr": f.mass + added.surge - 1.5 * x,
        "Yb|b|": 2.5 * tb * (1.0 - cb) + 0.5,
        "Yr|r|": 0.343 * cb * tb - 0.07,
        "Ybbr": 1.5 * cb * tb - 0.65,
        "Ybrr": 5.95 * tb * (1.0 - cb),
        "Nb": k,
        "Nr": -0.54 * k + k**2,
        "Nb|b|": -0.96 * tb * (1.0 - cb) + 0.066,
        "Nr|r|": 0.5 * x - 0.09,
        "Nbbr": -(57.5 * x**2 - 18.4 * x + 1.6),
        "Nbrr": -(0.5 * cb * tb - 0.05),
        **added.terms(),
    }
    return DerivativeSet.from_values(
        f"{ship.name}, Kijima 1990",
        ship,
        values,
        HOME.but(sway_variable="beta"),
        provenance=Provenance(source="Kijima et al. 1990 (linear terms Inoue et al. 1981); Zhou et al. 1983"),
    )


def yoshimura_masumoto(ship: Ship) -> DerivativeSet:
    """Derivatives of Yoshimura and Masumoto 2012, cubic MMG form.

    Scaled by ``0.5 rho L T U^2``, inertia outside. Added masses are those of Zhou et al. 1983. The formulas were
    made in the drift angle; terms odd in it change sign here. Copies in circulation keep the sign of ``Xvr`` and
    print ``-0.185 L/B + 0.48`` for Yvvv; the signs here are those that KVLCC2, KCS and S-175 confirm (Yvvv -1.50,
    -1.80, -1.75 against -1.61, -1.72, -2.01 measured). Copies disagree about the sign of Nvrr, which is left out.

    Validity: medium-speed and fast merchant ships and fishing vessels. Source: Hydrodynamic database and
    manoeuvring prediction method with medium high-speed merchant ships and fishing vessels, MARSIM 2012.

    Raises
    ------
    ConventionError
        When the ship's volume or mass is not known.
    """
    f = _form(ship)
    k, x, cb = f.aspect, f.cb / f.lb, f.cb
    added = zhou_added_mass(ship)
    values = {
        "Xvv": 1.15 * x - 0.18,
        "Xvr": -(added.sway - 1.91 * x + 0.08),
        "Xrr": -0.085 * x + 0.008 - ship.xG / ship.L * added.sway,
        "Xvvvv": -6.68 * x + 1.1,
        "Yv": -(0.5 * math.pi * k + 1.4 * x),
        "Yr": added.surge + 0.5 * x,
        "Yvvv": -(0.185 * f.lb + 0.48),
        "Yvvr": -0.75,
        "Yvrr": -(0.26 * (1.0 - cb) * f.lb + 0.11),
        "Yrrr": -0.051,
        "Nv": -k,
        "Nr": -0.54 * k + k**2,
        "Nvvv": 0.69 * cb - 0.66,
        "Nvvr": 1.55 * x - 0.76,
        "Nrrr": 0.25 * x - 0.056,
        **added.terms(),
    }
    return DerivativeSet.from_values(
        f"{ship.name}, Yoshimura and Masumoto 2012",
        ship,
        values,
        HOME,
        provenance=Provenance(
            source="Yoshimura and Masumoto 2012; Zhou et al. 1983",
            misprints=("Xvr and Yvvv: signs as measured hulls confirm them", "Nvrr: left out, sign disputed"),
        ),
    )


EMPIRICAL_SETS: dict[str, Callable[[Ship], DerivativeSet]] = {
    "clarke": clarke,
    "kijima": kijima,
    "yoshimura-masumoto": yoshimura_masumoto,
}
"""The sets by the name that a campaign file uses (``fit.prior``)."""


def empirical_set(ship: Ship, name: str) -> DerivativeSet:
    """Empirical derivatives by name.

    Raises
    ------
    TowtankError
        For an unknown name.
    ConventionError
        When the ship's volume or mass is not known.
    """
    try:
        make = EMPIRICAL_SETS[name]
    except KeyError:
        raise TowtankError(
            f"'{name}' is not an empirical set of derivatives", cure=f"use one of {', '.join(EMPIRICAL_SETS)}"
        ) from None
    return make(ship)


@dataclass(frozen=True)
class AddedMass:
    """Added masses over ``0.5 rho L^2 T``, added yaw inertia over ``0.5 rho L^4 T``.

    Attributes
    ----------
    surge, sway, yaw : float
        mx', my', Jz', all positive.
    """

    surge: float
    sway: float
    yaw: float

    def terms(self) -> dict[str, float]:
        """The same as derivatives: Xudot, Yvdot, Nrdot."""
        return {"Xudot": -self.surge, "Yvdot": -self.sway, "Nrdot": -self.yaw}


def zhou_added_mass(ship: Ship) -> AddedMass:
    """Added masses from Zhou, Sheng and Feng 1983 (regression of Motora's charts), deep water, about midship.

    KVLCC2: 0.023, 0.224, 0.0112 against 0.022, 0.223, 0.011 of Yasukawa and Yoshimura 2015.

    Raises
    ------
    ConventionError
        When the ship's volume or mass is not known.
    """
    f = _form(ship)
    cb, lb, tb = f.cb, f.lb, 1.0 / f.bt
    surge = 0.01 * (
        0.398
        + 11.97 * cb * (1.0 + 3.73 * tb)
        - 2.89 * cb * lb * (1.0 + 1.13 * tb)
        + 0.175 * cb * lb**2 * (1.0 + 0.541 * tb)
        - 1.107 * lb * tb
    )
    sway = (
        0.882
        - 0.54 * cb * (1.0 - 1.6 * tb)
        - 0.156 * lb * (1.0 - 0.673 * cb)
        + 0.826 * tb * lb * (1.0 - 0.678 * tb)
        - 0.638 * cb * tb * lb * (1.0 - 0.669 * tb)
    )
    arm = 0.01 * (33.0 - 76.85 * cb * (1.0 - 0.784 * cb) + 3.43 * lb * (1.0 - 0.63 * cb))
    return AddedMass(surge * f.mass, sway * f.mass, arm**2 * f.mass)


def shallow_added_mass_factors(ship: Ship) -> AddedMass:
    """Factors on the added masses in shallow water, Li and Wu 1990, with F = h/T - 1; 1 in deep water.

    S-175 at h/T = 1.2: 5.57, 3.21, 2.89.
    """
    f = ship.depth_ratio - 1.0
    if not math.isfinite(f):
        return AddedMass(1.0, 1.0, 1.0)
    form = _form(ship)
    bt, lt = form.bt, ship.L / ship.T
    surge = f**1.3 + 3.77 + 1.14 * bt - 0.233 * lt - 3.43 * form.cb
    sway = f**0.82 + 0.413 + 0.032 * bt + 0.0129 * bt**2
    yaw = f**0.82 + 0.413 + 0.0192 * bt + 0.00554 * bt**2
    return AddedMass(surge / f**1.3, sway / f**0.82, yaw / f**0.82)


def shallow_sway_factor(ship: Ship) -> float:
    """Factor on Yv in shallow water, Kijima and Nakiri 1990: ``(1 - T/h)**-n - T/h``, n = 0.40 Cb B/T.

    Between 1 and 8: the formula dips below 1 in moderate depth and diverges at the keel. KVLCC2: 4.2 at h/T = 1.2,
    2.0 at 1.5.
    """
    form = _form(ship)
    ratio = 1.0 / ship.depth_ratio
    factor = (1.0 - ratio) ** (-0.40 * form.cb * form.bt) - ratio
    return min(max(factor, 1.0), _MAX_SWAY_FACTOR)


@dataclass(frozen=True)
class _Form:
    cb: float
    lb: float
    bt: float
    aspect: float
    mass: float


def _form(ship: Ship) -> _Form:
    """Form parameters that the formulas share: Cb, L/B, B/T, 2T/L, m' = 2 Cb B/L."""
    cb = ship.block_coefficient
    if cb is None and ship.mass is not None:
        cb = ship.mass / (ship.rho * ship.L * ship.B * ship.T)
    if cb is None:
        raise ConventionError(
            f"the block coefficient of '{ship.name}' is not known", cure="give the ship's volume or mass"
        )
    return _Form(cb, ship.L / ship.B, ship.B / ship.T, 2.0 * ship.T / ship.L, 2.0 * cb * ship.B / ship.L)
