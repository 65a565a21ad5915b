"""Where OpenFOAM's function objects put their files: ``postProcessing/<object>/<start time>/<file>``."""

from __future__ import annotations

from pathlib import Path

from .openfoam_header import stem_of

_OTHER_ENDINGS = {
    ".vtk",
    ".vtp",
    ".vtu",
    ".vtm",
    ".obj",
    ".stl",
    ".raw",
    ".png",
    ".eps",
    ".gz",
    ".foam",
    ".gnuplot",
}
_DEPTH = 4


def is_time(name: str) -> bool:
    """Whether a folder is named after a time, as ``0``, ``12.5`` or ``1e-05``."""
    try:
        float(name)
    except ValueError:
        return False
    return name[:1].isdigit()


def post_processing_folder(path: Path) -> Path | None:
    """The folder of the function objects of a case; None if `path` is no OpenFOAM case.

    `path` may be the case, its ``postProcessing`` folder, one object in it, or a case of the versions that wrote the
    objects straight into the case.
    """
    if (path / "postProcessing").is_dir():
        return path / "postProcessing"
    return path if run_files(path) else None


def run_files(folder: Path) -> dict[str, dict[str, list[Path]]]:
    """Files of each function object and each kind of file, oldest run first.

    Returns
    -------
    dict of str to dict of str to list of Path
        ``{"forces": {"force": [.../0/force.dat, .../10/force.dat], "moment": [...]}}``. Objects of a region are named
        ``region/object``.
    """
    found: dict[str, dict[str, list[tuple[float, str, Path]]]] = {}
    for times in _time_folders(folder, _DEPTH):
        name = times.parent.relative_to(folder).as_posix()
        name = folder.name if name == "." else name
        inside = [file for file in sorted(times.iterdir()) if file.is_file()]
        stems = {file.name.removesuffix(".dat") for file in inside}
        for file in inside:
            if file.suffix in _OTHER_ENDINGS or file.name.startswith("."):
                continue
            # A second run from the same time appends it to the name: force.dat, then force_0.dat.
            whole, short = file.name.removesuffix(".dat"), stem_of(file)
            stem = short if short in stems else whole
            found.setdefault(name, {}).setdefault(stem, []).append(
                (float(times.name), file.name[len(stem) :], file)
            )
    return {
        name: {
            stem: [file for _, _, file in sorted(files, key=lambda one: (one[0], len(one[1]), one[1]))]
            for stem, files in sorted(stems.items())
        }
        for name, stems in sorted(found.items())
    }


def _time_folders(folder: Path, depth: int) -> list[Path]:
    """Folders named after a time, below folders that are not; those of the case's own fields are passed over."""
    found: list[Path] = []
    if (folder / "system").is_dir() and (folder / "constant").is_dir():
        children = [child for child in folder.iterdir() if child.is_dir() and not is_time(child.name)]
        children = [child for child in children if child.name not in ("system", "constant") and depth == _DEPTH]
    else:
        children = [child for child in folder.iterdir() if child.is_dir()]
    for child in sorted(children):
        if is_time(child.name):
            found.append(child)
        elif depth > 1 and not child.name.startswith((".", "processor")):
            found += _time_folders(child, depth - 1)
    return found
