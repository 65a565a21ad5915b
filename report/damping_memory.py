"""Radiation memory in the decay report: tables and figures of B, A and the retardation function."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..decay.beside_memory import MemoryComparison
from .damping_figures import drawn, shown_unit
from .drawings import Drawing
from .figure_style import BLUE, INK, VERMILLION, new_axes, small_legend
from .page_table import Column, Table, make_table
from .typography import fixed, significant

_SHOWN_AMPLITUDES = 6


def memory_table(memory: MemoryComparison) -> Table:
    """Share of the waves in the equivalent damping at a few amplitudes, below the orders that were tried."""
    fit = memory.fit
    low, high = fit.diagnostics.amplitudes
    at = np.linspace(low, high, _SHOWN_AMPLITUDES)
    one = fit.equivalent(at)
    share = fit.radiation_share(at)
    factor, unit = shown_unit(fit.motion)
    inertia = fit.effective_inertia(one.omega)
    columns = [
        Column(f"amplitude [{unit}]", "number"),
        Column("ω [rad/s]", "number"),
        Column("αₑ [1/s]", "number"),
        Column("95 % interval", "number"),
        Column("waves [%]", "number"),
        Column(f"I + A(ω) [{fit.units['inertia']}]", "number"),
    ]
    rows = [
        [
            fixed(factor * at[k], 2),
            fixed(one.omega[k], 4),
            fixed(one.alpha[k], 5),
            f"{fixed(one.alpha_lower[k], 5)} … {fixed(one.alpha_upper[k], 5)}",
            fixed(100.0 * share[k], 1),
            significant(float(inertia[k]), 4),
        ]
        for k in range(at.size)
    ]
    orders = "; ".join(
        f"order {row['order']}: R² {row['r2_damping']:.4f} of B, {row['r2_added_mass']:.4f} of A"
        for row in memory.identified.tried.to_dict("records")
    )
    return make_table(columns, rows, f"Rational transfer function, {orders}.")


def draw_memory(memory: MemoryComparison, prefix: str) -> tuple[Drawing, ...]:
    """Damping, added mass where it is known, and retardation function: table beside transfer function."""
    order = memory.identified.order
    drawings = [
        drawn(
            radiation_figure(memory, "B"),
            f"{prefix}-memory-damping",
            f"Radiation damping: table, and transfer function of order {order}; dotted: the natural frequency.",
        )
    ]
    if memory.table.added_mass is not None:
        drawings.append(
            drawn(
                radiation_figure(memory, "A"),
                f"{prefix}-memory-mass",
                f"Added mass; {significant(memory.identified.infinite, 4)} {_mass_unit(memory)} "
                "at infinite frequency.",
            )
        )
    drawings.append(drawn(retardation_figure(memory), f"{prefix}-memory-kernel", "Retardation function of both."))
    return tuple(drawings)


def radiation_figure(memory: MemoryComparison, quantity: str, *, ax: Axes | None = None) -> Axes:
    """Damping (``B``) or added mass (``A``) of the table and of its transfer function against frequency.

    Parameters
    ----------
    memory : MemoryComparison
    quantity : {"B", "A"}
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    frame = memory.to_frame()
    omega = frame["omega [rad/s]"].to_numpy()
    fine = np.linspace(omega[0], omega[-1], 300)
    found = memory.identified
    fitted = found.function.damping(fine) if quantity == "B" else found.added_mass(fine)
    ax.plot(omega, frame[quantity], "o", color=INK, markersize=2.6, label="table")
    ax.plot(fine, fitted, color=BLUE, linewidth=1.3, label=f"order {found.order}")
    ax.axvline(memory.fit.omega_n, color=VERMILLION, linewidth=0.8, linestyle=":")
    ax.set_xlabel("ω [rad/s]")
    unit = _damping_unit(memory) if quantity == "B" else _mass_unit(memory)
    ax.set_ylabel(f"{'damping B' if quantity == 'B' else 'added mass A'} [{unit}]")
    small_legend(ax, loc="best")
    return ax


def retardation_figure(memory: MemoryComparison, *, ax: Axes | None = None) -> Axes:
    """K(t) of the table and of the transfer function.

    Parameters
    ----------
    memory : MemoryComparison
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    frame = memory.retardation()
    ax.plot(frame["time [s]"], frame["table"], color=INK, linewidth=2.2, alpha=0.35, label="table")
    ax.plot(
        frame["time [s]"],
        frame["fitted"],
        color=BLUE,
        linewidth=1.1,
        label=f"order {memory.identified.order}",
    )
    ax.set_xlim(0.0, float(frame["time [s]"].iloc[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel(f"K [{_damping_unit(memory)}/s]".replace("N m s/s", "N m").replace("N s/m/s", "N/m"))
    small_legend(ax, loc="upper right")
    return ax


def _damping_unit(memory: MemoryComparison) -> str:
    return "N s/m" if memory.fit.motion == "heave" else "N m s"


def _mass_unit(memory: MemoryComparison) -> str:
    return str(memory.fit.units["inertia"]).replace("m2", "m²")
