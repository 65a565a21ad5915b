"""The documentation runs, its links lead somewhere, and it names what the code has."""

from __future__ import annotations

import os
import re
import shlex
import tomllib
from pathlib import Path

import pytest
import typer
from pydantic import BaseModel

import towtank.pmm.campaign_file as campaign_file
from towtank.cli.main import app, main
from towtank.core.conventions import CHOICES, PRESETS
from towtank.core.hull_models import HULL_MODELS
from towtank.core.ship import Ship
from towtank.formats.channels import ALIASES, DIMENSIONS
from towtank.formats.read import FORMATS
from towtank.pmm.campaign_file import load_campaign_file
from towtank.pmm.empirical_derivatives import EMPIRICAL_SETS
from towtank.pmm.run_matrix import expand_runs
from towtank.pmm.run_types import RUN_PARAMETERS, RUN_TYPES

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted(ROOT.glob("docs/*.md"))
ALL_PAGES = [*PAGES, *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"))]

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"\]\(([^)\s]+)\)")
_EXPECTED = re.compile(r"\s+# exit status (\d+)$")


def blocks(page: Path, *languages: str) -> list[tuple[str, str]]:
    """Code blocks of a page in these languages: (language, text)."""
    text = page.read_text(encoding="utf-8")
    return [(kind, body) for kind, body in _BLOCK.findall(text) if kind in languages]


def commands(body: str) -> list[str]:
    """Lines of a console or shell block that call towtank, without prompt."""
    lines = (line.removeprefix("$ ").strip() for line in body.splitlines())
    return [line for line in lines if line.startswith("towtank ")]


@pytest.mark.parametrize(
    "page", [page for page in PAGES if blocks(page, "python", "console")], ids=lambda p: p.stem
)
def test_page_runs(page, tmp_path, monkeypatch, capsys):
    """Blocks run from top to bottom in one folder and one namespace."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    for kind, body in blocks(page, "python", "console"):
        if kind == "python":
            exec(compile(body, page.name, "exec"), names)
            continue
        for line in commands(body):
            expected = _EXPECTED.search(line)
            with pytest.raises(SystemExit) as stop:
                main(shlex.split(line, comments=True)[1:])
            said = capsys.readouterr()
            assert stop.value.code == (int(expected[1]) if expected else 0), f"{line}\n{said.err}"
            assert said.err.count("\n") == (1 if expected else 0), f"{line}\n{said.err}"
    assert not (tmp_path / "demo" / "wrong").exists()


@pytest.mark.parametrize("page", ALL_PAGES, ids=lambda p: p.stem)
def test_links_lead_somewhere(page):
    targets = [link.partition("#")[0] for link in _LINK.findall(page.read_text(encoding="utf-8"))]
    broken = [t for t in targets if t and "://" not in t and not (page.parent / t).exists()]
    assert not broken


@pytest.mark.parametrize("page", ALL_PAGES, ids=lambda p: p.stem)
def test_commands_exist_with_their_options(page):
    known = typer.main.get_command(app).commands  # type: ignore[attr-defined]
    for _, body in blocks(page, "sh", "console"):
        for line in commands(body):
            words = shlex.split(line, comments=True)[1:]
            command = known[words[0]]
            if hasattr(command, "commands"):
                command = command.commands[words[1]]
            options = {
                name for parameter in command.params for name in (*parameter.opts, *parameter.secondary_opts)
            }
            assert not {word for word in words[1:] if re.match(r"--?[a-z]", word)} - options, line


def text_of(name: str) -> str:
    return (ROOT / "docs" / name).read_text(encoding="utf-8")


def sections() -> list[type[BaseModel]]:
    """Every part of a campaign file that has keys."""
    classes = [one for one in vars(campaign_file).values() if isinstance(one, type) and issubclass(one, BaseModel)]
    return [one for one in classes if one.model_fields]


@pytest.mark.parametrize("section", sections(), ids=lambda s: s.__name__)
def test_campaign_page_names_every_key(section):
    text = text_of("campaign-file.md")
    assert [key for key in section.model_fields if f"`{key}`" not in text] == []


@pytest.mark.parametrize(
    "words",
    [
        pytest.param(RUN_PARAMETERS, id="parameters of a run"),
        pytest.param(RUN_TYPES, id="run types"),
        pytest.param(Ship.__dataclass_fields__, id="particulars"),
        pytest.param([*DIMENSIONS, *ALIASES], id="channels"),
        pytest.param(FORMATS, id="formats"),
        pytest.param(HULL_MODELS, id="hull models"),
        pytest.param(EMPIRICAL_SETS, id="priors"),
    ],
)
def test_campaign_page_names_every(words):
    text = text_of("campaign-file.md")
    assert [word for word in words if f"`{word}`" not in text] == []


def test_choices_of_keys_are_named():
    text = text_of("campaign-file.md")
    for section in sections():
        for key, field in section.model_fields.items():
            choices = re.findall(r"'([^']+)'", "".join(re.findall(r"Literal\[(.*?)\]", str(field.annotation))))
            assert [choice for choice in choices if f"`{choice}`" not in text] == [], f"{section.__name__}.{key}"


def test_defaults_of_the_campaign_page():
    """The third cell of a key's row is its default, where that is one number, word or truth value."""
    told = {}
    for section in (campaign_file.Inertia, campaign_file.Reduction, campaign_file.Fit, campaign_file.Output):
        heading = f"## `[{section.__name__.lower()}]`"
        part = text_of("campaign-file.md").partition(f"{heading}\n")[2].partition("\n## ")[0]
        cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in part.splitlines() if line[:1] == "|"]
        for keys, default in ((row[0], row[2].split(" ")[0]) for row in cells if len(row) == 4):
            told |= {(section, key): default for key in re.findall(r"`(\w+)`", keys)}
    assert len(told) > 30
    for (section, key), default in told.items():
        value = section.model_fields[key].default
        if isinstance(value, bool):
            assert default == str(value).lower(), key
        elif isinstance(value, int | float):
            assert float(default) == value, key
        elif isinstance(value, str):
            assert default == f"`{value}`", key


def test_example_of_the_campaign_page_is_valid(tmp_path):
    page = ROOT / "docs" / "campaign-file.md"
    ((_, toml),) = blocks(page, "toml")
    ((_, matrix),) = blocks(page, "csv")
    (tmp_path / "campaign.toml").write_text(toml, encoding="utf-8")
    (tmp_path / "pmm.csv").write_text(matrix, encoding="utf-8")
    (tmp_path / "runs").mkdir()
    for name in ("drift_-4.txt", "drift_10.txt", "zero.txt", "sway_1.txt", "yaw_1.txt", "yawdrift_1.txt"):
        (tmp_path / "runs" / name).touch()
    campaign = load_campaign_file(tmp_path / "campaign.toml")
    assert set(tomllib.loads(toml)) >= {"campaign", "ship", "channels", "runs", "fit", "output"}
    runs = expand_runs(campaign.runs, tmp_path, campaign.make_conventions(), tmp_path / "campaign.toml")
    assert [run.kind for run in runs] == ["static_drift"] * 2 + ["pure_sway", "pure_yaw", "yaw_drift"]
    assert sorted(round(run.drift_angle, 4) for run in runs[:2]) == [-0.0698, 0.1745]


def test_conventions_page_names_every_choice():
    text = text_of("conventions.md")
    missing = [word for key, choices in CHOICES.items() for word in (key, *choices) if f"`{word}`" not in text]
    assert missing == []
    assert [name for name in PRESETS if f"`{name}`" not in text] == []


def test_no_page_stands_alone():
    linked = {link for page in ALL_PAGES for link in _LINK.findall(page.read_text(encoding="utf-8"))}
    names = {os.path.basename(link.partition("#")[0]) for link in linked}
    assert [page.name for page in ALL_PAGES if page.name not in names | {"README.md"}] == []
