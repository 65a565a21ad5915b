"""What the errors of the RANS paper say of the measurements."""

import pytest

KEY = "dtc-rans-measured"


@pytest.mark.parametrize(
    ("condition", "quantity", "value"),
    [
        ("calm", "z0/L", -0.16705),
        ("calm", "trim", -0.83547),
        ("calm", "Ct", 5.2198),
        ("waves", "heave", 0.1778),
        ("waves", "z0/L", -0.1772),
        ("waves", "pitch", 0.0452),
        ("waves", "Caw", 2.3856),
        ("waves", "wave amplitude", 0.9587),
    ],
)
def test_measured_values_follow_from_the_errors(find, condition, quantity, value):
    case = find(KEY, f"measured {quantity} that", condition)
    assert case.printed == value
    assert case.verdict == "reproduced"


def test_half_the_wave_height_is_the_amplitude(find):
    half = find(KEY, "Caw with half the height")
    whole = find(KEY, "Caw with the whole height")
    assert half.computed == pytest.approx(4.0 * whole.computed)
    assert half.computed == pytest.approx(2.3856, rel=0.06)
