"""What a campaign leaves behind: tables, figures, the report, exports and comparisons."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .comparison import compare_sets, comparison_text
    from .exports import export_set
    from .html_report import render_report, write_report
    from .manoeuvre_outputs import write_manoeuvres
    from .manoeuvre_page import render_manoeuvres
    from .outputs import write_results
    from .set_table import read_set
    from .validation_outputs import write_validation

_HOME = {
    "compare_sets": ".comparison",
    "comparison_text": ".comparison",
    "export_set": ".exports",
    "read_set": ".set_table",
    "render_manoeuvres": ".manoeuvre_page",
    "render_report": ".html_report",
    "write_manoeuvres": ".manoeuvre_outputs",
    "write_report": ".html_report",
    "write_results": ".outputs",
    "write_validation": ".validation_outputs",
}

__all__ = [
    "compare_sets",
    "comparison_text",
    "export_set",
    "read_set",
    "render_manoeuvres",
    "render_report",
    "write_manoeuvres",
    "write_report",
    "write_results",
    "write_validation",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name], __name__), name)
