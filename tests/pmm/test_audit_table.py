"""The header of a file against the campaign."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core import Finding, Ship
from towtank.formats.dialect import Dialect
from towtank.formats.raw_table import RawTable
from towtank.pmm.audit_rules import RULES
from towtank.pmm.audit_table import audit_table
from towtank.pmm.run_types import Run

SHIP = Ship("model", 3.048, 0.41, 0.136, rho=1000.0, scale=46.6)
YAW = Run("yaw", "pure_yaw", speed=1.5, frequency=1.1, sway_amplitude=0.3)
ONE = {"Y": np.ones(20)}


def rules(run=None, ship=SHIP, **table):
    return {item.rule: item.severity for item in audit_table(RawTable(ONE, path="a.txt", **table), run, ship=ship)}


def test_findings_of_the_reader_are_passed_on():
    noticed = Finding("blank-rows", "warning", "2 blank rows", "a.txt")
    passed_on = replace(noticed, cure=RULES["blank-rows"].cure)
    assert audit_table(RawTable(ONE, findings=(noticed,)), None) == [passed_on]


def test_how_the_text_was_read():
    assert rules(dialect=Dialect(";", decimal=",", encoding="cp1252")) == {
        "decimal-comma": "info",
        "header-encoding": "info",
    }
    for encoding in ("utf-8", "utf-8-sig", "ascii"):
        assert rules(dialect=Dialect("\t", encoding=encoding)) == {}


@pytest.mark.parametrize(
    "metadata",
    [
        {"Lpp": 3.048, "rho": 1000.0, "scale": 46.6},
        {"Lpp [mm]": "3048 mm", "Water density": "0.9985 t/m3", "Scale": "1:46.6"},
        {"L.b.p": "3,048 m", "density": 998.0, "lambda": 1 / 46.6},
        {"Lpp": "unknown", "Water": "fresh water 18 C"},
        {},
    ],
)
def test_headers_that_agree(metadata):
    assert rules(metadata=metadata) == {}


@pytest.mark.parametrize(
    ("rule", "metadata"),
    [
        ("wrong-length", {"Lpp": 2.8}),
        ("scale-label", {"Lpp": 142.04}),
        ("density", {"rho": 1025.0}),
        ("density", {"Water density": "1.025 t/m3"}),
        ("density", {"Water": "sea water"}),
        ("scale-label", {"Scale": "1:24.83"}),
    ],
)
def test_headers_that_disagree(rule, metadata):
    assert rules(metadata=metadata) == {rule: "error"}
    assert rules(ship=None, metadata=metadata) == {}


@pytest.mark.parametrize(("length", "expected"), [(3.048, {}), (2.4384, {"wrong-length": "error"})])
def test_the_length_of_non_dimensional_rates(length, expected):
    t = np.arange(0.0, 40.0, 0.05)
    r = 0.2 * np.sin(1.1 * t)
    rdot = 0.2 * 1.1 * np.cos(1.1 * t)
    columns = {"r'": r * length / 1.5, "rdot'": rdot * length**2 / 1.5**2}
    found = audit_table(RawTable(columns, path="a.txt"), YAW, ship=SHIP)
    assert {item.rule: item.severity for item in found} == expected
    if found:
        assert "2.4" in found[0].message
        assert found[0].file == "a.txt"
    by_header = audit_table(RawTable(columns, metadata={"Lpp": 3.048}), YAW)
    assert {item.rule: item.severity for item in by_header} == expected


def test_rates_that_do_not_vary_say_nothing():
    still = {"r'": np.zeros(30), "rdot'": np.zeros(30)}
    assert audit_table(RawTable(still), YAW, ship=SHIP) == []
    assert audit_table(RawTable({"r'": np.ones(30)}), YAW, ship=SHIP) == []
