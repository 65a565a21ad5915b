"""Ensembles: what scatters, what is told of it, criteria, failures, the same result for the same seed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import SimulationError, TowtankError
from towtank.simulate.ensembles import Ensemble, ensemble
from towtank.simulate.manoeuvre_indices import event_indices
from towtank.simulate.manoeuvres import course_keeping, turning, zigzag
from towtank.simulate.parameter_scatter import HULL, MMG_COEFFICIENTS
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")
MANOEUVRES = ("turning 35", "turning -35", "zigzag 10/10")
TURN, PORT, ZIGZAG = "turning +35", "turning -35", "zigzag +10/10"


@pytest.fixture(scope="module")
def five_per_cent() -> Ensemble:
    """KVLCC2 with 31 uncertain parameters."""
    return ensemble(KVLCC2, MANOEUVRES, n=400, seed=2, percent=5, names=(HULL, *MMG_COEFFICIENTS))


def values_of(found):
    return {(m, i): values for m, indices in found.values.items() for i, values in indices.items()}


def test_spread_of_31_parameters_is_that_of_an_independent_calculation(five_per_cent):
    # 20 000 draws with fixed steps: mean and sd; the tolerances are three standard errors of 400 draws
    table = five_per_cent.indices.set_index(["manoeuvre", "index"])
    for place, mean, sd in (
        ((TURN, "advance"), 3.087, 0.172),
        ((TURN, "tactical diameter"), 3.117, 0.217),
        ((ZIGZAG, "overshoot 1"), 5.14, 0.67),
        ((ZIGZAG, "overshoot 2"), 14.5, 3.35),
    ):
        assert table.loc[place, "mean"] == pytest.approx(mean, abs=0.15 * sd + 0.01 * mean)
        assert table.loc[place, "sd"] == pytest.approx(sd, rel=0.15)


def test_value_is_that_of_the_unperturbed_vessel(five_per_cent):
    events = sail(KVLCC2, zigzag(10)).events
    alone = event_indices(ZIGZAG, events, KVLCC2.ship, KVLCC2.speed)
    table = five_per_cent.indices
    rows = table[table["manoeuvre"] == ZIGZAG].set_index("index")
    assert rows.loc["overshoot 2", "value"] == alone["overshoot 2"][0]
    assert rows.loc["overshoot 2", "draws"] == five_per_cent.draws == 400


def test_the_same_seed_gives_the_same_result_and_another_another(five_per_cent):
    again = ensemble(KVLCC2, MANOEUVRES, n=400, seed=2, percent=5, names=(HULL, *MMG_COEFFICIENTS), workers=2)
    fewer = ensemble(KVLCC2, MANOEUVRES[:1], n=30, seed=2, percent=5, names=(HULL, *MMG_COEFFICIENTS))
    other = ensemble(KVLCC2, MANOEUVRES[:1], n=30, seed=3, percent=5, names=(HULL, *MMG_COEFFICIENTS))
    for place, values in values_of(five_per_cent).items():
        np.testing.assert_array_equal(values_of(again)[place], values)
    for place, values in values_of(fewer).items():
        np.testing.assert_array_equal(values_of(five_per_cent)[place][:30], values)
    advance = fewer.draws_of(TURN, "advance")
    assert not np.any(other.draws_of(TURN, "advance") == advance)


def test_each_draw_has_its_own_propeller_rate_unless_the_vessel_has_one(five_per_cent):
    assert np.std(five_per_cent.rates) > 0.01
    one = ensemble(KVLCC2.but(rate=11.8), "turning 35", n=10, percent=5)
    assert set(one.rates) == {11.8}
    assert one.provenance.choices["propeller rate"] == 11.8


def test_criteria_count_the_worse_side_of_each_draw(five_per_cent):
    table = five_per_cent.criteria.set_index("criterion")
    assert list(table.index) == [
        "turning: advance",
        "turning: tactical diameter",
        "10/10 zig-zag: first overshoot",
        "10/10 zig-zag: second overshoot",
    ]
    assert (table["verdict"] == "pass").all()
    assert (table["probability"] > 0.99).all()
    worst = np.maximum(five_per_cent.draws_of(TURN, "advance"), five_per_cent.draws_of(PORT, "advance"))
    row = table.loc["turning: advance"]
    assert row["margin_p05"] == pytest.approx(4.5 - np.quantile(worst, 0.95))
    assert row["margin_p95"] == pytest.approx(4.5 - np.quantile(worst, 0.05))
    assert row["margin_p05"] < row["margin"] < row["margin_p95"]
    assert five_per_cent.criteria.attrs["notes"]


def test_draws_that_fail_are_counted_named_and_do_not_pass():
    found = ensemble(KVLCC2, "zigzag 10/10", n=300, seed=1, percent=25, names=(HULL, *MMG_COEFFICIENTS))
    failures = found.failures
    assert failures["manoeuvre"].unique().tolist() == [ZIGZAG]
    assert failures["draws"].sum() > 0
    missing = int(np.sum(np.isnan(found.draws_of(ZIGZAG, "overshoot 1"))))
    assert failures["draws"].sum() == missing
    assert failures["share"].sum() == pytest.approx(missing / 300)
    row = found.criteria.set_index("criterion").loc["10/10 zig-zag: second overshoot"]
    assert row["probability"] == np.mean(found.draws_of(ZIGZAG, "overshoot 2") <= row["limit"])
    assert row["probability"] < 1.0 - missing / 300 + 1e-12
    assert row["probability_se"] == pytest.approx(np.sqrt(row["probability"] * (1 - row["probability"]) / 300))
    assert found.indices.set_index("index").loc["overshoot 1", "draws"] == 300 - missing
    told = [finding for finding in found.provenance.findings if finding.rule == "failed-draws"]
    assert {finding.message.split(" no indices: ")[-1] for finding in told} == set(failures["reason"])
    fan = found.fan(ZIGZAG, tracks=20)
    assert len(fan.numbers) == 20
    assert np.isfinite(found.draws_of(ZIGZAG, "overshoot 1")[fan.numbers]).all()


def test_a_fitted_set_is_drawn_from_its_covariance():
    hull = KVLCC2.hull
    sd = 0.05 * np.abs(hull.values)
    pair = [hull.names.index(name) for name in ("Nv", "Nr")]
    spread = {}
    for correlation in (0.0, 0.95):
        matrix = np.diag(sd**2)
        matrix[pair[0], pair[1]] = matrix[pair[1], pair[0]] = correlation * sd[pair[0]] * sd[pair[1]]
        found = ensemble(replace(hull, covariance=matrix), "zigzag 10/10", n=400, like="kvlcc2")
        spread[correlation] = found.indices.set_index("index").loc["overshoot 2", "sd"]
        assert found.scatter.names == hull.names
        assert found.provenance.choices["scatter"] == f"covariance of '{hull.name}'"
    # errors of Nv and Nr that go together cancel
    assert spread[0.95] < 0.75 * spread[0.0]


def test_raw_draws_hold_parameters_and_indices(five_per_cent):
    raw = five_per_cent.raw
    assert len(raw) == 400
    np.testing.assert_array_equal(raw["parameter", "rudder.eps"], five_per_cent.parameters[:, 28])
    assert five_per_cent.scatter.names[28] == "rudder.eps"
    np.testing.assert_array_equal(raw[ZIGZAG, "overshoot 2"], five_per_cent.draws_of(ZIGZAG, "overshoot 2"))
    assert five_per_cent.quantile(ZIGZAG, "overshoot 2", 0.5) == pytest.approx(raw[ZIGZAG, "overshoot 2"].median())
    assert five_per_cent.quantile(ZIGZAG, "overshoot 2", [0.05, 0.95]).shape == (2,)


def test_a_draw_can_be_sailed_again(five_per_cent):
    vessel = five_per_cent.vessel_of(17)
    again = event_indices(TURN, sail(vessel, turning(35)).events, vessel.ship, vessel.speed)
    assert again["advance"][0] == pytest.approx(five_per_cent.draws_of(TURN, "advance")[17], abs=1e-3)


def test_provenance_tells_seed_scatter_and_sampling(five_per_cent):
    choices = five_per_cent.provenance.choices
    assert (choices["draws"], choices["seed"], choices["sampling"]) == (400, 2, "random")
    assert choices["scatter"] == "independent 5 % of 31 numbers"
    assert choices["manoeuvres"] == ", ".join(five_per_cent.manoeuvres)


def test_mirrored_draws_sharpen_the_mean():
    plain, mirrored = (
        [
            float(
                ensemble(KVLCC2, turning(35, 100), n=40, seed=seed, percent=3, sampling=sampling).indices["mean"][
                    0
                ]
            )
            for seed in range(12)
        ]
        for sampling in ("random", "antithetic")
    )
    assert np.std(mirrored) < 0.4 * np.std(plain)


FAULTS = {
    "no manoeuvre": ([], {}, "an ensemble needs a manoeuvre"),
    "twice": (["turning 35", turning(35)], {}, r"'turning \+35' is among the manoeuvres twice"),
    "without indices": (course_keeping(10.0), {}, "names no known manoeuvre"),
    "one draw": ("turning 35", {"n": 1}, "an ensemble of 1 draws has no spread"),
    "no scatter": ("turning 35", {"percent": None}, "no covariance to draw from"),
}


@pytest.mark.parametrize(("manoeuvres", "more", "message"), FAULTS.values(), ids=FAULTS)
def test_what_cannot_be_an_ensemble_is_an_error(manoeuvres, more, message):
    with pytest.raises(TowtankError, match=message):
        ensemble(KVLCC2, manoeuvres, **{"percent": 5, "n": 10, **more})


def test_a_vessel_that_diverges_unperturbed_is_an_error():
    with pytest.raises(SimulationError, match=r"turning \+35: the motion diverges"):
        ensemble(named_ship("dtmb5512"), "turning 35", n=10, percent=5)


def test_unknown_names_are_errors_with_the_known_ones(five_per_cent):
    with pytest.raises(SimulationError, match=r"has no index 'advnce' -> it has advance"):
        five_per_cent.draws_of(TURN, "advnce")
    with pytest.raises(SimulationError, match=r"has not sailed 'turning 35' -> it has sailed turning \+35"):
        five_per_cent.fan("turning 35")
