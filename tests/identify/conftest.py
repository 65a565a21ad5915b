"""Noise with memory, and open measurements, for the tests of this room."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

Noise = Callable[..., np.ndarray]
OPEN_DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


@pytest.fixture(scope="session")
def ar1() -> Noise:
    """``ar1(rng, rho, n, channels)``: stationary AR(1) with unit innovations, shape (n, channels)."""

    def draw(rng: np.random.Generator, rho: float, n: int, channels: int) -> np.ndarray:
        warm_up = 400
        return lfilter([1.0], [1.0, -rho], rng.standard_normal((n + warm_up, channels)), axis=0)[warm_up:]

    return draw


@pytest.fixture(scope="session")
def squat_run() -> Callable[[str], dict[str, np.ndarray]]:
    """``squat_run("C2")``: channels of an open DTC run in shallow water, by name; skips where it is absent."""

    def read(name: str) -> dict[str, np.ndarray]:
        file = OPEN_DATA / "squat_dtc_mashcon2019" / f"{name}.dat"
        if not file.exists():
            pytest.skip("open measurements are not here")
        lines = file.read_text(encoding="latin-1").splitlines()
        names = [cell.strip() for cell in lines[0].split("\t") if cell.strip()]
        rows = [[float(cell) for cell in line.split("\t")[: len(names)]] for line in lines[2:] if line.strip()]
        return dict(zip(names, np.array(rows).T))

    return read
