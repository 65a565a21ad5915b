"""Three grids: a known convergence, and each behaviour."""

import pytest

from towtank.reproduce.grid_triplet import GridTriplet


def second_order(refinement):
    """1 + 0.01 h^2 on h = 1, r, r^2."""
    return GridTriplet(*(1.0 + 0.01 * (refinement**n) ** 2 for n in range(3)))


@pytest.mark.parametrize("refinement", [1.4, 2.0])
def test_order_of_a_second_order_scheme(refinement):
    grids = second_order(refinement)
    assert grids.order(refinement) == pytest.approx(2.0)
    assert grids.ratio == pytest.approx(refinement**-2)
    assert grids.behaviour == "monotonic"


def test_index_is_the_safety_factor_times_the_error_of_the_fine_grid():
    assert second_order(2.0).convergence_index(2.0) == pytest.approx(1.25 * 0.01)
    assert second_order(2.0).convergence_index(2.0, factor=3.0) == pytest.approx(3 * 0.01)


@pytest.mark.parametrize(
    ("values", "behaviour"),
    [((1.0, 1.1, 1.3), "monotonic"), ((1.0, 1.1, 0.7), "oscillatory"), ((1.0, 1.3, 1.4), "divergent")],
)
def test_behaviour(values, behaviour):
    assert GridTriplet(*values).behaviour == behaviour


def test_published_case_of_celik_et_al():
    """NASA's grid convergence tutorial: pressure recovery on three grids, ratio 2."""
    grids = GridTriplet(0.97050, 0.96854, 0.96178)
    assert grids.order(2.0) == pytest.approx(1.786170, abs=1e-6)
    assert 100 * grids.convergence_index(2.0) / 0.97050 == pytest.approx(0.103083, abs=1e-6)
