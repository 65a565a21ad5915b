import numpy as np
import pytest

from towtank.decay.coloured_noise import ColouredNoise


def noise_of(make_noise, correlation: float, size: int = 2000, runs: int = 1) -> ColouredNoise:
    series = [make_noise(size, 1.0, correlation, seed) for seed in range(runs)]
    return ColouredNoise.of_residuals(series, [0.01] * runs, 3.0)


def test_white_noise_gives_the_textbook_covariance(make_noise):
    rows = np.random.default_rng(1).standard_normal((3, 2000))
    noise = noise_of(make_noise, 0.0)
    np.testing.assert_allclose(noise.covariance([rows]), rows @ rows.T, atol=0.12 * 2000)
    np.testing.assert_allclose(np.diag(noise.white_floor([rows])), np.diag(rows @ rows.T), rtol=0.12)


@pytest.mark.parametrize("correlation", [0.5, 0.9])
def test_autoregressive_noise_gives_the_exact_variance(make_noise, correlation):
    phase = 2.0 * np.pi * 0.01 * np.arange(2000)
    rows = np.vstack([np.exp(-0.001 * np.arange(2000)) * np.cos(phase), np.sin(phase)])
    lags = np.abs(np.subtract.outer(np.arange(2000), np.arange(2000)))
    exact = rows @ (correlation**lags) @ rows.T
    estimated = np.mean(
        [
            ColouredNoise.of_residuals([make_noise(2000, 1.0, correlation, k)], [0.01], 1.0).covariance([rows])
            for k in range(10)
        ],
        axis=0,
    )
    np.testing.assert_allclose(np.diag(estimated), np.diag(exact), rtol=0.2)


def test_records_add_up(make_noise):
    rows = np.random.default_rng(1).standard_normal((2, 2000))
    two = noise_of(make_noise, 0.5, runs=2)
    alone = [ColouredNoise((two.parts[k],), (0.01,), 1.0).covariance([rows]) for k in range(2)]
    np.testing.assert_allclose(two.covariance([rows, rows]), alone[0] + alone[1])
    assert two.dof > noise_of(make_noise, 0.5).dof


def test_correlation_time(make_noise):
    assert noise_of(make_noise, 0.0).correlation_samples[0] < 2.0
    # (1 + r)/(1 - r) = 19
    assert noise_of(make_noise, 0.9, 20000).correlation_samples[0] == pytest.approx(19.0, rel=0.35)
