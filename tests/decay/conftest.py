from collections.abc import Callable

import numpy as np
import pytest

from towtank.decay.decay_input import decay_from_table
from towtank.decay.decay_record import DecayRecord
from towtank.decay.equation import simulate_decay


def coloured(size: int, sd: float, correlation: float, seed: int) -> np.ndarray:
    """AR(1) noise in its stationary state."""
    from scipy.signal import lfilter

    white = np.random.default_rng(seed).standard_normal(size + 1000) * sd * np.sqrt(1.0 - correlation**2)
    return np.asarray(lfilter([1.0], [1.0, -correlation], white))[1000:]


def decaying(
    coefficients: tuple[float, ...],
    *,
    degrees: float = 25.0,
    duration: float = 60.0,
    step: float = 0.1,
    noise: float = 0.0,
    correlation: float = 0.9,
    seed: int = 0,
    speed: float = 0.0,
    offset: float = 0.0,
) -> DecayRecord:
    """Free roll from rest at an angle, with noise in degrees."""
    time = np.arange(0.0, duration, step)
    angle = simulate_decay(time, (np.radians(degrees), 0.0), np.array(coefficients))[:, 0] + offset
    if noise:
        angle = angle + coloured(time.size, np.radians(noise), correlation, seed)
    return decay_from_table({"time": time, "phi": angle}, unit="rad", speed=speed, name=f"run {speed:g}")


@pytest.fixture(scope="session")
def make_decay() -> Callable[..., DecayRecord]:
    return decaying


@pytest.fixture(scope="session")
def make_noise() -> Callable[..., np.ndarray]:
    return coloured


#: alpha 0.02, beta 0.15, gamma 0.3, omega 0.6.
@pytest.fixture(scope="session")
def literature() -> tuple[float, ...]:
    return (0.04, 0.15, 0.3, 0.36, 0.0, 0.0)
