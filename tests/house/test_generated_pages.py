"""Tables of the documentation that are written from the code; run as a script, this file renews them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from towtank.datasets import list_sets, list_tables
from towtank.datasets.catalogue import Kind, find
from towtank.pmm.audit_rules import RULES
from towtank.reproduce import papers
from towtank.simulate.index_definitions import DEFINITIONS, definition_of
from towtank.simulate.ships import named_ships

DOCS = Path(__file__).resolve().parents[2] / "docs"

_STAGES = {
    "reading": "By the reader",
    "header": "In the header",
    "record": "In the record of a run",
    "campaign": "Across runs",
}


def _cell(value: object) -> str:
    return str(value).replace("|", "\\|")


def _table(head: tuple[str, ...], rows: list[tuple[object, ...]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(_cell(cell) for cell in line) + " |" for line in lines)


def rules_text() -> str:
    """The rules of the audit, one table a stage."""
    parts = []
    for stage, title in _STAGES.items():
        rows = [(f"`{r.name}`", r.severity, r.meaning, r.cure) for r in RULES.values() if r.stage == stage]
        parts.append(f"## {title}\n\n" + _table(("rule", "severity", "meaning", "cure"), rows))
    return "\n\n".join(parts)


def papers_text() -> str:
    """The papers of the gallery."""
    return _table(("key", "paper"), [(f"`{key}`", paper.citation) for key, paper in papers().items()])


def sets_text() -> str:
    """The published derivative sets, one table a paper."""
    groups: dict[str, list[tuple[object, ...]]] = {}
    for row in list_sets().itertuples(index=False):
        paper, place = _paper_and_place("set", row.key, row.source)
        groups.setdefault(paper, []).append((f"`{row.key}`", row.name, row.conventions, row.terms, place))
    return _by_paper(groups, ("key", "set", "conventions", "terms", "place"))


def tables_text() -> str:
    """The published tables, one table a paper."""
    groups: dict[str, list[tuple[object, ...]]] = {}
    for row in list_tables().itertuples(index=False):
        paper, place = _paper_and_place("table", row.key, row.source)
        place = f"{place} (computed)" if row.computed else place
        groups.setdefault(paper, []).append((f"`{row.key}`", row.title, row.rows, row.columns, place))
    return _by_paper(groups, ("key", "table", "rows", "columns", "place"))


def _paper_and_place(kind: Kind, key: str, source: str) -> tuple[str, str]:
    paper = find(kind, key).reference
    assert source.startswith(paper)
    return paper, source.removeprefix(paper).lstrip(", ")


def _by_paper(groups: dict[str, list[tuple[object, ...]]], head: tuple[str, ...]) -> str:
    return "\n\n".join(f"**{paper}**\n\n{_table(head, groups[paper])}" for paper in sorted(groups))


def indices_text() -> str:
    """The manoeuvring indices."""
    numbered = ("overshoot 1", "time to check yaw 1", "time of execute 2", "time of overshoot 1", "time to 90")
    numbered += ("speed ratio at 90", "drift distance 360-720", "drift direction 360-720")
    return _table(
        ("index", "unit", "definition"), [(name, *definition_of(name)) for name in (*DEFINITIONS, *numbered)]
    )


def ships_text() -> str:
    """The named ships."""
    return _table(("name", "ship"), [(f"`{name}`", line) for name, line in named_ships().items()])


PAGES = {
    ("audit-rules.md", "rules"): rules_text,
    ("gallery.md", "papers"): papers_text,
    ("published-sets.md", "sets"): sets_text,
    ("published-sets.md", "tables"): tables_text,
    ("simulator.md", "indices"): indices_text,
    ("simulator.md", "ships"): ships_text,
}
"""Page and marker -> text that stands between ``<!-- begin marker -->`` and ``<!-- end marker -->``."""


def _between(marker: str) -> re.Pattern[str]:
    return re.compile(rf"(<!-- begin {marker} -->\n)(.*?)(\n?<!-- end {marker} -->)", re.DOTALL)


@pytest.mark.parametrize(("page", "marker"), PAGES)
def test_page_says_what_the_code_has(page, marker):
    match = _between(marker).search((DOCS / page).read_text(encoding="utf-8"))
    assert match is not None, f"docs/{page} has lost the markers of '{marker}'"
    wanted = PAGES[page, marker]()
    assert match[2].strip().splitlines() == wanted.splitlines(), (
        f"renew docs/{page}: python tests/house/{Path(__file__).name}"
    )


def test_every_rule_belongs_to_a_stage():
    assert {rule.stage for rule in RULES.values()} <= set(_STAGES)


if __name__ == "__main__":
    for (page, marker), text in PAGES.items():
        path = DOCS / page
        fresh = f"<!-- begin {marker} -->\n\n{text()}\n\n<!-- end {marker} -->"
        path.write_text(_between(marker).sub(lambda _, fresh=fresh: fresh, path.read_text("utf-8")), "utf-8")
