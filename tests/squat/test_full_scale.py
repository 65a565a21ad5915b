"""Squat of a made voyage: tide, density, static position and current are taken out, the truth is left."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError, TowtankError
from towtank.squat.full_scale import reduce_full_scale
from towtank.squat.rtk_antennas import read_antennas
from towtank.squat.squat_curve import SquatCurve
from towtank.squat.static_reference import static_reference
from towtank.squat.steady_squat import reduce_steady
from towtank.squat.tide import TideTable
from towtank.squat.virtual_voyage import (
    BERTH,
    DRAUGHT,
    LENGTH,
    RHO_BERTH,
    VOLUME,
    WATERPLANE_AREA,
    virtual_layout,
    virtual_tide,
    virtual_voyage,
)

VOYAGE = virtual_voyage(step=1.0, noise=0.01)
WATER = {"rho": VOYAGE.rho, "volume": VOLUME, "waterplane_area": WATERPLANE_AREA, "current": VOYAGE.current}


@pytest.fixture(scope="module", params=[True, False], ids=["gyro", "antennas"])
def record(request, tmp_path_factory):
    file = VOYAGE.write(tmp_path_factory.mktemp("voyage") / "voyage.csv")
    return read_antennas(file, virtual_layout(gyro=request.param))


def reduced(record, **changes):
    reference = static_reference(record, virtual_tide(), start=BERTH[0], stop=BERTH[1], rho=RHO_BERTH)
    return reduce_full_scale(record, reference, virtual_tide(), **{**WATER, **changes})


def test_the_truth_is_left(record):
    found = reduced(record).record
    far = 0.5 * LENGTH
    for x in (far, 0.0, -far):
        error = found.sinkage_at(x) - (VOYAGE.sinkage + VOYAGE.trim * x)
        assert abs(error.mean()) < 3e-3
    np.testing.assert_allclose(found.heel, VOYAGE.heel, atol=2e-3)
    np.testing.assert_allclose(found.speed, VOYAGE.speed, atol=1e-6)


def test_forgotten_density_counts_as_squat_and_is_said(record):
    plain = reduced(record, rho=None)
    difference = plain.record.midship - reduced(record).record.midship
    np.testing.assert_allclose(difference, VOYAGE.density, atol=1e-12)
    assert any("no density under way" in note for note in plain.notes)
    assert plain.choices["density"] == "as at rest"


def test_steady_part_is_free_of_the_swell(record):
    found = reduced(record)
    late = (found.record.time > 1200.0) & np.isfinite(found.steady.midship)
    np.testing.assert_allclose(found.steady.midship[late], 0.012 * 81.0, atol=0.012)
    frame = found.frame
    total = frame["sinkage_bow_steady"] + frame["sinkage_bow_unsteady"]
    np.testing.assert_allclose(total[late], frame["sinkage_bow"][late])
    assert set(frame.columns) == set(frame.attrs["units"])


def test_summary_names_the_turn_and_its_uncertainty(record):
    summary = reduced(record).summary.set_index("quantity")
    lateral = summary.loc["largest steady sinkage, lateral"]
    assert lateral["at_time"] == pytest.approx(1500.0, abs=15.0)
    # the mean over a minute takes 1 % from the top of the heel
    assert lateral["value"] == pytest.approx(0.972 + 0.04 * 25.6 * 0.99, abs=0.02)
    assert 0.0 < lateral["u_rss"] < lateral["u_linear"] < 0.15
    corner, along = (
        summary.loc[f"largest steady sinkage, {name}", "value"] for name in ("corner", "longitudinal")
    )
    assert corner > max(along, lateral["value"])
    assert summary.loc["largest density rise", "value"] == pytest.approx(-VOYAGE.density.min())


def test_clearance_of_the_deepest_corner(record):
    found = reduced(record, charted_depth=16.0, draught=DRAUGHT, static_trim=0.0004, u_depth=0.1, u_draught=0.05)
    trim, heel = VOYAGE.trim + 0.0004, VOYAGE.heel
    deepest = VOYAGE.sinkage + VOYAGE.density + np.abs(trim) * 175.0 + np.abs(heel) * 25.6
    expected = 16.0 + virtual_tide().at(found.record.time) - DRAUGHT - deepest
    assert np.median(np.abs(found.clearance.clearance - expected)) < 0.05
    assert found.clearance.uncertainty > np.hypot(0.1, 0.05)
    assert found.summary.set_index("quantity").loc["least clearance", "value"] == found.clearance.clearance.min()
    np.testing.assert_allclose(
        found.depth_froude_number, found.record.speed / np.sqrt(9.80665 * found.water_depth), rtol=1e-12
    )


def test_reductions_of_model_tests_take_the_voyage(record):
    found = reduced(record).record
    runs = [
        reduce_steady(found, rule="key-times", start=start, stop=start + 240.0, depth=20.0, run=str(start))
        for start in (1200.0, 1680.0, 2040.0)
    ]
    curve = SquatCurve.from_runs(runs, draught=DRAUGHT, name="voyage")
    np.testing.assert_allclose(curve.points["sinkage_midship"], 0.972, atol=0.02)


def test_what_cannot_be_reduced_is_named(record):
    with pytest.raises(FitError, match="needs the ship's volume and waterplane"):
        reduced(record, volume=None)
    with pytest.raises(TowtankError, match=r"1.02 kg/m3 is no density"):
        reduced(record, rho=1.02)
    with pytest.raises(TowtankError, match=r"a water depth of -.* m is impossible"):
        reduced(record, charted_depth=-30.0)
    with pytest.raises(FitError, match=r"m/s at .* s is not below the critical speed of .* m of water"):
        reduced(record, charted_depth=5.0)
    with pytest.raises(FitError, match=r"table of the current: time .* outside"):
        reduced(record, current=TideTable([0.0, 60.0], [0.0, 0.1], quantity="current"))
    reference, short = _reference(record), TideTable([0.0, 1000.0], [2.5, 2.1])
    with pytest.raises(FitError, match="outside its 0 to 1000 s"):
        reduce_full_scale(record, reference, short)
    silent = replace(record, keel=np.full_like(record.keel, np.nan))
    with pytest.raises(FitError, match="no sample has altitude and attitude"):
        reduce_full_scale(silent, reference, virtual_tide())


def _reference(record):
    return static_reference(record, virtual_tide(), start=BERTH[0], stop=BERTH[1])


def test_a_short_record_has_no_steady_part(record):
    cut = replace(
        record,
        time=record.time[:40],
        keel=record.keel[:40],
        trim=record.trim[:40],
        heel=record.heel[:40],
        speed=record.speed[:40],
    )
    with pytest.raises(FitError, match="a record of 39 s holds no mean over 60 s"):
        reduce_full_scale(cut, _reference(record), virtual_tide())


def test_a_gap_leaves_no_steady_value_beside_it(record):
    kept = (record.time < 1800.0) | (record.time > 1900.0)
    cut = replace(
        record,
        time=record.time[kept],
        keel=record.keel[kept],
        trim=record.trim[kept],
        heel=record.heel[kept],
        speed=record.speed[kept],
    )
    found = reduce_full_scale(cut, _reference(record), virtual_tide())
    beside = np.abs(cut.time - 1850.0) < 79.0
    assert np.isnan(found.steady.midship[beside]).all()
    assert np.isfinite(found.summary["value"]).all()
