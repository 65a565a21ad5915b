"""Uncertain inputs: normal, uniform, gamma and beta, each with the polynomials that are orthogonal under its density.

The pairing is that of Wiener and Askey (Xiu and Karniadakis 2002): Hermite for the normal distribution, Legendre for
the uniform, Laguerre for the gamma, Jacobi for the beta distribution. Each input is a straight line of a *germ* xi
of standard form, x = centre + width * xi; the polynomials are those of the germ, in their classical scaling:

========  =======================  =====================================  ==========================================
family    germ                     polynomial                             mean square under the density of the germ
========  =======================  =====================================  ==========================================
normal    N(0, 1)                  He_n, probabilists' Hermite            n!
uniform   U(-1, 1)                 P_n, Legendre                          1 / (2 n + 1)
gamma     gamma(k, 1), xi >= 0     L_n^(k - 1), generalised Laguerre      Gamma(n + k) / (n! Gamma(k))
beta      beta(p, q) on (-1, 1)    P_n^(q - 1, p - 1), Jacobi             h_n / h_0 with the Jacobi weight
========  =======================  =====================================  ==========================================
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Family = Literal["normal", "uniform", "gamma", "beta"]

POLYNOMIALS = {"normal": "Hermite", "uniform": "Legendre", "gamma": "Laguerre", "beta": "Jacobi"}
"""Name of the polynomials of each family."""

PARAMETERS = {
    "normal": ("mean", "sd"),
    "uniform": ("low", "high"),
    "gamma": ("shape", "scale", "start"),
    "beta": ("p", "q", "low", "high"),
}
"""Parameters of each family, in order; the start of a gamma distribution is 0 when not given."""

_WRITTEN = re.compile(r"^\s*(?P<name>[^=]+?)\s*=\s*(?P<family>\w+)\s*\((?P<numbers>[^()]*)\)\s*$")


@dataclass(frozen=True)
class UncertainInput:
    """One input with its distribution.

    Attributes
    ----------
    name : str
    family : {"normal", "uniform", "gamma", "beta"}
    parameters : tuple of float
        As :data:`PARAMETERS` names them, in the unit of the input.

    Raises
    ------
    TowtankError
        For an unknown family, a wrong number of parameters, or a spread that is not positive.
    """

    name: str
    family: Family
    parameters: tuple[float, ...]

    def __post_init__(self) -> None:
        if self.family not in PARAMETERS:
            raise TowtankError(
                f"unknown distribution '{self.family}'",
                cure=f"use one of {', '.join(PARAMETERS)}",
                place=f"input {self.name}",
            )
        wanted = PARAMETERS[self.family]
        given = tuple(float(value) for value in self.parameters)
        if self.family == "gamma" and len(given) == 2:
            given = (*given, 0.0)
        if len(given) != len(wanted) or not all(math.isfinite(value) for value in given):
            raise TowtankError(
                f"{self.family} needs {len(wanted)} finite numbers, not {self.parameters}",
                cure=f"give {self.family}({', '.join(wanted)})",
                place=f"input {self.name}",
            )
        object.__setattr__(self, "parameters", given)
        positive = {"normal": given[1:], "uniform": (), "gamma": given[:2], "beta": given[:2]}[self.family]
        if any(value <= 0.0 for value in positive) or self.width <= 0.0:
            raise TowtankError(
                f"{self.family}{given} has no positive spread",
                cure=f"give {self.family}({', '.join(wanted)}) with low < high and positive spread and shape",
                place=f"input {self.name}",
            )

    @property
    def polynomial(self) -> str:
        """Name of the polynomials that are orthogonal under this distribution."""
        return POLYNOMIALS[self.family]

    @property
    def centre(self) -> float:
        """Value of the input where the germ is zero."""
        p = self.parameters
        return {"normal": p[0], "uniform": 0.5 * (p[0] + p[1]), "gamma": p[-1], "beta": 0.5 * (p[-2] + p[-1])}[
            self.family
        ]

    @property
    def width(self) -> float:
        """Change of the input for one unit of the germ."""
        p = self.parameters
        return {"normal": p[1], "uniform": 0.5 * (p[1] - p[0]), "gamma": p[1], "beta": 0.5 * (p[-1] - p[-2])}[
            self.family
        ]

    @property
    def mean(self) -> float:
        """Mean of the input."""
        return self.centre + self.width * float(self._scipy().mean())

    @property
    def sd(self) -> float:
        """Standard deviation of the input."""
        return self.width * float(self._scipy().std())

    def germ(self, values: ArrayLike) -> np.ndarray:
        """Germ of values of the input.

        Raises
        ------
        TowtankError
            When a value cannot come from the distribution, or is no number.
        """
        x = np.asarray(values, dtype=float)
        xi = (x - self.centre) / self.width
        low, high = self._scipy().support()
        slack = 1e-9
        outside = ~((xi >= low - slack) & (xi <= high + slack))
        if outside.any():
            bad = float(np.atleast_1d(x)[np.atleast_1d(outside)][0])
            raise TowtankError(
                f"{self.name} = {bad:g} cannot come from {self}",
                cure="widen the distribution or drop the sample",
                place=f"input {self.name}",
            )
        return np.clip(xi, low, high)

    def value(self, germ: ArrayLike) -> np.ndarray:
        """Values of the input at a germ."""
        return self.centre + self.width * np.asarray(germ, dtype=float)

    def quantile(self, probability: ArrayLike) -> np.ndarray:
        """Values of the input below which it lies with a probability."""
        return self.value(self._scipy().ppf(np.asarray(probability, dtype=float)))

    def probability(self, values: ArrayLike) -> np.ndarray:
        """Probability that the input is not larger than a value."""
        return np.asarray(self._scipy().cdf((np.asarray(values, dtype=float) - self.centre) / self.width))

    def _scipy(self) -> Any:
        """Distribution of the germ."""
        from scipy import stats

        p = self.parameters
        if self.family == "normal":
            return stats.norm()
        if self.family == "uniform":
            return stats.uniform(-1.0, 2.0)
        if self.family == "gamma":
            return stats.gamma(p[0])
        return stats.beta(p[0], p[1], -1.0, 2.0)

    def __str__(self) -> str:
        return f"{self.family}({', '.join(f'{value:g}' for value in self.parameters)})"


def parse_input(text: str) -> UncertainInput:
    """An input as it is written: ``"wave_height=normal(62.35, 0.64)"``.

    Parameters
    ----------
    text : str
        Name, equals sign, family with its parameters as :data:`PARAMETERS` names them.

    Raises
    ------
    TowtankError
        When it cannot be understood.
    """
    found = _WRITTEN.match(text)
    cure = "write it as name=normal(mean, sd), uniform(low, high), gamma(shape, scale), beta(p, q, low, high)"
    if found is None:
        raise TowtankError(f"'{text}' is not an input with its distribution", cure=cure)
    try:
        numbers = tuple(float(word) for word in found["numbers"].split(","))
    except ValueError:
        raise TowtankError(f"'{found['numbers']}' in '{text}' are not numbers", cure=cure) from None
    return UncertainInput(found["name"], cast(Family, found["family"].lower()), numbers)


def check_inputs(inputs: tuple[UncertainInput, ...]) -> None:
    """Refuse an empty list and names that stand twice.

    Raises
    ------
    TowtankError
    """
    if not inputs:
        raise TowtankError("no uncertain input is given", cure="name at least one, e.g. speed=normal(1.2, 0.01)")
    names = [one.name for one in inputs]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise TowtankError(f"the input {twice[0]} is given twice", cure="keep one distribution for each input")
