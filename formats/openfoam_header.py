"""Headers of OpenFOAM's postProcessing files to columns.

The function objects of the .com and the .org line and their versions differ in file names, labels, parentheses and
order. All of them print ``#`` comments, the last of which labels the columns, and rows of numbers and nested ``( )``
groups. So a file is understood from the labels together with the groups of its first row.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from ..core.errors import ReadError
from .log_layout import LogLayout
from .number_text import is_number
from .solver_log import EmptyLogError, LogKind, Point

_PARTS = ("total", "pressure", "viscous", "porous")
_AXES = ("x", "y", "z")
_COMPONENTS = {
    3: _AXES,
    6: ("xx", "xy", "xz", "yy", "yz", "zz"),
    9: ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"),
}
_ENTRY = re.compile(r"^(?P<key>[^:()]*?\S)\s*:\s*(?P<value>.*\S)\s*$")
_PROBE = re.compile(r"^(?:Probe|Location)\s+(\d+)\s*:?\s*\(\s*(\S+)\s+(\S+)\s+(\S+?)\s*\)(.*)$")
_RUN_SUFFIX = re.compile(r"_[0-9][0-9.eE+-]*$")

#: File names (without ending and without the time that a second run appends) of each kind.
_STEMS: dict[str, LogKind] = {
    **dict.fromkeys(("force", "moment", "forces"), "forces"),
    **dict.fromkeys(("coefficient", "coefficients", "forceCoeffs"), "coefficients"),
    **dict.fromkeys(("sixDoFRigidBodyState", "rigidBodyState"), "motion"),
    **dict.fromkeys(("height", "position", "surfaceElevation"), "surface"),
    **dict.fromkeys(("residuals", "solverInfo"), "residuals"),
}
_TITLES: tuple[tuple[str, LogKind], ...] = (
    ("force coefficients", "coefficients"),
    ("motion state", "motion"),
    ("residuals", "residuals"),
    ("solver information", "residuals"),
)
_MOTION_NAMES = {"omega": "angular_velocity", "linear_velocity": "velocity", "center_of_mass": "centre_of_mass"}
_OUTSIDE = "the point lies outside the mesh"


def stem_of(path: Path) -> str:
    """Name of a postProcessing file without ``.dat`` and without the time that a second run appends to it."""
    stem = path.name.removesuffix(".dat").removesuffix(".xy")
    return _RUN_SUFFIX.sub("", stem)


def openfoam_layout(head: bytes, path: Path) -> LogLayout | None:
    """Columns of a file written by a function object of OpenFOAM; None if it is no such file.

    Parameters
    ----------
    head : bytes
        The beginning of the file, with at least its first row if it has one.
    path : Path
        The file; its name tells forces from moments and names the field of probes.

    Raises
    ------
    ReadError
        If it is such a file and has no rows, or its columns cannot be told.
    """
    stem = stem_of(path)
    lines, starts = _lines(head)
    comments = _leading_comments(lines)
    gauges = not comments and bool(lines) and lines[0].split()[:1] == ["Time"] and "gauge" in stem + lines[0]
    if gauges:
        return _gauge_layout(lines, starts, path)
    labels = _labels(comments)
    if not comments or not (labels[:1] == ["Time"] or stem in _STEMS or "Probe 0" in comments[0]):
        return None
    data = next((i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")), None)
    if data is None:
        raise EmptyLogError(
            "there are no data rows", cure="the file holds a header only: the run wrote nothing", file=path
        )
    cells = _cells(lines[data])
    header, points = _entries(comments)
    title = comments[0].strip()
    if title and ":" not in title and not title.startswith(("Time", "Probe")):
        header = {"title": title, **header}
    kind = _kind(stem, title.lower(), labels, points)
    label_line = next((line for line in reversed(comments) if line.strip().startswith("Time")), "")
    notes: list[str] = []
    if "bins" in header or stem.endswith("Bin"):
        raise ReadError(
            "holds forces by bins along the body, not a history",
            cure="name the force or forces file beside it",
            file=path,
        )
    if kind == "forces":
        names = _force_names(label_line, cells, stem, path, notes)
    elif points and kind in ("probes", "surface"):
        names, points = _point_names(kind, stem, path, cells, points)
    else:
        names = _names(kind, stem, labels, cells, notes)
    if kind == "probes" and any(_OUTSIDE in header.get(f"Probe {i}", "") for i in range(len(points))):
        notes.append("some probes were not found in the mesh")
    return LogLayout(
        dialect="OpenFOAM",
        kind=kind,
        names=names,
        units=_units(kind, names, header),
        first_byte=starts[data],
        header=header,
        points=points,
        notes=tuple(notes),
    )


def _lines(head: bytes) -> tuple[list[str], list[int]]:
    """Whole lines of `head` and where each begins."""
    lines: list[str] = []
    starts: list[int] = []
    at = 0
    for line in head.splitlines(keepends=True):
        if line.endswith((b"\n", b"\r")):
            lines.append(line.decode("utf-8", errors="replace").rstrip("\r\n"))
            starts.append(at)
        at += len(line)
    return lines, starts


def _leading_comments(lines: Sequence[str]) -> list[str]:
    comments = []
    for line in lines:
        if line.lstrip().startswith("#"):
            comments.append(line.lstrip()[1:])
        elif line.strip():
            break
    return comments


def _labels(comments: Sequence[str]) -> list[str]:
    """Labels of the columns; empty if no comment begins with ``Time``."""
    line = next((line for line in reversed(comments) if line.strip().startswith("Time")), "").strip()
    if "\t" in line:
        return [label for label in (piece.strip() for piece in line.split("\t")) if label]
    return re.findall(r"[^\s()]*\([^()]*\)|[^\s()]+", line)


def _cells(line: str) -> list[list[str]]:
    """Numbers and words of a row, those of a parenthesised group together."""
    cells: list[list[str]] = []
    depth = 0
    for token in re.findall(r"[()]|[^\s()]+", line):
        if token == "(":
            depth += 1
            if depth == 1:
                cells.append([])
        elif token == ")":
            depth -= 1
        elif depth:
            cells[-1].append(token)
        else:
            cells.append([token])
    return [cell for cell in cells if cell]


def _entries(comments: Sequence[str]) -> tuple[dict[str, str], dict[str, Point]]:
    header: dict[str, str] = {}
    points: dict[str, Point] = {}
    for line in map(str.strip, comments):
        probe = _PROBE.match(line)
        entry = _ENTRY.match(line)
        if probe:
            points[probe[1]] = (float(probe[2]), float(probe[3]), float(probe[4]))
            if "Not Found" in probe[5]:
                header[f"Probe {probe[1]}"] = _OUTSIDE
        elif entry:
            header[entry["key"]] = entry["value"]
    return header, points


def _kind(stem: str, title: str, labels: Sequence[str], points: dict[str, Point]) -> LogKind:
    joined = " ".join(labels)
    if re.search(r"\bforces?\s*\(|total_x", joined):
        return "forces"
    for words, kind in _TITLES:
        if title.startswith(words):
            return kind
    if stem in _STEMS:
        return _STEMS[stem]
    if "hB" in labels:
        return "surface"
    return "probes" if points else "monitor"


def _force_names(
    label_line: str, cells: Sequence[Sequence[str]], stem: str, path: Path, notes: list[str]
) -> tuple[str, ...]:
    """``time`` and components of forces and moments, as in ``Fx_pressure`` and ``Mz_viscous``."""
    count = sum(map(len, cells)) - 1
    flat = re.findall(r"\b(total|pressure|viscous|porous|internal)_x", label_line)
    groups: list[tuple[str, list[str]]]
    if flat or stem in ("force", "moment"):
        letter = "M" if stem == "moment" or "moment" in label_line.lower() else "F"
        parts = ["porous" if part == "internal" else part for part in flat]
        if 3 * len(parts) != count:
            parts = list(_PARTS[: count // 3])
        groups = [(letter, parts)]
        if stem in ("force", "moment") and not flat and count in (12, 18) and "(" in label_line:
            groups = _nested_groups(label_line, count)
    else:
        groups = _nested_groups(label_line, count)
    names = [f"{letter}{axis}_{part}" for letter, parts in groups for part in parts for axis in _AXES]
    if len(names) != count or len(cells[0]) != 1:
        raise ReadError(
            f"the rows have {count} values behind the time, which are no vectors of total, pressure, viscous and "
            "porous forces",
            cure="write the file with the function object 'forces', or map its columns by a channel map",
            file=path,
        )
    kept = {part for _, parts in groups for part in parts}
    if "internal" in flat:
        notes.append("the part that the solver calls internal is named porous")
    if "viscous" not in kept:
        notes.append("the file has no viscous part" + ("" if "pressure" in kept else " and no pressure part"))
    return ("time", *names)


def _nested_groups(label_line: str, count: int) -> list[tuple[str, list[str]]]:
    """Parts of forces and of moments in a row ``((pressure) (viscous) (porous)) ((pressure) ...)``."""
    before, _, behind = label_line.partition("moment")
    found = [re.findall(r"pressure|viscous|porous", text) for text in (before, behind)]
    if 3 * (len(found[0]) + len(found[1])) != count or len(found[0]) != len(found[1]):
        # The header of some versions leaves the parts out; a row of six vectors or so can mean one thing only.
        found = [list(_PARTS[1 : 1 + count // 6])] * 2
    return [("F", found[0]), ("M", found[1])]


def _point_names(
    kind: str, stem: str, path: Path, cells: Sequence[Sequence[str]], points: dict[str, Point]
) -> tuple[tuple[str, ...], dict[str, Point]]:
    """Columns of probes (``U_0_x``), gauges (``hB_0``, ``hL_0``) and positions of the surface (``p_0_x``)."""
    values = [len(cell) for cell in cells[1:]]
    order = list(points)
    if kind == "surface" and stem == "height" and len(values) == 2 * len(order):
        columns = [f"{what}_{number}" for number in order for what in ("hB", "hL")]
        return ("time", *columns), {name: points[name.split("_")[1]] for name in columns}
    field = "p" if kind == "surface" else path.name
    if len(values) != len(order):
        raise ReadError(
            f"the header lists {len(order)} points and the rows have {len(values)} values",
            cure="the run was cut off while it wrote the header, or two files were joined",
            file=path,
        )
    names = ["time"]
    for number, size in zip(order, values):
        names += _expand(f"{field}_{number}", size)
    return tuple(names), {f"{field}_{number}": point for number, point in points.items()}


def _expand(label: str, size: int) -> list[str]:
    """Names of the numbers of one cell."""
    if size == 1:
        return [label]
    inner = re.fullmatch(r"\((.*)\)", label)
    if inner and len(inner[1].split()) == size:
        return inner[1].split()
    return [f"{label}_{axis}" for axis in _COMPONENTS.get(size, tuple(map(str, range(size))))]


def _names(
    kind: str, stem: str, labels: Sequence[str], cells: Sequence[Sequence[str]], notes: list[str]
) -> tuple[str, ...]:
    if len(labels) != len(cells):
        # Labels of two words between blanks, or groups whose components are labelled one by one.
        apart = " ".join(labels).replace("(", " ").replace(")", " ").split()
        flat = [token for cell in cells for token in cell]
        if len(apart) == len(flat):
            labels, cells = apart, [[token] for token in flat]
        elif kind == "surface" and len(cells) % 2:
            pairs = [f"{what}_{i}" for i in range(len(cells) // 2) for what in ("hB", "hL")]
            labels = ["Time", *pairs]
        else:
            notes.append(f"the header labels {len(labels)} of {len(cells)} columns; they are numbered")
            labels = ["Time", *(f"column_{i}" for i in range(2, len(cells) + 1))]
    if kind == "motion":
        labels = [_motion_name(label) for label in labels]
    names = ["time"]
    for label, cell in zip(labels[1:], cells[1:]):
        is_text = len(cell) == 1 and not is_number(cell[0])
        names += [""] if is_text else _expand(label, len(cell))
    if kind == "surface" and stem == "height":
        heights = [name for name in names if name in ("hB", "hL")]
        if len(heights) == len(names) - 1:
            names = ["time", *(f"{name}_{i // 2}" for i, name in enumerate(heights))]
    return tuple(names)


def _motion_name(label: str) -> str:
    """``centreOfRotation`` and ``Centre of rotation`` as ``centre_of_rotation``."""
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", label)
    name = "_".join(spaced.lower().split())
    return _MOTION_NAMES.get(name, name)


def _units(kind: str, names: Sequence[str], header: dict[str, str]) -> dict[str, str]:
    angle = "deg" if header.get("Angle Units", "").lower().startswith("deg") else "rad"

    def unit(name: str) -> str:
        if name == "time":
            return "s"
        if kind == "forces":
            return "N" if name.startswith("F") else "N m"
        if kind == "surface":
            return "m"
        if kind in ("coefficients", "residuals"):
            return "-"
        if kind != "motion":
            return ""
        if name.startswith("centre_of"):
            return "m"
        if name.startswith("velocity"):
            return "m/s"
        return f"{angle}/s" if name.startswith("angular") else angle if name.startswith("rotation") else ""

    return {name: unit(name) for name in names if name}


def _gauge_layout(lines: Sequence[str], starts: Sequence[int], path: Path) -> LogLayout:
    """waves2Foam: a line of names, then three rows of coordinates at the times -1, -2 and -3."""
    gauges = lines[0].split()[1:]
    rows = [line.split() for line in lines[1:4]]
    coordinates = [[float(value) for value in row[1:]] for row in rows if len(row) == len(gauges) + 1]
    if len(lines) < 5 or len(coordinates) < 3:
        raise EmptyLogError(
            "there are no data rows", cure="the file holds a header only: the run wrote nothing", file=path
        )
    x, y, z = coordinates
    return LogLayout(
        dialect="OpenFOAM",
        kind="surface",
        names=("time", *gauges),
        units={"time": "s", **dict.fromkeys(gauges, "m")},
        first_byte=starts[4],
        points={name: (x[i], y[i], z[i]) for i, name in enumerate(gauges)},
    )
