"""Mean wave-drift forces: the form without a table, and tables over angle and wavelength."""

import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ConventionError, ReadError, TowtankError
from towtank.core.ship import Ship
from towtank.datasets import load_set
from towtank.simulate.wave_drift import AnkudinovDrift, DriftTable, Waves

DTC = load_set("dtc").ship


def frame():
    angles = np.arange(0.0, 181.0, 45.0)
    rows = [(a, w, w * math.cos(math.radians(a)), 0.0, 0.0) for w in (0.5, 0.7, 1.0) for a in angles]
    return pd.DataFrame(rows, columns=["encounter angle [deg]", "wavelength/L", "CX", "CY", "CN"])


def test_form_of_the_dtc_paper():
    # equation 19 written out, H = 0.02 m at 1:100
    surge, sway, yaw, yaw_twice = AnkudinovDrift().amplitudes(DTC, 0.02)
    weight = DTC.rho * 9.80665
    block = DTC.volume / (DTC.L * DTC.B * DTC.T)
    assert surge == pytest.approx(
        0.0388 * weight * DTC.B * block * 0.02**2 + 0.311 * weight * DTC.B**2 * 0.02**2.5 / DTC.L**1.5
    )
    assert sway == pytest.approx(0.0388 * weight * DTC.L * 0.02**2)
    angle = 0.7
    total = yaw * math.sin(angle) + yaw_twice * math.sin(2 * angle)
    expected = -0.125 * weight * DTC.L * DTC.T * 0.02**2 * math.cos(angle) * math.sin(angle)
    assert total == pytest.approx(expected - 0.03 * sway * math.sin(angle) * DTC.L)


def test_form_is_dimensionally_consistent():
    model, full = DTC, DTC.at_scale(1.0)
    ratio = AnkudinovDrift().amplitudes(full, 2.0) / AnkudinovDrift().amplitudes(model, 0.02)
    assert ratio == pytest.approx([1e6, 1e6, 1e8, 1e8])


def test_form_needs_a_volume():
    with pytest.raises(ConventionError, match="block coefficient"):
        AnkudinovDrift().amplitudes(Ship("box", 10.0, 2.0, 1.0), 0.1)


def test_table_in_any_order_of_rows():
    shuffled = frame().sample(frac=1.0, random_state=3)
    table = DriftTable.from_frame(shuffled)
    assert table.wavelengths.tolist() == [0.5, 0.7, 1.0]
    assert table.at_wavelength(0.7).at(0.0)[0] == pytest.approx(0.7)
    assert 0.7 < table.at_wavelength(0.8).at(0.0)[0] < 1.0


def test_one_wavelength_is_enough():
    table = DriftTable.from_frame(frame()[lambda rows: rows["wavelength/L"] == 0.7])
    assert table.at_wavelength(0.7).at(math.pi)[0] == pytest.approx(-0.7)


def test_edges_are_held_and_told():
    table = DriftTable.from_frame(frame())
    assert np.array_equal(table.at_wavelength(3.0).values, table.at_wavelength(1.0).values)
    assert table.doubts(DTC, Waves(0.02, 0.0, 0.6 * DTC.L, table)) == []
    assert "those of 0.5 L are used" in table.doubts(DTC, Waves(0.02, 0.0, 0.2 * DTC.L, table))[0]


def test_missing_combination_is_named():
    rows = frame()
    hole = rows[~((rows["wavelength/L"] == 0.7) & (rows["encounter angle [deg]"] == 90))]
    with pytest.raises(ReadError, match="different angles"):
        DriftTable.from_frame(hole)


def test_csv_names_its_file(tmp_path):
    path = tmp_path / "drift.csv"
    frame().drop(columns="CY").to_csv(path, index=False)
    with pytest.raises(ReadError, match=r"drift\.csv: the table has no column 'CY'"):
        DriftTable.from_csv(path)
    frame().to_csv(path, index=False)
    assert DriftTable.from_csv(path).source == "drift.csv"


def test_table_needs_the_wavelength():
    with pytest.raises(TowtankError, match="needs the wavelength"):
        Waves(0.02, 0.0, None, DriftTable.from_frame(frame())).length_ratio(DTC)


def test_bad_waves_are_named():
    with pytest.raises(TowtankError, match="a height of -1"):
        Waves(-1.0, 0.0)
    with pytest.raises(TowtankError, match="a length of 0"):
        Waves(1.0, 0.0, 0.0)
