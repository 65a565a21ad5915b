"""DTC in shallow-water head waves by CFD (MASHCON 2019, two papers): harmonics of motions and forces, added resistance.

Both papers have the same model and the same waves, so that their tables can be held against each other and against
the dispersion relation.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ..core.ship import Ship
from ..verify import relative_errors
from .case import Case, Paper, half_digit
from .dtc_head_waves import CLEARANCES, SPEEDS, WAVE_LENGTH, added_resistance_unit, depth_of, encounter_frequency
from .printed_numbers import printed_by, printed_rows, ship_of
from .rounding import spread_of

KEY = "dtc-cfd-waves"

_THIRD = (
    "the fit has a third harmonic that the table does not print; first and second alone give between 2 A1 and "
    "2 A1 + 4 A2^2/A1"
)
_OWN_FREQUENCY = (
    "each channel was fitted with a frequency of its own; the others of the run have 3.78 to 3.80 rad/s"
)
_OWN_FIT = "trim was fitted by itself; the means of stern and bow give another last digit"
_WRONG_AMPLITUDE = (
    "the coefficient is made non-dimensional with the first harmonic of the wave probe, which is not printed for this "
    "test: an amplitude of {needed:.1f} mm instead of the nominal {nominal:.2f} mm gives the print"
)


def cases() -> Iterator[Case]:
    """All cases of both papers."""
    yield from _frequencies()
    yield from _crest_to_trough()
    yield from _rigid_motions()
    yield from _motion_errors()
    yield from _calm_resistance()
    yield from _added_resistance()
    yield from _coefficients()


def _frequencies() -> Iterator[Case]:
    """The column headed 1/s holds rad/s: it is the encounter frequency of the wave length."""
    for key in ("dtc-cfd-motions", "dtc-wave-harmonics"):
        ship = ship_of(key)
        for row in printed_rows(key):
            test = str(row["test"])
            omega = encounter_frequency(WAVE_LENGTH * ship.L, depth_of(ship, CLEARANCES[test]), SPEEDS[test])
            # the wave length is printed in two digits: half of the last one is 1 % of it and 0.6 % of the frequency
            case = Case(
                KEY,
                _where(key, row),
                "frequency in rad/s, printed as 1/s",
                row["omega"],
                omega,
                _length_spread(ship, test) + half_digit(2),
            )
            yield case if case.verdict == "reproduced" else replace(case, note=_OWN_FREQUENCY)


def _length_spread(ship: Ship, test: str) -> float:
    depth = depth_of(ship, CLEARANCES[test])
    return spread_of(lambda length: encounter_frequency(length * ship.L, depth, SPEEDS[test]), (WAVE_LENGTH, 2))


def _where(key: str, row: dict[str, object]) -> str:
    table = "motions" if key == "dtc-cfd-motions" else "added resistance"
    return f"{table}, {row['test']} {row['quantity']}, {row['source']}"


def _crest_to_trough() -> Iterator[Case]:
    """Height of the fitted signal from its first two harmonics: a range, since their phases are not printed."""
    for key in ("dtc-cfd-motions", "dtc-wave-harmonics"):
        for row in printed_rows(key):
            first, second = float(row["first"]), float(row["second"])
            widest = 4.0 * second**2 / first
            spread = spread_of(lambda a, b: 2.0 * a + 2.0 * b**2 / a, (first, 2), (second, 2)) + half_digit(2)
            case = Case(
                KEY,
                _where(key, row),
                "crest to trough from the first two harmonics",
                row["height"],
                2.0 * first + 0.5 * widest,
                0.5 * widest + spread,
            )
            yield case if case.verdict == "reproduced" else replace(case, note=_THIRD)


def _rigid_motions() -> Iterator[Case]:
    """Mean heave and trim of a rigid hull follow from stern and bow."""
    length = ship_of("dtc-cfd-motions").L
    rows = {(row["test"], row["quantity"], row["source"]): row for row in printed_rows("dtc-cfd-motions")}
    for test in ("CW3", "CW4"):
        for source in ("CFD", "EFD"):
            stern, bow = (float(rows[test, end, source]["mean"]) for end in ("stern", "bow"))
            for quantity, unit, computed, spread in (
                ("heave", "mm", 0.5 * (stern + bow), half_digit(2)),
                ("trim", "mm/m", (stern - bow) / length, 2.0 * half_digit(2) / length),
            ):
                case = Case(
                    KEY,
                    f"motions, {test} {source}",
                    f"mean {quantity} from stern and bow in {unit}",
                    rows[test, quantity, source]["mean"],
                    computed,
                    spread + half_digit(2),
                )
                yield case if case.verdict == "reproduced" else replace(case, note=_OWN_FIT)


def _motion_errors() -> Iterator[Case]:
    """What the text says of the comparison."""
    rows = {(row["test"], row["quantity"], row["source"]): row for row in printed_rows("dtc-cfd-motions")}

    def pair(test: str, quantity: str, column: str) -> tuple[float, float]:
        return float(rows[test, quantity, "CFD"][column]), float(rows[test, quantity, "EFD"][column])

    for test, quantity, column, printed, decimals in (
        ("CW3", "heave", "mean", 1.5, 1),
        ("CW3", "bow", "mean", 3.0, 0),
        ("CW4", "heave", "first", 1.38, 2),
    ):
        s, d = pair(test, quantity, column)
        yield Case(
            KEY,
            f"motions, text on {test}",
            f"deviation of the {'mean' if column == 'mean' else 'first harmonic'} of {quantity} in mm",
            printed,
            abs(s - d),
            half_digit(decimals) + 2.0 * half_digit(2),
        )
    s, d = pair("CW4", "wave", "first")
    yield Case(
        KEY,
        "motions, text on CW4",
        "computed wave amplitude over the measured one, %",
        18.0,
        float(relative_errors([s], [d]).s_minus_d[0]),
        half_digit(0) + spread_of(lambda a, b: 100.0 * (a - b) / b, (s, 2), (d, 2)),
        note="Table 4 gives 11 % for the first harmonic and 12 % for mean and both harmonics together",
    )


def _calm_resistance() -> Iterator[Case]:
    for row in printed_rows("dtc-calm-resistance"):
        decimals = 1 if row["test"] == "C2" else 2
        s, d = float(row["computed"]), float(row["measured"])
        yield Case(
            KEY,
            f"added resistance, calm water {row['test']}",
            "size of the difference in %",
            row["difference"],
            float(relative_errors([s], [d]).absolute[0]),
            half_digit(2) + spread_of(lambda a, b: 100.0 * abs(a - b) / b, (s, 2), (d, decimals)),
        )
        yield Case(
            KEY,
            f"added resistance, calm water {row['test']}",
            "friction and pressure together in N",
            row["computed"],
            float(row["friction"]) + float(row["pressure"]),
            3.0 * half_digit(2),
        )


def _added_resistance() -> Iterator[Case]:
    """The total force agrees within 5 %, what the waves add does not."""
    waves, calm = printed_by("dtc-added-resistance", "test"), printed_by("dtc-calm-resistance", "test")
    for test, still in (("CW2", "C1"), ("CW5", "C3"), ("CW3", "C2")):
        row = waves[test]
        yield Case(
            KEY,
            f"added resistance, {test}",
            "computed, in waves less calm, in N",
            row["added"],
            float(row["computed"]) - float(calm[still]["computed"]),
            3.0 * half_digit(2),
        )
        yield Case(
            KEY,
            f"added resistance, {test}",
            "friction and pressure together in N",
            row["computed"],
            float(row["friction"]) + float(row["pressure"]),
            3.0 * half_digit(2),
        )
    total_s, total_d = float(waves["CW3"]["computed"]), float(waves["CW3"]["measured"])
    calm_d = float(calm["C2"]["measured"])
    yield Case(
        KEY,
        "added resistance, CW3",
        "measured, in waves less calm, in N (recomputed reference)",
        1.87,
        total_d - calm_d,
        1e-9,
    )
    yield Case(
        KEY,
        "added resistance, CW3",
        "(S-D)/D of the total resistance in %",
        4.6,
        float(relative_errors([total_s], [total_d]).s_minus_d[0]),
        half_digit(1) + spread_of(lambda s, d: 100.0 * (s - d) / d, (total_s, 2), (total_d, 2)),
    )
    added_s, added_d = float(waves["CW3"]["added"]), total_d - calm_d
    yield Case(
        KEY,
        "added resistance, CW3",
        "(S-D)/D of the added resistance in % (recomputed reference)",
        57.0,
        float(relative_errors([added_s], [added_d]).s_minus_d[0]),
        half_digit(0)
        + spread_of(lambda s, w, c: 100.0 * (s - w + c) / (w - c), (added_s, 2), (total_d, 2), (calm_d, 1)),
    )
    force = {
        (row["test"], row["source"]): row for row in printed_rows("dtc-wave-harmonics") if row["quantity"] == "X"
    }
    for test, source, column in (
        ("CW2", "CFD", "computed"),
        ("CW5", "CFD", "computed"),
        ("CW3", "CFD", "computed"),
    ):
        yield Case(
            KEY,
            f"added resistance, {test}",
            "computed resistance in Table 5 from the mean force in Table 4, in N",
            waves[test][column],
            -float(force[test, source]["mean"]),
            2.0 * half_digit(2),
        )


def _coefficients() -> Iterator[Case]:
    """The coefficient of added resistance with the wave amplitude that is known: nominal, or of the probe."""
    ship = ship_of("dtc-added-resistance")
    heights = printed_by("dtc-added-resistance-cases", "test")
    (probe,) = [
        float(row["first"])
        for row in printed_rows("dtc-wave-harmonics")
        if (row["quantity"], row["source"]) == ("wave", "CFD")
    ]
    for test, row in printed_by("dtc-added-resistance", "test").items():
        measured = test == "CW5"
        nominal = 0.5 * float(heights[test]["wave_height"])
        amplitude = probe if measured else nominal
        added, printed = float(row["added"]), float(row["coefficient"])

        def coefficient(force: float, height: float) -> float:
            return force / added_resistance_unit(ship, 1e-3 * height)

        needed = math.sqrt(added / (printed * added_resistance_unit(ship, 1e-3)))
        yield Case(
            KEY,
            f"added resistance, {test}",
            f"coefficient with the amplitude of {'the wave probe' if measured else 'half the wave height'}",
            printed,
            coefficient(added, amplitude),
            half_digit(2) + spread_of(coefficient, (added, 2), (amplitude, 2)),
            note="" if measured else _WRONG_AMPLITUDE.format(needed=needed, nominal=nominal),
        )
        if not measured:
            yield Case(
                KEY,
                f"added resistance, {test}",
                "wave amplitude in mm that the printed coefficient needs (recomputed reference)",
                35.75,
                needed,
                spread_of(
                    lambda force, c: math.sqrt(force / (c * added_resistance_unit(ship, 1e-3))),
                    (added, 2),
                    (printed, 2),
                )
                + half_digit(2),
            )


PAPER = Paper(
    KEY,
    "DTC container ship in shallow-water head waves by CFD (2019), motions and added resistance, 5th MASHCON, Ostend, "
    "pp. 49-56 and 220-229",
    cases,
)
