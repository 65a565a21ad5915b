"""A case of the gallery: the printed value, ours, the tolerance that the printed digits support, the verdict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

Verdict = Literal["reproduced", "reproduced-after-correction", "not-reproducible"]


@dataclass(frozen=True)
class Case:
    """One printed quantity and what towtank makes of it.

    Attributes
    ----------
    paper, case, quantity : str
        Key of the paper, what was done (table, equation), and which number.
    printed : float or str
        As the paper prints it.
    computed : float or str
        What this package computes.
    tolerance : float
        Absolute difference that the rounding of the printed numbers explains.
    expected : float or str, optional
        The printed value after the correction that `note` explains; None when the print stands.
    note : str
        Reason of a correction, or of a failure to reproduce.
    """

    paper: str
    case: str
    quantity: str
    printed: float | str
    computed: float | str
    tolerance: float = 0.0
    expected: float | str | None = None
    note: str = ""

    @property
    def verdict(self) -> Verdict:
        """Reproduced, reproduced after a correction, or not reproducible."""
        if self.expected is None:
            return "reproduced" if agrees(self.printed, self.computed, self.tolerance) else "not-reproducible"
        if agrees(self.expected, self.computed, self.tolerance):
            return "reproduced-after-correction"
        return "not-reproducible"

    def to_dict(self) -> dict[str, Any]:
        """Mapping with the keys paper, case, quantity, printed, computed, tolerance, verdict, note."""
        return {
            "paper": self.paper,
            "case": self.case,
            "quantity": self.quantity,
            "printed": self.printed,
            "computed": self.computed,
            "tolerance": self.tolerance,
            "verdict": self.verdict,
            "note": self.note,
        }


def agrees(printed: float | str, computed: float | str, tolerance: float) -> bool:
    """True when two numbers differ by no more than `tolerance`, or two texts are equal."""
    if isinstance(printed, str) or isinstance(computed, str):
        return printed == computed
    if math.isnan(printed) or math.isnan(computed):
        return False
    # The last bit of a decimal fraction must not decide.
    return abs(printed - computed) <= tolerance * (1 + 1e-9) + 1e-15


def half_digit(decimals: int) -> float:
    """Half a unit of the last printed decimal: what rounding alone explains."""
    return 0.5 * 10.0**-decimals


@dataclass(frozen=True)
class Paper:
    """A paper in the gallery.

    Attributes
    ----------
    key : str
        What the user types.
    citation : str
    cases : callable
        Returns the cases; called when the gallery is shown.
    """

    key: str
    citation: str
    cases: Callable[[], Iterable[Case]]
