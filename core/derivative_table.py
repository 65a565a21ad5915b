"""Derivative tables as text and LaTeX: aligned, with units named and digits that the uncertainty supports."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .derivative_set import DerivativeSet


def digits_for(value: float, std: float) -> int:
    """Decimals that show two significant digits of the uncertainty; five significant ones when unknown."""
    scale = std if std and math.isfinite(std) and std > 0 else abs(value) * 1e-3
    if not scale or not math.isfinite(scale):
        return 5
    return min(max(1 - math.floor(math.log10(scale)), 0), 9)


def unit_line(result: DerivativeSet) -> str:
    """One line that says how the values are scaled."""
    c = result.conventions
    scale = {
        "LT": "forces / (0.5 rho L T U^2), moments / (0.5 rho L^2 T U^2)",
        "L2": "forces / (0.5 rho L^2 U^2), moments / (0.5 rho L^3 U^2)",
        "bis": "forces / (m g), moments / (m g L), speeds / sqrt(g L)",
        "dimensional": f"SI at U = {result.reference_speed} m/s",
    }[c.force_scaling]
    speed = "U instantaneous" if c.velocity_scale == "instantaneous" else "U = approach speed"
    return f"{scale}; {speed}; origin {c.origin}; {c.sway_variable}; angles in {c.angle_unit}"


def derivative_table(result: DerivativeSet) -> str:
    """Aligned text table of a set."""
    frame = result.to_frame()
    interval = result.covariance is not None
    rows = []
    for name, value, std, lower, upper, _ in frame.itertuples(index=False, name=None):
        places = digits_for(value, std)
        cells = [name, f"{value:.{places}f}"]
        if interval:
            cells += [f"{number:.{places}f}" for number in (std, lower, upper)]
        rows.append(cells)
    head = ["name", "value", "std", "lower 95 %", "upper 95 %"][: len(rows[0]) if rows else 2]
    widths = [max(len(cell) for cell in column) for column in zip(head, *rows)]

    def line(cells: list[str]) -> str:
        first, *others = (
            cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(cells, widths))
        )
        return "  ".join((first, *others)).rstrip()

    rule = "-" * (sum(widths) + 2 * (len(widths) - 1))
    title = f"{result.name}  ({result.ship.name}, L = {result.ship.L:g} m)"
    return "\n".join([title, unit_line(result), rule, line(head), rule, *(line(row) for row in rows), rule])


def latex_table(result: DerivativeSet) -> str:
    """LaTeX tabular of a set, with the conventions in the caption."""
    rows = []
    for name, value, std, *_ in result.to_frame().itertuples(index=False, name=None):
        places = digits_for(value, std)
        label = f"${name[0]}_{{{name[1:]}}}'$" if name != "R0" else "$R_0'$"
        error = f"{std:.{places}f}" if math.isfinite(std) else "--"
        rows.append(f"{label} & {value:.{places}f} & {error} \\\\")
    caption = unit_line(result).replace("^2", "$^2$").replace("^3", "$^3$").replace("rho", "$\\rho$")
    caption = caption.replace("_", "\\_")
    name = result.name.replace("_", "\\_").replace("%", "\\%").replace("&", "\\&")
    return "\n".join(
        [
            "\\begin{table}",
            f"\\caption{{{name}: {caption}}}",
            "\\begin{tabular}{lrr}",
            "\\hline",
            "derivative & value & standard uncertainty \\\\",
            "\\hline",
            *rows,
            "\\hline",
            "\\end{tabular}",
            "\\end{table}",
            "",
        ]
    )
