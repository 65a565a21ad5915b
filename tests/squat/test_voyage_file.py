"""The file of a voyage, checked key by key."""

import pytest

from towtank.core.errors import CampaignError
from towtank.squat.virtual_voyage import virtual_layout, virtual_voyage
from towtank.squat.voyage_file import load_voyage


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return virtual_voyage(step=10.0).write_folder(tmp_path_factory.mktemp("voyage"))


def test_the_file_says_what_the_ship_carries(file):
    layout = load_voyage(file).make_layout()
    assert dict(layout.antennas) == dict(virtual_layout().antennas)
    assert (layout.pitch_positive, layout.roll_positive) == ("bow-up", "port-down")
    assert layout.extra == ("rho", "depth")


def test_what_is_not_given_has_the_values_of_the_source(file):
    voyage = load_voyage(file)
    assert voyage.steady.window == 60.0
    assert voyage.accuracy.make_accuracies().altitude == 0.03
    assert voyage.accuracy.pitch == pytest.approx(0.01)


def test_antennas_that_tell_trim_and_heel_need_no_signs(file):
    text = file.read_text(encoding="utf-8")
    begin, end = text.index("pitch = "), text.index("[tide]")
    other = file.with_name("antennas_only.toml")
    other.write_text(text[:begin] + 'speed = "sog"\n\n' + text[end:], encoding="utf-8")
    assert load_voyage(other).make_layout().knows_heel


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[static]", "[static]\nstrat = 1.0", r"key 'static.strat': unknown key .*closest: start"),
        ("stop = 400.0", "stop = -1.0", "0 to -1 s is empty -> give start before stop"),
        ('file = "tide.csv"', "", "give level or file"),
        ('file = "current.csv"', 'file = "a"\nalong = 1.0', "give along or file"),
        ('column = "rho"', "", "give under_way or column"),
        ('[bottom]\ncolumn = "depth"', "[bottom]", "give charted_depth or column"),
        ("volume = 172000.0", "", "key 'ship': a change of density needs the displaced volume"),
        ("L = 350.0", "L = -350.0", r"L = -350\.0 is not positive"),
        ("rho = 1005.0\n\n[ant", "scale = 40.0\n\n[ant", "key 'ship.scale': the ship is at scale 40"),
        ('pitch_positive = "bow-up"', 'pitch_positive = "up"', r"key 'sensors.pitch_positive'"),
        (
            'pitch_positive = "bow-up"\n',
            "",
            "key 'sensors': which way 'pitch' is positive is not declared .* give pitch_positive bow-down or bow-up",
        ),
        (
            'roll_positive = "port-down"\n',
            "",
            "key 'sensors': which way 'roll' is positive .* give roll_positive starboard-down or port-down",
        ),
        ("B = 51.2", "", "ship: 'B' is missing"),
        ("[voyage]", "[voyage", "not valid TOML"),
    ],
)
def test_what_is_wrong_with_a_file_is_named(file, old, new, said):
    text = file.read_text(encoding="utf-8")
    assert old in text
    other = file.with_name("changed.toml")
    other.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(CampaignError, match=rf"changed\.toml.*{said}"):
        load_voyage(other)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(CampaignError, match=r"nowhere\.toml: file not found -> give the path of a voyage file"):
        load_voyage(tmp_path / "nowhere.toml")
