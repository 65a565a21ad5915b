"""The published grid search: finds what lies on its grid, stops in hollows, sees an excitation."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.discrete_search import SHIP, search_on_grid
from towtank.decay.excited_roll import Excitation, simulate_excited_roll

TRUTH = {"b1": 0.080, "b3": 0.256, "c1": 11.88, "c3": 1.758, "c5": -18.624}
STEPS = {"b1": 0.005, "b3": 0.02, "c1": 0.05, "c3": 0.25, "c5": 2.0}
TIME = np.arange(0.0, 10.0, 0.02)


def moving(excitation=None):
    x, v = simulate_excited_roll(TIME, (math.radians(25.0), 0.0), TRUTH, excitation).T
    inner = sum(TRUTH[name] * term for name, term in zip(SHIP, (v, v**3, x, x**3, x**5)))
    moment = 0.0 if excitation is None else excitation.moment(TIME)
    return TIME, x, v, moment - inner


def test_truth_on_the_grid_and_near_is_found():
    start = {name: TRUTH[name] + STEPS[name] for name in SHIP}
    found = search_on_grid(*moving(), start=start, steps=STEPS)
    assert found.values == pytest.approx(TRUTH)
    assert found.error < 1e-10
    assert found.moves == 1
    assert found.local_minimum


def test_from_farther_away_it_stops_in_a_hollow():
    start = {"b1": 0.056, "b3": 0.333, "c1": 11.0, "c3": 2.6, "c5": -12.0}
    found = search_on_grid(*moving(), start=start, steps=STEPS)
    assert found.local_minimum
    assert abs(found.values["c3"] / TRUTH["c3"] - 1.0) > 0.1
    # A small misfit does not make the coefficients right.
    assert found.error < 0.01


def test_moving_every_coefficient_is_another_search():
    start = {name: TRUTH[name] + 2.0 * STEPS[name] for name in SHIP}
    found = search_on_grid(*moving(), start=start, steps=STEPS, unchanged=False)
    moved = {name: (found.values[name] - start[name]) / STEPS[name] for name in SHIP}
    assert {round(value) % 2 for value in moved.values()} == {found.moves % 2}


def test_nine_coefficients_with_an_excitation():
    wave = Excitation(1.0, 3.0, 0.5, 0.2)
    truth = {**TRUTH, "f": 1.0, "we": 3.0, "phase": 0.5, "f0": 0.2}
    steps = {**STEPS, "f": 0.05, "we": 0.02, "phase": 0.05, "f0": 0.02}
    start = {name: truth[name] + steps[name] for name in truth}
    columns = [column[:100] for column in moving(wave)]
    found = search_on_grid(*columns, start=start, steps=steps, unchanged=False)
    assert found.values == pytest.approx(truth)


def test_moves_can_run_out():
    start = {name: TRUTH[name] + 6.0 * STEPS[name] for name in SHIP}
    found = search_on_grid(*moving(), start=start, steps=STEPS, most_moves=1)
    assert (found.moves, found.local_minimum) == (1, False)


def test_bad_requests_are_refused():
    columns = moving()
    with pytest.raises(FitError, match="no guess or step of c5"):
        search_on_grid(*columns, start=TRUTH, steps={name: STEPS[name] for name in SHIP[:4]})
    with pytest.raises(FitError, match="not positive"):
        search_on_grid(*columns, start=TRUTH, steps={**STEPS, "c3": 0.0})
    with pytest.raises(FitError, match="differ in length"):
        search_on_grid(TIME, *[column[:-1] for column in columns[1:]], start=TRUTH, steps=STEPS)
