"""Words of the command line for squat: channels, windows and speeds."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import TowtankError

CHANNELS_EXAMPLE = '"time=time, speed=u, bow=z_VF, stern=z_VA"'
_ROLES = ("time", "speed", "bow", "stern", "heave", "trim", "extra", "wave")

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)"

_USUAL = {
    "time": ("time", "t"),
    "speed": ("speed", "u", "v"),
    "bow": ("bow", "sinkage_bow", "z_bow", "bow_sinkage"),
    "stern": ("stern", "sinkage_stern", "z_stern", "stern_sinkage"),
    "heave": ("heave", "sinkage"),
    "trim": ("trim", "pitch"),
}
"""Names that need no ``--channels``."""


def channels_from(text: str) -> dict[str, Any]:
    """Section ``[channels]`` from ``role=column, ...``; a place ``x`` or ``x/y`` in m is a role too.

    A unit may follow a column in square brackets.

    Raises
    ------
    TowtankError
        For an unknown role, a word without ``=`` or a role that is given twice.
    """
    section: dict[str, Any] = {}
    for word in (part.strip() for part in text.split(",")):
        role, equals, column = (part.strip() for part in word.partition("="))
        if not (role and equals and column):
            raise TowtankError(
                f"--channels: '{word}' is not role=column", cure=f"write for example {CHANNELS_EXAMPLE}"
            )
        match = re.fullmatch(r"(.*\S)\s*\[([^\]]+)\]", column)
        if match:
            column = match[1]
            section.setdefault("units", {})[column] = match[2].strip()
        place = re.fullmatch(rf"({_NUMBER})(?:/({_NUMBER}))?", role)
        if place:
            section.setdefault("points", {})[column] = (float(place[1]), float(place[2] or 0.0))
        elif role == "extra":
            section.setdefault("extra", []).append(column)
        elif role not in _ROLES:
            raise TowtankError(
                f"--channels: '{role}' is no role",
                cure=f"roles are {', '.join(_ROLES)}, or a place x or x/y in m from midship",
            )
        elif role in section:
            raise TowtankError(f"--channels: '{role}' is given twice", cure="name one column")
        else:
            section[role] = column
    return section


def usual_channels(file: Path) -> dict[str, Any]:
    """Section ``[channels]`` for a file whose columns have usual names.

    Raises
    ------
    TowtankError
        When time, or bow and stern, or heave and trim are not among them.
    """
    from ..formats.read import read_table

    columns = list(read_table(file).columns)
    found = {role: next((name for name in columns if name.lower() in names), "") for role, names in _USUAL.items()}
    pair = ("bow", "stern") if found["bow"] and found["stern"] else ("heave", "trim")
    if not all(found[role] for role in ("time", *pair)):
        raise TowtankError(
            f"which channels are time and sinkage is not known; the columns are {', '.join(columns)}",
            cure=f"name them, for example --channels {CHANNELS_EXAMPLE}",
            file=file,
        )
    return {role: found[role] for role in ("time", "speed", *pair) if found[role]}


def window_from(text: str) -> dict[str, Any]:
    """Section ``[window]`` from ``30-95%``, ``plateau``, ``plateau 30-95%``, ``mser`` or ``63.5:79.2`` (s).

    Raises
    ------
    TowtankError
    """
    words = text.strip()
    number = f"({_NUMBER})"
    share = re.fullmatch(rf"(?:(fraction|plateau)\s+)?{number}\s*(?:-|to)\s*{number}\s*%", words)
    if share:
        return {"rule": share[1] or "fraction", "begin": float(share[2]) / 100, "end": float(share[3]) / 100}
    times = re.fullmatch(rf"{number}?\s*:\s*{number}?", words)
    if times and (times[1] or times[2]):
        section: dict[str, Any] = {"rule": "key-times"}
        section |= {key: float(of) for key, of in (("start", times[1]), ("stop", times[2])) if of}
        return section
    if words in ("fraction", "plateau", "mser"):
        return {"rule": words}
    if words == "auto":
        return {"rule": "mser"}
    raise TowtankError(
        f"--window: '{text}' is not understood",
        cure="write 30-95%, plateau, auto, or seconds as 63.5:79.2",
    )


def speeds_from(text: str, unit: str) -> np.ndarray:
    """Speeds in m/s from ``6:16:1`` (first, last and step, last included) or ``6,8,10``, shape (n,).

    Parameters
    ----------
    text : str
    unit : str
        ``kn`` or ``m/s``.

    Raises
    ------
    TowtankError
    """
    factors = {"kn": 1852.0 / 3600.0, "m/s": 1.0}
    if unit not in factors:
        raise TowtankError(f"--speed-unit: '{unit}' is no unit of speed here", cure="use kn or m/s")
    try:
        if ":" in text:
            parts = [float(part) for part in text.split(":")]
            first, last, step = parts if len(parts) == 3 else (*parts, 1.0)
            if not (step > 0.0 and np.isfinite(last) and last >= first):
                raise ValueError
            count = int(np.floor((last - first) / step * (1.0 + 1e-12) + 1e-9)) + 1
            if count > 1000:
                raise TowtankError(f"--speed: {count} speeds", cure="give a larger step")
            speeds = first + step * np.arange(count)
        else:
            speeds = np.array([float(part) for part in text.split(",")])
    except ValueError:
        raise TowtankError(
            f"--speed: '{text}' is not understood", cure="write first:last:step as 6:16:1, or 6,8,10"
        ) from None
    if not np.isfinite(speeds).all() or (speeds <= 0.0).any():
        raise TowtankError(f"--speed: '{text}' has a speed that is not positive", cure="give speeds above 0")
    return np.asarray(speeds * factors[unit])
