"""Progress bars: silent without a terminal, one bar for each kind of work on one."""

from __future__ import annotations

import io
from collections.abc import Callable

import pytest

from towtank.cli import progress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def terminal(monkeypatch) -> Callable[[], Terminal]:
    """Put a terminal in the place of standard error; called in the test, after pytest has taken it."""

    def attach() -> Terminal:
        screen = Terminal()
        monkeypatch.setattr(progress.sys, "stderr", screen)
        monkeypatch.setenv("TERM", "xterm")
        return screen

    return attach


def work(show: bool = True) -> None:
    with progress.progress_bar(show) as told:
        for done in range(4):
            told("reading runs", done, 3)
        told("fitting", 1, 1)


def test_nothing_is_drawn_where_nobody_looks(capsys):
    work()
    assert capsys.readouterr() == ("", "")


def test_nothing_is_drawn_for_short_work_or_when_unwanted(terminal, monkeypatch):
    screen = terminal()
    work()
    monkeypatch.setattr(progress, "_PATIENCE", -1.0)
    work(show=False)
    assert screen.getvalue() == ""


def test_long_work_shows_each_kind(terminal, monkeypatch):
    monkeypatch.setattr(progress, "_PATIENCE", -1.0)
    screen = terminal()
    work()
    drawn = screen.getvalue()
    assert "reading runs" in drawn
    assert "3/3" in drawn
    assert "fitting" in drawn


def test_the_cursor_comes_back_after_an_error(terminal, monkeypatch):
    monkeypatch.setattr(progress, "_PATIENCE", -1.0)
    screen = terminal()

    def spoilt() -> None:
        with progress.progress_bar() as told:
            told("reading runs", 1, 3)
            raise ValueError("spoilt")

    with pytest.raises(ValueError, match="spoilt"):
        spoilt()
    hidden, shown = "\x1b[?25l", "\x1b[?25h"
    assert screen.getvalue().rindex(shown) > screen.getvalue().rindex(hidden)
