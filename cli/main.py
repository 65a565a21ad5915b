"""The ``towtank`` command: one application, errors in one line, exit status 2 for what the user can mend."""

from __future__ import annotations

import inspect
import sys
from typing import Annotated, Any

import typer

from ..core.errors import TowtankError
from . import (
    campaign_commands,
    cfd_commands,
    compare_command,
    decay_command,
    gci_command,
    planning_commands,
    reproduce_command,
    set_commands,
    simulate_command,
    squat_commands,
    uq_command,
    validate_cfd_command,
    validate_command,
)
from .demo_command import demo

app = typer.Typer(
    name="towtank",
    help="Captive tests to hydrodynamic derivatives, with uncertainty and conventions attached to every number.\n\n"
    "Example: towtank run campaign.toml --out results",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(value: bool) -> None:
    if value:
        from .. import __version__

        typer.echo(f"towtank {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    debug: Annotated[bool, typer.Option("--debug", help="Show the traceback of an error.")] = False,
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


app.command("demo")(demo)
campaign_commands.register(app)
decay_command.register(app)
cfd_commands.register(app)
set_commands.register(app)
compare_command.register(app)
planning_commands.register(app)
simulate_command.register(app)
squat_commands.register(app)
validate_command.register(app)
gci_command.register(app)
validate_cfd_command.register(app)
uq_command.register(app)
reproduce_command.register(app)


def _flow_help(group: typer.Typer) -> None:
    """Let the width of the terminal, not that of the source, break the lines of every help text."""
    for command in group.registered_commands:
        paragraphs = inspect.getdoc(command.callback or _options) or ""
        command.help = "\n\n".join(" ".join(part.split()) for part in paragraphs.split("\n\n"))
    for below in group.registered_groups:
        if below.typer_instance is not None:
            _flow_help(below.typer_instance)


_flow_help(app)


def main(arguments: list[str] | None = None) -> None:
    """Entry point of the command line.

    Exit status: 0 done, 1 a defect of the program, 2 something the user can mend, 130 interrupted.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in words
    # --debug may stand anywhere on the line
    words = [word for word in words if word != "--debug"]
    try:
        status = app(args=words, prog_name="towtank", standalone_mode=False)
        sys.exit(status if isinstance(status, int) else 0)
    except TowtankError as error:
        if debug:
            raise
        _fail(str(error), 2)
    except (KeyboardInterrupt, typer.Abort):
        _fail("interrupted; earlier results are untouched", 130)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)
    except OSError as error:
        if debug:
            raise
        reason = error.strerror or str(error)
        _fail(f"{error.filename or 'output'}: {reason} -> give a path that you may read and write", 2)
    except Exception as error:
        if type(error).__name__ == "NoArgsIsHelpError":
            # the help has been printed
            sys.exit(2)
        if _is_usage(error):
            _fail(_usage_text(error), 2)
        if debug:
            raise
        _fail(f"defect in towtank: {type(error).__name__}: {error} -> run again with --debug and report it", 1)


def _is_usage(error: Exception) -> bool:
    # Typer carries a click of its own in newer versions; both mark a wrong command line in the same way.
    return hasattr(error, "format_message") and hasattr(error, "exit_code")


def _usage_text(error: Any) -> str:
    context = getattr(error, "ctx", None)
    hint = f" (see: {context.command_path} --help)" if context is not None else ""
    return f"{error.format_message()}{hint}"


def _fail(message: str, status: int) -> None:
    print(f"towtank: {' '.join(message.split())}", file=sys.stderr)
    sys.exit(status)


if __name__ == "__main__":
    main()
