import re
import tomllib
from pathlib import Path

import pytest
from pydantic import BaseModel

import towtank.decay.decay_campaign as decay_campaign
from towtank.core.errors import CampaignError
from towtank.decay.compare import METHODS
from towtank.decay.decay_campaign import checked_campaign, command_line_campaign, load_decay_campaign

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "decay.md").read_text(encoding="utf-8")
SMALL = {"decay": {"name": "a"}, "records": [{"file": "roll.csv"}]}


def sections():
    return [
        one
        for one in vars(decay_campaign).values()
        if isinstance(one, type)
        and issubclass(one, BaseModel)
        and one.model_fields
        and one.__name__ != "DecayCampaign"
    ]


@pytest.mark.parametrize("section", sections(), ids=lambda one: one.__name__)
def test_the_page_names_every_key(section):
    assert [key for key in section.model_fields if f"`{key}`" not in PAGE] == []


@pytest.mark.parametrize("method", METHODS)
def test_the_page_names_every_method(method):
    assert f"| `{method}` |" in PAGE


def test_the_example_of_the_page_is_valid():
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    campaign = checked_campaign(tomllib.loads(text), Path("campaign.toml"))
    assert [one.speed for one in campaign.records] == [0.0, 0.5]
    assert campaign.make_ship().GM == 5.73
    assert campaign.fit.chosen_methods == tuple(METHODS)


def test_defaults():
    campaign = checked_campaign(SMALL, Path("c.toml"))
    assert (campaign.fit.models, campaign.fit.restoring) == (["linear+quadratic"], "auto")
    assert campaign.reduction.offset == "drift"
    assert campaign.make_ship() is None


@pytest.mark.parametrize(
    ("more", "parts"),
    [
        ({"fit": {"methods": ["energy"]}}, ("key 'fit.methods'", "closest: energy method")),
        ({"fit": {"models": []}}, ("key 'fit.models'",)),
        ({"fit": {"restoring": "stiff"}}, ("key 'fit'", "stiff", "auto, linear, cubic or quintic")),
        ({"reduction": {"skipp": 1}}, ("key 'reduction.skipp'", "closest: skip")),
        ({"records": []}, ("key 'records'",)),
        ({"ikeda": {"midship_coefficient": 0.9}}, ("[ikeda] needs", "[ship]")),
        ({"ship": {"name": "a", "L": 1.0, "B": 1.0}}, ("[ship]", "'T' is missing")),
        ({"ship": {"name": "a", "L": "long", "B": 1.0, "T": 0.1}}, ("[ship]",)),
        ({"decay": {"name": "a", "truth": {"b1": 1.0}}}, ("key 'decay'", "virtual = true")),
        ({"decay": {"name": "a", "virtual": True, "truth": {"b9": 1.0}}}, ("truth names 'b9'",)),
    ],
)
def test_faults_name_the_key(more, parts):
    with pytest.raises(CampaignError) as error:
        checked_campaign(SMALL | more, Path("c.toml"))
    for part in ("c.toml", *parts):
        assert part in str(error.value)


def test_a_captive_campaign_is_sent_away():
    with pytest.raises(CampaignError, match="captive-test campaign"):
        checked_campaign({"campaign": {"name": "a"}}, Path("c.toml"))


def test_file_that_is_missing(tmp_path):
    with pytest.raises(CampaignError, match="file not found"):
        load_decay_campaign(tmp_path / "none.toml")


def test_command_line_repeats_what_is_shared():
    campaign = command_line_campaign(
        ["a.csv", "b.csv"], record={"scale": 36.0, "start": None}, sections={"channels": {"unit": "deg"}}
    )
    assert [(one.file, one.scale, one.start) for one in campaign.records] == [
        ("a.csv", 36.0, None),
        ("b.csv", 36.0, None),
    ]
    assert campaign.decay.name == "a"


def test_fixed_terms_go_to_the_models_that_have_them():
    campaign = checked_campaign(
        SMALL | {"fit": {"models": ["linear", "linear+quadratic"], "fixed": {"b2": 0.1}}}, Path("c.toml")
    )
    assert campaign.fit.make_model("linear", "linear").fixed == {}
    assert campaign.fit.make_model("linear+quadratic", "linear").fixed == {"b2": 0.1}
