"""Which solver wrote a file of histories, and what its columns are."""

from __future__ import annotations

from pathlib import Path

from ..core.errors import ReadError
from .fluent_report import fluent_layout
from .log_layout import LogLayout
from .monitor_table import monitor_layout
from .openfoam_header import openfoam_layout
from .solver_log import EmptyLogError
from .star_ccm import star_layout
from .text_bytes import refuse_binary

_HEAD = 65_536
_LARGEST_HEAD = 64 * 2**20
_DIALECTS = (openfoam_layout, fluent_layout, star_layout)


def layout_of(path: Path, index: str | int | None = None) -> LogLayout:
    """The columns of a file of histories, told by its header and its first rows.

    Parameters
    ----------
    path : Path
        The file.
    index : str or int, optional
        Column of a table of unknown origin that is the time, by name or by number from 1.

    Raises
    ------
    EmptyLogError
        If the file is empty or holds a header only.
    ReadError
        If it is missing, binary or of no known form.
    """
    return layout_from(read_head(path), path, index)


def layout_from(head: bytes, path: Path, index: str | int | None = None) -> LogLayout:
    """The same from the beginning of a file."""
    if not head.strip():
        raise EmptyLogError(
            "the file is empty", cure="the run wrote nothing: leave it out or repeat it", file=path
        )
    refuse_binary(head, str(path))
    for dialect in _DIALECTS:
        layout = dialect(head, path)
        if layout is not None:
            return layout
    layout = monitor_layout(head, path, index)
    if layout is not None:
        return layout
    raise ReadError(
        "is no history of a known form",
        cure="give OpenFOAM's postProcessing files, STAR-CCM+ monitors as CSV, Fluent report files (.out, .frp), or a "
        "table of columns with a line of names",
        file=path,
    )


def read_head(path: Path) -> bytes:
    """The beginning of the file, with some rows behind even the longest header."""
    try:
        with open(path, "rb") as file:
            head = file.read(_HEAD)
            while len(head) < _LARGEST_HEAD and not _has_rows(head):
                more = file.read(len(head))
                if not more:
                    break
                head += more
    except FileNotFoundError:
        raise ReadError("file not found", cure="check the path", file=path) from None
    except OSError as error:
        raise ReadError(
            f"cannot be read ({error.strerror or error})", cure="check its permissions", file=path
        ) from None
    return head


def _has_rows(head: bytes) -> bool:
    """Whether at least one whole line below the comments is there."""
    lines = head.rpartition(b"\n")[0].splitlines()
    return bool(lines) and not lines[-1].lstrip().startswith(b"#")
