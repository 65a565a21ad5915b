"""K and T from records of Nomoto's own equations."""

import math

import numpy as np
import pytest
from scipy.signal import TransferFunction, lsim

from towtank.core.errors import FitError, ReadError
from towtank.simulate.nomoto import NomotoFit, fit_nomoto
from towtank.simulate.trajectory import Trajectory

TIME = np.arange(0.0, 400.0, 1.0)


def pair(fit: NomotoFit) -> tuple[float, float]:
    return fit.K, fit.T


def record(hull, numerator, denominator, neutral=0.0, noise=0.0, name="zigzag 10/10"):
    """Rudder between two angles in straight lines, and the heading of a transfer function from rudder to heading."""
    corners = np.arange(0.0, 401.0, 5.0)
    helm = np.where((corners // 50) % 2 == 0, 1.0, -1.0) * math.radians(10.0)
    helm[0] = 0.0
    delta = np.interp(TIME, corners, helm)
    _, psi, _ = lsim(TransferFunction(numerator, denominator), delta - neutral, TIME, interp=True)
    psi = psi + noise * np.random.default_rng(4).standard_normal(len(psi))
    return Trajectory.from_columns({"time": TIME, "psi": psi, "delta": delta}, hull, name)


@pytest.mark.parametrize(("gain", "lag"), [(0.05, 20.0), (0.12, 60.0), (-0.04, -90.0)])
def test_first_order_exactly(hull, gain, lag):
    found = fit_nomoto(record(hull, [gain], [lag, 1.0, 0.0], neutral=0.01))
    assert pair(found) == pytest.approx((gain, lag), rel=1e-6)
    assert found.neutral_rudder == pytest.approx(0.01, rel=1e-5)
    assert found.r_squared == pytest.approx(1.0)
    assert math.isnan(found.T3)


def test_second_order_exactly(hull):
    found = fit_nomoto(record(hull, [0.06 * 12.0, 0.06], [40.0 * 6.0, 46.0, 1.0, 0.0]), order=2)
    fitted = [found.K, found.T1, found.T2, found.T3, found.T]
    assert fitted == pytest.approx([0.06, 40.0, 6.0, 12.0, 34.0], rel=1e-5)
    assert found.order == 2


def test_noise_leaves_the_truth_within_the_errors(hull):
    misses = []
    for order, numerator, denominator in (
        (1, [0.05], [20.0, 1.0, 0.0]),
        (2, [0.72, 0.06], [240.0, 46.0, 1.0, 0.0]),
    ):
        found = fit_nomoto(record(hull, numerator, denominator, noise=math.radians(0.2)), order=order)
        truth = {"K": numerator[-1], "T": 20.0 if order == 1 else 34.0, "neutral_rudder": 0.0}
        misses += [(getattr(found, name) - value) / found.errors[name] for name, value in truth.items()]
        assert found.rms == pytest.approx(math.radians(0.2), rel=0.1)
    assert np.abs(misses).max() < 3.5


def test_exact_zigzag_with_a_sudden_rudder(zigzag):
    run = zigzag()
    found = fit_nomoto(run.trajectory(step=0.1))
    assert pair(found) == pytest.approx((run.K, run.T), rel=0.01)


def test_turn_gives_the_steady_rate(hull):
    time = np.arange(0.0, 400.0, 0.25)
    delta = np.where(time > 20.0, 0.6, 0.0)
    after = np.clip(time - 20.0, 0.0, None)
    psi = 0.03 * 0.6 * (after - 25.0 * (1.0 - np.exp(-after / 25.0)))
    turn = Trajectory.from_columns({"time": time, "psi": psi, "delta": delta}, hull, "turning +35")
    free, known = fit_nomoto(turn), fit_nomoto(turn, neutral_rudder=0.0)
    assert pair(free) == pytest.approx((0.03, 25.0), rel=0.03)
    assert pair(known) == pytest.approx((0.03, 25.0), rel=0.005)
    assert known.errors["K"] < 0.1 * free.errors["K"]
    assert known.errors["neutral_rudder"] == known.neutral_rudder == 0.0


def test_window_keeps_to_a_part(hull):
    whole = record(hull, [0.05], [20.0, 1.0, 0.0])
    broken = whole.with_columns("later", psi=np.where(TIME > 300.0, 0.0, whole["psi"]))
    found = fit_nomoto(broken, window=(0.0, 290.0))
    assert pair(found) == pytest.approx((0.05, 20.0), rel=1e-3)


def test_prime_values(hull):
    found = fit_nomoto(record(hull, [0.05], [20.0, 1.0, 0.0])).scaled(hull, 5.0)
    assert found == pytest.approx({"K'": 1.0, "T'": 1.0, "P": 0.5})


def test_records_without_steering(hull):
    still = Trajectory.from_columns({"time": TIME, "psi": 0.0 * TIME, "delta": 0.1 + 0.0 * TIME}, hull, "zigzag")
    with pytest.raises(FitError, match="no steering to fit"):
        fit_nomoto(still)
    with pytest.raises(FitError, match=r"samples between 0 and 3 s"):
        fit_nomoto(record(hull, [0.05], [20.0, 1.0, 0.0]), window=(0.0, 3.0))
    with pytest.raises(ReadError, match="channels missing"):
        fit_nomoto(Trajectory.from_columns({"time": TIME, "psi": TIME}, hull, "zigzag"))


def test_record_that_does_not_determine_the_lag(hull):
    # A heading that follows the integral of the rudder at once: the lag is below the sampling interval.
    record_ = record(hull, [0.05], [1e-3, 1.0, 0.0])
    with pytest.raises(FitError, match="does not determine the time constant"):
        fit_nomoto(record_)
