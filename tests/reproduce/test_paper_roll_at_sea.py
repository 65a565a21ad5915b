"""Roll at sea: listed decays, how far the paper missed, all five coefficients, the refusal."""

import pytest

from towtank.reproduce.paper_roll_at_sea import KEY, benchmark


def test_peaks_of_the_benchmark_decays(shown):
    cases = [case for case in shown[KEY] if case.quantity.startswith("peak")]
    assert len(cases) == 24
    assert all(abs(case.computed - case.printed) < 0.05 for case in cases)


def test_the_paper_missed_by_up_to_264_percent(shown):
    errors = [case.computed for case in shown[KEY] if "by the paper's method" in case.quantity]
    assert max(errors, key=abs) == pytest.approx(264.0, abs=0.5)


@pytest.mark.parametrize("number", [1, 2])
def test_all_five_coefficients_within_a_percent(shown, number):
    cases = [case for case in shown[KEY] if case.case.startswith(f"case {number} identified")]
    assert [case.quantity for case in cases] == list(benchmark(number))
    assert all(abs(case.computed / case.printed - 1.0) < 0.01 for case in cases)
    assert all("the paper's method found" in case.note for case in cases)


def test_the_published_search_stops_in_a_hollow(shown):
    cases = [case for case in shown[KEY] if "discrete search" in case.case]
    assert len(cases) == 2
    assert all(abs(case.computed / case.printed - 1.0) > 0.1 for case in cases)


def test_nine_parameters_of_one_oscillation_are_refused(find):
    case = find(KEY, "answer")
    assert case.computed == "refused"
    assert "c1 trades with f and we" in case.note
