"""Errors and warnings that name the file, the place, the cause and the cure.

Every error that a user can cause is a :class:`TowtankError`. The command line prints it in one line and
exits with status 2; the library lets it pass so that a script can catch it by kind.
"""

from __future__ import annotations

from pathlib import Path


class TowtankError(Exception):
    """A fault that the user can mend.

    Parameters
    ----------
    cause : str
        What is wrong, in one sentence without a full stop.
    cure : str, optional
        What to do about it.
    file : str or Path, optional
        The file at fault.
    place : str, optional
        Row, key, channel or run inside the file.
    """

    def __init__(self, cause: str, *, cure: str = "", file: str | Path | None = None, place: str = "") -> None:
        self.cause = cause
        self.cure = cure
        self.file = str(file) if file is not None else ""
        self.place = place
        super().__init__(cause)

    def __str__(self) -> str:
        where = ", ".join(part for part in (self.file, self.place) if part)
        text = f"{where}: {self.cause}" if where else self.cause
        if self.cure:
            text = f"{text} -> {self.cure}"
        return " ".join(text.split())

    def __reduce__(self) -> tuple[object, ...]:
        # Errors cross process boundaries when runs are read in parallel; keyword arguments must survive.
        return _rebuild, (type(self), self.cause, self.cure, self.file, self.place)


def _rebuild(kind: type[TowtankError], cause: str, cure: str, file: str, place: str) -> TowtankError:
    return kind(cause, cure=cure, file=file or None, place=place)


class ReadError(TowtankError):
    """A file cannot be read as the table that it is said to be."""


class CampaignError(TowtankError):
    """A campaign file or a key in it is wrong."""


class AuditError(TowtankError):
    """The import audit found a fault that would make the numbers wrong."""


class ConventionError(TowtankError):
    """A convention is unknown, or a conversion between two of them is not exact."""


class TermError(TowtankError):
    """A hull-force term cannot be understood or evaluated."""


class FitError(TowtankError):
    """The data cannot support the fit that was asked for."""


class DatasetError(TowtankError):
    """A published table is unknown or malformed."""


class SimulationError(TowtankError):
    """A manoeuvre cannot be sailed: divergence, reversed flow, a manoeuvre that is not completed."""


class TowtankWarning(UserWarning):
    """Something the user should know that does not make the result wrong."""
