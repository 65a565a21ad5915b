"""The open measurement files, read as they were published."""

from pathlib import Path

import numpy as np
import pytest

from towtank.formats.channels import ChannelMap
from towtank.formats.read import read_table

DATA = Path(__file__).parents[3] / "shared" / "data"
pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="open measurement files are not here")


@pytest.mark.parametrize(
    ("name", "rows", "columns", "rolling", "step"),
    [("C1.dat", 4482, 17, "Nm", 0.05), ("C2.dat", 2035, 17, "Nm", 0.05), ("CW3.dat", 4352, 18, "°", 0.025)],
)
def test_squat_of_the_dtc(name, rows, columns, rolling, step):
    table = read_table(DATA / "squat_dtc_mashcon2019" / name)
    assert (len(table), len(table.columns)) == (rows, columns)
    assert table.dialect.encoding == "latin-1"
    assert table.units["psi"] == "°"
    assert table.units["roll"] == rolling
    assert table.findings == ()
    np.testing.assert_allclose(np.diff(table.columns["time"]), step, atol=1e-9)
    channels = {
        "time": "time",
        "x": "x0",
        "u": "u",
        "heave": "heave",
        "trim": "trim",
        "X": "X",
        "Y": "Y",
        "N": "N",
    }
    record = ChannelMap.model_validate(channels | {"theta": "trim", "psi": "psi"}).apply(table)
    np.testing.assert_allclose(record["heave"], table.columns["heave"] / 1000, rtol=1e-14)
    np.testing.assert_allclose(record["theta"], table.columns["trim"] / 1000, rtol=1e-14)


def test_first_and_last_values_of_the_squat_run():
    table = read_table(DATA / "squat_dtc_mashcon2019" / "C1.dat")
    assert [values[0] for values in table.columns.values()][:6] == [0.05, 0.0025, -0.0001, 0.0, 0.0, 0.0385]
    assert table.columns["WG4"][-1] == 0.0443


def test_roll_decay_of_the_kvlcc2():
    model = read_table(DATA / "decay_kvlcc2" / "model_test_21337.csv")
    assert list(model.columns) == ["time", "x", "y", "z", "phi", "theta", "psi"]
    assert len(model) == 9166
    assert model.columns["phi"][0] == 0.00017453292519943296
    potential = read_table(DATA / "decay_kvlcc2" / "fnpf_kvlcc2_rolldecay_0kn.csv")
    assert list(potential.columns) == ["Time", "phi", "phi1d", "phi2d", "V1"]
    assert len(potential) == 9000
    np.testing.assert_allclose(np.diff(potential.columns["Time"]), 0.02, atol=1e-9)


def test_squat_table_of_2009():
    table = read_table(DATA / "squat_lataire_2009" / "subset1.xls")
    np.testing.assert_array_equal(table.columns["speed"], [0.458, 0.572, 0.687, 0.801] * 2)
    assert table.units["speed"] == "m/s"
    assert table.columns["-0.92"][0] == pytest.approx(2.38861386)
    assert np.flatnonzero(np.isnan(table.columns["0.49"])).tolist() == [3, 7]
    assert [finding.rule for finding in table.findings] == ["text-column"]
