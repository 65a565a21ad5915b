"""Current, wind and waves from a TOML file."""

from __future__ import annotations

import math

import pytest

from towtank.core.errors import ReadError
from towtank.simulate.environment_file import read_environment
from towtank.simulate.ships import named_ship
from towtank.simulate.wave_drift import DriftTable

SHIP = named_ship("kvlcc2").ship

TEXT = """
[current]
speed = 0.25
direction = 90

[wind]
speed = 2.0
direction = 30
type = "tanker, loaded"
frontal_area = 0.3
lateral_area = 1.1

[waves]
height = 0.1
direction = 180
wavelength = 7.0
drift = "drift.csv"
"""

DRIFT = """encounter angle [deg],wavelength/L,CX,CY,CN
0,0.5,0.3,0,0
90,0.5,0,1,0.1
180,0.5,-0.6,0,0
0,1.5,0.2,0,0
90,1.5,0,0.5,0.05
180,1.5,-0.4,0,0
"""


def test_every_section_is_read(tmp_path):
    path = tmp_path / "sea.toml"
    path.write_text(TEXT)
    (tmp_path / "drift.csv").write_text(DRIFT)
    sea = read_environment(path, SHIP)
    assert sea.current is not None
    assert sea.current.velocity == pytest.approx((0.0, 0.25))
    assert sea.wind is not None
    assert sea.wind.direction == pytest.approx(math.radians(30.0))
    assert "tanker" in sea.wind.coefficients.source
    assert sea.waves is not None
    assert isinstance(sea.waves.drift, DriftTable)
    assert sea.waves.length_ratio(SHIP) == pytest.approx(1.0)


def test_an_empty_file_is_calm(tmp_path):
    (tmp_path / "calm.toml").write_text("")
    calm = read_environment(tmp_path / "calm.toml", SHIP)
    assert (calm.current, calm.wind, calm.waves) == (None, None, None)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("speed = 0.25", "speed = -0.25"), "current.speed"),
        (("direction = 90", ""), "current.direction"),
        (('type = "tanker, loaded"', 'typ = "tanker, loaded"'), "closest: type"),
        (('"tanker, loaded"', '"raft"'), "no wind coefficients for 'raft'"),
        (("wavelength = 7.0", ""), "needs the wavelength"),
        (("height = 0.1", 'height = "high"'), "waves.height"),
    ],
)
def test_a_wrong_key_is_named(tmp_path, change, said):
    path = tmp_path / "sea.toml"
    path.write_text(TEXT.replace(*change))
    (tmp_path / "drift.csv").write_text(DRIFT)
    with pytest.raises(ReadError) as caught:
        read_environment(path, SHIP)
    assert said in str(caught.value)
    assert "sea.toml" in str(caught.value)
