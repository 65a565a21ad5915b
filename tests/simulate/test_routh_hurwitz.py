"""Routh-Hurwitz against the roots themselves."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.simulate.routh_hurwitz import is_hurwitz, routh_column

coefficient = st.floats(-10.0, 10.0).filter(lambda x: abs(x) > 1e-3)


@given(st.lists(coefficient, min_size=2, max_size=7))
@settings(max_examples=300, deadline=None)
def test_verdict_is_that_of_the_roots(coefficients):
    roots = np.roots(coefficients)
    assume(np.abs(roots.real).min() > 1e-6)
    assert is_hurwitz(coefficients) == bool(np.all(roots.real < 0))


@given(
    st.lists(st.floats(-3.0, 3.0).filter(lambda x: abs(x) > 0.05), min_size=1, max_size=3),
    st.lists(st.tuples(st.floats(-3.0, 3.0).filter(lambda x: abs(x) > 0.05), st.floats(0.1, 3.0)), max_size=2),
)
@settings(max_examples=200, deadline=None)
def test_sign_changes_count_the_roots_on_the_right(real, pairs):
    roots = [*real, *(complex(a, b) for a, b in pairs), *(complex(a, -b) for a, b in pairs)]
    column = routh_column(np.poly(roots).real)
    # a zero in the column ends the array; it belongs to polynomials that this law does not count
    assume(np.abs(column).min() > 1e-9 * np.abs(column).max())
    changes = int(np.sum(np.diff(np.sign(column)) != 0))
    assert changes == sum(complex(root).real > 0 for root in roots)


@given(st.lists(coefficient, min_size=2, max_size=6), st.floats(0.1, 10.0))
@settings(max_examples=60, deadline=None)
def test_sign_and_size_of_the_whole_do_not_matter(coefficients, scale):
    column = np.abs(routh_column(coefficients))
    assume(column.min() > 1e-9 * column.max())
    assert is_hurwitz(coefficients) == is_hurwitz([-scale * value for value in coefficients])


@pytest.mark.parametrize("coefficients", [[1.0, 0.0, 1.0], [1.0, 1.0, 1.0, 1.0], [1.0, 0.0], [1.0, 2.0, 0.0]])
def test_roots_on_the_axis_are_not_stable(coefficients):
    assert not is_hurwitz(coefficients)


@pytest.mark.parametrize("coefficients", [[0.0, 1.0], [1.0], [1.0, float("nan")]])
def test_no_polynomial_is_named(coefficients):
    with pytest.raises(TowtankError, match="no polynomial"):
        is_hurwitz(coefficients)
