"""Example of NASA's tutorial."""

import pytest

from towtank.reproduce.paper_nasa_grids import cases


def test_all_five_numbers():
    found = {case.quantity: case for case in cases()}
    assert len(found) == 5
    assert {case.verdict for case in found.values()} == {"reproduced"}
    assert found["GCI of grids 2 and 3, %"].computed == pytest.approx(0.356249, abs=5e-7)
