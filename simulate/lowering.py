"""Lower the kernel by numba to LLVM's intermediate language: ``python -m towtank.simulate.lowering``.

To be run after each change of the compiled sources; a test tells when it was forgotten.
"""

from __future__ import annotations

import re

import llvmlite.binding as llvm

from .compiled_kernel import DIMENSIONS, LOWERED, Lowered, fingerprint, host_machine
from .many_draws import sail_draws

_INTEGERS = (0, 1, 2, 13)
"""Arguments of :func:`sail_draws` that hold integers."""

_MATHEMATICS = frozenset({"atan2", "cos", "exp", "pow", "sin", "sqrt", "memset", "memcpy"})
"""Functions outside the kernel that it may call: those of the system's library."""

_INNER = re.compile(
    r"simulate\d+(?:circular\d+sine_and_cosine|equations\d+(?:derivative|hull_forces)|kernel\d+sail_one"
    r"|propulsion\d+propeller_thrust|rudder_force\d+rudder_normal_force|runge_kutta\d+step)B"
)
"""Names, as numba writes them, of what each stage of each step calls, or calls it."""


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
    symbol = result.fndesc.llvm_func_name
    return Lowered(fingerprint(), symbol, _joined(text, symbol))


def _joined(text: str, symbol: str) -> str:
    """The code with the functions of a step made one, which are called with some seventy arguments otherwise.

    numba leaves them apart because of their size, and does not say that its arrays share no memory. Both together
    spare a third of the time.
    """
    machine = host_machine(llvm)
    module = llvm.parse_assembly("\n".join(_marked(line, symbol) for line in text.splitlines()))
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    passes = llvm.create_pass_builder(machine, tuning)
    passes.getModulePassManager().run(module, passes)
    return str(module)


def _marked(line: str, symbol: str) -> str:
    """A line of code, with the wishes at the head of a function."""
    if not line.startswith("define "):
        return line
    name = line.split("@", 1)[1].split("(", 1)[0]
    if name.strip('"') == symbol:
        # the fifth field of an array is where its numbers are
        return re.sub(r"ptr ((?:[\w()]+ )*)(%arg\.\w+\.4\b)", r"ptr noalias \1\2", line)
    if _INNER.search(name):
        return re.sub(r"( (?:#\d+ )?\{)$", r" alwaysinline\1", line)
    return line


if __name__ == "__main__":
    LOWERED.write_bytes(lower().packed())
