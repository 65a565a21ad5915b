"""The form of one file of histories."""

from towtank.formats.log_layout import LogLayout


def test_the_time_is_the_index_where_there_is_one():
    assert LogLayout("columns", "monitor", ("iteration", "time", "a"), {}, 0).index_name == "time"
    assert LogLayout("columns", "monitor", ("iteration", "a"), {}, 0).index_name == "iteration"
