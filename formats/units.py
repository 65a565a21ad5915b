"""Units as laboratories print them, their factor to SI and their dimension.

The units of nearly every campaign stand in a table here, because importing and starting pint takes longer than
reading a run; any other unit is looked up with pint. All conversions are plain factors: a unit with an offset
(degrees Celsius) is refused.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from ..core.errors import ReadError

if TYPE_CHECKING:
    import pint


class Conversion(NamedTuple):
    """Factor from a unit to SI, and the dimension of the unit."""

    factor: float
    dimension: str


#: SI symbol of each dimension that is known by name.
SI_SYMBOLS = {
    "dimensionless": "-",
    "slope": "m/m",
    "angle": "rad",
    "time": "s",
    "length": "m",
    "velocity": "m/s",
    "acceleration": "m/s2",
    "angular velocity": "rad/s",
    "angular acceleration": "rad/s2",
    "frequency": "1/s",
    "revolution rate": "1/s",
    "force": "N",
    "moment": "N m",
    "mass": "kg",
    "moment of inertia": "kg m2",
    "density": "kg/m3",
    "pressure": "Pa",
    "area": "m2",
    "volume": "m3",
    "temperature": "K",
}

_DEGREE = math.pi / 180.0
_TURN = 2.0 * math.pi
_KNOT = 1852.0 / 3600.0
_GRAVITY = 9.80665

#: Commonest units in the spelling of pint: the table is proven equal to pint by a test.
FACTORS: dict[str, Conversion] = {
    "s": Conversion(1.0, "time"),
    "ms": Conversion(1e-3, "time"),
    "min": Conversion(60.0, "time"),
    "hour": Conversion(3600.0, "time"),
    "m": Conversion(1.0, "length"),
    "mm": Conversion(1e-3, "length"),
    "cm": Conversion(1e-2, "length"),
    "inch": Conversion(0.0254, "length"),
    "foot": Conversion(0.3048, "length"),
    "N": Conversion(1.0, "force"),
    "kN": Conversion(1e3, "force"),
    "MN": Conversion(1e6, "force"),
    "kgf": Conversion(_GRAVITY, "force"),
    "gram_force": Conversion(_GRAVITY * 1e-3, "force"),
    "metric_ton_force": Conversion(_GRAVITY * 1e3, "force"),
    "N*m": Conversion(1.0, "moment"),
    "N*mm": Conversion(1e-3, "moment"),
    "N*cm": Conversion(1e-2, "moment"),
    "kN*m": Conversion(1e3, "moment"),
    "MN*m": Conversion(1e6, "moment"),
    "kgf*m": Conversion(_GRAVITY, "moment"),
    "kgf*cm": Conversion(_GRAVITY * 1e-2, "moment"),
    "rad": Conversion(1.0, "angle"),
    "mrad": Conversion(1e-3, "angle"),
    "deg": Conversion(_DEGREE, "angle"),
    "gon": Conversion(math.pi / 200.0, "angle"),
    "rad/s": Conversion(1.0, "angular velocity"),
    "mrad/s": Conversion(1e-3, "angular velocity"),
    "deg/s": Conversion(_DEGREE, "angular velocity"),
    "deg/min": Conversion(_DEGREE / 60.0, "angular velocity"),
    "revolution/s": Conversion(_TURN, "angular velocity"),
    "revolution/min": Conversion(_TURN / 60.0, "angular velocity"),
    "rad/s^2": Conversion(1.0, "angular acceleration"),
    "deg/s^2": Conversion(_DEGREE, "angular acceleration"),
    "Hz": Conversion(1.0, "frequency"),
    "1/s": Conversion(1.0, "frequency"),
    "m/s": Conversion(1.0, "velocity"),
    "mm/s": Conversion(1e-3, "velocity"),
    "cm/s": Conversion(1e-2, "velocity"),
    "km/h": Conversion(1.0 / 3.6, "velocity"),
    "knot": Conversion(_KNOT, "velocity"),
    "m/s^2": Conversion(1.0, "acceleration"),
    "mm/s^2": Conversion(1e-3, "acceleration"),
    "standard_gravity": Conversion(_GRAVITY, "acceleration"),
    "g": Conversion(1e-3, "mass"),
    "kg": Conversion(1.0, "mass"),
    "metric_ton": Conversion(1e3, "mass"),
    "kg*m^2": Conversion(1.0, "moment of inertia"),
    "kg/m^3": Conversion(1.0, "density"),
    "metric_ton/m^3": Conversion(1e3, "density"),
    "Pa": Conversion(1.0, "pressure"),
    "m^2": Conversion(1.0, "area"),
    "m^3": Conversion(1.0, "volume"),
    "percent": Conversion(1e-2, "dimensionless"),
    "dimensionless": Conversion(1.0, "dimensionless"),
}

_SPELLINGS = {
    "-": "dimensionless",
    "--": "dimensionless",
    "1": "dimensionless",
    "m/m": "slope",
    "mm/m": "slope/1000",
    "%": "percent",
    "sec": "s",
    "secs": "s",
    "second": "s",
    "seconds": "s",
    "sek": "s",
    "msec": "ms",
    "h": "hour",
    "meter": "m",
    "metre": "m",
    "in": "inch",
    "ft": "foot",
    "newton": "N",
    "kp": "kgf",
    "gf": "gram_force",
    "tf": "metric_ton_force",
    "t": "metric_ton",
    "t/m^3": "metric_ton/m^3",
    "degree": "deg",
    "degrees": "deg",
    "radian": "rad",
    "radians": "rad",
    "rad/sec": "rad/s",
    "deg/sec": "deg/s",
    "rad*s^-1": "rad/s",
    "deg*s^-1": "deg/s",
    "rad/s/s": "rad/s^2",
    "deg/s/s": "deg/s^2",
    "rad*s^-2": "rad/s^2",
    "deg*s^-2": "deg/s^2",
    "s^-1": "1/s",
    "1/sec": "1/s",
    "rps": "revolution/s",
    "rev/s": "revolution/s",
    "rpm": "revolution/min",
    "rev/min": "revolution/min",
    "u/min": "revolution/min",
    "m*s^-1": "m/s",
    "m/sec": "m/s",
    "m*s^-2": "m/s^2",
    "m/s/s": "m/s^2",
    "kn": "knot",
    "kt": "knot",
    "kts": "knot",
    "knots": "knot",
    "kmh": "km/h",
    "kph": "km/h",
    "g_0": "standard_gravity",
}

# A slope is the tangent of a small trim or heel angle, which pint knows only as a plain ratio.
_SLOPES = {"slope": Conversion(1.0, "slope"), "slope/1000": Conversion(1e-3, "slope")}

_AMBIGUOUS = {
    "grad": "write 'deg' for degrees (the German Grad) or 'gon' for the 400th part of a turn",
    "KN": "write 'kN' for kilonewtons or 'kn' for knots",
    "Kn": "write 'kN' for kilonewtons or 'kn' for knots",
    "NM": "write 'N m' for newton-metres or 'nautical_mile'",
}

_SIGNS = str.maketrans(
    {
        "·": "*",
        "⋅": "*",
        "∙": "*",
        "•": "*",
        "×": "*",
        "²": "^2",
        "³": "^3",
        "⁻": "^-",
        "¹": "1",
        "−": "-",
        "–": "-",
        "µ": "u",
        "μ": "u",
        "°": "deg",
        "º": "deg",
        "˚": "deg",
        "Â": None,
    }
)

_BRACKETED = re.compile(r"^(?P<name>.*\S)\s*(?P<open>[\[(])(?P<unit>[^\[\]()]*)[\])]$")
_SLASHED = re.compile(r"^(?P<name>.*\S)\s+/\s+(?P<unit>\S+)$")


def strip_brackets(text: str) -> str:
    """The unit inside ``[N]``, ``(N)``, ``{N}`` or ``<N>``; other text as it is, without outer blanks."""
    text = text.strip()
    while len(text) >= 2 and text[0] + text[-1] in ("[]", "()", "{}", "<>"):
        text = text[1:-1].strip()
    return text


@lru_cache(maxsize=1024)
def normal_spelling(unit: str) -> str:
    """One spelling for the many that laboratories print: ``N·m``, ``N.m``, ``N-m`` and ``Nm`` become ``N*m``."""
    text = strip_brackets(unit).translate(_SIGNS).replace("**", "^")
    text = re.sub(r"\^-(\d)?\^?", r"^-\1", text)
    text = re.sub(r"\s*([*/^])\s*", r"\1", text)
    text = re.sub(r"(?<=[A-Za-z])[.\-](?=[A-Za-z])", "*", text)
    text = re.sub(r"(?<=[A-Za-z])(-?\d)", r"^\1", text)
    text = re.sub(r"\s+", "*", text)
    # Without this pint takes 'Nm' for the textile count of yarn, metres per gram.
    return re.sub(r"\b([kM]?N|kgf)([cm]?m)\b", r"\1*\2", text)


@lru_cache(maxsize=1024)
def conversion(unit: str) -> Conversion:
    """Factor to SI and dimension of a printed unit.

    Parameters
    ----------
    unit : str
        As printed: ``"kN"``, ``"[N·m]"``, ``"(°/s)"``, ``"rpm"``, ``"-"``. Upper-case spellings of the common
        units are understood where only one reading is possible.

    Returns
    -------
    Conversion
        ``factor``: SI value of one unit (angles in radians, revolutions as 2 pi radians); ``dimension``: a key of
        `SI_SYMBOLS`, or the SI base units of a dimension without a name here.

    Raises
    ------
    ReadError
        If the unit is empty, unknown, ambiguous (``grad``, ``KN``), or not a plain factor (``degC``).
    """
    bare = strip_brackets(unit)
    if not bare:
        raise ReadError("there is no unit", cure="give one, e.g. 'N', or 'SI' where the values are in SI")
    if bare in _AMBIGUOUS or bare.lower() == "grad":
        raise ReadError(f"unit '{bare}' has two readings", cure=_AMBIGUOUS.get(bare, _AMBIGUOUS["grad"]))
    known = _tabulated(bare)
    return known if known is not None else _from_pint(bare)


def _tabulated(unit: str) -> Conversion | None:
    text = normal_spelling(unit)
    for spelling in (text, text.lower()):
        spelling = _SPELLINGS.get(spelling, spelling)
        if spelling in _SLOPES:
            return _SLOPES[spelling]
        if spelling in FACTORS:
            return FACTORS[spelling]
    return None


def _from_pint(unit: str) -> Conversion:
    registry = _registry()
    try:
        one = registry.Quantity(1.0, normal_spelling(unit)).to_base_units()
        zero = registry.Quantity(0.0, normal_spelling(unit)).to_base_units()
    # pint evaluates the text as an expression: a malformed one raises nearly anything.
    except Exception as error:
        raise ReadError(
            f"unit '{unit}' is unknown", cure="use a unit such as N, kN, N m, m/s, mm, deg, rad/s, rpm"
        ) from error
    if zero.magnitude != 0.0:
        raise ReadError(
            f"unit '{unit}' has an offset and is no plain factor",
            cure="give unit = 'SI' and, if you need kelvins, the offset",
        )
    base = str(one.units)
    return Conversion(float(one.magnitude), _dimension_names().get(base, base))


@lru_cache(maxsize=1)
def _registry() -> pint.UnitRegistry:
    import pint

    return pint.UnitRegistry()


@lru_cache(maxsize=1)
def _dimension_names() -> dict[str, str]:
    """Base units as pint prints them, and the dimension that they stand for."""
    symbols = {name: text.replace(" ", "*") for name, text in SI_SYMBOLS.items()}
    names = {}
    for dimension, symbol in symbols.items():
        if dimension in {"slope", "revolution rate"}:
            continue
        spelled = "dimensionless" if symbol == "-" else normal_spelling(symbol)
        names[str(_registry().Quantity(1.0, spelled).to_base_units().units)] = dimension
    return names


def convertible(unit: str, dimension: str) -> float | None:
    """Factor from `unit` to the SI unit of `dimension`; None if the unit is of another dimension.

    Three pairs that are the same in base units but not for the engineer are treated by name: a yaw rate printed
    in ``1/s`` is in rad/s, but one in ``Hz`` is refused; a propeller rate in ``rpm`` or ``rad/s`` is turned into
    revolutions per second; a trim or heel printed as a slope (``mm/m``) is taken as a small angle.
    """
    factor, own = conversion(unit)
    if own == dimension:
        return factor
    if dimension == "revolution rate":
        return factor if own == "frequency" else factor / _TURN if own == "angular velocity" else None
    if dimension == "angular velocity" and own == "frequency":
        return factor if _common_spelling(unit) == "1/s" else None
    if dimension == "angular acceleration" and normal_spelling(unit) in {"1/s^2", "s^-2"}:
        return factor
    if dimension == "angle" and own == "slope":
        return factor
    return None


def counts_revolutions(unit: str) -> bool:
    """Whether a unit counts turns (``rpm``, ``rps``, ``rev/s``) and not radians."""
    return _common_spelling(unit).startswith("revolution")


def _common_spelling(unit: str) -> str:
    text = normal_spelling(unit).lower()
    return _SPELLINGS.get(text, text)


def looks_like_unit(text: str) -> bool:
    """Whether a header cell is a unit: bracketed, ``-``, or a unit of the table."""
    text = text.strip()
    bare = strip_brackets(text)
    if not bare:
        return False
    return bare != text or bare in _AMBIGUOUS or bare.lower() == "grad" or _tabulated(bare) is not None


def split_name(heading: str) -> tuple[str, str]:
    """Name and unit of a heading such as ``Fx [N]``, ``Fx (N)`` or ``Fx / N``; the unit is empty if there is none.

    Square brackets always hold a unit; round ones and the stroke only if what they hold is a known unit, so
    that ``Force (bow)`` and ``Gauge (1)`` stay one name.
    """
    heading = heading.strip()
    match = _BRACKETED.match(heading)
    if match and (match["open"] == "[" or (looks_like_unit(match["unit"]) and match["unit"].strip() != "1")):
        return match["name"], match["unit"].strip()
    match = _SLASHED.match(heading)
    if match and looks_like_unit(match["unit"]):
        return match["name"], match["unit"]
    return heading, ""
