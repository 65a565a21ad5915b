import json
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import CampaignError, FitError
from towtank.core.ship import Ship
from towtank.decay.compare import DecayComparison
from towtank.decay.decay_analysis import analyse_decays, disagreements, run_decay_campaign
from towtank.decay.decay_campaign import checked_campaign
from towtank.decay.decay_input import decay_from_table
from towtank.decay.equation import simulate_decay
from towtank.decay.restoring_curve import RestoringCurve
from towtank.decay.shipped_decay import write_decay_campaign

TRUTH = (0.02, 0.3, 0.0, 0.36, 0.0, 0.0)
SHIP = {"name": "hull", "L": 100.0, "B": 16.0, "T": 6.0, "volume": 6700.0, "KG": 6.0, "GM": 0.8, "rho": 1000.0}


def campaign(count: int = 1, **more):
    data = {"decay": {"name": "a"}, "records": [{"file": f"{k}.csv"} for k in range(count)]}
    data["fit"] = {"methods": ["integration", "extinction curve"]}
    return checked_campaign(data | more, "c.toml")


def record(make_decay, **options):
    return make_decay(TRUTH, **{"duration": 120.0, "noise": 0.05, "correlation": 0.5} | options)


def test_group_quotes_the_integration_fit(make_decay):
    analysis = analyse_decays(campaign(), [record(make_decay)])
    (group,) = analysis.groups
    assert group.preferred.method == "integration"
    assert group.verdict.supported == "linear+quadratic"
    assert group.ratio.omega_n == pytest.approx(0.6, rel=2e-3)
    assert [one.method for one in group.results] == ["integration", "extinction curve"]
    assert group.doubts(group.preferred) == ()
    limits = analysis.damping_frame().set_index(["method", "name"]).loc[("integration", "b2")]
    assert limits["lower95"] < 0.3 < limits["upper95"]


def test_a_method_that_leaves_the_others_is_told(make_decay):
    (group,) = analyse_decays(campaign(), [record(make_decay)]).groups
    assert list(disagreements(group)) == []
    other = group.comparisons["linear+quadratic"]["extinction curve"]
    moved = replace(other, params=other.params * np.array([1.3, 1.3, 1.0]))
    results = {"integration": group.preferred, "extinction curve": moved}
    spoilt = replace(group, comparisons={"linear+quadratic": DecayComparison(results, {})})
    (finding,) = disagreements(spoilt)
    assert (finding.rule, finding.place, finding.severity) == ("methods-disagree", "extinction curve", "warning")
    assert "+3" in finding.message
    assert "methods-disagree" in replace(spoilt, findings=(finding,)).doubts(moved)
    assert "methods-disagree" not in spoilt.doubts(moved)


def test_speeds_part_the_groups_and_a_dependence_joins_them(make_decay):
    entries = [{"file": "0.csv"}, {"file": "1.csv", "speed": 2.0}]
    records = [record(make_decay), record(make_decay, speed=2.0, seed=1)]
    fast = {"methods": ["integration"]}
    apart = analyse_decays(campaign(records=entries, fit=fast), records)
    assert [group.label for group in apart.groups] == ["roll, 0 m/s", "roll, 2 m/s"]
    assert apart.damping_frame()["group"].nunique() == 2
    joined = analyse_decays(
        campaign(records=entries, fit=fast | {"speed_terms": ["b1*U"], "restoring": "linear"}), records
    )
    (group,) = joined.groups
    low, high = group.preferred.conf_int()[group.preferred.position("b1*U")]
    assert low < 0.0 < high


def test_dimensional_columns_where_the_ship_is_known(make_decay):
    ship = Ship.from_dict(SHIP)
    made = record(make_decay)
    known = analyse_decays(campaign(ship=SHIP), [type(made)(**vars(made) | {"ship": ship})])
    table = known.equivalent_frame()
    inertia = 1000.0 * 6700.0 * 9.80665 * 0.8 / known.groups[0].preferred.omega_n ** 2
    own = table[table["method"] == "integration"]
    np.testing.assert_allclose(own["B44 [N m s]"], 2.0 * own["alpha_e [1/s]"] * inertia, rtol=1e-9)
    assert "B44 [N m s]" not in analyse_decays(campaign(), [made]).equivalent_frame()


def test_ikeda_needs_the_particulars(make_decay):
    made = record(make_decay)
    without = {key: value for key, value in SHIP.items() if key != "KG"}
    wanted = campaign(ship=without, ikeda={"midship_coefficient": 0.95})
    with pytest.raises(CampaignError, match="KG is missing"):
        analyse_decays(wanted, [type(made)(**vars(made) | {"ship": Ship.from_dict(without)})])


def test_first_and_last_amplitude_are_degrees(make_decay):
    analysis = analyse_decays(
        campaign(reduction={"first_amplitude": 15.0, "last_amplitude": 5.0}), [record(make_decay)]
    )
    low, high = np.degrees(analysis.groups[0].preferred.diagnostics.amplitudes)
    assert 4.5 < low < 5.5
    assert 13.0 < high <= 15.0


def test_when_no_method_fits(make_decay):
    entry = {"file": "0.csv", "start": 0.0, "end": 15.0}
    fit = {"methods": ["extinction curve"], "models": ["linear+quadratic+cubic"], "restoring": "linear"}
    wanted = campaign(records=[entry], fit=fit, reduction={"offset": "none"})
    with pytest.raises(FitError, match="no method could fit"):
        analyse_decays(wanted, [record(make_decay)])


def test_shipped_campaign_reads_back(tmp_path):
    path = write_decay_campaign(tmp_path)
    seen = []
    analysis = run_decay_campaign(path, progress=lambda *what: seen.append(what))
    assert analysis.truth["b2"] == 0.11
    assert analysis.campaign.decay.virtual
    (group,) = analysis.groups
    assert group.failures == {}
    assert group.ikeda is not None
    assert ("fitting", 10, 10) in seen
    data = json.loads(json.dumps(analysis.to_dict()))
    assert data["format"] == "towtank damping 1"
    assert len(data["groups"][0]["results"]) == 9


def test_lever_curve_of_a_campaign(make_decay):
    """A pendulum: levers of a sine explain it with c1 alone."""
    degrees = np.arange(0.0, 61.0, 5.0)
    levers = [[float(one), float(np.sin(np.radians(one)))] for one in degrees]
    fit = {"methods": ["integration"], "gz": levers}
    curve = RestoringCurve.from_levers(np.radians(degrees), np.sin(np.radians(degrees)))
    time = np.arange(0.0, 80.0, 0.1)
    value = simulate_decay(time, (0.6, 0.0), np.array([0.04, 0.2, 0.0, 0.36, 0.0, 0.0]), curve=curve)[:, 0]
    made = decay_from_table({"time": time, "phi": value}, unit="rad")
    (group,) = analyse_decays(campaign(fit=fit), [made]).groups
    assert group.verdict is None
    np.testing.assert_allclose(group.preferred.values, [0.04, 0.2, 0.36], rtol=1e-3)
    assert group.preferred.model.label == "b1+b2, c1 GZ"
    for wrong in ({"gz": levers, "restoring": "cubic"}, {"gz": levers[::-1]}):
        with pytest.raises(CampaignError, match="gz"):
            campaign(fit=wrong)


def test_standard_forms_stand_in_the_json(make_decay):
    data = analyse_decays(campaign(), [record(make_decay)]).to_dict()["groups"][0]
    assert data["extinction"]["b"]["value"] == pytest.approx(4.0 / 3.0 * 0.3 * np.radians(1.0), rel=0.05)
    assert data["extinction"]["b"]["unit"] == "1/deg"
    assert [row["angle [deg]"] for row in data["bertin"]] == pytest.approx(
        [10.0, 12.5, 15.0, 17.5, 20.0, 22.5, 25.0]
    )
