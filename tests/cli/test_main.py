"""The entry point: exit status, one line on standard error, tracebacks only when asked."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
import typer

from towtank.cli import main as entry
from towtank.core.errors import ReadError


@pytest.fixture
def failing(monkeypatch):
    """Make every command raise an error."""

    def fail(error: BaseException) -> None:
        def app(**_: object) -> None:
            raise error

        monkeypatch.setattr(entry, "app", app)

    return fail


CASES = [
    (
        ReadError("no\nsamples", cure="export again", file="a.txt", place="row 1"),
        2,
        "towtank: a.txt, row 1: no samples -> export again\n",
    ),
    (
        PermissionError(13, "Permission denied", "/results"),
        2,
        "towtank: /results: Permission denied -> give a path",
    ),
    (OSError(28, "No space left on device"), 2, "towtank: output: No space left on device -> give a path"),
    (KeyboardInterrupt(), 130, "towtank: interrupted; earlier results are untouched\n"),
    (typer.Abort(), 130, "towtank: interrupted; earlier results are untouched\n"),
    (
        ZeroDivisionError("by\nzero"),
        1,
        "towtank: defect in towtank: ZeroDivisionError: by zero -> run again with --debug",
    ),
]


@pytest.mark.parametrize(("error", "status", "said"), CASES)
def test_an_error_is_one_line_and_a_status(failing, towtank, error, status, said):
    failing(error)
    ended = towtank("run")
    assert ended.status == status
    assert ended.out == ""
    assert ended.err.startswith(said)
    assert ended.err.count("\n") == 1


@pytest.mark.parametrize("error", [case[0] for case in CASES if isinstance(case[0], Exception)][:3])
def test_debug_lets_the_error_through_wherever_it_stands(failing, error):
    failing(error)
    for words in (["--debug", "run"], ["run", "--debug"]):
        with pytest.raises(type(error)):
            entry.main(words)


def test_a_closed_pipe_is_no_error(failing, monkeypatch):
    import io

    monkeypatch.setattr(sys, "stderr", io.StringIO())
    failing(BrokenPipeError())
    with pytest.raises(SystemExit) as ended:
        entry.main([])
    assert ended.value.code == 0


def test_without_a_command_the_commands_are_listed(towtank):
    ended = towtank()
    assert ended.status == 2
    assert "synthesize" in ended.out + ended.err


def test_help_of_the_whole(towtank):
    for flag in ("--help", "-h"):
        ended = towtank(flag)
        assert ended.status == 0
        assert "Example: towtank run campaign.toml" in ended.out
        for command in ("demo", "run", "audit", "init", "sets", "show", "convert", "export", "compare", "plan"):
            assert command in ended.out


@pytest.mark.parametrize(
    "words", [("fly",), ("run", "c.toml", "--fast"), ("export", "kvlcc2"), ("run", "--workers", "x")]
)
def test_a_wrong_command_line_says_where_help_is(towtank, words):
    ended = towtank(*words)
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert "--help)" in ended.err


def test_the_module_runs_as_a_program():
    done = subprocess.run(
        [sys.executable, "-m", "towtank", "run", "none.toml"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr == "towtank: none.toml: file not found -> give the path of a campaign.toml\n"


def test_debug_of_the_program_shows_the_traceback():
    done = subprocess.run(
        [sys.executable, "-m", "towtank", "run", "none.toml", "--debug"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode != 0
    assert "Traceback" in done.stderr
    assert "CampaignError: none.toml: file not found" in done.stderr


def test_looking_for_help_loads_no_heavy_library():
    """The command line answers at once because pandas, scipy and matplotlib stay unread."""
    code = (
        "import sys\nfrom towtank.cli.main import main\ntry:\n    main(['--version'])\nexcept SystemExit:\n    pass\n"
        "print(*(name for name in ('pandas', 'scipy.stats', 'sklearn', 'statsmodels', 'cvxpy', 'matplotlib', 'numba')"
        " if name in sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[1:] == [""]


def commands(command, path=()):
    """Every command and group of the application, with its words."""
    yield command, path
    for name, sub in getattr(command, "commands", {}).items():
        yield from commands(sub, (*path, name))


COMMANDS = list(commands(typer.main.get_command(entry.app)))


@pytest.mark.parametrize(("command", "path"), COMMANDS, ids=[" ".join(path) or "towtank" for _, path in COMMANDS])
def test_help_loses_no_word_in_square_brackets(command, path):
    texts = [command.help, *(getattr(parameter, "help", None) for parameter in command.params)]
    # the page of help takes [word] for a style and prints nothing; \[word] is printed
    assert [text for text in texts if re.search(r"(?<!\\)\[[a-z]", text or "")] == []
