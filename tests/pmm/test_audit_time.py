"""The time channel: each fault, and clocks that are sound."""

import numpy as np
import pytest

from towtank.pmm.audit_time import audit_time

EVEN = np.arange(0.0, 20.0, 0.01)


def found(time):
    findings, usable = audit_time(time)
    return {item.rule: item.severity for item in findings}, usable


@pytest.mark.parametrize(
    "time", [EVEN, EVEN + 1.0e6, EVEN[:12], np.round(EVEN, 2), 7.0 + np.arange(2000) / 300.0], ids=str
)
def test_even_clocks_are_clean(time):
    assert found(time) == ({}, True)


def test_a_few_samples_are_no_record():
    assert found(np.array([0.0, 0.1])) == ({"too-short": "error"}, False)


def test_missing_time():
    time = EVEN.copy()
    time[5] = np.nan
    assert found(time) == ({"missing-values": "error"}, False)


def test_time_that_runs_backwards():
    assert found(EVEN[::-1]) == ({"time-not-increasing": "error"}, False)
    shuffled = np.random.default_rng(0).permutation(EVEN)
    assert found(shuffled) == ({"time-not-increasing": "error"}, False)
    assert found(np.zeros(50)) == ({"time-not-increasing": "error"}, False)


def test_a_restarted_run_overlaps():
    time = np.concatenate([EVEN[:1000], EVEN[800:]])
    findings, usable = audit_time(time)
    assert [item.rule for item in findings] == ["time-overlap"]
    assert "200 sample(s) overlap" in findings[0].message
    assert not usable


@pytest.mark.parametrize(("count", "severity"), [(3, "warning"), (100, "error")])
def test_repeated_stamps(count, severity):
    time = np.sort(np.concatenate([EVEN, EVEN[100 : 100 + count]]))
    assert found(time) == ({"time-duplicated": severity}, True)


@pytest.mark.parametrize(("step", "decimals", "severity"), [(0.013, 2, "warning"), (1 / 300, 2, "error")])
def test_rounded_stamps(step, decimals, severity):
    time = np.round(np.arange(2000) * step, decimals)
    assert found(time) == ({"time-rounded": severity}, True)


@pytest.mark.parametrize(("missing", "severity"), [(2, "warning"), (40, "error")])
def test_gaps(missing, severity):
    time = np.delete(EVEN, np.arange(500, 500 + missing))
    findings, usable = audit_time(time)
    assert [(item.rule, item.severity) for item in findings] == [("gap", severity)]
    assert f"{missing} sample(s) are missing in 1 gap(s)" in findings[0].message
    assert usable


def test_uneven_sampling():
    stretched = 20.0 * (EVEN / 20.0) ** 1.3
    assert found(stretched) == ({"non-uniform-sampling": "warning"}, True)
    jitter = EVEN + np.random.default_rng(1).uniform(-0.003, 0.003, EVEN.size)
    assert found(jitter) == ({"non-uniform-sampling": "warning"}, True)
