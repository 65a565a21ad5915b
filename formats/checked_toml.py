"""TOML files checked key by key: what is wrong is said with file, key, cause and cure."""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from ..core.errors import TowtankError

File = TypeVar("File", bound=BaseModel)


def read_toml(path: Path, error: type[TowtankError], *, what: str = "TOML file") -> dict[str, Any]:
    """Contents of a TOML file in utf-8.

    Parameters
    ----------
    path : Path
    error : type of TowtankError
        What is raised.
    what : str
        What the file is to be, e.g. ``"campaign.toml"``.

    Raises
    ------
    TowtankError
        When the file is missing, is a folder, cannot be read, or is not TOML.
    """
    try:
        return tomllib.loads(path.read_bytes().decode("utf-8"))
    except FileNotFoundError:
        raise error("file not found", cure=f"give the path of a {what}", file=path) from None
    except IsADirectoryError:
        raise error("this is a folder", cure=f"give the {what} inside it", file=path) from None
    except UnicodeDecodeError:
        raise error("not a text file", cure=f"a {what} is TOML in utf-8", file=path) from None
    except OSError as reason:
        raise error(
            f"not readable ({reason.strerror})", cure="check the path and its permissions", file=path
        ) from None
    except tomllib.TOMLDecodeError as reason:
        raise error(f"not valid TOML: {reason}", cure="mend the syntax there", file=path) from None


def validated_sections(
    model: type[File],
    data: Mapping[str, Any],
    path: Path,
    error: type[TowtankError],
    sections: Mapping[str, type[BaseModel]],
) -> File:
    """The contents of a file as a model.

    Parameters
    ----------
    model : type of BaseModel
        Of the whole file.
    data : mapping
    path : Path
        For the message.
    error : type of TowtankError
        What is raised.
    sections : mapping of str to type of BaseModel
        Models of the sections by their names: an unknown key is answered with the nearest ones of its section.

    Raises
    ------
    TowtankError
        With the first fault.
    """
    try:
        return model.model_validate(data)
    except ValidationError as fault:
        raise _first_fault(fault, model, path, error, sections) from None


def _first_fault(
    fault: ValidationError,
    model: type[BaseModel],
    path: Path,
    error: type[TowtankError],
    sections: Mapping[str, type[BaseModel]],
) -> TowtankError:
    """The fault that is to be mended first, in the user's words."""
    faults = fault.errors()
    # A misspelt key is told before the key that is missing because of it.
    first = next((one for one in faults if one["type"] == "extra_forbidden"), faults[0])
    keys = [str(part) for part in first["loc"]]
    # A validator of ours may bring the cure along.
    cause, _, cure = first["msg"].removeprefix("Value error, ").partition(" -> ")
    if first["type"] == "extra_forbidden":
        section = next((sections[key] for key in reversed(keys[:-1]) if key in sections), model)
        close = difflib.get_close_matches(keys[-1], section.model_fields, n=3, cutoff=0.6)
        cause = "unknown key"
        cure = f"closest: {', '.join(close)}" if close else f"keys here are {', '.join(section.model_fields)}"
    elif first["type"] == "missing":
        cause, cure = "the key is missing", "add it"
    elif first["type"] != "value_error":
        cause = f"{cause[:1].lower()}{cause[1:]}, not {first['input']!r}"
    more = f" (and {fault.error_count() - 1} more)" if fault.error_count() > 1 else ""
    return error(
        f"{cause}{more}",
        cure=cure or f"correct it in {path.name}",
        file=path,
        place=f"key '{'.'.join(keys)}'" if keys else "",
    )
