"""Noise with memory, for the tests of this room."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.signal import lfilter

Noise = Callable[..., np.ndarray]


@pytest.fixture(scope="session")
def ar1() -> Noise:
    """``ar1(rng, rho, n, channels)``: stationary AR(1) with unit innovations, shape (n, channels)."""

    def draw(rng: np.random.Generator, rho: float, n: int, channels: int) -> np.ndarray:
        warm_up = 400
        return lfilter([1.0], [1.0, -rho], rng.standard_normal((n + warm_up, channels)), axis=0)[warm_up:]

    return draw
