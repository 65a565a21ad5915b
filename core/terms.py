"""Hull-force terms: what ``Yvvr`` means, as an object that builds its regression column and its force.

The same :class:`Term` serves the fit (its column of the design matrix) and the simulator (its share of the
force), so that what was fitted is what is simulated.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from .errors import TermError
from .variables import ORDER, TOKENS, VARIABLES

COMPONENTS = ("X", "Y", "N", "K")

_TOKEN = "|".join(sorted((re.escape(token) for token in TOKENS), key=len, reverse=True))
_PIECE = re.compile(rf"\|(?P<modulus>{_TOKEN})\||(?P<plain>{_TOKEN})")


@dataclass(frozen=True, order=True)
class Factor:
    """Power of one variable in a term: ``x**power * abs(x)**modulus``."""

    variable: str
    power: int
    modulus: int = 0

    def __post_init__(self) -> None:
        if self.variable not in VARIABLES:
            raise TermError(f"unknown variable '{self.variable}'", cure=f"use one of {', '.join(VARIABLES)}")
        if self.power < 0 or self.modulus < 0 or self.power + self.modulus == 0:
            raise TermError(f"'{self.variable}' needs a positive power in a term")

    @property
    def degree(self) -> int:
        """Power and modulus together."""
        return self.power + self.modulus


@dataclass(frozen=True)
class Term:
    """One term of a hull-force model.

    Attributes
    ----------
    name : str
        Name in the literature's spelling, e.g. ``Yvvr``, ``Nv|v|``, ``Xvvvv``, ``Yvphiphi``, ``R0``.
    component : {"X", "Y", "N", "K"}
        Force or moment that the term belongs to.
    factors : tuple of Factor
        Powers of the variables; empty for a constant.
    sign : {1, -1}
        ``R0`` enters the surge force with a minus sign (MMG); all other terms with plus.
    """

    name: str
    component: str
    factors: tuple[Factor, ...]
    sign: int = 1

    def __post_init__(self) -> None:
        if self.component not in COMPONENTS:
            raise TermError(
                f"term '{self.name}' has no force component", cure=f"begin with {', '.join(COMPONENTS)}"
            )
        variables = [factor.variable for factor in self.factors]
        if len(set(variables)) != len(variables):
            raise TermError(f"term '{self.name}' names a variable in two factors")
        object.__setattr__(self, "factors", tuple(sorted(self.factors, key=lambda f: ORDER[f.variable])))

    @classmethod
    @lru_cache(maxsize=1024)
    def parse(cls, name: str) -> Term:
        """Read a term from its name.

        ``b`` is the drift angle, ``d`` the rudder angle, ``|v|`` a modulus, ``u`` the surge velocity less the
        approach speed, ``0`` a constant; ``R0`` is the resistance, ``X = -R0``.

        Raises
        ------
        TermError
            When the name cannot be read, with the part that was not understood.
        """
        if name == "R0":
            return cls("R0", "X", (), -1)
        text = name.replace("'", "").replace("_", "")
        if not text or text[0] not in COMPONENTS:
            raise TermError(
                f"'{name}' is not a term",
                cure="write the force first, then the variables: Yvvr, Nv|v|, Xudot",
            )
        body = text[1:]
        if body.startswith("0"):
            body = body[1:]
        elif not body:
            raise TermError(f"'{name}' names a force but no variable", cure=f"write {text}0 for a constant")
        powers: dict[str, list[int]] = {}
        position = 0
        while position < len(body):
            piece = _PIECE.match(body, position)
            if piece is None:
                raise TermError(
                    f"'{name}': '{body[position:]}' is not a variable",
                    cure=f"variables are {', '.join(TOKENS)}",
                )
            is_modulus = piece.group("modulus") is not None
            variable = TOKENS[piece.group("modulus") or piece.group("plain")]
            powers.setdefault(variable, [0, 0])[is_modulus] += 1
            position = piece.end()
        factors = tuple(Factor(variable, power, modulus) for variable, (power, modulus) in powers.items())
        return cls(name, text[0], factors)

    @classmethod
    def spell(cls, component: str, factors: Iterable[Factor]) -> Term:
        """Term with the canonical spelling of its `factors`."""
        ordered = sorted(factors, key=lambda f: ORDER[f.variable])
        spelling = "".join(
            VARIABLES[f.variable].token * f.power + f"|{VARIABLES[f.variable].token}|" * f.modulus for f in ordered
        )
        return cls(component + (spelling or "0"), component, tuple(ordered))

    @property
    def degree(self) -> int:
        """Sum of all powers and moduli."""
        return sum(factor.degree for factor in self.factors)

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables in the term."""
        return tuple(factor.variable for factor in self.factors)

    @property
    def parity(self) -> int:
        """+1 when the term is unchanged by exchange of port and starboard, -1 when it changes sign."""
        odd = sum(factor.power for factor in self.factors if VARIABLES[factor.variable].mirrored)
        return -1 if odd % 2 else 1

    @property
    def symmetric_hull(self) -> bool:
        """True when a hull with port-starboard symmetry may have this term."""
        return self.parity == (1 if self.component == "X" else -1)

    def column(self, state: Mapping[str, np.ndarray | float]) -> np.ndarray:
        """Value of the term for a unit coefficient, in the force's sign.

        Parameters
        ----------
        state : mapping of str to array_like
            The variables by name, non-dimensional (or in SI for a dimensional set), broadcastable.

        Returns
        -------
        ndarray
            ``sign * prod(x**power * abs(x)**modulus)``, of the state's shape.
        """
        value: np.ndarray | float = float(self.sign)
        for factor in self.factors:
            try:
                x = state[factor.variable]
            except KeyError:
                raise TermError(
                    f"term '{self.name}' needs '{factor.variable}', which the motion does not give",
                    cure="give the channel or drop the term",
                ) from None
            for _ in range(factor.power):
                value = value * x
            if factor.modulus:
                magnitude = np.abs(x)
                for _ in range(factor.modulus):
                    value = value * magnitude
        if np.ndim(value) == 0 and state:
            return np.full(np.broadcast_shapes(*(np.shape(x) for x in state.values())), float(value))
        return np.asarray(value, dtype=float)


def parse_terms(names: Iterable[str | Term]) -> tuple[Term, ...]:
    """Terms from names; a name given twice is an error.

    Raises
    ------
    TermError
        For an unreadable or repeated name.
    """
    terms = tuple(name if isinstance(name, Term) else Term.parse(name) for name in names)
    seen: set[tuple[str, tuple[Factor, ...]]] = set()
    for term in terms:
        key = (term.component, term.factors)
        if key in seen:
            raise TermError(f"term '{term.name}' is given twice", cure="name each term once")
        seen.add(key)
    return terms
