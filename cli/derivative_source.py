"""What a user may name where a derivative set is wanted: a file, or the key of a published set."""

from __future__ import annotations

from pathlib import Path

from ..core.derivative_set import DerivativeSet
from ..core.errors import DatasetError, ReadError


def load_derivatives(name: str) -> DerivativeSet:
    """Set from a JSON or CSV file, a results folder, or the key of a published set.

    Raises
    ------
    ReadError
        When it is neither.
    """
    path = Path(name)
    if path.is_dir():
        path = path / "derivatives.json"
    if path.suffix.lower() in (".json", ".csv") or path.is_file():
        from ..report.set_table import read_set

        return read_set(path)
    from ..datasets import load_set

    try:
        return load_set(name)
    except DatasetError as error:
        raise ReadError(
            f"'{name}' is neither a file nor a published set", cure=error.cure or "see: towtank sets"
        ) from None
