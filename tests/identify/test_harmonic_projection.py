from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.harmonic_projection import HarmonicProjector, checked_time, harmonic_basis


def test_basis_columns_are_mean_cosine_sine() -> None:
    t, omega = np.linspace(0.0, 7.0, 50), 1.3
    basis = harmonic_basis(t, omega, 3, phase=0.4)
    a = omega * t + 0.4
    expected = [np.ones(50), np.cos(a), np.sin(a), np.cos(2 * a), np.sin(2 * a), np.cos(3 * a), np.sin(3 * a)]
    np.testing.assert_allclose(basis, np.column_stack(expected), atol=1e-14)
    assert harmonic_basis(t, omega, 0).shape == (50, 1)


@pytest.mark.parametrize("cycles", [4.0, 3.37, 0.6])
@pytest.mark.parametrize("trend", [False, True])
def test_projection_agrees_with_least_squares(cycles: float, trend: bool) -> None:
    n, order = 800, 3
    t = 5.0 + 0.02 * np.arange(n)
    omega = 2.0 * np.pi * cycles / (n * 0.02)
    y = np.random.default_rng(0).standard_normal((n, 4))
    projector = HarmonicProjector(t, omega, order, phase=0.2, trend=trend)
    expected = np.linalg.lstsq(projector.basis, y, rcond=None)[0]
    scale = np.abs(expected).max()
    np.testing.assert_allclose(projector.project(y), expected, atol=1e-9 * scale)
    np.testing.assert_allclose(projector.project(np.asfortranarray(y)), expected, atol=1e-9 * scale)
    np.testing.assert_allclose(projector.project(y[:, 1]), expected[:, 1], atol=1e-9 * scale)
    gram = projector.basis.T @ projector.basis
    np.testing.assert_allclose(projector.inverse_gram @ gram, np.eye(len(gram)), atol=1e-5)


def test_whole_cycles_are_recognised_and_others_not() -> None:
    t = 0.01 * np.arange(3000)
    assert HarmonicProjector(t, 2.0 * np.pi / 10.0, 3).orthogonal
    assert not HarmonicProjector(t, 2.0 * np.pi / 10.1, 3).orthogonal
    uneven = t + 0.003 * np.sin(t)
    assert not HarmonicProjector(uneven, 2.0 * np.pi / 10.0, 3).orthogonal


@pytest.mark.parametrize("cycles", [5.0, 4.3])
def test_closed_loop_is_exact(cycles: float) -> None:
    n = 1200
    t = 0.05 * np.arange(n)
    omega = 2.0 * np.pi * cycles / (n * 0.05)
    truth = np.random.default_rng(1).standard_normal((9, 3))
    projector = HarmonicProjector(t, omega, 4)
    signal = projector.reconstruct(truth)
    np.testing.assert_allclose(projector.project(signal), truth, atol=1e-12)
    np.testing.assert_array_equal(projector.reconstruct_rows(truth).shape, (3, n))
    np.testing.assert_allclose(projector.reconstruct_rows(truth).T, signal, atol=1e-13)


def test_uniform_sampling_is_told_from_jitter() -> None:
    t = 0.1 * np.arange(100)
    assert checked_time(t)[1:] == (pytest.approx(0.1), True)
    t[50] += 1e-3
    assert checked_time(t)[2] is False


@pytest.mark.parametrize(
    ("t", "omega", "order", "message"),
    [
        (np.arange(100.0), 0.0, 3, "not positive"),
        (np.arange(100.0), 1.3, 3, "half the sampling rate"),
        (np.arange(5.0), 0.1, 3, "samples cannot carry"),
        (np.array([0.0, 1.0, 1.0, 2.0]), 0.1, 1, "does not increase"),
        (np.arange(1.0), 0.1, 1, "at least two samples"),
        (0.01 * np.arange(2000), 1e-4, 3, "cannot separate"),
        (np.arange(100.0), 0.1, -1, "negative"),
    ],
)
def test_impossible_projections_are_refused(t: np.ndarray, omega: float, order: int, message: str) -> None:
    with pytest.raises(FitError, match=message):
        HarmonicProjector(t, omega, order)


def test_channels_must_fit_and_be_finite() -> None:
    projector = HarmonicProjector(np.arange(100.0), 0.2, 2)
    with pytest.raises(FitError, match="99 rows"):
        projector.project(np.zeros(99))
    with pytest.raises(FitError, match="not finite"):
        projector.project(np.where(np.arange(100) == 7, np.nan, 0.0))
