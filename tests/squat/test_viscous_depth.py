"""Form factor against depth, friction line, step from model to ship."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.squat.viscous_depth import (
    form_factor_in_depth,
    friction_line,
    ship_resistance_coefficient,
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
