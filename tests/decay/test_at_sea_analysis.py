"""Records at sea by all methods: guesses, refusals, tables, and campaigns from files."""

import json
import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import CampaignError, FitError
from towtank.decay.at_sea_analysis import analyse_at_sea, first_guess, run_at_sea_campaign
from towtank.decay.at_sea_results import joined_terms
from towtank.decay.decay_campaign import AtSeaSettings, checked_campaign
from towtank.decay.decay_record import DecayRecord
from towtank.decay.excited_roll import Excitation, simulate_excited_roll
from towtank.decay.random_decrement import random_decrement

SHIP = {"b1": 0.080, "b3": 0.256, "c1": 11.88, "c3": 1.758, "c5": -18.624}


def sea(count: int = 10, seed: int = 0) -> DecayRecord:
    """So many oscillations, each with an excitation of its own, and a little noise."""
    rng = np.random.default_rng(seed)
    rate = math.sqrt(SHIP["c1"])
    state = (0.001, 1.0)
    times, angles = [np.zeros(1)], [np.array([state[0]])]
    local = np.arange(0.0, 6.0 * math.pi / rate, 0.02)
    for _ in range(count):
        wave = Excitation(1.2 * rng.uniform(0.5, 1.5), rate * rng.uniform(0.7, 1.3), rng.uniform(0.0, 6.28), 0.0)
        path = simulate_excited_roll(local, state, SHIP, wave)
        upward = np.flatnonzero((path[:-1, 0] < 0.0) & (path[1:, 0] >= 0.0)) + 1
        last = int(upward[upward > 3][0])
        times.append(times[-1][-1] + local[1 : last + 1])
        angles.append(path[1 : last + 1, 0])
        state = (float(path[last, 0]), float(path[last, 1]))
    time, angle = np.concatenate(times), np.concatenate(angles)
    noisy = angle + math.radians(0.01) * rng.standard_normal(angle.size)
    return DecayRecord(time, noisy, name="sea", source="sea.csv")


def narrow() -> DecayRecord:
    """Three nearly harmonic oscillations."""
    time = np.arange(0.0, 200.0, 0.02)
    angle = simulate_excited_roll(time, (0.0, 0.0), SHIP, Excitation(0.3, 3.0))[:, 0]
    return DecayRecord(time[-420:] - time[-420], angle[-420:], name="narrow", source="narrow.csv")


@pytest.fixture(scope="module")
def joint():
    return analyse_at_sea(sea(), AtSeaSettings(methods=["joint fit"], guess={**SHIP, "c1": 12.3}))


def test_joint_fit_alone(joint):
    table = joint.terms().set_index("name")
    assert set(table["method"]) == {"joint fit"}
    for name, value in SHIP.items():
        assert abs(table.loc[name, "value"] - value) < 4.0 * table.loc[name, "std"]
    assert table.loc["b3", "unit"] == "s/rad2"
    assert joint.guessed_from == "given"
    assert joint.decrements == ()
    assert joint.searched is None


def test_equivalent_damping_of_the_joint_fit(joint):
    (one,) = joint.equivalent().values()
    rate = one.omega * one.amplitude
    wanted = 0.5 * SHIP["b1"] + 0.375 * rate**2 * SHIP["b3"]
    assert np.abs(one.alpha / wanted - 1.0).max() < 0.1
    assert ((one.alpha_lower < one.alpha) & (one.alpha < one.alpha_upper)).all()


def test_all_methods_stand_beside_each_other(monkeypatch):
    monkeypatch.setattr("towtank.decay.at_sea_analysis._SEARCH_MOVES", 10)
    found = analyse_at_sea(sea(6), AtSeaSettings(period=1.8, terms=["b1", "c1"], guess={"b3": 0.256}))
    assert found.guessed_from == "period 1.8 s given"
    assert found.failures == {}
    table = found.terms()
    assert list(dict.fromkeys(table["method"])) == [
        "random decrement", "joint fit", "discrete search, as published",
    ]  # fmt: skip
    published = table[table["method"] == "discrete search, as published"]
    assert list(published["name"]) == ["b1", "b3", "c1", "c3", "c5", "f", "we", "phase", "f0"]
    assert published["std"].isna().all()
    assert found.searched.determines <= 11
    assert "few-pieces" in [item.rule for item in found.findings]
    data = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert data["joint fit"]["names"] == ["b1", "c1"]
    assert data["discrete search"]["local minimum"] in (True, False)


def test_what_cannot_be_identified_is_refused_with_the_reason(monkeypatch):
    monkeypatch.setattr("towtank.decay.at_sea_analysis._SEARCH_MOVES", 10)
    with pytest.raises(
        FitError, match=r"no method gives a result; joint fit: \d+ parameters are asked .* c1 trades"
    ):
        analyse_at_sea(narrow(), AtSeaSettings(methods=["joint fit"]))
    beside = analyse_at_sea(narrow(), AtSeaSettings(methods=["joint fit", "discrete search"]))
    assert "parameters are asked" in beside.failures["joint fit"]
    assert beside.joint is None
    assert beside.searched is not None


def test_guess_comes_from_the_random_decrement_when_it_is_sound():
    rng = np.random.default_rng(1)
    time = 0.1 * np.arange(20000)
    angle, rate, position = np.zeros(time.size), 0.0, 0.0
    for k, push in enumerate(0.03 * rng.standard_normal(time.size)):
        rate += 0.1 * (push - 0.04 * rate - 0.36 * position)
        position += 0.1 * rate
        angle[k] = position
    record = DecayRecord(time, angle, name="broad")
    signature = random_decrement(time, angle)
    assert signature.findings == ()
    guess, said = first_guess(record, AtSeaSettings(), [signature])
    assert said == "random decrement"
    assert guess["c1"] == pytest.approx(0.36, rel=0.03)
    assert guess["b1"] == pytest.approx(0.04, rel=0.4)
    assert first_guess(record, AtSeaSettings(), [])[1] == "mean period of the record"


def test_levels_in_degrees():
    found = analyse_at_sea(sea(), AtSeaSettings(methods=["random decrement"], levels=[5.0, 8.0]))
    assert [math.degrees(one.level) for one in found.decrements] == pytest.approx([5.0, 8.0])
    (points,) = found.equivalent().values()
    assert points.amplitude == pytest.approx(np.radians([5.0, 8.0]))


def test_campaign_of_two_records(tmp_path):
    for number in range(2):
        one = sea(5, seed=number)
        frame = pd.DataFrame({"time": one.time, "phi": np.degrees(one.value)})
        frame.to_csv(tmp_path / f"{number}.csv", index=False)
    (tmp_path / "c.toml").write_text(
        '[decay]\nname = "two"\n[channels]\nunit = "deg"\n[[records]]\nfile = "0.csv"\n'
        '[[records]]\nfile = "1.csv"\nstart = 1.0\n'
        '[at_sea]\nmethods = ["joint fit"]\nterms = ["b1", "c1"]\nperiod = 1.8\nmost = 3\n'
    )
    seen = []
    analysis = run_at_sea_campaign(tmp_path / "c.toml", progress=lambda *what: seen.append(what))
    assert analysis.terms_frame()["record"].unique().tolist() == ["0", "1"]
    assert len(analysis.excitations_frame()) == 6
    assert list(analysis.excitations_frame().columns[:3]) == ["start [s]", "period [s]", "amplitude [deg]"]
    assert analysis.equivalent_frame()["method"].unique().tolist() == ["joint fit"]
    assert analysis.records[1].record.time[0] >= 1.0
    assert ("fitting", 2, 2) in seen
    assert analysis.to_dict()["format"] == "towtank damping at sea 1"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"at_sea": {"methods": ["joint fitt"]}}, "closest: joint fit"),
        ({"at_sea": {"guess": {"b7": 1.0}}}, "guess names 'b7'"),
        ({"at_sea": {"levels": [0.0]}}, "trigger level is not positive"),
        ({"at_sea": {}, "records": [{"file": "a.csv", "motion": "heave"}]}, "is no roll record"),
        ({"at_sea": {}, "memory": {"table": "b.csv"}}, "belongs to free decays"),
    ],
)
def test_keys_are_checked(change, message):
    data = {"decay": {"name": "a"}, "records": [{"file": "a.csv"}], **change}
    with pytest.raises(CampaignError, match=message):
        checked_campaign(data, "c.toml")


def test_terms_are_joined_as_in_labels():
    assert joined_terms(("b1", "b3", "c1")) == "b1+b3, c1"
    assert joined_terms(("c1",)) == "c1"
