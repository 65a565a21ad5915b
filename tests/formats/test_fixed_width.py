import pytest

from towtank.core.errors import ReadError
from towtank.formats.fixed_width import SEPARATOR, column_edges, cut, separate

TOUCHING = ["   0.10-12.3456-13.1111", "   0.20 12.3456 13.1111", "   0.30-11.3456  3.1111"]


def test_touching_numbers_are_parted_behind_their_decimals():
    edges = column_edges(TOUCHING, ".")
    assert [cut(line, edges) for line in TOUCHING[:2]] == [
        ["0.10", "-12.3456", "-13.1111"],
        ["0.20", "12.3456", "13.1111"],
    ]


def test_blank_cells_are_kept():
    lines = ["   0.10          -13.11", "   0.20   12.34   13.11", "   0.30  -11.34   -3.11"]
    edges = column_edges(lines, ".")
    assert cut(lines[0], edges) == ["0.10", "", "-13.11"]


def test_no_lines_give_no_columns():
    assert column_edges([], ".") == ()


def test_separated_bytes_and_cut_last_line():
    edges = column_edges(TOUCHING, ".")
    data = "\n".join([*TOUCHING, "", "   0.40-12.3"]).encode()
    separated, is_cut = separate(data, edges)
    assert is_cut
    assert separated.decode().splitlines()[0].split(SEPARATOR) == ["   0.10", "-12.3456", "-13.1111"]
    assert len(separated.splitlines()) == 3


def test_longer_line_is_an_error():
    edges = column_edges(TOUCHING, ".")
    with pytest.raises(ReadError, match=r"a.txt, line 12: the line has 25 characters where the columns end at 23"):
        separate(b"   0.10-12.3456-13.1111\n   0.10-12.3456-13.111122\n", edges, file="a.txt", first_line=11)
