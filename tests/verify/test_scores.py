"""Scores against the numbers of the papers that define and use them."""

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.datasets import load_set, load_table
from towtank.verify import (
    at_measured_points,
    bias_is_possible,
    normalised_rms,
    quality_and_bias,
    relative_errors,
    rms,
    score_table,
    z_score,
)

values = st.lists(st.floats(0.1, 10.0), min_size=1, max_size=12)


def test_three_sign_conventions_on_the_static_drift_of_dtmb_5512():
    table = load_table("dtmb5512-drift-errors").frame.set_index("source")
    for force in ("X", "Y", "N"):
        errors = relative_errors([table.loc["CFD", force]], [table.loc["EFD", force]])
        assert errors.s_minus_d[0] == pytest.approx(table.loc["CFD", f"{force}_error"], abs=0.05)
        assert errors.d_minus_s[0] == -errors.s_minus_d[0]
        assert errors.absolute[0] == abs(errors.s_minus_d[0])
        assert errors.notes == ()


def test_absolute_errors_of_the_oblique_towing_derivatives_are_all_reproduced():
    table = load_table("dtmb5512-drift-comparison").frame
    errors = relative_errors(table["CFD"], table["EFD"])
    np.testing.assert_allclose(errors.absolute, table["error"], atol=0.011)


def test_a_negative_force_of_smaller_magnitude_is_underpredicted():
    assert relative_errors([-0.9], [-1.0]).s_minus_d[0] == pytest.approx(-10.0)


def test_no_relative_error_near_a_zero_measurement():
    errors = relative_errors([1.0, 0.1, 2.0], [0.0, 1e-12, 1.0])
    assert np.isnan(errors.s_minus_d[:2]).all()
    assert np.isnan(errors.absolute[:2]).all()
    assert errors.absolute[2] == pytest.approx(100.0)
    assert errors.notes == ("pairs 1, 2 left out: the measurement is near zero",)


def test_the_user_may_say_what_is_near_zero():
    errors = relative_errors([0.02, 1.0], [0.01, 0.5], near_zero=0.05)
    assert np.isnan(errors.s_minus_d[0])
    assert errors.s_minus_d[1] == pytest.approx(100.0)


def test_missing_values_are_named():
    errors = relative_errors([1.0, np.nan], [1.0, 1.0])
    assert errors.notes == ("pair 2 left out: a value is missing",)


def test_pairs_must_have_one_length():
    with pytest.raises(TowtankError, match="cannot be paired"):
        relative_errors([1.0, 2.0], [1.0])


def test_quality_and_bias_of_two_deviations_of_opposite_sign():
    score = quality_and_bias([1.1, 1.8], [1.0, 2.0])
    assert score.quality == pytest.approx(0.100)
    assert score.bias_text == "0/2"
    assert not score.systematic


def test_uniform_overprediction_is_systematic():
    data = np.linspace(0.002, 0.02, 8)
    score = quality_and_bias(1.09 * data, data)
    assert score.quality == pytest.approx(0.09)
    assert score.bias_text == "-8/8"
    assert score.systematic


def test_ties_count_but_have_no_sign():
    score = quality_and_bias([1.0, 2.0, 2.9], [1.0, 2.0, 3.0])
    assert (score.bias, score.n, score.ties) == (1, 3, 2)
    assert bias_is_possible(score.bias, score.n, score.ties)


@given(values, st.randoms(use_true_random=False))
def test_bias_of_any_pairs_is_a_possible_bias(data, random):
    simulation = [value * random.choice([0.9, 1.0, 1.1]) for value in data]
    score = quality_and_bias(simulation, data)
    assert bias_is_possible(score.bias, score.n, score.ties)
    assert quality_and_bias(data, simulation).bias == -score.bias


def test_parity_tells_the_printed_bias_that_needs_a_tie():
    table = load_table("baw-squat-scores").frame.set_index("case").drop("sum")
    impossible = [
        (case, column)
        for case, row in table.iterrows()
        for column in ("BS_bow", "BS_stern", "BS_cog", "BS_trim")
        if not bias_is_possible(int(row[column]), int(row["n"]))
    ]
    assert impossible == [("A4", "BS_bow")]
    assert bias_is_possible(-4, 5, ties=1)
    assert not bias_is_possible(2, 8, ties=7)
    assert not bias_is_possible(0, 1, ties=2)


@pytest.mark.parametrize("corrected", [True, False])
def test_sums_of_the_printed_biases(corrected):
    frame = load_table("baw-squat-scores", corrected=corrected).frame.set_index("case")
    columns = ["n", "BS_bow", "BS_stern", "BS_cog", "BS_trim"]
    differs = frame.drop("sum")[columns].sum() != frame.loc["sum", columns]
    assert list(differs[differs].index) == ([] if corrected else ["BS_cog"])


@pytest.mark.parametrize("corrected", [True, False])
def test_printed_quality_of_the_dtc_squat_lies_within_the_rounding(corrected):
    outside = []
    for row in load_table("baw-dtc-squat", corrected=corrected).frame.itertuples():
        # squat is printed to 0.1 mm, trim to 0.0001 deg: half a unit each way
        half = 0.00005
        qualities = [
            quality_and_bias([row.CFD + i * half], [row.EFD + j * half]).quality for i in (-1, 1) for j in (-1, 1)
        ]
        if not min(qualities) - 5e-4 <= row.Q <= max(qualities) + 5e-4:
            outside.append((row.case, row.quantity))
    assert outside == ([] if corrected else [("DTC-C2", "squat at the stern")])


def test_pairs_without_quality_still_count_in_the_absolute_deviation():
    score = quality_and_bias([0.1, 1.1], [0.0, 1.0])
    assert (score.n, score.quality) == (1, pytest.approx(0.1))
    assert score.rms == pytest.approx(0.1)
    assert score.mean_error == pytest.approx(0.1)
    assert score.notes == ("pair 1 left out: the measurement is near zero",)


def test_mean_and_scatter_are_apart():
    score = quality_and_bias([1.1, 1.3], [1.0, 1.0])
    assert score.mean_error == pytest.approx(0.2)
    assert score.scatter == pytest.approx(math.sqrt(0.02))


def test_score_of_nothing_is_nan():
    score = quality_and_bias([], [])
    assert math.isnan(score.quality)
    assert (score.bias, score.n, score.systematic) == (0, 0, False)


def test_computation_is_interpolated_to_measured_speeds_but_not_beyond():
    at = at_measured_points([0.5, 1.5, 2.5, 4.0], [3.0, 1.0, 2.0], [30.0, 10.0, 20.0])
    assert np.isnan(at[[0, 3]]).all()
    assert at[1:3].tolist() == [15.0, 25.0]
    assert quality_and_bias(at, [1.0, 15.0, 25.0, 1.0]).n == 2


def test_two_computed_values_at_one_speed_are_refused():
    with pytest.raises(TowtankError, match="two values at 1"):
        at_measured_points([1.0], [1.0, 1.0, 2.0], [1.0, 2.0, 3.0])


def test_z_score_of_independent_and_of_shared_uncertainty():
    assert z_score(1.3, 1.0, 0.3, 0.4) == pytest.approx(0.6)
    assert z_score(1.3, 1.0, 0.3, 0.4, covariance=0.08) == pytest.approx(0.3 / 0.3)


def test_z_score_needs_an_uncertainty():
    assert np.isnan(z_score(1.3, 1.0, None, None))
    assert np.isnan(z_score(1.3, 1.0, 0.0, 0.0))
    assert np.isnan(z_score(1.3, 1.0, 0.1, 0.1, covariance=0.01))
    assert z_score([1.3], [1.0], [np.nan], [0.1])[0] == pytest.approx(3.0)


@given(values, st.floats(0.01, 10.0))
def test_scores_do_not_depend_on_the_unit(data, unit):
    d = np.array(data)
    s = d * np.linspace(0.8, 1.3, len(d))
    assert quality_and_bias(s * unit, d * unit).quality == pytest.approx(quality_and_bias(s, d).quality)
    assert normalised_rms(s * unit, d * unit, by="rms") == pytest.approx(normalised_rms(s, d, by="rms"))


def test_root_mean_square_and_its_three_normalisations():
    s, d = [1.0, 3.0, 6.0, np.nan], [1.0, 2.0, 5.0, 9.0]
    assert rms([3.0, 4.0]) == pytest.approx(math.sqrt(12.5))
    expected = math.sqrt(2 / 3)
    assert normalised_rms(s, d) == pytest.approx(expected / 4)
    assert normalised_rms(s, d, by="mean") == pytest.approx(expected / (8 / 3))
    assert normalised_rms(s, d, by="rms") == pytest.approx(expected / math.sqrt(10))
    assert math.isnan(normalised_rms([1.0, 2.0], [3.0, 3.0]))
    assert math.isnan(normalised_rms([np.nan], [3.0]))


def test_table_of_two_derivative_sets():
    cfd, efd = load_set("dtmb5512-drift-fn0.280-cfd"), load_set("dtmb5512-drift-fn0.280-efd")
    frame = score_table(cfd.params, efd.params, sd_a=cfd.bse, sd_b=efd.bse).set_index("name")
    assert frame.loc["Yv", "absolute"] == pytest.approx(9.76, abs=0.01)
    assert frame.loc["Nvvv", "difference"] == pytest.approx(0.0308)
    assert frame["z"].isna().all()
    score = quality_and_bias(frame["a"], frame["b"])
    assert score.n == 5
    assert score.bias_text == "-3/5"


def test_table_names_what_only_one_side_has_and_what_is_zero():
    frame = score_table({"Yv": -0.3, "Yp": 0.1, "Yr": 0.05}, {"Yp": 0.0, "Yv": -0.25, "Nv": -0.1})
    assert frame["name"].tolist() == ["Yp", "Yv", "Nv", "Yr"]
    assert frame["note"].tolist() == ["b is near zero", "", "only in b", "only in a"]
    assert frame["s_minus_d"].isna().tolist() == [True, False, True, True]


def test_table_weighs_the_difference_by_both_uncertainties():
    a, b = {"Yv": -0.3, "Nv": -0.1}, {"Yv": -0.2, "Nv": -0.2}
    frame = score_table(a, b, sd_a={"Yv": 0.03}, sd_b=pd.Series({"Yv": 0.04, "Nv": 0.05}))
    assert frame["z"].tolist() == pytest.approx([-2.0, 2.0])
    assert frame["note"].tolist() == ["", "z without the unknown uncertainty of a"]
    shared = score_table(a, b, sd_a={"Yv": 0.03}, sd_b={"Yv": 0.04}, covariance={"Yv": 0.0008})
    assert shared.loc[0, "z"] == pytest.approx(-0.1 / 0.03)
