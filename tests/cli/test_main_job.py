"""The command line as a user meets it: results, formats, exit status, errors in one line."""

import json

import pandas as pd
import pytest

from towtank.cli.main import main
from towtank.core import DerivativeSet
from towtank.pmm.shipped_campaigns import write_points_campaign


@pytest.fixture
def towtank(capsys):
    """Run a command; returns exit status, standard output and standard error."""

    def run(*words):
        with pytest.raises(SystemExit) as ended:
            main([str(word) for word in words])
        out, err = capsys.readouterr()
        return ended.value.code or 0, out, err

    return run


@pytest.fixture
def campaign(tmp_path):
    return write_points_campaign(tmp_path / "dtc")


def test_demo_prints_both_tables_and_the_way_to_the_reports(towtank, tmp_path):
    status, out, err = towtank("demo", "--out", tmp_path / "demo")
    assert (status, err) == (0, "")
    assert "DTC static drift" in out
    assert "DTMB 5512" in out
    assert "20/20 zig-zag: first overshoot" in out
    for folder in ("dtc-static-drift", "dtmb5512-virtual-pmm", "kvlcc2-virtual-manoeuvres"):
        results = tmp_path / "demo" / folder / "results"
        assert str(results / "report.html") in out
        assert (results / "report.html").stat().st_size > 50_000
    sailed = (tmp_path / "demo" / "kvlcc2-virtual-manoeuvres" / "results" / "report.html").read_text(
        encoding="utf-8"
    )
    assert "Virtual data." in sailed
    for shown in ("turning +35: 40 draws", "overshoot 2 over 200 draws", "IMO standards for ship manoeuvrability"):
        assert shown in sailed


def test_run_writes_what_it_promises(towtank, campaign, tmp_path):
    out = tmp_path / "results"
    status, text, _ = towtank("run", campaign, "--out", out)
    assert status == 0
    assert "Yvvv" in text
    names = {path.name for path in out.iterdir()}
    promised = {
        "derivatives.csv",
        "derivatives.json",
        "harmonics.csv",
        "runs.csv",
        "provenance.json",
        "report.html",
    }
    assert promised <= names
    table = pd.read_csv(out / "derivatives.csv")
    assert list(table) == ["name", "value", "std", "lower95", "upper95", "scaling"]
    found = DerivativeSet.from_json(out / "derivatives.json")
    assert list(found.names) == table["name"].tolist()
    assert found.values.tolist() == pytest.approx(table["value"].tolist(), rel=1e-12)
    assert json.loads((out / "provenance.json").read_text())


@pytest.mark.parametrize(
    ("name", "printed", "share"),
    [
        ("R0", 0.0176, 0.02),
        ("Xvv", -0.0617, 0.02),
        ("Xvvvv", 0.1304, 0.02),
        ("Yv", -0.0903, 0.01),
        ("Yvvv", -1.86, 0.01),
        ("Nv", -0.1005, 0.01),
        ("Nvvv", 0.0359, 0.01),
    ],
)
def test_dtc_model_test_returns_the_printed_derivatives(towtank, campaign, tmp_path, name, printed, share):
    towtank("run", campaign, "--out", tmp_path / "r", "--no-report")
    found = DerivativeSet.from_json(tmp_path / "r" / "derivatives.json")
    assert found[name] == pytest.approx(printed, rel=share)


def test_an_error_leaves_old_results_and_nothing_half_written(towtank, campaign, tmp_path):
    out = tmp_path / "results"
    towtank("run", campaign, "--out", out, "--no-report")
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    campaign.write_text(campaign.read_text().replace("X_EFD", "X_none"))
    status, text, err = towtank("run", campaign, "--out", out)
    assert (status, text) == (2, "")
    assert "X_none" in err
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert {path.name for path in tmp_path.iterdir()} == {"dtc", "results"}


def _spoil(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[campaign]", "[campaign", "TOML"),
        ('model = "mmg-drift"', 'modle = "mmg-drift"', "fit.modle"),
        ('model = "mmg-drift"', 'model = "mmg-drfit"', "mmg-drift"),
        ('model = "mmg-drift"', 'terms = ["Yv", "Yq"]', "Yq"),
        ('model = "mmg-drift"', 'terms = ["R0", "Yv", "Yr"]', "Yr"),
        ('scaling = "LT"', 'scaling = "LD"', "points.scaling"),
        ('scaling = "LT"', 'scaling = "L2"', "l2-against-lt"),
        ('table = "dtc-drift-points-63"', 'table = "dtc-drift-points-64"', "dtc-drift-points-63"),
        ("T = ", "T = -", "T = -0.2278"),
    ],
)
def test_faults_of_a_campaign_file_end_in_one_line(towtank, campaign, tmp_path, old, new, said):
    _spoil(campaign, old, new)
    status, out, err = towtank("run", campaign, "--out", tmp_path / "results")
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert err.startswith("towtank: ")
    assert said in err
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize("make", ["missing", "folder", "binary"])
def test_what_is_not_a_campaign_file_is_refused(towtank, tmp_path, make):
    path = tmp_path / "campaign.toml"
    if make == "folder":
        path.mkdir()
    if make == "binary":
        path.write_bytes(b"\x89PNG\r\n\x1a\n\x00\x00\xff\xfe")
    status, _, err = towtank("run", path, "--out", tmp_path / "results")
    assert status == 2
    assert err.count("\n") == 1
    assert str(path) in err


def test_debug_shows_the_traceback(tmp_path):
    from towtank.core.errors import CampaignError

    with pytest.raises(CampaignError):
        main(["run", str(tmp_path / "none.toml"), "--debug"])


def test_an_unknown_option_or_command_is_a_user_error(towtank):
    for words in (["run"], ["fly"], ["convert", "kvlcc2", "--into", "prime"]):
        status, _, err = towtank(*words)
        assert status == 2
        assert err.strip()


@pytest.mark.parametrize(
    "command",
    [
        "demo",
        "run",
        "audit",
        "init",
        "sets",
        "show",
        "convert",
        "export",
        "compare",
        "synthesize",
        "plan",
        "reproduce",
    ],
)
def test_every_help_has_an_example(towtank, command):
    status, out, _ = towtank(command, "--help")
    assert status == 0
    assert "Example: towtank" in out


def test_version(towtank):
    from towtank import __version__

    assert towtank("--version")[1].strip() == f"towtank {__version__}"


def test_convert_there_and_back_is_exact(towtank, tmp_path):
    there, back = tmp_path / "there.json", tmp_path / "back.json"
    assert towtank("convert", "kvlcc2", "--to", "prime", "--out", there)[0] == 0
    assert towtank("convert", there, "--to", "mmg", "--out", back)[0] == 0
    from towtank.datasets import load_set

    start, end = load_set("kvlcc2"), DerivativeSet.from_json(back)
    for name in start.names:
        assert end[name] == pytest.approx(start[name], rel=1e-12)


@pytest.mark.parametrize(("words", "said"), [
    (("convert", "kvlcc2", "--to", "primeval"), "primeval"),
    (("convert", "kvlcc9", "--to", "prime"), "kvlcc2"),
    (("export", "kvlcc2", "--for", "ansys"), "shipmmg"),
    (("reproduce", "dtc-pmn"), "dtc-pmm"),
    (("plan", "kvlcc2", "--matrix", "generl"), "general"),
    (("synthesize", "kvlcc2", "--format", "pdf"), "simman"),
    (("init", "nowhere"), "nowhere"),
    (("audit", "none.toml"), "none.toml"),
])  # fmt: skip
def test_wrong_names_list_the_right_ones(towtank, words, said):
    status, out, err = towtank(*words)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert said in err


def test_a_misspelt_waiver_is_refused(towtank, campaign, tmp_path):
    status, _, err = towtank("run", campaign, "--accept", "densty", "--out", tmp_path / "r")
    assert status == 2
    assert "density" in err


def test_reproduce_as_json_has_the_promised_keys(towtank):
    status, out, _ = towtank("reproduce", "s175", "--json")
    cases = json.loads(out)
    assert status == 0
    keys = {"paper", "case", "quantity", "printed", "computed", "tolerance", "verdict", "note"}
    assert all(set(case) == keys for case in cases)
    misprint = [case for case in cases if case["verdict"] == "reproduced-after-correction"]
    assert any("Nrrr" in case["quantity"] for case in misprint)


def test_compare_scores_a_set_against_itself(towtank, tmp_path):
    status, out, _ = towtank("compare", "dtc-drift-efd", "dtc-drift-cfd-63", "--out", tmp_path / "c.csv")
    assert status == 0
    assert "Q =" in out
    assert "BS =" in out
    assert "Yvvv" in pd.read_csv(tmp_path / "c.csv")["name"].tolist()


@pytest.mark.parametrize(
    ("target", "number"),
    [("shipmmg", "-0.315"), ("mss", "-0.020475"), ("csv", "-0.315"), ("latex", "-0.315"), ("json", "-0.315")],
)
def test_export_prints_what_a_simulator_takes(towtank, target, number):
    # mss takes prime I: -0.315 T/L
    status, out, err = towtank("export", "kvlcc2", "--for", target)
    assert (status, err) == (0, "")
    assert number in out


def test_export_to_a_workbook(towtank, tmp_path):
    assert towtank("export", "kvlcc2", "--for", "xlsx", "--out", tmp_path / "k.xlsx")[0] == 0
    assert (tmp_path / "k.xlsx").stat().st_size > 4000


def test_synthesize_then_run_recovers_the_set(towtank, tmp_path):
    folder = tmp_path / "virtual"
    status, out, _ = towtank(
        "synthesize", "kvlcc2", "--matrix", "general", "--out", folder, "--sampling-rate", 10, "--duration", 10
    )
    assert status == 0
    assert "virtual runs" in out
    status, _, _ = towtank("run", folder / "campaign.toml", "--out", tmp_path / "r", "--no-report", "--quiet")
    assert status == 0
    from towtank.datasets import load_set

    truth = load_set("kvlcc2").to("added-mass-inside")
    found = DerivativeSet.from_json(tmp_path / "r" / "derivatives.json")
    for name in ("Yv", "Nv", "Yr", "Nr", "Yvvr", "Nvrr"):
        assert found[name] == pytest.approx(truth[name], abs=1e-6)


def test_plan_answers_how_many_repeats(towtank):
    status, out, _ = towtank("plan", "kvlcc2", "--matrix", "general", "--for", "Nv", "--within", 0.05)
    assert status == 0
    assert "Nv: the programme gives" in out
    assert "best next runs" in out


def test_lists(towtank):
    assert "kvlcc2" in towtank("sets")[1]
    assert "dtc-drift-points-63" in towtank("sets", "--tables")[1]
    assert "l2-against-lt" in towtank("audit", "--list")[1]
    assert "dtmb5512" in towtank("synthesize", "--list")[1]
    assert "dtc-pmm" in towtank("reproduce", "--list")[1]
    assert "Yasukawa" in towtank("show", "kvlcc2")[1]
