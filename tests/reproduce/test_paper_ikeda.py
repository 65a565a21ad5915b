"""Simplified Ikeda components: 44 of 45 numbers as listed, one misprint."""

from towtank.decay.ikeda import ikeda_damping
from towtank.reproduce.paper_ikeda import KEY, sample_hull


def test_one_number_of_forty_five_is_a_misprint(shown):
    (misprint,) = [case for case in shown[KEY] if case.verdict != "reproduced"]
    assert misprint.verdict == "reproduced-after-correction"
    assert (misprint.printed, misprint.expected) == (5.62220e-03, 5.62218e-03)
    assert len(shown[KEY]) == 45


def test_tolerances_are_half_a_digit(shown):
    assert all(5e-7 <= case.tolerance / case.printed <= 5e-6 for case in shown[KEY])


def test_sample_hull_is_inside_the_regressions():
    hull = sample_hull()
    assert ikeda_damping(hull, 0.1, 0.6 * hull.frequency_unit).within_limits
