import numpy as np
import pytest

from towtank.core.errors import AuditError, ReadError
from towtank.decay.decay_audit import audit_decay, repaired_time
from towtank.decay.decay_input import decay_from_table

TIME = np.arange(0.0, 40.0, 0.1)
ANGLE = 0.3 * np.exp(-0.02 * TIME) * np.cos(0.6 * TIME)


def spoilt(change: str) -> tuple[np.ndarray, np.ndarray]:
    time, angle = TIME.copy(), ANGLE.copy()
    if change == "too-short":
        return time[:2], angle[:2]
    if change == "not-finite":
        angle[7] = np.nan
    elif change == "time-not-rising":
        time[9] = time[8]
    elif change == "gap":
        keep = (time < 10.0) | (time > 12.0)
        return time[keep], angle[keep]
    elif change == "constant":
        angle[:] = 0.1
    elif change == "uneven-sampling":
        time[1::2] += 0.04
    return time, angle


@pytest.mark.parametrize("rule", ["too-short", "not-finite", "time-not-rising", "gap", "constant"])
def test_faults_stop_the_import(rule):
    time, angle = spoilt(rule)
    assert rule in [item.rule for item in audit_decay(time, angle, motion="roll", unit="rad")]
    with pytest.raises(AuditError, match=rf"\[{rule}\]"):
        decay_from_table({"time": time, "phi": angle}, unit="rad")


def test_a_sound_record_has_no_findings():
    assert audit_decay(TIME, ANGLE, motion="roll", unit="rad") == []


def test_uneven_samples_are_interpolated_and_told():
    time, _ = spoilt("uneven-sampling")
    angle = 0.3 * np.exp(-0.02 * time) * np.cos(0.6 * time)
    record = decay_from_table({"time": time, "phi": angle}, unit="rad")
    assert [item.rule for item in record.findings] == ["uneven-sampling"]
    assert np.ptp(np.diff(record.time)) < 1e-9
    exact = 0.3 * np.exp(-0.02 * record.time) * np.cos(0.6 * record.time)
    np.testing.assert_allclose(record.value, exact, atol=1e-6)


def test_lengths_must_agree():
    with pytest.raises(ReadError, match="differ in length"):
        repaired_time(TIME, {"value": ANGLE[:-1]})
