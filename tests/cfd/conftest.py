"""Small OpenFOAM-shaped cases, and a small virtual sweep that several tests read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from towtank.cfd.grid_study import GridStudy
from towtank.cfd.shipped_sweep import run_virtual_sweep

Case = Callable[..., Path]
TIME = 0.1 * np.arange(1, 401)


@pytest.fixture
def case(tmp_path: Path) -> Case:
    """``case(name, x, y, ..., viscous=0.2)``: a case with these forces in solver axes over TIME."""

    def write(
        name: str = "case",
        x: np.ndarray | float = 10.0,
        y: np.ndarray | float = 2.0,
        z: np.ndarray | float = 30.0,
        moments: tuple[float, float, float] | None = (0.5, 0.25, 4.0),
        viscous: float | None = 0.2,
        cofr: str = "(0 0 0)",
        time: np.ndarray = TIME,
    ) -> Path:
        folder = tmp_path / name / "postProcessing" / "forces" / "0"
        folder.mkdir(parents=True)
        columns = [np.broadcast_to(np.asarray(values, dtype=float), time.shape) for values in (x, y, z)]
        _write(folder / "force.dat", time, np.column_stack(columns), viscous, cofr)
        if moments is not None:
            _write(folder / "moment.dat", time, np.tile(moments, (time.size, 1)), viscous, cofr)
        return tmp_path / name

    return write


def _write(file: Path, time: np.ndarray, total: np.ndarray, viscous: float | None, cofr: str) -> None:
    parts = ["total"] if viscous is None else ["total", "pressure", "viscous"]
    table = [total] if viscous is None else [total, (1.0 - viscous) * total, viscous * total]
    names = [f"{part}_{axis}" for part in parts for axis in "xyz"]
    rows = np.column_stack([time, *table])
    body = "\n".join("\t".join(f"{value:.9g}" for value in row) for row in rows)
    text = f"# Force\n# CofR                : {cofr}\n#\n# Time\t" + "\t".join(names) + f"\n{body}\n"
    file.write_text(text, encoding="utf-8")


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> GridStudy:
    """The virtual sweep that ``towtank demo cfd`` shows."""
    return run_virtual_sweep(tmp_path_factory.mktemp("sweep"))
