"""Monitor files through the channel map."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.formats.channels import ChannelMap
from towtank.formats.log_channels import through_channels
from towtank.formats.solver_log import SolverLog

FRAME = pd.DataFrame({"time": [100.0, 200.0], "Force X": [1.5, 2.0], "Pitch": [180.0, 90.0], "n": [60.0, 120.0]})
UNITS = {"time": "ms", "Force X": "kN", "Pitch": "deg", "n": ""}
LOG = SolverLog("monitor", "monitor", FRAME, UNITS, (Path("m.csv"),))
COLUMNS = ("Force X", "time", "Pitch", "n")


def mapped(**channels: object) -> SolverLog:
    return through_channels(LOG, ChannelMap.model_validate(channels), COLUMNS)


def test_forces_in_si_with_their_sign():
    found = mapped(Fx_total={"column": "Force X", "sign": -1})
    assert found.kind == "forces"
    assert found.frame.to_numpy().tolist() == [[100.0, -1500.0], [200.0, -2000.0]]
    assert (list(found.frame.columns), found.units["Fx_total"]) == (["time", "Fx_total"], "N")
    assert found.notes == ("Fx_total: column Force X [kN], x -1 -> N",) or "x -1" in found.notes[0]


def test_other_channels_stay_a_monitor():
    found = mapped(theta="Pitch", propeller_rate={"column": "n", "unit": "rpm"})
    assert found.kind == "monitor"
    assert np.allclose(found.frame["theta"], [np.pi, np.pi / 2])
    assert found.frame["propeller_rate"].tolist() == [1.0, 2.0]
    assert (found.units["theta"], found.units["propeller_rate"]) == ("rad", "1/s")


def test_the_time_is_converted_when_it_is_mapped():
    found = mapped(time={"column": "Clock", "unit": "ms"}, Mz_total={"column": "n", "unit": "SI"})
    assert found.frame["time"].tolist() == [0.1, 0.2]
    assert found.units["Mz_total"] == "N m"


def test_a_column_by_its_number_in_the_file():
    assert mapped(Fx_total={"column": 1}).frame["Fx_total"].tolist() == [1500.0, 2000.0]


@pytest.mark.parametrize(
    ("channels", "cause"),
    [
        ({"Fx_total": "Force Y"}, "no column 'Force Y'"),
        ({"Mz_total": "n"}, "has no unit"),
        ({"X": "Pitch"}, "dimension"),
    ],
)
def test_columns_and_units_that_are_not_there(channels, cause):
    with pytest.raises(ReadError, match=cause):
        mapped(**channels)
