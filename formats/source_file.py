"""The bytes of a measurement file, read once and hashed."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from ..core.errors import ReadError


@dataclass(frozen=True, eq=False)
class SourceFile:
    """A file held in memory.

    Attributes
    ----------
    path : str
        Where it was read.
    data : bytes
        All of its bytes.
    sha256 : str
        Their SHA-256 digest in hexadecimal.
    """

    path: str
    data: bytes
    sha256: str

    @classmethod
    def read(cls, path: str | Path) -> SourceFile:
        """Read `path` once.

        Raises
        ------
        ReadError
            If the file is missing, is a folder, may not be read, or is empty.
        """
        try:
            data = Path(path).read_bytes()
        except FileNotFoundError:
            raise ReadError(
                "file not found", cure="check the path; relative paths start at the campaign file", file=path
            ) from None
        except IsADirectoryError:
            raise ReadError("is a folder, not a file", cure="name the run files in it", file=path) from None
        except OSError as error:
            raise ReadError(
                f"cannot be read ({error.strerror or error})", cure="check its permissions", file=path
            ) from None
        if not data:
            raise ReadError("the file is empty", cure="export the run again or leave it out", file=path)
        return cls(str(path), data, hashlib.sha256(data).hexdigest())
