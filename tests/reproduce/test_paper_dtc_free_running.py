"""DTC free-running tests: repeatability and scale."""

import pytest

from towtank.reproduce.paper_dtc_free_running import KEY


def test_everything_printed_is_reproduced(shown):
    assert len(shown[KEY]) == 20
    assert {case.verdict for case in shown[KEY]} == {"reproduced"}


@pytest.mark.parametrize(
    ("quantity", "value"),
    [
        ("uncertainty of the first overshoot", 0.372),
        ("uncertainty of the time of the first overshoot", 1.738),
        ("uncertainty of the second overshoot", 0.497),
        ("uncertainty of the time of the second overshoot", 2.856),
        ("relative of the second overshoot", 4.40),
    ],
)
def test_student_intervals_of_five_tests(find, quantity, value):
    assert find(KEY, quantity).computed == pytest.approx(value, abs=5e-3)


def test_measured_particulars_of_the_model_say_so(find):
    assert find(KEY, "pitch inertia").note == "measured on the model"
    assert find(KEY, "yaw inertia").note == ""
