"""The compiled kernel: machine code from the disk, else from its lowered form, else by numba from the source.

numba needs half a minute of this kernel's first compilation, most of it before any machine code is made, and a second
to start whenever it is imported. Both are spared: :mod:`towtank.simulate.lowering` has numba lower the kernel once to
the intermediate language of LLVM, which is part of the package (``kernel.ll.xz``); a machine makes its own code of it,
in seconds, and keeps that code on its disk. The lowered form names the sources it was made of. When they differ, or
the processor is of another kind, numba compiles the sources.

With ``NUMBA_DISABLE_JIT=1`` the sources run as plain Python.
"""

from __future__ import annotations

import ctypes
import hashlib
import lzma
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from .parameters import CONTROLS, NODES, STATES

SOURCES = (
    "circular", "crossings", "drift", "environment_forces", "environment_layout", "equations", "given_orders",
    "kernel", "many_draws", "parameters", "propulsion", "rudder_force", "runge_kutta", "step_limits",
    "straight_course",
)  # fmt: skip
"""Modules whose functions are compiled."""

DIMENSIONS = (1, 2, 1, 2, 1, 1, 2, 2, 2, 2, 1, 3, 2, 2, 1, 1, 2, 2, 2)
"""Of the arguments of :func:`towtank.simulate.many_draws.sail_draws`."""

_HERE = Path(__file__).parent
LOWERED = _HERE / "kernel.ll.xz"
_STAGES = 7
_ONE_AT_A_TIME = Lock()


@dataclass(frozen=True)
class Lowered:
    """The kernel in LLVM's intermediate language.

    Attributes
    ----------
    sources : str
        Fingerprint of the sources.
    symbol : str
        Name of the function.
    text : str
    """

    sources: str
    symbol: str
    text: str

    def packed(self) -> bytes:
        """As a file."""
        return lzma.compress("\n".join([self.sources, self.symbol, self.text]).encode(), preset=9)

    @classmethod
    def unpacked(cls, data: bytes) -> Lowered:
        """From a file."""
        return cls(*lzma.decompress(data).decode().split("\n", 2))


def fingerprint() -> str:
    """Fingerprint of the sources of the kernel."""
    digest = hashlib.sha256()
    for name in SOURCES:
        digest.update((_HERE / f"{name}.py").read_bytes())
    return digest.hexdigest()


def sail_many(*arrays: np.ndarray) -> None:
    """Sail draws: :func:`towtank.simulate.many_draws.sail_draws` without the room that it works in.

    Other threads run meanwhile. The arrays are contiguous, of float64 and int64, and no two share memory.
    """
    products, watches = arrays[1], arrays[8]
    room = (
        np.zeros(CONTROLS),
        np.zeros(NODES + len(products)),
        np.zeros((_STAGES, STATES)),
        np.zeros((5, STATES)),
        np.zeros((len(watches), 2)),
    )
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        from .many_draws import sail_draws

        sail_draws(*arrays, *room)
        return
    # where a function of numba leaves its result and its exception: this one has neither
    unused = np.zeros(2, dtype=np.int64)
    numbers = [unused.ctypes.data, unused.ctypes.data + 8]
    for array in (*arrays, *room):
        if not array.flags.c_contiguous:
            raise ValueError("the kernel takes contiguous arrays")
        numbers += [0, 0, array.size, 8, array.ctypes.data, *array.shape, *array.strides]
    _machine_code()(*numbers)


def _machine_code() -> Callable[..., Any]:
    """The compiled function; threads that ask for it at once wait for the first."""
    with _ONE_AT_A_TIME:
        return _function()


@cache
def _function() -> Callable[..., Any]:
    """The compiled function, whose arguments are those that numba passes for the arrays."""
    import llvmlite.binding as llvm

    _start(llvm)
    sources = fingerprint()
    machine = host_machine(llvm)
    key = f"{sources}{llvm.get_host_cpu_name()}{machine.triple}{llvm.llvm_version_info}"
    name = f"kernel-{hashlib.sha256(key.encode()).hexdigest()[:24]}.bin"
    kept = _read(name)
    if kept is None:
        symbol, code = _compiled(llvm, machine, sources)
        _keep(name, symbol.encode() + b"\n" + code)
    else:
        head, code = kept.split(b"\n", 1)
        symbol = head.decode()
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    count = 2 + sum(5 + 2 * dimensions for dimensions in DIMENSIONS)
    function = ctypes.CFUNCTYPE(ctypes.c_int32, *[ctypes.c_int64] * count)(engine.get_function_address(symbol))
    function.engine = engine  # type: ignore[attr-defined]  # the code lives as long as its engine
    return function


def _start(llvm: Any) -> None:
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()


def host_machine(llvm: Any) -> Any:
    """The processor that this runs on, for which LLVM makes code."""
    features = llvm.get_host_cpu_features().flatten()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=llvm.get_host_cpu_name(), features=features, opt=3, codemodel="jitdefault", jit=True
    )


def _compiled(llvm: Any, machine: Any, sources: str) -> tuple[str, bytes]:
    """Symbol and machine code of the kernel."""
    lowered = _shipped(sources, machine.triple)
    if lowered is not None:
        try:
            return lowered.symbol, machine.emit_object(llvm.parse_assembly(lowered.text))
        except RuntimeError:
            # an LLVM that does not read what another one has written
            pass
    from .lowering import lower

    lowered = lower()
    return lowered.symbol, machine.emit_object(llvm.parse_assembly(lowered.text))


def _shipped(sources: str, triple: str) -> Lowered | None:
    """The lowered form in the package, if it is of these sources and for this kind of processor."""
    if not LOWERED.exists():
        return None
    lowered = Lowered.unpacked(LOWERED.read_bytes())
    fits = lowered.sources == sources and f'target triple = "{triple}"' in lowered.text
    return lowered if fits else None


def _folders() -> list[Path]:
    """Where machine code is kept, in the order of preference."""
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    if chosen:
        return [Path(chosen)]
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return [_HERE / "__pycache__", Path(home) / "towtank"]


def _read(name: str) -> bytes | None:
    for folder in _folders():
        try:
            return (folder / name).read_bytes()
        except OSError:
            continue
    return None


def _keep(name: str, data: bytes) -> None:
    """Write a file in one go, so that another process never reads half of it."""
    for folder in _folders():
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile(dir=folder, delete=False) as file:
                file.write(data)
            os.replace(file.name, folder / name)
        except OSError:
            continue
        return
