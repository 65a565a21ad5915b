"""What an audit says about a file: a named rule, a severity, a place and a cure."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from .errors import AuditError

if TYPE_CHECKING:
    import pandas as pd

Severity = Literal["error", "warning", "info"]


@dataclass(frozen=True)
class Finding:
    """One observation of an audit rule.

    Attributes
    ----------
    rule : str
        Name of the rule, e.g. ``"angle-in-degrees"``; ``--accept RULE`` waives it.
    severity : {"error", "warning", "info"}
        An error stops the import unless the rule is accepted; a warning is kept in the report.
    message : str
        What was seen and what was expected.
    file, place : str
        Where: file name; row, channel or run.
    cure : str
        What to do about it.
    accepted : bool
        True when the user waived the rule.
    """

    rule: str
    severity: Severity
    message: str
    file: str = ""
    place: str = ""
    cure: str = ""
    accepted: bool = False


def accept(findings: Iterable[Finding], rules: Iterable[str]) -> list[Finding]:
    """Mark the findings of the named `rules` as accepted by the user."""
    waived = set(rules)
    return [replace(f, accepted=True) if f.rule in waived else f for f in findings]


def stop_on_error(findings: Iterable[Finding]) -> None:
    """Raise :class:`AuditError` for the first error that nobody accepted."""
    open_errors = [f for f in findings if f.severity == "error" and not f.accepted]
    if not open_errors:
        return
    first = open_errors[0]
    more = f" (and {len(open_errors) - 1} more errors)" if len(open_errors) > 1 else ""
    raise AuditError(
        f"[{first.rule}] {first.message}{more}",
        cure=f"{first.cure}; or accept it knowingly with --accept {first.rule}",
        file=first.file or None,
        place=first.place,
    )


def findings_frame(findings: Iterable[Finding]) -> pd.DataFrame:
    """Table of findings, one a row, worst first."""
    import pandas as pd

    order = {"error": 0, "warning": 1, "info": 2}
    columns = ["severity", "rule", "file", "place", "message", "cure", "accepted"]
    rows = [
        (f.severity, f.rule, f.file, f.place, f.message, f.cure, f.accepted)
        for f in sorted(findings, key=lambda f: (order[f.severity], f.rule, f.file))
    ]
    return pd.DataFrame(rows, columns=columns)
