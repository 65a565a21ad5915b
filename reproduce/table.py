"""The gallery as an aligned text table."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from textwrap import wrap

from .case import Case

_NOTE_WIDTH = 96
_NUMBERS = (2, 3, 4)


def _number(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.6g}"


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    cells = (c.rjust(w) if i in _NUMBERS else c.ljust(w) for i, (c, w) in enumerate(zip(row, widths)))
    return "  ".join(cells).rstrip()


def gallery_text(cases: Sequence[Case]) -> str:
    """Table of cases by paper, notes below the rows they belong to, and a count of verdicts."""
    lines: list[str] = []
    for paper in dict.fromkeys(case.paper for case in cases):
        own = [case for case in cases if case.paper == paper]
        rows = [
            (
                case.case,
                case.quantity,
                _number(case.printed),
                _number(case.computed),
                f"{case.tolerance:.2g}",
                case.verdict,
            )
            for case in own
        ]
        head = ("case", "quantity", "printed", "computed", "tolerance", "verdict")
        widths = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
        rule = "-" * (sum(widths) + 2 * (len(widths) - 1))
        lines += ["", paper, rule, _line(head, widths), rule]
        last_note = ""
        for case, row in zip(own, rows, strict=True):
            lines.append(_line(row, widths))
            if case.note and case.note != last_note:
                lines += [f"    {part}" for part in wrap(case.note, _NOTE_WIDTH)]
            last_note = case.note
    verdicts = Counter(case.verdict for case in cases)
    lines += ["", ", ".join(f"{verdict}: {count}" for verdict, count in verdicts.most_common())]
    return "\n".join(lines).lstrip("\n")
