"""``towtank sets``, ``show``, ``convert`` and ``export``."""

from __future__ import annotations

import pandas as pd
import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.datasets import load_set


def test_sets_and_tables_are_listed_with_ship_and_source(towtank):
    listed = towtank("sets").out
    assert "kvlcc2" in listed
    assert "mariner" in listed
    tables = towtank("sets", "--tables").out
    assert "dtc-drift-points-63" in tables
    assert "columns" in tables.splitlines()[0]


def test_show_says_conventions_source_and_misprints(towtank):
    ended = towtank("show", "s175")
    assert ended.status == 0
    assert "0.5 rho L T U^2" in ended.out
    assert "source: " in ended.out
    assert "misprint: " in ended.out
    assert "-0.4220" in ended.out or "-0.422" in ended.out


@pytest.fixture
def fitted(tmp_path):
    """A set with uncertainty as a file."""
    path = tmp_path / "fit" / "derivatives.json"
    path.parent.mkdir()
    load_set("kvlcc2").to_json(path)
    return path


def test_a_set_is_a_file_a_folder_or_a_key(towtank, fitted):
    by_key, by_file, by_folder = (towtank("show", name).out for name in ("kvlcc2", fitted, fitted.parent))
    assert by_key == by_file == by_folder


def test_a_table_with_a_heading_is_a_set(towtank, tmp_path):
    table = towtank("export", "kvlcc2", "--for", "csv").out
    assert table.startswith("name,value,std,lower95,upper95,scaling\nR0,")
    path = tmp_path / "kvlcc2.csv"
    path.write_text("# ship.name = KVLCC2 model\n# ship.L = 7.0\n# ship.B = 1.27\n# ship.T = 0.455\n" + table)
    assert towtank("show", path).status == 0
    assert "Yvvr" in towtank("compare", "kvlcc2", path).out


@pytest.mark.parametrize(
    ("content", "said"),
    [("{}", "derivatives.json"), ("not json", "derivatives.json"), (None, "file not found")],
)
def test_a_file_that_is_no_set(towtank, tmp_path, content, said):
    path = tmp_path / "derivatives.json"
    if content is not None:
        path.write_text(content)
    for command in (("show", path), ("convert", path, "--to", "prime"), ("export", path, "--for", "csv")):
        ended = towtank(*command)
        assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
        assert said in ended.err
        assert " -> " in ended.err


def test_convert_prints_or_writes(towtank, tmp_path):
    printed = towtank("convert", "kvlcc2", "--to", "prime,cog")
    assert printed.status == 0
    assert "Yvvr" in printed.out
    for name in ("prime.json", "prime.csv"):
        ended = towtank("convert", "kvlcc2", "--to", "prime", "--out", tmp_path / name)
        assert ended.out == f"{len(load_set('kvlcc2'))} derivatives -> {tmp_path / name}\n"
    ship = load_set("kvlcc2").ship
    converted = DerivativeSet.from_json(tmp_path / "prime.json")
    assert converted["Yv"] == pytest.approx(load_set("kvlcc2")["Yv"] * ship.T / ship.L)
    assert pd.read_csv(tmp_path / "prime.csv").set_index("name")["value"]["Yv"] == pytest.approx(converted["Yv"])


def test_convert_scales_by_froude_and_takes_a_speed(towtank, tmp_path):
    path = tmp_path / "full.json"
    ended = towtank("convert", "kvlcc2", "--to", "dimensional", "--scale", 1, "--speed", 1.0, "--out", path)
    assert ended.status == 0, ended.err
    full = DerivativeSet.from_json(path)
    start = load_set("kvlcc2")
    larger = full.ship.L / start.ship.L
    assert larger == pytest.approx(start.ship.scale)
    assert full.conventions.force_scaling == "dimensional"
    without = towtank("convert", "kvlcc2", "--to", "dimensional", "--out", tmp_path / "none" / "x.json")
    assert without.status == 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("convert", "kvlcc2", "--to", "lt,primeval"), "unknown convention 'primeval' -> use one of mmg, prime"),
        (("export", "kvlcc2", "--for", "ansys"), "'ansys' is not an export -> use one of csv"),
        (("export", "kvlcc2", "--for", "xlsx"), "give a file with --out"),
        (("show", "kvlc2"), "did you mean kvlcc2"),
    ],
)
def test_wrong_words_get_the_right_ones(towtank, words, said):
    ended = towtank(*words)
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert said in ended.err


@pytest.mark.parametrize("target", ["shipmmg", "mss", "csv", "latex", "json", "xlsx"])
def test_export_writes_a_file(towtank, tmp_path, target):
    path = tmp_path / f"hull.{ {'xlsx': 'xlsx'}.get(target, 'txt') }"
    ended = towtank("export", "kvlcc2", "--for", target, "--out", path)
    assert ended == (0, f"written: {path}\n", "")
    assert path.stat().st_size > 300
    assert [one.name for one in tmp_path.iterdir()] == [path.name]
