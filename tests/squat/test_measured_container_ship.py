"""Formulas against the open measurements of an 8000 TEU container ship over a sloping bank (Antwerp 2009)."""

from pathlib import Path

import numpy as np
import pytest

from towtank.core.ship import Ship
from towtank.formats import read_table
from towtank.squat.fairway import Fairway
from towtank.squat.prediction import predict
from towtank.verify import relative_errors

FILE = Path(__file__).resolve().parents[3] / "shared" / "data" / "squat_lataire_2009" / "subset1.xls"
SCALE = 80.7
SHIP = Ship("8000 TEU", L=4.01, B=0.53, T=0.18, volume=0.66 * 4.01 * 0.53 * 0.18, scale=SCALE)
SPEED = np.array([0.458, 0.572, 0.687, 0.801])

# Full-scale metres at 8, 10, 12 and 14 kn
SAMPLES = {
    ("icorels", "bow"): (0.198, 0.318, 0.476, 0.678),
    ("icorels-2.4", "bow"): (0.280, 0.449, 0.672, 0.957),
    ("barrass-2", "largest"): (0.308, 0.489, 0.716, 0.985),
    ("barrass-3", "largest"): (0.422, 0.658, 0.950, 1.291),
    ("tuck-hooft", "bow"): (0.229, 0.367, 0.549, 0.782),
    ("yoshimura", "bow"): (0.285, 0.445, 0.642, 0.873),
    ("eryuzlu", "bow"): (0.282, 0.470, 0.714, 1.015),
    ("roemisch", "bow"): (0.146, 0.227, 0.328, 0.451),
    ("millward", "bow"): (0.295, 0.505, 0.811, 1.239),
    ("norrbin", "bow"): (0.276, 0.430, 0.620, 0.843),
    ("ankudinov", "bow"): (0.339, 0.505, 0.707, 0.943),
}


@pytest.fixture(scope="module")
def found():
    return predict(SHIP, 0.243, SPEED)


@pytest.mark.parametrize(("formula", "place"), SAMPLES)
def test_samples_at_full_scale(found, formula, place):
    values = SCALE * found.of(formula, "maximum" if place == "largest" else place)
    np.testing.assert_allclose(values, SAMPLES[formula, place], rtol=1e-3, atol=6e-4)


@pytest.fixture(scope="module")
def measured():
    """Bow and stern sinkage in m of the ship at y0 = 0, from the open file."""
    if not FILE.exists():
        pytest.skip("open measurements are not here")
    sinkage = read_table(FILE).columns["0"] / 1000.0
    return {"bow": sinkage[:4], "stern": sinkage[4:], "middle": 0.5 * (sinkage[:4] + sinkage[4:])}


@pytest.mark.parametrize(
    ("formula", "predicted", "against", "errors"),
    [
        ("tuck-hooft", "bow", "bow", (-2.1, -5.1, -12.1, -6.3)),
        ("barrass-3", "maximum", "middle", (87.0, 78.0, 58.6, 31.2)),
        ("roemisch", "bow", "bow", (-37.6, -41.3, -47.4, -46.0)),
        ("icorels", "bow", "middle", (-12.4, -14.1, -20.5, -31.1)),
        ("norrbin", "bow", "middle", (22.1, 16.2, 3.5, -14.3)),
    ],
)
def test_verdicts_of_the_measured_ship_in_per_cent(found, measured, formula, predicted, against, errors):
    scores = relative_errors(found.of(formula, predicted), measured[against]).s_minus_d
    # the references come from metres rounded to the millimetre
    np.testing.assert_allclose(scores, errors, atol=0.6)


def test_stern_at_the_highest_speed_is_above_all_but_three(found, measured):
    last = found.table[found.table["speed"] == SPEED[-1]].set_index("formula")["maximum"]
    above = set(last[last > measured["stern"][-1]].index)
    assert above == {"barrass-3", "millward", "eryuzlu-hausser"}


def test_huuska_with_the_section_of_the_tank_and_its_bank():
    channel = Fairway(0.243, area=1.2155, top_width=6.0)
    values = SCALE * predict(SHIP, 0.243, SPEED, channel=channel).of("huuska", "bow")
    np.testing.assert_allclose(values, (0.374, 0.599, 0.896, 1.276), rtol=1e-3)
