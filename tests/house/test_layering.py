"""Imports run downward; this check reads the files itself and needs no other tool."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

FLOORS = [
    ("core",),
    ("datasets",),
    ("identify", "verify", "formats"),
    ("pmm", "decay", "squat"),
    ("simulate", "cfd"),
    ("report", "reproduce"),
    ("cli",),
]
"""Rooms from the ground up; rooms of one floor do not import each other."""

LEVEL = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}


def rooms_imported(path: Path) -> set[str]:
    """Rooms of the package that a file imports from, at any depth of its code."""
    package = ("towtank", *path.relative_to(ROOT).parts[:-1])
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = (
                [*package[: len(package) + 1 - node.level], node.module or ""]
                if node.level
                else [node.module or ""]
            )
            modules = [".".join((*base, alias.name)).replace("..", ".") for alias in node.names]
        else:
            continue
        found |= {module.split(".")[1] for module in modules if module.startswith("towtank.")}
    return found & set(LEVEL)


@pytest.mark.parametrize("room", LEVEL)
def test_room_imports_only_from_below(room):
    wrong = [
        f"{path.relative_to(ROOT)} imports {other}"
        for path in sorted((ROOT / room).rglob("*.py"))
        for other in rooms_imported(path)
        if other != room and LEVEL[other] >= LEVEL[room]
    ]
    assert wrong == []


def test_every_room_has_a_floor():
    rooms = {path.parent.name for path in ROOT.glob("*/__init__.py") if not path.parent.name.startswith(".")}
    assert rooms - {"build", "dist", "tests"} == set(LEVEL)


def test_the_check_sees_imports():
    assert rooms_imported(ROOT / "pmm" / "campaign.py") >= {"core", "formats"}
    assert rooms_imported(ROOT / "__main__.py") == {"cli"}


def test_the_package_itself_imports_nothing():
    assert rooms_imported(ROOT / "__init__.py") == set()
