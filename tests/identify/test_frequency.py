from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.frequency import find_frequency

OMEGA = 2.0 * np.pi / 15.0


@pytest.mark.parametrize("cycles", [1.3, 2.7, 8.4])
def test_noise_free_frequency_is_exact_for_broken_cycles(cycles: float) -> None:
    t = 100.0 + 0.05 * np.arange(int(cycles * 15.0 / 0.05))
    y = 1.0 + 2.0 * np.cos(OMEGA * t + 0.3) + 0.5 * np.sin(3.0 * OMEGA * t)
    assert find_frequency(t, y, 3).omega == pytest.approx(OMEGA, rel=1e-12)


def test_uneven_sampling_and_several_channels() -> None:
    rng = np.random.default_rng(0)
    t = np.sort(rng.uniform(0.0, 60.0, 900))
    y = np.column_stack([np.cos(OMEGA * t), 1e-3 * np.sin(2.0 * OMEGA * t) + 1e-3 * np.cos(OMEGA * t)])
    assert find_frequency(t, y, 2).omega == pytest.approx(OMEGA, rel=1e-11)


def test_fundamental_below_the_strongest_line_is_found_and_not_invented() -> None:
    t = 0.05 * np.arange(2400)
    double = np.cos(2.0 * OMEGA * t)
    assert find_frequency(t, double, 3).omega == pytest.approx(2.0 * OMEGA, rel=1e-10)
    assert find_frequency(t, double + 0.3 * np.cos(OMEGA * t), 3).omega == pytest.approx(OMEGA, rel=1e-10)


def test_standard_error_matches_the_scatter(ar1: Callable[..., np.ndarray]) -> None:
    t = 0.1 * np.arange(600)
    noise = ar1(np.random.default_rng(1), 0.8, 600, 60)
    found = [find_frequency(t, 5.0 * np.cos(OMEGA * t) + column, 1) for column in noise.T]
    scatter = np.std([f.omega for f in found])
    assert np.mean([f.se for f in found]) == pytest.approx(scatter, rel=0.25)
    assert np.mean([abs(f.omega - OMEGA) < 2.0 * f.se for f in found]) > 0.85


@pytest.mark.parametrize(
    ("y", "message"),
    [
        (np.zeros(500), "no channel varies"),
        (np.linspace(0.0, 1.0, 500), "less than one cycle"),
        (np.where(np.arange(500) == 3, np.nan, 1.0), "not finite"),
    ],
)
def test_records_without_a_frequency_are_refused(y: np.ndarray, message: str) -> None:
    with pytest.raises(FitError, match=message):
        find_frequency(0.1 * np.arange(500), y, 2)


def test_order_zero_is_refused() -> None:
    with pytest.raises(FitError, match="without a harmonic"):
        find_frequency(np.arange(50.0), np.cos(np.arange(50.0)), 0)
