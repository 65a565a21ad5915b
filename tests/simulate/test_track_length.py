"""Length of the track between events."""

import math

import numpy as np
import pytest

from towtank.simulate.events import Events, stack_events
from towtank.simulate.track_length import track_length


def test_quarter_circle_through_three_events(circle):
    events = circle().events({"execute": 0.0, "heading 45": 45.0, "heading 90": 90.0})
    exact = circle().radius * 0.5 * math.pi
    assert track_length(events, ("execute", "heading 45", "heading 90")) == pytest.approx(exact, rel=1e-3)
    assert track_length(events, ("execute", "heading 30", "heading 90")) == pytest.approx(exact, rel=1e-2)


def test_ten_degrees_need_no_event_between(circle):
    events = circle(side=-1.0, heading=1.0).events({"execute": 0.0, "heading 10": 10.0})
    assert track_length(events, ("execute", "heading 10")) == pytest.approx(200.0 * math.radians(10.0), rel=2e-6)


def test_event_that_a_draw_misses_is_passed_over(circle):
    names = {"execute": 0.0, "heading 45": 45.0, "heading 90": 90.0}
    whole = circle().events(names)
    gap = dict(whole.mapping)
    gap["heading 45"] = np.full_like(whole["heading 45"], np.nan)
    unfinished = dict(whole.mapping)
    unfinished["heading 90"] = np.full_like(whole["heading 90"], np.nan)
    found = track_length(stack_events([whole, Events(gap), Events(unfinished)]), tuple(names))
    direct = track_length(whole, ("execute", "heading 90"))[0]
    assert found[:2] == pytest.approx([track_length(whole, tuple(names))[0], direct])
    assert np.isnan(found[2])


def test_ends_that_were_not_watched(circle):
    events = circle().events({"execute": 0.0, "heading 10": 10.0})
    assert np.isnan(track_length(events, ("execute", "stopped"))).all()
