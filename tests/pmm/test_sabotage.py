"""Every rule of the audit: a sabotaged copy of a shipped campaign triggers it, and no clean one triggers any."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.core.conventions import Conventions
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import AuditError
from towtank.formats.write import write_table
from towtank.pmm.audit_rules import RULES
from towtank.pmm.campaign import Campaign
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.shipped_campaigns import write_pmm_campaign, write_points_campaign
from towtank.pmm.standard_matrices import standard_matrix
from towtank.pmm.virtual_campaign import synthesize

DRIFT, TOW, SWAY, YAW = "03_drift_-12_deg.txt", "09_drift_+0_deg.txt", "20_sway_v_0.266_m_s.txt", "26_*.txt"


@pytest.fixture(scope="session")
def shipped(tmp_path_factory) -> dict[str, Path]:
    """Folders of the shipped campaigns, and of a small one in the SIMMAN form."""
    folder = tmp_path_factory.mktemp("shipped")
    pmm = write_pmm_campaign(folder / "pmm").parent
    points = write_points_campaign(folder / "points").parent
    truth = Campaign.load(pmm / "campaign.toml")
    # Every other run is enough to be sabotaged.
    every = pd.read_csv(pmm / "matrix.csv")
    every[(every.index % 2 == 0) | (every["type"] == "pure_sway")].to_csv(pmm / "matrix.csv", index=False)
    derivatives = DerivativeSet.from_json(pmm / "truth.json")
    runs = [run for run in standard_matrix("dtmb5512", truth.ship) if run.kind == "static_drift"][4:13:2]
    quick = Laboratory(sampling_rate=5.0, conventions=Conventions(angle_unit="deg"))
    terms = ["R0", "Yv", "Yvvv", "Nv", "Nvvv"]
    synthesize(
        derivatives, runs, folder / "simman", name="SIMMAN", fmt="simman", fit_terms=terms, laboratory=quick
    )
    return {"pmm": pmm, "points": points, "simman": folder / "simman"}


# -- changes of files ----------------------------------------------------------------------------------------


@dataclass
class Sheet:
    """One run file as columns that a test may spoil."""

    header: list[str]
    units: dict[str, str]
    columns: dict[str, np.ndarray] = field(default_factory=dict)

    @classmethod
    def read(cls, path: Path) -> Sheet:
        lines = path.read_text().splitlines()
        header = [line.removeprefix("# ") for line in lines if line.startswith("#")]
        names, units, *_ = (line.split("\t") for line in lines if not line.startswith("#"))
        values = np.loadtxt(path, skiprows=len(header) + 2)
        return cls(header, dict(zip(names, units, strict=True)), dict(zip(names, values.T.copy(), strict=True)))

    def write(self, path: Path, **form: str) -> None:
        write_table(path, self.columns, self.units, header=self.header, **form)

    def keep(self, rows) -> None:
        self.columns = {name: values[rows] for name, values in self.columns.items()}

    @property
    def middle(self) -> int:
        return len(self.columns["time"]) // 2


def columns(files: str, change: Callable[[Sheet], None], **form: str) -> Callable[[Path], None]:
    """Spoil the columns of all run files of a pattern."""

    def spoil(folder: Path) -> None:
        paths = sorted((folder / "runs").glob(files))
        assert paths
        for path in paths:
            sheet = Sheet.read(path)
            change(sheet)
            path.unlink()
            sheet.write(path, **form)

    return spoil


def text(files: str, change: Callable[[list[str]], object], encoding: str = "utf-8") -> Callable[[Path], None]:
    """Spoil the lines of a run file, in place or by what `change` returns."""

    def spoil(folder: Path) -> None:
        (path,) = (folder / "runs").glob(files)
        lines = path.read_text().splitlines(keepends=True)
        lines = change(lines) or lines
        path.unlink()
        path.write_text("".join(lines), encoding=encoding)

    return spoil


def campaign(*changes: tuple[str, str]) -> Callable[[Path], None]:
    """Replace texts of the campaign file."""

    def spoil(folder: Path) -> None:
        path = folder / "campaign.toml"
        content = path.read_text()
        for old, new in changes:
            assert old in content
            content = content.replace(old, new)
        path.unlink()
        path.write_text(content)

    return spoil


def matrix(change: Callable[[pd.DataFrame], object]) -> Callable[[Path], None]:
    """Change the test matrix."""

    def spoil(folder: Path) -> None:
        path = folder / "matrix.csv"
        frame = pd.read_csv(path).set_index("name")
        change(frame)
        path.unlink()
        frame.to_csv(path)

    return spoil


def both(*spoilers: Callable[[Path], None]) -> Callable[[Path], None]:
    def spoil(folder: Path) -> None:
        for one in spoilers:
            one(folder)

    return spoil


def exported(ending: str, write: Callable[[Path, Sheet], None]) -> Callable[[Path], None]:
    """Put the file of one drift run into another format."""

    def spoil(folder: Path) -> None:
        path = folder / "runs" / DRIFT
        write(path.with_suffix(ending), Sheet.read(path))
        matrix(lambda f: f.__setitem__("file", f["file"].replace(f"runs/{DRIFT}", f"runs/{path.stem}{ending}")))(
            folder
        )

    return spoil


def workbook(path: Path, sheet: Sheet, *, as_text: bool = False, sheets: int = 1) -> None:
    from openpyxl import Workbook

    book = Workbook()
    for number in range(sheets):
        page = book.active if number == 0 else book.create_sheet(f"copy {number}")
        page.append(list(sheet.columns))
        page.append(list(sheet.units.values()))
        for row in np.column_stack(list(sheet.columns.values())).tolist():
            page.append([str(row[0]) if as_text else row[0], *row[1:]])
    book.save(path)


def tdms(path: Path, sheet: Sheet) -> None:
    nptdms = pytest.importorskip("nptdms")
    stamps = np.datetime64("2020-05-04T10:00:00") + (sheet.columns["time"] * 1e6).astype("timedelta64[us]")
    channels = [nptdms.ChannelObject("run", "time", stamps)]
    for name, unit in sheet.units.items():
        if name != "time":
            channels.append(nptdms.ChannelObject("run", name, sheet.columns[name], {"unit_string": unit}))
    with nptdms.TdmsWriter(path) as writer:
        writer.write_segment(channels)


def points_with_a_stray_array(folder: Path) -> None:
    from scipy.io import savemat

    from towtank.datasets import load_table

    frame = load_table("dtc-drift-points-63").frame
    arrays = {name: frame[name].to_numpy() for name in ("v", "X_EFD", "Y_EFD", "N_EFD")}
    savemat(folder / "points.mat", arrays | {"calibration": np.arange(4.0)})
    campaign(('table = "dtc-drift-points-63"', 'file = "points.mat"'))(folder)


def change(sheet: Sheet, name: str, values) -> None:
    sheet.columns[name] = np.asarray(values, dtype=float)


def jittered(sheet: Sheet) -> None:
    time = sheet.columns["time"]
    step = time[1] - time[0]
    change(sheet, "time", time + step * np.random.default_rng(0).uniform(-0.3, 0.3, len(time)))


def backwards(sheet: Sheet) -> None:
    order = np.arange(len(sheet.columns["time"])).reshape(-1, 2)[:, ::-1].ravel()
    sheet.keep(order[200:600])


def twice(sheet: Sheet) -> None:
    """Every tenth time stamp is that of the sample before."""
    sheet.columns["time"][10::10] = sheet.columns["time"][9:-1:10]


def restarted(sheet: Sheet) -> None:
    n = len(sheet.columns["time"])
    sheet.keep(np.r_[0 : n // 2, n // 2 - 120 : n])


def clipped(sheet: Sheet) -> None:
    limit = 0.6 * np.abs(sheet.columns["Y"]).max()
    change(sheet, "Y", np.clip(sheet.columns["Y"], -limit, limit))


def spiked(sheet: Sheet) -> None:
    sheet.columns["Y"][sheet.middle] += 5 * np.ptp(sheet.columns["Y"])


def drifting(sheet: Sheet) -> None:
    time = sheet.columns["time"]
    change(sheet, "Y", sheet.columns["Y"] * (0.2 + 1.6 * time / time[-1]))


def exchanged(sheet: Sheet, a: str, b: str) -> None:
    sheet.columns[a], sheet.columns[b] = sheet.columns[b], sheet.columns[a]


def along_the_tank(sheet: Sheet) -> None:
    change(sheet, "u", sheet.columns["speed"])
    change(sheet, "v", 0.0 * sheet.columns["v"])


def later(sheet: Sheet) -> None:
    change(sheet, "time", sheet.columns["time"] + 0.5)


def with_rudder(sign: float) -> Callable[[Path], None]:
    """A straight run becomes a run with 10 deg of rudder to starboard, the angle recorded with `sign`."""

    def add(sheet: Sheet) -> None:
        sheet.units["delta"] = "deg"
        change(sheet, "delta", np.zeros(len(sheet.columns["time"])))

    def turn(sheet: Sheet) -> None:
        change(sheet, "delta", np.full(len(sheet.columns["time"]), sign * 10.0))

    def mark(frame: pd.DataFrame) -> None:
        frame["rudder_angle"] = 0.0
        frame.loc["drift +0 deg", "rudder_angle"] = 10.0

    return both(
        columns("*.txt", add),
        columns(TOW, turn),
        matrix(mark),
        campaign(("[inertia]\n", 'rudder_angle = { column = "delta", unit = "deg" }\n\n[inertia]\n')),
    )


# -- the table -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Sabotage:
    """What is done to a shipped campaign, and which rules see it."""

    spoil: Callable[[Path], None]
    severity: str = "error"
    base: str = "pmm"
    also: tuple[str, ...] = ()


SABOTAGE: dict[str, Sabotage] = {
    # -- by the reader
    "ragged-last-line": Sabotage(text(DRIFT, lambda lines: [*lines[:-1], lines[-1][:25]]), "warning"),
    "blank-rows": Sabotage(text(DRIFT, lambda lines: lines.insert(900, "\n")), "warning"),
    "comment-in-data": Sabotage(text(DRIFT, lambda lines: lines.insert(900, "# restart\n")), "warning"),
    "units-fewer-than-columns": Sabotage(
        text(DRIFT, lambda lines: lines.__setitem__(3, lines[3].rsplit("\t", 1)[0] + "\n")), "warning"
    ),
    "names-fewer-than-columns": Sabotage(
        both(
            text(DRIFT, lambda lines: lines.__setitem__(2, lines[2].replace("\tx\t", "\t\t"))),
            campaign(('x = { column = "x", unit = "m" }\n', "")),
        ),
        "warning",
    ),
    "duplicate-columns": Sabotage(
        text(
            DRIFT, lambda lines: [*lines[:2], *(f"{a.strip()}\t{b}" for a, b in zip(lines[2:], repeat_x(lines)))]
        ),
        "warning",
    ),
    "text-column": Sabotage(
        text(DRIFT, lambda ls: [*ls[:2], *(f"{a.rstrip()}\t{b}\n" for a, b in zip(ls[2:], remarks()))]), "warning"
    ),
    "left-out": Sabotage(points_with_a_stray_array, "warning", base="points"),
    "numbers-as-text": Sabotage(exported(".xlsx", lambda p, s: workbook(p, s, as_text=True)), "warning"),
    "first-sheet": Sabotage(exported(".xlsx", lambda p, s: workbook(p, s, sheets=2)), "info"),
    "time-stamps": Sabotage(exported(".tdms", tdms), "info"),
    "no-condition-file": Sabotage(
        lambda folder: next((folder / "runs").glob("*.cond")).unlink(), "warning", "simman"
    ),
    # -- in the header
    "decimal-comma": Sabotage(columns(DRIFT, lambda s: None, decimal=","), "info"),
    "header-encoding": Sabotage(
        text(DRIFT, lambda lines: lines.insert(0, "# Schräganströmung 12°\n"), "latin-1"), "info"
    ),
    "wrong-length": Sabotage(columns(DRIFT, lambda s: s.header.append("Lpp: 3.2"))),
    "density": Sabotage(columns(DRIFT, lambda s: s.header.append("water density: 1025"))),
    "scale-label": Sabotage(columns(DRIFT, lambda s: s.header.append("scale: 1:35.5"))),
    # -- time
    "too-short": Sabotage(columns(DRIFT, lambda s: s.keep(slice(700, 708)))),
    "time-not-increasing": Sabotage(columns(DRIFT, backwards)),
    "time-duplicated": Sabotage(columns(DRIFT, twice), also=("non-uniform-sampling",)),
    "time-rounded": Sabotage(columns(DRIFT, lambda s: change(s, "time", np.floor(10 * s.columns["time"]) / 10))),
    "time-overlap": Sabotage(columns(DRIFT, restarted)),
    "gap": Sabotage(columns(DRIFT, lambda s: s.keep(np.r_[0:900, 1100 : 2 * s.middle]))),
    "non-uniform-sampling": Sabotage(columns(DRIFT, jittered), "warning"),
    # -- channels
    "missing-values": Sabotage(columns(DRIFT, lambda s: s.columns["Y"].__setitem__(slice(800, 805), np.nan))),
    "constant-channel": Sabotage(
        columns(DRIFT, lambda s: change(s, "Y", np.full_like(s.columns["Y"], 3.0))),
        also=("transient-only",),
    ),
    "saturated-channel": Sabotage(columns(SWAY, clipped), "warning"),
    "spikes": Sabotage(columns(DRIFT, spiked), "warning"),
    "transient-only": Sabotage(columns(DRIFT, drifting)),
    "short-of-whole-cycles": Sabotage(columns(SWAY, lambda s: s.keep(slice(0, 340)))),
    # -- motion
    "swapped-channels": Sabotage(columns(DRIFT, lambda s: exchanged(s, "u", "v"))),
    "earth-fixed-velocities": Sabotage(columns(DRIFT, along_the_tank)),
    "angle-in-degrees": Sabotage(campaign(('column = "psi", unit = "deg"', 'column = "psi", unit = "rad"'))),
    "length-in-millimetres": Sabotage(columns(SWAY, lambda s: change(s, "y", 1000 * s.columns["y"]))),
    "speed-mismatch": Sabotage(
        columns(DRIFT, lambda s: [change(s, name, 1.2 * s.columns[name]) for name in ("speed", "u", "v", "x")])
    ),
    "drift-sign": Sabotage(campaign(('column = "v", unit = "m/s"', 'column = "v", unit = "m/s", sign = -1'))),
    "rudder-sign": Sabotage(with_rudder(-1.0)),
    "frequency-mismatch": Sabotage(
        matrix(lambda f: f.__setitem__("frequency", f["frequency"].replace(0.841, 0.841 / (2 * np.pi))))
    ),
    "amplitude-mismatch": Sabotage(columns(SWAY, lambda s: change(s, "y", 1.4 * s.columns["y"]))),
    "phase-mismatch": Sabotage(columns(SWAY, later)),
    # -- across runs
    "force-sign": Sabotage(
        campaign(*((f'column = "{name}", unit', f'column = "{name}", sign = -1, unit') for name in "XYN"))
    ),
    "inertia-inside": Sabotage(campaign(("inside = true", "inside = false"))),
    "inertia-outside": Sabotage(campaign(("inside = true\nmass = 86.0", "inside = true\nmass = 172.0"))),
    "moment-reference": Sabotage(campaign(("moment_x = 0.0", "moment_x = 3.0"))),
    "l2-against-lt": Sabotage(campaign(('scaling = "LT"', 'scaling = "L2"')), base="points"),
    "force-unit": Sabotage(
        campaign(*((f'column = "{n}", unit = "N', f'column = "{n}", unit = "kN') for n in "XYN"))
    ),
}


def repeat_x(lines: list[str]) -> list[str]:
    return ["x\n", "m\n", *("0\n" for _ in lines[4:])]


def remarks():
    yield "remark"
    yield "-"
    while True:
        yield "good"


def test_the_table_covers_every_rule():
    assert set(SABOTAGE) == set(RULES)


@pytest.fixture
def copy(shipped, tmp_path) -> Callable[[str], Path]:
    """A copy of a shipped campaign, whose files are linked until they are changed."""

    def make(base: str) -> Path:
        return Path(shutil.copytree(shipped[base], tmp_path / base, copy_function=os.link))

    return make


@pytest.mark.parametrize("rule", SABOTAGE)
def test_a_sabotaged_campaign_triggers_the_rule(rule, copy):
    case = SABOTAGE[rule]
    folder = copy(case.base)
    case.spoil(folder)
    loaded = Campaign.load(folder / "campaign.toml")
    findings = loaded.audit()
    mine = [item for item in findings if item.rule == rule]
    assert mine, f"{rule} was not seen; seen were {sorted({item.rule for item in findings})}"
    assert case.severity in {item.severity for item in mine}
    others = {item.rule for item in findings} - {rule, *case.also}
    assert not others, f"further rules: {[item for item in findings if item.rule in others]}"
    assert all(item.message and item.cure and item.file for item in mine)
    assert not re.search(r"\bnan\b|None", mine[0].message)
    if case.severity == "error":
        with pytest.raises(AuditError) as caught:
            loaded.run(compare=False)
        assert f"[{rule}]" in str(caught.value) or any(f"[{name}]" in str(caught.value) for name in case.also)
        assert f"--accept {rule}" in str(caught.value) or case.also
    else:
        result = loaded.run(compare=False)
        assert rule in {item.rule for item in result.findings}


@pytest.mark.parametrize("seed", [1, 2, 3, 4, 5512])
def test_the_clean_virtual_campaign_triggers_nothing(seed, tmp_path):
    result = Campaign.load(write_pmm_campaign(tmp_path / "clean", seed=seed)).run(compare=False)
    assert result.findings == ()
    assert set(result.runs_frame()["findings"]) == {""}


@pytest.mark.parametrize("base", ["points", "simman"])
def test_other_clean_campaigns_trigger_nothing(base, shipped):
    loaded = Campaign.load(shipped[base] / "campaign.toml")
    assert loaded.audit() == []
    assert loaded.run(compare=False).findings == ()


def test_a_rudder_to_the_right_side_triggers_nothing(copy):
    """The bare hull of the sabotage of the rudder sign, with the recorded angle as the matrix has it."""
    folder = copy("pmm")
    with_rudder(1.0)(folder)
    assert Campaign.load(folder / "campaign.toml").audit() == []


def test_every_finding_of_a_reader_is_a_rule():
    """Readers know no rules; their names must be in the list all the same."""
    import towtank.formats

    sources = Path(towtank.formats.__file__).parent.glob("*.py")
    names = {
        name for path in sources for name in re.findall(r'Finding\(\s*(?:rule=)?"([a-z-]+)"', path.read_text())
    }
    assert len(names) >= 10
    assert names <= set(RULES)


def test_an_accepted_error_is_kept_as_a_waiver(copy):
    folder = copy("pmm")
    SABOTAGE["density"].spoil(folder)
    result = Campaign.load(folder / "campaign.toml").run(compare=False, accept_rules=["density"])
    (waived,) = (item for item in result.findings if item.rule == "density")
    assert waived.accepted
    assert result.derivatives.provenance.choices["accepted rules"] == ["density"]
    row = result.runs_frame().set_index("run").loc["drift -12 deg"]
    assert (row["findings"], row["quality"]) == ("density", "accepted with errors")
