"""A model held against its ship: files and terminal."""

import json

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.report.scaling_outputs import Scaling, require_scaling_folder, scaling_text, write_scaling
from towtank.squat.scaling_error import scaling_errors
from towtank.squat.squat_curve import SquatCurve
from towtank.squat.tabled_curve import TabledCurve

SPEED = np.array([3.0, 4.0, 5.0, 6.0])


@pytest.fixture
def scaling() -> Scaling:
    """The ship sinks 5 % less at the bow, and as much at the stern."""
    bow, stern = 0.01 * SPEED**2, 0.008 * SPEED**2
    ship = SquatCurve(
        pd.DataFrame({"speed": SPEED, "sinkage_bow": 0.95 * bow, "sinkage_stern": stern}), 18.0, 14.5
    )
    model = SquatCurve(
        pd.DataFrame(
            {"speed": SPEED[:3] / np.sqrt(40), "sinkage_bow": bow[:3] / 40, "sinkage_stern": stern[:3] / 40}
        ),
        0.45,
        0.3625,
        scale=40.0,
    )
    return Scaling(
        TabledCurve(model, "model.csv", "a"), TabledCurve(ship, "ship.csv", "b"), scaling_errors(model, ship)
    )


def test_files_hold_errors_and_clearance(scaling, tmp_path):
    written = write_scaling(scaling, tmp_path / "out")
    assert {path.name for path in written} == {
        "scaling_errors.csv", "scaling_clearance.csv", "scaling.json", "provenance.json",
    }  # fmt: skip
    table = pd.read_csv(tmp_path / "out" / "scaling_errors.csv")
    bow = table[table["quantity"] == "sinkage_bow"]
    np.testing.assert_allclose(bow["error"], -0.05 * 0.01 * SPEED[:3] ** 2)
    data = json.loads((tmp_path / "out" / "scaling.json").read_text())
    assert (data["scale"], data["outside"]) == (40.0, 1)
    provenance = json.loads((tmp_path / "out" / "provenance.json").read_text())
    assert provenance["inputs"] == {"model.csv": "a", "ship.csv": "b"}


def test_the_terminal_says_signs_percent_and_what_is_outside(scaling):
    text = scaling_text(scaling)
    assert "model.csv at 1:40 against ship.csv: depth 18 m, h/T 1.24" in text
    assert "-5.3" in text  # five of ninety-five
    assert "1 speed(s) of the ship lie outside the model's; nothing is extrapolated" in text
    assert text.endswith("error: ship less model by Froude's law; sinkage positive down, trim by the bow")


def test_results_of_another_kind_are_kept(tmp_path):
    (tmp_path / "provenance.json").write_text('{"format": "towtank scores provenance 1", "files": []}')
    with pytest.raises(TowtankError, match="results of another kind"):
        require_scaling_folder(tmp_path)
