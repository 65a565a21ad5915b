"""Polynomial chaos for DTC in head waves (MASHCON 2019): two uncertain inputs, six runs, three responses."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from ..verify import ChaosExpansion, UncertainInput, fit_chaos, project_chaos, relative_errors, sample_statistics
from ..verify.chaos_basis import term_count
from ..verify.sampling import strata_hit
from .case import Case, Paper, half_digit
from .printed_numbers import printed_by, printed_rows
from .random_exponential import GRID, INPUTS, error_levels, exact_mean_and_sd, random_exponential
from .rounding import rounding_spread, spread_of

KEY = "dtc-chaos"

WAVE = (
    UncertainInput("wave_height", "normal", (62.35, 0.64)),
    UncertainInput("wave_period", "normal", (1.38, 0.01)),
)
"""Wave height in mm and period in s, with the spread of the measured cycles."""

OUTPUTS = {"heave": 4, "pitch": 4, "X": 4}
"""Responses and the decimals that are printed of them."""

_INPUT_STEPS = (half_digit(3), half_digit(3))

_MISPRINT = (
    "5.826 is printed; the printed means give 4.67, those with all digits 4.80, and the text calls polynomial chaos "
    "the closer method, which 5.826 against 5.127 contradicts: 4.826"
)

_LEVELS = (
    "of six samples for six coefficients: the fit passes through all points, and the tail of its error is that of "
    "hypercubes which hardly separate the coefficients, so that it depends on the generator of the samples"
)


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _sampling()
    for output in OUTPUTS:
        yield from _monte_carlo(output)
        yield from _chaos(output)
        yield from _coefficients(output)
    yield from _exact()
    yield from _projection()
    yield from _levels()


def runs() -> tuple[np.ndarray, dict[str, np.ndarray], dict[str, float]]:
    """Inputs of the six runs, shape (6, 2), their responses, and the measurement."""
    rows = printed_by("dtc-chaos-samples", "case")
    measured = rows.pop("EFD")
    inputs = np.array([[row["wave_height"], row["wave_period"]] for row in rows.values()], dtype=float)
    responses = {name: np.array([row[name] for row in rows.values()], dtype=float) for name in OUTPUTS}
    return inputs, responses, {name: float(measured[name]) for name in OUTPUTS}


def _sampling() -> Iterator[Case]:
    inputs, _, _ = runs()
    for name, hit in zip((one.name for one in WAVE), strata_hit(WAVE, inputs).tolist(), strict=True):
        yield Case(KEY, "Table 4, Latin hypercube of six", f"sixths of the distribution hit, {name}", 6, hit)
    for order, printed in ((1, 3), (2, 6)):
        yield Case(KEY, "text", f"coefficients, two inputs, order {order}", printed, term_count(2, order))
    yield Case(KEY, "Table 4", "samples for each coefficient, order 1", 2.0, len(inputs) / term_count(2, 1), 0.0)


def _published(output: str, method: str, corrected: bool = True) -> dict[str, float]:
    from ..datasets import load_table

    rows = load_table("dtc-chaos-results", corrected=corrected).frame.to_dict("records")
    (row,) = [row for row in rows if (row["output"], row["method"]) == (output, method)]
    return {str(key): value for key, value in row.items()}


def _size_of_error(mean: float, measured: float) -> float:
    """Size of (D - S)/D in per cent, as the tables print it."""
    return float(relative_errors([mean], [measured]).absolute[0])


def _monte_carlo(output: str) -> Iterator[Case]:
    """Mean and population standard deviation of the six runs: every printed digit."""
    _, responses, measured = runs()
    printed, decimals = _published(output, "Monte Carlo"), OUTPUTS[output]
    ours, where = sample_statistics(responses[output]), f"Tables 6 to 8, Monte Carlo, {output}"
    yield Case(KEY, where, "expected value", printed["mean"], round(ours.mean, decimals), 0.0)
    yield Case(KEY, where, "standard deviation", printed["sd"], round(ours.population_sd, decimals), 0.0)
    yield Case(
        KEY,
        where,
        "size of the error in %",
        printed["error"],
        _size_of_error(ours.mean, measured[output]),
        spread_of(_size_of_error, (ours.mean, decimals), (measured[output], decimals)) + half_digit(3),
    )


def _chaos(output: str) -> Iterator[Case]:
    inputs, responses, measured = runs()
    printed, decimals = _published(output, "polynomial chaos"), OUTPUTS[output]
    fit = fit_chaos(WAVE, inputs, responses[output], 1)
    spread = _spread(output, lambda one: [one.mean[0], one.sd[0]])
    where = f"Tables 6 to 8, polynomial chaos of order 1, {output}"
    for what, key, value, own in (
        ("expected value", "mean", float(fit.mean[0]), spread[0]),
        ("standard deviation", "sd", float(fit.sd[0]), spread[1]),
    ):
        yield Case(KEY, where, what, printed[key], value, float(own) + half_digit(decimals))
    as_printed = _published(output, "polynomial chaos", corrected=False)["error"]
    wrong = as_printed != printed["error"]
    error = _size_of_error(float(fit.mean[0]), measured[output])
    of_data = spread_of(lambda data: _size_of_error(float(fit.mean[0]), data), (measured[output], decimals))
    of_runs = 100.0 * float(spread[0]) / abs(measured[output])
    yield Case(
        KEY,
        where,
        "size of the error in %",
        as_printed,
        error,
        of_data + of_runs + half_digit(3),
        expected=printed["error"] if wrong else None,
        note=_MISPRINT if wrong else "",
    )


def _spread(output: str, of: Callable[[ChaosExpansion], list[float]]) -> np.ndarray:
    """How far the rounding of the printed runs can move a result of the regression."""
    inputs, responses, _ = runs()
    count = len(inputs)

    def result(numbers: np.ndarray) -> np.ndarray:
        samples = numbers[: 2 * count].reshape(count, 2)
        return np.array(of(fit_chaos(WAVE, samples, numbers[2 * count :], 1)))

    numbers = np.concatenate([inputs.ravel(), responses[output]])
    steps = [*np.tile(_INPUT_STEPS, count), *np.full(count, half_digit(OUTPUTS[output]))]
    return rounding_spread(result, numbers, steps)


def _coefficients(output: str) -> Iterator[Case]:
    inputs, responses, _ = runs()
    reference = printed_by("dtc-chaos-regression", "output")[output]
    fit = fit_chaos(WAVE, inputs, responses[output], 1)
    ours = {
        "height": float(fit.coefficients[1, 0]),
        "period": float(fit.coefficients[2, 0]),
        "r2": float(fit.r2[0]),
    }
    words = {
        "height": "coefficient of the wave height",
        "period": "coefficient of the wave period",
        "r2": "R squared",
    }
    for name, value in ours.items():
        decimals = 3 if name == "r2" else 7 if output == "X" else 8
        yield Case(
            KEY,
            f"regression of order 1, {output}",
            f"{words[name]} (recomputed reference)",
            float(reference[name]),
            value,
            half_digit(decimals) * (1 if name == "r2" else 10),
        )


def _exact() -> Iterator[Case]:
    rows = printed_rows("random-exponential")
    mean, sd = exact_mean_and_sd(np.array([row["x"] for row in rows], dtype=float))
    for row, own_mean, own_sd in zip(rows, mean.tolist(), sd.tolist(), strict=True):
        where = f"a exp(-b x), x = {row['x']:g}"
        yield Case(KEY, where, "mean in closed form (recomputed reference)", row["mean"], own_mean, half_digit(10))
        yield Case(KEY, where, "sd in closed form (recomputed reference)", row["sd"], own_sd, half_digit(10))


def _projection() -> Iterator[Case]:
    mean, sd = exact_mean_and_sd(GRID)
    fit = project_chaos(INPUTS, 2, lambda samples: random_exponential(samples, GRID), level=8)
    where = "a exp(-b x), Legendre projection of order 2, 0 <= x <= 10"
    largest = float(np.max(np.abs(fit.mean / mean - 1.0)))
    yield Case(KEY, where, "largest relative error of the mean", 0.0, largest, 1e-14)
    largest = float(np.max(np.abs(fit.sd / sd - 1.0)))
    yield Case(KEY, where, "largest relative error of the sd", 2.5e-4, largest, 0.5e-4)


def _levels() -> Iterator[Case]:
    """Reference levels have one digit and are of 200 hypercubes from another generator, which scatter themselves."""
    words = ("mean by regression", "sd by regression", "sd of the samples")
    for row in printed_rows("random-exponential-errors"):
        count = int(row["samples"])
        ours = error_levels(count, hypercubes=200 if count < 100 else 60)
        for name, what, value in zip(("mean", "sd", "plain_sd"), words, ours, strict=True):
            interpolates = count == 6 and name == "sd"
            yield Case(
                KEY,
                f"a exp(-b x), {count} samples, order 2",
                f"relative error of the {what}, 95 % (recomputed reference)",
                row[name],
                value,
                0.4 * row[name],
                note=_LEVELS if interpolates else "",
            )


PAPER = Paper(
    KEY,
    "Verification and validation versus uncertainty quantification in CFD: non-intrusive polynomial chaos for DTC in "
    "shallow-water head waves (2019), 5th MASHCON, Ostend, pp. 365-384",
    cases,
)
