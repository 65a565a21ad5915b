"""Mean squat and motion in waves: the benchmark run CW3 and a synthetic one."""

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.head_waves import met_wave
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord, read_sinkage
from towtank.squat.squat_in_waves import reduce_in_waves

LENGTH = 3.984
LAYOUT = SinkageLayout(
    length=LENGTH,
    points={"z_VF": (LENGTH / 2, 0.0), "z_VA": (-LENGTH / 2, 0.0)},
    speed="u",
    extra=("X", "WG4"),
    xG=-0.052,
)


@pytest.fixture(scope="module")
def cw3(benchmark_run):
    return reduce_in_waves(read_sinkage(benchmark_run("CW3"), LAYOUT), start=63.5, stop=79.2)


@pytest.mark.parametrize(
    ("quantity", "mean", "amplitude"),
    [
        ("sinkage_midship", 7.06e-3, 5.55e-3),
        # The laboratory counts trim by the stern: -0.60 mm/m there.
        ("trim", 0.60e-3, 4.04e-3),
        ("sinkage_stern", 5.86e-3, 8.80e-3),
        ("sinkage_bow", 8.26e-3, 10.66e-3),
        ("X", -7.37, 8.55),
    ],
)
def test_published_rows_of_the_benchmark(cw3, quantity, mean, amplitude):
    fit = cw3.fits[quantity]
    assert float(fit.mean) == pytest.approx(mean, rel=0.03)
    assert float(fit.amplitude[0]) == pytest.approx(amplitude, rel=0.01)


def test_frequency_of_encounter_is_found(cw3):
    assert cw3.omega == pytest.approx(7.05, abs=0.01)
    assert cw3.omega == pytest.approx(met_wave(1.38, 0.326, 0.872).omega_encounter, rel=0.01)
    assert cw3.notes == ()


def test_phases_about_the_wave_at_the_centre_of_gravity(cw3):
    """22 and 133 degrees are printed for stern and bow, to the amplitude ratios 0.282 and 0.342."""
    k = met_wave(1.38, 0.326).wave_number
    for quantity, printed_phase, printed_ratio in (("sinkage_stern", 22, 0.282), ("sinkage_bow", 133, 0.342)):
        response = cw3.response(quantity, "WG4", wave_x=4.03, to_x=-0.052, k=k)
        assert math.degrees(cmath.phase(response)) == pytest.approx(printed_phase, abs=4)
        # The print divides by half the wave height at another gauge, 31.18 mm.
        assert float(cw3.fits[quantity].amplitude[0]) / 31.175e-3 == pytest.approx(printed_ratio, abs=1.5e-3)


def _synthetic(noise=0.0):
    time = np.arange(0.0, 20.0, 0.025)
    angle = 7.05 * time
    midship = 0.007 + 0.0055 * np.cos(angle + 0.2) + 0.0003 * np.cos(2 * angle - 1.0)
    trim = 0.0006 + 0.004 * np.cos(angle + 1.5) + 0.0001 * np.cos(3 * angle)
    wave = 0.03 * np.cos(angle - 2.0)
    rng = np.random.default_rng(2)
    midship = midship + noise * rng.standard_normal(time.size)
    return SinkageRecord(time, midship, trim, LAYOUT, extra={"wave": wave}, extra_units={"wave": "m"}, name="made")


def test_harmonics_are_recovered_without_noise():
    waves = reduce_in_waves(_synthetic(), start=1.0, stop=19.0)
    assert waves.omega == pytest.approx(7.05, abs=1e-6)
    heave, trim = waves.fits["sinkage_midship"], waves.fits["trim"]
    assert heave.mean == pytest.approx(0.007, abs=1e-8)
    assert heave.amplitude == pytest.approx([0.0055, 0.0003, 0.0], abs=1e-8)
    assert heave.phase[:2] == pytest.approx([0.2, -1.0], abs=1e-4)
    assert trim.amplitude == pytest.approx([0.004, 0.0, 0.0001], abs=1e-8)
    frame = waves.frame.set_index("quantity")
    assert frame.loc["trim", "amplitude_3"] == pytest.approx(0.0001, abs=1e-8)
    assert frame.loc["wave", "unit"] == "m"


def test_the_frequency_found_in_noise_is_within_its_error():
    waves = reduce_in_waves(_synthetic(noise=2e-4), start=1.0, stop=19.0)
    assert abs(waves.omega - 7.05) < 4 * waves.omega_se
    assert waves.omega_se < 1e-3


def test_response_moves_the_wave_to_its_reference():
    waves = reduce_in_waves(_synthetic(), start=1.0, stop=19.0)
    response = waves.response("sinkage_midship", "wave", wave_x=4.0, to_x=0.0, k=3.0)
    assert abs(response) == pytest.approx(0.0055 / 0.03)
    expected = cmath.exp(1j * (0.2 + 2.0 + 3.0 * 4.0))
    assert response / abs(response) == pytest.approx(expected, abs=1e-4)
    with pytest.raises(FitError, match="'WG9' was not analysed"):
        waves.response("sinkage_midship", "WG9", wave_x=4.0, to_x=0.0, k=3.0)


def test_short_and_motionless_windows_are_named():
    record = _synthetic()
    short = reduce_in_waves(record, start=1.0, stop=6.0)
    assert short.notes == (f"{5.0 * 7.05 / (2 * math.pi):.1f} cycles in the window; ITTC asks for 10",)
    with pytest.raises(FitError, match="carry no 3 harmonics"):
        reduce_in_waves(record, start=1.0, stop=1.2)
    still = replace(record, midship=np.full_like(record.time, 0.007), trim=np.zeros_like(record.time))
    with pytest.raises(FitError, match="made: no channel varies"):
        reduce_in_waves(still, start=1.0, stop=19.0)
