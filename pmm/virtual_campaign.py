"""Virtual campaigns as folders: run files, test matrix, campaign file, and the set that a fit should find."""

from __future__ import annotations

import json
import math
import os
import re
import secrets
import shutil
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..core.conventions import HOME
from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, TermError
from ..core.hull_models import HULL_MODELS, hull_model
from ..core.provenance import program_versions
from ..core.record import Record
from ..core.ship import Ship
from ..core.terms import Term, parse_terms
from ..formats.simman import SIMMAN_UNITS, write_simman
from ..formats.write import write_table
from .laboratory import STANDARD_LABORATORY, Laboratory
from .noise import SILENT, Noise, reference_forces
from .run_types import Run
from .standard_matrices import matrix_frame
from .virtual_records import (
    UNITS,
    ZERO_RUN,
    VirtualRun,
    excited_terms,
    require_names,
    sets_by_depth,
    synthesize_records,
    virtual_run,
    zero_run,
)

__all__ = ["CAMPAIGN_FILE", "FORMATS", "campaign_text", "synthesize", "synthesize_records"]

CAMPAIGN_FILE = "campaign.toml"

FORMATS: dict[str, str] = {"text": ".txt", "csv": ".csv", "simman": ".simman"}
"""Formats of run files, with the ending of each."""

_ACCELERATIONS = ("udot", "vdot", "rdot")


def synthesize(
    derivatives: DerivativeSet | Mapping[float, DerivativeSet],
    runs: Sequence[Run],
    folder: str | Path,
    *,
    name: str,
    noise: Noise = SILENT,
    laboratory: Laboratory = STANDARD_LABORATORY,
    fmt: str = "text",
    fit_terms: str | Sequence[str | Term] | None = None,
    reference: Mapping[str, float] | None = None,
    digits: int | None = None,
    overwrite: bool = False,
    progress: Callable[[str, int, int], None] | None = None,
) -> Path:
    """Write a virtual campaign: one file a run, test matrix, campaign file, and the set that made it.

    The folder appears when everything is written; an interrupted run leaves nothing behind.

    Parameters
    ----------
    derivatives : DerivativeSet, or mapping of float to DerivativeSet
        The set, or one set for each water depth in m.
    runs : sequence of Run
    folder : str or Path
        Where the campaign goes.
    name : str
        Name of the campaign.
    noise : Noise
    laboratory : Laboratory
        Axes, signs, sampling, transients, inertia and zero of the balance.
    fmt : {"text", "csv", "simman"}
        Tab-separated or comma-separated tables with a row of units, or the SIMMAN form with a condition file.
    fit_terms : str or sequence, optional
        Hull model or terms that the campaign file asks for; those of the set that the runs excite when not
        given.
    reference : mapping of str to float, optional
        Reference forces of the noise in N and Nm; the largest force of each channel when not given.
    digits : int, optional
        Significant digits of what is written; as many as the numbers have when not given.
    overwrite : bool
        Replace the virtual campaign that is in `folder`.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    Path
        The campaign file.

    Raises
    ------
    CampaignError
        For a folder that is not empty, a wrong format, two runs of one name, or a depth without a set.
    TermError, ConventionError
        When the set cannot be evaluated on the runs.
    """
    if fmt not in FORMATS:
        raise CampaignError(f"'{fmt}' is not a format of run files", cure=f"use one of {', '.join(FORMATS)}")
    require_names(runs)
    sets = sets_by_depth(derivatives)
    if fit_terms is None:
        fit_terms = excited_terms(sets, runs, laboratory)
        if not fit_terms:
            raise CampaignError("no run excites a term of the set", cure="give runs that vary its variables")
    terms = _fit_section(fit_terms)
    if reference is None:
        wet = [run for run in runs if not run.dry] or runs
        reference = reference_forces(virtual_run(sets, run, laboratory).forces for run in wet)
    target = Path(folder)
    with _new_folder(target, overwrite) as place:
        (place / "runs").mkdir()
        files = _file_names(runs, FORMATS[fmt])
        for number, (run, file) in enumerate(zip(runs, files, strict=True)):
            clean = virtual_run(sets, run, laboratory)
            _write_run(clean, run, place / file, fmt, noise, reference, digits)
            if progress:
                progress("writing runs", number + 1, len(runs))
        ship = next(iter(sets.values())).ship
        tare = ""
        if laboratory.balance_zero:
            tare = f"runs/{ZERO_RUN}{FORMATS[fmt]}"
            still = zero_run(ship, laboratory, clean.forces)
            _write_run(still, None, place / tare, fmt, noise, reference, digits)
        matrix = matrix_frame(runs, laboratory.conventions)
        matrix.insert(1, "file", files)
        matrix.to_csv(place / "matrix.csv", index=False)
        channels = [*clean.forces, *(["speed"] if laboratory.ramp else [])]
        sections = {
            "campaign": {
                "name": name,
                "source": _source(sets),
                "virtual": True,
                "notes": _notes(runs, noise, reference, laboratory),
            },
            "ship": ship.to_dict(),
            "conventions": {key: ours for key, (ours, _) in laboratory.conventions.differences(HOME).items()},
            "channels": _channel_section(channels, fmt, laboratory),
            "reader": {"format": "simman"} if fmt == "simman" else {},
            "inertia": _inertia_section(runs, laboratory),
            "reduction": _reduction_section(sets, laboratory, ship),
            "fit": terms,
        }
        group = {"matrix": "matrix.csv"} | ({"tare": tare} if tare else {})
        (place / CAMPAIGN_FILE).write_text(campaign_text(sections, [group]), encoding="utf-8")
        for depth, one in sets.items():
            one.to_json(place / ("truth.json" if depth is None else f"truth at depth {depth:g} m.json"))
    return target / CAMPAIGN_FILE


def campaign_text(sections: Mapping[str, Mapping[str, Any]], groups: Sequence[Mapping[str, Any]]) -> str:
    """Text of a campaign file: its sections, empty ones left out, and one ``[[runs]]`` for each of `groups`."""
    blocks = [(f"[{title}]", values) for title, values in sections.items() if values]
    blocks += [("[[runs]]", values) for values in groups]
    return (
        "\n\n".join(
            "\n".join([title, *(f"{_key(key)} = {_toml(value)}" for key, value in values.items())])
            for title, values in blocks
        )
        + "\n"
    )


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    return repr(value)


@contextmanager
def _new_folder(target: Path, overwrite: bool) -> Iterator[Path]:
    """A temporary folder beside `target` that takes its place when the block ends without an error."""
    if target.exists() and not target.is_dir():
        raise CampaignError("this is a file", cure="give a folder", file=target)
    occupied = target.is_dir() and any(target.iterdir())
    if occupied and not overwrite:
        raise CampaignError("the folder is not empty", cure="give a new folder, or ask to overwrite", file=target)
    if occupied and not _holds_virtual_campaign(target):
        raise CampaignError(
            "the folder holds something else than a virtual campaign", cure="give another folder", file=target
        )
    target.parent.mkdir(parents=True, exist_ok=True)
    stamp = secrets.token_hex(4)
    temporary = target.with_name(f".{target.name}.{stamp}")
    temporary.mkdir()
    try:
        yield temporary
        if occupied:
            old = target.with_name(f".{target.name}.{stamp}.old")
            os.replace(target, old)
            os.replace(temporary, target)
            shutil.rmtree(old)
        else:
            os.replace(temporary, target)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _holds_virtual_campaign(folder: Path) -> bool:
    try:
        data = tomllib.loads((folder / CAMPAIGN_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return data.get("campaign", {}).get("virtual") is True


def _file_names(runs: Sequence[Run], ending: str) -> list[str]:
    width = len(str(len(runs)))
    plain = [re.sub(r"[^A-Za-z0-9.+-]+", "_", run.name).strip("_.") for run in runs]
    return [f"runs/{number:0{width}d}_{text}{ending}" for number, text in enumerate(plain, start=1)]


def _write_run(
    clean: VirtualRun,
    run: Run | None,
    path: Path,
    fmt: str,
    noise: Noise,
    reference: Mapping[str, float],
    digits: int | None,
) -> None:
    record = clean.record(noise, reference)
    if digits is not None:
        rounded = {channel: _significant(values, digits) for channel, values in record.channels.items()}
        record = Record({**rounded, "time": record.time}, record.units, record.source)
    if fmt == "simman":
        write_simman(record, path, _condition(clean.ship, run))
        return
    degrees = clean.laboratory.conventions.angle_unit == "deg"
    columns, units = {}, {}
    for channel, values in record.channels.items():
        if channel in _ACCELERATIONS:
            continue
        unit = UNITS[channel]
        if degrees and unit.startswith("rad"):
            values, unit = np.degrees(values), unit.replace("rad", "deg")
        # No "-0" where a sign was turned.
        columns[channel], units[channel] = values + 0.0, unit
    header = [f"virtual data, generated by towtank {program_versions()['towtank']}: not measured", clean.name]
    write_table(path, columns, units, delimiter="," if fmt == "csv" else "\t", header=header)


def _significant(values: np.ndarray, digits: int) -> np.ndarray:
    """Values rounded to `digits` significant digits of the largest."""
    largest = float(np.abs(values).max(initial=0.0))
    return values if largest == 0.0 else np.round(values, digits - 1 - math.floor(math.log10(largest)))


def _condition(ship: Ship, run: Run | None) -> dict[str, str | float]:
    known = {
        "Lpp": ship.L,
        "B": ship.B,
        "T": ship.T,
        "mass": ship.displacement_mass,
        "Izz": ship.yaw_inertia,
        "xG": ship.xG,
        "rho": ship.rho,
        "U": None if run is None else run.speed,
    }
    return {key: value for key, value in known.items() if value is not None}


def _fit_section(wanted: str | Sequence[str | Term]) -> dict[str, Any]:
    if isinstance(wanted, str):
        if wanted not in HULL_MODELS:
            raise TermError(f"unknown hull model '{wanted}'", cure=f"use one of {', '.join(HULL_MODELS)}")
        return {"model": wanted}
    terms = parse_terms(wanted)
    for model in HULL_MODELS:
        if terms == hull_model(model):
            return {"model": model}
    names = []
    for term in terms:
        spelled = term if Term.parse(term.name) == term else Term.spell(term.component, term.factors)
        names.append(spelled.name)
    return {"terms": names}


def _source(sets: Mapping[float | None, DerivativeSet]) -> str:
    texts = []
    for one in sets.values():
        origin = one.provenance.source
        texts.append(f"computed from the derivative set '{one.name}'" + (f" ({origin})" if origin else ""))
    return "; ".join(dict.fromkeys(texts))


def _notes(runs: Sequence[Run], noise: Noise, reference: Mapping[str, float], laboratory: Laboratory) -> str:
    sizes = {"white": noise.white, "ar1": noise.ar1, "drift": noise.drift, "offset": noise.offset}
    sizes |= {"quantum": noise.quantum, "gain_bias": noise.gain_bias}
    said = ", ".join(f"{key} {value:g}" for key, value in sizes.items() if value)
    if noise.ar1:
        said += f", rho {noise.rho:g} between samples"
    scale = ", ".join(f"{name} {value:.6g}" for name, value in reference.items())
    text = f"Virtual data of {len(runs)} runs: computed, not measured. "
    text += f"Noise as share of {scale} (N, N m): {said}; seed {noise.seed}." if said else "No noise."
    if laboratory.inertia is not None:
        text += f" Inertia in the forces: {laboratory.inertia.describe()}."
    return text


def _channel_section(channels: Sequence[str], fmt: str, laboratory: Laboratory) -> dict[str, Any]:
    if fmt == "simman":
        units = {("time" if column == "Time" else column): unit for column, unit in SIMMAN_UNITS.items()}
        return {name: {"column": "Time" if name == "time" else name, "unit": unit} for name, unit in units.items()}
    turn = laboratory.conventions.angle_unit
    names = ["time", *channels, "x", "y", "psi", "u", "v", "r"]
    return {name: {"column": name, "unit": UNITS[name].replace("rad", turn)} for name in names}


def _inertia_section(runs: Sequence[Run], laboratory: Laboratory) -> dict[str, Any]:
    body = laboratory.inertia
    if body is None:
        return {}
    if any(run.dry for run in runs):
        return {"inside": True, "dry_runs": True}
    return {"inside": True, "mass": body.mass, "xG": body.xG, "Izz": body.Izz}


def _reduction_section(
    sets: Mapping[float | None, DerivativeSet], laboratory: Laboratory, ship: Ship
) -> dict[str, Any]:
    scales = {one.conventions.velocity_scale for one in sets.values()}
    if len(scales) > 1:
        raise CampaignError("the sets are scaled with different speeds", cure="convert one of them")
    return {
        "skip_cycles": laboratory.startup_cycles,
        "position_x": laboratory.path_point(ship),
        "moment_x": laboratory.moment_point(ship),
        "nondimensional_speed": scales.pop(),
    }
