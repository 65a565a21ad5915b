"""Readers and writers of run files: any laboratory's table to channels in SI.

``read_table`` reads text, spreadsheets, MATLAB, HDF5 and TDMS files into a :class:`RawTable`; a
:class:`ChannelMap` turns it into a :class:`towtank.core.record.Record`. Nothing here knows the physics of ships.
Libraries of a format are imported when a file of it is read.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .channels import Channel, ChannelMap, rotate_to_model
    from .condition import read_condition
    from .delimited import Dialect, read_delimited, sniff
    from .hdf5 import read_hdf5
    from .matlab import read_matlab
    from .raw_table import RawTable
    from .read import FORMATS, read_table
    from .simman import SIMMAN_CHANNELS, read_simman, write_simman
    from .spreadsheet import read_spreadsheet
    from .stream import iter_records
    from .tdms import read_tdms
    from .write import atomic_path, write_table

_HOMES = {
    "Channel": "channels",
    "ChannelMap": "channels",
    "Dialect": "delimited",
    "FORMATS": "read",
    "RawTable": "raw_table",
    "SIMMAN_CHANNELS": "simman",
    "atomic_path": "write",
    "iter_records": "stream",
    "read_condition": "condition",
    "read_delimited": "delimited",
    "read_hdf5": "hdf5",
    "read_matlab": "matlab",
    "read_simman": "simman",
    "read_spreadsheet": "spreadsheet",
    "read_table": "read",
    "read_tdms": "tdms",
    "rotate_to_model": "channels",
    "sniff": "delimited",
    "write_simman": "simman",
    "write_table": "write",
}

__all__ = [
    "FORMATS",
    "SIMMAN_CHANNELS",
    "Channel",
    "ChannelMap",
    "Dialect",
    "RawTable",
    "atomic_path",
    "iter_records",
    "read_condition",
    "read_delimited",
    "read_hdf5",
    "read_matlab",
    "read_simman",
    "read_spreadsheet",
    "read_table",
    "read_tdms",
    "rotate_to_model",
    "sniff",
    "write_simman",
    "write_table",
]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
