"""Damping ratios by the procedure for a simulator: both forms, noise, scale, frequencies."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.ship import Ship
from towtank.decay.heave_pitch import (
    decay_ratio,
    heave_frequency,
    logarithmic_decrement_of,
    pitch_frequency,
    roll_frequency,
    step_response_peak,
)
from towtank.decay.logarithmic_decrement import damping_ratio
from towtank.decay.virtual_decay import VirtualDecay, virtual_decay


def linear(zeta, motion="heave", omega=2.0, **options):
    terms = {"b1": 2.0 * zeta * omega, "c1": omega**2}
    return virtual_decay(VirtualDecay(terms, 0.1, motion=motion, **{"cycles": 6.0, **options})).record


def test_forms_are_half_a_percent_apart_at_a_tenth():
    decrement = logarithmic_decrement_of(0.1)
    assert damping_ratio(decrement) == pytest.approx(0.1, rel=1e-12)
    assert damping_ratio(decrement, "light") / 0.1 - 1.0 == pytest.approx(1.0 / math.sqrt(0.99) - 1.0)
    assert damping_ratio(decrement, "light") / 0.1 - 1.0 == pytest.approx(0.005, abs=5e-5)


@pytest.mark.parametrize("zeta", [0.01, 0.1, 0.3])
@pytest.mark.parametrize("motion", ["heave", "pitch"])
def test_linear_decay_gives_its_ratio_and_frequency(zeta, motion):
    found = decay_ratio(linear(zeta, motion))
    assert found.zeta == pytest.approx(zeta, rel=1e-3)
    assert found.zeta_light == pytest.approx(zeta / math.sqrt(1.0 - zeta**2), rel=1e-3)
    assert found.omega_n == pytest.approx(2.0, rel=3e-4)
    assert found.omega_d == pytest.approx(2.0 * math.sqrt(1.0 - zeta**2), rel=3e-4)
    assert found.motion == motion


def test_rest_position_does_not_matter():
    still, shifted = decay_ratio(linear(0.2)), decay_ratio(linear(0.2, offset=0.05))
    assert shifted.zeta == pytest.approx(still.zeta, rel=1e-6)


def test_noise_gives_an_error_that_holds_the_truth():
    found = decay_ratio(linear(0.05, cycles=12.0, white=3e-4, seed=2))
    assert abs(found.zeta - 0.05) < 3.0 * found.zeta_sd
    assert 0.0 < found.zeta_sd < 0.01


def test_heavy_damping_says_what_the_light_form_would_miss():
    (finding,) = decay_ratio(linear(0.3)).findings
    assert finding.rule == "damping-heavy"
    assert "4.8 %" in finding.message


def test_damping_that_depends_on_amplitude_is_flagged():
    plan = VirtualDecay({"b1": 0.02, "b2": 0.5, "c1": 4.0}, 0.3, motion="pitch")
    found = decay_ratio(virtual_decay(plan).record)
    assert [finding.rule for finding in found.findings] == ["damping-depends-on-amplitude"]
    table = found.to_frame()
    assert table["zeta"].iloc[0] > 2.0 * table["zeta"].iloc[-1]
    assert (table["zeta_light"] > table["zeta"]).all()


def test_full_scale_by_froude():
    model = decay_ratio(linear(0.1, scale=49.0))
    ship = model.at_scale(1.0)
    assert ship.zeta == model.zeta
    assert ship.omega_n == pytest.approx(model.omega_n / 7.0)
    assert ship.amplitude == pytest.approx(49.0 * model.amplitude)
    with pytest.raises(FitError, match="scale 0"):
        model.at_scale(0.0)


def test_peak_of_a_step_force():
    assert step_response_peak(0.0) == 2.0
    time = np.arange(0.0, 10.0, 1e-3)
    damped = 2.0 * math.sqrt(0.96)
    x = 1.0 - np.exp(-0.4 * time) * (np.cos(damped * time) + 0.4 / damped * np.sin(damped * time))
    assert step_response_peak(0.2) == pytest.approx(x.max(), rel=1e-6)
    with pytest.raises(FitError, match="between 0 and 1"):
        step_response_peak(1.0)


@pytest.mark.parametrize(
    ("record", "message"),
    [
        (lambda: linear(0.1, cycles=0.7), "turning points|swing to both sides"),
        (lambda: linear(0.97), "swing to both sides|turning points|smaller one"),
    ],
)
def test_records_without_cycles_are_refused(record, message):
    with pytest.raises(FitError, match=message):
        decay_ratio(record())


def test_natural_frequencies():
    ship = Ship("box", 100.0, 20.0, 5.0, volume=1e4, rho=1000.0, GM=2.0)
    assert heave_frequency(ship, 2000.0, 1e7) == pytest.approx(math.sqrt(1000.0 * 9.80665 * 2000.0 / 2e7))
    assert pitch_frequency(ship, 150.0, 9e9) == pytest.approx(math.sqrt(1e7 * 9.80665 * 150.0 / 9e9))
    assert roll_frequency(ship, 6e8) == pytest.approx(math.sqrt(1e7 * 9.80665 * 2.0 / 6e8))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: roll_frequency(Ship("a", 1.0, 1.0, 1.0, volume=1.0), 1.0), "no GM"),
        (lambda: pitch_frequency(Ship("a", 1.0, 1.0, 1.0), 1.0, 1.0), "no volume"),
        (lambda: heave_frequency(Ship("a", 1.0, 1.0, 1.0, volume=1.0), -1.0, 0.0), "no oscillation"),
    ],
)
def test_frequencies_need_particulars(call, message):
    with pytest.raises(FitError, match=message):
        call()
