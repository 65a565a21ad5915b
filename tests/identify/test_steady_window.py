from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.stationarity import stationarity
from towtank.identify.steady_window import speed_plateau, steady_window

Noise = Callable[..., np.ndarray]
N = 3000
T = 0.02 * np.arange(N)
RAMP = np.interp(T, [0.0, 2.0, 7.0, 52.0, 57.0, 60.0], [0.0, 0.0, 1.5, 1.5, 0.0, 0.0])


def towed_run(ar1: Noise, seed: int, transient: float = 3.0) -> tuple[np.ndarray, np.ndarray]:
    """Forces of a run with acceleration, a decaying transient, a plateau and braking; and the speed."""
    rng = np.random.default_rng(seed)
    forces = np.array([-5.0, 20.0, 8.0]) * (RAMP / 1.5)[:, None] ** 2 + 0.2 * ar1(rng, 0.8, N, 3)
    towed = (T > 2.0) & (T < 52.0)
    forces[towed] += transient * np.exp(-(T[towed] - 7.0) / 3.0)[:, None]
    return forces, RAMP + 0.003 * rng.standard_normal(N)


@pytest.mark.parametrize("with_speed", [True, False])
def test_window_lies_in_the_steady_part(ar1: Noise, with_speed: bool) -> None:
    for seed in range(5):
        forces, speed = towed_run(ar1, seed)
        choice = steady_window(T, forces, speed=speed if with_speed else None)
        assert choice.start_time > 15.0
        assert choice.stop_time < 52.0
        assert choice.stop_time - choice.start_time > 15.0
        np.testing.assert_allclose(forces[choice.slice].mean(axis=0), [-5.0, 20.0, 8.0], atol=0.15)


def test_fraction_is_taken_of_the_steady_part(ar1: Noise) -> None:
    forces, speed = towed_run(ar1, 1)
    whole = steady_window(T, forces, rule="mser", speed=speed)
    part = steady_window(T, forces, fraction=(0.2, 0.6), speed=speed)
    length = whole.slice.stop - whole.slice.start
    assert part.slice.start - whole.slice.start == pytest.approx(0.2 * length, abs=1)
    assert part.slice.stop - whole.slice.start == pytest.approx(0.6 * length, abs=1)
    assert "MSER" in part.note
    assert "20-60 %" in part.note


def test_key_times_are_taken_as_given(ar1: Noise) -> None:
    forces, _ = towed_run(ar1, 2)
    choice = steady_window(T, forces[:, 1], rule="key-times", start=20.0, stop=30.0)
    assert (choice.start_time, choice.stop_time) == (pytest.approx(20.0), pytest.approx(30.0))
    assert choice.rule == "key-times"


def test_search_respects_start_and_stop(ar1: Noise) -> None:
    forces, _ = towed_run(ar1, 3)
    choice = steady_window(T, forces, rule="mser", start=25.0, stop=40.0)
    assert choice.start_time >= 25.0
    assert choice.stop_time <= 40.0


def test_speed_plateau_of_both_directions() -> None:
    noise = 0.004 * np.random.default_rng(0).standard_normal(N)
    for sign in (1.0, -1.0):
        first, last = speed_plateau(sign * (RAMP + noise))
        assert T[first] == pytest.approx(7.0, abs=0.3)
        assert T[last - 1] == pytest.approx(52.0, abs=0.3)


@pytest.mark.parametrize("with_speed", [True, False])
@pytest.mark.parametrize(
    ("name", "bow", "stern", "tolerance"), [("C1", 0.88, 0.58, 0.01), ("C2", 8.34, 5.01, 0.05)]
)
def test_published_squat_of_open_runs(squat_run, name, bow, stern, tolerance, with_speed: bool) -> None:
    # The published means themselves move by 0.1 mm with the window at the higher speed.
    run = squat_run(name)
    sinkage = np.column_stack([run["z_VF"], run["z_VA"]])
    choice = steady_window(run["time"], sinkage, speed=run["u"] if with_speed else None)
    assert choice.is_stationary
    np.testing.assert_allclose(sinkage[choice.slice].mean(axis=0), [bow, stern], atol=tolerance)


def test_drift_is_found_and_measured(ar1: Noise) -> None:
    y = 10.0 + ar1(np.random.default_rng(0), 0.5, N, 1)[:, 0] + 2.0 * (T - T[0]) / (T[-1] - T[0])
    verdict = stationarity(T, y)
    assert not verdict.stationary
    assert verdict.drift[0] == pytest.approx(2.0, abs=4.0 * verdict.drift_se[0])
    assert stationarity(T, y, tolerance=3.0).stationary
    choice = steady_window(T, y, rule="key-times", start=0.0)
    assert not choice.is_stationary
    assert choice.drift == pytest.approx(verdict.drift)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rule": "median"}, "no window rule"),
        ({"rule": "key-times"}, "needs a start or a stop"),
        ({"fraction": (0.9, 0.3)}, "no window"),
        ({"start": 5.0, "stop": 5.1}, "too few"),
        ({"speed": np.zeros(N)}, "does not move"),
        ({"speed": np.full(N, np.nan)}, "not finite"),
    ],
)
def test_contradictory_requests_are_refused(options: dict, message: str) -> None:
    y = np.random.default_rng(0).standard_normal(N)
    with pytest.raises(FitError, match=message):
        steady_window(T, y, **options)


def test_bad_channels_are_refused() -> None:
    with pytest.raises(FitError, match="rows"):
        steady_window(T, np.zeros(5))
    with pytest.raises(FitError, match="not finite"):
        steady_window(T, np.where(np.arange(N) == 5, np.inf, 1.0))
