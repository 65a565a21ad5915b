"""A solver log of gigabytes: towtank in bounded memory, against the fastest reader of pandas on the same file.

Usage: python benchmarks/solver_log_speed.py [--size 2GB] [--folder DIR] [--repeat 3] [--forms plain,openfoam]

Two forms of the same history of forces (time and 18 columns, seven digits) are written, timed and deleted:

* ``plain``: a comma-separated monitor file. pandas reads it with its pyarrow engine and with its C engine; the faster
  one counts.
* ``openfoam``: rows of nested parentheses. No reader of pandas takes them; its C engine is given the bytes with blanks
  in the place of parentheses, which is the quickest way to numbers that pandas has (that replacement is in its time).

towtank takes every row of every column into means, deviations and extremes of blocks of time (``read_log_blocks``),
and hands out every row at full resolution (``iter_solver_log``). Each reading is a process of its own, started in
turns; the least time of the repetitions counts, from after the imports. Peak memory is the greatest resident size of
the process. Printed: time of pandas over time of towtank (above 0.5 is wanted) and peak memory (below 500 MB is
wanted).
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

COLUMNS = 18
STEP = 1e-4
BLOCK = 0.05
_ROWS = 20_000
"""Rows whose text is repeated, under running times, until the file is full."""


def write_log(path: Path, form: str, size: int) -> int:
    """Write a history of about `size` bytes; returns its number of rows."""
    rng = np.random.default_rng(6)
    values = rng.normal(size=(_ROWS, COLUMNS)) * 10.0 ** rng.integers(-3, 5, COLUMNS)
    if form == "plain":
        rows = [",".join(f"{value:.6e}" for value in row) for row in values]
        names = [f"Monitor {number}: Force {number} (N)" for number in range(COLUMNS)]
        head, gap = ",".join(f'"{name}"' for name in ["Physical Time: Physical Time (s)", *names]) + "\n", ","
    else:
        rows = []
        for row in values:
            vectors = [" ".join(f"{value:.6e}" for value in row[at : at + 3]) for at in range(0, COLUMNS, 3)]
            rows.append(f"(({') ('.join(vectors[:3])})) (({') ('.join(vectors[3:])}))")
        parts = "(pressure viscous porous)"
        head, gap = f"# Forces\n# CofR : (0 0 0)\n# Time forces{parts} moment{parts}\n", "\t"
    count = 0
    with open(path, "w", buffering=2**22) as file:
        file.write(head)
        while file.tell() < size:
            file.writelines(f"{(count + i) * STEP:.8g}{gap}{row}\n" for i, row in enumerate(rows, start=1))
            count += len(rows)
    return count


def by_blocks(path: Path) -> int:
    """towtank: means, deviations and extremes of blocks."""
    from towtank.formats import read_log_blocks

    return int(read_log_blocks(path, BLOCK).counts.sum())


def by_rows(path: Path) -> int:
    """towtank: every row at full resolution, some megabytes at a time."""
    from towtank.formats import iter_solver_log

    return sum(len(frame) for frame in iter_solver_log(path))


def by_pyarrow(path: Path) -> int:
    """pandas with its pyarrow engine."""
    import pandas as pd

    return len(pd.read_csv(path, engine="pyarrow"))


def by_c(path: Path) -> int:
    """pandas with its C engine."""
    import pandas as pd

    return len(pd.read_csv(path, engine="c"))


def by_c_without_groups(path: Path) -> int:
    """pandas with its C engine, parentheses replaced before."""
    import io

    import pandas as pd

    text = path.read_bytes().translate(bytes.maketrans(b"()\t", b"   "))
    return len(pd.read_csv(io.BytesIO(text), engine="c", sep=r"\s+", comment="#", header=None))


READERS: dict[str, Callable[[Path], int]] = {
    reader.__name__: reader for reader in (by_blocks, by_rows, by_pyarrow, by_c, by_c_without_groups)
}
OURS = ("by_blocks", "by_rows")
THEIRS = {"plain": ("by_pyarrow", "by_c"), "openfoam": ("by_c_without_groups",)}


def measure(reader: str, path: Path, small: Path) -> None:
    """Read `path` in this process and print time, rows and peak memory; `small` loads the libraries before."""
    READERS[reader](small)
    start = time.perf_counter()
    rows = READERS[reader](path)
    seconds = time.perf_counter() - start
    print(json.dumps({"seconds": seconds, "rows": rows, "megabytes": peak_memory()}))


def peak_memory() -> float:
    """Greatest resident size of this process in MB."""
    status = Path("/proc/self/status")
    if status.exists():
        # The resource usage of a process begins with that of the one that started it; this does not.
        own = next(int(line.split()[1]) for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    else:
        own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return own / 1024


def warm(path: Path) -> None:
    """Bring a file into the cache of the system, for all readers alike."""
    with open(path, "rb") as file:
        while file.read(2**24):
            pass


def in_process(reader: str, path: Path, small: Path) -> dict[str, float]:
    """The same in a process of its own."""
    command = [sys.executable, __file__, "--measure", reader, str(path), str(small)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{reader} failed: {done.stderr.strip().splitlines()[-1:]}")
    return json.loads(done.stdout)


def compare(form: str, size: int, folder: Path, repeat: int) -> None:
    """Write, time and delete one form."""
    path, small = folder / f"{form}.dat", folder / f"{form}_small.dat"
    if form == "plain":
        path, small = path.with_suffix(".csv"), small.with_suffix(".csv")
    rows = write_log(path, form, size)
    write_log(small, form, 2**21)
    print(f"\n{form}: {os.path.getsize(path) / 1e6:.0f} MB, {rows} rows of {COLUMNS + 1} columns")
    readers = OURS + THEIRS[form]
    seconds = dict.fromkeys(readers, float("inf"))
    peaks = dict.fromkeys(readers, 0.0)
    try:
        warm(path)
        for _ in range(repeat):
            for reader in readers:
                found = in_process(reader, path, small)
                if found["rows"] != rows:
                    raise SystemExit(f"{reader} read {found['rows']} of {rows} rows")
                seconds[reader] = min(seconds[reader], found["seconds"])
                peaks[reader] = max(peaks[reader], found["megabytes"])
    finally:
        path.unlink()
        small.unlink()
    for reader in readers:
        speed = size / 1e6 / seconds[reader]
        print(f"  {reader:20s} {seconds[reader]:8.2f} s  {speed:6.0f} MB/s  peak {peaks[reader]:6.0f} MB")
    best = min(THEIRS[form], key=lambda reader: seconds[reader])
    for reader in OURS:
        ratio = seconds[best] / seconds[reader]
        print(f"  speed of {reader} over pandas {best}: {ratio:.2f} (wanted: 0.5 or more)")
    print(f"  peak memory of towtank: {max(peaks[one] for one in OURS):.0f} MB (wanted: under 500 MB)")


def bytes_of(text: str) -> int:
    """``2GB``, ``200MB`` or a number of bytes."""
    for unit, factor in (("GB", 10**9), ("MB", 10**6)):
        if text.upper().endswith(unit):
            return int(float(text[: -len(unit)]) * factor)
    return int(text)


def main() -> None:
    """Run the comparison."""
    if sys.argv[1:2] == ["--measure"]:
        measure(sys.argv[2], Path(sys.argv[3]), Path(sys.argv[4]))
        return
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=bytes_of, default=bytes_of("2GB"))
    parser.add_argument("--folder", type=Path, default=None)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--forms", default="plain,openfoam")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=given.folder) as folder:
        for form in given.forms.split(","):
            compare(form, given.size, Path(folder), given.repeat)


if __name__ == "__main__":
    main()
