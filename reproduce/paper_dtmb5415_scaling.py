"""One PMM campaign in two papers: DTMB 5415 of Taimuri et al. (L^2 scaling) against DTMB 5512 (L T scaling)."""

from __future__ import annotations

from collections.abc import Iterator

from ..datasets import load_set
from .case import Case, Paper, half_digit

KEY = "dtmb5415-scaling"

_TABLES = {
    "Tables 12 and 14, drift": ("dtmb5512-drift-fn0.280-efd", ("Xvv", "Yv", "Yvvv", "Nv", "Nvvv")),
    "Table 17, pure yaw": ("dtmb5512-yaw-efd", ("Xrr", "Yr", "Yrrr", "Nr", "Nrrr")),
    "Table 18, coupling": ("dtmb5512-coupling-efd", ("Xvr", "Yvrr", "Yvvr", "Nvrr", "Nvvr")),
}

_NOTES = {
    "Xrr": "Table 18 of the same paper has -0.0190",
    "Yr": "-0.0485 is also what the paper prints for Nr",
    "Yrrr": "ten times as large as in the other paper",
    "Xvr": "Taimuri et al. repeat their value of Nv",
    "Nvrr": "single-run and curve-fit evaluations of these tests differ even in sign (Sakamoto 2012)",
}


def cases() -> Iterator[Case]:
    """Each derivative of the model tests, printed in L T scaling, from the other paper's in L^2 scaling.

    The numbers agree or not as they stand: nothing but the reference area is converted.
    """
    other = load_set("dtmb5415")
    converted = other.to("lt")
    # Table 4 of Taimuri et al. has five decimals.
    factor = other.ship.L / other.ship.T
    tolerance = factor * half_digit(5) + half_digit(4)
    for table, (key, names) in _TABLES.items():
        measured = load_set(key)
        for name in names:
            apart = abs(converted[name] - measured[name])
            differs = f"{100 * apart / abs(measured[name]):.1f} % apart, more than rounding explains"
            if name in _NOTES:
                differs += f"; {_NOTES[name]}"
            yield Case(
                KEY,
                f"{table} of DTMB 5512",
                f"{name} from DTMB 5415",
                measured[name],
                converted[name],
                tolerance,
                note=differs if apart > tolerance else "",
            )


PAPER = Paper(
    KEY,
    "Taimuri et al. (2020), Ocean Engineering, Table 4, against the virtual captive tests of DTMB 5512 with the "
    "measurements of IIHR (Yoon 2009)",
    cases,
)
