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
    from .growing_log import GrowingLog
    from .hdf5 import read_hdf5
    from .log_blocks import LogBlocks
    from .log_files import iter_solver_log, read_log_blocks
    from .matlab import read_matlab
    from .raw_table import RawTable
    from .read import FORMATS, read_table
    from .simman import SIMMAN_CHANNELS, read_simman, write_simman
    from .solver_case import read_solver_case, read_solver_log
    from .solver_log import EmptyLogError, LogKind, Restart, SolverCase, SolverLog
    from .spreadsheet import read_spreadsheet
    from .stream import iter_records
    from .tdms import read_tdms
    from .write import atomic_path, write_table

_HOMES = {
    "Channel": "channels",
    "ChannelMap": "channels",
    "Dialect": "delimited",
    "FORMATS": "read",
    "EmptyLogError": "solver_log",
    "GrowingLog": "growing_log",
    "LogBlocks": "log_blocks",
    "LogKind": "solver_log",
    "RawTable": "raw_table",
    "Restart": "solver_log",
    "SIMMAN_CHANNELS": "simman",
    "SolverCase": "solver_log",
    "SolverLog": "solver_log",
    "atomic_path": "write",
    "iter_records": "stream",
    "iter_solver_log": "log_files",
    "read_condition": "condition",
    "read_delimited": "delimited",
    "read_hdf5": "hdf5",
    "read_log_blocks": "log_files",
    "read_matlab": "matlab",
    "read_simman": "simman",
    "read_solver_case": "solver_case",
    "read_solver_log": "solver_case",
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
    "EmptyLogError",
    "GrowingLog",
    "LogBlocks",
    "LogKind",
    "RawTable",
    "Restart",
    "SolverCase",
    "SolverLog",
    "atomic_path",
    "iter_records",
    "iter_solver_log",
    "read_condition",
    "read_delimited",
    "read_hdf5",
    "read_log_blocks",
    "read_matlab",
    "read_simman",
    "read_solver_case",
    "read_solver_log",
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
