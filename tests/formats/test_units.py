import math
import subprocess
import sys

import pytest

from towtank.core.errors import ReadError
from towtank.formats.units import (
    FACTORS,
    SI_SYMBOLS,
    conversion,
    convertible,
    counts_revolutions,
    looks_like_unit,
    normal_spelling,
    split_name,
)


@pytest.fixture(scope="module")
def registry():
    import pint

    return pint.UnitRegistry()


@pytest.mark.parametrize("spelling", FACTORS)
def test_table_equals_pint(spelling, registry):
    quantity = registry.Quantity(1.0, spelling).to_base_units()
    assert FACTORS[spelling].factor == pytest.approx(quantity.magnitude, rel=1e-14)
    symbol = normal_spelling(SI_SYMBOLS[FACTORS[spelling].dimension])
    si = registry.Quantity(1.0, "dimensionless" if symbol == "-" else symbol).to_base_units()
    assert quantity.units == si.units


@pytest.mark.parametrize(
    ("printed", "factor", "dimension"),
    [
        ("N", 1.0, "force"),
        ("[N]", 1.0, "force"),
        ("(N)", 1.0, "force"),
        ("kN", 1e3, "force"),
        ("kgf", 9.80665, "force"),
        ("kp", 9.80665, "force"),
        ("Nm", 1.0, "moment"),
        ("N·m", 1.0, "moment"),
        ("N.m", 1.0, "moment"),
        ("N*m", 1.0, "moment"),
        ("N m", 1.0, "moment"),
        ("N-m", 1.0, "moment"),
        ("kNm", 1e3, "moment"),
        ("Nmm", 1e-3, "moment"),
        ("kgf.m", 9.80665, "moment"),
        ("deg", math.pi / 180, "angle"),
        ("°", math.pi / 180, "angle"),
        ("º", math.pi / 180, "angle"),
        ("Â°", math.pi / 180, "angle"),
        ("DEG", math.pi / 180, "angle"),
        ("rad", 1.0, "angle"),
        ("deg/s", math.pi / 180, "angular velocity"),
        ("°/s", math.pi / 180, "angular velocity"),
        ("[° / s]", math.pi / 180, "angular velocity"),
        ("rad/s", 1.0, "angular velocity"),
        ("rad/s²", 1.0, "angular acceleration"),
        ("rad/s^2", 1.0, "angular acceleration"),
        ("deg/s2", math.pi / 180, "angular acceleration"),
        ("rad s⁻²", 1.0, "angular acceleration"),
        ("m/s", 1.0, "velocity"),
        ("M/S", 1.0, "velocity"),
        ("m s-1", 1.0, "velocity"),
        ("m/s**2", 1.0, "acceleration"),
        ("mm", 1e-3, "length"),
        ("cm", 1e-2, "length"),
        ("kn", 1852 / 3600, "velocity"),
        ("kts", 1852 / 3600, "velocity"),
        ("knots", 1852 / 3600, "velocity"),
        ("km/h", 1 / 3.6, "velocity"),
        ("Hz", 1.0, "frequency"),
        ("1/s", 1.0, "frequency"),
        ("s^-1", 1.0, "frequency"),
        ("rpm", 2 * math.pi / 60, "angular velocity"),
        ("rps", 2 * math.pi, "angular velocity"),
        ("s", 1.0, "time"),
        ("sec", 1.0, "time"),
        ("ms", 1e-3, "time"),
        ("-", 1.0, "dimensionless"),
        ("[-]", 1.0, "dimensionless"),
        ("%", 1e-2, "dimensionless"),
        ("mm/m", 1e-3, "slope"),
        ("t", 1e3, "mass"),
        ("kg m²", 1.0, "moment of inertia"),
        ("kg.m2", 1.0, "moment of inertia"),
        ("kg/m³", 1.0, "density"),
    ],
)
def test_units_as_laboratories_print_them(printed, factor, dimension):
    found = conversion(printed)
    assert found.factor == pytest.approx(factor, rel=1e-15)
    assert found.dimension == dimension


@pytest.mark.parametrize(
    ("printed", "factor", "dimension"),
    [("lbf", 4.4482216152605, "force"), ("lbf ft", 1.3558179483314, "moment"), ("um", 1e-6, "length")],
)
def test_other_units_come_from_pint(printed, factor, dimension):
    found = conversion(printed)
    assert found.factor == pytest.approx(factor, rel=1e-12)
    assert found.dimension == dimension


def test_dimension_without_a_name_is_given_in_base_units():
    assert conversion("N/m^2/s").dimension == "kilogram / meter / second ** 3"


@pytest.mark.parametrize("printed", ["grad", "Grad", "[grad]", "KN", "NM"])
def test_ambiguous_units_are_refused(printed):
    with pytest.raises(ReadError, match="has two readings -> write"):
        conversion(printed)


@pytest.mark.parametrize("printed", ["quux", "N m)", "kg m**", "1/0"])
def test_unknown_units_are_refused(printed):
    with pytest.raises(ReadError, match="is unknown"):
        conversion(printed)


def test_missing_unit_is_refused():
    with pytest.raises(ReadError, match="there is no unit"):
        conversion(" [] ")


def test_unit_with_an_offset_is_refused():
    with pytest.raises(ReadError, match="has an offset"):
        conversion("degC")


@pytest.mark.parametrize(
    ("printed", "dimension", "factor"),
    [
        ("rpm", "revolution rate", 1 / 60),
        ("rps", "revolution rate", 1.0),
        ("Hz", "revolution rate", 1.0),
        ("rad/s", "revolution rate", 1 / (2 * math.pi)),
        ("rpm", "angular velocity", 2 * math.pi / 60),
        ("1/s", "angular velocity", 1.0),
        ("Hz", "angular velocity", None),
        ("1/s2", "angular acceleration", 1.0),
        ("mm/m", "angle", 1e-3),
        ("-", "angle", None),
        ("kg", "force", None),
        ("mm", "velocity", None),
        ("kN", "force", 1e3),
    ],
)
def test_conversion_to_the_expected_dimension(printed, dimension, factor):
    found = convertible(printed, dimension)
    assert found == (None if factor is None else pytest.approx(factor, rel=1e-15))


def test_common_units_do_not_import_pint():
    code = (
        "import sys; from towtank.formats.units import conversion;"
        "[conversion(u) for u in ('N', 'kN', 'N·m', '°/s', 'rpm', 'mm', '-', 'knots', 'kg m2')];"
        "assert 'pint' not in sys.modules"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    ("text", "is_unit"),
    [("[anything]", True), ("N", True), ("-", True), ("grad", True), ("Fx", False), ("", False), ("12.5", False)],
)
def test_header_cells_that_look_like_units(text, is_unit):
    assert looks_like_unit(text) is is_unit


@pytest.mark.parametrize(
    ("heading", "name", "unit"),
    [
        ("Fx [N]", "Fx", "N"),
        ("Fx[kN]", "Fx", "kN"),
        ("Fx (N)", "Fx", "N"),
        ("Yaw rate [deg/s] ", "Yaw rate", "deg/s"),
        ("Fx / N", "Fx", "N"),
        ("Fx [raw]", "Fx", "raw"),
        ("Force (bow)", "Force (bow)", ""),
        ("Gauge (1)", "Gauge (1)", ""),
        ("lift / drag", "lift / drag", ""),
        ("[N]", "[N]", ""),
        ("Fx", "Fx", ""),
    ],
)
def test_units_are_split_from_names(heading, name, unit):
    assert split_name(heading) == (name, unit)


def test_revolutions_are_told_from_radians():
    assert counts_revolutions("rpm")
    assert counts_revolutions("[rev/s]")
    assert not counts_revolutions("rad/s")
