import os
import subprocess
import sys

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.equation import simulate_decay
from towtank.decay.extremes import find_extremes
from towtank.decay.restoring_curve import RestoringCurve

HADDARA_WU = {1: (0.080, 0.0, 0.256, 11.88, 1.758, -18.624), 2: (0.077, 0.0, 0.407, 7.661, 2.496, -18.832)}


def test_eight_peaks_of_the_literature(literature):
    time = np.arange(0.0, 45.0, 0.05)
    angle = simulate_decay(time, (np.radians(25.0), 0.0), np.array(literature))[:, 0]
    peaks = np.degrees(np.abs(find_extremes(time, angle).value[:8]))
    expected = [25.0, 20.137, 16.640, 13.991, 11.912, 10.239, 8.865, 7.721]
    np.testing.assert_allclose(peaks, expected, atol=1e-3)


@pytest.mark.parametrize(
    ("case", "degrees", "peaks"),
    [
        (1, 10.0, (8.79, 7.83, 7.03, 6.35)),
        (1, 20.0, (15.31, 12.60, 10.75, 9.38)),
        (1, 30.0, (19.29, 14.94, 12.36, 10.58)),
        (2, 10.0, (8.55, 7.45, 6.56, 5.83)),
        (2, 20.0, (14.50, 11.60, 9.71, 8.34)),
        (2, 30.0, (17.82, 13.46, 10.95, 9.25)),
    ],
)
def test_haddara_and_wu(case, degrees, peaks):
    time = np.arange(0.0, 20.0, 0.01)
    angle = simulate_decay(time, (np.radians(degrees), 0.0), np.array(HADDARA_WU[case]))[:, 0]
    found = find_extremes(time, angle)
    upper = np.degrees(found.value[found.value > 0.0])[1:5]
    np.testing.assert_allclose(upper, peaks, atol=0.05)


def test_linear_decay_is_the_closed_form():
    time = np.linspace(0.0, 50.0, 401)
    path = simulate_decay(time, (0.2, 0.05), np.array([0.06, 0.0, 0.0, 0.36, 0.0, 0.0]))
    alpha, damped = 0.03, np.sqrt(0.36 - 0.03**2)
    exact = np.exp(-alpha * time) * (
        0.2 * np.cos(damped * time) + (0.05 + alpha * 0.2) / damped * np.sin(damped * time)
    )
    np.testing.assert_allclose(path[:, 0], exact, atol=2e-7)


def test_energy_is_lost_by_the_work_of_damping(literature):
    time = np.arange(0.0, 40.0, 0.02)
    x, v = simulate_decay(time, (0.4, 0.0), np.array(literature)).T
    energy = 0.5 * v**2 + 0.5 * 0.36 * x**2
    power = 0.04 * v**2 + 0.15 * np.abs(v) ** 3 + 0.3 * v**4
    lost = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(time))])
    np.testing.assert_allclose(energy[0] - energy, lost, atol=2e-6)


@pytest.mark.parametrize("column", range(8))
def test_sensitivities_are_the_gradient(column):
    time = np.arange(0.0, 40.0, 0.1)
    parameters = np.array([0.04, 0.15, 0.3, 0.36, 0.1, 0.1, 0.4, 0.02])

    def path(shift: float) -> np.ndarray:
        moved = parameters.copy()
        moved[column] += shift
        return simulate_decay(time, (moved[6], moved[7]), moved[:6])

    numeric = (path(1e-6) - path(-1e-6)) / 2e-6
    exact = simulate_decay(time, (0.4, 0.02), parameters[:6], sensitivities=True)
    np.testing.assert_allclose(
        exact[:, 2 + 2 * column : 4 + 2 * column], numeric, atol=1e-7 * np.abs(numeric).max()
    )


def test_lever_curve_of_a_sine_is_the_pendulum():
    angle = np.radians(np.arange(0.0, 81.0, 5.0))
    curve = RestoringCurve.from_levers(angle, 2.0 * np.sin(angle))
    assert curve.metacentric_height == pytest.approx(2.0, rel=1e-3)
    time = np.linspace(0.0, 40.0, 801)
    x, v = simulate_decay(time, (1.0, 0.0), np.array([0.0, 0.0, 0.0, 0.36, 0.0, 0.0]), curve=curve).T
    energy = 0.5 * v**2 + 0.36 * (1.0 - np.cos(x))
    np.testing.assert_allclose(energy, energy[0], rtol=2e-4)


def test_divergence_is_nan_and_bad_input_is_named():
    time = np.arange(0.0, 60.0, 0.1)
    path = simulate_decay(time, (2.0, 0.0), np.array([0.0, 0.0, 0.0, 0.36, 0.0, -1.0]))
    assert np.isnan(path[-1]).all()
    assert np.isfinite(path[0]).all()
    with pytest.raises(FitError, match="do not rise"):
        simulate_decay(time[::-1], (0.1, 0.0), np.ones(6))
    with pytest.raises(FitError, match="c1 > 0"):
        simulate_decay(time, (0.1, 0.0), np.array([0.0, 0.0, 0.0, -1.0, 0.0, 0.0]))


def test_plain_python_gives_the_same_motion(tmp_path):
    code = (
        "import numpy as np; from towtank.decay.equation import simulate_decay;"
        "p = simulate_decay(np.arange(0, 10, .1), (.4, .01), np.array([.04, .15, .3, .36, .1, .1]),"
        " sensitivities=True); np.save(r'%s', p)"
    )
    target = tmp_path / "plain.npy"
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", code % target], check=True, env=environment)
    compiled = simulate_decay(
        np.arange(0, 10, 0.1), (0.4, 0.01), np.array([0.04, 0.15, 0.3, 0.36, 0.1, 0.1]), sensitivities=True
    )
    np.testing.assert_allclose(np.load(target), compiled, rtol=1e-12, atol=1e-14)
