"""Events: states by name and draw."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.events import COLUMNS, Events, stack_events


def states(*times: float) -> np.ndarray:
    rows = np.full((len(times), len(COLUMNS)), np.nan)
    rows[:, 0] = times
    rows[:, 3] = np.radians(times)
    return rows


def test_a_single_row_is_one_draw():
    events = Events({"execute": states(1.0)[0], "end": states(5.0)})
    assert events.draws == 1
    assert events["execute"].shape == (1, 11)
    assert events.names == ("execute", "end")


def test_columns_by_name_and_nan_for_what_was_not_watched():
    events = Events({"execute": states(0.0, 1.0), "end": states(5.0, np.nan)})
    assert events.at("execute", "psi") == pytest.approx([0.0, np.radians(1.0)])
    assert np.isnan(events.at("heading 90", "time")).all()
    assert events.at("heading 90", "time").shape == (2,)
    assert events.occurred("end").tolist() == [True, False]


def test_unknown_event_and_column_are_named():
    events = Events({"execute": states(0.0)})
    with pytest.raises(TowtankError, match=r"no event 'heading 90'.*its events are execute"):
        events["heading 90"]
    with pytest.raises(TowtankError, match="no column 'heading'"):
        events.at("execute", "heading")


@pytest.mark.parametrize("shape", [(3,), (2, 10), (1, 2, 11)])
def test_other_shapes_are_refused(shape):
    with pytest.raises(TowtankError, match=r"shape \(draws, 11\)"):
        Events({"execute": np.zeros(shape)})


def test_events_of_different_draws_are_refused():
    with pytest.raises(TowtankError, match="shapes"):
        Events({"execute": states(0.0), "end": states(0.0, 1.0)})


def test_draws_are_chosen_and_stacked_again():
    events = Events({"execute": states(0.0, 1.0, 2.0), "end": states(5.0, 6.0, 7.0)})
    assert events.draw(1).at("end", "time").tolist() == [6.0]
    masked = events.draw(np.array([True, False, True]))
    assert masked.at("end", "time").tolist() == [5.0, 7.0]
    again = stack_events([events.draw(slice(0, 2)), events.draw(2)])
    np.testing.assert_array_equal(again["end"], events["end"])


def test_stacking_fills_events_that_one_part_did_not_watch():
    stacked = stack_events(
        [Events({"execute": states(0.0)}), Events({"execute": states(1.0), "end": states(3.0)})]
    )
    assert np.isnan(stacked.at("end", "time")[0])
    assert stacked.at("end", "time")[1] == 3.0
    with pytest.raises(TowtankError, match=r"nothing|no events"):
        stack_events([])


def test_frame_is_in_the_order_of_time_and_leaves_out_what_did_not_happen():
    events = Events({"end": states(9.0), "execute": states(1.0), "heading 90": states(np.nan)})
    frame = events.frame()
    assert frame.index.tolist() == ["execute", "end"]
    assert frame["time"].tolist() == [1.0, 9.0]
