"""Spiral loops of cubic curves: delta = -a r + b r^3 has a loop of known width."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.events import Events, stack_events
from towtank.simulate.spiral_indices import reverse_spiral_indices, spiral_event_indices, spiral_indices

A, B, NEUTRAL = 10.0, 5.0e4, 0.01
# Extremes of the curve at r = +-sqrt(a / 3 b); the loop is as high as the two roots of delta = 0 are apart.
WIDTH = 2.0 * (2.0 / 3.0) * A * math.sqrt(A / (3.0 * B))
HEIGHT = 2.0 * math.sqrt(A / B)


def rudder_of(rate: np.ndarray, a: float = A) -> np.ndarray:
    return NEUTRAL - a * rate + B * rate**3


def test_loop_of_an_unstable_ship_from_the_reverse_spiral():
    rate = np.linspace(-0.03, 0.03, 61)
    found = {name: values[0] for name, values in reverse_spiral_indices(rudder_of(rate), rate).items()}
    assert found["loop width"] == pytest.approx(math.degrees(WIDTH), rel=0.01)
    assert found["loop height"] == pytest.approx(math.degrees(HEIGHT), rel=0.01)
    assert found["neutral rudder"] == pytest.approx(math.degrees(NEUTRAL), abs=0.01)
    assert math.isnan(found["yaw rate slope"])


def test_stable_ship_has_no_loop():
    rate = np.linspace(-0.03, 0.03, 61)
    found = {
        name: values[0] for name, values in reverse_spiral_indices(rudder_of(rate, -A), rate[::-1] * -1.0).items()
    }
    assert found["loop width"] == 0.0
    assert found["loop height"] == 0.0
    assert found["yaw rate slope"] == pytest.approx(1.0 / A, rel=0.02)
    assert found["neutral rudder"] == pytest.approx(math.degrees(NEUTRAL))


def direct(step: float, a: float) -> tuple[np.ndarray, np.ndarray]:
    """Rudder from starboard to port and back, and the yaw rate that stays on its branch as long as there is one."""
    way = np.radians(np.arange(25.0, -25.1, -step))
    rudder = np.concatenate([way, way[::-1][1:]])
    rates, rate = [], 0.05
    for angle in rudder:
        roots = np.roots([B, 0.0, -a, NEUTRAL - angle])
        real = np.sort(roots[np.abs(roots.imag) < 1e-9].real)
        stable = [root for root in real if 3.0 * B * root**2 - a > 0.0]
        rate = min(stable, key=lambda root: abs(root - rate))
        rates.append(rate)
    return rudder, np.array(rates)


def test_direct_spiral_finds_the_same_loop_to_a_step_of_the_rudder():
    found = {name: values[0] for name, values in spiral_indices(*direct(0.5, A)).items()}
    assert found["loop width"] == pytest.approx(math.degrees(WIDTH), abs=1.0)
    assert found["neutral rudder"] == pytest.approx(math.degrees(NEUTRAL), abs=0.5)
    assert found["loop height"] == pytest.approx(math.degrees(HEIGHT), rel=0.05)


def test_direct_spiral_of_a_stable_ship():
    found = spiral_indices(*direct(1.0, -A))
    assert found["loop width"] == pytest.approx(0.0, abs=1e-9)
    assert found["neutral rudder"] == pytest.approx(math.degrees(NEUTRAL), abs=0.1)


@pytest.mark.parametrize(
    ("rudder", "rate", "cause"),
    [
        ([0.1, 0.2], [0.01, 0.02], "at least five"),
        ([0.1, 0.2, 0.3, 0.4, math.nan], [0.01] * 5, "has no value"),
        ([0.1, 0.2, 0.3, 0.4, 0.5], [0.01, 0.02, 0.03, 0.04, 0.05], "on one side only"),
        ([0.1, 0.2, 0.3, 0.4, 0.5], [-0.01, 0.02, 0.02, 0.04, 0.05], "appears twice"),
    ],
)
def test_reverse_spiral_without_a_curve(rudder, rate, cause):
    with pytest.raises(TowtankError, match=cause):
        reverse_spiral_indices(rudder, rate)


def test_direct_spiral_needs_both_ways():
    rate = np.linspace(0.02, -0.02, 9)
    with pytest.raises(TowtankError, match="one way only"):
        spiral_indices(10.0 * rate, rate)
    both = np.concatenate([rate, rate[::-1][1:]])
    with pytest.raises(TowtankError, match="keeps its sign on one way"):
        spiral_indices(10.0 * both, np.abs(both) + 0.01)


def steady_points(rows, rudder, rate):
    """Events of a spiral at its steady points."""
    points = enumerate(zip(rudder, rate, strict=True), start=1)
    states = {f"steady_{number}": {"time": 1.0 * number, "delta": d, "r": r} for number, (d, r) in points}
    return rows(execute={"time": 0.0}, **states)


def test_sailed_spirals_are_indexed_by_their_steady_points(rows, hull):
    rate = np.linspace(-0.03, 0.03, 41)
    found = spiral_event_indices(steady_points(rows, rudder_of(rate), rate), hull, reverse=True)
    assert found["loop width"] == pytest.approx(reverse_spiral_indices(rudder_of(rate), rate)["loop width"])
    rudder, steady = direct(1.0, A)
    found = spiral_event_indices(steady_points(rows, rudder, steady), hull)
    assert found["loop width"] == pytest.approx(spiral_indices(rudder, steady)["loop width"])


def test_draw_without_a_curve_is_nan_among_others(rows, hull):
    rate = np.linspace(-0.03, 0.03, 41)
    whole = steady_points(rows, rudder_of(rate), rate)
    lost = Events({name: np.nan * states for name, states in whole.mapping.items()})
    found = spiral_event_indices(stack_events([whole, lost]), hull, reverse=True)
    assert found["loop width"][0] > 0.0
    assert np.isnan(found["loop width"][1])
    with pytest.raises(TowtankError, match="has no value"):
        spiral_event_indices(lost, hull, reverse=True)
