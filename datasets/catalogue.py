"""The files of published numbers: one paper each, found by the keys of what they hold.

A file is TOML::

    notes = ["said of every set of the paper"]
    [source]                 # authors, title, year, published, doi
    [conventions]            # choices that differ from home, for the whole paper
    [ship.<key>]             # particulars in SI; like = "<other key>" and scale = ... for similar ships
    [[set]]                  # a derivative set, see sets.py
    [[table]]                # a table, see tables.py

The key of a set or table is the first line of its block, so that a paper can be found without reading all.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any, Literal

from ..core.conventions import Conventions
from ..core.errors import DatasetError, TowtankError
from ..core.ship import Ship

FOLDER = Path(__file__).with_name("papers")

Kind = Literal["set", "table"]

_HEADING = re.compile(r'^\[\[(set|table)\]\]\nkey = "([^"]+)"$', re.MULTILINE)
_PAPER_KEYS = {"notes", "source", "conventions", "ship", "set", "table"}
_SOURCE_KEYS = {"authors", "title", "year", "published", "doi"}


@dataclass(frozen=True, eq=False)
class Paper:
    """One file of published numbers."""

    file: Path
    data: Mapping[str, Any]

    @cached_property
    def reference(self) -> str:
        """Authors, year, title and where it was published, in one line."""
        source = self.data["source"]
        year = f" ({source['year']})" if "year" in source else ""
        if source.get("authors"):
            parts = [f"{source['authors']}{year}", source["title"]]
        else:
            parts = [f"{source['title']}{year}"]
        if source.get("published"):
            parts.append(source["published"])
        if "doi" in source:
            parts.append(f"doi {source['doi']}")
        return ", ".join(parts)

    def block(self, kind: Kind, key: str) -> Mapping[str, Any]:
        """The set or table of that key."""
        found: Mapping[str, Any] = next(item for item in self.data[kind] if item["key"] == key)
        return found

    def conventions(self, changes: Mapping[str, Any]) -> Conventions:
        """Home with the choices of the paper and then those of one set or table."""
        return Conventions.from_dict({**self.data.get("conventions", {}), **changes})

    def ship(self, key: str) -> Ship:
        """Ship of that key.

        Raises
        ------
        DatasetError
            When the paper does not describe it, or not fully.
        """
        try:
            fields = dict(self.data["ship"][key])
        except KeyError:
            raise DatasetError(f"no ship '{key}'", cure="add [ship.<key>]", file=self.file) from None
        fields.pop("note", None)
        similar = fields.pop("like", None)
        try:
            if similar is None:
                return Ship.from_dict(fields)
            ship = self.ship(similar)
            if "scale" in fields:
                ship = ship.at_scale(fields.pop("scale"), rho=fields.pop("rho", None))
            return replace(ship, **fields)
        except (TowtankError, TypeError) as error:
            raise DatasetError(str(error), file=self.file, place=f"ship.{key}") from error

    def ship_note(self, key: str) -> str:
        """What is to be said about the particulars of a ship; empty when nothing."""
        fields = self.data["ship"][key]
        return str(fields.get("note") or (self.ship_note(fields["like"]) if "like" in fields else ""))


def correction_sentence(what: str, printed: float, item: Mapping[str, Any], corrected: bool) -> str:
    """What was done about a misprint: `item` holds ``corrected`` and ``reason``."""
    right, reason = item["corrected"], item["reason"]
    if corrected:
        return f"{what}: {right:g} used for the printed {printed:g}: {reason}"
    return f"{what}: {printed:g} as printed, {right:g} is right: {reason}"


def doubt_sentence(what: str, printed: float, item: Mapping[str, Any]) -> str:
    """A number that is kept but doubted: `item` holds ``reason`` and perhaps ``likely``."""
    likely = f", {item['likely']:g} is likely" if "likely" in item else ""
    return f"{what}: {printed:g} as printed is doubtful{likely}: {item['reason']}"


def check_keys(block: Mapping[str, Any], known: set[str], required: set[str], file: Path, place: str) -> None:
    """Refuse unknown and missing keys of a block.

    Raises
    ------
    DatasetError
        With the key and where it stands.
    """
    for key in sorted(set(block) - known):
        raise DatasetError(
            f"unknown key '{key}'", cure=f"keys are {', '.join(sorted(known))}", file=file, place=place
        )
    for key in sorted(required - set(block)):
        raise DatasetError(f"'{key}' is missing", file=file, place=place)


@cache
def read_paper(file: Path) -> Paper:
    """Paper of a file.

    Raises
    ------
    DatasetError
        When the file is not readable as a paper.
    """
    try:
        data = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise DatasetError(f"not readable as TOML: {error}", file=file) from error
    check_keys(data, _PAPER_KEYS, {"source"}, file, "top")
    check_keys(data["source"], _SOURCE_KEYS, {"title"}, file, "source")
    return Paper(file, data)


@cache
def index(kind: Kind) -> dict[str, Path]:
    """Key of each set or table and the file that holds it, in alphabetical order."""
    found: dict[str, Path] = {}
    for file in sorted(FOLDER.glob("*.toml")):
        for what, key in _HEADING.findall(file.read_text(encoding="utf-8")):
            if what != kind:
                continue
            if key in found:
                raise DatasetError(f"{kind} '{key}' is also in {found[key].name}", file=file)
            found[key] = file
    return dict(sorted(found.items()))


def find(kind: Kind, key: str) -> Paper:
    """Paper that holds the set or table of that key.

    Raises
    ------
    DatasetError
        For an unknown key, with those nearest to it.
    """
    files = index(kind)
    if key not in files:
        from difflib import get_close_matches

        near = get_close_matches(key, files, n=4, cutoff=0.4) or list(files)
        raise DatasetError(f"no published {kind} '{key}'", cure=f"did you mean {', '.join(near)}")
    return read_paper(files[key])
