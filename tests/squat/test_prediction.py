"""Every formula against the sample table of the field, at full scale and model scale, in and out of its limits."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.prediction import FORMULAS, PLACES, predict
from towtank.squat.squat_formula import KNOT

KEYS = (
    "icorels-2.4", "icorels", "huuska", "barrass-3", "barrass-2", "eryuzlu", "eryuzlu-hausser", "yoshimura",
    "tuck-hooft", "millward", "norrbin",
)  # fmt: skip


def hull(L, B, T, block):
    return Ship("hull", L=L, B=B, T=T, volume=block * L * B * T)


KVLCC2 = hull(320.0, 58.0, 20.8, 0.81)
BULK = hull(216.0, 32.2, 12.5, 0.83)
KCS = hull(230.0, 32.2, 10.8, 0.651)

# (ship, depth, knots, width of a canal, samples in the order of KEYS, Ankudinov bow and stern)
SAMPLES = {
    "kvlcc2": (
        KVLCC2, 24.96, 10, None,
        (0.839, 0.839, 0.839, 0.810, 0.744, 0.501, 0.842, 0.879, 0.685, 0.812, 0.816), (1.081, 0.931),
    ),
    "bulk": (
        BULK, 15.0, 10, None,
        (0.737, 0.737, 0.737, 0.834, 0.775, 0.540, 0.740, 0.715, 0.602, 0.821, 0.687), (0.922, 0.780),
    ),
    "bulk in a canal": (
        BULK, 15.0, 8, 150.0,
        (0.454, 0.454, 0.938, 0.824, 0.757, 0.465, 0.495, 0.673, 0.371, 0.467, 0.440), (0.940, 0.911),
    ),
    "kcs": (
        KCS, 14.04, 10, None,
        (0.505, 0.358, 0.505, 0.651, 0.493, 0.510, 0.768, 0.479, 0.412, 0.596, 0.467), (0.527, 0.596),
    ),
}  # fmt: skip


def of_sample(name):
    ship, depth, knots, width, samples, ankudinov = SAMPLES[name]
    channel = None if width is None else Fairway.canal(depth, width)
    return predict(ship, depth, knots * KNOT, channel=channel), samples, ankudinov


@pytest.mark.parametrize("name", SAMPLES)
def test_sample_table_to_its_digits(name):
    found, samples, ankudinov = of_sample(name)
    for key, printed in zip(KEYS, samples, strict=True):
        # 0.0005 is the rounding; 0.04 % the gravity of 9.81 that the samples were computed with
        assert found.of(key, "maximum")[0] == pytest.approx(printed, abs=5e-4 + 5e-4 * printed), key
    for place, printed in zip(("bow", "stern"), ankudinov, strict=True):
        assert found.of("ankudinov", place)[0] == pytest.approx(printed, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "bow", "stern"), [("kvlcc2", 0.762, 0.354), ("bulk", 0.516, 0.337), ("kcs", 0.259, 0.312)]
)
def test_roemisch_of_the_sample_table(name, bow, stern):
    found, _, _ = of_sample(name)
    assert found.of("roemisch", "bow")[0] == pytest.approx(bow, abs=1e-3)
    assert found.of("roemisch", "stern")[0] == pytest.approx(stern, abs=1e-3)


def test_every_formula_is_there_in_and_out_of_its_limits():
    found = predict(KCS, 14.04, np.array([6.0, 16.0]) * KNOT).table
    assert set(found["formula"]) == set(FORMULAS)
    assert len(found) == 2 * len(FORMULAS)
    assert found["maximum"].notna().all()
    assert found["applicable"].equals(found["flag"] == "")
    norrbin = found[found["formula"] == "norrbin"]
    assert list(norrbin["applicable"]) == [True, False]
    assert norrbin["flag"].iloc[1] == "Fh 0.701 above 0.4"
    eryuzlu = found[found["formula"] == "eryuzlu"]["flag"].iloc[0]
    assert eryuzlu.startswith("CB 0.651 below 0.8")


def test_formulas_of_open_water_are_flagged_in_a_canal():
    found, _, _ = of_sample("bulk in a canal")
    flags = found.table.set_index("formula")["flag"]
    assert "not for a canal" in flags["icorels"]
    assert "not for a canal" not in flags["huuska"]


def test_model_is_computed_as_its_ship():
    speed = np.array([8.0, 10.0]) * KNOT
    ship = predict(BULK, 15.0, speed, channel=Fairway.canal(15.0, 150.0, 3.0)).table
    model = BULK.at_scale(50.0)
    small = predict(model, 15.0 / 50, speed / np.sqrt(50), channel=Fairway.canal(15.0 / 50, 3.0, 3.0)).table
    for place in PLACES:
        np.testing.assert_allclose(50.0 * small[place], ship[place], rtol=1e-12)
    np.testing.assert_allclose(small["knots"], [8, 10] * len(FORMULAS), rtol=1e-12)
    assert list(small["flag"]) == list(ship["flag"])


def test_spread_takes_the_applicable_ones():
    found = predict(KCS, 14.04, 10 * KNOT)
    some, every = found.spread().iloc[0], found.spread(applicable=False).iloc[0]
    assert every["count"] == len(FORMULAS)
    assert 0 < some["count"] < every["count"]
    assert every["min"] <= some["min"] <= some["median"] <= some["max"] <= every["max"]


def test_squat_grows_with_speed_and_with_less_water():
    for key in FORMULAS:
        speed = np.linspace(2.0, 6.0, 9)
        assert (np.diff(predict(KVLCC2, 25.0, speed).of(key, "maximum")) > 0).all(), key
        if key not in ("barrass-3", "roemisch"):
            deep, shallow = (predict(KVLCC2, depth, [5.0]).of(key, "maximum")[0] for depth in (30.0, 25.0))
            assert shallow > deep, key


def test_no_speed_no_squat():
    assert (predict(KVLCC2, 25.0, [0.0]).table["maximum"] == 0.0).all()


@pytest.mark.parametrize(
    ("ship", "depth", "speeds", "said"),
    [
        (Ship("bare", L=100, B=20, T=5), 7.0, [3.0], "no displaced volume"),
        (KCS, -14.0, [3.0], "depth = -14.0 is not a positive number"),
        (KCS, 10.0, [3.0], "not more than the draught"),
        (KCS, 14.04, [3.0, np.nan], "not a number"),
        (KCS, 14.04, [-3.0], "negative"),
        (KCS, 14.04, [], "missing"),
        (KCS, 14.04, [5.0, 16.0], "16.000 m/s is not below the critical 11.734 m/s"),
    ],
)
def test_wrong_input_is_a_named_error(ship, depth, speeds, said):
    with pytest.raises(TowtankError, match=said):
        predict(ship, depth, speeds)


def test_other_wrong_choices():
    with pytest.raises(TowtankError, match="one depth"):
        predict(KCS, 14.0, [3.0], channel=Fairway.canal(15.0, 100.0))
    with pytest.raises(TowtankError, match="3 propellers"):
        predict(KCS, 14.0, [3.0], propellers=3)
    with pytest.raises(TowtankError, match="no formula was chosen"):
        predict(KCS, 14.0, [3.0], formulas=())
    found = predict(KCS, 14.0, [3.0])
    with pytest.raises(TowtankError, match="no place 'keel'"):
        found.of("icorels", "keel")
    with pytest.raises(TowtankError, match="no formula 'tuck'"):
        found.of("tuck", "bow")
    with pytest.raises(TowtankError, match="no place"):
        found.spread("keel")
