"""Declared sinkage channels."""

import pytest

from towtank.core.errors import CampaignError
from towtank.squat.sinkage_layout import SinkageLayout


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        ({"length": 0.0}, "length of 0 m is impossible"),
        ({"points": {"bow": (2.0, 0.0)}}, "give no trim"),
        ({"points": {"port": (2.0, -0.3), "starboard": (2.0, 0.3)}}, r"at 1 place\(s\)"),
        ({"heave": "heave"}, "heave alone gives no trim"),
        ({"points": {"a": (1.0, 0.0), "b": (-1.0, 0.0)}, "trim": "trim"}, "says it twice"),
        ({"points": {"a": (1.0, 0.0)}, "heave": "heave", "trim": "trim"}, "both by points and by heave"),
        ({"heave": "heave", "trim": "trim", "trim_positive": "aft"}, "sense of a channel is unknown"),
    ],
)
def test_a_layout_that_does_not_determine_the_motion_is_refused(declared, message):
    with pytest.raises(CampaignError, match=message):
        SinkageLayout(**{"length": 4.0, **declared})


def test_channels_and_places_of_a_layout():
    layout = SinkageLayout(length=4.0, heave="z", trim="t", speed="u", extra=("X", "z"), xG=-0.05)
    assert layout.channels == ("time", "z", "t", "u", "X")
    assert layout.places == {"bow": 2.0, "stern": -2.0, "midship": 0.0, "cog": -0.05}
