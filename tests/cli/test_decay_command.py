"""``towtank decay`` and ``towtank demo decay``: what they write, what they print, and what they refuse."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.decay.equation import simulate_decay

B1, B2, C1 = 0.02, 0.12, 6.0
STEP = 0.05
FAST = ("--methods", "integration; extinction curve")
FILES = ["damping.csv", "damping.json", "equivalent_damping.csv", "provenance.json", "report.html"]
KVLCC2 = Path(__file__).resolve().parents[3] / "shared" / "data" / "decay_kvlcc2" / "model_test_21337.csv"

SHIP = """
[ship]
name = "a tanker"
L = 320.0
B = 58.0
T = 20.8
volume = 312600.0
rho = 1000.0
KG = 18.6
GM = 5.73
kxx = 23.2
[ikeda]
midship_coefficient = 0.998
"""


def roll(amplitude: float = 12.0, seed: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Time and roll in degrees with a little noise."""
    time = np.arange(0.0, 45.0, STEP)
    path = simulate_decay(time, (np.radians(amplitude), 0.0), np.array([B1, B2, 0.0, C1, 0.0, 0.0]))[:, 0]
    return time, np.degrees(path) + 0.02 * np.random.default_rng(seed).standard_normal(time.size)


def write(path: Path, time: np.ndarray, angle: np.ndarray, name: str = "phi") -> Path:
    pd.DataFrame({"time": time, name: angle}).to_csv(path, index=False)
    return path


@pytest.fixture
def record(tmp_path) -> Path:
    return write(tmp_path / "roll.csv", *roll())


def values(folder: Path, method: str = "integration") -> pd.DataFrame:
    table = pd.read_csv(folder / "damping.csv")
    return table[table["method"] == method].set_index("name")


def test_record_to_results(towtank, record, tmp_path):
    (tmp_path / "ship.toml").write_text(SHIP)
    ended = towtank(
        "decay",
        record,
        "--unit",
        "deg",
        "--scale",
        68,
        "--ship",
        tmp_path / "ship.toml",
        *FAST,
        "--out",
        tmp_path / "out",
    )
    assert (ended.status, ended.err) == (0, "")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == FILES
    table = pd.read_csv(tmp_path / "out" / "damping.csv")
    assert list(table.columns) == ["method", "model", "name", "value", "std", "lower95", "upper95", "unit"]
    found = values(tmp_path / "out")
    assert found.loc["b1", "lower95"] < B1 < found.loc["b1", "upper95"]
    assert found.loc["b2", "value"] == pytest.approx(B2, rel=0.03)
    assert found.loc["b2", "unit"] == "1/rad"
    curve = pd.read_csv(tmp_path / "out" / "equivalent_damping.csv")
    assert list(curve.columns[:6]) == [
        "method", "model", "amplitude [deg]", "omega [rad/s]", "alpha_e [1/s]", "alpha_e std [1/s]",
    ]  # fmt: skip
    own = curve[curve["method"] == "integration"]
    wanted = 0.5 * B1 + 4.0 / (3.0 * np.pi) * np.sqrt(C1) * np.radians(own["amplitude [deg]"]) * B2
    np.testing.assert_allclose(own["alpha_e [1/s]"], wanted, rtol=0.02)
    inertia = 1000.0 * 312600.0 / 68**3 * 9.80665 * (5.73 / 68) / C1
    np.testing.assert_allclose(own["B44 [N m s]"], 2.0 * wanted * inertia, rtol=0.03)
    page = (tmp_path / "out" / "report.html").read_text()
    for word in ("Extinction curve", "What can be identified", "Beside Ikeda", "CM = 0.998 is outside"):
        assert word in page
    assert "ikeda-limits" in ended.out
    assert "b1 [1/s]" in ended.out
    assert "the records support: linear+quadratic damping, linear restoring" in ended.out


def test_degrees_and_radians_give_the_same_damping(towtank, tmp_path):
    time, angle = roll()
    for name, unit, factor in (("d", "deg", 1.0), ("r", "rad", np.radians(1.0))):
        file = write(tmp_path / f"{name}.csv", time, factor * angle)
        ended = towtank("decay", file, "--unit", unit, *FAST, "--no-report", "--out", tmp_path / name)
        assert ended.status == 0
    for column in ("value", "std"):
        np.testing.assert_allclose(values(tmp_path / "d")[column], values(tmp_path / "r")[column], rtol=1e-6)


def test_several_models_and_json(towtank, record):
    ended = towtank(
        "decay",
        record,
        "--unit",
        "deg",
        "--model",
        "linear,linear+quadratic",
        "--methods",
        "integration",
        "--json",
    )
    assert ended.status == 0
    (group,) = json.loads(ended.out)["groups"]
    assert [one["model"] for one in group["results"]] == ["b1, c1", "b1+b2, c1"]
    assert group["models"]["supported"] == "linear+quadratic"
    assert "model-contradicted" in [item["rule"] for item in group["findings"]]


def test_repeats_are_fitted_together(towtank, record, tmp_path):
    second = write(tmp_path / "again.csv", *roll(9.0, seed=4))
    out = tmp_path / "out"
    options = ("--unit", "deg", "--methods", "integration", "--no-report")
    assert towtank("decay", record, *options, "--out", out).status == 0
    alone = values(out).loc["b2", "std"]
    ended = towtank("decay", record, second, *options, "--out", out)
    assert ended.status == 0
    assert "2 record(s)" in ended.out
    assert values(out).loc["b2", "std"] < alone


def test_campaign_of_two_speeds(towtank, record, tmp_path):
    write(tmp_path / "fast.csv", *roll(10.0, seed=5))
    (tmp_path / "campaign.toml").write_text(
        '[decay]\nname = "two speeds"\n[channels]\nunit = "deg"\n'
        '[[records]]\nfile = "roll.csv"\n[[records]]\nfile = "fast.csv"\nspeed = 0.8\n'
        '[fit]\nmethods = ["integration"]\nrestoring = "linear"\n'
    )
    out = tmp_path / "out"
    ended = towtank("decay", tmp_path / "campaign.toml", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert pd.read_csv(out / "damping.csv")["group"].unique().tolist() == ["roll, 0 m/s", "roll, 0.8 m/s"]
    provenance = json.loads((out / "provenance.json").read_text())
    assert provenance["campaign_file"] == "campaign.toml"
    assert len(provenance["inputs"][str(tmp_path / "fast.csv")]) == 64
    assert (out / "report.html").read_text().count('class="group"') >= 2


def test_demo_shows_the_truth(towtank, tmp_path):
    ended = towtank("demo", "decay", "--out", tmp_path / "demo")
    assert (ended.status, ended.err) == (0, "")
    assert "virtual record: simulated, not measured" in ended.out
    results = tmp_path / "demo" / "virtual-roll-decay" / "results"
    assert sorted(path.name for path in results.iterdir()) == FILES
    page = (results / "report.html").read_text()
    assert "Virtual data." in page
    found = values(results)
    for name, truth in (("b1", 0.0042), ("b2", 0.11), ("c1", 6.06)):
        assert found.loc[name, "lower95"] < truth < found.loc[name, "upper95"]
    (truth_line,) = [line.split() for line in ended.out.splitlines() if line.startswith("truth ")]
    assert truth_line[1:4] == ["0.0042", "0.11", "6.06"]


def spoilt(kind: str, path: Path) -> None:
    """Write a record with a fault."""
    time, angle = roll()
    if kind == "binary":
        path.write_bytes(bytes(range(256)) * 30)
    elif kind == "empty":
        path.write_bytes(b"")
    elif kind == "NaN":
        angle[100:105] = np.nan
        write(path, time, angle)
    elif kind == "gap":
        write(path, np.delete(time, slice(200, 300)), np.delete(angle, slice(200, 300)))
    elif kind == "two samples":
        write(path, time[:2], angle[:2])
    elif kind == "constant":
        write(path, time, np.full_like(angle, 3.0))
    elif kind == "growing":
        write(path, time, angle[::-1])
    elif kind == "text in a cell":
        write(path, time, angle)
        path.write_text(path.read_text().replace("0.05,", "0.05,fail", 1))
    elif kind != "missing":
        write(path, time, angle)


BAD: dict[str, tuple[tuple[object, ...], tuple[str, ...]]] = {
    "missing": ((), ("roll.csv: file not found", "check the path")),
    "binary": ((), ("roll.csv", "binary")),
    "empty": ((), ("roll.csv", "the file is empty", "export the run again")),
    "NaN": ((), ("roll.csv, sample 101", "[not-finite] 5 sample(s)", "--accept not-finite")),
    "gap": ((), ("roll.csv", "[gap] 1 gap(s)", "--accept gap")),
    "two samples": ((), ("roll.csv", "[too-short]", "2 sample(s)", "give the whole record")),
    "constant": ((), ("roll.csv", "[constant] the roll does not move", "check the channel")),
    "growing": ((), ("roll.csv", "do not decay", "check that it is a free decay")),
    "text in a cell": ((), ("roll.csv, line", "'fail", "is not a number")),
    "wrong column": (("--angle", "ph"), ("roll.csv", "no column 'ph'", "closest: phi")),
    "wrong time": (("--time", "seconds"), ("roll.csv", "no column 'seconds'", "the file has time, phi")),
    "unit of a force": (("--unit", "N"), ("roll.csv, channel phi", "unit 'N' does not measure roll")),
    "unknown unit": (("--unit", "dge"), ("roll.csv, channel phi", "unit 'dge' is unknown", "deg")),
    "degrees for radians": (("--unit", "rad"), ("[angle-in-degrees]", "57.3", "--accept angle-in-degrees")),
    "unknown model": (("--model", "quadratik"), ("key 'fit'", "quadratik", "linear, quadratic, cubic")),
    "unknown method": (("--methods", "integrtion"), ("'integrtion' is no method", "closest: integration")),
    "unknown motion": (("--motion", "yaw"), ("motion", "'roll', 'pitch' or 'heave'", "'yaw'")),
    "negative scale": (("--scale", "-3"), ("scale", "greater than 0", "-3")),
    "unknown ship": (("--ship", "nix"), ("no ship 'nix'", "kvlcc2")),
    "window outside": (("--start", "100"), ("roll.csv", "0 sample(s)", "the record runs from 0 to")),
}


@pytest.mark.parametrize("kind", BAD)
def test_one_line_and_nothing_written(kind, towtank, tmp_path):
    options, parts = BAD[kind]
    file = tmp_path / "roll.csv"
    spoilt(kind, file)
    unit = () if "--unit" in options else ("--unit", "deg")
    before = sorted(path.name for path in tmp_path.iterdir())
    ended = towtank("decay", file, *unit, *options, "--out", tmp_path / "out")
    assert (ended.status, ended.out) == (2, ""), ended.err
    assert ended.err.startswith("towtank: ")
    assert ended.err.count("\n") == 1
    assert " -> " in ended.err
    for part in parts:
        assert part in ended.err, ended.err
    assert sorted(path.name for path in tmp_path.iterdir()) == before


def test_missing_unit(towtank, record, tmp_path):
    ended = towtank("decay", record, "--out", tmp_path / "out")
    assert ended.status == 2
    assert "the unit of 'phi' is not declared" in ended.err
    assert "'rad' or 'deg'" in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (('unit = "deg"', 'unti = "deg"'), ("key 'channels.unti'", "unknown key", "closest: unit")),
        (('file = "roll.csv"', 'file = "nil.csv"'), ("nil.csv", "not found")),
        (("speed = 0.8", 'speed = "fast"'), ("key 'records.0.speed'", "'fast'")),
        (("L = 320.0\n", ""), ("[ship]", "'L' is missing")),
        (("midship_coefficient = 0.998", "midship_coefficient = 9.98"), ("midship_coefficient", "less than")),
        (("KG = 18.6\n", ""), ("[ikeda]", "KG is missing")),
        (("[decay]", "[campaign]"), ("captive-test campaign", "towtank run")),
    ],
)  # fmt: skip
def test_campaign_errors_name_the_key(change, parts, towtank, record, tmp_path):
    text = f'[decay]\nname = "a"\n{SHIP}[channels]\nunit = "deg"\n[[records]]\nfile = "roll.csv"\nspeed = 0.8\n'
    text += '[fit]\nmethods = ["integration"]\n'
    assert change[0] in text
    (tmp_path / "campaign.toml").write_text(text.replace(*change))
    ended = towtank("decay", tmp_path / "campaign.toml", "--out", tmp_path / "out")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    for part in parts:
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


def test_results_of_another_kind_are_kept(towtank, record, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "provenance.json").write_text('{"format": "towtank provenance 1", "files": []}')
    ended = towtank("decay", record, "--unit", "deg", "--out", out)
    assert ended.status == 2
    assert "results of another kind" in ended.err
    assert [path.name for path in out.iterdir()] == ["provenance.json"]


def test_one_speed_for_each_file(towtank, record, tmp_path):
    write(tmp_path / "fast.csv", *roll(10.0, seed=5))
    out = tmp_path / "out"
    options = ("--unit", "deg", "--methods", "integration", "--restoring", "linear")
    ended = towtank(
        "decay", record, tmp_path / "fast.csv", *options, "--speed", "0,0.8", "--no-report", "--out", out
    )
    assert (ended.status, ended.err) == (0, "")
    table = pd.read_csv(out / "against_speed.csv")
    assert table["speed [m/s]"].unique().tolist() == [0.0, 0.8]
    joined = towtank(
        "decay", record, tmp_path / "fast.csv", *options, "--speed", "0,0.8", "--speed-terms", "b1*U",
        "--no-report", "--out", out,
    )  # fmt: skip
    assert (joined.status, joined.err) == (0, "")
    found = values(out)
    assert found.loc["b1*U", "lower95"] < 0.0 < found.loc["b1*U", "upper95"]
    assert not (out / "against_speed.csv").exists()
    curve = pd.read_csv(out / "equivalent_damping.csv")
    assert curve["speed [m/s]"].unique().tolist() == [0.0, 0.8]


def test_full_scale_is_the_default(towtank, tmp_path):
    """The same decay in seconds of the ship: B44-hat does not know the scale."""
    time, angle = roll()
    (tmp_path / "ship.toml").write_text(SHIP)
    hats = {}
    for scale in (1.0, 68.0):
        file = write(tmp_path / f"at{scale:g}.csv", time * np.sqrt(68.0 / scale), angle)
        ended = towtank(
            "decay", file, "--unit", "deg", "--ship", tmp_path / "ship.toml", "--methods", "integration",
            *(() if scale == 1.0 else ("--scale", scale)), "--no-report", "--out", tmp_path / f"out{scale:g}",
        )  # fmt: skip
        assert (ended.status, ended.err) == (0, "")
        hats[scale] = pd.read_csv(tmp_path / f"out{scale:g}" / "equivalent_damping.csv")["B44-hat [-]"]
    np.testing.assert_allclose(hats[1.0], hats[68.0], rtol=1e-4)


def radiation(path: Path) -> Path:
    """Table of radiation of a second-order memory at model scale."""
    omega = np.linspace(0.2, 20.0, 60)
    s = 1j * omega
    kernel = 60.0 * s / (s**2 + 3.0 * s + 15.0)
    table = {"omega [rad/s]": omega, "B44 [N m s]": kernel.real, "A44 [kg m2]": 50.0 + kernel.imag / omega}
    pd.DataFrame(table).to_csv(path, index=False)
    return path


def test_memory_beside_the_methods_without_it(towtank, record, tmp_path):
    out = tmp_path / "out"
    ended = towtank(
        "decay", record, "--unit", "deg", "--methods", "integration", "--memory", radiation(tmp_path / "b.csv"),
        "--inertia", 300.0, "--out", out,
    )  # fmt: skip
    assert (ended.status, ended.err) == (0, "")
    assert "radiation memory of order 2" in ended.out
    found = values(out, "integration with memory")
    assert found.loc["inertia", "value"] == 300.0
    assert found.loc["b1", "value"] < values(out).loc["b1", "value"]
    assert {"radiation.csv", "retardation.csv"} <= {path.name for path in out.iterdir()}
    assert "Radiation memory" in (out / "report.html").read_text()


def voyage(path: Path) -> Path:
    """Roll in degrees of a light ship in a broad sea."""
    rng = np.random.default_rng(1)
    time = 0.1 * np.arange(12000)
    angle, rate, position = np.zeros(time.size), 0.0, 0.0
    for k, push in enumerate(0.03 * rng.standard_normal(time.size)):
        rate += 0.1 * (push - 0.04 * rate - 0.36 * position)
        position += 0.1 * rate
        angle[k] = np.degrees(position)
    return write(path, time, angle)


def test_roll_at_sea(towtank, tmp_path):
    file, out = voyage(tmp_path / "voyage.csv"), tmp_path / "out"
    ended = towtank("decay", file, "--unit", "deg", "--at-sea", "--methods", "random decrement", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert sorted(path.name for path in out.iterdir()) == [
        "at_sea.csv", "damping.json", "equivalent_damping.csv", "excitations.csv", "provenance.json", "report.html",
    ]  # fmt: skip
    table = pd.read_csv(out / "at_sea.csv")
    omega = table[table["name"] == "omega"]
    assert (np.abs(omega["value"] - 0.6) < 4.0 * omega["std"]).all()
    assert "random decrement" in ended.out
    again = towtank(
        "decay", file, "--unit", "deg", "--at-sea", "--methods", "random decrement", "--period", 10, "--json"
    )
    assert json.loads(again.out)["records"][0]["guess from"] == "period 10 s given"


def test_what_the_sea_does_not_tell_is_refused(towtank, tmp_path):
    time = np.arange(0.0, 12.0, 0.05)
    file = write(tmp_path / "swell.csv", time, 5.0 * np.sin(3.0 * time + 0.2))
    ended = towtank(
        "decay", file, "--unit", "deg", "--at-sea", "--methods", "joint fit", "--out", tmp_path / "out"
    )
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    for part in ("swell.csv", "parameters are asked", "c1 trades with f and we", "random decrement"):
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("options", "parts"),
    [
        (("--period", 9), ("--period is given without --at-sea", "add --at-sea")),
        (("--inertia", 9), ("--inertia is given without --memory",)),
        (("--speed", "0,1,2"), ("--speed has 3 numbers for 1 file(s)", "one for each file")),
        (("--speed", "fast"), ("--speed fast is no number",)),
        (("--at-sea", "--methods", "joint"), ("'joint' is no method", "closest: joint fit")),
        (("--at-sea", "--memory", "roll.csv"), ("[memory] belongs to free decays",)),
        (("--memory", "nil.csv"), ("nil.csv", "not found")),
    ],
)
def test_options_that_do_not_fit(options, parts, towtank, record, tmp_path):
    ended = towtank("decay", record, "--unit", "deg", *options, "--out", tmp_path / "out")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    for part in parts:
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(not KVLCC2.exists(), reason="the open measurements are not here")
def test_measured_kvlcc2(towtank, tmp_path):
    """Coefficients of the published analysis (window 15 to 3.5 degrees, quintic restoring) within their errors."""
    ended = towtank(
        "decay", KVLCC2, "--angle", "phi", "--unit", "rad", "--scale", 68, "--restoring", "quintic",
        "--methods", "integration", "--no-report", "--out", tmp_path / "out",
    )  # fmt: skip
    assert ended.status == 0
    found = values(tmp_path / "out")
    for name, published in (("b1", 0.003945), ("b2", 0.110187), ("c1", 6.0579)):
        assert abs(found.loc[name, "value"] - published) < 3.0 * found.loc[name, "std"], name
    data = json.loads((tmp_path / "out" / "damping.json").read_text())
    assert data["groups"][0]["results"][0]["diagnostics"]["r2"] > 0.9999
