from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.harmonics import fit_harmonics, harmonic_basis, in_out_of_phase, whole_cycle_window

Noise = Callable[..., np.ndarray]
OMEGA = 2.0 * np.pi / 15.0
T = 0.025 * np.arange(6 * 600)
V, R, V0 = 0.3, 0.25, 0.12


def test_pure_sway_formulas() -> None:
    yv, yvvv, yvdot, y0, x0, xvv = -0.3, -1.6, -0.2, 0.04, -0.02, -0.05
    v, vdot = V * np.cos(OMEGA * T), -V * OMEGA * np.sin(OMEGA * T)
    y = y0 + yv * v + yvvv * v**3 + yvdot * vdot
    x = x0 + xvv * v**2
    fit = fit_harmonics(T, np.column_stack([y, x]), omega=OMEGA, order=4)
    np.testing.assert_allclose(fit.mean, [y0, x0 + 0.5 * xvv * V**2], atol=1e-12)
    np.testing.assert_allclose(fit.cos[0], [yv * V + 0.75 * yvvv * V**3, 0.0], atol=1e-12)
    np.testing.assert_allclose(fit.sin[0], [-yvdot * OMEGA * V, 0.0], atol=1e-12)
    np.testing.assert_allclose(fit.cos[1], [0.0, 0.5 * xvv * V**2], atol=1e-12)
    np.testing.assert_allclose(fit.cos[2], [0.25 * yvvv * V**3, 0.0], atol=1e-12)


def test_modulus_harmonics_match_their_closed_form() -> None:
    # |cos| cos has a slowly falling spectrum: only an analysis without aliasing shows 1e-12, so the continuous
    # integral is taken by quadrature over the smooth quarter cycle.
    nodes, weights = np.polynomial.legendre.leggauss(60)
    a = 0.25 * np.pi * (nodes + 1.0)
    for k, expected in ((1, 8.0 / (3.0 * np.pi)), (3, 8.0 / (15.0 * np.pi)), (5, -8.0 / (105.0 * np.pi))):
        integral = 4.0 / np.pi * 0.25 * np.pi * weights @ (np.cos(a) ** 2 * np.cos(k * a))
        assert integral == pytest.approx(expected, abs=1e-13)
    v = V * np.cos(OMEGA * T)
    fit = fit_harmonics(T, v * np.abs(v), omega=OMEGA, order=5)
    expected_cos = np.array([8.0 / 3.0, 0.0, 8.0 / 15.0, 0.0, -8.0 / 105.0]) / np.pi * V**2
    np.testing.assert_allclose(fit.cos, expected_cos, atol=1e-9)


def test_modulus_harmonics_by_fit_are_exact_in_the_limit_of_fine_sampling() -> None:
    # Aliases of |cos| cos fall with the cube of the samples in a cycle.
    n = 30000
    t = np.arange(n) * (15.0 / n)
    v = V * np.cos(OMEGA * t)
    fit = fit_harmonics(t, v * np.abs(v), omega=OMEGA, order=1)
    assert fit.cos[0] == pytest.approx(8.0 / (3.0 * np.pi) * V**2, abs=1e-12)


def test_yaw_with_drift_formulas() -> None:
    yv, yvvv, yr, yrrr, yvrr, yvvr, xvr, yrdot = -0.3, -1.6, 0.08, 0.01, -0.4, 0.38, 0.05, -0.01
    r, rdot = R * np.cos(OMEGA * T), -R * OMEGA * np.sin(OMEGA * T)
    y = yv * V0 + yvvv * V0**3 + yr * r + yrrr * r**3 + yvrr * V0 * r**2 + yvvr * V0**2 * r + yrdot * rdot
    fit = fit_harmonics(T, np.column_stack([y, xvr * V0 * r]), omega=OMEGA, order=3)
    assert fit.mean[0] == pytest.approx(yv * V0 + yvvv * V0**3 + 0.5 * yvrr * V0 * R**2, abs=1e-12)
    assert fit.cos[0, 0] == pytest.approx((yr + yvvr * V0**2) * R + 0.75 * yrrr * R**3, abs=1e-12)
    assert fit.sin[0, 0] == pytest.approx(-yrdot * OMEGA * R, abs=1e-12)
    assert fit.cos[1, 0] == pytest.approx(0.5 * yvrr * V0 * R**2, abs=1e-12)
    assert fit.cos[0, 1] == pytest.approx(xvr * V0 * R, abs=1e-12)


@pytest.mark.parametrize("phase", [0.0, 0.7])
def test_in_and_out_of_phase_whatever_the_clock(phase: float) -> None:
    yv, yvvv, yvdot, shift = -0.3, -1.6, -0.2, 1.1
    v = V * np.cos(OMEGA * T + shift)
    vdot = -V * OMEGA * np.sin(OMEGA * T + shift)
    force = fit_harmonics(T, yv * v + yvvv * v**3 + yvdot * vdot, omega=OMEGA, phase=phase)
    motion = fit_harmonics(T, v, omega=OMEGA, phase=phase)
    split = in_out_of_phase(force, motion)
    assert split.velocity == pytest.approx(yv * V + 0.75 * yvvv * V**3, abs=1e-12)
    assert split.acceleration == pytest.approx(yvdot * OMEGA * V, abs=1e-12)
    assert split.acceleration_amplitude == pytest.approx(OMEGA * V, rel=1e-12)


def test_phase_and_amplitude_conventions() -> None:
    y = 2.0 * np.cos(OMEGA * T + 0.4) + 0.5 * np.cos(2.0 * OMEGA * T - 1.0)
    fit = fit_harmonics(T, y, omega=OMEGA, order=2)
    np.testing.assert_allclose(fit.amplitude, [2.0, 0.5], atol=1e-12)
    np.testing.assert_allclose(fit.phase, [0.4, -1.0], atol=1e-12)
    referred = fit_harmonics(T, y, omega=OMEGA, order=2, phase=0.4)
    np.testing.assert_allclose(referred.phase, [0.0, -1.8], atol=1e-12)
    np.testing.assert_allclose(referred.predict(T), y, atol=1e-12)
    assert fit.r2 == pytest.approx(1.0, abs=1e-12)
    assert fit.n_cycles == pytest.approx(6.0, rel=1e-12)


@pytest.mark.parametrize(("n", "cycles", "rho"), [(600, 3.0, 0.8), (1500, 3.4, 0.8), (1500, 4.0, 0.95)])
@pytest.mark.parametrize("detrend", [False, True])
def test_intervals_cover(ar1: Noise, n: int, cycles: float, rho: float, detrend: bool) -> None:
    t = 0.05 * np.arange(n)
    omega = 2.0 * np.pi * cycles / (n * 0.05)
    truth = np.array([1.0, 5.0, -2.0, 0.3, 0.0, 1.0, 0.0])
    noise = ar1(np.random.default_rng(5), rho, n, 1000)
    signal = harmonic_basis(t, omega, 3) @ truth
    fit = fit_harmonics(t, signal[:, None] + noise, omega=omega, order=3, detrend=detrend)
    lower, upper = fit.conf_int()
    coverage = np.mean((lower <= truth[:, None]) & (truth[:, None] <= upper), axis=1)
    # Seven coverages of a thousand each: the binomial scatter of one is 0.7 %.
    assert coverage.min() >= 0.92
    assert coverage.max() <= 0.975
    assert 0.935 <= coverage.mean() <= 0.965


def test_found_frequency_widens_the_errors(ar1: Noise) -> None:
    n = 1000
    t = 0.05 * np.arange(n)
    omega = 2.0 * np.pi * 3.4 / (n * 0.05)
    truth = np.array([1.0, 5.0, 0.0])
    signal = harmonic_basis(t, omega, 1) @ truth
    inside = []
    for column in ar1(np.random.default_rng(6), 0.8, n, 80).T:
        fit = fit_harmonics(t, signal + column, order=1)
        lower, upper = fit.conf_int()
        inside.append((lower <= truth) & (truth <= upper))
        assert fit.omega_se > 0.0
    # The sine coefficient of a cosine takes the whole error of the frequency.
    assert np.mean(inside, axis=0).min() >= 0.88
    assert fit.se[2] > 1.3 * fit_harmonics(t, signal + column, omega=omega, order=1).se[2]


def test_published_heave_of_an_open_run_in_waves(squat_run) -> None:
    run = squat_run("CW3")
    # The steady speed lasts from 58 to 92 s, but from 77 s on the heave grows and then falls.
    window = whole_cycle_window(run["time"], 7.05, start=64.0, stop=76.5)
    fit = fit_harmonics(run["time"][window], run["heave"][window], order=2)
    assert fit.omega == pytest.approx(7.05, abs=0.005)
    assert fit.mean == pytest.approx(7.06, abs=0.02)
    assert fit.amplitude[0] == pytest.approx(5.55, abs=0.03)


def test_drift_is_fitted_beside_the_harmonics() -> None:
    y = 3.0 * np.cos(OMEGA * T) + 0.02 * (T - T.mean())
    fit = fit_harmonics(T, y, omega=OMEGA, order=2, detrend=True)
    assert fit.slope == pytest.approx(0.02, abs=1e-12)
    assert fit.cos[0] == pytest.approx(3.0, abs=1e-12)
    np.testing.assert_allclose(fit.predict(T), y, atol=1e-11)


def test_frame_lists_each_channel_and_harmonic() -> None:
    fit = fit_harmonics(T, np.column_stack([np.cos(OMEGA * T), 2.0 + 0.0 * T]), omega=OMEGA, order=2)
    frame = fit.to_frame()
    assert frame[["channel", "harmonic"]].to_numpy().tolist() == [[c, k] for c in (0, 1) for k in (0, 1, 2)]
    assert frame.loc[1, "amplitude"] == pytest.approx(1.0)
    assert frame.loc[3, "cos"] == pytest.approx(2.0)
    assert frame.loc[5, "omega [rad/s]"] == pytest.approx(2.0 * OMEGA)


def test_window_holds_the_largest_whole_number_of_cycles() -> None:
    t = 2.0 + 0.01 * np.arange(4000)
    omega = 2.0 * np.pi / 9.0
    window = whole_cycle_window(t, omega)
    assert (window.start, window.stop) == (0, 3600)
    skipped = whole_cycle_window(t, omega, skip_cycles=1, start=3.0)
    assert t[skipped.start] == pytest.approx(12.0, abs=1e-9)
    assert skipped.stop - skipped.start == 2700
    stopped = whole_cycle_window(t, omega, stop=25.0)
    assert stopped.stop - stopped.start == 1800


def test_window_takes_a_record_that_ends_exactly_with_its_last_cycle() -> None:
    t = 0.03 * np.arange(500)
    window = whole_cycle_window(t, 2.0 * np.pi / 7.5)
    assert (window.start, window.stop) == (0, 500)


def test_window_without_a_cycle_is_refused() -> None:
    with pytest.raises(FitError, match="less than one"):
        whole_cycle_window(0.1 * np.arange(50), 2.0 * np.pi / 6.0)
    with pytest.raises(FitError, match="not positive"):
        whole_cycle_window(0.1 * np.arange(50), -1.0)


def test_phases_need_one_clock_and_a_moving_motion() -> None:
    force = fit_harmonics(T, np.cos(OMEGA * T), omega=OMEGA)
    with pytest.raises(FitError, match="different frequency"):
        in_out_of_phase(force, fit_harmonics(T, np.cos(OMEGA * T), omega=1.01 * OMEGA))
    with pytest.raises(FitError, match="one channel"):
        in_out_of_phase(force, fit_harmonics(T, np.ones((T.size, 2)), omega=OMEGA))
    with pytest.raises(FitError, match="no first harmonic"):
        in_out_of_phase(force, fit_harmonics(T, np.zeros(T.size), omega=OMEGA))
