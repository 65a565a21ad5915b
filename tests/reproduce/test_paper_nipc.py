"""Polynomial chaos for DTC in head waves."""

import pytest

KEY = "dtc-chaos"


@pytest.mark.parametrize("output", ["heave", "pitch", "X"])
def test_monte_carlo_has_every_printed_digit(find, output):
    for quantity in ("expected value", "standard deviation"):
        case = find(KEY, quantity, f"Monte Carlo, {output}")
        assert case.computed == case.printed


@pytest.mark.parametrize(("output", "sd"), [("heave", 0.005), ("pitch", 0.04), ("X", 0.005)])
def test_polynomial_chaos_is_close_to_the_print(find, output, sd):
    # the sd of pitch is printed with two digits
    where = f"polynomial chaos of order 1, {output}"
    mean, spread = find(KEY, "expected value", where), find(KEY, "standard deviation", where)
    assert mean.computed == pytest.approx(mean.printed, rel=1.4e-3)
    assert spread.computed == pytest.approx(spread.printed, rel=sd)


def test_the_error_of_pitch_is_a_misprint(find):
    case = find(KEY, "size of the error", "polynomial chaos of order 1, pitch")
    assert (case.printed, case.expected) == (5.826, 4.826)
    assert case.verdict == "reproduced-after-correction"
    assert case.computed == pytest.approx(4.80, abs=0.01)


def test_error_levels_are_found_from_twelve_samples_on(shown):
    levels = [case for case in shown[KEY] if "samples, order 2" in case.case]
    assert len(levels) == 15
    missed = [(case.case, case.quantity) for case in levels if case.verdict != "reproduced"]
    assert all("6 samples" in case and "sd by regression" in quantity for case, quantity in missed)
