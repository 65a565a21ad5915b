"""Levels of a stepped channel: ramps belong to none, noise parts none."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from towtank.simulate.held_levels import held_levels, settled_part

LEVELS = (20.0, 15.0, 10.0, 5.0, 0.0, -5.0)


def steps(ramp: int = 10, hold: int = 80) -> np.ndarray:
    parts = [np.full(hold, LEVELS[0])]
    for before, after in pairwise(LEVELS):
        parts += [np.linspace(before, after, ramp + 2)[1:-1], np.full(hold, after)]
    return np.concatenate(parts)


def test_levels_end_where_the_ramps_begin():
    values = steps()
    found = held_levels(values, 1.0, values)
    assert [values[part][-1] for part in found] == list(LEVELS)
    assert [part.stop for part in found] == [80 + 90 * number for number in range(len(LEVELS))]


@pytest.mark.parametrize("seed", range(4))
def test_noise_parts_no_level(seed):
    values = steps() + 0.15 * np.random.default_rng(seed).standard_normal(len(steps()))
    found = held_levels(values, 1.0, values)
    assert [np.mean(values[settled_part(part)]) for part in found] == pytest.approx(LEVELS, abs=0.25)


def test_a_rudder_that_moves_on_ends_the_level():
    values, rudder = steps(), steps()
    rudder[70:80] -= 3.0
    assert held_levels(values, 1.0, rudder)[0].stop == 70


def test_a_slow_passage_is_no_level():
    values = np.concatenate([np.full(100, 1.0), np.linspace(1.0, 0.0, 40), np.full(100, 0.0)])
    assert len(held_levels(values, 0.6, values)) == 2


def test_a_short_record_has_none():
    assert held_levels(np.zeros(5), 1.0, np.zeros(5)) == []
