"""Decay with radiation memory: against the eigenvalues and the convolution, and what is no decay."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.equation import simulate_decay
from towtank.decay.fluid_memory import memory_state, simulate_memory_decay
from towtank.decay.transfer_function import TransferFunction

INERTIA = 8e10
MEMORY = TransferFunction(np.array([6e8, 3e8, 0.0]), np.array([1.0, 1.1, 0.8, 0.25]))
TERMS = {"b1": 0.0075, "b2": 0.03, "c1": 0.0987}
TIME = np.arange(0.0, 120.0, 0.25)


def test_linear_decay_is_that_of_the_matrix_exponential():
    from scipy.linalg import expm

    a, b, c = MEMORY.state_space()
    whole = np.zeros((5, 5))
    whole[0, 1] = 1.0
    whole[1, :2] = -TERMS["c1"], -TERMS["b1"]
    whole[1, 2:] = -c / INERTIA
    whole[2:, 1], whole[2:, 2:] = b, a
    linear = {"b1": TERMS["b1"], "c1": TERMS["c1"]}
    path = simulate_memory_decay(TIME, (0.1, 0.02), linear, MEMORY, INERTIA)
    start = np.array([0.1, 0.02, 0.0, 0.0, 0.0])
    for i in (1, 40, 479):
        assert path[i] == pytest.approx((expm(whole * TIME[i]) @ start)[:2], abs=1e-8)


def test_quadratic_decay_fulfils_the_equation_with_its_convolution():
    time = np.arange(0.0, 60.0, 0.02)
    x, v = simulate_memory_decay(time, (0.12, 0.0), TERMS, MEMORY, INERTIA).T
    kernel = MEMORY.impulse_response(time)
    force = 0.02 * np.convolve(kernel, v)[: time.size] - 0.01 * (kernel[0] * v + kernel * v[0])
    acceleration = np.gradient(v, time)
    left = acceleration + (TERMS["b1"] + TERMS["b2"] * np.abs(v)) * v + TERMS["c1"] * x + force / INERTIA
    assert np.abs(left[5:-5]).max() < 2e-5 * np.abs(acceleration).max()


def test_weak_memory_leaves_the_plain_decay():
    weak = TransferFunction(MEMORY.numerator * 1e-9, MEMORY.denominator)
    path = simulate_memory_decay(TIME, (0.12, 0.0), {**TERMS, "c3": 0.1}, weak, INERTIA)
    plain = simulate_decay(TIME, (0.12, 0.0), np.array([0.0075, 0.03, 0.0, 0.0987, 0.1, 0.0]))
    assert path == pytest.approx(plain, abs=1e-7)


def test_radiation_damps_and_adds_inertia():
    with_waves = simulate_memory_decay(TIME, (0.12, 0.0), TERMS, MEMORY, INERTIA)[:, 0]
    without = simulate_decay(TIME, (0.12, 0.0), np.array([0.0075, 0.03, 0.0, 0.0987, 0.0, 0.0]))[:, 0]
    assert np.abs(with_waves[-90:]).max() < np.abs(without[-90:]).max()
    last = [TIME[np.flatnonzero(x[1:] * x[:-1] < 0.0)[-1]] for x in (with_waves, without)]
    assert MEMORY.added_mass_difference(np.array([math.sqrt(0.0987)]))[0] > 0.0
    assert last[0] > last[1]


def test_divergence_ends_in_missing_values():
    path = simulate_memory_decay(TIME, (0.5, 0.0), {"c1": 0.1, "c3": -5.0}, MEMORY, INERTIA)
    assert np.isnan(path[-1]).all()
    assert np.isfinite(path[0]).all()


@pytest.mark.parametrize(
    ("time", "terms", "inertia", "message"),
    [
        (TIME[::-1], TERMS, INERTIA, "rise"),
        (TIME, {**TERMS, "b4": 1.0}, INERTIA, "no term 'b4'"),
        (TIME, {"b1": 0.1}, INERTIA, "positive c1"),
        (TIME, TERMS, 0.0, "positive c1 and inertia"),
    ],
)
def test_what_is_no_decay_is_refused(time, terms, inertia, message):
    with pytest.raises(FitError, match=message):
        simulate_memory_decay(time, (0.1, 0.0), terms, MEMORY, inertia)


@pytest.mark.parametrize("column", range(9))
def test_sensitivities_are_the_gradient(column):
    parameters = np.array([0.0075, 0.03, 0.2, 0.0987, 0.05, 0.05, 0.12, 0.01, INERTIA])
    time = TIME[:200]
    state = np.array([0.03, -0.02, 0.01])

    def path(values: np.ndarray, **more: bool) -> np.ndarray:
        terms = dict(zip(("b1", "b2", "b3", "c1", "c3", "c5"), values[:6]))
        return simulate_memory_decay(
            time, (values[6], values[7]), terms, MEMORY, float(values[8]), state=state, **more
        )

    step = 1e-6 if column < 8 else 1e-4 * INERTIA
    up, down = parameters.copy(), parameters.copy()
    up[column] += step
    down[column] -= step
    numeric = (path(up) - path(down)) / (2.0 * step)
    exact = path(parameters, sensitivities=True)[:, 2 + 2 * column : 4 + 2 * column]
    np.testing.assert_allclose(exact, numeric, atol=1e-6 * np.abs(numeric).max())


def test_state_of_the_memory_continues_a_decay():
    """A decay that is cut and goes on with the state from its past is the whole decay."""
    time = np.arange(0.0, 60.0, 0.05)
    whole = simulate_memory_decay(time, (0.12, 0.0), TERMS, MEMORY, INERTIA)
    cut = 337
    state = memory_state(time[: cut + 1], whole[: cut + 1, 0] + 0.3, MEMORY)
    again = simulate_memory_decay(time[cut:], tuple(whole[cut]), TERMS, MEMORY, INERTIA, state=state)
    assert again == pytest.approx(whole[cut:], abs=2e-6)
    forgetful = simulate_memory_decay(time[cut:], tuple(whole[cut]), TERMS, MEMORY, INERTIA)
    assert np.abs(forgetful - whole[cut:]).max() > 1e-4
    assert memory_state(time[:1], whole[:1, 0], MEMORY) == pytest.approx(np.zeros(3))
