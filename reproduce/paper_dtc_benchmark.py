"""DTC in shallow water (MASHCON 2019): eleven codes, a simulator and the open model tests of one ship.

The paper of the codes prints values and no scores: the scores here are those that its tables give.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.variables import GRAVITY
from ..squat.fairway import MIDSHIP_COEFFICIENT, blockage
from ..squat.head_waves import met_wave
from ..squat.restoring_squat import stern_over_bow
from ..squat.restricted_flow import kreitner, level_drop
from ..verify import complex_error, phasor, relative_errors, score_codes
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_by, printed_rows, ship_of
from .rounding import spread_of

KEY = "dtc-benchmark"

_MEASURED = "Model tests"
_PANEL = ("DIFFRAC open water", "HYDROSTAR", "MOSES", "NEMOH", "WAMIT")
"""Panel codes without tank walls."""
_STRIP = ("OCTOPUS", "PDSTRIP", "SEAWAY")


def cases() -> Iterator[Case]:
    """All cases of the three papers."""
    yield from _mean_sinkage()
    yield from _motion_errors()
    yield from _rankings()
    yield from _waves_full_scale()
    yield from _waves_of_the_model()
    yield from _windows()
    yield from _repeats()
    yield from _added_resistance()
    yield from _simulator()
    yield from _simulated_wave()
    yield from _stern_over_bow()
    yield from _revolutions()
    yield from _tank_walls()


def _mean_sinkage() -> Iterator[Case]:
    rows = [row for row in printed_rows("dtc-mean-sinkage") if row["test"] in ("C1", "C2", "C3")]

    def of(code: str) -> dict[str, float]:
        return {f"{row['test']} {end}": float(row[f"{end}_{code}"]) for row in rows for end in ("stern", "bow")}

    table = score_codes(of("EFD"), {code: of(code) for code in ("SlenderFlow", "RAPID")}).set_index("code")
    reference = {
        "SlenderFlow": {"bias": -0.0110, "rms": 0.0209, "normalised_rms": 0.0583},
        "RAPID": {"bias": -0.0512, "rms": 0.0789, "normalised_rms": 0.2198},
    }
    said = {"bias": "mean error, m", "rms": "RMS error, m", "normalised_rms": "RMS error over RMS sinkage"}
    for code, numbers in reference.items():
        for name, value in numbers.items():
            yield Case(
                KEY,
                "mean sinkage, C1 to C3",
                f"{said[name]}, {code}",
                value,
                float(table[name].to_dict()[code]),
                half_digit(4),
            )
    for code, percent in (("SlenderFlow", 8.1), ("RAPID", 23.5)):
        computed = float(table["mean_absolute_percent"].to_dict()[code])
        yield Case(
            KEY, "mean sinkage, C1 to C3", f"mean relative error, %, {code}", percent, computed, half_digit(1)
        )
    yield Case(KEY, "mean sinkage, C1 to C3", "better code", "SlenderFlow", str(table.index[0]))


def _phasors(row: dict[str, object]) -> np.ndarray:
    """Stern and bow."""
    sizes = np.array([row["stern"], row["bow"]], dtype=float)
    return phasor(sizes, np.radians(np.array([row["stern_phase"], row["bow_phase"]], dtype=float)))


def _errors_of(test: str) -> dict[str, float]:
    """Complex error of each code in a test, best first."""
    rows = [row for row in printed_rows("dtc-motion-amplitudes") if row["test"] == test]
    (measured,) = [_phasors(row) for row in rows if row["code"] == _MEASURED]
    errors = {str(row["code"]): complex_error(_phasors(row), measured) for row in rows if row["code"] != _MEASURED}
    return dict(sorted(errors.items(), key=lambda item: item[1]))


_REFERENCE = {
    "CW1": {
        "DIFFRAC open water": 0.269,
        "DIFFRAC channel": 0.437,
        "HYDROSTAR": 0.247,
        "MOSES": 0.258,
        "NEMOH": 0.228,
        "OCTOPUS": 1.184,
        "PDSTRIP": 0.547,
        "SEAWAY Class. Ord.": 1.182,
        "SEAWAY Diff. Ord.": 0.384,
        "SEAWAY Class. Mod.": 1.182,
        "SEAWAY Diff. Mod.": 0.384,
        "WAMIT": 0.269,
    },
    "CW3": {
        "FATIMA": 0.481,
        "HYDROSTAR": 0.711,
        "OCTOPUS": 0.702,
        "PDSTRIP": 0.630,
        "SEAWAY Class. Ord.": 1.136,
        "SEAWAY Diff. Ord.": 0.376,
        "SEAWAY Class. Mod.": 0.690,
        "SEAWAY Diff. Mod.": 0.374,
    },
    "CW4": {
        "DIFFRAC open water": 0.475,
        "DIFFRAC channel": 0.181,
        "HYDROSTAR": 0.460,
        "MOSES": 0.551,
        "NEMOH": 0.452,
        "OCTOPUS": 1.107,
        "PDSTRIP": 0.961,
        "SEAWAY Class. Ord.": 0.858,
        "SEAWAY Diff. Ord.": 0.622,
        "SEAWAY Class. Mod.": 0.858,
        "SEAWAY Diff. Mod.": 0.622,
        "WAMIT": 0.458,
    },
}


def _motion_errors() -> Iterator[Case]:
    for test, reference in _REFERENCE.items():
        errors = _errors_of(test)
        for code, value in reference.items():
            yield Case(KEY, f"complex error, {test}", code, value, errors[code], half_digit(3))


def _rankings() -> Iterator[Case]:
    where = "rankings"
    for test, best in (("CW1", "NEMOH"), ("CW4", "DIFFRAC channel")):
        yield Case(KEY, where, f"best code in {test}", best, next(iter(_errors_of(test))))
    for test in ("CW1", "CW4"):
        errors = _errors_of(test)
        worst = max(errors[code] for code in _PANEL)
        best_strip = min(error for code, error in errors.items() if code.startswith(_STRIP))
        yield Case(
            KEY, where, f"panel codes without walls before strip theory in {test}", "yes", _yes(worst < best_strip)
        )
    for test in _REFERENCE:
        errors = _errors_of(test)
        better = all(errors[f"SEAWAY Diff. {kind}"] < errors[f"SEAWAY Class. {kind}"] for kind in ("Ord.", "Mod."))
        yield Case(KEY, where, f"diffraction loads before classical ones in {test}", "yes", _yes(better))
    by_code = {row["code"]: row for row in printed_rows("dtc-motion-amplitudes") if row["test"] == "CW3"}
    hidden, measured = by_code["SEAWAY Class. Mod."], by_code[_MEASURED]
    error = float(relative_errors([hidden["bow"]], [measured["bow"]]).s_minus_d[0])
    yield Case(KEY, where, "bow amplitude error of SEAWAY Class. Mod. in CW3, %", 0.0, error, half_digit(1))
    for test, heave, relative in (("CW1", 0.166, 0.782), ("CW3", 0.178, 0.515), ("CW4", 0.117, 0.635)):
        (row,) = [r for r in printed_rows("dtc-motion-amplitudes") if r["test"] == test and r["code"] == _MEASURED]
        stern, bow = (complex(z) for z in _phasors(row))
        yield Case(KEY, "measured motion", f"heave at midship, {test}", heave, abs(stern + bow) / 2, half_digit(3))
        yield Case(KEY, "measured motion", f"bow against stern, {test}", relative, abs(bow - stern), half_digit(3))


def _yes(fact: bool) -> str:
    return "yes" if fact else "no"


def _waves_full_scale() -> Iterator[Case]:
    """Wave number, length over that of the ship, and encounter, at 14.5 m of draught."""
    ship = ship_of("dtc-mean-sinkage")
    reference = {
        "CW1": (0.03240, 0.546, 13.00),
        "CW2": (0.03240, 0.546, 10.77),
        "CW3": (0.03240, 0.546, 8.38),
        "CW4": (0.03216, 0.550, 15.70),
        "CW5": (0.03216, 0.550, 12.58),
    }
    table = printed_by("dtc-motion-cases", "test")
    for test, (k, ratio, period) in reference.items():
        row = table[test]
        depth = ship.T * (1.0 + float(row["clearance"]) / 100.0)
        wave = met_wave(float(row["wave_period"]), depth, float(row["speed"]) * KNOT)
        for quantity, printed, computed in (
            ("wave number, rad/m", k, wave.wave_number),
            ("wave length over L", ratio, wave.length / ship.L),
            ("period of encounter, s", period, wave.period_of_encounter),
        ):
            yield Case(KEY, f"waves at full scale, {test}", quantity, printed, computed, 0.005 * printed)


def _waves_of_the_model() -> Iterator[Case]:
    reference = {"CW3": 0.890, "CW2": 1.144, "CW5": 1.330}
    table = printed_by("dtc-benchmark-waves", "test")
    for test, period in reference.items():
        row = table[test]
        wave = met_wave(float(row["period"]), float(row["depth"]), float(row["speed"]))
        computed = wave.period_of_encounter
        yield Case(KEY, f"waves of the model, {test}", "period of encounter, s", period, computed, half_digit(3))
    ship = ship_of("dtc-benchmark-waves")
    for test, ratio in (("CW3", 0.55), ("FW2", 0.40)):
        row = table[test]
        length = met_wave(float(row["period"]), float(row["depth"])).length / ship.L
        yield Case(KEY, f"waves of the model, {test}", "wave length over L", ratio, length, half_digit(2))


def _windows() -> Iterator[Case]:
    """Speed over the window of regular waves, from the carriage positions, and the cycles in it."""
    waves = printed_by("dtc-benchmark-waves", "test")
    for row in printed_rows("dtc-benchmark-windows"):
        length, time = float(row["x_end"]) - float(row["x_start"]), float(row["t_end"]) - float(row["t_start"])
        printed = float(row["speed"])
        yield Case(KEY, f"window of {row['test']}", "mean speed, m/s", printed, length / time, 0.005 * printed)
        wave = waves[row["test"]]
        met = met_wave(float(wave["period"]), float(wave["depth"]), float(wave["speed"]))
        enough = time / met.period_of_encounter >= 10.0
        yield Case(KEY, f"window of {row['test']}", "ten cycles or more", "yes", _yes(enough))


def _repeats() -> Iterator[Case]:
    """Heave, its scatter and the trim of 26 repeats from the four sensors."""
    sensors, motions = printed_by("dtc-benchmark-sensors", "sensor"), printed_by("dtc-benchmark-motions", "motion")
    length = ship_of("dtc-benchmark-motions").L
    corners = ("P1", "P2", "P3", "P4")
    for clearance in (100, 20):
        where = f"26 repeats, {clearance} % clearance"
        mean, sd = f"mean_{clearance}", f"sd_{clearance}"
        heave = float(np.mean([sensors[name][mean] for name in corners]))
        yield Case(KEY, where, "heave, mm", float(motions["heave"][mean]), heave, half_digit(2))
        scatter = math.sqrt(sum(float(sensors[name][sd]) ** 2 for name in corners)) / 4.0
        truncated = clearance == 20
        yield Case(
            KEY,
            where,
            "standard deviation of heave, mm",
            float(motions["heave"][sd]),
            scatter,
            half_digit(2),
            expected=0.04 if truncated else None,
            note="0.0354 mm is printed cut off, not rounded" if truncated else "",
        )
        bow, stern = float(motions["bow"][mean]), float(motions["stern"][mean])
        spread = spread_of(lambda b, s: (s - b) / length, (bow, 2), (stern, 2))
        printed = float(motions["trim"][mean])
        yield Case(KEY, where, "trim, mm/m", printed, (stern - bow) / length, spread + half_digit(2))


def _added_resistance() -> Iterator[Case]:
    sensors = printed_by("dtc-benchmark-sensors", "sensor")["X"]
    for clearance, decimals, uncertainty in ((100, 2, 0.03), (20, 2, 0.07)):
        computed = math.hypot(float(sensors[f"sd_{clearance}"]), float(sensors[f"sd_{clearance}"]))
        where = f"added resistance, {clearance} % clearance"
        yield Case(KEY, where, "standard uncertainty, N", uncertainty, computed, half_digit(decimals))
    # 2.06 N in waves of 0.90 L less the calm water value
    yield Case(KEY, "added resistance, 100 % clearance", "mean, N", 1.20, 2.06 + float(sensors["mean_100"]), 1e-9)
    calm = {
        str(row["case"]): row for row in printed_rows("dtc-simulator-squat") if row["quantity"] == "resistance"
    }
    (force,) = [r for r in printed_rows("dtc-simulator-waves") if (r["case"], r["quantity"]) == ("CW3", "X mean")]
    for side, value in (("measured", 1.49), ("simulated", 1.35)):
        added = -float(force[side]) - float(calm["C2"][side])
        yield Case(KEY, "added resistance, CW3 over C2", f"{side}, N", value, added, 1e-9)


def _simulator() -> Iterator[Case]:
    """Difference in per cent of the measurement, from the printed pairs; the print rounds to whole per cents."""
    for key in ("dtc-simulator-squat", "dtc-simulator-waves"):
        for row in printed_rows(key):
            pair = (float(row["simulated"]), 2), (float(row["measured"]), 2)
            computed = float(relative_errors([pair[0][0]], [pair[1][0]]).s_minus_d[0])
            spread = spread_of(lambda s, d: 100.0 * (s - d) / d, *pair)
            yield Case(
                KEY,
                f"simulator, {row['case']}",
                f"difference of {row['quantity']}, %",
                float(row["difference"]),
                computed,
                spread + half_digit(0),
            )


def _simulated_wave() -> Iterator[Case]:
    """The waves of CW4 are 0.55 ship lengths long, which the printed period does not give at that depth."""
    ship, row = ship_of("dtc-benchmark-waves"), printed_by("dtc-benchmark-waves", "test")["CW4"]
    depth, ratio = float(row["depth"]), 0.55

    def period(lengths: float) -> float:
        k = 2.0 * math.pi / (lengths * ship.L)
        return 2.0 * math.pi / math.sqrt(GRAVITY * k * math.tanh(k * depth))

    yield Case(
        KEY,
        "simulator, head of the table of CW4",
        "wave period in s",
        1.38,
        period(ratio),
        spread_of(period, (ratio, 2)) + half_digit(2),
        expected=float(row["period"]),
        note="the head repeats the wave of CW1; 1.66 s was measured",
    )


def _stern_over_bow() -> Iterator[Case]:
    """Equations 5 and 6 give one ratio for the hull; the simulated pairs give three."""
    rows = {(row["case"], row["quantity"]): row["simulated"] for row in printed_rows("dtc-simulator-squat")}
    pairs = {test: (float(rows[test, "stern"]), float(rows[test, "bow"])) for test in ("C1", "C2", "C3")}
    for test, printed in (("C1", 0.348), ("C2", 0.364), ("C3", 0.339)):
        stern, bow = pairs[test]
        coupling = (1.0 - stern / bow) / (1.0 + stern / bow)
        name = "pitch at the bow over heave (recomputed reference)"
        yield Case(KEY, f"simulator, {test}", name, printed, coupling, half_digit(3))
        # of a ship of length 1, whose restoring in heave and pitch are 1
        matrix = np.array([[1.0, 2.0 * coupling], [2.0 * coupling, 1.0]])
        ratio = stern_over_bow(matrix, 1.0)
        yield Case(KEY, f"simulator, {test}", "stern over bow by the restoring matrix", stern / bow, ratio, 1e-9)
    slow, fast = (pairs[test][0] / pairs[test][1] for test in ("C1", "C2"))
    spread = sum(spread_of(lambda s, b: s / b, *((value, 2) for value in pairs[test])) for test in ("C1", "C2"))
    yield Case(
        KEY,
        "simulator, equations 5 and 6",
        "stern over bow at 16 kn as at 6 kn",
        slow,
        fast,
        spread,
        note="the equations make the ratio a constant of the hull; the simulated pairs differ by more than rounding",
    )


def _revolutions() -> Iterator[Case]:
    rows = printed_rows("dtc-benchmark-revolutions")
    for row in rows:
        spread = spread_of(lambda u, n: u / (60.0 * n), (row["speed"], 3), (row["revolutions"], 2))
        computed = float(row["speed"]) / (60.0 * float(row["revolutions"]))
        where = f"Table 9, {row['revolutions']:g} rps"
        yield Case(KEY, where, "speed over revolutions a minute", row["ratio"], computed, spread + half_digit(5))
    speeds, revolutions = ([float(row[name]) for row in rows] for name in ("speed", "revolutions"))
    for speed, printed in ((0.327, 5.09), (0.872, 12.57)):
        computed = float(np.interp(speed, speeds, revolutions))
        name = "revolutions in rps (recomputed reference)"
        yield Case(KEY, f"Table 9, {speed:g} m/s", name, printed, computed, half_digit(2))


def _tank_walls() -> Iterator[Case]:
    """What the walls of the 7 m wide tank do by one-dimensional theory."""
    ship = ship_of("dtc-benchmark-waves")
    area = MIDSHIP_COEFFICIENT * ship.B * ship.T
    for test, speed, depth, share, gamma, drop in (
        ("C1", 0.327, 0.326, 0.040, 1.043, 0.48),
        ("C2", 0.872, 0.326, 0.040, 1.057, 4.55),
        ("C3", 0.327, 0.1956, 0.067, 1.077, 0.87),
    ):
        where = f"tank walls, {test}"
        ratio = blockage(area, 7.0 * depth)
        froude = speed / math.sqrt(GRAVITY * depth)
        found = kreitner(ratio, froude).gamma
        lower = 1000.0 * float(level_drop(depth, froude, found)[0])
        for name, printed, computed, decimals in (
            ("blockage", share, ratio, 3),
            ("Kreitner's gamma", gamma, float(found[0]), 3),
            ("drop of level in mm", drop, lower, 2),
        ):
            yield Case(KEY, where, f"{name} (recomputed reference)", printed, computed, half_digit(decimals))


PAPER = Paper(
    KEY,
    "DTC squat and motions in shallow water (2019): codes compared, open model tests, simulator, 5th MASHCON",
    cases,
)
