"""HDF5 files: data sets of a group, compound data sets, and matrices with named columns."""

from __future__ import annotations

import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..core.errors import ReadError
from .named_arrays import NamedArray, as_entry, as_texts, assemble
from .raw_table import RawTable
from .source_file import SourceFile

_UNIT_ATTRIBUTES = ("units", "unit", "Units", "Unit")
_NAME_ATTRIBUTES = ("columns", "names", "labels", "Columns", "Names")


def read_hdf5(path: str | Path, group: str | None = None, columns: Iterable[str | int] | None = None) -> RawTable:
    """Read the data sets of one group of an HDF5 file.

    Vectors are columns under the name of the data set; the fields of a compound data set are columns; a matrix
    takes the names of its columns from its attribute ``columns`` and else ``name_1``, ``name_2``, ... Units come
    from the attribute ``units`` or ``unit``, one or one for each column. Attributes of the file and the group, and
    single numbers, become metadata.

    Parameters
    ----------
    path : str or Path
        The file.
    group : str, optional
        Path of the group or of one data set; default the only group that holds arrays.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to keep; default all.

    Raises
    ------
    ReadError
        If the file is damaged, has no such group, or has several and none is named.
    """
    return parse_hdf5(SourceFile.read(path), group, columns)


def parse_hdf5(
    source: SourceFile, group: str | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read an HDF5 file from bytes in memory; see :func:`read_hdf5`."""
    import h5py

    try:
        with h5py.File(io.BytesIO(source.data), "r") as file:
            node = _node(file, group, source.path)
            metadata = _attributes(file) | _attributes(node)
            if isinstance(node, h5py.Dataset):
                datasets = {node.name.rsplit("/", 1)[-1]: node}
            else:
                datasets = {name: one for name, one in node.items() if isinstance(one, h5py.Dataset)}
            arrays: list[NamedArray] = []
            for name, dataset in datasets.items():
                entry = as_entry(dataset[()]) if not dataset.shape and not dataset.dtype.names else None
                if isinstance(entry, str):
                    metadata[name] = entry
                else:
                    arrays += _arrays(name, dataset)
    except (OSError, RuntimeError) as error:
        raise ReadError(
            f"is no readable HDF5 file ({error})",
            cure="close it in the other program and export it again",
            file=source.path,
        ) from error
    return assemble(arrays, source, wanted=columns, metadata=metadata)


def _node(file: Any, group: str | None, path: str) -> Any:
    """The group to read."""
    import h5py

    holders: list[str] = []

    def note(name: str, one: Any) -> None:
        if isinstance(one, h5py.Dataset) and (one.shape or one.dtype.names):
            holder = "/" + name.rpartition("/")[0]
            if holder not in holders:
                holders.append(holder)

    file.visititems(note)
    if group is not None:
        if group in file:
            return file[group]
        raise ReadError(
            f"there is no group '{group}'", cure=f"the groups with arrays are {', '.join(holders)}", file=path
        )
    if len(holders) > 1 and "/" not in holders:
        raise ReadError(
            f"there are {len(holders)} groups with arrays",
            cure=f"name one of {', '.join(holders)}",
            file=path,
        )
    return file if "/" in holders or not holders else file[holders[0]]


def _arrays(name: str, dataset: Any) -> list[NamedArray]:
    units = _listed(dataset, _UNIT_ATTRIBUTES)
    values = dataset[()]
    fields = dataset.dtype.names
    if fields:
        one_each = len(units) == len(fields)
        return [
            NamedArray(field, values[field], units=units[place : place + 1] if one_each else units[:1])
            for place, field in enumerate(fields)
        ]
    return [NamedArray(name, values, _listed(dataset, _NAME_ATTRIBUTES), units)]


def _listed(dataset: Any, attributes: tuple[str, ...]) -> list[str]:
    return next((as_texts(dataset.attrs[one]) for one in attributes if one in dataset.attrs), [])


def _attributes(node: Any) -> dict[str, str | float]:
    entries = {name: as_entry(value) for name, value in node.attrs.items()}
    return {name: value for name, value in entries.items() if value is not None}
