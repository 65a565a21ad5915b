"""Names, sizes and words of the repository's files; every test asserts something."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

_TEXT = {".py", ".md", ".toml", ".j2", ".css", ".txt", ".yml", ".yaml", ".cfg", ""}
_NOT_OURS = {"build", "dist", "demo"}

NAMELESS = {"utils", "util", "helpers", "helper", "misc", "common", "base", "tools", "stuff"}
"""File names that say nothing about what the file does."""

LONGEST = 700

# Written in halves so that this file does not hold them itself.
FOREIGN = [
    "/wo" + "rk/",
    "/op" + "t/tt",
    "sub" + "-agent",
    "sub" + "agent",
    "issue" + " #",
    "chat" + "gpt",
    "clau" + "de",
]
UNFINISHED = [
    r"\bTO" + r"DO\b",
    r"\bFIX" + r"ME\b",
    r"\bXX" + r"X\b",
    r"\bfor n" + r"ow\b",
    r"NotImpl" + "emented",
]


def files() -> list[Path]:
    """Text files of the repository, without what tools leave behind."""
    found = []
    for path in ROOT.rglob("*"):
        parts = path.relative_to(ROOT).parts
        if any(part in _NOT_OURS or part.startswith("towtank-") or part.endswith(".egg-info") for part in parts):
            continue
        if any(part.startswith(".") for part in parts) and parts[0] not in (".ci", ".gitignore"):
            continue
        if path.suffix in _TEXT and path.is_file() and "__pycache__" not in parts:
            found.append(path)
    return sorted(found)


FILES = files()
CODE = [path for path in FILES if path.suffix == ".py"]
TESTS = [path for path in CODE if path.name.startswith("test_") and "tests" in path.relative_to(ROOT).parts]


def lines_with(pattern: re.Pattern[str], paths: list[Path]) -> list[str]:
    """``file:line`` of each line that matches."""
    return [
        f"{path.relative_to(ROOT)}:{number}"
        for path in paths
        for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), start=1)
        if pattern.search(line)
    ]


def test_the_repository_is_seen():
    assert {ROOT / "core" / "terms.py", ROOT / ".ci" / "run", ROOT / "README.md", Path(__file__)} <= set(FILES)
    assert len(TESTS) > 80


def test_files_speak_of_ships():
    assert lines_with(re.compile("|".join(map(re.escape, FOREIGN)), re.IGNORECASE), FILES) == []


def test_nothing_is_left_unfinished():
    assert lines_with(re.compile("|".join(UNFINISHED)), FILES) == []


def test_names_say_what_a_file_does():
    assert [path for path in CODE if path.stem.removeprefix("test_") in NAMELESS] == []


@pytest.mark.parametrize("path", CODE, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_code_fits_on_a_few_screens(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST


def _asserts(node: ast.AST, local: dict[str, ast.AST], seen: frozenset[str] = frozenset()) -> bool:
    """Whether a function asserts: itself, by a checking function, or through a function of its file."""
    for part in ast.walk(node):
        if isinstance(part, ast.Assert):
            return True
        if isinstance(part, ast.Call):
            function = part.func
            name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
            if re.match(r"(assert|check|raises|warns|fail)", name):
                return True
            if name in local and name not in seen and _asserts(local[name], local, seen | {name}):
                return True
    return False


@pytest.mark.parametrize("path", TESTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_every_test_asserts(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = {
        node.name: node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    tests = {name: node for name, node in functions.items() if name.startswith("test_")}
    assert tests or "check_estimator" in path.read_text(encoding="utf-8")
    assert [name for name, node in tests.items() if not _asserts(node, functions)] == []


def test_no_test_measures_time():
    clocks = re.compile(r"\b(perf_counter|process_time|timeit|time\.(time|monotonic)\()")
    assert lines_with(clocks, [path for path in TESTS if path != Path(__file__)]) == []
