"""Exact conversion of hull derivatives between conventions.

Every conversion is an affine map of the derivatives, ``b = M a + c``, so that covariances convert with ``M``.
Scalings and signs are diagonal. A change of the sway variable (``v' = -sin beta``), of the reference point
(``v_P = v + x_P r``) or of the speed that scales the forces (U against U0 on the path u = U0) is a formal power
series: substituted into each term and cut at the highest degree of the set, it is a triangular map whose
inverse is the series of the inverse substitution. Round trips are therefore exact to rounding, and the force is
the same up to terms of higher degree than the model has.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from .conventions import Conventions
from .errors import ConventionError
from .motion import origin_position
from .scales import force_unit, mass_coefficient, variable_unit, yaw_inertia_coefficient
from .ship import Ship
from .terms import Factor, Term
from .variables import VARIABLES

Powers = tuple[Factor, ...]
Series = dict[Powers, float]
Key = tuple[str, Powers]

_EXPANDED = ("v", "beta", "r")
"""Variables whose powers count towards the degree at which series are cut."""


def _degree(powers: Powers) -> int:
    return sum(factor.degree for factor in powers if factor.variable in _EXPANDED)


def _sorted(powers: Iterable[Factor]) -> Powers:
    return Term("", "X", tuple(powers)).factors


def _multiply(a: Series, b: Series, degree: int) -> Series:
    product: Series = {}
    for left, x in a.items():
        for right, y in b.items():
            merged: dict[str, list[int]] = {}
            for factor in (*left, *right):
                power = merged.setdefault(factor.variable, [0, 0])
                power[0] += factor.power
                power[1] += factor.modulus
            powers = _sorted(Factor(name, p, m) for name, (p, m) in merged.items())
            if _degree(powers) <= degree:
                product[powers] = product.get(powers, 0.0) + x * y
    return product


def _power(base: Series, exponent: int, degree: int) -> Series:
    result: Series = {(): 1.0}
    for _ in range(exponent):
        result = _multiply(result, base, degree)
    return result


def _binomial_series(q: Series, exponent: float, degree: int) -> Series:
    """``(1 + q)**exponent`` for a series `q` without constant term."""
    total: Series = {(): 1.0}
    power: Series = {(): 1.0}
    coefficient = 1.0
    for n in range(1, degree + 1):
        power = _multiply(power, q, degree)
        coefficient *= (exponent - n + 1) / n
        if not power or coefficient == 0.0:
            break
        for key, value in power.items():
            total[key] = total.get(key, 0.0) + coefficient * value
    return total


def _one(variable: str, coefficient: float = 1.0) -> Series:
    return {(Factor(variable, 1),): coefficient}


@dataclass(frozen=True)
class Substitution:
    """Old variables as series in new ones, and the ratio of the squared old to new scaling speed.

    ``speed_squared`` is the series q in ``(U_old / U_new)**2 = 1 + q``; ``variables`` holds each replaced
    variable as (series of the plain variable, series of its modulus or None when it has no modulus).
    """

    variables: dict[str, tuple[Series, Series | None]]
    speed_squared: Series


def _substitute(term: Term, change: Substitution, degree: int) -> Series:
    """Series of one term after the change of variables, force scaled with the new speed."""
    speeds = sum(VARIABLES[factor.variable].speed * factor.degree for factor in term.factors)
    series: Series = {(): 1.0}
    if change.speed_squared:
        series = _binomial_series(change.speed_squared, (2 - speeds) / 2, degree)
    for factor in term.factors:
        if factor.variable not in change.variables:
            series = _multiply(series, {(factor,): 1.0}, degree)
            continue
        plain, modulus = change.variables[factor.variable]
        series = _multiply(series, _power(plain, factor.power, degree), degree)
        if factor.modulus:
            if modulus is None:
                raise ConventionError(
                    f"term '{term.name}' with a modulus cannot be moved to another reference point exactly",
                    cure="refit the set about the new point, or use a cubic model",
                )
            series = _multiply(series, _power(modulus, factor.modulus, degree), degree)
    return series


def _odd_series(variable: str, coefficients: Sequence[float]) -> tuple[Series, Series]:
    """Series ``-sum c_n x**n`` over odd n, and that of its modulus."""
    plain: Series = {}
    modulus: Series = {}
    for n, coefficient in enumerate(coefficients):
        if n % 2:
            plain[(Factor(variable, n),)] = -coefficient
            modulus[_sorted([Factor(variable, n - 1, 1)] if n > 1 else [Factor(variable, 0, 1)])] = coefficient
    return plain, modulus


def _sine(degree: int) -> list[float]:
    return [(-1) ** ((n - 1) // 2) / math.factorial(n) if n % 2 else 0.0 for n in range(degree + 1)]


def _arcsine(degree: int) -> list[float]:
    return [math.comb(n - 1, (n - 1) // 2) / (2 ** (n - 1) * n) if n % 2 else 0.0 for n in range(degree + 1)]


def _arctangent(degree: int) -> list[float]:
    return [(-1) ** ((n - 1) // 2) / n if n % 2 else 0.0 for n in range(degree + 1)]


def _tangent(degree: int) -> list[float]:
    # from tan' = 1 + tan^2
    t = [0.0, 1.0]
    for n in range(1, degree):
        t.append(sum(t[i] * t[n - i] for i in range(n + 1)) / (n + 1))
    return t[: degree + 1]


# v' = v/U = -sin(beta) with the instantaneous speed; v/U0 = -tan(beta) on the path u = U0
_DRIFT_TO_SWAY = {"instantaneous": _arcsine, "approach": _arctangent}
_SWAY_TO_DRIFT = {"instantaneous": _sine, "approach": _tangent}


def _shift(distance: float, velocity_scale: str) -> Substitution:
    """Old origin to a new one `distance` (x/L) further forward: v_old = v_new - distance * r."""
    sway = _one("v") | _one("r", -distance)
    acceleration = _one("vdot") | _one("rdot", -distance)
    q: Series = {}
    if velocity_scale == "instantaneous":
        q = {_sorted([Factor("v", 1), Factor("r", 1)]): -2.0 * distance, (Factor("r", 2),): distance**2}
    return Substitution({"v": (sway, None), "vdot": (acceleration, None)}, q)


def _rescale(velocity_scale: str) -> Substitution:
    # On the path u = U0: (U0/U)^2 = 1 - (v/U)^2 and (U/U0)^2 = 1 + (v/U0)^2.
    return Substitution({}, {(Factor("v", 2),): -1.0 if velocity_scale == "instantaneous" else 1.0})


@dataclass
class LinearMap:
    """Affine map of derivatives: ``new = matrix @ old + offset`` from `source` to `target` terms."""

    source: tuple[Term, ...]
    target: tuple[Term, ...]
    matrix: np.ndarray
    offset: np.ndarray

    def then(self, other: LinearMap) -> LinearMap:
        """This map followed by another."""
        return LinearMap(
            self.source, other.target, other.matrix @ self.matrix, other.matrix @ self.offset + other.offset
        )

    def without_cancelled(self) -> LinearMap:
        """Copy without the rows in which a series and its inverse have met and left nothing."""
        kept = (np.abs(self.matrix).max(axis=1, initial=0.0) > 1e-14) | (self.offset != 0.0)
        target = tuple(term for term, keep in zip(self.target, kept, strict=True) if keep)
        return LinearMap(self.source, target, self.matrix[kept], self.offset[kept])


def _identity(terms: Sequence[Term]) -> LinearMap:
    return LinearMap(tuple(terms), tuple(terms), np.eye(len(terms)), np.zeros(len(terms)))


def _diagonal(terms: Sequence[Term], factors: Sequence[float]) -> LinearMap:
    return LinearMap(tuple(terms), tuple(terms), np.diag(np.asarray(factors, float)), np.zeros(len(terms)))


def _from_images(terms: Sequence[Term], images: Sequence[dict[Key, float]]) -> LinearMap:
    """Map from each source term's image; known terms keep their name and sign, new ones are spelled."""
    known = {(term.component, term.factors): term for term in terms}
    targets: dict[Key, Term] = {}
    for image in images:
        for key, value in image.items():
            if value != 0.0 and key not in targets:
                targets[key] = known.get(key) or Term.spell(*key)
    row = {key: i for i, key in enumerate(targets)}
    matrix = np.zeros((len(targets), len(terms)))
    for column, image in enumerate(images):
        for key, value in image.items():
            if value != 0.0:
                matrix[row[key], column] += value * targets[key].sign
    return LinearMap(tuple(terms), tuple(targets.values()), matrix, np.zeros(len(targets)))


def _cut(terms: Sequence[Term]) -> dict[str, int]:
    """Degree at which each component's series are cut: Y, N and K share one: a shift mixes them."""
    surge = [_degree(term.factors) for term in terms if term.component == "X"]
    others = [_degree(term.factors) for term in terms if term.component != "X"]
    lateral = max(others, default=0)
    return {"X": max(surge, default=0), "Y": lateral, "N": lateral, "K": lateral}


def _change(terms: Sequence[Term], change: Callable[[int], Substitution]) -> LinearMap:
    cut = _cut(terms)
    images = []
    for term in terms:
        degree = cut[term.component]
        series = _substitute(term, change(max(degree, 1)), degree)
        images.append({(term.component, powers): term.sign * value for powers, value in series.items()})
    return _from_images(terms, images)


def _shift_origin(terms: Sequence[Term], distance: float, velocity_scale: str) -> LinearMap:
    moved = _change(terms, lambda degree: _shift(distance, velocity_scale))
    # N_new = N_old - distance * Y_old, in units of the moment
    images = []
    for term in moved.target:
        image: dict[Key, float] = {(term.component, term.factors): float(term.sign)}
        if term.component == "Y":
            image["N", term.factors] = -distance
        images.append(image)
    return moved.then(_from_images(moved.target, images))


def _scale_factors(
    terms: Sequence[Term], a: Conventions, b: Conventions, ship: Ship, speed: float | None
) -> list[float]:
    if {a.force_scaling, b.force_scaling} <= {"LT", "L2"}:
        reference = 1.0
    elif speed is None:
        raise ConventionError(
            f"converting {a.force_scaling} to {b.force_scaling} needs a reference speed",
            cure="give the set its reference_speed (m/s)",
        )
    else:
        reference = speed

    def dimensional(term: Term, conventions: Conventions) -> float:
        scaling = conventions.force_scaling
        unit = force_unit(term.component, scaling, ship, reference)
        for factor in term.factors:
            unit /= variable_unit(factor.variable, scaling, ship, reference) ** factor.degree
        return unit

    return [dimensional(term, a) / dimensional(term, b) for term in terms]


def _sign_factors(terms: Sequence[Term], a: Conventions, b: Conventions) -> list[float]:
    """Signs and angle units that differ, term by term."""
    flipped: set[str] = set()
    forces: dict[str, float] = dict.fromkeys("XYNK", 1.0)
    if a.axes != b.axes:
        flipped |= {"v", "beta", "r", "vdot", "rdot"}
        forces |= {"Y": -1.0, "N": -1.0}
    if a.rudder_sign != b.rudder_sign:
        flipped.add("delta")
    if a.drift_sign != b.drift_sign:
        flipped.add("beta")
    if a.force_sign != b.force_sign:
        forces = {component: -sign for component, sign in forces.items()}
    angle = {"rad": 1.0, "deg": math.pi / 180.0}
    per_angle = angle[b.angle_unit] / angle[a.angle_unit]
    factors = []
    for term in terms:
        value = forces[term.component]
        for factor in term.factors:
            if factor.variable in flipped and factor.power % 2:
                value = -value
            if VARIABLES[factor.variable].angle:
                value *= per_angle**factor.degree
        factors.append(value)
    return factors


_RIGID_BODY = (
    # (term, m', m' xG', Izz' + m' xG'^2) that is subtracted when inertia is inside the derivatives
    ("Xudot", -1.0, 0.0, 0.0),
    ("Xvr", 1.0, 0.0, 0.0),
    ("Xrr", 0.0, 1.0, 0.0),
    ("Yvdot", -1.0, 0.0, 0.0),
    ("Yrdot", 0.0, -1.0, 0.0),
    ("Yr", -1.0, 0.0, 0.0),
    ("Yru", -1.0, 0.0, 0.0),
    ("Nvdot", 0.0, -1.0, 0.0),
    ("Nrdot", 0.0, 0.0, -1.0),
    ("Nr", 0.0, -1.0, 0.0),
    ("Nru", 0.0, -1.0, 0.0),
)

_MUNK = (
    ("Xrr", "Yrdot", -1.0),
    ("Nv", "Yvdot", 1.0),
    ("Nvu", "Yvdot", 1.0),
    ("Nv", "Xudot", -1.0),
    ("Nvu", "Xudot", -1.0),
    ("Nr", "Yrdot", 1.0),
    ("Nru", "Yrdot", 1.0),
)

_CORIOLIS: dict[str, tuple[tuple[str, str, float], ...]] = {
    # (derivative, acceleration derivative, factor): what each form holds inside
    "outside-with-munk": (),
    "outside": _MUNK,
    "inside": (*_MUNK, ("Yr", "Xudot", 1.0), ("Yru", "Xudot", 1.0), ("Xvr", "Yvdot", -1.0)),
}


def _rows(terms: Sequence[Term]) -> dict[Key, int]:
    return {(term.component, term.factors): row for row, term in enumerate(terms)}


def _row(rows: dict[Key, int], name: str) -> int | None:
    term = Term.parse(name)
    return rows.get((term.component, term.factors))


def _rigid_body(terms: Sequence[Term], ship: Ship, sign: float) -> LinearMap:
    result = _identity(terms)
    rows = _rows(terms)
    for name, mass, moment, inertia in _RIGID_BODY:
        row = _row(rows, name)
        if row is None:
            continue
        m = mass_coefficient(ship)
        value = mass * m + moment * m * ship.xG / ship.L
        if inertia:
            value += inertia * yaw_inertia_coefficient(ship)
        result.offset[row] += sign * value
    return result


def _coriolis(terms: Sequence[Term], a: str, b: str) -> LinearMap:
    result = _identity(terms)
    rows = _rows(terms)
    change: dict[tuple[str, str], float] = {}
    for form, sign in ((b, 1.0), (a, -1.0)):
        for name, source, factor in _CORIOLIS[form]:
            change[name, source] = change.get((name, source), 0.0) + sign * factor
    for (name, source), factor in change.items():
        row = _row(rows, name)
        if row is None or factor == 0.0:
            continue
        column = _row(rows, source)
        if column is None:
            if source == "Yrdot":
                continue  # sway-yaw coupling is neglected by sets that do not name it
            raise ConventionError(
                f"moving the added-mass Coriolis terms in {name} needs {source}, which the set does not have",
                cure=f"add {source} to the set (mx' = -Xudot, my' = -Yvdot)",
            )
        result.matrix[row, column] += factor
    return result


def _change_speed(terms: Sequence[Term], velocity_scale: str) -> LinearMap:
    for term in terms:
        if {"u", "surge"} & set(term.variables):
            raise ConventionError(
                f"term '{term.name}' depends on surge velocity, so another velocity scale is not exact",
                cure="refit the model in the wanted convention",
            )
    return _change(terms, lambda degree: _rescale(velocity_scale))


def conversion_map(
    terms: Sequence[Term], a: Conventions, b: Conventions, ship: Ship, reference_speed: float | None
) -> LinearMap:
    """Affine map that takes derivatives from conventions `a` to `b`.

    Parameters
    ----------
    terms : sequence of Term
        Terms of the set, in convention `a`.
    a, b : Conventions
    ship : Ship
        Gives length, draught, mass and centre of gravity where they are needed.
    reference_speed : float or None
        Speed in m/s at which dimensional and bis derivatives hold.

    Returns
    -------
    LinearMap
        Its target may hold more terms than the source where a series needs them.

    Raises
    ------
    ConventionError
        When the conversion is not exact or lacks data.
    """
    here = a.but(force_scaling="LT", **_SIGNS_OF_HOME)
    there = b.but(force_scaling="LT", **_SIGNS_OF_HOME)
    total = _diagonal(terms, _scale_factors(terms, a, here, ship, reference_speed))
    total = total.then(_diagonal(terms, _sign_factors(terms, a, here)))
    if here != there:
        total = total.then(_series_steps(terms, here, there, ship))
    now = total.target
    total = total.then(_diagonal(now, _sign_factors(now, there, b)))
    return total.then(_diagonal(now, _scale_factors(now, there, b, ship, reference_speed)))


_SIGNS_OF_HOME = {
    key: getattr(Conventions(), key) for key in ("axes", "drift_sign", "rudder_sign", "angle_unit", "force_sign")
}


def _series_steps(terms: Sequence[Term], a: Conventions, b: Conventions, ship: Ship) -> LinearMap:
    """Map between conventions that differ in more than scales and signs."""
    total = _identity(terms)

    def go(make: Callable[[tuple[Term, ...]], LinearMap]) -> None:
        nonlocal total
        total = total.then(make(total.target))

    at_a, at_b = origin_position(a, ship), origin_position(b, ship)
    same_inertia = (a.rigid_body_inertia, a.added_mass_coriolis) == (
        b.rigid_body_inertia,
        b.added_mass_coriolis,
    )
    new_frame = at_a != at_b or not same_inertia
    stays_drift = a.sway_variable == b.sway_variable == "beta" and not (
        new_frame or a.velocity_scale != b.velocity_scale
    )
    if a.sway_variable == "beta" and not stays_drift:
        forward = _DRIFT_TO_SWAY[a.velocity_scale]
        go(lambda now: _change(now, lambda n: Substitution({"beta": _odd_series("v", forward(n))}, {})))
    if new_frame and at_a:
        go(lambda now: _shift_origin(now, -at_a, a.velocity_scale))
    scale = a.velocity_scale
    if not same_inertia:
        # The inertia forces are m u r, m v r, ...: on the path u = U0 they are single terms of a set that is
        # scaled by the approach speed, so that is where they are moved.
        if scale == "instantaneous":
            go(lambda now: _change_speed(now, "approach"))
            scale = "approach"
        # Xudot and Yvdot are added masses only while the ship's own mass is outside.
        if a.rigid_body_inertia == "inside":
            go(lambda now: _rigid_body(now, ship, -1.0))
        if a.added_mass_coriolis != b.added_mass_coriolis:
            go(lambda now: _coriolis(now, a.added_mass_coriolis, b.added_mass_coriolis))
        if b.rigid_body_inertia == "inside":
            go(lambda now: _rigid_body(now, ship, 1.0))
    if scale != b.velocity_scale:
        go(lambda now: _change_speed(now, b.velocity_scale))
    if new_frame and at_b:
        go(lambda now: _shift_origin(now, at_b, b.velocity_scale))
    if b.sway_variable == "beta" and not stays_drift:
        backward = _SWAY_TO_DRIFT[b.velocity_scale]
        go(lambda now: _change(now, lambda n: Substitution({"v": _odd_series("beta", backward(n))}, {})))
    return total.without_cancelled()
