from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import t as student

from towtank.core.errors import FitError
from towtank.identify.coefficient_table import CoefficientTable

COV = np.array([[4.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
TABLE = CoefficientTable(("Yv", "Yr", "Y0"), np.array([2.0, -3.0, 1.0]), COV, np.array([5.0, 12.0, 5.0]), 0.95)


def test_names_find_their_coefficients() -> None:
    assert TABLE["Yr"] == -3.0
    assert TABLE.position("Y0") == 2
    with pytest.raises(FitError, match="no coefficient 'Nv'"):
        TABLE["Nv"]


def test_errors_and_correlation() -> None:
    np.testing.assert_allclose(TABLE.bse, [2.0, 1.0, 0.0])
    np.testing.assert_allclose(TABLE.correlation, [[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]])
    assert TABLE.cov_params() is COV


def test_intervals_use_each_coefficients_own_degrees_of_freedom() -> None:
    half = student.ppf(0.95, [5.0, 12.0, 5.0]) * [2.0, 1.0, 0.0]
    np.testing.assert_allclose(TABLE.conf_int(0.90)[:, 1] - TABLE.params, half)
    np.testing.assert_allclose(TABLE.pvalues[:2], 2.0 * student.sf([1.0, 3.0], [5.0, 12.0]))
    with pytest.raises(FitError, match="confidence"):
        TABLE.conf_int(95.0)


def test_frame_is_indexed_by_name() -> None:
    frame = TABLE.to_frame()
    assert list(frame.columns) == ["value", "std", "t", "p", "lower", "upper", "dof"]
    assert frame.loc["Yr", "value"] == -3.0
    assert frame.loc["Yr", "upper"] == pytest.approx(TABLE.conf_int()[1, 1])
