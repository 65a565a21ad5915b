"""Where a number came from: program, files, choices, findings."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

from .findings import Finding


def program_versions() -> dict[str, str]:
    """Versions of towtank, Python and the libraries that make the numbers."""
    return dict(_installed())


@cache
def _installed() -> Mapping[str, str]:
    """The same, read once: a campaign has a provenance for every fit."""
    from importlib.metadata import PackageNotFoundError, version

    versions = {"python": platform.python_version()}
    for name in ("towtank", "numpy", "scipy", "pandas"):
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            versions[name] = "not installed"
    return versions


@dataclass(frozen=True)
class Provenance:
    """History of a result.

    Attributes
    ----------
    source : str
        Paper and table, or the campaign file.
    inputs : mapping of str to str
        File -> sha256 of its bytes.
    choices : mapping
        Each choice that was made, by name: window, harmonics, filter, model, weights, ...
    findings : tuple of Finding
        What the audit said, waivers included.
    history : tuple of str
        What was done to the result since, e.g. conversions.
    misprints : tuple of str
        Known errors of the source and what was done about them.
    versions : mapping of str to str
        Program versions.
    """

    source: str = ""
    inputs: Mapping[str, str] = field(default_factory=dict)
    choices: Mapping[str, Any] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    history: tuple[str, ...] = ()
    misprints: tuple[str, ...] = ()
    versions: Mapping[str, str] = field(default_factory=dict)

    def and_then(self, step: str) -> Provenance:
        """Copy with one more step of history."""
        return replace(self, history=(*self.history, step))

    def to_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Provenance:
        """Provenance from :meth:`to_dict`."""
        values = dict(data)
        values["findings"] = tuple(Finding(**item) for item in values.get("findings", ()))
        for key in ("history", "misprints"):
            values[key] = tuple(values.get(key, ()))
        return cls(**values)


def file_hash(path: str | Path) -> str:
    """sha256 of a file's bytes."""
    import hashlib

    digest = hashlib.sha256()
    with open(path, "rb") as stream:
        for block in iter(lambda: stream.read(1 << 20), b""):
            digest.update(block)
    return digest.hexdigest()
