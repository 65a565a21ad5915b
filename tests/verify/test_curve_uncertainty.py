"""Curves at common points and pooled; harmonics with phases across the cut."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.verify import curve_uncertainty, harmonic_uncertainty, unwrapped_phases

H = (1.0, 1.5, 2.0)
X = np.linspace(1.0, 12.0, 6)


def curves(points=X, p=2.0):
    return [np.sin(points / 10.0) + 0.01 * h**p * points for h in H]


def test_second_order_curve_has_its_error_at_every_point():
    found = curve_uncertainty([X] * 3, curves(), H, quantity="Y", unit="N")
    assert found.uncertainty == pytest.approx(1.6 * 0.01 * X)
    assert list(found.table["point"]) == X.tolist()
    assert set(found.table["class"]) == {"monotone convergent"}
    assert found.oscillating == 0.0


def test_pooled_order_is_that_of_the_whole_curve():
    change, mean = curve_uncertainty([X] * 3, curves(p=1.5), H, quantity="Y").pooled
    assert (change.method, mean.method) == ("pooled change", "mean order")
    assert change.order == pytest.approx(1.5)
    assert mean.order == pytest.approx(1.5)
    assert mean.uncertainty == pytest.approx(1.25 * 0.01 * math.sqrt(np.mean(X**2)))
    assert change.behaviour == "monotone convergent"


def test_a_curve_that_mostly_oscillates_is_called_so():
    swinging = [np.sin(X / 10.0) + 0.01 * (-1.0) ** i * h**2 for i, h in enumerate(H)]
    found = curve_uncertainty([X] * 3, swinging, H, quantity="Y")
    assert found.oscillating == 1.0
    assert {one.behaviour for one in found.pooled} == {"oscillatory convergent"}
    assert "100 % of the points oscillate" in found.pooled[0].note
    assert {one.preferred.method for one in found.local} == {"data range"}


def test_only_common_points_count():
    coarse = X[::2]
    values = [curves()[0], curves()[1], curves(coarse)[2]]
    found = curve_uncertainty([X, X, coarse], values, H, quantity="Y")
    assert found.points.tolist() == coarse.tolist()
    assert "3 point(s)" in found.notes[0]


def test_interpolation_is_asked_for_and_stays_inside():
    other = np.linspace(2.0, 11.0, 10)
    values = [curves()[0], curves(other)[1], curves(other)[2]]
    with pytest.raises(TowtankError, match="no point in common"):
        curve_uncertainty([X, other + 0.03, other + 0.05], values, H)
    found = curve_uncertainty([X, other, other], values, H, interpolate=True)
    assert found.points.min() >= 2.0
    assert found.points.max() <= 11.0
    assert "straight lines" in found.notes[0]


def test_missing_values_leave_their_point_out():
    values = curves()
    values[1][2] = np.nan
    found = curve_uncertainty([X] * 3, values, H, quantity="Y")
    assert found.points.size == 5


def test_two_grids_have_no_pooled_order():
    found = curve_uncertainty([X] * 2, curves()[:2], H[:2], quantity="Y")
    assert found.pooled == ()
    assert math.isnan(found.oscillating)


def test_order_of_the_grids_does_not_matter():
    straight = curve_uncertainty([X] * 3, curves(), H)
    turned = curve_uncertainty([X] * 3, curves()[::-1], H[::-1])
    assert turned.uncertainty == pytest.approx(straight.uncertainty)


@pytest.mark.parametrize(
    ("points", "values", "words"),
    [([X] * 2, curves(), "sets of points"), ([X, X, X[:-1]], curves(), "grid 3 has 6 values at 5 points")],
)
def test_bad_input_is_named(points, values, words):
    with pytest.raises(TowtankError, match=words):
        curve_uncertainty(points, values, H, quantity="Y")


def test_phases_cross_the_cut():
    assert unwrapped_phases([179.0, -179.0, -170.0], [1, 2, 4], "deg") == pytest.approx([179.0, 181.0, 190.0])
    assert unwrapped_phases([-3.1, 3.1], [1, 2]) == pytest.approx([-3.1, 3.1 - 2.0 * math.pi])
    with pytest.raises(TowtankError, match="'turns'"):
        unwrapped_phases([0.0, 1.0], [1, 2], "turns")


def test_amplitude_and_phase_of_a_harmonic_converge_with_their_orders():
    h = np.array([1.0, 1.5, 2.0])
    phases = np.mod(359.0 + 1.0 * h**1.0 + 180.0, 360.0) - 180.0
    amplitude, phase = harmonic_uncertainty(
        1.0 + 0.1 * h**2, phases, h, quantity="heave", unit="m", phase_unit="deg"
    )
    assert amplitude["GCI Celik"].order == pytest.approx(2.0)
    assert phase["GCI Celik"].order == pytest.approx(1.0)
    assert phase.quantity == "heave phase"
    assert phase["GCI Celik"].uncertainty == pytest.approx(1.25)


def test_wrapped_phase_would_have_been_divergent():
    phases = [-179.5, 179.5, 177.0]
    _, phase = harmonic_uncertainty([1.0, 1.1, 1.3], phases, [1, 2, 4], phase_unit="deg")
    assert phase.behaviour == "monotone convergent"
    assert phase.preferred.uncertainty < 5.0


def test_negative_amplitude_is_refused():
    with pytest.raises(TowtankError, match="negative"):
        harmonic_uncertainty([1.0, -1.0, 1.0], [0, 0, 0], [1, 2, 4])
