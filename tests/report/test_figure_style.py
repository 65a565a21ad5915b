"""Axes, decimation, units and inline SVG."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.colors import same_color

from towtank.report.figure_style import (
    CROWD,
    INK,
    MUTED,
    Sheet,
    decimated,
    engineering_unit,
    inline_svg,
    new_axes,
    small_legend,
)


def test_decimation_keeps_the_envelope() -> None:
    values = np.random.default_rng(1).standard_normal(6001)
    times = np.arange(6001.0)
    t, v = decimated(times, values, 400)
    assert len(v) <= 400
    assert (v.min(), v.max()) == (values.min(), values.max())
    assert np.all(np.diff(t) > 0)
    np.testing.assert_array_equal(v, values[t.astype(int)])


def test_a_short_series_is_left_alone() -> None:
    times = np.arange(10.0)
    assert decimated(times, times, 20)[0] is times


@pytest.mark.parametrize(
    ("largest", "factor", "unit"), [(150.0, 1.0, "N"), (1999.0, 1.0, "N"), (2500.0, 1e-3, "kN"), (3e6, 1e-6, "MN")]
)
def test_engineering_units(largest: float, factor: float, unit: str) -> None:
    assert engineering_unit("N", np.array([1.0, -largest]), np.zeros(0)) == (factor, unit)


def test_a_sheet_is_empty_again() -> None:
    sheet = Sheet()
    ax = sheet.fresh()
    ax.errorbar([0.0, 100.0], [0.0, 1.0], yerr=0.1, label="old")
    ax.fill_between([0.0, 1.0], [0.0, 1.0], alpha=0.2)
    ax.set_xlabel("old label")
    small_legend(ax)
    assert "old" in sheet.svg("a", "first")
    ax = sheet.fresh()
    ax.plot([0.0, 1.0], [0.0, 1.0])
    text = sheet.svg("b", "second")
    assert "old" not in text
    assert ax.get_xlim()[1] < 2.0
    assert not ax.containers


def test_inline_svg_is_one_element_that_follows_the_page() -> None:
    ax = new_axes()
    ax.plot([0, 1], [0, 1])
    ax.set_xlabel("drift angle [deg] & more")
    text = inline_svg(ax.figure, "one", 'a "quoted" <text>')
    root = ElementTree.fromstring(text)
    assert root.tag.endswith("svg")
    assert root.attrib["role"] == "img"
    assert root.attrib["aria-label"] == 'a "quoted" <text>'
    assert "width" not in root.attrib
    assert "var(--ink)" in text
    assert "drift angle [deg] &amp; more" in text
    assert "http" not in text.replace("http://www.w3.org/", "")


def test_identifiers_of_two_drawings_differ() -> None:
    def identifiers(name: str) -> set[str]:
        ax = new_axes()
        ax.plot([0, 1], [0, 1], "o")
        text = inline_svg(ax.figure, name, "x")
        return {
            e.attrib["id"]
            for e in ElementTree.fromstring(text).iter()
            if "id" in e.attrib and e.tag.endswith("Path")
        }

    assert not identifiers("one") & identifiers("two")


def test_crowds_become_an_image_that_is_seen_on_dark_paper() -> None:
    x = np.linspace(0.0, 1.0, CROWD + 1)
    few, many = new_axes(), new_axes()
    few.errorbar(x[:20], x[:20], yerr=0.1, fmt="o", color=INK)
    many.errorbar(x, x, yerr=0.1, fmt="o", color=INK)
    assert "<image" not in inline_svg(few.figure, "few", "x")
    assert inline_svg(many.figure, "many", "x").count("<image") == 1
    assert same_color(many.lines[0].get_color(), MUTED)
    assert same_color(many.collections[0].get_colors()[0], MUTED)


def test_drawing_in_threads_leaves_the_settings_alone() -> None:
    before = dict(mpl.rcParams)

    def draw(number: int) -> str:
        ax = new_axes()
        ax.plot([0, number], [0, 1])
        return inline_svg(ax.figure, f"g{number}", "x")

    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(draw, range(1, 5)))
    assert together == [draw(number) for number in range(1, 5)]
    assert dict(mpl.rcParams) == before
