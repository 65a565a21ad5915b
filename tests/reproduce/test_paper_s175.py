"""S-175: eighteen of nineteen coefficients, errors of turning circles, depth corrections."""

import pytest

from towtank.reproduce.paper_s175 import KEY


def test_eighteen_of_nineteen_agree_and_the_nineteenth_is_a_misprint(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("Table 2")]
    assert len(cases) == 19
    (misprint,) = [case for case in cases if case.verdict != "reproduced"]
    assert (misprint.quantity, misprint.printed, misprint.expected) == ("Nrrr", -0.4220, -0.0422)
    assert misprint.verdict == "reproduced-after-correction"
    assert misprint.computed == pytest.approx(-0.0422, abs=5e-5)


def test_errors_of_four_tables_of_turning_circles(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("Tables 3, 4")]
    assert len(cases) == 12
    assert all(case.tolerance < 0.05 for case in cases)


def test_added_masses_in_shallow_water(find):
    assert find(KEY, "mx' at h/d").computed / 0.0044 == pytest.approx(5.570, abs=1e-3)
    assert find(KEY, "my' at h/d").computed / 0.1299 == pytest.approx(3.211, abs=1e-3)
    assert find(KEY, "JN' at h/d").computed / 0.0077 == pytest.approx(2.886, abs=1e-3)


def test_misprints_of_the_quadratic_terms(find):
    sign, zero = find(KEY, "Yv|v| at"), find(KEY, "Nv|v| in deep")
    assert sign.printed == -sign.expected == 3.91669
    assert zero.printed == -0.00924
    assert zero.computed == pytest.approx(-0.0924, abs=5e-5)
