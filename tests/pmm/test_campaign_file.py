"""Campaign files: what is understood, and the one line that each mistake gets."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from towtank.core.errors import CampaignError
from towtank.core.hull_models import hull_model
from towtank.pmm.campaign_file import candidate_terms, load_campaign_file

LEAST = """
[campaign]
name = "a campaign"

[ship]
name = "a ship"
L = 3.0
B = 0.4
T = 0.15

[channels]
time = "time [s]"
X = "Fx [N]"
Y = "Fy [N]"

[[runs]]
files = "*.txt"
type = "static_drift"
speed = 1.5
drift_angle = 4.0
"""


@pytest.fixture
def written(tmp_path):
    """Write a campaign file: a text that is complete, or LEAST with replacements and an ending."""

    def write(*replacements: tuple[str, str], end: str = "", text: str = LEAST) -> Path:
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "campaign.toml"
        path.write_text(text + end, encoding="utf-8")
        return path

    return write


def test_the_least_campaign_has_a_default_for_everything(written):
    file = load_campaign_file(written())
    assert file.make_ship().L == 3.0
    assert file.make_conventions().angle_unit == "rad"
    assert file.reduction.window == "fraction"
    assert file.reduction.fraction == (0.30, 0.95)
    assert file.fit.estimator == "wls"
    assert file.fit.hull_terms() is None
    assert file.output.scaling == "lt"
    assert file.runs[0].model_extra == {"speed": 1.5, "drift_angle": 4.0}
    assert not file.inertia.inside


def test_every_section_is_read(written):
    end = """
[points]
file = "points.csv"
scaling = "L2"
columns = { v = "v'", Y = "Y'" }
sd = { Y = 0.002 }

[conventions]
angle_unit = "deg"
origin = 0.1

[reader]
format = "spreadsheet"
sheet = "run"

[inertia]
inside = true
mass = 90.0
Izz = 50.0
mount_mass = 4.0

[reduction]
lowpass = 2.5
window = "mser"
harmonics = 5
moment_x = 0.0

[fit]
terms = ["R0", "Yv", "Yv|v|"]
estimator = "constrained"
bounds = { Yv = [-1.0, 0.0], "Yv|v|" = [-9.0, inf] }
group_by = ["depth", "speed"]
candidates = ["mmg-drift", "R0 Yv Yvvv"]

[fit.shared_bias]
gain = { Y = 0.01 }

[[fit.equalities]]
terms = { Yv = 1.0, "Yv|v|" = -1.0 }

[output]
scaling = "prime,cog"
report = false
"""
    file = load_campaign_file(written(end=end, text='accept = ["density"]\n' + LEAST))
    assert file.accept == ["density"]
    assert file.points.columns == {"v": "v'", "Y": "Y'"}
    assert file.reader.sheet == "run"
    assert file.inertia.mount_mass == 4.0
    assert [term.name for term in file.fit.hull_terms()] == ["R0", "Yv", "Yv|v|"]
    assert file.fit.bounds["Yv|v|"] == (-9.0, math.inf)
    assert file.fit.shared_bias.gain == {"Y": 0.01}
    assert file.fit.equalities[0].value == 0.0
    assert file.fit.group_by == ("depth", "speed")
    assert not file.output.report


def test_moment_and_motion_are_about_the_origin_unless_a_point_is_named(written):
    end = "xG = -0.06\n"
    ship = ("T = 0.15\n", f"T = 0.15\n{end}")
    at_cog = load_campaign_file(written(ship, end='[conventions]\norigin = "cog"\n')).reduction
    assert (at_cog.moment_x, at_cog.position_x) == (-0.06, -0.06)
    named = load_campaign_file(written(end="[conventions]\norigin = 0.1\n[reduction]\nmoment_x = 0.0\n")).reduction
    assert named.moment_x == 0.0
    assert named.position_x == pytest.approx(0.3)
    assert load_campaign_file(written()).reduction.moment_x == 0.0


def test_candidates_are_models_or_terms():
    assert candidate_terms("mmg-drift") == hull_model("mmg-drift")
    assert [term.name for term in candidate_terms("R0 Yv Yvvv")] == ["R0", "Yv", "Yvvv"]


MISTAKES = {
    # place and cause and cure, in parts that the line must have
    "unknown key": ((), "[fit]\nmodle = 'mmg'", ("key 'fit.modle'", "unknown key", "closest: model")),
    "unknown section": ((), "[fitt]\nmodel = 'mmg'", ("key 'fitt'", "unknown key", "closest: fit")),
    "unknown key of a channel": (
        (('Y = "Fy [N]"', 'Y = { column = "Fy", unti = "N" }'),),
        "",
        ("key 'channels.Y.unti'", "closest: unit"),
    ),
    "strange key": ((), "[output]\nqqq = 1", ("key 'output.qqq'", "keys here are report, series_in_report")),
    "wrong type": ((), "[reduction]\nharmonics = 'three'", ("key 'reduction.harmonics'", "integer", "'three'")),
    "wrong choice": ((), "[fit]\nestimator = 'wsl'", ("key 'fit.estimator'", "'wls', 'ols'", "'wsl'")),
    "out of range": ((), "[reduction]\nlowpass = -2.0", ("key 'reduction.lowpass'", "greater than or equal to 0")),
    "missing key": ((('name = "a campaign"', ""),), "", ("key 'campaign.name'", "the key is missing", "add it")),
    "missing ship key": ((("T = 0.15", ""),), "", ("[ship]", "'T' is missing", "complete")),
    "negative draught": ((("T = 0.15", "T = -0.15"),), "", ("[ship]", "T = -0.15 is not positive", "SI units")),
    "text for a length": (
        (("L = 3.0", 'L = "3 m"'),),
        "",
        ("key 'ship'", "L = '3 m' is not a number", "SI units"),
    ),
    "unknown ship key": (
        (("T = 0.15", "T = 0.15\ndraft = 1.0"),),
        "",
        ("[ship]", "unknown key 'draft'", "keys are"),
    ),
    "unknown convention": ((), "[conventions]\naxis = 'x'", ("[conventions]", "unknown convention 'axis'")),
    "wrong convention": ((), "[conventions]\naxes = 'up'", ("[conventions]", "axes = 'up'", "forward-starboard")),
    "scaling as a convention": (
        (),
        "[conventions]\nforce_scaling = 'L2'",
        ("[conventions]", "force_scaling is no convention of measured data", "points.scaling"),
    ),
    "unknown model": (
        (),
        "[fit]\nmodel = 'nomoto'",
        ("key 'fit'", "unknown hull model 'nomoto'", "mmg, mmg-steady"),
    ),
    "unknown term": ((), "[fit]\nterms = ['Yq']", ("key 'fit'", "'q' is not a variable", "variables are")),
    "term twice": ((), "[fit]\nterms = ['Yv', 'Y_v']", ("key 'fit'", "'Y_v' is given twice")),
    "unknown candidate": ((), "[fit]\ncandidates = ['Zv']", ("key 'fit'", "'Zv' is not a term")),
    "model and terms": ((), "[fit]\nmodel = 'mmg'\nterms = ['Yv']", ("key 'fit'", "model or terms, not both")),
    "bounds without constraints": ((), "[fit]\nbounds = { Yv = [-1, 0] }", ("key 'fit'", "'constrained'")),
    "staged Huber": ((), "[fit]\nstaged = true\nestimator = 'huber'", ("staged = true goes with", "not 'huber'")),
    "bootstrap of ridge": (
        (),
        "[fit]\ncovariance = 'bootstrap'\nestimator = 'ridge'",
        ("covariance 'bootstrap'", "not of estimator 'ridge'"),
    ),
    "equality of two forces": (
        (),
        "[fit]\nestimator = 'constrained'\nequalities = [{ terms = { Yv = 1.0, Nv = 1.0 } }]",
        ("equality 1 mixes forces",),
    ),
    "crossed fraction": ((), "[reduction]\nfraction = [0.9, 0.2]", ("key 'reduction.fraction'", "two increasing")),
    "inertia without mass": ((), "[inertia]\ninside = true", ("key 'inertia'", "needs mass and Izz")),
    "dry runs outside": ((), "[inertia]\ndry_runs = true", ("key 'inertia'", "needs inside = true")),
    "unknown output scaling": ((), "[output]\nscaling = 'prim'", ("key 'output.scaling'", "'prim'", "mmg, prime")),
    "nothing to fit": (
        ((LEAST[LEAST.index("[[runs]]") :], ""),),
        "",
        ("a campaign needs [[runs]] or [points]",),
    ),
    "no channels": (
        ((LEAST[LEAST.index("[channels]") : LEAST.index("[[runs]]")], ""),),
        "",
        ("[[runs]] need a [channels] map",),
    ),
    "no time": ((('time = "time [s]"\n', ""),), "", ("[channels] need a time", 'add e.g. time = "Time [s]"')),
    "singular crosstalk": (
        (("[channels]", "[channels]\ncrosstalk = [[1.0, 1.0], [1.0, 1.0]]\ncrosstalk_channels = ['X', 'Y']"),),
        "",
        ("key 'channels'", "singular"),
    ),
    "bad syntax": ((("[ship]", "[ship"),), "", ("not valid TOML", "line 5", "mend the syntax")),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_gets_one_line_with_file_place_cause_and_cure(mistake, written):
    replacements, end, parts = MISTAKES[mistake]
    path = written(*replacements, end=end)
    with pytest.raises(CampaignError) as caught:
        load_campaign_file(path)
    line = str(caught.value)
    assert line.startswith(str(path))
    assert "\n" not in line
    assert " -> " in line
    for part in parts:
        assert part in line
    assert "pydantic" not in line


def test_an_unknown_rule_in_accept_gets_the_closest_ones(written):
    with pytest.raises(CampaignError, match="'densty' is not an audit rule -> closest: density"):
        load_campaign_file(written(text='accept = ["densty"]\n' + LEAST))


def test_several_mistakes_are_counted(written):
    with pytest.raises(CampaignError, match=r"\(and 1 more\)"):
        load_campaign_file(written(end="[reduction]\nlowpass = -1.0\nharmonics = 0\n"))


def test_what_is_not_a_file_of_text(tmp_path):
    for make, cause in (
        (lambda path: None, "file not found"),
        (lambda path: path.mkdir(), "this is a folder"),
        (lambda path: path.write_bytes(b"\x89HDF\r\n\xff\xfe"), "not a text file"),
    ):
        path = tmp_path / cause.replace(" ", "-")
        make(path)
        with pytest.raises(CampaignError, match=cause) as caught:
            load_campaign_file(path)
        assert caught.value.file == str(path)
        assert caught.value.cure
    with pytest.raises(CampaignError, match="not readable"):
        load_campaign_file(tmp_path / "not-a-text-file" / "campaign.toml")
