"""Form factor against depth, friction line, step from model to ship."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.squat.viscous_depth import (
    deep_viscous_resistance,
    form_factor_in_depth,
    friction_line,
    gross_watanabe_form_factor,
    ship_resistance_coefficient,
    townsin_roughness,
    viscous_ratio,
)


def test_form_factors_of_the_ferry():
    assert form_factor_in_depth(1.22, 6.0, 13.1) == pytest.approx(1.392, abs=5e-4)
    assert form_factor_in_depth(1.22, 6.0, 22.5) == pytest.approx(1.285, abs=5e-4)
    assert viscous_ratio(6.0, 13.1) == pytest.approx(1.1409, abs=5e-5)


def test_friction_line_at_round_numbers():
    np.testing.assert_allclose(friction_line([1e7, 1e9]), [0.075 / 25, 0.075 / 49], rtol=1e-14)


def test_form_factor_takes_more_off_the_model():
    froude_way = ship_resistance_coefficient(4e-3, 1.37e7, 1.07e9)
    hughes_way = ship_resistance_coefficient(4e-3, 1.37e7, 1.07e9, form_factor=1.22)
    assert froude_way == pytest.approx(4e-3 - (0.00284 - 0.00152), abs=1e-5)
    assert 4e-3 - hughes_way == pytest.approx(1.22 * (4e-3 - froude_way))
    assert ship_resistance_coefficient(4e-3, 1e7, 1e7, 1.2) == 4e-3


@pytest.mark.parametrize(("draught", "depth", "said"), [(6.0, 12.0, "T/h = 0.500"), (6.0, 5.0, "no water")])
def test_too_shallow(draught, depth, said):
    with pytest.raises(TowtankError, match=said):
        viscous_ratio(draught, depth)


def test_form_factor_of_a_tanker_and_of_a_slender_hull():
    assert gross_watanabe_form_factor(320.0, 58.0, 20.8, 0.81) == pytest.approx(
        1.017 + 16.2 / 30.44 / 1.670, abs=1e-3
    )
    assert gross_watanabe_form_factor(320.0, 30.0, 20.8, 0.5) < 1.1


def test_roughness_allowance_by_hand():
    # 150 micrometres on 150 m: the cube root is 0.01; at Re 1e9 the second term is 0.01 too
    assert townsin_roughness(150.0, 1e9) == pytest.approx(0.000125)
    assert townsin_roughness(150.0, 1e9, 8 * 150e-6) == pytest.approx(0.00044 + 0.000125)
    with pytest.raises(TowtankError, match="a roughness of -1 m is impossible"):
        townsin_roughness(150.0, 1e9, -1.0)


def test_viscous_resistance_is_the_sum_of_both_coefficients():
    ship = {"length": 150.0, "wetted_surface": 4000.0, "form_factor": 1.22}
    speed = 1e9 * 1.19e-6 / 150.0
    expected = 0.5 * 1025.0 * speed**2 * 4000.0 * (1.22 * 0.075 / 49.0 + 0.000125)
    assert deep_viscous_resistance(speed, **ship) == pytest.approx(expected)
    with pytest.raises(TowtankError, match="a speed is not positive"):
        deep_viscous_resistance([1.0, 0.0], **ship)
