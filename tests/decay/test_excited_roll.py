"""Roll under a harmonic excitation: listed decays, steady response, energy, bad requests."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.datasets import load_table
from towtank.decay.excited_roll import Excitation, simulate_excited_roll

LINEAR = {"b1": 0.2, "c1": 4.0}


def haddara_wu(case):
    row = load_table("roll-at-sea-benchmark").frame.set_index("case").loc[case]
    return {name: float(row[name]) for name in ("b1", "b3", "c1", "c3", "c5")}


@pytest.mark.parametrize("row", load_table("roll-at-sea-decays").frame.to_dict("records"), ids=str)
def test_listed_peaks_of_haddara_and_wu(row):
    time = np.arange(0.0, 20.0, 0.01)
    x = simulate_excited_roll(time, (math.radians(row["start"]), 0.0), haddara_wu(row["case"]))[:, 0]
    inside = np.flatnonzero((x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:]) & (x[1:-1] > 0.0)) + 1
    assert np.degrees(x[inside[:4]]) == pytest.approx([row[f"peak{i}"] for i in range(1, 5)], abs=0.01)
    up = np.flatnonzero((x[:-1] < 0.0) & (x[1:] >= 0.0))
    crossings = time[up] - x[up] * 0.01 / (x[up + 1] - x[up])
    assert np.diff(crossings).mean() == pytest.approx(row["period"], abs=1e-4)


def test_steady_response_is_the_transfer_function():
    wave = Excitation(0.3, 1.5, 0.4, 0.2)
    time = np.arange(0.0, 200.0, 0.05)
    x = simulate_excited_roll(time, (0.0, 0.0), LINEAR, wave)[:, 0]
    gain = 1.0 / (4.0 - 1.5**2 + 0.2j * 1.5)
    expected = 0.3 * np.imag(gain * np.exp(1j * (1.5 * time + 0.4))) + 0.2 / 4.0
    assert x[-500:] == pytest.approx(expected[-500:], abs=1e-7)


def test_moment_of_an_excitation():
    wave = Excitation(2.0, 3.0, 0.5, -1.0)
    assert wave.moment(np.array([0.0, 0.7])) == pytest.approx(
        [2.0 * math.sin(0.5) - 1.0, 2.0 * math.sin(2.6) - 1.0]
    )


def test_without_damping_energy_stays():
    terms = {"c1": 4.0, "c3": -1.0, "c5": 0.5}
    x, v = simulate_excited_roll(np.arange(0.0, 60.0, 0.1), (0.5, 0.0), terms).T
    energy = 0.5 * v**2 + 2.0 * x**2 - 0.25 * x**4 + 0.5 / 6.0 * x**6
    assert energy == pytest.approx(np.full(energy.size, energy[0]), rel=1e-6)


def test_capsize_leaves_missing_values():
    x = simulate_excited_roll(np.arange(0.0, 60.0, 0.1), (0.5, 3.0), {"c1": 1.0, "c3": -2.0})[:, 0]
    assert np.isnan(x[-1])


def test_bad_requests_are_refused():
    with pytest.raises(FitError, match="rise"):
        simulate_excited_roll(np.array([0.0, 0.0, 1.0]), (0.1, 0.0), LINEAR)
    with pytest.raises(FitError, match="no term 'b5'"):
        simulate_excited_roll(np.arange(3.0), (0.1, 0.0), {"b5": 1.0})
