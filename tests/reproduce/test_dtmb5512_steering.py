"""DTMB 5512: the divergence of the printed set is reported, not integrated."""

import pytest

from towtank.core.errors import SimulationError
from towtank.reproduce.paper_dtmb5512 import KEY
from towtank.simulate.manoeuvres import turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship


def test_divergence_after_two_and_a_half_lengths(shown):
    cases = [case for case in shown[KEY] if "diverges" in case.quantity]
    assert len(cases) == 2
    assert all(case.verdict == "reproduced" for case in cases)


def test_the_error_names_ship_manoeuvre_time_and_state():
    with pytest.raises(SimulationError, match=r"'dtmb5512', turning \+35: the motion diverges after .* s \(u = "):
        sail(named_ship("dtmb5512"), turning(35.0))
