from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.ship import Ship
from towtank.decay.decay_input import decay_from_table, read_decay
from towtank.decay.derivation_fit import fit_derivation
from towtank.decay.energy_method import fit_energy_method

DATA = Path(__file__).resolve().parents[3] / "shared" / "data" / "decay_kvlcc2"


def table(**changes: np.ndarray) -> dict[str, np.ndarray]:
    time = np.arange(0.0, 40.0, 0.1)
    return {"time": time, "phi": 0.3 * np.exp(-0.02 * time) * np.cos(0.6 * time), **changes}


def test_full_scale_by_froude(make_decay, literature):
    model = replace(make_decay(literature), scale=25.0, speed=0.5)
    full = model.at_scale(1.0)
    np.testing.assert_allclose(full.time, 5.0 * model.time)
    np.testing.assert_array_equal(full.value, model.value)
    assert full.speed == pytest.approx(2.5)
    assert full.period == pytest.approx(5.0 * model.period, rel=1e-9)
    heave = decay_from_table(table(), angle="phi", unit="m", motion="heave", scale=25.0).at_scale(1.0)
    assert heave.value[0] == pytest.approx(25.0 * 0.3)
    with pytest.raises(FitError, match="not positive"):
        model.at_scale(0.0)


def test_rest_position_and_drift_are_taken_off(make_decay, literature):
    record = make_decay(literature, offset=0.02)
    np.testing.assert_allclose(record.centred().value, record.value - 0.02, atol=2e-4)
    drifting = replace(record, value=record.value + 2e-4 * record.time)
    np.testing.assert_allclose(drifting.centred("drift").value, make_decay(literature).value, atol=6e-4)
    assert record.centred("none") is record
    with pytest.raises(FitError, match="offset 'mean' is unknown"):
        record.centred("mean")


def test_filter_delays_nothing(make_decay, literature):
    noisy = make_decay(literature, noise=0.2, correlation=0.0)
    clean = make_decay(literature).value
    filtered = noisy.filtered()
    assert "forward and backward" in filtered.steps[-1]
    assert np.std(filtered.value - clean) < 0.6 * np.std(noisy.value - clean)
    lag = np.argmax(np.correlate(filtered.value[100:-100], clean[100:-100], "full")) - (clean.size - 201)
    assert lag == 0


def test_cut_by_time_and_automatically(make_decay, literature):
    record = make_decay(literature)
    cut = record.free_part(start=5.0, end=40.0)
    assert (cut.time[0], cut.time[-1]) == (pytest.approx(5.0), pytest.approx(40.0))
    assert cut.whole is record
    late = record.free_part(first_amplitude=0.25)
    assert np.abs(late.value).max() < 0.3
    early = record.free_part(last_amplitude=0.2)
    assert early.time[-1] < record.time[-1] / 2.0
    with pytest.raises(FitError, match="lie between"):
        record.free_part(start=59.8)


def test_derivatives_are_those_of_the_motion(make_decay, literature):
    record = make_decay(literature, step=0.05).with_derivatives()
    x, v, a = record.value, record.rate, record.acceleration
    balance = a + 0.04 * v + 0.15 * np.abs(v) * v + 0.3 * v**3 + 0.36 * x
    assert np.abs(balance).max() < 5e-3 * np.abs(a).max()


def test_derivatives_of_a_record_that_begins_at_the_release_are_fit_to_use(make_decay):
    """The ends that the filter falsifies are gone: both estimators that take the derivatives stay right."""
    coefficients = (0.04, 0.2, 0.0, 0.36, 0.0, 0.0)
    record = make_decay(coefficients, step=0.05)
    derived = record.with_derivatives()
    lost = round(0.5 * record.period / 0.05)
    assert derived.time[0] == pytest.approx(record.time[lost])
    assert f"{lost} samples dropped at both ends" in derived.steps[-1]
    for fit in (fit_derivation, fit_energy_method):
        result = fit(derived)
        assert result.findings == () or {item.rule for item in result.findings} == {"inseparable"}
        np.testing.assert_allclose(result.values, [0.04, 0.2, 0.36], rtol=0.015)
    with pytest.raises(FitError, match="left between the ends"):
        make_decay(coefficients, duration=11.0).with_derivatives()


@pytest.mark.skipif(not DATA.is_dir(), reason="open measurements are not here")
def test_kvlcc2_model_test_starts_where_it_is_free():
    ship = Ship("KVLCC2", 320.0, 58.0, 20.8, volume=312653.0, GM=5.73, kxx=23.2, rho=1000.0)
    record = read_decay(DATA / "model_test_21337.csv", unit="rad", scale=68.0, ship=ship)
    free = record.free_part().centred()
    assert free.time[0] == pytest.approx(26.2, abs=0.05)
    assert "taken for pushes" in free.steps[0]
    assert record.findings == ()
    wrong = read_decay(DATA / "model_test_21337.csv", unit="rad", scale=1.0, ship=ship)
    assert [item.rule for item in wrong.findings] == ["period-against-ship"]
