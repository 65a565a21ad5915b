"""Runs of the open benchmark with the DTC model, and files that a test writes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

BENCHMARK = Path(__file__).resolve().parents[3] / "shared" / "data" / "squat_dtc_mashcon2019"


@pytest.fixture(scope="session")
def benchmark_run() -> Callable[[str], Path]:
    """``benchmark_run("C1")``: path of a run; skips where the files are not at hand."""

    def path(name: str) -> Path:
        file = BENCHMARK / f"{name}.dat"
        if not file.exists():
            pytest.skip("the benchmark runs are not at hand")
        return file

    return path


@pytest.fixture
def write_run(tmp_path: Path) -> Callable[..., Path]:
    """``write_run(time=..., bow=..., units={...})``: a tab-separated run file."""

    def write(units: dict[str, str] | None = None, name: str = "run.dat", **channels: np.ndarray) -> Path:
        given = {"time": "s", "u": "m/s", **(units or {})}
        heading = ["\t".join(channels), "\t".join(given.get(channel, "mm") for channel in channels)]
        rows = ["\t".join(f"{value:.6f}" for value in row) for row in np.column_stack(list(channels.values()))]
        file = tmp_path / name
        file.write_text("\n".join([*heading, *rows]) + "\n", encoding="utf-8")
        return file

    return write
