"""``[simulate]``: the fitted set sailed, its section of the report, and what is refused before a run is read."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from towtank.core.errors import CampaignError, TowtankError
from towtank.datasets import load_set
from towtank.pmm.campaign import Campaign
from towtank.pmm.campaign_file import Simulate, load_campaign_file
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.standard_matrices import standard_matrix
from towtank.pmm.virtual_campaign import synthesize
from towtank.report.campaign_manoeuvres import check_simulate, sail_campaign, sailed_provenance, sailed_text
from towtank.report.outputs import write_results

SECTION = """
[simulate]
ship_from = "kvlcc2"
manoeuvres = ["turning 35", "zigzag 10/10"]
speed = 1.18
draws = 30
seed = 4
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> Path:
    """A virtual KVLCC2 campaign without the section."""
    truth = load_set("kvlcc2")
    folder = tmp_path_factory.mktemp("made") / "campaign"
    return synthesize(
        truth,
        standard_matrix("general", truth.ship),
        folder,
        name="virtual KVLCC2",
        noise=Noise(ar1=0.01, seed=1),
        laboratory=Laboratory(sampling_rate=10.0),
    )


def with_section(made: Path, section: str, name: str) -> Path:
    path = made.with_name(f"{name}.toml")
    path.write_text(made.read_text(encoding="utf-8") + section, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def result(made):
    return Campaign.load(with_section(made, SECTION, "sailed")).run()


def test_the_fitted_set_sails_as_the_truth_does(result, tmp_path):
    out = tmp_path / "results"
    names = {path.name for path in write_results(result, out)}
    assert {"indices.csv", "imo.csv", "draws.csv", "elasticities.csv", "trajectory_turning_35.csv"} <= names
    with (out / "indices.csv").open(encoding="utf-8") as stream:
        found = {(row["manoeuvre"], row["index"]): row for row in csv.DictReader(stream)}
    advance = found["turning +35", "advance"]
    assert float(advance["value"]) == pytest.approx(3.078, abs=0.05)
    assert 0.0 < float(advance["sd"]) < 0.1
    page = (out / "report.html").read_text(encoding="utf-8")
    assert '<a href="#manoeuvres">Manoeuvres</a>' in page
    assert "30 draws, seed 4" in page
    assert "simulate.ship_from" in page
    assert "overshoot 2 over 30 draws" in page


def test_a_fault_inside_the_environment_file_is_told_at_once(tmp_path):
    (tmp_path / "sea.toml").write_text("[current]\nspeed = -1\n", encoding="utf-8")
    with pytest.raises(TowtankError, match=r"sea.toml, key 'current.speed'"):
        check_simulate(Simulate(environment="sea.toml"), tmp_path / "campaign.toml", load_set("kvlcc2").ship)


def test_terminal_and_provenance_tell_verdicts_and_doubts(result, tmp_path):
    sailed = sail_campaign(result)
    text = sailed_text(sailed)
    assert "'virtual KVLCC2' was sailed, 30 draws: turning +35, zigzag +10/10" in text
    assert "turning: tactical diameter" in text
    assert "doubt: set 'virtual KVLCC2'" in text
    write_results(result, tmp_path / "results", report=False, sailed=sailed)
    facts = json.loads((tmp_path / "results" / "provenance.json").read_text(encoding="utf-8"))
    (one,) = facts["manoeuvres"]
    assert one["vessel"] == "virtual KVLCC2"
    assert one["ensemble"]["draws"] == 30
    assert len(one["doubts"]) >= 1


def test_a_set_that_cannot_be_sailed_is_told_with_its_cause(made, tmp_path):
    result = Campaign.load(with_section(made, "\n[simulate]\ndraws = 0\n", "alone")).run(compare=False)
    (one,) = sail_campaign(result)
    assert one.results is None
    assert "a propeller" in one.cause
    assert "was not sailed: set 'virtual KVLCC2' cannot be sailed" in sailed_text([one])
    assert "a propeller" in sailed_provenance([one])[0]["not sailed"]
    names = {path.name for path in write_results(result, tmp_path / "results")}
    assert "indices.csv" not in names
    page = (tmp_path / "results" / "report.html").read_text(encoding="utf-8")
    assert "Not sailed" in page


def test_without_the_section_nothing_is_sailed(made):
    assert load_campaign_file(made).simulate is None


@pytest.mark.parametrize(
    ("settings", "key", "said"),
    [
        (Simulate(ship_from="kvlcc3"), "simulate.ship_from", "no ship 'kvlcc3'"),
        (Simulate(manoeuvres=["turning 35", "zigzac 10/10"]), "simulate.manoeuvres", "'zigzac 10/10'"),
        (Simulate(manoeuvres=["zigzag 10-10"]), "simulate.manoeuvres", "cannot be read"),
        (Simulate(environment="sea.toml"), "simulate.environment", "'sea.toml' not found"),
        (Simulate(draws=1), "simulate.draws", "one draw has no spread"),
        (
            Simulate(manoeuvres=["turning 35", "turning +35"]),
            "simulate.manoeuvres",
            "'turning +35' is asked for twice",
        ),
        (Simulate(ship_from="kvlcc2", manoeuvres=["turning 350"]), "simulate.manoeuvres", "stops at 35 deg"),
    ],
)
def test_what_does_not_exist_is_refused_at_once(settings, key, said, tmp_path):
    with pytest.raises(CampaignError) as caught:
        check_simulate(settings, tmp_path / "campaign.toml")
    assert f"key '{key}'" in str(caught.value)
    assert said in str(caught.value)
    assert "->" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[simulate]\nship_frm = "kvlcc2"', "closest: ship_from"),
        ("[simulate]\ndraws = -1", "greater than or equal to 0"),
        ("[simulate]\nspeed = 0", "greater than 0"),
    ],
)
def test_the_section_is_validated_key_by_key(made, text, said):
    with pytest.raises(CampaignError) as caught:
        load_campaign_file(with_section(made, f"\n{text}\n", "wrong"))
    assert "simulate." in str(caught.value)
    assert said in str(caught.value)
