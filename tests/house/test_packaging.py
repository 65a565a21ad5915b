"""What is built is what is in the folders."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from functools import cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

import pytest

import towtank

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SETUPTOOLS = PROJECT["tool"]["setuptools"]

_NAME_OF_IMPORT = {
    "sklearn": "scikit-learn",
    "nptdms": "npTDMS",
    "python_calamine": "python-calamine",
}
_COME_ALONG = {"click", "markupsafe"}
"""Parts of typer and jinja2, in whose interfaces they show."""

_NEEDED_BY_OTHERS = {"openpyxl"}
"""Imported by pandas when it writes a workbook."""


def package_folders() -> list[Path]:
    """Folders of the root with an ``__init__.py``, the root included."""
    inner = (file.parent for file in ROOT.rglob("__init__.py"))
    return sorted(
        folder
        for folder in inner
        if not any(
            part.startswith(".") or part in ("tests", "build", "dist") for part in folder.relative_to(ROOT).parts
        )
    )


def test_packages_are_the_folders():
    dotted = {".".join(("towtank", *folder.relative_to(ROOT).parts)) for folder in package_folders()}
    assert set(SETUPTOOLS["packages"]) == dotted
    assert SETUPTOOLS["package-dir"] == {"towtank": "."}


def test_every_code_folder_is_a_package():
    outside = {"tests", "benchmarks", "docs"}
    bare = {
        path.parent.relative_to(ROOT)
        for path in ROOT.glob("*/**/*.py")
        if not path.relative_to(ROOT).parts[0].startswith(".") and path.relative_to(ROOT).parts[0] not in outside
    } - {folder.relative_to(ROOT) for folder in package_folders()}
    assert bare - {path for path in bare if path.parts[0] in ("build", "dist")} == set()


def test_data_files_are_packaged():
    """Each file that is no code, in a package's folder, is matched by the package data."""
    data = SETUPTOOLS["package-data"]
    assert "py.typed" in data["towtank"]
    assert (ROOT / "py.typed").is_file()
    forgotten = []
    for package in package_folders():
        if package == ROOT:
            continue
        dotted = ".".join(("towtank", *package.relative_to(ROOT).parts))
        packaged = {path for pattern in data.get(dotted, []) for path in package.glob(pattern)}
        forgotten += [
            path.relative_to(ROOT).as_posix()
            for path in package.rglob("*")
            if path.is_file() and path.suffix != ".py" and "__pycache__" not in path.parts and path not in packaged
        ]
    assert forgotten == []


@pytest.mark.parametrize("name", ["datasets/papers", "report/report.html.j2", "report/report.css"])
def test_shipped_data_are_there(name):
    assert (ROOT / name).exists()


def test_versions_agree():
    assert towtank.__version__ == PROJECT["project"]["version"] == version("towtank")
    assert f"## {towtank.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").replace(
        "[", ""
    ).replace("]", "")


def test_command_leads_to_a_function():
    module, _, function = PROJECT["project"]["scripts"]["towtank"].partition(":")
    assert callable(getattr(import_module(module), function))


def distributions(requirements: list[str]) -> set[str]:
    """Names of distributions in a list of requirements, in one spelling."""
    return {re.split(r"[\[<>=!~; ]", text)[0].lower() for text in requirements}


@cache
def imported() -> dict[str, str]:
    """Third-party modules that the package imports: distribution -> a file that does."""
    found: dict[str, str] = {}
    for folder in package_folders():
        for path in folder.glob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                names = []
                if isinstance(node, ast.Import):
                    names = [alias.name for alias in node.names]
                elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                    names = [node.module]
                for name in names:
                    top = name.partition(".")[0]
                    if top not in sys.stdlib_module_names and top != "towtank":
                        found[_NAME_OF_IMPORT.get(top, top).lower()] = path.relative_to(ROOT).as_posix()
    return found


def test_imports_are_declared():
    project = PROJECT["project"]
    extras = [*project["optional-dependencies"]["tdms"], *project["optional-dependencies"]["cluster"]]
    declared = distributions(project["dependencies"]) | distributions(extras)
    assert {name: file for name, file in imported().items() if name not in declared | _COME_ALONG} == {}


def test_dependencies_are_used():
    assert distributions(PROJECT["project"]["dependencies"]) - set(imported()) - _NEEDED_BY_OTHERS == set()


def test_licence_is_mit():
    assert PROJECT["project"]["license"] == "MIT"
    assert (ROOT / "LICENSE").read_text(encoding="utf-8").startswith("MIT License")
