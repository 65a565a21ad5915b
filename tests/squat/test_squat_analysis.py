"""From a campaign to means, repeats, curves and formulas: truth recovered, and the benchmark's runs."""

import json

import numpy as np
import pytest

from towtank.core.errors import CampaignError, ReadError
from towtank.squat.shipped_squat import write_squat_campaign
from towtank.squat.squat_analysis import run_squat_campaign
from towtank.squat.squat_campaign import command_line_squat
from towtank.squat.steady_squat import SQUAT_COLUMNS

SHIP = {"name": "DTC", "L": 3.984, "B": 0.572, "T": 0.163, "volume": 0.24553, "scale": 89.11}
CHANNELS = {"bow": "z_VF", "stern": "z_VA", "speed": "u", "extra": ["X"]}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return write_squat_campaign(tmp_path_factory.mktemp("squat"))


@pytest.fixture(scope="module")
def shipped(file):
    return run_squat_campaign(file)


def test_the_truth_is_inside_three_standard_errors(shipped):
    (group,) = shipped.groups
    for quantity, true in shipped.truth.items():
        fit = group.fits[quantity]["depth-froude"]
        assert abs(fit.params[0] - true) < 3.0 * np.sqrt(fit.cov[0, 0]), quantity
        low, high = fit.band([0.6])
        assert low[0] < high[0]


def test_table_of_means_has_the_promised_columns(shipped):
    frame = shipped.squat_frame()
    assert tuple(frame.columns) == SQUAT_COLUMNS
    assert frame["run"].nunique() == 8
    assert set(frame["unit"]) == {"m", "m/m", "m/s"}
    inside = frame[frame["run"] == "run_12kn"].set_index("quantity")
    speed = inside.loc["speed", "mean"]
    square = speed**2 / (9.80665 * 0.2025)
    true = 0.0190 * square / np.sqrt(1.0 - square)
    # the shift of a run, 0.04 mm, is no part of its standard error
    assert inside.loc["sinkage_bow", "mean"] == pytest.approx(true, abs=2.5e-4)


def test_runs_of_one_speed_are_pooled_and_said_so(shipped):
    (repeats,) = shipped.repeats
    assert [run.run for run in repeats.runs] == ["run_12kn", "run_12kn_again", "run_12kn_third"]
    said = [item for item in shipped.findings if item.rule == "repeats-pooled"]
    assert "3 runs are pooled" in said[0].message
    bow = repeats.pooled["sinkage_bow"]
    assert bow.half_width == pytest.approx(4.3027 * bow.sd / np.sqrt(3), rel=1e-4)


def test_waves_keep_out_of_the_curve(shipped):
    (group,) = shipped.groups
    assert len(group.curve.points) == 7
    frame = shipped.waves_frame().set_index("quantity")
    assert frame.loc["sinkage_bow", "amplitude_1"] == pytest.approx(2.1e-3, rel=0.02)
    assert frame.loc["sinkage_stern", "amplitude_1"] == pytest.approx(1.6e-3, rel=0.02)
    assert frame.loc["trim", "omega"] == pytest.approx(6.8, abs=5e-3)
    lead = frame.loc["sinkage_bow", "phase_1"] - frame.loc["sinkage_stern", "phase_1"]
    assert lead == pytest.approx(1.6, abs=0.05)


def test_full_scale_by_froude(shipped):
    model, ship = shipped.curve_frame(), shipped.full_scale_frame()
    np.testing.assert_allclose(ship["sinkage_bow [m]"], 80.0 * model["sinkage_bow [m]"])
    np.testing.assert_allclose(ship["speed [m/s]"], np.sqrt(80.0) * model["speed [m/s]"])
    np.testing.assert_allclose(ship["trim [m/m]"], model["trim [m/m]"])
    np.testing.assert_allclose(ship["depth_froude [-]"], model["depth_froude [-]"])


def test_formulas_stand_beside_the_measurement(shipped):
    scores = shipped.groups[0].comparison.scores
    ranked = scores[scores["place"] == "maximum"]
    assert ranked["rms"].is_monotonic_increasing
    outside = scores[scores["applicable"] == 0]["formula"].unique()
    # h/T is 1.5 to the last bit but one: the two are inside their limits
    assert set(outside) == {"eryuzlu", "yoshimura"}
    icorels = ranked.set_index("formula").loc["icorels"]
    assert icorels["bias"] == pytest.approx(4.1e-4, rel=0.1)


def test_everything_goes_to_json(shipped):
    data = json.loads(json.dumps(shipped.to_dict()))
    assert data["virtual"] is True
    assert len(data["squat"]) == len(shipped.squat_frame())
    assert data["fits"][0]["quantity"] == "sinkage_bow"


def test_unrepeated_when_told_so(file):
    text = file.read_text()
    other = file.with_name("apart.toml")
    other.write_text(text + "\n[fit]\nsame_speed = 0.0\n[output]\nformulas = false\n")
    result = run_squat_campaign(other)
    assert result.repeats == ()
    assert result.repeats_frame().empty
    assert result.formulas_frame().empty


def test_steps_filter_and_speed_without_a_channel(file, tmp_path):
    folder = file.parent
    sections = {
        "ship": {"name": "s", "L": 2.875, "B": 0.4025, "T": 0.135, "volume": 0.1016},
        "channels": {"bow": "bow", "stern": "stern"},
        "fairway": {"depth": 0.2025},
        "filter": {"name": "butterworth", "cutoff": 1.0},
        "window": {"rule": "key-times", "start": 30.0, "stop": 55.0},
        "output": {"formulas": False},
    }
    campaign = command_line_squat(
        [folder / "run_12kn.csv"], record={"speed": 0.69, "condition": "a"}, sections=sections
    )
    result = run_squat_campaign(campaign)
    (one,) = result.steady
    assert one.means["speed"].mean == pytest.approx(0.69)
    assert any("butterworth filter, 1 Hz" in step for step in result.runs[0].steps)
    stepped = {**sections, "steps": {"last": 20.0}, "channels": {**sections["channels"], "speed": "speed"}}
    result = run_squat_campaign(command_line_squat([folder / "run_12kn.csv"], record={}, sections=stepped))
    (step,) = result.steady
    assert step.run == "run_12kn 1"
    assert step.window.stop_time - step.window.start_time == pytest.approx(20.0, abs=0.1)


def test_a_correction_moves_the_points_and_says_what_it_needs(file):
    text = file.read_text()
    other = file.with_name("corrected.toml")
    other.write_text(
        text.replace("depth = 0.2025", "depth = 0.2025\nwidth = 4.0") + '\n[correction]\nname = "kreitner"\n'
    )
    result = run_squat_campaign(other)
    moved, measured = result.corrected_frame(), result.curve_frame()
    assert (moved["speed [m/s]"] > 1.05 * measured["speed [m/s]"]).all()
    np.testing.assert_allclose(moved["sinkage_bow [m]"], measured["sinkage_bow [m]"])
    other.write_text(text + '\n[correction]\nname = "kreitner"\n')
    with pytest.raises(CampaignError, match="needs section -> add the width of the tank"):
        run_squat_campaign(other)


def test_a_missing_run_is_named(file):
    other = file.with_name("missing.toml")
    other.write_text(file.read_text() + '\n[[records]]\nfile = "nil.csv"\n')
    with pytest.raises(ReadError, match=r"nil\.csv: file not found"):
        run_squat_campaign(other)


def test_published_runs_of_the_benchmark(benchmark_run):
    files = [benchmark_run("C1"), benchmark_run("C2")]
    sections = {"ship": SHIP, "channels": CHANNELS, "fairway": {"depth": 0.326}}
    result = run_squat_campaign(command_line_squat(files, record={}, sections=sections))
    frame = result.squat_frame().set_index(["run", "quantity"])["mean"]
    for run, bow, stern in (("C1", 0.88e-3, 0.58e-3), ("C2", 8.34e-3, 5.01e-3)):
        assert frame[run, "sinkage_bow"] == pytest.approx(bow, rel=0.02)
        assert frame[run, "sinkage_stern"] == pytest.approx(stern, rel=0.02)
    rules = {item.rule for item in result.findings}
    assert {"units-row", "moment-named-as-angle", "not-utf8", "heading-width"} <= rules
    assert result.repeats == ()


def test_published_run_in_waves(benchmark_run):
    sections = {"ship": SHIP, "channels": CHANNELS, "fairway": {"depth": 0.326}}
    record = {"waves": True, "start": 63.5, "stop": 79.2}
    result = run_squat_campaign(command_line_squat([benchmark_run("CW3")], record=record, sections=sections))
    waves = result.waves_frame().set_index("quantity")
    assert waves.loc["sinkage_midship", "mean"] == pytest.approx(7.06e-3, rel=0.03)
    assert waves.loc["sinkage_midship", "amplitude_1"] == pytest.approx(5.55e-3, rel=0.01)
    assert waves.loc["X", "amplitude_1"] == pytest.approx(8.55, rel=0.01)
    means = result.squat_frame().set_index("quantity")
    assert means.loc["sinkage_bow", "mean"] == waves.loc["sinkage_bow", "mean"]
    assert (means.loc["trim", "window_start"], means.loc["trim", "window_end"]) == pytest.approx((63.5, 79.2))
