"""Dead, clipped, spiky and unsettled channels, and the sound ones that look like them."""

import numpy as np
import pytest

from towtank.pmm.audit_channels import audit_channels, audit_steadiness

TIME = np.arange(0.0, 40.0, 0.02)
ALL = slice(0, len(TIME))
WAVE = np.sin(0.8 * TIME)


def noise(seed: int, size: float = 0.02) -> np.ndarray:
    return size * np.random.default_rng(seed).standard_normal(len(TIME))


def found(lively=frozenset(), **channels):
    findings = audit_channels({"time": TIME, **channels}, TIME, ALL, lively=lively, force_unit=1.0)
    return {(item.rule, item.severity, item.place) for item in findings}


@pytest.mark.parametrize("seed", range(5))
def test_noisy_and_quantised_channels_are_clean(seed):
    Y = WAVE + noise(seed)
    assert found(X=-0.2 + noise(seed + 10), Y=Y, N=np.round(Y, 2), y=WAVE) == set()
    assert found(X=np.round(noise(seed), 1), Y=np.round(WAVE, 1)) == set()


def test_noise_free_forces_may_be_constant_or_vanish():
    assert found(X=np.full(len(TIME), -0.2), Y=np.zeros(len(TIME)), N=1e-16 * WAVE) == set()
    assert found(X=-0.2 - 1e-17 * WAVE, Y=WAVE) == set()


def test_missing_values():
    Y, y = WAVE + noise(0), WAVE.copy()
    Y[7], y[7:9] = np.inf, np.nan
    assert found(Y=Y, y=y) == {
        ("missing-values", "error", "channel Y"),
        ("missing-values", "warning", "channel y"),
    }


def test_dead_channels():
    dead = np.full(len(TIME), 0.3)
    assert found(X=-0.2 + noise(1), Y=dead) == {("constant-channel", "error", "channel Y")}
    assert found(frozenset({"y"}), Y=WAVE + noise(1), y=dead) == {("constant-channel", "warning", "channel y")}
    assert found(frozenset({"Y"}), X=WAVE, Y=dead) == {("constant-channel", "warning", "channel Y")}
    assert found(Y=WAVE + noise(1), rudder_angle=dead) == set()


def test_clipped_channels():
    clipped = np.clip(WAVE + noise(2), -0.8, None)
    assert found(Y=clipped) == {("saturated-channel", "warning", "channel Y")}
    assert found(Y=np.round(np.clip(WAVE + noise(2), None, 0.8), 3)) == {
        ("saturated-channel", "warning", "channel Y")
    }


def test_a_force_that_settles_at_its_extreme_is_not_clipped():
    settled = np.round(1.0 - np.exp(-TIME / 3.0), 4)
    assert found(Y=settled, X=-settled) == set()


def test_spikes():
    Y = WAVE + noise(3)
    Y[[900, 1300]] += 5.0
    assert found(Y=Y) == {("spikes", "warning", "channel Y")}
    step = WAVE + noise(3) + 5.0 * (TIME > 20.0)
    assert found(Y=step) == set()
    start = WAVE + noise(3)
    start[2] += 50.0
    assert found(Y=start) == set()


@pytest.mark.parametrize("seed", range(5))
def test_steady_runs_are_steady(seed):
    assert audit_steadiness({"X": -1.0 + noise(seed, 0.1), "Y": noise(seed + 9, 0.1)}, ALL) == []


def test_a_run_that_ends_in_its_transient():
    rising = -1.0 + np.exp(-TIME / 30.0) + noise(4)
    findings = audit_steadiness({"X": rising, "Y": noise(5)}, ALL)
    assert [(item.rule, item.severity) for item in findings] == [("transient-only", "error")]
    slow = -1.0 - 0.3 * TIME / TIME[-1]
    assert [item.severity for item in audit_steadiness({"X": slow}, ALL)] == ["warning"]
    settled = -1.0 + np.exp(-TIME / 4.0) + noise(4)
    assert audit_steadiness({"X": settled, "Y": noise(5)}, ALL) == []


def test_nothing_is_said_about_runs_without_forces():
    assert audit_steadiness({"u": WAVE}, ALL) == []
    assert audit_steadiness({"X": WAVE}, slice(0, 9)) == []
