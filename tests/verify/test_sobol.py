"""Sobol indices from coefficients and from samples."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.verify.input_distribution import UncertainInput
from towtank.verify.polynomial_chaos import project_chaos
from towtank.verify.sobol import chaos_sobol, sampled_sobol

ANGLES = tuple(UncertainInput(f"x{i}", "uniform", (-np.pi, np.pi)) for i in (1, 2, 3))


def ishigami(x):
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


# exact indices of Ishigami and Homma (1990)
_VARIANCE = 49.0 / 8.0 + 0.1 * np.pi**4 / 5.0 + 0.01 * np.pi**8 / 18.0 + 0.5
_FIRST = [0.5 * (1.0 + 0.1 * np.pi**4 / 5.0) ** 2 / _VARIANCE, 49.0 / 8.0 / _VARIANCE, 0.0]
_TOGETHER = 0.01 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0) / _VARIANCE
_TOTAL = [_FIRST[0] + _TOGETHER, _FIRST[1], _TOGETHER]


def test_indices_of_the_ishigami_function_from_coefficients():
    table = chaos_sobol(project_chaos(ANGLES, 12, ishigami, level=14))
    np.testing.assert_allclose(table["first"], _FIRST, atol=2e-4)
    np.testing.assert_allclose(table["total"], _TOTAL, atol=2e-4)
    np.testing.assert_allclose(table["interaction"], table["total"] - table["first"])


def test_indices_of_the_ishigami_function_from_samples():
    table = sampled_sobol(ishigami, ANGLES, power=11, seed=1)
    np.testing.assert_allclose(table["first"], _FIRST, atol=0.03)
    np.testing.assert_allclose(table["total"], _TOTAL, atol=0.03)
    assert (table["total_low"] < table["total_high"]).all()
    assert table["input"].tolist() == ["x1", "x2", "x3"]


def test_several_outputs_stand_below_each_other():
    both = sampled_sobol(lambda x: np.column_stack([ishigami(x), x[:, 0] + x[:, 1] + x[:, 2]]), ANGLES, power=8)
    assert both["output"].tolist() == ["y1"] * 3 + ["y2"] * 3
    np.testing.assert_allclose(both["first"][3:], 1.0 / 3.0, atol=0.1)


def test_an_output_that_does_not_vary_has_no_shares():
    table = chaos_sobol(project_chaos(ANGLES, 1, lambda x: np.zeros(len(x))))
    assert table[["first", "total"]].isna().all(axis=None)


def test_too_few_samples_are_refused():
    with pytest.raises(FitError, match="power 2"):
        sampled_sobol(ishigami, ANGLES, power=2)
