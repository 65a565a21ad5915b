"""Products of the hull terms."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import TermError
from towtank.core.terms import parse_terms
from towtank.simulate.monomials import MODULUS, monomials
from towtank.simulate.parameters import NODES, Node


def evaluated(form, v, r, phi):
    value = np.zeros(NODES + len(form.products))
    value[Node.V], value[Node.R], value[Node.PHI], value[Node.ONE] = v, r, phi, 1.0
    for k, (a, b) in enumerate(form.products):
        value[NODES + k] = abs(value[a]) if b == MODULUS else value[a] * value[b]
    return value[form.nodes]


def test_products_are_the_terms_own_columns():
    names = [
        "R0",
        "Xvv",
        "Xvr",
        "Xvvvv",
        "Yv",
        "Yr",
        "Yvvr",
        "Yv|v|",
        "Y|v|r",
        "Yvphiphi",
        "Nv",
        "Nrrr",
        "N|v|r|r|",
    ]
    names += ["Kphi", "Kvvphi"]
    terms = parse_terms(names)
    form = monomials(terms)
    state = {"v": -0.31, "r": 0.42, "phi": 0.1}
    found = evaluated(form, *state.values())
    for place, row in enumerate(form.rows):
        term = terms[row]
        assert found[place] * term.sign == pytest.approx(float(term.column(state)), rel=1e-14)
    assert [terms[row].component for row in form.rows] == sorted((t.component for t in terms), key="XYNK".index)


def test_powers_that_terms_share_are_computed_once():
    form = monomials(parse_terms(["Xvv", "Xvvvv", "Yvvv", "Yvvr", "Nvvv", "Nvvr"]))
    assert len(form.products) == 4  # vv, vvv, vvr, vvvv


def test_unknown_variable_is_named():
    with pytest.raises(TermError, match="vdot"):
        monomials(parse_terms(["Yvvdot"]))
