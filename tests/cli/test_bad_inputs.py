"""Each bad input ends with status 2 and one line that says file, place, cause and cure; nothing is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

DRIFT = "runs/03_drift_-4_deg.txt"
HEAD = 4
"""Lines of a run file above its data: two comments, names, units."""


def edit(path: Path, *changes: tuple[str, str]) -> None:
    text = path.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text, f"{old} is not in {path}"
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")


def toml(*changes: tuple[str, str]) -> Callable[[Path], None]:
    """Change texts of the campaign file."""
    return lambda path: edit(path, *changes)


def file(change: Callable[[list[str]], list[str]]) -> Callable[[Path], None]:
    """Change the lines of one run file."""

    def spoil(path: Path) -> None:
        target = path.parent / DRIFT
        target.write_text("".join(change(target.read_text().splitlines(keepends=True))))

    return spoil


def cells(name: str, value: str, rows: slice) -> Callable[[Path], None]:
    """Put a text into some cells of a column of one run file."""

    def change(lines: list[str]) -> list[str]:
        place = lines[2].rstrip("\n").split("\t").index(name)
        data = [line.rstrip("\n").split("\t") for line in lines[HEAD:]]
        for row in data[rows]:
            row[place] = value
        return [*lines[:HEAD], *("\t".join(row) + "\n" for row in data)]

    return file(change)


def matrix(*changes: tuple[str, str]) -> Callable[[Path], None]:
    return lambda path: edit(path.parent / "matrix.csv", *changes)


def replaced(content: bytes) -> Callable[[Path], None]:
    return lambda path: (path.parent / DRIFT).write_bytes(content)


def points(text: str, extra: str = "") -> Callable[[Path], None]:
    """A campaign of reduced points in place of the runs."""

    def spoil(path: Path) -> None:
        content = path.read_text()
        ship = content[content.index("[ship]") : content.index("[conventions]")]
        (path.parent / "points.csv").write_text(text)
        head = '[campaign]\nname = "points"\n\n'
        path.write_text(f'{head}{ship}[points]\nfile = "points.csv"\n{extra}\n[fit]\nterms = ["R0", "Yv", "Nv"]\n')

    return spoil


@dataclass(frozen=True)
class Bad:
    """What is spoilt, and the parts of the line that says so."""

    spoil: Callable[[Path], object]
    parts: tuple[str, ...]


RUN = f"{DRIFT}"
BAD = {
    # -- the campaign file
    "missing campaign": Bad(lambda path: path.unlink(), ("campaign.toml", "file not found", "give the path")),
    "binary campaign": Bad(
        lambda path: path.write_bytes(b"\x89PNG\xff\xfe\x00"), ("not a text file", "TOML in utf-8")
    ),
    "bad syntax": Bad(toml(("[ship]", "[ship")), ("not valid TOML", "line", "mend the syntax")),
    "unknown key": Bad(
        toml(("skip_cycles", "skip_cycle")), ("key 'reduction.skip_cycle'", "closest: skip_cycles")
    ),
    "wrong type": Bad(
        toml(("skip_cycles = 1", 'skip_cycles = "one"')), ("reduction.skip_cycles", "integer", "'one'")
    ),
    "missing ship key": Bad(toml(("T = 0.136\n", "")), ("[ship]", "'T' is missing", "complete or correct")),
    "negative draught": Bad(
        toml(("T = 0.136", "T = -0.136")), ("[ship]", "T = -0.136 is not positive", "SI units")
    ),
    "unknown waiver": Bad(toml(("[campaign]", 'accept = ["gpa"]\n[campaign]')), ("key 'accept'", "'gpa'", "gap")),
    # -- run files
    "missing run file": Bad(
        lambda path: (path.parent / DRIFT).unlink(),
        ("matrix.csv, row 4", f"run file '{RUN}' not found", "mend the name"),
    ),
    "empty run file": Bad(replaced(b""), (RUN, "the file is empty", "export the run again")),
    "binary run file": Bad(replaced(bytes(range(256)) * 20), (RUN, "binary")),
    "header only": Bad(file(lambda lines: lines[:HEAD]), (RUN, "there are no data rows", "export the run again")),
    "two samples": Bad(
        file(lambda lines: lines[: HEAD + 2]), (RUN, "[too-short]", "2 sample", "--accept too-short")
    ),
    "text in a cell": Bad(cells("Y", "fail", slice(200, 201)), (RUN, "line 205", "Y", "fail")),
    "NaN in a force": Bad(
        cells("Y", "nan", slice(200, 204)), (RUN, "channel Y", "[missing-values]", "missing in 4 of")
    ),
    "gap in time": Bad(
        file(lambda lines: lines[:300] + lines[380:]), (RUN, "time", "[gap]", "80 sample", "--accept gap")
    ),
    "constant force": Bad(
        cells("Y", "1.5", slice(None)), (RUN, "channel Y", "[constant-channel]", "1.5 in all samples", "cable")
    ),
    # -- channels
    "unknown column": Bad(
        toml(('column = "Y"', 'column = "Fq"')), ("channel Y", "no column 'Fq'", "the file has time")
    ),
    "nearly a column": Bad(
        toml(('speed = { column = "speed"', 'speed = { column = "sped"')),
        ("channel speed", "'sped'", "closest: speed"),
    ),
    "wrong unit": Bad(
        toml(('column = "Y", unit = "N"', 'column = "Y", unit = "kg"')),
        ("channel Y", "unit 'kg' is of dimension mass where force is expected", "'kgf'"),
    ),
    "unknown unit": Bad(toml(('column = "Y", unit = "N"', 'column = "Y", unit = "Nn"')), ("channel Y", "'Nn'")),
    "missing unit": Bad(
        lambda path: (toml(('column = "Y", unit = "N"', 'column = "Y"'))(path), file(without_units)(path)),
        ("channel Y", "column 'Y' has no unit in the file", "give unit = 'N'"),
    ),
    # -- runs
    "unknown type": Bad(
        matrix(("pure_sway", "pure_swai")), ("'pure_swai' is not a run type", "use one of", "pure_sway")
    ),
    "missing frequency": Bad(matrix((",frequency,", ",series,")), ("a pure_sway run needs 'frequency'", "add it")),
    "missing zero run": Bad(
        toml(("runs/zero.txt", "runs/nil.txt")), ("zero run 'runs/nil.txt' not found", "tare")
    ),
    "no file in the matrix": Bad(
        matrix((RUN, "")), ("run 'drift -4 deg'", "the run has no file", "column 'file'")
    ),
    # -- the fit
    "unknown term": Bad(toml(('"Yvvv"', '"Yvvq"')), ("key 'fit'", "'q' is not a variable", "variables are")),
    "term not excited": Bad(
        toml(('"Yvvv"', '"Yvvv", "Yd"')), ("component Y", "no run excites Yd", "leave the term out")
    ),
    "inseparable terms": Bad(
        lambda path: (points("v,Y\n" + 3 * "-0.1,0.03\n0.1,-0.03\n")(path), edit(path, ('"Nv"', '"Yv|v|"'))),
        ("component Y", "cannot separate these terms at all: Yv, Yv|v|", "drop one of them"),
    ),
    "too few data": Bad(
        points("v,X,Y,N\n0.1,-0.02,-0.03,-0.02\n"), ("component X", "leave no residual", "add runs")
    ),
    "misspelt bound": Bad(
        toml(("[fit]", '[fit]\nestimator = "constrained"\nbounds = { Yvv = [-1.0, 0.0] }')),
        ("key 'fit.bounds'", "'Yvv' is not a fitted term", "closest: Yv"),
    ),
    "bias of no force": Bad(
        toml(("[fit]", "[fit]\nshared_bias = { gain = { K = 0.01 } }")),
        ("shared bias of 'K', which is not fitted", "fitted are X, Y, N"),
    ),
    # -- points
    "missing points": Bad(
        lambda path: (points("v,Y\n")(path), (path.parent / "points.csv").unlink()),
        ("points.csv", "file not found", "check the path"),
    ),
    "unknown dataset": Bad(
        lambda path: (points("v,Y\n")(path), edit(path, ('file = "points.csv"', 'table = "dtc-drift-points-6"'))),
        ("[points] table", "no published table 'dtc-drift-points-6'", "dtc-drift-points-63"),
    ),
    "wrong scaling of points": Bad(
        points(
            "v,X,Y,N\n" + "".join(f"{v},-0.0008,{-0.013 * v},{-0.007 * v}\n" for v in (-0.2, -0.1, 0.0, 0.1, 0.2))
        ),
        (
            "[l2-against-lt]",
            "divided by L^2 and read as divided by L T",
            "points to 'L2'",
            "--accept l2-against-lt",
        ),
    ),
    "a force that is a text": Bad(points("v,Y\n0.1,high\n0.2,low\n"), ("points.csv", "no force column X, Y or N")),
}


def without_units(lines: list[str]) -> list[str]:
    return [*lines[:3], *lines[HEAD:]]


def everything(folder: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@pytest.mark.parametrize("bad", BAD)
def test_one_line_with_file_place_cause_and_cure(bad, towtank, campaign, tmp_path):
    BAD[bad].spoil(campaign)
    before = everything(tmp_path)
    ended = towtank("run", campaign, "--out", tmp_path / "results")
    assert ended.status == 2, ended.err
    assert ended.out == ""
    assert ended.err.startswith("towtank: ")
    assert ended.err.count("\n") == 1
    assert ended.err.endswith("\n")
    assert str(campaign.parent) in ended.err
    assert " -> " in ended.err
    for part in BAD[bad].parts:
        assert part in ended.err, ended.err
    assert "Traceback" not in ended.err
    assert everything(tmp_path) == before


@pytest.mark.parametrize("bad", ["unknown column", "NaN in a force", "wrong scaling of points"])
def test_the_audit_command_refuses_them_too(bad, towtank, campaign):
    BAD[bad].spoil(campaign)
    ended = towtank("audit", campaign)
    assert ended.status == 2
    assert "Traceback" not in ended.err


def test_a_folder_is_no_campaign(towtank, campaign, tmp_path):
    ended = towtank("run", campaign.parent, "--out", tmp_path / "results")
    assert (ended.status, ended.err.count("\n")) == (2, 1)
    assert "this is a folder -> give the campaign.toml inside it" in ended.err
    assert not (tmp_path / "results").exists()


def test_an_unknown_rule_on_the_command_line(towtank, campaign, tmp_path):
    for command in (("run", campaign, "--out", tmp_path / "results"), ("audit", campaign)):
        ended = towtank(*command, "--accept", "densty")
        assert (ended.status, ended.out) == (2, "")
        assert ended.err == "towtank: 'densty' is not an audit rule -> closest: density, transient-only\n"
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda folder: folder / "taken", id="a file"),
        pytest.param(lambda folder: folder / "taken" / "deep", id="below a file"),
        pytest.param(lambda folder: Path("/proc/towtank/results"), id="not writable"),
    ],
)
def test_a_place_for_results_that_is_none(make, towtank, campaign, tmp_path):
    (tmp_path / "taken").write_text("mine")
    before = everything(tmp_path)
    out = make(tmp_path)
    ended = towtank("run", campaign, "--out", out, "--no-report")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert str(out) in ended.err
    assert " -> " in ended.err
    assert everything(tmp_path) == before


def test_an_error_leaves_the_old_results(towtank, campaign, tmp_path):
    out = tmp_path / "results"
    assert towtank("run", campaign, "--out", out, "--no-report").status == 0
    before = everything(tmp_path)
    cells("Y", "nan", slice(200, 204))(campaign)
    spoilt = everything(tmp_path)
    assert towtank("run", campaign, "--out", out, "--no-report").status == 2
    assert everything(tmp_path) == spoilt
    assert {name: data for name, data in spoilt.items() if "results" in name} == {
        name: data for name, data in before.items() if "results" in name
    }
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]
