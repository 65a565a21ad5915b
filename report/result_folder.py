"""A folder of results: complete or not at all, and nothing of an earlier result left in it."""

from __future__ import annotations

import json
import os
import secrets
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import TowtankError

if TYPE_CHECKING:
    import pandas as pd

Progress = Callable[[str, int, int], None]
Writer = Callable[[Path], Any]
"""Writes one file, or nothing where there is nothing to write."""

PROVENANCE = "provenance.json"


def write_folder(
    out: Path,
    writers: Sequence[tuple[str, Writer]],
    provenance: dict[str, Any],
    progress: Progress | None = None,
) -> list[Path]:
    """Write files and a provenance that lists them.

    Everything is made in a folder beside `out` first. A new folder then appears at once; in an existing one file
    after file is replaced, and files that its provenance lists and this result does not have are removed. Until then
    the old result stays.

    Parameters
    ----------
    out : Path
        Made when it is missing.
    writers : sequence of (str, callable)
        Name of each file and what writes it.
    provenance : dict
        With a key ``format``, which says whose results these are.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files, the provenance last.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    require_folder(out, provenance["format"])
    with _beside(out) as folder:
        names: list[str] = []
        for number, (name, write) in enumerate(writers):
            if progress:
                progress("writing", number, len(writers))
            write(folder / name)
            if (folder / name).exists():
                names.append(name)
        write_json(provenance | {"files": [*names, PROVENANCE]}, folder / PROVENANCE)
        names.append(PROVENANCE)
        if progress:
            progress("writing", len(writers), len(writers))
        _publish(folder, out, names)
    return [out / name for name in names]


def require_folder(out: Path, wanted: str) -> None:
    """Refuse a file, and a folder with results whose provenance has another format than `wanted`.

    Raises
    ------
    TowtankError
    """
    if out.exists() and not out.is_dir():
        raise TowtankError("this is a file", cure="give a folder for the results", file=out)
    found = _old_provenance(out).get("format")
    if isinstance(found, str) and found.startswith("towtank ") and found != wanted:
        kinds = " and ".join(item.removeprefix("towtank ").rstrip(" 1") for item in (found, wanted))
        raise TowtankError(
            f"the folder holds results of another kind ({kinds})", cure="give another folder with --out", file=out
        )


def csv_writer(frame: Callable[[], pd.DataFrame]) -> Writer:
    """What writes a table as CSV with all digits."""
    # pandas writes the shortest text that reads back as the same number
    return lambda path: frame().to_csv(path, index=False)


def write_json(data: Any, path: Path) -> None:
    """Write plain data, one value a line."""
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def timestamp(created: datetime | None = None) -> str:
    """A moment in UTC as a provenance has it; the present one when not given."""
    return (created or datetime.now(UTC)).astimezone(UTC).isoformat(timespec="seconds")


@contextmanager
def _beside(out: Path) -> Iterator[Path]:
    """A temporary folder beside `out`, on the same disk, gone at the end."""
    folder = out.absolute().with_name(f".{out.absolute().name}.{secrets.token_hex(4)}")
    try:
        folder.mkdir(parents=True)
    except OSError as error:
        raise TowtankError(
            f"the folder cannot be written to: {error.strerror}", cure="give another folder", file=out
        ) from None
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _publish(folder: Path, out: Path, names: list[str]) -> None:
    """Move the files of `folder` to `out`."""
    try:
        if not out.exists():
            os.replace(folder, out)
            return
        listed = _old_provenance(out).get("files", [])
        own = {name for name in listed if isinstance(name, str) and Path(name).name == name}
        for name in names:
            os.replace(folder / name, out / name)
        for name in own - set(names):
            (out / name).unlink(missing_ok=True)
    except OSError as error:
        raise TowtankError(
            f"the results cannot be moved there: {error.strerror}",
            cure="close files that are open there",
            file=out,
        ) from None


def _old_provenance(out: Path) -> dict[str, Any]:
    """Provenance of the result that is in a folder now; empty when there is none of ours."""
    try:
        data = json.loads((out / PROVENANCE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    ours = isinstance(data, dict) and str(data.get("format", "")).startswith("towtank ")
    return data if ours else {}
