"""Tables of radiation from files: columns, units, scale, and what is no such table."""

import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import FitError, ReadError
from towtank.decay.radiation_table import RadiationTable, inertia_factor, read_radiation
from towtank.decay.transfer_function import TransferFunction

MEMORY = TransferFunction(np.array([6e8, 0.0]), np.array([1.0, 0.6, 0.5]))
OMEGA = np.linspace(0.05, 6.0, 80)
DAMPING = MEMORY.damping(OMEGA)
MASS = 2e10 + MEMORY.added_mass_difference(OMEGA)


def write(path, **columns):
    pd.DataFrame(columns).to_csv(path, index=False)
    return path


def test_usual_names_are_found_and_units_heeded(tmp_path):
    file = write(
        tmp_path / "b.csv",
        **{"frequency [Hz]": OMEGA / (2.0 * math.pi), "B44 [kN m s]": DAMPING / 1e3, "A44 [t m2]": MASS / 1e3},
    )
    table = read_radiation(file, scale=2.0)
    np.testing.assert_allclose(table.frequency, OMEGA)
    np.testing.assert_allclose(table.damping, DAMPING)
    np.testing.assert_allclose(table.added_mass, MASS)
    assert (table.scale, len(table.sha256)) == (2.0, 64)


def test_named_columns_without_units_are_si(tmp_path):
    file = write(tmp_path / "b.csv", w=OMEGA, wave=DAMPING)
    table = read_radiation(file, damping="wave", infinite=2e10)
    np.testing.assert_array_equal(table.damping, DAMPING)
    assert table.added_mass is None
    assert table.infinite == 2e10


def test_memory_comes_back():
    fit = RadiationTable(OMEGA, DAMPING, MASS).identify()
    assert fit.order == 2
    np.testing.assert_allclose(fit.function.denominator, MEMORY.denominator, rtol=1e-8)
    assert fit.infinite == pytest.approx(2e10, rel=1e-8)
    alone = RadiationTable(np.concatenate([[0.0], OMEGA]), np.concatenate([[0.0], DAMPING])).identify()
    assert alone.r2_damping > 0.99
    assert alone.infinite == 0.0


@pytest.mark.parametrize(("motion", "power"), [("roll", 5), ("heave", 3)])
def test_scale_keeps_the_decay(motion, power):
    """The memory of a model is that of the ship in shorter seconds: K over inertia and time keeps its shape."""
    full = RadiationTable(OMEGA, DAMPING, MASS, 2e10, motion)
    model = full.at_scale(49.0)
    np.testing.assert_allclose(model.frequency, 7.0 * OMEGA)
    np.testing.assert_allclose(model.added_mass, MASS / 49.0**power)
    np.testing.assert_allclose(model.damping / model.added_mass, 7.0 * DAMPING / MASS)
    assert model.infinite == pytest.approx(2e10 / 49.0**power)
    assert inertia_factor(motion, 2.0) == 2.0**power
    np.testing.assert_allclose(model.at_scale(1.0).damping, DAMPING)
    with pytest.raises(FitError, match="not positive"):
        full.at_scale(-1.0)


@pytest.mark.parametrize(
    ("columns", "options", "message"),
    [
        ({"x": OMEGA, "B44": DAMPING}, {}, r"b\.csv: .*no column 'omega or frequency or w' of frequency.*x, B44"),
        ({"omega": OMEGA, "B33": DAMPING}, {}, "no column 'B44 or B' of damping"),
        ({"omega": OMEGA, "B44": DAMPING}, {"added_mass": "A"}, "no column 'A' of added mass"),
        ({"omega": OMEGA[::-1], "B": DAMPING}, {}, r"b\.csv, column omega: .*do not rise"),
        ({"omega": OMEGA, "B": -DAMPING}, {}, "nowhere positive"),
        ({"omega": OMEGA, "B [N]": DAMPING}, {}, r"column B: unit 'N' is no unit of 'B' -> give it in N m s"),
        (
            {"omega": OMEGA, "B": np.where(OMEGA > 3.0, np.nan, DAMPING)},
            {},
            "'B' holds values that are not finite",
        ),
    ],
)
def test_what_is_no_table_is_refused(columns, options, message, tmp_path):
    file = write(tmp_path / "b.csv", **columns)
    with pytest.raises(ReadError, match=message):
        read_radiation(file, **options)
