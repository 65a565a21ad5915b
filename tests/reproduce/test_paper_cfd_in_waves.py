"""DTC in head waves by CFD."""

import pytest

KEY = "dtc-cfd-waves"


def test_the_total_resistance_agrees_and_the_added_one_does_not(find):
    total = find(KEY, "(S-D)/D of the total resistance", "CW3")
    added = find(KEY, "(S-D)/D of the added resistance", "CW3")
    assert total.computed == pytest.approx(4.6, abs=0.05)
    assert added.computed == pytest.approx(57.2, abs=0.1)


@pytest.mark.parametrize(("test", "nominal"), [("CW2", 1.78), ("CW3", 3.756)])
def test_the_coefficient_needs_the_measured_amplitude(find, test, nominal):
    case = find(KEY, "coefficient with the amplitude of half the wave height", test)
    assert case.computed == pytest.approx(nominal, abs=0.005)
    assert case.verdict == "not-reproducible"
    assert "35.8 mm instead of the nominal" in case.note
    needed = find(KEY, "wave amplitude in mm that the printed coefficient needs", test)
    assert needed.verdict == "reproduced"


def test_the_measured_amplitude_gives_the_print(find):
    assert find(KEY, "coefficient with the amplitude of the wave probe", "CW5").verdict == "reproduced"


def test_frequencies_are_in_radians(shown):
    frequencies = [case for case in shown[KEY] if case.quantity.startswith("frequency")]
    assert len(frequencies) == 24
    assert sum(case.verdict == "reproduced" for case in frequencies) == 23


def test_four_tables_of_harmonics_are_consistent_but_for_the_third_harmonic(shown):
    heights = [case for case in shown[KEY] if case.quantity.startswith("crest to trough")]
    assert len(heights) == 24
    assert all(case.computed == pytest.approx(case.printed, rel=0.045) for case in heights)
    assert all("third harmonic" in case.note for case in heights if case.verdict != "reproduced")
