"""Sensors of every kind give the same sinkage, trim and heel."""

import math

import numpy as np
import pytest

from towtank.core.errors import AuditError, CampaignError, ReadError
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import read_sinkage

TIME = np.arange(0.05, 10.0, 0.05)
MIDSHIP = 0.006 + 0.001 * np.sin(2.0 * TIME)
TRIM = 0.0008 + 0.0001 * np.cos(3.0 * TIME)
HEEL = 0.0003 * np.sin(5.0 * TIME)
LENGTH = 4.0


def _at(x, y=0.0):
    return 1e3 * (MIDSHIP + TRIM * x + HEEL * y)


def test_two_points_up_positive_and_heave_with_bow_up_trim_agree(write_run):
    two = read_sinkage(
        write_run(time=TIME, a=-_at(1.8), b=-_at(-1.5)),
        SinkageLayout(length=LENGTH, points={"a": (1.8, 0.0), "b": (-1.5, 0.0)}, sinkage_positive="up"),
    )
    heave = read_sinkage(
        write_run(time=TIME, z=_at(0.4), t=-1e3 * TRIM, units={"t": "mm/m"}),
        SinkageLayout(length=LENGTH, heave="z", heave_x=0.4, trim="t", trim_positive="bow-up"),
    )
    for record in (two, heave):
        np.testing.assert_allclose(record.midship, MIDSHIP, atol=2e-9)
        np.testing.assert_allclose(record.trim, TRIM, atol=2e-9)
        np.testing.assert_allclose(record.sinkage_at(LENGTH / 2), MIDSHIP + TRIM * LENGTH / 2, atol=4e-9)
        assert record.heel is None
        with pytest.raises(CampaignError, match="no heel was measured"):
            record.sinkage_at(0.0, 0.3)


@pytest.mark.parametrize(
    ("trim", "unit", "base"),
    [(np.degrees(np.arctan(TRIM)), "deg", None), (TRIM * LENGTH, "m", LENGTH), (1e3 * TRIM, "mm/m", None)],
)
def test_trim_in_degrees_metres_and_slope_agree(write_run, trim, unit, base):
    layout = SinkageLayout(length=LENGTH, heave="z", trim="t", trim_base=base)
    record = read_sinkage(write_run(time=TIME, z=_at(0.0), t=trim, units={"t": unit}), layout)
    # Six decimals of a metre over 4 m.
    np.testing.assert_allclose(record.trim, TRIM, atol=1.3e-7)


def test_four_corners_give_heel_and_their_misfit(write_run):
    points = {"p1": (1.0, -0.2), "p2": (1.0, 0.2), "p3": (-1.0, -0.2), "p4": (-1.0, 0.2)}
    readings = {name: _at(*place) for name, place in points.items()}
    layout = SinkageLayout(length=LENGTH, points=points)
    record = read_sinkage(write_run(time=TIME, **readings), layout)
    np.testing.assert_allclose(record.heel, HEEL, atol=1e-8)
    np.testing.assert_allclose(record.sinkage_at(0.5, 0.1), 1e-3 * _at(0.5, 0.1), atol=1e-8)
    assert record.misfit < 1e-9
    # A sensor 0.4 mm off cannot lie in the plane of the other three: the plane misses each by 0.1 mm.
    bent = read_sinkage(write_run(time=TIME, **{**readings, "p1": readings["p1"] + 0.4}), layout)
    assert bent.misfit == pytest.approx(1e-4, rel=1e-3)


def test_wrong_channels_and_units_are_named(write_run):
    file = write_run(time=TIME, z=_at(0.0), t=TRIM, units={"t": "N"})
    with pytest.raises(ReadError, match=r"no channel 'heave'.*time, z, t"):
        read_sinkage(file, SinkageLayout(length=LENGTH, heave="heave", trim="t"))
    with pytest.raises(ReadError, match="channel t: is in N, a force"):
        read_sinkage(file, SinkageLayout(length=LENGTH, heave="z", trim="t"))
    metres = read_sinkage(file, SinkageLayout(length=LENGTH, heave="z", trim="t"), units={"t": "m/m"})
    np.testing.assert_allclose(metres.trim, TRIM, atol=1e-6)
    with pytest.raises(CampaignError, match="needs the length it is measured over"):
        read_sinkage(file, SinkageLayout(length=LENGTH, heave="z", trim="t"), units={"t": "m"})


def test_an_accepted_fault_is_read_and_kept_as_accepted(write_run):
    layout = SinkageLayout(length=LENGTH, points={"a": (2.0, 0.0), "b": (-2.0, 0.0)})
    file = write_run(time=TIME, a=np.full_like(TIME, 3.0), b=_at(-2.0))
    with pytest.raises(AuditError, match=r"channel a: \[constant-channel\].*--accept constant-channel"):
        read_sinkage(file, layout)
    record = read_sinkage(file, layout, accepted=["constant-channel"])
    assert [f.accepted for f in record.findings if f.rule == "constant-channel"] == [True]
    assert math.isclose(record.sinkage_at(2.0)[0], 3e-3)
