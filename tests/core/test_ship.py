import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core import Ship
from towtank.core.errors import TowtankError


@given(scale=st.floats(0.5, 200), rho=st.sampled_from([998.0, 1000.0, 1025.0]))
def test_scaling_there_and_back(scale, rho):
    full = Ship("s", L=230, B=32.2, T=10.8, volume=52030, xG=-3.4, kzz=57.5, mass=5.3e7, depth=16, KG=13, GM=0.6)
    model = full.at_scale(scale, rho=rho)
    back = model.at_scale(1.0, rho=1025.0)
    for item in ("L", "B", "T", "volume", "xG", "kzz", "mass", "depth", "KG", "GM", "yaw_inertia"):
        assert getattr(back, item) == pytest.approx(getattr(full, item), rel=1e-12)
    assert model.depth_ratio == pytest.approx(full.depth_ratio)
    assert model.block_coefficient == pytest.approx(full.block_coefficient)


def test_kcs_model_of_the_depth_study():
    model = Ship("KCS", L=230, B=32.2, T=10.8, volume=52030).at_scale(75.5)
    assert pytest.approx(3.0464, abs=5e-5) == model.L
    assert pytest.approx(0.1430, abs=5e-5) == model.T
    assert model.volume == pytest.approx(0.1209, abs=5e-5)


def test_froude_numbers():
    ship = Ship("m", L=3.048, B=0.41, T=0.136, depth=1.5)
    assert ship.froude_number(1.5311) == pytest.approx(0.28, abs=5e-4)
    assert ship.depth_froude_number(1.0) == pytest.approx(1 / math.sqrt(9.80665 * 1.5))


@pytest.mark.parametrize("bad", [{"L": -1}, {"T": 0}, {"rho": math.nan}, {"depth": 0.1}, {"mass": -3}])
def test_impossible_particulars_are_refused(bad):
    with pytest.raises(TowtankError):
        Ship(**({"name": "s", "L": 3.0, "B": 0.4, "T": 0.14} | bad))


def test_unknown_and_missing_keys_are_named():
    with pytest.raises(TowtankError, match="Lpp"):
        Ship.from_dict({"name": "s", "Lpp": 3, "L": 3, "B": 1, "T": 1})
    with pytest.raises(TowtankError, match="'B' is missing"):
        Ship.from_dict({"name": "s", "L": 3, "T": 1})
