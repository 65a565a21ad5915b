"""Nine container ships at full scale."""

import pytest

from towtank.reproduce.paper_container_ships_at_sea import KEY, block_coefficient


def test_block_coefficients_are_within_two_hundredths(shown):
    coefficients = [case for case in shown[KEY] if case.quantity == "block coefficient as printed"]
    assert len(coefficients) == 9
    assert max(abs(case.printed - case.computed) for case in coefficients) < 0.02
    beyond = {case.case for case in coefficients if case.verdict != "reproduced"}
    assert beyond == {f"Table 1, ULCS{number}" for number in (2, 4, 5, 6)}


def test_block_coefficient_of_a_box_is_one():
    assert block_coefficient(1025.0 * 6.0, 1025.0, 3.0, 2.0, 1.0) == pytest.approx(1.0)


def test_three_ships_are_tender(find):
    assert find(KEY, "corrected metacentric height").computed == "ULCS1, ULCS3, ULCS8"


def test_the_printed_accuracy_is_a_linear_sum(shown):
    sums = [case for case in shown[KEY] if case.quantity == "linear sum of the sensors in m"]
    assert [case.computed for case in sums] == pytest.approx([0.12, 0.14, 0.13, 0.15], abs=1e-3)
    assert all(case.verdict == "reproduced" for case in sums)
