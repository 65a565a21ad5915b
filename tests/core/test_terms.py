import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core.errors import TermError
from towtank.core.hull_models import HULL_MODELS, hull_model
from towtank.core.terms import Factor, Term, parse_terms
from towtank.core.variables import VARIABLES


@pytest.mark.parametrize(
    ("name", "factors"),
    [
        ("Yvvr", {"v": (2, 0), "r": (1, 0)}),
        ("Nv|v|", {"v": (1, 1)}),
        ("Yrdot", {"rdot": (1, 0)}),
        ("Yvphiphi", {"v": (1, 0), "phi": (2, 0)}),
        ("Xetaeta", {"eta": (2, 0)}),
        ("Ybbr", {"beta": (2, 0), "r": (1, 0)}),
        ("Yddd", {"delta": (3, 0)}),
        ("Yvdd", {"v": (1, 0), "delta": (2, 0)}),
        ("Yuud", {"u": (2, 0), "delta": (1, 0)}),
        ("Y0u", {"u": (1, 0)}),
        ("X0", {}),
        ("Kp", {"p": (1, 0)}),
    ],
)
def test_names_are_read_as_the_field_writes_them(name, factors):
    term = Term.parse(name)
    assert term.component == name[0]
    assert {f.variable: (f.power, f.modulus) for f in term.factors} == factors


@pytest.mark.parametrize("name", ["", "Qv", "Y", "Yq", "Yvx", "Y|v", "v"])
def test_unreadable_names_are_refused(name):
    with pytest.raises(TermError):
        Term.parse(name)


def test_resistance_enters_with_a_minus_sign():
    assert Term.parse("R0").column({"v": np.zeros(2)}).tolist() == [-1.0, -1.0]


def test_column_is_the_product_of_powers_and_moduli():
    v = np.array([-2.0, 3.0])
    assert Term.parse("Yv|v|").column({"v": v}).tolist() == [-4.0, 9.0]
    assert Term.parse("Yvvv").column({"v": v}).tolist() == [-8.0, 27.0]


def test_missing_variable_is_named():
    with pytest.raises(TermError, match="phi"):
        Term.parse("Yphi").column({"v": np.zeros(3)})


@pytest.mark.parametrize("name", [t.name for m in HULL_MODELS for t in hull_model(m) if "eta" not in t.name])
def test_every_model_term_suits_a_symmetric_hull_or_is_a_heel_term(name):
    assert Term.parse(name).symmetric_hull


def test_a_term_given_twice_is_refused():
    with pytest.raises(TermError, match="twice"):
        parse_terms(["Yvvr", "Yvrv"])


factors = st.lists(
    st.tuples(st.sampled_from(sorted(VARIABLES)), st.integers(0, 3), st.integers(0, 2)).filter(
        lambda f: f[1] + f[2] > 0
    ),
    max_size=3,
    unique_by=lambda f: f[0],
)


@given(component=st.sampled_from("XYNK"), factors=factors)
def test_spelling_and_reading_are_inverse(component, factors):
    term = Term.spell(component, [Factor(*f) for f in factors])
    again = Term.parse(term.name)
    assert again.factors == term.factors
    assert again.component == component


def test_parity_follows_the_mirror():
    assert Term.parse("Xvr").parity == 1
    assert Term.parse("Yvvr").parity == -1
    assert Term.parse("Yv|v|").parity == -1
    assert Term.parse("Xv").symmetric_hull is False
