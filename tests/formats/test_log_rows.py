"""Rows of solver logs: the compiled way and the plain one agree, and what is no row is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.core.errors import ReadError
from towtank.formats import log_rows
from towtank.formats.log_layout import LogLayout
from towtank.formats.log_rows import Reading, places_of, row_blocks

LAYOUT = LogLayout("OpenFOAM", "monitor", ("time", "a", "b"), {}, 0)
CELL = st.one_of(
    st.floats(-1e9, 1e9).map(repr),
    st.sampled_from(["1", "-2.5e-03", "nan", "-inf", "N/A", "12345678901234567890.5", "1e-310", "1.5D+03"]),
)
LINE = st.one_of(
    st.lists(CELL, min_size=3, max_size=3).map(" ".join),
    st.lists(CELL, min_size=3, max_size=3).map(lambda cells: f"{cells[0]}\t(({cells[1]}) {cells[2]})"),
    st.lists(CELL, min_size=0, max_size=5).map("  ".join),
    st.sampled_from(["# Time a b", "", "  \t", "0.5 ((1 # Forces", "Time a b"]),
)


def read(path: Path, layout: LogLayout = LAYOUT, **options):
    reading = Reading()
    places, _ = places_of(layout, None)
    blocks = list(row_blocks(path, layout, places, reading, **options))
    return (np.concatenate(blocks, axis=1) if blocks else np.empty((3, 0))), reading


@settings(deadline=None, max_examples=60)
@given(st.lists(LINE, max_size=30), st.sampled_from(["\n", "\r\n"]))
def test_compiled_and_plain_parser_agree(lines, end):
    piece = (end.join([*lines, ""])).encode()
    places, _ = places_of(LAYOUT, None)
    if not piece:
        return
    compiled = log_rows._parse_compiled(piece, LAYOUT, places)
    plain = log_rows._parse_plainly(piece, LAYOUT, places)
    assert np.array_equal(compiled.block, plain.block, equal_nan=True)
    assert [number for number, _ in compiled.faults] == [number for number, _ in plain.faults]
    assert compiled.lines == plain.lines


@pytest.mark.parametrize("piece", [7, 64, 1000])
def test_pieces_end_anywhere(tmp_path, monkeypatch, piece):
    monkeypatch.setattr(log_rows, "PIECE", piece)
    monkeypatch.setattr(log_rows, "_SMALL", 0)
    path = tmp_path / "log.dat"
    path.write_text("".join(f"{i * 0.5} ({i} -{i})\n" for i in range(200)))
    values, reading = read(path)
    assert values.T.tolist() == [[i * 0.5, i, -i] for i in range(200)]
    assert reading.end == path.stat().st_size


def test_a_cut_last_line_is_left_out_and_told(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("1 (2 3)\n2 (2 3)\n3 (2 ")
    values, reading = read(path)
    assert values[0].tolist() == [1, 2]
    assert reading.broken.notes() == ["the last line (3) is cut off and was left out"]


@pytest.mark.parametrize(
    ("last", "whole"), [("3 (4 5)", True), ("3 (4 5", False), ("3 4.00 5.2", False), ("3 4.00 5.25", True)]
)
def test_a_last_line_without_end_counts_if_it_is_certainly_whole(tmp_path, last, whole):
    path = tmp_path / "log.dat"
    path.write_text("1 2.00 3.75\n" + last)
    values, reading = read(path)
    assert values.shape[1] == 1 + whole
    assert bool(reading.broken.cut) is not whole


def test_a_crash_in_the_middle_costs_its_line(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("1 2 3\n2 2 3\n3 2# Forces\n# Time a b\n3 2 3\n4 2 3\n")
    values, reading = read(path)
    assert values[0].tolist() == [1, 2, 3, 4]
    assert reading.broken.notes() == ["1 broken line(s) were left out, the first at line 3: '3 2# Forces'"]


def test_headers_between_the_rows_are_counted(tmp_path):
    path = tmp_path / "log.csv"
    layout = LogLayout("STAR-CCM+", "monitor", ("time", "a", "b"), {}, 0, delimiter=",", comment="")
    path.write_text('1,2,3\n"Time: Time (s)","a Monitor: a","b Monitor: b"\n2,2,3\n')
    values, reading = read(path, layout)
    assert values[0].tolist() == [1, 2]
    assert reading.broken.notes() == ["the header stands 1 more time(s) between the rows"]


def test_columns_that_change_within_the_file_are_an_error(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("1 2 3\n" * 5 + "1 2 3 4\n" * 20)
    with pytest.raises(ReadError, match=r"log.dat, line 6: 20 lines are no rows of 3 values.*split it there"):
        read(path)


def test_a_file_that_is_written_keeps_its_half_line(tmp_path):
    path = tmp_path / "log.dat"
    path.write_text("1 2 3\n2 2 3\n3 2 3")
    values, reading = read(path, half_lines=True)
    assert values[0].tolist() == [1, 2]
    assert (reading.end, reading.broken.notes()) == (12, [])


def test_places_always_hold_the_index():
    places, names = places_of(LAYOUT, ["b"])
    assert (places.tolist(), names) == ([0, -1, 1], ["time", "b"])
