"""Virtual records: what is in them is what was asked for, and they say that they are virtual."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.decay_input import read_decay
from towtank.decay.equation import simulate_decay
from towtank.decay.fluid_memory import simulate_memory_decay
from towtank.decay.transfer_function import TransferFunction
from towtank.decay.virtual_decay import LABEL, VirtualDecay, demo_plan, virtual_decay

PLAN = VirtualDecay({"b1": 0.01, "b2": 0.1, "c1": 6.0}, 0.2)


def test_held_model_decays_from_the_angle():
    made = virtual_decay(replace(PLAN, rest_cycles=2.0))
    assert made.release == pytest.approx(2.0 * PLAN.natural_period)
    before = made.record.time < made.release
    assert (made.record.value[before] == 0.2).all()
    expected = simulate_decay(
        made.record.time[~before] - made.release, (0.2, 0.0), np.array([0.01, 0.1, 0.0, 6.0, 0.0, 0.0])
    )
    assert made.record.value[~before] == pytest.approx(expected[:, 0], abs=1e-12)


def test_it_says_that_it_is_virtual():
    record = virtual_decay(PLAN).record
    assert LABEL in record.steps
    assert record.source.startswith("virtual")
    assert record.name.startswith("virtual")


@pytest.mark.parametrize("amplitude", [0.2, -0.2])
def test_pushes_reach_the_angle_and_the_free_part_is_found(amplitude):
    made = virtual_decay(replace(PLAN, amplitude=amplitude, pushes=8, rest_cycles=2.0, cycles=20.0))
    after = made.clean[made.record.time >= made.release]
    peak = np.abs(after[:100]).max()
    assert peak == pytest.approx(0.2, rel=2e-3)
    assert np.abs(made.clean).max() == pytest.approx(0.2, rel=0.05)
    free = made.record.free_part()
    assert made.release <= free.time[0] <= made.release + PLAN.natural_period
    other = virtual_decay(replace(PLAN, amplitude=-amplitude, pushes=8, rest_cycles=2.0, cycles=20.0))
    assert made.clean == pytest.approx(-other.clean)


def test_noise_has_its_sizes_and_memory():
    plan = replace(PLAN, cycles=400.0, white=0.002, ar1=0.005, correlation_time=0.4, seed=3)
    made = virtual_decay(plan)
    noise = made.record.value - made.clean
    step = PLAN.natural_period / PLAN.samples_a_cycle
    assert noise.var() == pytest.approx(0.002**2 + 0.005**2, rel=0.05)
    lag = round(0.4 / step)
    covariance = float(np.mean(noise[lag:] * noise[:-lag]))
    assert covariance == pytest.approx(0.005**2 * math.exp(-lag * step / 0.4), rel=0.1)


def test_seeds_make_records():
    noisy = replace(PLAN, white=0.001)
    first, again = virtual_decay(noisy), virtual_decay(noisy)
    assert (first.record.value == again.record.value).all()
    assert (first.record.value != virtual_decay(replace(noisy, seed=1)).record.value).any()


def test_rest_position_and_drift():
    made = virtual_decay(replace(PLAN, offset=0.01, drift=0.02))
    added = made.record.value - made.clean
    assert added[0] == pytest.approx(0.01)
    assert added[-1] == pytest.approx(0.03)


@pytest.mark.parametrize("motion", ["roll", "pitch", "heave"])
def test_table_reads_back(tmp_path, motion):
    made = virtual_decay(replace(PLAN, motion=motion))
    file = tmp_path / "virtual.csv"
    made.to_frame().to_csv(file, index=False)
    again = read_decay(file, motion=motion)
    assert again.value == pytest.approx(made.record.value, abs=1e-12)
    assert again.time == pytest.approx(made.record.time, abs=1e-9)


def test_memory_damps_the_record():
    memory = TransferFunction(np.array([6e8, 0.0]), np.array([1.0, 0.6, 0.5]))
    plan = VirtualDecay({"b1": 0.01, "c1": 0.1}, 0.1, memory=memory, inertia=8e10)
    made = virtual_decay(plan)
    expected = simulate_memory_decay(made.record.time, (0.1, 0.0), plan.coefficients, memory, 8e10)[:, 0]
    assert made.clean == pytest.approx(expected)


def test_demonstration_is_a_model_pushed_by_hand():
    made = virtual_decay(demo_plan())
    assert made.record.scale == 68.0
    assert made.record.ship is not None
    assert abs(made.record.ship.L - 320.0 / 68.0) < 1e-12
    assert np.degrees(np.abs(made.clean).max()) == pytest.approx(13.0, rel=0.02)
    assert made.truth["b2"] == 0.11
    assert made.release > 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"coefficients": {"b1": 0.1}}, "c1 > 0"),
        ({"coefficients": {"c1": 1.0, "d": 1.0}}, "no term 'd'"),
        ({"amplitude": 0.0}, "an amplitude"),
        ({"samples_a_cycle": 4.0}, "eight samples"),
        ({"white": -1.0}, "negative"),
        ({"motion": "surge"}, "'surge' is unknown"),
        (
            {"memory": TransferFunction(np.array([1.0, 0.0]), np.array([1.0, 1.0, 1.0])), "pushes": 2},
            "held and let go",
        ),
    ],
)
def test_plans_that_cannot_be_made(change, message):
    with pytest.raises(FitError, match=message):
        replace(PLAN, **change)


def test_capsizing_and_unreachable_angles_are_errors():
    with pytest.raises(FitError, match="capsizes"):
        virtual_decay(replace(PLAN, coefficients={"c1": 1.0, "c3": -5.0}, amplitude=0.6))
    with pytest.raises(FitError, match="do not reach"):
        virtual_decay(replace(PLAN, coefficients={"c1": 1.0, "c3": -5.0}, amplitude=0.6, pushes=2))
