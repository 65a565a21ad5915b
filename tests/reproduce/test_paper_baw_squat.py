"""Quality and bias of squat: what the definitions, the tables and their misprints say."""

import pytest

from towtank.reproduce.paper_baw_squat import KEY


def test_seven_of_eight_printed_qualities_lie_in_their_rounding_and_one_measurement_is_mended(shown):
    qualities = [
        case for case in shown[KEY] if case.case.startswith("Table 6") and case.quantity.startswith("Q of")
    ]
    assert len(qualities) == 8
    (mended,) = [case for case in qualities if case.verdict != "reproduced"]
    assert (mended.case, mended.quantity) == ("Table 6, DTC-C2", "Q of squat at the stern")
    assert mended.verdict == "reproduced-after-correction"
    assert "0.0050 m" in mended.note


def test_the_total_bias_at_the_centre_of_gravity_is_the_only_wrong_sum(shown):
    sums = {case.quantity: case for case in shown[KEY] if case.case == "Table 4, sums"}
    computed = {quantity: case.computed for quantity, case in sums.items()}
    assert computed == {
        "points": 69,
        "BS at bow": -42,
        "BS at stern": 57,
        "BS at centre of gravity": 21,
        "BS of trim": -69,
    }
    wrong = [quantity for quantity, case in sums.items() if case.printed != case.computed]
    assert wrong == ["BS at centre of gravity"]


def test_one_printed_bias_is_impossible_without_a_tie(shown):
    impossible = [case.quantity for case in shown[KEY] if case.computed == "needs a tie"]
    assert impossible == ["A4, bow: -4/5"]


def test_canal_areas_agree_within_one_and_a_half_per_cent(shown):
    canals = [case for case in shown[KEY] if case.quantity.startswith("S of")]
    assert len(canals) == 8
    for case in canals:
        assert case.computed == pytest.approx(case.printed, rel=0.0145)


def test_trim_from_bow_and_stern_is_the_printed_trim(shown):
    trims = [case for case in shown[KEY] if case.quantity.startswith("trim of")]
    assert len(trims) == 4
    assert all(abs(case.computed - case.printed) < 0.0015 for case in trims)


def test_without_propeller_the_bow_sinks_more_and_the_stern_less(find):
    assert find(KEY, "change of bow").computed == pytest.approx(10.7, abs=0.05)
    assert find(KEY, "change of stern").computed == pytest.approx(-3.9, abs=0.05)
    assert find(KEY, "change of trim").computed == pytest.approx(54.2, abs=0.05)
