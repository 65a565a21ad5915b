"""Keel, trim and heel from antennas and attitude."""

import numpy as np
import pytest

from towtank.core.errors import AuditError, CampaignError, ReadError
from towtank.squat.rtk_antennas import Antenna, AntennaLayout, keel_from_antennas, read_antennas
from towtank.squat.virtual_voyage import DRAUGHT, virtual_layout, virtual_tide, virtual_voyage


def altitudes(places, keel, trim, heel):
    """Exact altitudes of antennas on a ship with these angles in rad."""
    down = [
        keel + a.x * np.sin(trim) + a.y * np.cos(trim) * np.sin(heel) - a.z * np.cos(trim) * np.cos(heel)
        for a in places
    ]
    return -np.column_stack(down)


TIME = np.arange(5.0)
KEEL = np.array([3.0, 4.0, 5.0, 6.0, 7.0])
TRIM = np.radians([0.0, 0.5, -0.5, 2.0, 0.1])
HEEL = np.radians([0.0, 3.0, -8.0, 5.0, 0.2])


@pytest.mark.parametrize("sensors", [(), ("pitch",), ("roll",), ("pitch", "roll")])
def test_rotation_is_exact_whatever_tells_the_angles(sensors):
    places = [Antenna(60.0, -25.0, 52.0), Antenna(60.0, 25.0, 52.0), Antenna(150.0, 0.0, 30.0)]
    given = {name: name for name in sensors}
    layout = AntennaLayout(350.0, 51.0, {f"Z{n}": place for n, place in enumerate(places)}, **given)
    found = keel_from_antennas(
        TIME,
        altitudes(places, KEEL, TRIM, HEEL),
        layout,
        trim=np.sin(TRIM) if "pitch" in sensors else None,
        roll=np.sin(HEEL) if "roll" in sensors else None,
    )
    np.testing.assert_allclose(found.keel, KEEL, atol=2e-5)
    np.testing.assert_allclose(found.trim, np.sin(TRIM), atol=1e-6)
    np.testing.assert_allclose(found.heel, np.cos(TRIM) * np.sin(HEEL), atol=1e-6)
    assert found.misfit == pytest.approx(0.0, abs=1e-6)


def test_one_antenna_on_the_centre_line_with_a_pitch_sensor_knows_no_heel():
    layout = AntennaLayout(200.0, 30.0, {"Z": Antenna(-70.0, 0.0, 40.0)}, pitch="pitch")
    place = list(layout.antennas.values())
    found = keel_from_antennas(TIME, altitudes(place, KEEL, TRIM, 0.0 * HEEL), layout, trim=np.sin(TRIM))
    np.testing.assert_allclose(found.keel, KEEL)
    assert found.heel is None


@pytest.mark.parametrize(
    ("antennas", "sensors", "said"),
    [
        ({"Z": Antenna(0.0)}, {}, "1 antenna.s. do not tell trim"),
        ({"A": Antenna(50.0, 10.0), "B": Antenna(-50.0, -10.0)}, {}, "2 antenna.s. do not tell trim and heel"),
        ({"A": Antenna(50.0, 10.0)}, {"pitch": "p"}, "do not tell heel"),
        ({}, {}, "no antenna is declared"),
        ({"A": Antenna(0.0)}, {"pitch": "p", "pitch_positive": "up"}, "sense of an angle is unknown"),
        ({"A": Antenna(0.0)}, {"pitch": "p", "length": -1.0}, "-1 m by 30 m is impossible"),
    ],
)
def test_a_layout_that_does_not_determine_the_ship_is_refused(antennas, sensors, said):
    with pytest.raises(CampaignError, match=said):
        AntennaLayout(**{"length": 200.0, "breadth": 30.0, "antennas": antennas, **sensors})


@pytest.fixture(scope="module")
def voyage():
    return virtual_voyage(step=2.0, noise=0.005)


def test_a_file_is_read_in_its_own_units_and_signs(voyage, tmp_path):
    record = read_antennas(voyage.write(tmp_path / "v.csv"), virtual_layout())
    at_rest = record.time < 400.0
    draught = record.keel + virtual_tide().at(record.time)
    # the askew gyro lifts the ship by 14 cm, the same at rest and under way
    assert np.ptp(draught[at_rest]) < 0.03
    assert np.median(draught[at_rest]) == pytest.approx(DRAUGHT - 0.142, abs=5e-3)
    assert record.misfit < 0.01
    assert record.sha256


def sabotaged(voyage, tmp_path, **changes):
    from dataclasses import replace

    return replace(voyage, channels={**voyage.channels, **changes}).write(tmp_path / "bad.csv")


@pytest.mark.parametrize(
    ("name", "change", "rule"),
    [
        ("Z_bow", lambda z: np.full_like(z, 33.0), "constant-channel"),
        ("pitch", lambda z: np.full_like(z, np.nan), "all-missing"),
        ("Z_port", lambda z: -z, "antennas-disagree"),
        ("roll", lambda z: -z, "antennas-disagree"),
        ("pitch", lambda z: z * 180.0 / np.pi, "antennas-disagree"),
        ("roll", lambda z: z * 180.0 / np.pi, "angle-in-degrees"),
        ("time", lambda t: np.where(t > 500.0, 500.0, t), "time-not-increasing"),
    ],
)
def test_each_fault_of_a_file_has_its_rule(voyage, tmp_path, name, change, rule):
    file = sabotaged(voyage, tmp_path, **{name: change(voyage.channels[name])})
    with pytest.raises(AuditError, match=rf"\[{rule}\]"):
        read_antennas(file, virtual_layout())


def test_two_samples_are_too_short(voyage, tmp_path):
    file = sabotaged(voyage, tmp_path, **{name: values[:2] for name, values in voyage.channels.items()})
    with pytest.raises(AuditError, match=r"\[too-short\] 2 samples"):
        read_antennas(file, virtual_layout())


def test_gaps_and_holes_are_warnings_at_sea(voyage, tmp_path):
    kept = (voyage.channels["time"] < 900.0) | (voyage.channels["time"] > 960.0)
    holes = {name: values[kept] for name, values in voyage.channels.items()}
    holes["Z_bow"] = np.where(np.arange(kept.sum()) == 300, np.nan, holes["Z_bow"])
    record = read_antennas(sabotaged(voyage, tmp_path, **holes), virtual_layout())
    rules = {finding.rule: finding.severity for finding in record.findings}
    assert rules["gap"] == rules["missing-values"] == "warning"
    assert np.isnan(record.keel[300])


def test_a_channel_of_another_quantity_is_refused(voyage, tmp_path):
    file = voyage.write(tmp_path / "v.csv")
    with pytest.raises(ReadError, match="should be a length"):
        read_antennas(file, virtual_layout(), units={"Z_bow": "deg"})
    (tmp_path / "short.csv").write_text("time,Z_port\n0,1\n1,2\n", encoding="utf-8")
    layout = AntennaLayout(350.0, 51.0, {"Z_bow": Antenna(0.0)}, pitch="Z_port")
    with pytest.raises(ReadError, match="no channel 'Z_bow' -> the file has time"):
        read_antennas(tmp_path / "short.csv", layout)
