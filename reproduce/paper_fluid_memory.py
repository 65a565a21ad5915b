"""Radiation memory by the procedure of Perez and Fossen, as a unified model of manoeuvring in waves uses it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.ship import Ship
from ..decay.decay_input import decay_from_table
from ..decay.fluid_memory import simulate_memory_decay
from ..decay.memory_fit import fit_memory_decay
from ..decay.retardation import check_added_mass, impulse_response
from ..decay.transfer_function import TransferFunction, fit_transfer_function
from .case import Case, Paper, half_digit

KEY = "fluid-memory"

# The program's frequencies: 50 from 0.06 to 2.70 rad/s.
_FREQUENCIES = np.linspace(0.06, 2.70, 50)
_SECOND = {"p1": 6.0e8, "q1": 0.6, "q0": 0.5}
_INFINITE = 2.0e9
_EXACT = 1e-9


def cases() -> Iterator[Case]:
    """All cases of the thesis that its print allows."""
    yield from _added_masses()
    yield from _closed_loop()
    yield from _round_trip()
    yield from _decay()


def _added_masses() -> Iterator[Case]:
    """Equations 2-4 to 2-6 on the printed particulars; the thesis prints no ratios, these are computed from it."""
    ship = Ship("ship of the thesis", 113.8, 22.0, 8.5, volume=16998.0)
    block, mass = 16998.0 / (113.8 * 22.0 * 8.5), 1025.0 * 16998.0
    surge = 1.0 / (math.pi * math.sqrt(ship.L**3 / 16998.0) - 14.0)
    per_mass = 0.5 * math.pi * 1025.0 * ship.T**2 * ship.L / mass
    sway = per_mass * (1.0 + 0.16 * block * ship.B / ship.T - 5.1 * (ship.B / ship.L) ** 2)
    yaw = per_mass / 0.25**2 * (1.0 / 12.0 + 0.017 * block * ship.B / ship.T - 0.33 * ship.B / ship.L)
    for name, listed, value in (("mx/m", 0.0656, surge), ("my/m", 0.8663, sway), ("Jz/Iz", 0.6648, yaw)):
        yield Case(
            KEY,
            "equations 2-4 to 2-6",
            name,
            listed,
            value,
            half_digit(4) + 1e-4 * listed,
            note="the thesis prints particulars and formulas, and no ratio" if name == "mx/m" else "",
        )


def _memory() -> TransferFunction:
    return TransferFunction(np.array([_SECOND["p1"], 0.0]), np.array([1.0, _SECOND["q1"], _SECOND["q0"]]))


def _closed_loop() -> Iterator[Case]:
    """Equation 4-23 sampled by 4-22 and identified by 4-21: the smallest memory comes back."""
    memory = _memory()
    damping = memory.damping(_FREQUENCIES)
    mass = _INFINITE + memory.added_mass_difference(_FREQUENCIES)
    for known in (_INFINITE, None):
        fit = fit_transfer_function(_FREQUENCIES, damping, mass, infinite=known)
        what = "A at infinity known" if known is not None else "A at infinity fitted"
        found = {
            "p1": float(fit.function.numerator[0]),
            "q1": float(fit.function.denominator[1]),
            "q0": float(fit.function.denominator[2]),
        }
        yield Case(KEY, f"closed loop, {what}", "order", 2.0, float(fit.order))
        for name, value in _SECOND.items():
            yield Case(KEY, f"closed loop, {what}", name, value, found[name], _EXACT * value)
        yield Case(KEY, f"closed loop, {what}", "R2 of the added mass", 1.0, fit.r2_added_mass, _EXACT)
        yield Case(KEY, f"closed loop, {what}", "A at infinity", _INFINITE, fit.infinite, _EXACT * _INFINITE)


def _round_trip() -> Iterator[Case]:
    """Equations 3-10 to 3-12: damping to K(t), and back to damping and added mass."""
    memory = _memory()
    omega = np.linspace(0.05, 15.0, 150)
    time = np.linspace(0.0, 50.0, 501)
    damping = memory.damping(omega)
    response = impulse_response(omega, damping, time)
    exact = memory.impulse_response(time)
    check = check_added_mass(omega, _INFINITE + memory.added_mass_difference(omega), response)
    worst = float(np.abs(response.kernel - exact).max() / exact[0])
    back = float(np.abs(response.damping(omega) - damping).max() / damping.max())
    yield Case(KEY, "equation 3-12", "largest error of K(t) over K(0)", 0.0, worst, 1e-3)
    yield Case(KEY, "equations 3-12 and 3-11", "largest error of B over its peak", 0.0, back, 1e-3)
    yield Case(KEY, "equations 3-12 and 3-10", "A at infinity", _INFINITE, check.infinite, 1e-3 * _INFINITE)


def _decay() -> Iterator[Case]:
    """Equation 3-7 as a decay test: damping beside the memory, inertia and restoring known or free."""
    inertia = 8.0e10
    restoring = inertia * (2.0 * math.pi / 20.0) ** 2
    terms = {"b1": 6.0e8 / inertia, "b2": 2.3e9 / inertia, "c1": restoring / inertia}
    time = np.arange(0.0, 200.0, 0.25)
    angle = simulate_memory_decay(time, (math.radians(7.0), 0.0), terms, _memory(), inertia)[:, 0]
    record = decay_from_table({"time": time, "phi": angle}, unit="rad")
    known = fit_memory_decay(record, _memory(), inertia=inertia, restoring=restoring)
    free = fit_memory_decay(record, _memory(), inertia=1.2 * inertia, free_inertia=True)
    for what, fit in (("inertia and restoring known", known), ("all free", free)):
        for name, value in (("b1", 6.0e8), ("b2", 2.3e9), ("c1", restoring)):
            yield Case(
                KEY,
                f"decay with memory, {what}",
                f"{name} times inertia",
                value,
                fit.dimensional_terms()[name][0],
                1e-5 * value,
            )
        yield Case(KEY, f"decay with memory, {what}", "inertia", inertia, fit.inertia, 1e-5 * inertia)


PAPER = Paper(
    KEY,
    "Perez and Fossen (2009), identification of radiation memory, as in Castillo de Tebra's thesis (Delft University "
    "of Technology) on a unified model of a manoeuvring ship in waves",
    cases,
)
