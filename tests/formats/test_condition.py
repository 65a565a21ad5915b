import math

import pytest

from towtank.core.errors import ReadError
from towtank.formats.condition import header_entries, read_condition

CONDITION = """\
# KVLCC2, model 1:58
[model]
Lpp = 5517.2 mm   ! between perpendiculars
B [m]: 1.0
T 0.3586 m
mass: 2.09 t
Izz = 4205 kg m2
scale 1:58
trim = 1 deg
n = 600 rpm
omega = 60 rpm/s
rho = 998,2
; a remark
% another
date: 12:30
name = MOERI tanker
speed = 15.5 kn (full scale)
"""


def test_entries_are_read_in_si(tmp_path):
    path = tmp_path / "run.cond"
    path.write_text(CONDITION)
    assert read_condition(path) == {
        "Lpp": pytest.approx(5.5172),
        "B": 1.0,
        "T": 0.3586,
        "mass": pytest.approx(2090.0),
        "Izz": 4205.0,
        "scale": "1:58",
        "trim": pytest.approx(math.pi / 180),
        "n": pytest.approx(10.0),
        "omega": "60 rpm/s",
        "rho": 998.2,
        "date": "12:30",
        "name": "MOERI tanker",
        "speed": "15.5 kn (full scale)",
    }


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("Lpp = 5\nB =\n", r"line 2: 'B =' has no value"),
        ("Lpp = 5\nbeam\n", r"line 2: 'beam' has no value"),
        ("Lpp = 5\nLpp = 6\n", r"line 2: 'Lpp' is given twice, as 5.0 and as 6.0"),
        ("0.1 2.0 3.0\n", r"line 1: '0.1' is not the name of a particular"),
    ],
)
def test_faulty_lines_are_named(tmp_path, text, fault):
    path = tmp_path / "model.txt"
    path.write_text(text)
    with pytest.raises(ReadError, match=fault):
        read_condition(path)


def test_the_same_entry_may_stand_twice(tmp_path):
    path = tmp_path / "model.txt"
    path.write_text("Lpp = 5\nLpp = 5\n")
    assert read_condition(path) == {"Lpp": 5.0}


def test_latin_1_condition(tmp_path):
    path = tmp_path / "model.txt"
    path.write_bytes("heel = 10 °\n".encode("latin-1"))
    assert read_condition(path) == {"heel": pytest.approx(math.radians(10))}


def test_header_entries_keep_units_as_printed():
    lines = ["Run: 12", "Speed = 1.53 m/s", "a sentence without entry", "time 12:30", "Date: 2019-05-01;"]
    assert header_entries(lines) == {"Run": 12.0, "Speed": "1.53 m/s", "Date": "2019-05-01"}
