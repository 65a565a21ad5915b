"""Each fault of a sinkage file by its name, on real and on sabotaged files."""

import numpy as np
import pytest

from towtank.core.errors import AuditError, ReadError
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import read_sinkage

LAYOUT = SinkageLayout(length=3.984, points={"z_VF": (1.992, 0.0), "z_VA": (-1.992, 0.0)}, speed="u")
TIME = np.arange(1, 201) * 0.05
NOISE = np.random.default_rng(3).standard_normal((2, TIME.size)) * 0.1
GOOD = {"time": TIME, "u": np.full_like(TIME, 0.3), "z_VF": 0.9 + NOISE[0], "z_VA": 0.6 + NOISE[1]}


@pytest.mark.parametrize(("run", "moment"), [("C1", True), ("C2", True), ("CW3", False)])
def test_faults_of_the_benchmark_files_are_found(benchmark_run, run, moment):
    found = {finding.rule: finding for finding in read_sinkage(benchmark_run(run), LAYOUT).findings}
    assert ("moment-named-as-angle" in found) == moment
    assert set(found) - {"moment-named-as-angle"} == {"not-utf8", "units-row", "heading-width"}
    assert "latin-1" in found["not-utf8"].message
    assert found["units-row"].place == "row 2"
    assert found["heading-width"].message.startswith("the heading has 1")
    if moment:
        assert "'roll' is in Nm" in found["moment-named-as-angle"].message


def test_a_clean_file_is_told_of_its_units_row_only(write_run):
    assert [finding.rule for finding in read_sinkage(write_run(**GOOD), LAYOUT).findings] == ["units-row"]


def _with(**changed):
    return {**GOOD, **changed}


def _with_gap():
    kept = np.r_[0:80, 120:200]
    return {name: values[kept] for name, values in GOOD.items()}


@pytest.mark.parametrize(
    ("channels", "rule"),
    [
        ({name: values[:2] for name, values in GOOD.items()}, "too-short"),
        (_with(z_VF=np.full_like(TIME, 0.9)), "constant-channel"),
        (_with(z_VF=np.full_like(TIME, np.nan)), "all-missing"),
        (_with(z_VF=np.where(TIME[50] == TIME, np.nan, GOOD["z_VF"])), "missing-values"),
        (_with_gap(), "gap"),
        (_with(time=np.r_[TIME[:100], TIME[:100]]), "time-not-increasing"),
        (_with(z_VF=1e3 * GOOD["z_VF"]), "sinkage-too-large"),
    ],
)
def test_a_sabotaged_file_stops_under_the_name_of_its_fault(write_run, channels, rule):
    with pytest.raises(AuditError, match=rf"run\.dat.*\[{rule}\]"):
        read_sinkage(write_run(**channels), LAYOUT)


@pytest.mark.parametrize("size", [1.0, 1e4])
def test_a_force_is_told_from_a_sinkage_by_its_dimension_not_by_its_size(write_run, size):
    file = write_run(**_with(z_VF=size * GOOD["z_VF"]), units={"z_VF": "N"})
    with pytest.raises(ReadError, match=r"run\.dat, channel z_VF.*is in N, a force, and should be a length"):
        read_sinkage(file, LAYOUT)


def test_a_channel_without_a_unit_is_taken_as_si_and_said(tmp_path):
    file = tmp_path / "bare.csv"
    rows = np.column_stack([TIME, GOOD["u"], 1e-3 * GOOD["z_VF"], 1e-3 * GOOD["z_VA"]])
    np.savetxt(file, rows, delimiter=",", header="time,u,z_VF,z_VA", comments="")
    record = read_sinkage(file, LAYOUT)
    assert {finding.place for finding in record.findings if finding.rule == "no-unit"} == {
        "channel u",
        "channel z_VF",
        "channel z_VA",
    }
    assert record.sinkage_at(1.992).mean() == pytest.approx(0.9e-3, rel=0.05)
