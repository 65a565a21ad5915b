"""Computations scored against a measurement: by hand, in units, by case, ranked, pooled."""

import numpy as np
import pytest

from towtank.core.errors import ReadError, TowtankError
from towtank.squat.code_scores import CASE_COLUMNS, full_scale_unit, score_tables
from towtank.squat.curve_table import read_curve_table

EFD = "speed [m/s],bow [mm],trim [mm/m]\n0.4,1,0.1\n0.6,2,0.15\n0.8,4,0.2\n"


@pytest.fixture
def table(tmp_path):
    def write(name, text, by="speed", **options):
        path = tmp_path / f"{name}.csv"
        path.write_text(text)
        return read_curve_table(path, by, **options)

    return write


def test_quality_and_bias_by_hand(table):
    """Deviations of 10 % to both sides: Q 0.100, BS 0."""
    scores = score_tables(table("efd", "speed,a\n1,1\n2,2\n"), [table("cfd", "speed,a\n1,1.1\n2,1.8\n")]).scores
    assert tuple(scores.columns) == CASE_COLUMNS
    (row,) = scores.to_dict("records")
    assert row["Q"] == pytest.approx(0.1)
    assert (row["case"], row["quantity"], row["n"], row["BS"], row["unit"]) == ("cfd", "a", 2, 0, "")
    assert (row["bias"], row["max_abs"]) == pytest.approx((-0.05, 0.2))


def test_units_are_those_of_the_measurement(table):
    code = table("code", "speed [kn],bow [m],trim [deg]\n0.5,0.0012,0.006\n2,0.0055,0.012\n")
    scores = score_tables(table("efd", EFD), [code], scale=80.0)
    bow, trim = scores.details.to_dict("records")
    knots = 1852 / 3600
    at = np.interp([0.4, 0.6, 0.8], [0.5 * knots, 2 * knots], [1.2, 5.5])
    assert bow["bias"] == pytest.approx(np.mean(at - [1, 2, 4]))
    assert (bow["unit"], trim["unit"]) == ("mm", "mm/m")
    assert bow["rms_full_scale"] == pytest.approx(80e-3 * bow["rms"])
    assert (bow["unit_full_scale"], trim["unit_full_scale"]) == ("m", "deg")
    slope = 1e3 * np.radians(np.interp([0.4, 0.6, 0.8], [0.5 * knots, 2 * knots], [0.006, 0.012]))
    assert trim["bias"] == pytest.approx(np.mean(slope - [0.1, 0.15, 0.2]), rel=1e-3)


def test_nothing_is_extrapolated(table):
    code = table("code", "speed [m/s],bow [mm]\n0.3,1\n0.7,3\n")
    scores = score_tables(table("efd", EFD), [code])
    (row,) = scores.details.to_dict("records")
    assert row["n"] == 2
    assert row["note"] == "1 measured point(s) outside the computation"
    last = scores.points.iloc[-1]
    assert np.isnan(last["S"])
    assert any(item.rule == "quantity-missing" and "trim" in item.message for item in scores.findings)


def test_signs_of_the_three_errors(table):
    scores = score_tables(table("efd", EFD), [table("code", EFD.replace("0.4,1,", "0.4,1.5,"))])
    first = scores.points.iloc[0]
    assert first["S - D"] == pytest.approx(0.5)
    assert first["(S - D)/D [%]"] == pytest.approx(50.0)
    assert first["(D - S)/D [%]"] == pytest.approx(-50.0)
    bow = scores.details.iloc[0]
    # computed larger once, equal twice: bias up, BS down
    assert (bow["BS"], bow["ties"]) == (-1, 2)
    assert bow["bias"] > 0.0


def test_codes_are_ranked_by_quantity_and_over_one_unit(table):
    efd = table("efd", "speed,bow [mm],stern [mm]\n1,1,2\n2,2,4\n")
    near = table("near", "speed,bow [mm],stern [mm]\n1,1.1,2.1\n2,2.1,4.1\n")
    far = table("far", "speed,bow [mm],stern [mm]\n1,2,2\n2,3,4\n")
    scores = score_tables(efd, [far, near])
    ranks = scores.ranking.set_index(["quantity", "rank"])["code"]
    assert ranks["bow", 1] == "near"
    assert ranks["stern", 1] == "far"
    assert ranks["all [mm]", 1] == "near"
    totals = scores.totals.set_index(["code", "quantity"])
    assert totals.loc[("far", "all"), "n"] == 4
    own = totals.loc[("near", "bow"), "Q"] ** 2 + totals.loc[("near", "stern"), "Q"] ** 2
    assert totals.loc[("near", "all"), "Q"] == pytest.approx(np.sqrt(0.5 * own))


def test_cases_are_scored_apart_and_pooled(table):
    efd = table("efd", "case,speed,a\nC1,1,1\nC1,2,2\nC2,1,10\nC2,2,20\n")
    code = table("code", "case,speed,a\nC2,1,11\nC2,2,22\nC1,1,1\nC1,2,2\n")
    scores = score_tables(efd, [code])
    assert scores.scores["case"].tolist() == ["C1", "C2"]
    assert scores.scores["Q"].tolist() == pytest.approx([0.0, 0.1])
    assert scores.totals.iloc[0]["Q"] == pytest.approx(0.1 / np.sqrt(2))
    both = score_tables(efd, [code, table("other", "case,speed,a\nC1,1,2\nC1,2,4\n")])
    assert both.scores["case"].tolist() == ["code, C1", "code, C2", "other, C1"]
    assert any(item.rule == "case-missing" and "C2" in item.message for item in both.findings)


def test_uncertainties_give_z(table):
    efd = table("efd", "speed,a,a_se\n1,1,0.3\n2,2,0.3\n")
    code = table("code", "speed,a,a_std\n1,1.5,0.4\n2,2,0.4\n")
    scores = score_tables(efd, [code])
    assert scores.points["z"].tolist() == pytest.approx([1.0, 0.0])
    assert scores.details["quantity"].tolist() == ["a"]


def test_suspicions(table):
    efd = table("efd", "speed,a,t\n1,1,0.1\n2,2,0.2\n")
    found = score_tables(efd, [table("code", "speed,a,t\n1,1000,-0.1\n2,2000,-0.2\n")]).findings
    assert {item.rule for item in found} == {"opposite-sign", "unit-suspected"}


@pytest.mark.parametrize(
    ("unit", "factor", "shown"),
    [("mm", 0.05, "m"), ("deg", 1.0, "deg"), ("mm/m", 0.0573, "deg"), ("m/s", 7.071, "m/s")],
)
def test_full_scale_units(unit, factor, shown):
    assert full_scale_unit(unit, 50.0) == (pytest.approx(factor, rel=1e-3), shown)


def test_no_full_scale_for_a_force():
    factor, shown = full_scale_unit("N", 50.0)
    assert (np.isnan(factor), shown) == (True, "")


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("V,bow\n1,2\n", ("there is no column 'speed'", "--by: V, bow")),
        ("speed,bow [mm]\n1,\n2,\n", ("column bow", "not one value is a number")),
        ("speed,bow [mmm]\n1,1\n2,2\n", ("column bow", "unit 'mmm' is unknown")),
        ("speed,bow [mm]\n,1\n2,2\n", ("column speed", "missing in data row 1")),
        ("speed\n1\n2\n", ("no quantity beside 'speed'",)),
        ("speed [m/s],bow\n0.4,1\n0.6,2\n", ("'bow' has no unit here and is in mm in efd.csv", "--unit bow=UNIT")),
        ("speed [m/s],bow [N]\n0.4,1\n0.6,2\n", ("column bow", "is in N and cannot be held against mm")),
        ("speed [m/s],bow [mm]\n2,1\n3,2\n", ("reaches no measured speed", "nothing is extrapolated")),
        ("speed [m/s],bow [mm]\n0.4,1\n0.4,2\n", ("two values at 0.4", "average them first")),
        ("speed [m/s],heave [mm]\n0.4,1\n0.6,2\n", ("share no quantity", "name the columns alike")),
    ],
)
def test_what_cannot_be_scored_is_named(text, parts, table):
    with pytest.raises(TowtankError) as error:
        score_tables(table("efd", EFD), [table("bad", text)])
    for part in (*parts, "bad.csv"):
        if part != "bad.csv" or "efd.csv" not in str(error.value):
            assert part in str(error.value)


def test_two_codes_of_one_name_and_missing_cases(table, tmp_path):
    efd = table("efd", EFD)
    with pytest.raises(TowtankError, match="two computations have the name 'efd'"):
        score_tables(efd, [efd, efd])
    with pytest.raises(TowtankError, match="has no column 'case'"):
        score_tables(table("cased", "case,speed,a\nx,1,1\n"), [table("plain", "speed,a\n1,1\n")])
    with pytest.raises(ReadError, match="file not found"):
        read_curve_table(tmp_path / "nil.csv")
