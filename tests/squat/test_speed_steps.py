"""Runs whose speed rises by steps."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord
from towtank.squat.speed_steps import reduce_speed_steps, speed_steps

LEVELS = (0.6, 0.8, 1.0)
LAYOUT = SinkageLayout(length=9.0, points={"bow": (4.5, 0.0), "stern": (-4.5, 0.0)}, speed="u")


def _run():
    """Fixed 70 s, then each speed 400 s with 30 s of ramp, as in a computation."""
    time = np.arange(0.0, 1270.0, 0.5)
    speed = np.zeros_like(time)
    squat = np.zeros_like(time)
    for number, level in enumerate(LEVELS):
        begin = 70.0 + 400.0 * number
        before = LEVELS[number - 1] if number else 0.0
        on = time >= begin
        ramp = np.clip((time[on] - begin) / 30.0, 0.0, 1.0)
        speed[on] = before + (level - before) * ramp
        squat[on] = 0.02 * (before**2 + (level**2 - before**2) * (1.0 - np.exp(-(time[on] - begin) / 40.0)))
    wobble = 1e-6 * np.random.default_rng(7).standard_normal((2, time.size))
    return SinkageRecord(
        time, squat + wobble[0], 0.001 * squat + 1e-3 * wobble[1], LAYOUT, speed=speed, name="cfd"
    )


def test_steps_are_found_between_the_ramps():
    run = _run()
    steps = speed_steps(run.time, run.speed, shortest=200.0)
    assert [begin for begin, _ in steps] == pytest.approx([100.0, 500.0, 900.0], abs=4.0)
    assert [end for _, end in steps] == pytest.approx([470.0, 870.0, 1269.5], abs=4.0)


def test_each_step_is_averaged_over_its_last_part():
    reduced = reduce_speed_steps(_run(), shortest=200.0, last=100.0, depth=1.0, run="A1")
    assert [step.run for step in reduced] == ["A1 1", "A1 2", "A1 3"]
    for step, level in zip(reduced, LEVELS, strict=True):
        assert step.means["speed"].mean == pytest.approx(level, rel=1e-3)
        assert step.means["sinkage_midship"].mean == pytest.approx(0.02 * level**2, rel=5e-3)
        assert step.window.stop_time - step.window.start_time == pytest.approx(100.0, abs=1.0)


def test_runs_without_steps_are_named():
    run = _run()
    with pytest.raises(FitError, match="stays nowhere for 2000 s"):
        speed_steps(run.time, run.speed, shortest=2000.0)
    with pytest.raises(FitError, match=r"1 sample\(s\) hold no step"):
        speed_steps(run.time[:1], run.speed[:1], shortest=1.0)
    with pytest.raises(FitError, match="missing in places"):
        speed_steps(run.time, np.full_like(run.time, np.nan), shortest=1.0)
    with pytest.raises(FitError, match=r"cfd: step 1 stays for .* shorter than the 500 s"):
        reduce_speed_steps(run, shortest=200.0, last=500.0)
    with pytest.raises(FitError, match="speed steps need the speed"):
        reduce_speed_steps(
            SinkageRecord(run.time, run.midship, run.trim, LAYOUT, name="cfd"), shortest=200.0, last=100.0
        )
