from __future__ import annotations

import numpy as np
import pytest

from towtank.identify.divergence import divergence_row

T = np.linspace(0.0, 20.0, 2000)
NOISE = np.random.default_rng(0).standard_normal(2000)


def test_first_value_that_is_no_number() -> None:
    x = np.ones(100)
    x[[70, 90]] = np.nan, np.inf
    assert divergence_row(x) == 70


@pytest.mark.parametrize(
    "x",
    [
        10.0 + 0.1 * NOISE + np.exp(5.0 * (T - 18.0)),
        10.0 + 0.01 * np.exp(T / 3.0) * np.cos(6.0 * T),
        -1.0 + 1e-3 * NOISE - np.exp(4.0 * (T - 17.5)),
    ],
)
def test_blow_up_is_found(x: np.ndarray) -> None:
    row = divergence_row(x)
    assert row is not None
    assert row >= 900


@pytest.mark.parametrize(
    "x",
    [
        10.0 + NOISE,
        np.full(500, 3.0),
        10.0 + 50.0 * np.exp(-T) * np.cos(8.0 * T),
        10.0 + T,
        10.0 + 2.0 * np.cos(3.0 * T) * (1.0 - np.exp(-T / 5.0)),
        10.0 + 1e-6 * np.exp(T / 3.0) * np.cos(6.0 * T),
        NOISE[:10],
    ],
)
def test_bounded_records_have_not_diverged(x: np.ndarray) -> None:
    assert divergence_row(x) is None
