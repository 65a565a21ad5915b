"""KCS in waves: changes of the sway derivatives and their scaling."""

import pytest

from towtank.reproduce.paper_kcs_waves import KEY


def test_five_wave_conditions_and_calm_water(shown):
    levers = [case.computed for case in shown[KEY] if case.quantity.startswith("lever")]
    assert levers == pytest.approx([0.568, 0.510, 0.418, 0.401, 0.410, 0.272], abs=5e-4)


def test_head_waves_raise_both_derivatives_and_beam_waves_only_one(find):
    assert find(KEY, "change of Yv", "beam waves").computed == pytest.approx(77.7, abs=0.05)
    assert find(KEY, "change of Nv", "beam waves").computed == pytest.approx(-15.0, abs=0.05)
    assert find(KEY, "change of Nv", "head waves of 1 L").computed == pytest.approx(13.1, abs=0.05)


def test_mmg_form_is_larger_by_length_over_draught(find):
    assert find(KEY, "Yv in calm water").computed == pytest.approx(-8.931e-3 * 3.49 / 0.16388)
