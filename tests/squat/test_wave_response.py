"""Responses to regular waves: made motions give back the ratios and phases that they were made with."""

import cmath
import math

import numpy as np
import pytest

from towtank.core.errors import FitError, TowtankError
from towtank.squat.head_waves import wave_number, wave_of_encounter
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord
from towtank.squat.squat_in_waves import harmonic_errors, reduce_in_waves
from towtank.squat.wave_response import RESPONSE_COLUMNS, wave_responses

LENGTH, DEPTH, SPEED, OMEGA = 4.0, 0.326, 0.872, 7.05
GAUGE_X, COG = 4.03, -0.05
HEAVE, TRIM, HEIGHT = cmath.rect(0.2, 1.4), cmath.rect(0.15, -2.0), 0.03
LAYOUT = SinkageLayout(length=LENGTH, points={"a": (2.0, 0.0), "b": (-2.0, 0.0)}, xG=COG)


def _waves(noise: float = 0.0, *, seed: int = 1, gauge_omega: float = OMEGA, unit: str = "m"):
    """A run whose gauge, ahead of the ship, meets each crest before the centre of gravity does."""
    time = np.arange(0.0, 20.0, 0.02)
    rng = np.random.default_rng(seed)
    k = wave_of_encounter(OMEGA, DEPTH, SPEED).wave_number
    at_cog = HEIGHT * np.exp(1j * OMEGA * time)
    gauge = (HEIGHT * np.exp(1j * (gauge_omega * time + k * (GAUGE_X - COG)))).real
    midship = 0.007 + (HEAVE * at_cog).real + noise * rng.standard_normal(time.size)
    trim = 0.001 + (TRIM * at_cog).real + noise * rng.standard_normal(time.size)
    gauge = gauge + noise * rng.standard_normal(time.size)
    record = SinkageRecord(
        time, midship, trim, LAYOUT, extra={"wave": gauge}, extra_units={"wave": unit}, name="made"
    )
    return reduce_in_waves(record, start=1.0, stop=19.0, places={"midship": 0.0}, run="made")


def _responses(waves):
    return wave_responses(waves, "wave", gauge_x=GAUGE_X, reference_x=COG, depth=DEPTH, speed=SPEED)


def test_ratios_and_phases_about_the_centre_of_gravity_are_recovered():
    found = _responses(_waves())
    assert tuple(found.frame.columns) == RESPONSE_COLUMNS
    rows = found.frame.set_index("quantity")
    assert list(rows.index) == ["sinkage_midship", "trim"]
    for quantity, true in (("sinkage_midship", HEAVE), ("trim", TRIM)):
        assert rows.loc[quantity, "ratio"] == pytest.approx(abs(true), rel=1e-6)
        assert rows.loc[quantity, "phase"] == pytest.approx(cmath.phase(true), abs=1e-4)
    assert rows.loc["sinkage_midship", "unit"] == "m/m"
    assert rows.loc["trim", "unit"] == "1/m"
    assert rows.loc["trim", "over_slope"] == pytest.approx(0.15 / found.wave.wave_number, rel=1e-6)
    assert math.isnan(rows.loc["sinkage_midship", "over_slope"])
    assert rows.loc["trim", "wave_amplitude"] == pytest.approx(HEIGHT)
    assert found.notes == ()


def test_the_errors_are_those_of_many_runs():
    frames = [_responses(_waves(5e-4, seed=seed)).frame.set_index("quantity") for seed in range(40)]
    for name in ("ratio", "phase"):
        values = np.array([frame.loc["sinkage_midship", name] for frame in frames])
        said = np.mean([frame.loc["sinkage_midship", f"{name}_se"] for frame in frames])
        assert values.std(ddof=1) == pytest.approx(said, rel=0.35)


def test_a_gauge_that_stands_in_the_tank_is_told_by_its_frequency():
    wave = wave_of_encounter(OMEGA, DEPTH, SPEED)
    (note,) = _responses(_waves(gauge_omega=wave.omega)).notes
    assert "it may stand in the tank instead of moving with the ship" in note


def test_what_gives_no_response_is_named():
    waves = _waves()
    with pytest.raises(FitError, match="'WG9' was not analysed"):
        wave_responses(waves, "WG9", gauge_x=4.0, reference_x=0.0, depth=DEPTH, speed=SPEED)
    with pytest.raises(FitError, match="channel wave: the wave elevation is in N -> name a channel of length"):
        _responses(_waves(unit="N"))
    with pytest.raises(TowtankError, match=r"a water depth of -1 m is impossible"):
        wave_responses(waves, "wave", gauge_x=4.0, reference_x=0.0, depth=-1.0, speed=SPEED)


def test_a_harmonic_that_is_not_there_has_no_phase():
    fit = _waves().fits["sinkage_midship"]
    size, turn = harmonic_errors(fit, 1)
    assert turn == pytest.approx(size / float(fit.amplitude[0]), rel=1.0)
    still = reduce_in_waves(
        SinkageRecord(
            np.arange(0.0, 20.0, 0.02),
            0.007 + 0.001 * np.cos(OMEGA * np.arange(0.0, 20.0, 0.02)),
            np.zeros(1000),
            LAYOUT,
            name="made",
        ),
        start=1.0,
        stop=19.0,
    )
    assert harmonic_errors(still.fits["trim"], 1)[1] == math.inf


@pytest.mark.parametrize(
    ("omega_e", "depth", "speed"), [(7.05, 0.326, 0.872), (0.6, 20.0, 8.0), (2.0, math.inf, 1.0)]
)
def test_the_wave_of_an_encounter_is_met_with_it(omega_e, depth, speed):
    wave = wave_of_encounter(omega_e, depth, speed)
    assert wave.omega + wave.wave_number * speed == pytest.approx(omega_e, rel=1e-12)
    assert wave.wave_number == pytest.approx(wave_number(wave.omega, depth), rel=1e-12)


def test_the_wave_of_an_encounter_at_rest_and_what_has_none():
    assert wave_of_encounter(3.0, 5.0).omega == pytest.approx(3.0)
    with pytest.raises(TowtankError, match="a speed of -1 m/s meets no head waves"):
        wave_of_encounter(3.0, 5.0, -1.0)
    with pytest.raises(TowtankError, match="a wave frequency of 0 rad/s is impossible"):
        wave_of_encounter(0.0, 5.0, 1.0)
