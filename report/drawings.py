"""Figures of a page as inline SVG with their captions."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Drawing:
    """One figure of the page: its SVG, and the line below it (empty for none)."""

    svg: str
    caption: str = ""


@dataclass(frozen=True)
class Row:
    """Drawings that belong together, e.g. the components of one run, with key (colour, name) and line below."""

    title: str
    drawings: tuple[Drawing, ...]
    caption: str = ""
    key: tuple[tuple[str, str], ...] = ()
