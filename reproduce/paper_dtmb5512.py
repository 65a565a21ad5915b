"""DTMB 5512, virtual oblique towing and planar motion: errors, forward check, sinusoid formulas, grids."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.scales import mass_coefficient, yaw_inertia_coefficient
from ..datasets import load_set
from ..pmm.run_types import Run
from ..pmm.single_run import single_run_derivatives
from ..pmm.standard_matrices import pure_sway, pure_yaw
from ..verify import relative_errors
from .case import Case, Paper, half_digit
from .closed_loop import ROUND_TRIP, largest_difference, mean_forces, refitted, virtual_runs
from .dtmb5512_grids import grid_cases
from .dtmb5512_steering import steering_cases
from .printed_numbers import printed_by, printed_rows
from .rounding import spread_of

KEY = "dtmb5512"

SPEED = 1.5311
"""Carriage speed in m/s at Fn 0.28."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _particulars()
    yield from _drift_errors()
    yield from _oscillation_errors()
    yield from _forward_check()
    yield from _chain_rule()
    yield from _pure_sway_loop()
    yield from _pure_yaw_bias()
    yield from grid_cases(KEY)
    yield from steering_cases(KEY)


def _particulars() -> Iterator[Case]:
    sway = load_set("dtmb5512-sway-cfd")
    ship = sway.ship
    mass = mass_coefficient(ship)
    numbers = (float(ship.volume or math.nan), 3), (ship.L, 3), (ship.B, 3), (ship.T, 3)
    yield Case(
        KEY,
        "Table 1",
        "block coefficient",
        0.506,
        float(ship.block_coefficient or math.nan),
        spread_of(lambda volume, length, breadth, draught: volume / (length * breadth * draught), *numbers)
        + half_digit(3),
    )
    for quantity, reference, computed, decimals in (
        ("m' (recomputed reference)", 0.13613, mass, 5),
        ("Iz' (recomputed reference)", 0.008518, yaw_inertia_coefficient(ship), 6),
    ):
        yield Case(KEY, "Table 1", quantity, reference, computed, half_digit(decimals))
    yield Case(
        KEY,
        "Table 16, pure sway",
        "Yvdot (CFD) against -m'",
        sway["Yvdot"],
        -mass,
        half_digit(4),
        note="the added mass equals the mass of the model to the last digit, which is suspicious",
    )


# Errors ---------------------------------------------------------------------------------------------------------


def _drift_errors() -> Iterator[Case]:
    """The fifteen percentages of Tables 12 and 14: |CFD - EFD| / |EFD|."""
    for row in printed_rows("dtmb5512-drift-comparison"):
        yield Case(
            KEY,
            f"Tables 12 and 14, Fn {row['froude_number']:g}",
            f"error of {row['coefficient']} in %",
            row["error"],
            float(relative_errors([row["CFD"]], [row["EFD"]]).absolute[0]),
            half_digit(2),
        )


_OSCILLATION_ERRORS = {
    "sway": {"Xvv": 17.17, "Yv": 15.63, "Yvvv": 8.19, "Nv": 6.33, "Nvvv": 13.61, "Yvdot": 22.50, "Nvdot": 16.79},
    "yaw": {"Xrr": 6.38, "Yr": 0.62, "Yrrr": 7.77, "Nr": 3.92, "Nrrr": 6.34, "Yrdot": 13.33, "Nrdot": 2.86},
}
"""Errors in % relative to the measurement, recomputed from Tables 16 and 17; the paper gives ranges only."""

_PRINTED_RANGES = {"sway": (5.0, 21.0), "yaw": (2.0, 13.0)}
"""Smallest and largest error in % that the text states."""


def _oscillation_errors() -> Iterator[Case]:
    for motion, references in _OSCILLATION_ERRORS.items():
        table = "Table 16, pure sway" if motion == "sway" else "Table 17, pure yaw"
        cfd, efd = load_set(f"dtmb5512-{motion}-cfd"), load_set(f"dtmb5512-{motion}-efd")
        errors = relative_errors([cfd[name] for name in references], [efd[name] for name in references]).absolute
        for (name, reference), error in zip(references.items(), errors, strict=True):
            yield Case(
                KEY, table, f"error of {name} in % (recomputed reference)", reference, float(error), half_digit(2)
            )
        of_cfd = relative_errors([efd[name] for name in references], [cfd[name] for name in references]).absolute
        for which, pick, printed in zip(("smallest", "largest"), (np.min, np.max), _PRINTED_RANGES[motion]):
            error = float(pick(errors))
            apart = abs(error - printed) > half_digit(0)
            note = f"relative to the measurement, as in Tables 12 and 14; to the computation {pick(of_cfd):.1f} %"
            yield Case(
                KEY,
                table,
                f"{which} error in %, text",
                printed,
                error,
                half_digit(0),
                note=note if apart else "",
            )


# Oblique towing -------------------------------------------------------------------------------------------------


def _forward_check() -> Iterator[Case]:
    """Forces at 6 deg and Fn 0.28 from the fitted derivatives, beside those of the grid study at that angle."""
    derivatives = load_set("dtmb5512-drift-fn0.280-cfd")
    _, medium, _ = printed_rows("dtmb5512-drift-grids")
    convergence = printed_by("dtmb5512-grid-convergence", "quantity")
    run = Run("drift 6 deg", "static_drift", SPEED, drift_angle=math.radians(6.0))
    forces = mean_forces(derivatives, run)
    notes = {
        "Y": "tolerance: the grid uncertainty that Table 4 prints; the angle is printed as -6 deg, the signs are "
        "those of +6 deg with v = -U sin(beta)",
        "N": "29 % apart, far beyond the grid uncertainty of Table 4: the fitted derivatives and the grid study "
        "do not belong to one set of computations",
    }
    for force in ("Y", "N"):
        yield Case(
            KEY,
            "Table 12 to Table 2, 6 deg",
            f"{force}' from the fit, against the medium grid",
            medium[force],
            forces[force],
            convergence[f"drift_{force}"]["GCI_fine"],
            note=notes[force],
        )


def _chain_rule() -> Iterator[Case]:
    """Yvvv out of derivatives with respect to the drift angle (equations 23 to 25)."""
    printed = load_set("dtmb5512-drift-fn0.280-cfd")
    # In oblique towing the carriage speed is the speed of the model, so v' = -sin(beta).
    steady = replace(printed, conventions=printed.conventions.but(velocity_scale="instantaneous"))
    series = steady.to("drift-angle")
    slope, third, second = series["Yb"], 6.0 * series["Ybbb"], 2.0 * series["Xbb"]
    for name, as_printed, computed in (
        ("Yvvv", -third, -(third + slope) / 6.0),
        ("Xvv", second, second / 2.0),
    ):
        formula = "-(Y_bbb + Y_b)/6" if name == "Yvvv" else "X_bb/2"
        yield Case(
            KEY,
            "equations 23 to 25",
            f"{name} from derivatives in the drift angle",
            printed[name],
            computed,
            ROUND_TRIP,
            expected=printed[name],
            note=f"as printed, without the factors of the Taylor series, {as_printed:.3f}; {formula} is right",
        )


# Oscillations ---------------------------------------------------------------------------------------------------


def _pure_sway_loop() -> Iterator[Case]:
    """Table 16 through a virtual run of 0.266 m/s at 0.841 rad/s and the Fourier relations."""
    for source in ("cfd", "efd"):
        derivatives = load_set(f"dtmb5512-sway-{source}")
        (run,) = virtual_runs(derivatives, pure_sway([0.266], 0.841, SPEED))
        found = single_run_derivatives(run)
        for name in ("Yv", "Yvvv", "Yvdot", "Xvv"):
            yield Case(
                KEY,
                f"Table 16 {source.upper()}, closed loop",
                f"{name} by the Fourier relations",
                derivatives[name],
                found[name].value,
                ROUND_TRIP,
            )
        yield Case(
            KEY,
            f"Table 16 {source.upper()}, closed loop",
            f"largest difference over {len(derivatives)} derivatives",
            0.0,
            max(abs(derivatives[name] - found[name].value) for name in derivatives.names),
            ROUND_TRIP,
        )


def _largest_yaw_run() -> list[Run]:
    return pure_yaw([0.375], 1.08, SPEED)


def _pure_yaw_bias() -> Iterator[Case]:
    """Table 17 through a virtual run of 0.375 rad/s at 1.08 rad/s: sinusoid formulas and exact kinematics."""
    derivatives: DerivativeSet = load_set("dtmb5512-yaw-cfd")
    (run,) = virtual_runs(derivatives, _largest_yaw_run())
    found = single_run_derivatives(run)
    slope = run.run.sway_amplitude * run.run.frequency / SPEED
    note = (
        f"equation 30 takes r for a sinusoid, but on the path with y_max omega/U = {slope:.3f} it is none, and "
        "the formulas do not return what the forces were made of"
    )
    for name in ("Yr", "Yrrr", "Yrdot"):
        yield Case(
            KEY,
            "Table 17, sinusoid formulas on the exact motion",
            f"{name} by equation 30",
            derivatives[name],
            found[name].value,
            half_digit(4),
            note=note,
        )
    for name, reference, decimals in (("Yr", -0.0199, 4), ("Yrrr", -0.458, 3), ("Yrdot", -0.00991, 5)):
        yield Case(
            KEY,
            "Table 17, sinusoid formulas on the exact motion",
            f"{name} by equation 30 (recomputed reference)",
            reference,
            found[name].value,
            half_digit(decimals),
        )
    fit = refitted(derivatives, _largest_yaw_run())
    case = "Table 17, exact kinematics"
    for name in ("Yr", "Yrrr", "Yrdot"):
        yield Case(KEY, case, f"{name} by least squares", derivatives[name], fit[name], ROUND_TRIP)
    size = largest_difference(derivatives, fit)
    yield Case(KEY, case, f"largest difference over {len(derivatives)} derivatives", 0.0, size, ROUND_TRIP)


PAPER = Paper(
    KEY,
    "Virtual captive tests of DTMB 5512 (oblique towing and planar motion) in STAR-CCM+ and prediction of its "
    "manoeuvres, with measurements of IIHR (Yoon 2009)",
    cases,
)
