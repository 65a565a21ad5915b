"""The registry of audit rules is complete and consistent."""

import re
from pathlib import Path

import pytest

import towtank
from towtank.core.errors import CampaignError
from towtank.pmm.audit_rules import RULES, finding, require_rules, rules_frame

ROOT = Path(towtank.__file__).parent
GIVEN = re.compile(r'\b[Ff]inding\(\s*"([a-z0-9-]+)"')


def names_given(folder: str, pattern: str) -> set[str]:
    return {name for file in (ROOT / folder).glob(pattern) for name in GIVEN.findall(file.read_text("utf-8"))}


def test_every_fault_that_a_reader_notices_is_a_rule():
    given = names_given("formats", "*.py")
    assert {"ragged-last-line", "blank-rows", "duplicate-columns", "units-fewer-than-columns"} <= given
    assert given <= set(RULES)
    assert given == {rule.name for rule in RULES.values() if rule.stage == "reading"}


def test_every_rule_is_given_somewhere():
    text = "".join(
        file.read_text("utf-8") for file in (ROOT / "pmm").glob("audit_*.py") if "rules" not in file.name
    )
    for rule in RULES.values():
        assert rule.stage == "reading" or f'"{rule.name}"' in text, rule.name


def test_rules_are_named_and_explained():
    for name, rule in RULES.items():
        assert name == rule.name
        assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name)
        assert rule.severity in ("error", "warning", "info")
        assert rule.stage in ("reading", "header", "record", "campaign")
        assert rule.meaning
        assert rule.cure
        assert not rule.meaning.endswith(".")


def test_findings_take_severity_and_cure_of_their_rule():
    plain = finding("gap", "seen")
    assert (plain.severity, plain.cure) == ("error", RULES["gap"].cure)
    other = finding("gap", "seen", severity="warning", place="time", file="a.txt", cure="wait")
    assert (other.severity, other.place, other.file, other.cure) == ("warning", "time", "a.txt", "wait")
    with pytest.raises(KeyError):
        finding("no-such-rule", "seen")


def test_misspelt_waivers_are_refused():
    require_rules(["gap", "drift-sign"])
    with pytest.raises(CampaignError, match=r"'driftsign' is not an audit rule.*drift-sign"):
        require_rules(["gap", "driftsign"])


def test_the_table_of_rules():
    frame = rules_frame()
    assert list(frame.columns) == ["name", "severity", "stage", "meaning", "cure"]
    assert set(frame["name"]) == set(RULES)
