"""Several manoeuvres of one ship."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.simulate.environment import Current, Environment
from towtank.simulate.manoeuvres import course_keeping, turning, zigzag
from towtank.simulate.manoeuvring_results import COLUMNS, percentages, sail_manoeuvres
from towtank.simulate.ships import named_ship


@pytest.fixture(scope="module")
def results():
    programmes = [turning(35.0), turning(-35.0), zigzag(20.0), course_keeping(20.0)]
    return sail_manoeuvres(named_ship("kvlcc2"), programmes, draws=20, percent=5.0, seed=1)


def test_the_table_has_every_index_with_its_spread(results):
    frame = results.indices_frame()
    assert tuple(frame.columns) == COLUMNS
    assert set(frame["manoeuvre"]) == {"turning +35", "turning -35", "zigzag +20/20"}
    assert (frame["sd"] > 0.0).mean() > 0.9
    inside = (frame["p05"] <= frame["value"]) & (frame["value"] <= frame["p95"])
    assert inside.mean() > 0.9


def test_verdicts_take_the_worse_side_and_the_draws(results):
    frame = results.indices_frame().set_index(["manoeuvre", "index"])["value"]
    imo = results.imo_frame().set_index("criterion")
    worse = max(frame["turning +35", "advance"], frame["turning -35", "advance"])
    assert imo.loc["turning: advance", "value"] == pytest.approx(worse)
    assert imo.loc["turning: advance", "probability"] == 1.0
    assert imo.loc["initial turning", "verdict"] == "not tested"
    assert np.isnan(imo.loc["initial turning", "probability"])
    assert results.imo_frame().attrs["notes"]


def test_without_draws_there_is_no_spread():
    results = sail_manoeuvres(named_ship("kvlcc2"), [turning(35.0)], environment=Environment(Current(0.05, 0.0)))
    assert results.indices_frame()["sd"].isna().all()
    assert "probability" not in results.imo_frame()
    calm = sail_manoeuvres(named_ship("kvlcc2"), [turning(35.0)]).indices_frame()["value"][0]
    assert results.indices_frame()["value"][0] > calm  # carried along by the current


def test_percentages_name_hull_propeller_and_rudder():
    shares = percentages(named_ship("kvlcc2"), 5.0)
    assert shares is not None
    assert {"hull", "rudder.eps", "propeller.wP0"} <= set(shares)
    assert set(shares.values()) == {5.0}


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"draws": 5}, "no covariance"),
        ({"percent": 5.0}, "needs draws"),
        ({"draws": 5, "percent": 0.0}, "not positive"),
        ({"draws": 1, "percent": 5.0}, "no spread"),
    ],
)
def test_draws_need_something_to_draw_from(settings, said):
    with pytest.raises(SimulationError) as caught:
        sail_manoeuvres(named_ship("kvlcc2"), [turning(35.0)], **settings)
    assert said in str(caught.value)
