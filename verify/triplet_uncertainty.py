"""Uncertainty of the fine of three grids by each published method, none of them beyond what it is defined for.

Every uncertainty is the half-width of an interval of about 95 %, in the unit of the value, about the value of the
fine grid (about the corrected value where a method says so). No method silently treats an oscillating or diverging
triplet as a monotone one: the result is NaN, or the note says what was done.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from .grid_triplet import GridTriplet

GCI_SAFETY, TWO_GRID_SAFETY = 1.25, 3.0
"""Safety factors of Roache (1998) with an observed order, and with an assumed one."""

OSCILLATION_SHARE, DIVERGENCE_FACTOR = 0.5, 3.0
"""Share of the data range for oscillatory convergence (ITTC 7.5-03-01-01), and its multiple for divergence."""

NO_ESTIMATE = {
    "monotone divergent": "diverges: no order, no extrapolation",
    "oscillatory divergent": "diverges in oscillation: no order, no extrapolation",
    "equal solutions": "two grids give the same number: the order cannot be found",
}


@dataclass(frozen=True)
class UncertaintyEstimate:
    """What one method says of one quantity.

    Attributes
    ----------
    quantity, method : str
    behaviour : str
        Class of convergence, see :data:`towtank.verify.grid_triplet.Behaviour`, or ``too few grids``.
    order : float
        Order that the method used; NaN for none.
    extrapolated : float
        Value at vanishing spacing that the method implies; NaN for none.
    uncertainty : float
        Expanded uncertainty (about 95 %) in the unit of the quantity; NaN when the method has none.
    unit, note : str
    """

    method: str
    behaviour: str
    order: float
    extrapolated: float
    uncertainty: float
    note: str = ""
    quantity: str = ""
    unit: str = ""

    def of(self, quantity: str, unit: str) -> UncertaintyEstimate:
        """The same estimate with the name and unit of its quantity."""
        return replace(self, quantity=quantity, unit=unit)

    def noting(self, words: str) -> UncertaintyEstimate:
        """The same estimate with words before its note."""
        return replace(self, note=_joined(words, self.note))

    @property
    def standard_uncertainty(self) -> float:
        """Half the expanded uncertainty: coverage factor 2, as for a normal distribution."""
        return 0.5 * self.uncertainty


def _none(method: str, triplet: GridTriplet, note: str) -> UncertaintyEstimate:
    order = triplet.order if triplet.behaviour.endswith("divergent") else math.nan
    return UncertaintyEstimate(method, triplet.behaviour, order, math.nan, math.nan, note)


def gci_celik(triplet: GridTriplet, safety: float = GCI_SAFETY) -> UncertaintyEstimate:
    """Grid convergence index of Celik et al. (2008), J. Fluids Eng. 130:078001, as an absolute value.

    ``safety |eps21| / (r21^p - 1)`` with the order of unequal ratios and the sign term for oscillation.
    """
    name = "GCI Celik"
    if not triplet.behaviour.endswith(" convergent"):
        return _none(name, triplet, NO_ESTIMATE[triplet.behaviour])
    note = ""
    if triplet.behaviour == "oscillatory convergent":
        note = "oscillatory: order with Celik's sign term, then the monotone formula; take it with care"
    return _index(name, triplet, safety, note)


def gci_roache(triplet: GridTriplet, safety: float = GCI_SAFETY) -> UncertaintyEstimate:
    """Grid convergence index of Roache (1998) with the observed order; for monotone convergence alone."""
    name = "GCI Roache"
    if triplet.behaviour != "monotone convergent":
        return _none(
            name, triplet, NO_ESTIMATE.get(triplet.behaviour, "oscillatory: defined for monotone convergence")
        )
    return _index(name, triplet, safety)


def _index(name: str, triplet: GridTriplet, safety: float, note: str = "") -> UncertaintyEstimate:
    """A safety factor times the Richardson estimate, with what is to be doubted."""
    size = safety * abs(triplet.error)
    said = _joined(note, _order_doubt(triplet.order))
    return UncertaintyEstimate(name, triplet.behaviour, triplet.order, triplet.extrapolated, size, said)


def gci_oberkampf_roy(triplet: GridTriplet, formal_order: float = 2.0) -> UncertaintyEstimate:
    """Grid convergence index of Oberkampf and Roy (2010), section 8.7.3: the order limited, the factor 1.25 or 3.

    Within 10 % of the formal order that order and 1.25 are used; else the observed order, kept between 0.5 and
    the formal one, and 3.
    """
    name = "GCI Oberkampf-Roy"
    if triplet.behaviour != "monotone convergent":
        return _none(
            name, triplet, NO_ESTIMATE.get(triplet.behaviour, "oscillatory: defined for monotone convergence")
        )
    near = abs(triplet.order / formal_order - 1.0) <= 0.1
    order = formal_order if near else min(max(0.5, triplet.order), formal_order)
    safety = GCI_SAFETY if near else TWO_GRID_SAFETY
    error = triplet.eps21 / (triplet.r21**order - 1.0)
    note = f"observed order {triplet.order:.3g}, used {order:.3g}, safety factor {safety:g}"
    return UncertaintyEstimate(name, triplet.behaviour, order, triplet.fine - error, safety * abs(error), note)


def correction_factor_uncertainty(
    error: float, correction: float, *, corrected: bool = False, version: Literal[2001, 2004] = 2004
) -> float:
    """Uncertainty of Stern's correction-factor method.

    Parameters
    ----------
    error : float
        Richardson estimate delta_RE.
    correction : float
        Correction factor C, see :meth:`GridTriplet.correction_factor`.
    corrected : bool
        Uncertainty of the value that is corrected by C delta_RE, instead of that of the value itself.
    version : {2001, 2004}
        Stern et al. (2001), J. Fluids Eng. 123:793, equations 33 and 34, or Wilson, Shao and Stern (2004),
        J. Fluids Eng. 126:704, as in ITTC 7.5-03-01-01.
    """
    far = abs(1.0 - correction)
    size = abs(error)
    if corrected:
        if version == 2001 or far >= 0.25:
            return far * size
        return (2.4 * far**2 + 0.1) * size
    if version == 2001:
        return (abs(correction) + far) * size
    return (9.6 * far**2 + 1.1) * size if far < 0.125 else (2.0 * far + 1.0) * size


def correction_factor(
    triplet: GridTriplet,
    formal_order: float = 2.0,
    *,
    corrected: bool = False,
    version: Literal[2001, 2004] = 2004,
) -> UncertaintyEstimate:
    """Stern's correction-factor method, uncorrected or corrected.

    Oscillatory convergence takes half the data range, as the method says; the corrected form has no value there.
    The extrapolated value of the corrected form is ``S1 - C delta_RE``.
    """
    name = "correction factor" + (" 2001" if version == 2001 else "") + (" corrected" if corrected else "")
    if triplet.behaviour == "oscillatory convergent" and not corrected:
        return _half_range(name, triplet)
    if triplet.behaviour != "monotone convergent":
        return _none(name, triplet, NO_ESTIMATE.get(triplet.behaviour, "oscillatory: no error to correct by"))
    c, error = triplet.correction_factor(formal_order), triplet.error
    size = correction_factor_uncertainty(error, c, corrected=corrected, version=version)
    value = triplet.fine - c * error if corrected else triplet.extrapolated
    note = _joined(f"C = {c:.4g}", "far from the asymptotic range" if abs(1.0 - c) > 1.0 else "")
    return UncertaintyEstimate(name, triplet.behaviour, triplet.order, value, size, note)


def safety_of_order_ratio(order_ratio: float) -> float:
    """Factor of safety of Xing and Stern (2010) at P = p / p_est: 2.45 - 0.85 P up to 1, 16.4 P - 14.8 beyond.

    That is ``FS1 P + FS0 (1 - P)`` and ``FS1 P + FS2 (P - 1)`` with FS0 = 2.45, FS1 = 1.6, FS2 = 14.8.
    """
    return 2.45 - 0.85 * order_ratio if order_ratio <= 1.0 else 16.4 * order_ratio - 14.8


def factor_of_safety(triplet: GridTriplet, formal_order: float = 2.0) -> UncertaintyEstimate:
    """Factor-of-safety method of Xing and Stern (2010), J. Fluids Eng. 132:061403; oscillation takes half the range."""
    name = "factor of safety"
    if triplet.behaviour == "oscillatory convergent":
        return _half_range(name, triplet)
    if triplet.behaviour != "monotone convergent":
        return _none(name, triplet, NO_ESTIMATE[triplet.behaviour])
    order_ratio = triplet.order / formal_order
    safety = safety_of_order_ratio(order_ratio)
    return UncertaintyEstimate(
        name,
        triplet.behaviour,
        triplet.order,
        triplet.extrapolated,
        safety * abs(triplet.error),
        _joined(f"P = {order_ratio:.4g}, factor {safety:.4g}", _order_doubt(min(triplet.order, 1.0))),
    )


def _half_range(name: str, triplet: GridTriplet) -> UncertaintyEstimate:
    size = OSCILLATION_SHARE * triplet.extent
    return UncertaintyEstimate(
        name, triplet.behaviour, math.nan, math.nan, size, "oscillatory: half the range of the data, no order"
    )


def data_range(values: Sequence[float], behaviour: str) -> UncertaintyEstimate:
    """Uncertainty from the range of the data alone.

    Half of it for oscillatory convergence (ITTC 7.5-03-01-01, the mean of the limits as the value at
    vanishing spacing) and for equal solutions; three times it for divergence (Eca and Hoekstra 2009); none for monotone
    convergence, where the methods with an order apply.

    Parameters
    ----------
    values : sequence of float
    behaviour : str
        Their class of convergence.
    """
    name = "data range"
    high, low = max(values), min(values)
    extent = high - low
    if behaviour == "oscillatory convergent":
        note = "half the range of the data"
        return UncertaintyEstimate(name, behaviour, math.nan, 0.5 * (high + low), OSCILLATION_SHARE * extent, note)
    if behaviour == "equal solutions":
        note = "half the range of the data; equal numbers show no discretisation error, not that there is none"
        return UncertaintyEstimate(name, behaviour, math.nan, math.nan, OSCILLATION_SHARE * extent, note)
    if behaviour.endswith("divergent"):
        note = "divergent: three times the range of the data, a bound of need and not of theory"
        return UncertaintyEstimate(name, behaviour, math.nan, math.nan, DIVERGENCE_FACTOR * extent, note)
    note = (
        "monotone: the methods with an order apply" if behaviour == "monotone convergent" else "needs three grids"
    )
    return UncertaintyEstimate(name, behaviour, math.nan, math.nan, math.nan, note)


def gci_two_grids(fine: float, coarse: float, ratio: float, formal_order: float = 2.0) -> UncertaintyEstimate:
    """Grid convergence index of Roache (1998) for two grids: the formal order is assumed, the safety factor is 3."""
    error = (coarse - fine) / (ratio**formal_order - 1.0)
    note = f"two grids: the order {formal_order:g} is assumed, safety factor {TWO_GRID_SAFETY:g}"
    return UncertaintyEstimate(
        "GCI Roache", "too few grids", formal_order, fine - error, TWO_GRID_SAFETY * abs(error), note
    )


def _order_doubt(order: float) -> str:
    if order < 0.5:
        return "order below 0.5: the extrapolation is far away and not to be trusted"
    if order > 3.0:
        return "order above 3: the uncertainty is too small to be trusted"
    return ""


def _joined(*notes: str) -> str:
    return "; ".join(note for note in notes if note)
