"""MATLAB files: version 5 (and 4) through scipy, version 7.3 through h5py."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import ReadError
from .named_arrays import NamedArray, as_entry, as_texts, assemble
from .raw_table import RawTable
from .source_file import SourceFile

#: Variables, in lower case, that hold the names or units of the columns of a matrix beside them.
_NAME_FIELDS = ("names", "columns", "channels", "channelnames", "channel_names", "labels", "varnames", "header")
_UNIT_FIELDS = ("units", "unit")
_V73_MARK = b"MATLAB 7.3 MAT-file"


def read_matlab(
    path: str | Path, group: str | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read the arrays of a ``.mat`` file.

    Vectors, row or column, are columns of the table; the fields of a struct are named with their path
    (``run.balance.Fx``). The columns of a matrix take their names from a cell array of texts beside it (``names``,
    ``columns``, ``channels``, ``labels``, ...) and else are called ``name_1``, ``name_2``, ... Units come from a
    struct ``units`` with the same fields, from a cell array ``units`` in the order of the names, or from one text
    for all.

    Parameters
    ----------
    path : str or Path
        The file.
    group : str, optional
        Read only this struct, given as a path with dots; its fields are then named without it.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to keep; default all.

    Raises
    ------
    ReadError
        If the file is damaged, has no such struct, or holds no arrays of numbers (tables and timeseries objects
        cannot be read outside MATLAB).
    """
    return parse_matlab(SourceFile.read(path), group, columns)


def parse_matlab(
    source: SourceFile, group: str | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read a MATLAB file from bytes in memory; see :func:`read_matlab`."""
    tree, has_objects = _v73_tree(source) if source.data.startswith(_V73_MARK) else _v5_tree(source)
    for part in group.split(".") if group else ():
        if not isinstance(tree.get(part), dict):
            structs = [name for name, value in tree.items() if isinstance(value, dict)]
            raise ReadError(
                f"there is no struct '{group}'",
                cure=f"the structs are {', '.join(structs)}" if structs else "the file has no structs",
                file=source.path,
            )
        tree = tree[part]
    metadata: dict[str, str | float] = {}
    arrays = list(_arrays(tree, "", metadata))
    if has_objects and not any(array.values.dtype.kind in "fiub" for array in arrays):
        raise ReadError(
            "holds MATLAB objects (a table or timeseries), which only MATLAB can read",
            cure="save them as a struct of vectors: s = table2struct(t, 'ToScalar', true)",
            file=source.path,
        )
    return assemble(arrays, source, wanted=columns, metadata=metadata)


def _arrays(
    tree: Mapping[str, Any], prefix: str, metadata: dict[str, str | float], units: Any = None
) -> Iterator[NamedArray]:
    """Arrays of a tree of structs; texts are put into `metadata`."""
    fields = {name.lower(): name for name in tree}
    names_field = next((fields[one] for one in _NAME_FIELDS if one in fields and as_texts(tree[fields[one]])), "")
    units_field = next((fields[one] for one in _UNIT_FIELDS if one in fields and _is_units(tree[fields[one]])), "")
    names = as_texts(tree[names_field]) if names_field else []
    units = tree[units_field] if units_field else units
    listed = as_texts(units)
    by_name = (
        units if isinstance(units, Mapping) else dict(zip(names, listed)) if len(names) == len(listed) else {}
    )
    for name, value in tree.items():
        if name in (names_field, units_field):
            continue
        if isinstance(value, Mapping):
            yield from _arrays(value, f"{prefix}{name}.", metadata, by_name.get(name))
            continue
        texts = as_texts(value)
        if texts:
            metadata[prefix + name] = ", ".join(texts)
        elif isinstance(value, np.ndarray) or as_entry(value) is not None:
            array = np.asarray(value)
            # The order of variables in a file is not the order of a list: vectors take units by name only.
            is_matrix = array.ndim == 2 and 1 not in array.shape
            own = listed if is_matrix or len(listed) == 1 else as_texts(by_name.get(name))
            yield NamedArray(prefix + name, array, names if is_matrix else (), own)


def _is_units(value: Any) -> bool:
    if isinstance(value, Mapping):
        return all(_is_units(one) for one in value.values())
    return bool(as_texts(value))


def _v5_tree(source: SourceFile) -> tuple[dict[str, Any], bool]:
    """Variables, and whether there are MATLAB objects among them."""
    from scipy.io import loadmat

    try:
        tree = loadmat(io.BytesIO(source.data), simplify_cells=True)  # type: ignore[arg-type]
    # scipy raises errors of many kinds for a file that ends too early.
    except Exception as error:
        raise ReadError(
            f"is no readable MATLAB file ({error})", cure="save it again with save -v7", file=source.path
        ) from error
    has_objects = "__function_workspace__" in tree
    return {name: value for name, value in tree.items() if not name.startswith("__")}, has_objects


def _v73_tree(source: SourceFile) -> tuple[dict[str, Any], bool]:
    """Variables, and whether there are MATLAB objects among them."""
    import h5py

    try:
        with h5py.File(io.BytesIO(source.data), "r") as file:
            tree = {name: _v73_value(file[name], file) for name in file if not name.startswith("#")}
            return tree, "#subsystem#" in file
    except (OSError, RuntimeError, KeyError) as error:
        raise ReadError(
            f"is no readable MATLAB 7.3 file ({error})", cure="save it again with save -v7.3", file=source.path
        ) from error


def _fields(struct: Any) -> list[str]:
    """Fields in their order in MATLAB; HDF5 lists them by the alphabet."""
    ordered = ["".join(map(bytes.decode, letters)) for letters in struct.attrs.get("MATLAB_fields", [])]
    return ordered if set(ordered) == set(struct) else list(struct)


def _v73_value(node: Any, file: Any) -> Any:
    import h5py

    if isinstance(node, h5py.Group):
        return {name: _v73_value(node[name], file) for name in _fields(node)}
    kind = node.attrs.get("MATLAB_class", b"")
    kind = kind.decode() if isinstance(kind, bytes) else str(kind)
    if node.attrs.get("MATLAB_empty", 0):
        return "" if kind == "char" else np.empty(0)
    values = node[()]
    if kind == "char":
        # One text a column, since HDF5 stores the transpose of what MATLAB shows.
        texts = ["".join(map(chr, column)).strip() for column in np.atleast_2d(values).T]
        return texts[0] if len(texts) == 1 else texts
    if values.dtype == object:
        return [_v73_value(file[reference], file) for reference in np.ravel(values)]
    return np.asarray(values).T
