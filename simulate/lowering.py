"""Lower the kernel by numba to LLVM's intermediate language: ``python -m towtank.simulate.lowering``.

To be run after each change of the compiled sources; a test tells when it was forgotten.
"""

from __future__ import annotations

import re

from .compiled_kernel import DIMENSIONS, LOWERED, Lowered, fingerprint
from .many_draws import sail_draws

_INTEGERS = (0, 1, 2, 13)
"""Arguments of :func:`sail_draws` that hold integers."""

_MATHEMATICS = frozenset({"atan2", "cos", "exp", "pow", "sin", "sqrt", "memset", "memcpy"})
"""Functions outside the kernel that it may call: those of the system's library."""


def lower() -> Lowered:
    """The kernel as numba lowers and optimises it.

    Raises
    ------
    RuntimeError
        When the kernel calls what is not there without numba, such as its allocator.
    """
    types = [
        f"{'i8' if place in _INTEGERS else 'f8'}[{':, ' * (dimensions - 1)}::1]"
        for place, dimensions in enumerate(DIMENSIONS)
    ]
    sail_draws.compile(f"void({', '.join(types)})")
    ((arguments, result),) = sail_draws.overloads.items()
    text = sail_draws.inspect_llvm(arguments)
    # what numba declares and the optimised kernel no longer calls
    called = set(re.findall(r"(?:call|invoke)[^@\n]*@\"?([\w.$]+)", text))
    defined = set(re.findall(r"^define[^@\n]*@\"?([\w.$]+)", text, flags=re.MULTILINE))
    foreign = {name for name in called - defined if not name.startswith("llvm.")} - _MATHEMATICS
    if foreign:
        raise RuntimeError(f"the kernel calls {', '.join(sorted(foreign))}")
    return Lowered(fingerprint(), result.fndesc.llvm_func_name, text)


if __name__ == "__main__":
    LOWERED.write_bytes(lower().packed())
