"""Derivative sets as JSON: exact both ways."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .conventions import Conventions
from .errors import ReadError, TowtankError
from .provenance import Provenance
from .ship import Ship
from .terms import Factor, Term

if TYPE_CHECKING:
    from .derivative_set import DerivativeSet

FORMAT = "towtank derivative set 1"


def _plain(value: Any) -> Any:
    """Builtin types only; floats that JSON does not know become text."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | set):
        return [_plain(item) for item in value]
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, Path):
        return str(value)
    return value


def _term_to_dict(term: Term) -> dict[str, Any]:
    return {
        "name": term.name,
        "component": term.component,
        "sign": term.sign,
        "factors": [[factor.variable, factor.power, factor.modulus] for factor in term.factors],
    }


def set_to_dict(result: DerivativeSet) -> dict[str, Any]:
    """Plain mapping of a set."""
    data = {
        "format": FORMAT,
        "name": result.name,
        "ship": result.ship.to_dict(),
        "conventions": result.conventions.to_dict(),
        "reference_speed": result.reference_speed,
        "terms": [_term_to_dict(term) for term in result.terms],
        "values": result.values,
        "covariance": result.covariance,
        "dof": result.dof,
        "validity": result.validity,
        "diagnostics": result.diagnostics,
        "provenance": result.provenance.to_dict(),
    }
    plain: dict[str, Any] = _plain(data)
    return plain


def set_from_dict(data: Mapping[str, Any]) -> DerivativeSet:
    """Set from :func:`set_to_dict`.

    Raises
    ------
    ReadError
        When the mapping is not a derivative set.
    """
    from .derivative_set import DerivativeSet

    if data.get("format") != FORMAT:
        raise ReadError(
            "this is not a derivative set", cure=f'it should say "format": "{FORMAT}"; write one with to_json'
        )
    try:
        terms = tuple(
            Term(
                item["name"],
                item["component"],
                tuple(Factor(*factor) for factor in item["factors"]),
                item["sign"],
            )
            for item in data["terms"]
        )
        covariance = data["covariance"]
        return DerivativeSet(
            name=data["name"],
            ship=Ship.from_dict(data["ship"]),
            terms=terms,
            values=np.array([float(value) for value in data["values"]]),
            conventions=Conventions.from_dict(data["conventions"]),
            covariance=None if covariance is None else np.array(covariance, dtype=float),
            reference_speed=data["reference_speed"],
            validity={key: (float(low), float(high)) for key, (low, high) in data["validity"].items()},
            diagnostics=data["diagnostics"],
            dof=float(data["dof"]),
            provenance=Provenance.from_dict(data["provenance"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ReadError(
            f"the derivative set is incomplete: {error}", cure="write it again with to_json"
        ) from error


def write_json(result: DerivativeSet, path: str | Path | None) -> str:
    """JSON text of a set, written to `path` by way of a temporary name."""
    text = json.dumps(set_to_dict(result), indent=1)
    if path is not None:
        target = Path(path)
        temporary = target.with_name(f".{target.name}.{os.getpid()}")
        temporary.write_text(text + "\n", encoding="utf-8")
        os.replace(temporary, target)
    return text


def read_json(source: str | Path) -> DerivativeSet:
    """Set from a file or from JSON text."""
    text = str(source)
    file: str | None = None
    if not text.lstrip().startswith("{"):
        file = text
        try:
            text = Path(source).read_text(encoding="utf-8")
        except FileNotFoundError:
            raise ReadError("file not found", cure="give the path of a derivatives.json", file=file) from None
        except (OSError, UnicodeDecodeError) as error:
            raise ReadError(f"not readable as text: {error}", cure="give a derivatives.json", file=file) from None
    try:
        data = json.loads(text)
        if not isinstance(data, dict):
            raise ReadError("this is not a derivative set", cure="give a derivatives.json")
        return set_from_dict(data)
    except json.JSONDecodeError as error:
        raise ReadError(
            f"not JSON: {error.msg}", cure="give a derivatives.json", file=file, place=f"line {error.lineno}"
        ) from None
    except ReadError as error:
        raise ReadError(error.cause, cure=error.cure, file=file) from None
    except TowtankError as error:
        raise type(error)(error.cause, cure=error.cure, file=file) from None
