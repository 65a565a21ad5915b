"""The campaign file: what it yields and what it refuses."""

import re
import tomllib
from pathlib import Path

import pytest
from pydantic import BaseModel

from towtank.core.errors import CampaignError
from towtank.squat import campaign_sections, voyage_file
from towtank.squat.named_corrections import CORRECTIONS
from towtank.squat.noise_filter import FILTERS
from towtank.squat.prediction import FORMULAS
from towtank.squat.squat_campaign import checked_squat_campaign, command_line_squat, load_squat_campaign

TEXT = """
[squat]
name = "model 1:80"
scale = 80.0
[ship]
name = "ship"
L = 230.0
B = 32.2
T = 10.8
volume = 52030.0
xG = -3.4
[fairway]
depth = 0.2
width = 4.0
[channels]
bow = "zb"
stern = "zs"
[[records]]
file = "a.csv"
"""


@pytest.fixture
def path(tmp_path) -> Path:
    file = tmp_path / "campaign.toml"
    file.write_text(TEXT)
    return file


def test_ship_and_channels_come_to_the_scale_of_the_records(path):
    campaign = load_squat_campaign(path)
    assert campaign.scale == 80.0
    assert campaign.length == pytest.approx(2.875)
    ship = campaign.make_ship()
    assert ship is not None
    assert (ship.L, ship.T, ship.volume) == pytest.approx((2.875, 0.135, 52030 / 80**3))
    layout = campaign.make_layout()
    assert layout.points == {"zb": (pytest.approx(1.4375), 0.0), "zs": (pytest.approx(-1.4375), 0.0)}
    assert layout.places["cog"] == pytest.approx(-3.4 / 80)
    fairway = campaign.fairway.make_fairway(0.2)
    assert (fairway.kind, fairway.area) == ("canal", pytest.approx(0.8))


def test_trench_and_trapezoid(path):
    path.write_text(TEXT.replace("width = 4.0", "width = 4.0\nslope = 3.0\nbank_height = 0.1"))
    fairway = load_squat_campaign(path).fairway.make_fairway(0.2)
    assert fairway.kind == "trench"
    assert fairway.area == pytest.approx(0.2 * (4.0 + 3.0 * 0.2))


def test_runs_of_one_stem_are_told_apart():
    sections = {"ship": {"name": "s", "L": 4.0}, "channels": {"bow": "a", "stern": "b"}}
    campaign = command_line_squat(["x/run.csv", "y/run.csv", "z.csv"], record={}, sections=sections)
    assert campaign.run_names() == ["x/run.csv", "y/run.csv", "z"]


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (("depth = 0.2", "depth = -0.2"), ("key 'fairway'", "a water depth of -0.2 m is impossible", "positive")),
        (("depth = 0.2", "dpeth = 0.2"), ("key 'fairway.dpeth'", "unknown key", "closest: depth")),
        (('bow = "zb"\nstern = "zs"', 'time = "t"'), ("key 'channels'", "no channel of sinkage", "bow and stern")),
        (
            ('bow = "zb"\nstern = "zs"', 'heave = "z"\ntrim = "p"'),
            ("key 'channels'", "which way 'p' is positive", "bow-down or bow-up"),
        ),
        (('stern = "zs"', ""), ("1 sinkage channel(s) at 1 place(s)", "two different x")),
        (("L = 230.0", ""), ("length L is missing", "give L in m")),
        (("T = 10.8", "T = -10.8"), ("T = -10.8 is not positive",)),
        (("T = 10.8", "T = 10.8\nZ = 1"), ("unknown key 'Z'", "keys are")),
        (("width = 4.0", "slope = 3.0"), ("banks without a bottom width", "add width")),
        (("[squat]", "[decay]"), ("[decay]", "towtank decay")),
        (('file = "a.csv"', 'file = "a.csv"\n[[records]]\nfile = "a.csv"'), ("'a.csv' is given twice", "once")),
        (("[channels]", '[filter]\nname = "fir"\n[channels]'), ("'fir' is no filter", "butterworth")),
        (("[channels]", '[correction]\nname = "x"\n[channels]'), ("'x' is no correction", "kreitner")),
        (("[channels]", '[window]\nrule = "key-times"\n[channels]'), ("key-times needs its times", "in s")),
        (("[channels]", "[window]\nbegin = 0.9\nend = 0.3\n[channels]"), ("the window 0.9 to 0.3 is empty",)),
        (("scale = 80.0", "scale = 80.0\ntruth = { trim = 1.0 }"), ("only a virtual record", "virtual = true")),
    ],
)
def test_faults_are_named(change, parts, path):
    assert change[0] in TEXT
    path.write_text(TEXT.replace(*change))
    with pytest.raises(CampaignError) as error:
        load_squat_campaign(path)
    for part in (*parts, str(path), " -> "):
        assert part in str(error.value)


def test_a_ship_without_breadth_gives_no_curve_but_a_layout():
    campaign = checked_squat_campaign(
        {
            "squat": {"name": "a"},
            "ship": {"name": "s", "L": 4.0},
            "channels": {"points": {"z1": [1.5, 0.3], "z2": [1.5, -0.3], "z3": [-1.6, 0.0]}},
            "records": [{"file": "a.csv"}],
        },
        Path("x.toml"),
    )
    assert campaign.make_ship() is None
    assert campaign.make_layout().places["bow"] == 2.0


PAGE = (Path(__file__).resolve().parents[2] / "docs" / "squat.md").read_text(encoding="utf-8")
SECTIONS = [
    one
    for module in (campaign_sections, voyage_file)
    for one in vars(module).values()
    if isinstance(one, type) and issubclass(one, BaseModel)
]


@pytest.mark.parametrize("words", [FORMULAS, CORRECTIONS, FILTERS], ids=["formulas", "corrections", "filters"])
def test_page_names_every(words):
    assert [word for word in words if word != "none" and f"`{word}`" not in PAGE] == []


def test_page_names_every_key():
    keys = {key for section in SECTIONS for key in section.model_fields}
    assert sorted(key for key in keys if f"`{key}`" not in PAGE and f"[{key}" not in PAGE) == []


def test_example_of_the_page_is_valid():
    text, _ = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    campaign = checked_squat_campaign(tomllib.loads(text), Path("page.toml"))
    assert campaign.length == pytest.approx(355.0 / 89.11)
    assert campaign.records[2].waves


def test_voyage_of_the_page_is_valid(tmp_path):
    _, text = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "voyage.toml").write_text(text)
    assert voyage_file.load_voyage(tmp_path / "voyage.toml").make_layout().length == 350.0
