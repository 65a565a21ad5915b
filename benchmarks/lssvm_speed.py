"""LS-SVM of a uniformly sampled decay: towtank's Toeplitz routes against the dense system, in one run.

Usage: python benchmarks/lssvm_speed.py [--samples 8000] [--long 200000] [--repeat 3] [--eigen] [--full-dense]

Prints:

* the time of choosing gamma and sigma by exact leave-one-out over a 10 x 10 grid, the final fit included, over that
  of the dense route on the same grid. The dense route is timed on one point of the grid (Cholesky factor and diagonal
  of the inverse) and multiplied by 100; ``--eigen`` times one sigma of it too (one eigendecomposition, all gammas:
  minutes) and multiplies by 10, and ``--full-dense`` runs the Cholesky route over the whole grid;
* the difference of both solutions' coefficients at 2,000 samples;
* the time and the peak memory of one fit of a long record, leave-one-out included.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import statistics
import time
from collections.abc import Callable
from functools import partial

import numpy as np

GAMMAS = np.logspace(-1.0, 8.0, 10)
PERIOD = 10.0


def decay(samples: int, interval: float) -> tuple[np.ndarray, np.ndarray]:
    """Virtual roll decay in degrees with a period of 10 s and noise of 0.05 degrees."""
    t = np.arange(samples) * interval
    noise = 0.05 * np.random.default_rng(0).standard_normal(samples)
    return t, 10.0 * np.exp(-0.02 * t) * np.cos(2.0 * np.pi * t / PERIOD) + noise


def timed(work: Callable[[], object]) -> float:
    """Seconds that `work` takes."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def choose(t: np.ndarray, y: np.ndarray, sigmas: np.ndarray) -> None:
    """towtank: grid and final fit."""
    from towtank.identify.lssvm_curve import fit_lssvm_curve

    fit_lssvm_curve(t, y, gammas=GAMMAS, sigmas=sigmas, refine=False)


def one_dense_solve(t: np.ndarray, y: np.ndarray, sigma: float, gamma: float = 1e3) -> None:
    """Dense system, one gamma and sigma, with exact leave-one-out."""
    from towtank.identify.lssvm_dual import solve_dual
    from towtank.identify.lssvm_kernels import GaussianKernel

    solve_dual(GaussianKernel(sigma**2), t[:, None], y, np.ones(t.size), gamma)


def one_dense_spectrum(t: np.ndarray, y: np.ndarray, sigma: float) -> None:
    """Dense system, all gammas of one sigma, with exact leave-one-out."""
    from towtank.identify.lssvm_dual import dual_spectrum
    from towtank.identify.lssvm_kernels import GaussianKernel

    dual_spectrum(GaussianKernel(sigma**2), t[:, None], np.ones(t.size)).scores(y, GAMMAS, "loo")


def largest_difference(samples: int, sigmas: np.ndarray) -> float:
    """Largest difference of the kernel coefficients over the largest coefficient, gamma 1000."""
    from towtank.identify.lssvm_curve import fit_lssvm_curve
    from towtank.identify.lssvm_dual import solve_dual
    from towtank.identify.lssvm_kernels import GaussianKernel

    t, y = decay(samples, 0.1)
    worst = 0.0
    for sigma in sigmas:
        fast = fit_lssvm_curve(t, y, gamma=1e3, sigma=float(sigma)).alpha
        dense = solve_dual(GaussianKernel(sigma**2), t[:, None], y, np.ones(samples), 1e3).function.coef
        worst = max(worst, float(np.abs(fast - dense).max() / np.abs(dense).max()))
    return worst


def _long_fit(samples: int, sigma: float, queue: multiprocessing.Queue) -> None:
    from towtank.identify.lssvm_curve import fit_lssvm_curve

    t, y = decay(samples, 0.01)
    started = time.perf_counter()
    curve = fit_lssvm_curve(t, y, gamma=1e3, sigma=sigma)
    error = curve.loo_rmse
    seconds = time.perf_counter() - started
    queue.put((seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, curve.route, error))


def long_fit(samples: int, sigma: float) -> tuple[float, float, str, float]:
    """(seconds, peak MB, route, left-out error) of one fit in a process of its own."""
    context = multiprocessing.get_context("spawn")
    queue: multiprocessing.Queue = context.Queue()
    process = context.Process(target=_long_fit, args=(samples, sigma, queue))
    process.start()
    result = queue.get()
    process.join()
    return result


def main() -> None:
    """Run the benchmark and print its ratios."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=8000)
    parser.add_argument("--long", type=int, default=200_000)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--eigen", action="store_true", help="time the dense eigendecomposition too, minutes")
    parser.add_argument("--full-dense", action="store_true", help="run the dense grid in full, half an hour")
    options = parser.parse_args()
    # First, because a process inherits the peak memory of the one that starts it.
    for sigma in (0.1, 0.5, 2.5):
        seconds, peak, route, error = long_fit(options.long, sigma)
        print(
            f"{options.long} samples at 0.01 s, sigma {sigma} s ({route}): {seconds:.2f} s, peak {peak:.0f} MB, "
            f"left-out error {error:.4f} deg (wanted: 10 s, 1000 MB)"
        )

    interval = 20.0 * PERIOD / options.samples
    t, y = decay(options.samples, interval)
    # From a few steps to a quarter of the record: all that a user would let it try.
    sigmas = np.geomspace(16.0 * interval, 0.25 * t[-1], 10)
    choose(t[:500], y[:500], sigmas[:3])

    ours = statistics.median(timed(lambda: choose(t, y, sigmas)) for _ in range(options.repeat))
    solve = timed(lambda: one_dense_solve(t, y, float(sigmas[5])))
    print(
        f"{options.samples} samples, 10 gammas x 10 sigmas by exact leave-one-out: {ours:.2f} s (wanted: below 5)"
    )
    print(f"  dense, one solution {solve:.1f} s, 100 of them (extrapolated) {100 * solve:.0f} s")
    print(f"  ratio to the dense solve: {100 * solve / ours:.0f} (wanted: at least 200)", flush=True)
    if options.eigen:
        spectrum = timed(lambda: one_dense_spectrum(t, y, float(sigmas[5])))
        print(f"  dense, one eigendecomposition {spectrum:.1f} s, 10 of them (extrapolated) {10 * spectrum:.0f} s")
        print(f"  ratio to the dense eigendecomposition: {10 * spectrum / ours:.0f}", flush=True)
    if options.full_dense:
        pairs = [(float(s), float(g)) for s in sigmas for g in GAMMAS]
        whole = sum(timed(partial(one_dense_solve, t, y, s, g)) for s, g in pairs)
        print(f"  dense grid in full {whole:.0f} s, ratio {whole / ours:.0f}", flush=True)

    difference = largest_difference(2000, np.array([0.5, 1.0, 2.0, 4.0, 10.0]))
    print(f"2000 samples, coefficients differ from the dense ones by {difference:.1e} (wanted: below 1e-6)")


if __name__ == "__main__":
    main()
