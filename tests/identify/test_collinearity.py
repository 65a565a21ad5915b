from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.collinearity import (
    exact_dependencies,
    inseparable_terms,
    scaled_svd,
    variance_inflation,
    variance_proportions,
)

RNG = np.random.default_rng(0)
BASE = RNG.standard_normal((80, 4))


def test_condition_number_ignores_units() -> None:
    names = list("abcd")
    plain, _ = scaled_svd(BASE, 80, names)
    rescaled, _ = scaled_svd(BASE * [1.0, 1e6, 1e-3, 50.0], 80, names)
    assert plain.condition_number == pytest.approx(rescaled.condition_number)
    unit = BASE / np.linalg.norm(BASE, axis=0)
    assert plain.condition_number == pytest.approx(np.linalg.cond(unit))


def test_variance_proportions_sum_to_one() -> None:
    svd, _ = scaled_svd(BASE, 80, list("abcd"))
    np.testing.assert_allclose(variance_proportions(svd).sum(axis=0), 1.0)


def test_near_dependency_names_its_members_only() -> None:
    close = np.column_stack([BASE, BASE[:, 0] - 2.0 * BASE[:, 2] + 1e-3 * RNG.standard_normal(80)])
    svd, _ = scaled_svd(close, 80, list("abcde"))
    assert inseparable_terms(svd, list("abcde")) == [{"a", "c", "e"}]
    good, _ = scaled_svd(BASE, 80, list("abcd"))
    assert inseparable_terms(good, list("abcd")) == []


def test_competing_near_dependencies_are_all_reported() -> None:
    noise = 1e-3 * RNG.standard_normal((80, 2))
    close = np.column_stack([BASE, BASE[:, 0] + noise[:, 0], BASE[:, 1] + noise[:, 1]])
    names = list("abcdef")
    svd, _ = scaled_svd(close, 80, names)
    reported = set().union(*inseparable_terms(svd, names))
    assert reported == {"a", "b", "e", "f"}


def test_exact_dependencies_come_apart() -> None:
    dependent = np.column_stack([BASE, BASE[:, 0] + BASE[:, 1], 3.0 * BASE[:, 3]])
    names = list("abcdef")
    svd, _ = scaled_svd(dependent, 80, names)
    assert svd.rank == 4
    assert svd.condition_number == np.inf
    assert exact_dependencies(svd, names) == [{"a", "b", "e"}, {"d", "f"}]
    null = svd.null_directions()
    np.testing.assert_allclose(dependent @ null, 0.0, atol=1e-12)
    np.testing.assert_allclose(null.T @ null, np.eye(2), atol=1e-12)


def test_unexcited_term_is_named() -> None:
    with pytest.raises(FitError, match="no run excites b"):
        scaled_svd(np.column_stack([BASE[:, 0], np.zeros(80)]), 80, ["a", "b"])


def test_variance_inflation_of_correlated_columns() -> None:
    # Two centred columns with correlation 0.8: VIF = 1/(1 - 0.64).
    a, b = np.linalg.qr(BASE[:, :2] - BASE[:, :2].mean(axis=0))[0].T
    x = np.column_stack([np.ones(80), 5.0 + a, 0.8 * a + 0.6 * b])
    unit = np.diagonal(np.linalg.inv(x.T @ x))
    vif = variance_inflation(unit, (x**2).sum(axis=0), x.sum(axis=0), 80.0, True)
    np.testing.assert_allclose(vif[1:], 1.0 / 0.36)
    orthogonal = np.eye(3) * [1.0, 2.0, 3.0]
    unit = np.diagonal(np.linalg.inv(orthogonal.T @ orthogonal))
    plain = variance_inflation(unit, (orthogonal**2).sum(axis=0), orthogonal.sum(axis=0), 3.0, False)
    np.testing.assert_allclose(plain, 1.0)
