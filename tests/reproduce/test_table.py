"""The gallery as text."""

from towtank.reproduce import Case
from towtank.reproduce.table import gallery_text

GOOD = Case("first", "Table 1", "Yv", -0.25, -0.2501, 0.005)
BAD = Case("first", "Table 1", "Nv", -0.1, -0.2, 0.005, note="the figure has lost a sign " * 6)
OTHER = Case("second", "text", "area", "L^2", "L T", 0.0, "L T", "as in other papers")


def test_columns_are_aligned_and_papers_stand_apart():
    lines = gallery_text([GOOD, BAD, OTHER]).splitlines()
    assert lines[0] == "first"
    assert "second" in lines
    (good,) = (line for line in lines if " Yv " in line)
    (bad,) = (line for line in lines if " Nv " in line)
    assert good.index("reproduced") == bad.index("not-reproducible")


def test_notes_are_wrapped_below_their_row_and_not_repeated():
    lines = gallery_text([BAD, BAD]).splitlines()
    notes = [line for line in lines if line.startswith("    ")]
    assert len(notes) == 2
    assert max(len(line) for line in notes) <= 100


def test_verdicts_are_counted_in_the_last_line():
    last = gallery_text([GOOD, GOOD, BAD, OTHER]).splitlines()[-1]
    assert last == "reproduced: 2, not-reproducible: 1, reproduced-after-correction: 1"
