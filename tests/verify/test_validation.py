"""Comparison error, validation uncertainty, verdict."""

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.verify.validation import ERROR_FORMS, VALIDATION_COLUMNS, validate_table, validate_value


def test_kvlcc2_in_shallow_water():
    # KVLCC2 by SHIPFLOW (MASHCON 2019): S = 3.093 N against 3.620 N is not validated within 0.08 N
    one = validate_value(3.093, 3.620, U_D=0.0, U_SN=0.08, unit="N")
    assert one.error == pytest.approx(-0.527)
    assert one.errors["(S-D)/D [%]"] == pytest.approx(-14.558, abs=1e-3)
    assert one.verdict == "not validated"
    assert one.model_error == pytest.approx((-0.607, -0.447))
    assert one.level == pytest.approx(0.527)


def test_the_uncertainties_add_up_as_squares_and_decide():
    one = validate_value(10.5, 10.0, U_D=0.3, U_SN=0.4, U_input=1.2, quantity="X", unit="N")
    assert pytest.approx(1.3) == one.U_V
    assert one.verdict == "validated"
    assert one.level == one.U_V
    assert one.z == pytest.approx(0.5 / 0.65)
    assert one.sentence == "validated at level U_V = 1.3 N (13 % of D)"


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(0.0, 10.0), st.floats(0.0, 10.0))
def test_the_four_forms_are_one_error(s, d, u_d, u_sn):
    one = validate_value(s, d, U_D=u_d, U_SN=u_sn)
    assert tuple(one.errors) == ERROR_FORMS
    assert one.errors["S-D"] == -one.errors["D-S"] == one.error
    if d:
        assert one.errors["(S-D)/D [%]"] == -one.errors["(D-S)/D [%]"]
        assert one.errors["(S-D)/D [%]"] == pytest.approx(100.0 * (s - d) / d)
    # S and D change places: the same verdict
    assert validate_value(d, s, U_D=u_sn, U_SN=u_d).verdict == one.verdict
    low, high = one.model_error
    if one.verdict == "validated":
        assert low <= 0.0 <= high


@given(st.floats(0.1, 10.0), st.floats(1e-3, 1e3))
def test_the_verdict_does_not_depend_on_the_unit(error, scale):
    first = validate_value(5.0 + error, 5.0, U_D=1.0, U_SN=2.0)
    second = validate_value(scale * (5.0 + error), scale * 5.0, U_D=scale, U_SN=2.0 * scale)
    assert first.z == pytest.approx(second.z, rel=1e-6)


def test_what_is_shared_makes_the_uncertainty_smaller():
    alone = validate_value(1.0, 1.2, U_D=0.2, U_SN=0.0, U_input=0.2)
    shared = validate_value(1.0, 1.2, U_D=0.2, U_SN=0.0, U_input=0.2, covariance=0.0075)
    assert alone.verdict == "validated"
    assert pytest.approx(math.sqrt(0.08 - 8.0 * 0.0075)) == shared.U_V
    assert shared.verdict == "not validated"
    fully = validate_value(1.0, 1.2, U_D=0.2, U_SN=0.0, U_input=0.2, covariance=0.01)
    assert fully.U_V == 0.0


def test_an_unknown_part_gives_no_verdict_and_says_so():
    one = validate_value(1.0, 1.2, U_SN=0.1)
    assert one.verdict == "not judged"
    assert math.isnan(one.U_V)
    assert math.isnan(one.level)
    assert one.sentence == "not judged: U_D is unknown"


def test_zero_reference_and_zero_uncertainty_are_said():
    one = validate_value(0.1, 0.0, U_D=0.1, U_SN=0.1)
    assert math.isnan(one.errors["(S-D)/D [%]"])
    assert one.verdict == "validated"
    assert one.notes == ("D is zero: no error in per cent",)
    exact = validate_value(1.0, 1.0, U_D=0.0, U_SN=0.0)
    assert exact.notes == ("all uncertainties are zero",)
    assert exact.verdict == "validated"
    assert math.isnan(exact.z)


def test_the_required_uncertainty_is_held_against_the_level():
    good = validate_value(10.1, 10.0, U_D=0.3, U_SN=0.4, required=1.0)
    assert good.sentence.endswith("within the required 1")
    coarse = validate_value(10.1, 10.0, U_D=3.0, U_SN=4.0, required=1.0)
    assert coarse.verdict == "validated"
    assert coarse.sentence.endswith("beyond the required 1")


@pytest.mark.parametrize(
    ("values", "more", "message"),
    [
        ((math.nan, 1.0), {}, "S is no number"),
        ((1.0, math.inf), {}, "D is no number"),
        ((1.0, 1.0), {"U_D": -0.1}, r"quantity X: U_D is negative \(-0.1\)"),
        ((1.0, 1.0), {"required": -1.0}, "the required uncertainty is negative"),
        ((1.0, 1.0), {"coverage": 0.0}, "coverage factor 0 is not positive"),
        ((1.0, 1.0), {"U_D": 0.1, "U_SN": 0.1, "covariance": 1.0}, "covariance 1 is larger"),
    ],
)
def test_bad_values_are_named(values, more, message):
    with pytest.raises(TowtankError, match=message):
        validate_value(*values, **more, quantity="X")


def table(rows, *columns):
    return pd.DataFrame(rows, columns=["quantity", "value", *columns])


def test_a_table_has_a_row_for_each_shared_quantity():
    simulation = table(
        [("X", 1.0, 0.1, 0.2), ("N", 2.0, 0.1, 0.0), ("K", 1.0, 0.1, 0.0)], "uncertainty", "input_uncertainty"
    )
    data = table([("N", 2.05, 0.1), ("X", 1.5, 0.1), ("Y", 3.0, 0.1)], "uncertainty")
    frame = validate_table(simulation, data)
    assert tuple(frame.columns) == VALIDATION_COLUMNS
    assert frame["quantity"].tolist() == ["N", "X"]
    assert frame["verdict"].tolist() == ["validated", "not validated"]
    assert frame["U_V"].tolist() == pytest.approx([math.sqrt(0.02), math.sqrt(0.06)])
    assert frame.attrs["only_simulation"] == ["K"]
    assert frame.attrs["only_data"] == ["Y"]
    assert set(frame.attrs["sentences"]) == {"N", "X"}


def test_covariance_and_requirement_by_quantity():
    simulation, data = table([("X", 1.0, 0.2)], "uncertainty"), table([("X", 1.2, 0.2)], "uncertainty")
    frame = validate_table(simulation, data, covariance={"X": 0.0075}, required={"X": 0.1})
    assert frame["U_V"].iloc[0] == pytest.approx(math.sqrt(0.02))
    assert "beyond the required 0.1" in frame.attrs["sentences"]["X"]


def test_a_missing_column_is_unknown_not_zero():
    frame = validate_table(table([("X", 1.0)]), table([("X", 1.2, 0.1)], "uncertainty"))
    assert frame["verdict"].tolist() == ["not judged"]
    assert np.isnan(frame["U_SN"].iloc[0])
    assert frame["note"].iloc[0] == "U_SN is unknown"


def test_tables_that_do_not_fit_are_named():
    good = table([("X", 1.0, 0.1, "N")], "uncertainty", "unit")
    with pytest.raises(TowtankError, match="share no quantity: X against Y"):
        validate_table(good, table([("Y", 1.0)]))
    with pytest.raises(TowtankError, match="quantity X: simulation in 'N', data in 'kN'"):
        validate_table(good, table([("X", 1.0, 0.1, "kN")], "uncertainty", "unit"))
    with pytest.raises(TowtankError, match="the data names X twice"):
        validate_table(good, table([("X", 1.0), ("X", 2.0)]))
    with pytest.raises(TowtankError, match="the table of the simulation has no column 'quantity'"):
        validate_table(good.rename(columns={"quantity": "name"}), good)
