"""Damping and restoring models of a free decay, and the terms that they are made of.

Home equation, divided by the total inertia of the motion (displaced plus added)::

    x'' + b1 x' + b2 |x'| x' + b3 x'^3 + c1 g(x) + c3 x^3 + c5 x^5 = 0

with x in rad (roll, pitch) or m (heave) and g(x) = x, or the shape of a GZ curve with slope 1 at the origin. The
literature's ``2 alpha`` is b1, ``beta`` is b2 and ``gamma`` is b3. A coefficient may depend on forward speed U:
``b1`` becomes ``b1 + b1*U U + b1*U2 U^2``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..core.errors import FitError
from .restoring_curve import RestoringCurve

#: The terms of the home equation in the order in which they are packed for the kernel.
TERMS = ("b1", "b2", "b3", "c1", "c3", "c5")
DAMPING_TERMS = TERMS[:3]
RESTORING_TERMS = TERMS[3:]
#: Motions and the SI unit of their coordinate.
MOTION_UNITS = {"roll": "rad", "pitch": "rad", "heave": "m"}

_DAMPING_WORDS = {"linear": "b1", "quadratic": "b2", "cubic": "b3"}
_RESTORING_WORDS = {"linear": ("c1",), "cubic": ("c1", "c3"), "quintic": ("c1", "c3", "c5")}
#: Powers of the coordinate X and of time in the unit of each term, so that the sum is X/s2.
_POWERS = {"b1": (0, -1), "b2": (-1, 0), "b3": (-2, 1), "c1": (0, -2), "c3": (-2, -2), "c5": (-4, -2)}


@dataclass(frozen=True)
class DampingModel:
    """Which terms a decay is fitted with.

    Attributes
    ----------
    damping : tuple of str
        Some of ``b1``, ``b2``, ``b3``.
    restoring : tuple of str
        ``c1``, and any of ``c3``, ``c5``.
    speed : tuple of str
        Dependence on forward speed U in m/s: ``b1*U``, ``b1*U2``, ``b2*U``, ``c1*U``, ...
    fixed : mapping of str to float
        Terms whose value is known, in the home units; they are not fitted.
    curve : RestoringCurve, optional
        Shape of the restoring moment (GZ over GM); c1 multiplies it.
    memory : str
        Name of the radiation memory beside these terms; empty for none.

    Raises
    ------
    FitError
        For an unknown, doubled or missing term.
    """

    damping: tuple[str, ...] = ("b1", "b2")
    restoring: tuple[str, ...] = ("c1",)
    speed: tuple[str, ...] = ()
    fixed: Mapping[str, float] = field(default_factory=dict)
    curve: RestoringCurve | None = None
    memory: str = ""

    def __post_init__(self) -> None:
        known = {"damping": DAMPING_TERMS, "restoring": RESTORING_TERMS}
        for kind, terms in known.items():
            given = getattr(self, kind)
            strangers = [name for name in given if name not in terms]
            if strangers or len(set(given)) < len(given):
                raise FitError(
                    f"{kind} terms {', '.join(given)} are not different ones of {', '.join(terms)}",
                    cure="see damping_model()",
                )
        if "c1" not in self.restoring:
            raise FitError("a decay needs the restoring term c1", cure="fix it if it is known: fixed = {c1: ...}")
        for name in self.speed:
            base, power = split_speed_term(name)
            if power == 0 or base not in (*self.damping, *self.restoring):
                raise FitError(
                    f"'{name}' is no dependence on speed of a term of this model",
                    cure="write for example b1*U or b1*U2",
                )
        strangers = [name for name in self.fixed if name not in self.names]
        if strangers:
            raise FitError(
                f"'{strangers[0]}' is fixed but no term of the model", cure=f"terms are {', '.join(self.names)}"
            )
        object.__setattr__(self, "fixed", {name: float(value) for name, value in self.fixed.items()})

    @property
    def names(self) -> tuple[str, ...]:
        """All terms: damping, restoring, then their dependence on speed."""
        return (*self.damping, *self.restoring, *self.speed)

    @property
    def free(self) -> tuple[str, ...]:
        """Terms that are fitted."""
        return tuple(name for name in self.names if name not in self.fixed)

    @property
    def label(self) -> str:
        """For tables: ``b1+b2, c1+c3``."""
        parts = ["+".join(self.damping) or "undamped", "+".join(self.restoring)]
        if self.curve is not None:
            parts[1] = parts[1].replace("c1", "c1 GZ", 1)
        if self.speed:
            parts.append("+".join(self.speed))
        if self.fixed:
            parts.append("fixed " + "+".join(self.fixed))
        if self.memory:
            parts.append(self.memory)
        return ", ".join(parts)

    def with_fixed(self, **fixed: float) -> DampingModel:
        """Copy in which these terms have known values as well."""
        return replace(self, fixed={**self.fixed, **fixed})

    def spread(self, speed: float = 0.0) -> np.ndarray:
        """Matrix S, shape (6, p): coefficients of `TERMS` at this speed are S @ values of `names`."""
        matrix = np.zeros((len(TERMS), len(self.names)))
        for column, name in enumerate(self.names):
            base, power = split_speed_term(name)
            matrix[TERMS.index(base), column] = speed**power
        return matrix

    def columns(self, angle: np.ndarray, rate: np.ndarray, speed: float | np.ndarray = 0.0) -> np.ndarray:
        """Terms of the equation for coefficients of one, shape (n, p), from x (n,) and x' (n,)."""
        shape = angle if self.curve is None else self.curve(angle)
        base = {
            "b1": rate,
            "b2": np.abs(rate) * rate,
            "b3": rate**3,
            "c1": shape,
            "c3": angle**3,
            "c5": angle**5,
        }
        split = (split_speed_term(name) for name in self.names)
        return np.column_stack([base[term] * np.asarray(speed, dtype=float) ** power for term, power in split])

    def complete(self, values: Mapping[str, float]) -> np.ndarray:
        """Values of all `names`, shape (p,): the fixed ones, and those given.

        Raises
        ------
        FitError
            If one is missing.
        """
        everything = {**values, **self.fixed}
        missing = [name for name in self.names if name not in everything]
        if missing:
            raise FitError(f"the coefficient {missing[0]} is not given", cure="give it, or fix it in the model")
        return np.array([everything[name] for name in self.names], dtype=float)


def damping_model(
    damping: str | Sequence[str] = "linear+quadratic",
    restoring: str | Sequence[str] = "linear",
    *,
    speed: Sequence[str] = (),
    fixed: Mapping[str, float] | None = None,
    curve: RestoringCurve | None = None,
) -> DampingModel:
    """Model by the words of the field.

    Parameters
    ----------
    damping : str or sequence of str
        ``linear``, ``quadratic``, ``cubic`` and their sums such as ``linear+quadratic`` (the default: three terms are
        not separable in one record), or the terms themselves: ``b1+b2``.
    restoring : str or sequence of str
        ``linear`` (c1), ``cubic`` (c1, c3), ``quintic`` (c1, c3, c5), or the terms: ``c1+c5``.
    speed : sequence of str
        Dependence on forward speed: ``b1*U``, ``b1*U2``, ...
    fixed : mapping, optional
        Known values.
    curve : RestoringCurve, optional
        Shape of the restoring moment.

    Raises
    ------
    FitError
        For a word that is not known.
    """
    words = damping.split("+") if isinstance(damping, str) else list(damping)
    terms = tuple(_DAMPING_WORDS.get(word.strip(), word.strip()) for word in words)
    if isinstance(restoring, str) and restoring in _RESTORING_WORDS:
        springs = _RESTORING_WORDS[restoring]
    else:
        given = restoring.split("+") if isinstance(restoring, str) else restoring
        springs = tuple(word.strip() for word in given)
    return DampingModel(terms, springs, tuple(speed), dict(fixed or {}), curve)


def damping_words(model: DampingModel) -> str:
    """The damping of a model in words: ``linear+quadratic``."""
    words = {term: word for word, term in _DAMPING_WORDS.items()}
    return "+".join(words[term] for term in model.damping)


def split_speed_term(name: str) -> tuple[str, int]:
    """Term and power of the speed: ``b1*U2`` is ``("b1", 2)``, ``b1`` is ``("b1", 0)``."""
    base, star, factor = name.partition("*")
    if not star:
        return base, 0
    power = factor[1:] or "1"
    if not factor.startswith("U") or not power.isdigit():
        raise FitError(f"'{name}' is no dependence on speed", cure="write for example b1*U or b1*U2")
    return base, int(power)


def term_powers(name: str) -> tuple[int, int]:
    """Powers of the coordinate's unit and of the second in the unit of a term, the speed's factor left out."""
    return _POWERS[split_speed_term(name)[0]]


def term_unit(name: str, motion: str = "roll") -> str:
    """Unit of a term, e.g. ``s/rad2`` for b3 of roll, ``1/s/(m/s)`` for ``b1*U``."""
    power = split_speed_term(name)[1]
    angle, time = term_powers(name)
    powers = {"s": time, MOTION_UNITS[motion]: angle}
    above = [unit for unit, p in powers.items() if p > 0]
    below = [unit if p == -1 else f"{unit}{-p}" for unit, p in powers.items() if p < 0]
    lower = below[0] if len(below) == 1 else f"({' '.join(below)})"
    unit = f"{' '.join(above) or '1'}/{lower}" if below else " ".join(above)
    if power == 0:
        return unit
    return unit + ("/(m/s)" if power == 1 else f"/(m/s){power}")
