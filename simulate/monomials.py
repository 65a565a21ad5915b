"""Hull terms as a short list of products, so that powers which several terms share are computed once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import TermError
from ..core.terms import Factor, Term
from .parameters import NODES, Node

_NODES = {
    "v": Node.V,
    "beta": Node.BETA,
    "r": Node.R,
    "p": Node.P,
    "phi": Node.PHI,
    "u": Node.DU,
    "surge": Node.SURGE,
    "delta": Node.DELTA,
    "c": Node.C,
    "thrust": Node.THRUST,
    "eta": Node.ETA,
}

MODULUS = -1
"""Second factor of a product that stands for the modulus of the first."""

_COMPONENTS = "XYNK"

Powers = tuple[tuple[str, int, int], ...]


@dataclass(frozen=True, eq=False)
class Monomials:
    """Products and the terms made of them.

    Attributes
    ----------
    products : ndarray of int64, shape (m, 2)
        Product k is node ``products[k, 0]`` times node ``products[k, 1]`` (its modulus for ``MODULUS``); nodes count
        from the variables of :class:`~towtank.simulate.parameters.Node` on through the products.
    nodes : ndarray of int64, shape (n,)
        Node of each term, in the order X, Y, N, K.
    rows : ndarray of int64, shape (n,)
        Where each of these terms stands in the terms given.
    ends : tuple of int
        Where the terms of X, Y, N and K end.
    variables : frozenset of str
        Variables that the terms use.
    """

    products: np.ndarray
    nodes: np.ndarray
    rows: np.ndarray
    ends: tuple[int, int, int, int]
    variables: frozenset[str]


def monomials(terms: Sequence[Term]) -> Monomials:
    """Products of hull terms.

    Parameters
    ----------
    terms : sequence of Term
        Terms without accelerations and without the depth, which is constant in a manoeuvre.

    Raises
    ------
    TermError
        For a variable that a manoeuvre does not have.
    """
    known: dict[Powers, int] = {(): int(Node.ONE)}
    products: list[tuple[int, int]] = []

    def add(powers: Powers, first: int, second: int) -> int:
        products.append((first, second))
        known[powers] = NODES + len(products) - 1
        return known[powers]

    def node(powers: Powers) -> int:
        if powers in known:
            return known[powers]
        if len(powers) == 1 and powers[0][1] + powers[0][2] == 1:
            variable, power, _ = powers[0]
            if power:
                return int(_NODES[variable])
            return add(powers, int(_NODES[variable]), MODULUS)
        splits = [_without(powers, i) for i in range(len(powers))]
        # a part that is there already costs nothing
        rest, single = min(splits, key=lambda split: split[0] not in known)
        first = node(rest)
        return add(powers, first, node(single))

    by_component = [[i for i, term in enumerate(terms) if term.component == c] for c in _COMPONENTS]
    rows = [i for group in by_component for i in group]
    for term in terms:
        _require_known(term)
    # short products first, so that longer ones find them
    for i in sorted(rows, key=lambda i: terms[i].degree):
        node(_powers(terms[i].factors))
    ends = np.cumsum([len(group) for group in by_component])
    return Monomials(
        products=np.array(products, dtype=np.int64).reshape(-1, 2),
        nodes=np.array([node(_powers(terms[i].factors)) for i in rows], dtype=np.int64),
        rows=np.array(rows, dtype=np.int64),
        ends=(int(ends[0]), int(ends[1]), int(ends[2]), int(ends[3])),
        variables=frozenset(name for term in terms for name in term.variables),
    )


def _powers(factors: Sequence[Factor]) -> Powers:
    return tuple((f.variable, f.power, f.modulus) for f in factors)


def _without(powers: Powers, place: int) -> tuple[Powers, Powers]:
    """`powers` less one power of the variable at `place`, and that one power."""
    variable, power, modulus = powers[place]
    single = (variable, 1, 0) if power else (variable, 0, 1)
    left = (variable, power - single[1], modulus - single[2])
    rest = [*powers[:place], *([left] if left[1] + left[2] else []), *powers[place + 1 :]]
    return tuple(rest), (single,)


def _require_known(term: Term) -> None:
    for name in term.variables:
        if name not in _NODES:
            raise TermError(
                f"term '{term.name}' depends on '{name}', which a manoeuvre does not have in such a term",
                cure="an acceleration term holds one acceleration alone; drop the term or refit the set",
            )
