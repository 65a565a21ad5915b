"""KCS turning in waves: scale, safety index, drift."""

import pytest

from towtank.datasets import load_table
from towtank.reproduce.paper_kcs_turning import KEY


def test_safety_index_of_all_rows(shown):
    rows = [case for case in shown[KEY] if case.quantity.startswith("safety index")]
    assert len(rows) == 28
    assert {case.verdict for case in rows} == {"reproduced"}
    assert max(abs(case.printed - case.computed) for case in rows) < 0.01


def test_length_of_the_model_is_a_misprint(find):
    case = find(KEY, "length in m")
    assert case.verdict == "reproduced-after-correction"
    assert case.printed == 3.497
    assert case.computed == pytest.approx(230.0 / 65.833)


def test_other_particulars_keep_to_the_scale(shown):
    rows = [case for case in shown[KEY] if case.case.startswith("Table 1") and case.quantity != "length in m"]
    assert len(rows) == 7
    assert {case.verdict for case in rows} == {"reproduced"}


def test_drift_goes_with_short_waves_and_across_long_ones(find):
    assert find(KEY, "waves 0.5 L long", "drift direction").computed == pytest.approx(4.75)
    assert find(KEY, "waves 0.7 L long", "drift direction").computed == pytest.approx(41.4, abs=0.1)
    longest = find(KEY, "waves 1 L long", "drift direction")
    assert longest.computed == pytest.approx(53.0)
    assert longest.verdict == "not-reproducible"


def test_table_is_as_printed():
    frame = load_table("kcs-turning-waves").frame
    assert len(frame) == 28
    missing = frame[
        (frame["wave_direction"] == 270) & (frame["wave_height"] == 0.02) & (frame["wave_length"] == 0.5)
    ]
    assert missing.empty
    assert frame["drift_distance"].max() == 1.98
