"""Tables of the report about where its numbers come from: findings, choices, files, versions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import BaseModel

from ..core.findings import Finding
from ..pmm.campaign_file import CampaignFile
from .page_table import Column, Table, make_table

_SEVERITIES = ("error", "warning", "info")
_SECTIONS = (
    "reader",
    "channels",
    "conventions",
    "inertia",
    "reduction",
    "points",
    "fit",
    "simulate",
    "output",
    "accept",
)


def findings_table(findings: Iterable[Finding]) -> Table:
    """Findings of the audit, worst first, those of one rule and one wording together."""
    groups: dict[tuple[str, str, bool, str], list[Finding]] = {}
    for finding in findings:
        groups.setdefault((finding.severity, finding.rule, finding.accepted, finding.cure), []).append(finding)
    order = sorted(groups, key=lambda key: (_SEVERITIES.index(key[0]), key[1]))
    rows, marks = [], []
    for severity, rule, accepted, cure in order:
        found = groups[severity, rule, accepted, cure]
        places = [", ".join(part for part in (item.file, item.place) if part) for item in found]
        places = list(dict.fromkeys(place for place in places if place))
        shown = "; ".join(places[:3]) + (f" and {len(places) - 3} more" if len(places) > 3 else "")
        state = f"{severity}, accepted" if accepted else severity
        rows.append((state, rule, found[0].message, shown or "–", cure or "–"))
        marks.append("" if severity == "info" else "weak" if severity == "warning" or accepted else "bad")
    columns = [
        Column("severity"),
        Column("rule", "code"),
        Column("what was seen"),
        Column("where"),
        Column("what to do"),
    ]
    return make_table(columns, rows, marks=marks)


def choices_tables(settings: CampaignFile) -> tuple[Table, Table]:
    """Every setting of the campaign file: those that it sets, and those that are defaults."""
    rows: list[tuple[str, str, bool]] = []
    for section in _SECTIONS:
        value = getattr(settings, section)
        if section == "conventions":
            everything = settings.make_conventions().to_dict()
            rows += [(f"conventions.{key}", setting_text(x), key in value) for key, x in everything.items()]
        elif value is not None:
            rows += setting_rows(section, value, section in settings.model_fields_set)
    columns = [Column("setting", "code"), Column("value")]
    chosen = make_table(columns, [(key, text) for key, text, was_set in rows if was_set])
    default = make_table(columns, [(key, text) for key, text, was_set in rows if not was_set])
    return chosen, default


def setting_rows(key: str, value: Any, given: bool) -> list[tuple[str, str, bool]]:
    """Rows (key, value, set in the file) of a setting and everything below it."""
    rows: list[tuple[str, str, bool]] = []
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            rows += setting_rows(f"{key}.{name}", getattr(value, name), given and name in value.model_fields_set)
        return rows + [
            (f"{key}.{name}", setting_text(item), given) for name, item in (value.model_extra or {}).items()
        ]
    if isinstance(value, Mapping) and value:
        for name, below in value.items():
            rows += setting_rows(f"{key}.{name}", below, given)
        return rows
    return [(key, setting_text(value), given)]


def setting_text(value: Any) -> str:
    """A setting in words: yes and no, numbers short, a dash for nothing."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None or value in ("", [], {}, ()):
        return "–"
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, BaseModel):
        return setting_text(value.model_dump(exclude_defaults=True))
    if isinstance(value, Mapping):
        return ", ".join(f"{name} = {setting_text(item)}" for name, item in value.items())
    if isinstance(value, list | tuple):
        return ", ".join(setting_text(item) for item in value)
    return str(value)


def inputs_table(inputs: Mapping[str, str]) -> Table:
    """Input files with the sha256 of their bytes."""
    rows = [(name, digest or "not a file") for name, digest in inputs.items()]
    return make_table([Column("file"), Column("sha256", "code")], rows)


def versions_text(versions: Mapping[str, str]) -> str:
    """Program versions in one line."""
    return ", ".join(f"{name} {version}" for name, version in versions.items())
