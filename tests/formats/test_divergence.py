"""A divergence is a trail of printed nan that no number follows."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.formats.divergence import DivergenceWatch

NAN, INF = np.nan, np.inf


def watch(*columns: list[float], size: int) -> DivergenceWatch:
    values = np.array([list(range(len(columns[0]))), *columns], dtype=float)
    seen = DivergenceWatch(["time", "a", "b"][: len(values)])
    for at in range(0, values.shape[1], size):
        seen.add(values[:, at : at + size].copy())
    return seen


@pytest.mark.parametrize("size", [1, 2, 3, 9])
def test_the_earliest_trail_counts(size):
    seen = watch([1, 2, 3, 4, INF, INF], [1, 2, 3, -INF, INF, INF], size=size)
    assert seen.diverged_at == 3.0
    assert seen.notes(3) == ["diverged: b is nan or inf from time 3 on; 3 row(s) from there were left out"]


@pytest.mark.parametrize("size", [1, 2, 9])
def test_numbers_behind_it_make_it_a_gap(size):
    seen = watch([1, INF, INF, 4], [1, 2, 3, 4], size=size)
    assert seen.diverged_at is None
    assert seen.notes(0) == ["2 value(s) are printed as nan or inf between numbers and are missing here"]


@pytest.mark.parametrize("size", [1, 2, 9])
def test_missing_values_are_no_divergence(size):
    seen = watch([1, 2, NAN, NAN], [1, 2, 3, 4], size=size)
    assert (seen.diverged_at, seen.notes(0)) == (None, [])


@pytest.mark.parametrize("size", [1, 2, 9])
def test_a_column_without_any_number_is_left_alone(size):
    seen = watch([INF] * 4, [1, 2, 3, 4], size=size)
    assert seen.diverged_at is None
    assert not seen.is_empty
    assert seen.notes(0) == ["a: nan or inf throughout"]


def test_nothing_but_nan():
    assert watch([INF, INF], [NAN, INF], size=1).is_empty


def test_infinities_become_missing_values():
    block = np.array([[0.0, 1.0], [INF, 2.0]])
    DivergenceWatch(["time", "a"]).add(block)
    assert np.isnan(block[1, 0])
    assert block[1, 1] == 2.0
