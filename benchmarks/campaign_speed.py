"""A campaign of many runs: towtank from files to table, against pandas that only reads, and against a plain loop.

Usage: python benchmarks/campaign_speed.py [--runs 1000] [--samples 6000] [--folder DIR] [--repeat 3]

Prints three ratios:

* total time of ``towtank run`` (read, audit, reduce, fit, write) over the time pandas with pyarrow needs to read
  the same files on the same cores;
* the time after reading of the plain method (pandas and statsmodels in a loop: harmonics of every run, then one
  least-squares fit of all samples with the same exact kinematics and terms) over the time in which towtank yields
  the same (reduction on the same cores, and the fit; audit, comparisons and report, which the loop has not, are in
  the first ratio);
* the growth of memory from half of the runs to all of them (smaller campaigns do not load the compiled parser).
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import resource
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from towtank.pmm.run_reading import RunReader
    from towtank.pmm.run_types import Run

NAMES = ["time", "X", "Y", "N", "x", "y", "psi", "u", "v", "r", "torque", "rate"]


def write_campaign(folder: Path, runs: int, samples: int) -> Path:
    """Write a virtual campaign of `runs` files of `samples` rows and 12 channels; returns its campaign file."""
    from towtank.core import Conventions, DerivativeSet, Ship
    from towtank.formats.write import write_table
    from towtank.pmm import Run, prescribed_motion

    campaign = folder / "campaign.toml"
    if campaign.exists() and len(list(folder.glob("run_*.txt"))) == runs:
        return campaign
    folder.mkdir(parents=True, exist_ok=True)
    ship = Ship("DTMB 5512", L=3.048, B=0.41, T=0.136, volume=0.086, kzz=0.762, rho=1000.0)
    truth = DerivativeSet.from_values("truth", ship, TRUTH, Conventions(added_mass_coriolis="inside"))
    rng = np.random.default_rng(1)
    t = np.arange(samples) * 0.01
    rows = ["file,type,speed,drift_angle,frequency,sway_amplitude"]
    for number in range(runs):
        kind = ("static_drift", "pure_sway", "pure_yaw", "yaw_drift")[number % 4]
        drift = 0.0 if kind in ("pure_sway", "pure_yaw") else float(rng.uniform(-15, 15))
        omega = 0.0 if kind == "static_drift" else float(rng.uniform(0.6, 1.1))
        amplitude = 0.0 if kind == "static_drift" else float(rng.uniform(0.1, 0.35))
        run = Run(f"run_{number:04d}", kind, 1.531, math.radians(drift), frequency=omega, sway_amplitude=amplitude)
        at = prescribed_motion(run).at(t)
        forces = {name: force + rng.normal(0, 0.05, samples) for name, force in truth.forces(at).items()}
        columns = {
            "time": t,
            **forces,
            "x": at["x"],
            "y": at["y"],
            "psi": at["psi"],
            "u": at["surge"],
            "v": at["v"],
            "r": at["r"],
            "torque": rng.normal(0.2, 0.01, samples),
            "rate": rng.normal(8.0, 0.02, samples),
        }
        assert list(columns) == NAMES
        units = dict(zip(columns, ("s", "N", "N", "Nm", "m", "m", "rad", "m/s", "m/s", "rad/s", "Nm", "1/s")))
        columns = {name: np.round(values, 6) for name, values in columns.items()}
        write_table(folder / f"{run.name}.txt", columns, units)
        rows.append(f"{run.name}.txt,{kind},1.531,{drift},{omega},{amplitude}")
    (folder / "matrix.csv").write_text("\n".join(rows) + "\n")
    names = " ".join(f'"{name}",' for name in TRUTH)
    campaign.write_text(
        f"""[campaign]
name = "speed"
virtual = true

[ship]
name = "DTMB 5512"
L = 3.048
B = 0.41
T = 0.136
volume = 0.086
kzz = 0.762
rho = 1000.0
scale = 46.6

[conventions]
angle_unit = "deg"

[channels]
time = "time"
X = "X"
Y = "Y"
N = "N"
y = "y"
psi = "psi"
u = "u"
v = "v"
r = "r"

[[runs]]
matrix = "matrix.csv"

[fit]
terms = [{names}]
"""
    )
    return campaign


TRUTH = {
    "R0": 0.017, "Xvv": -0.142, "Xvr": 0.03, "Xrr": -0.028, "Yv": -0.3, "Yr": -0.0485, "Yvvv": -1.7875,
    "Yvvr": -1.7067, "Yvrr": -1.3683, "Yrrr": -0.452, "Yvdot": -0.1111, "Yrdot": -0.009, "Nv": -0.1628,
    "Nr": -0.0485, "Nvvv": -0.3284, "Nvvr": -0.5512, "Nvrr": -0.4011, "Nrrr": -0.0505, "Nvdot": -0.0131,
    "Nrdot": -0.007,
}  # fmt: skip


def towtank(campaign: Path) -> None:
    """The whole command, in this process."""
    from towtank.cli.main import main

    with tempfile.TemporaryDirectory() as out:
        try:
            main(["run", str(campaign), "--out", out, "--quiet"])
        except SystemExit as status:
            if status.code:
                raise RuntimeError(f"towtank run ended with status {status.code}") from None


def pandas_reads(campaign: Path) -> None:
    """Only read the files with pandas and pyarrow, all cores."""
    import pandas as pd

    for path in sorted(campaign.parent.glob("run_*.txt")):
        pd.read_csv(path, sep="\t", engine="pyarrow", skiprows=2, names=NAMES)


def reading_and_reducing(campaign: Path) -> tuple[float, float, float]:
    """Seconds that towtank takes to read alone, to read and reduce, and to fit; two processes."""
    from functools import partial

    from towtank.formats.stream import iter_records
    from towtank.pmm import Campaign
    from towtank.pmm.hull_fit import fit_hull
    from towtank.pmm.run_reading import RunReader

    loaded = Campaign.load(campaign)
    reader = RunReader(loaded.file, loaded.path, loaded.ship, loaded.conventions, large=True)
    plan = loaded._plan(reader)
    read, reduce = partial(_only_read, reader), partial(reader.read_and_reduce, plan=plan)
    reduce(loaded.runs[0])
    started = time.perf_counter()
    for _ in iter_records(loaded.runs, read, workers=2, processes=True):
        pass
    reading = time.perf_counter() - started
    started = time.perf_counter()
    runs = list(iter_records(loaded.runs, reduce, workers=2, processes=True))
    both = time.perf_counter() - started
    started = time.perf_counter()
    fit_hull(runs, loaded.file.fit, loaded.ship, name="speed", terms=loaded.file.fit.hull_terms())
    return reading, both, time.perf_counter() - started


def _only_read(reader: RunReader, run: Run) -> int:
    """Read, map and audit a run."""
    record, _ = reader._record(run)
    return len(record)


def plain_loop(campaign: Path) -> tuple[float, float]:
    """Pandas and statsmodels in a loop: (seconds of reading, seconds after reading).

    Each run: mean or harmonics of X, Y, N by statsmodels OLS, design matrix of the exact kinematics; then one OLS
    of all samples for each force.
    """
    import pandas as pd
    import statsmodels.api as sm

    matrix = pd.read_csv(campaign.parent / "matrix.csv")
    length, draught, rho = 3.048, 0.136, 1000.0
    reading = after = 0.0
    frames = []
    for row in matrix.itertuples():
        started = time.perf_counter()
        frame = pd.read_csv(campaign.parent / row.file, sep="\t", engine="pyarrow", skiprows=2, names=NAMES)
        reading += time.perf_counter() - started
        started = time.perf_counter()
        frame["udot"], frame["vdot"], frame["rdot"] = (
            np.gradient(frame[c], frame["time"]) for c in ("u", "v", "r")
        )
        speed = np.sqrt(frame["u"] ** 2 + frame["v"] ** 2)
        unit = 0.5 * rho * length * draught * speed**2
        scaled = pd.DataFrame({"X": frame["X"] / unit, "Y": frame["Y"] / unit, "N": frame["N"] / unit / length})
        v, r = frame["v"] / speed, frame["r"] * length / speed
        scaled["v"], scaled["r"] = v, r
        scaled["vdot"] = frame["vdot"] * length / speed**2
        scaled["rdot"] = frame["rdot"] * length**2 / speed**2
        if row.frequency > 0:
            basis = pd.DataFrame({"mean": np.ones(len(frame))})
            for k in (1, 2, 3):
                basis[f"c{k}"] = np.cos(k * row.frequency * frame["time"])
                basis[f"s{k}"] = np.sin(k * row.frequency * frame["time"])
            for name in "XYN":
                sm.OLS(frame[name], basis).fit()
        else:
            for name in "XYN":
                sm.OLS(frame[name], np.ones(len(frame))).fit()
        frames.append(scaled)
        after += time.perf_counter() - started
    started = time.perf_counter()
    data = pd.concat(frames, ignore_index=True)
    del frames
    v, r = data["v"], data["r"]
    surge = pd.DataFrame({"R0": -np.ones(len(data)), "Xvv": v**2, "Xvr": v * r, "Xrr": r**2})
    lateral = pd.DataFrame(
        {
            "v": v,
            "r": r,
            "vvv": v**3,
            "vvr": v**2 * r,
            "vrr": v * r**2,
            "rrr": r**3,
            "vd": data["vdot"],
            "rd": data["rdot"],
        }
    )
    sm.OLS(data["X"], surge).fit()
    sm.OLS(data["Y"], lateral).fit()
    sm.OLS(data["N"], lateral).fit()
    after += time.perf_counter() - started
    return reading, after


def timed(work: Callable[[], object]) -> float:
    """Seconds that `work` takes."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def _peak(campaign: str, queue: multiprocessing.Queue) -> None:
    towtank(Path(campaign))
    status = Path("/proc/self/status")
    if status.exists():
        # The resource usage of a process begins with that of the one that started it; this does not.
        own = next(int(line.split()[1]) for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    else:
        own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    queue.put(max(own, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss) / 1024)


def peak_memory(campaign: Path) -> float:
    """Peak memory in MB of the largest process of the whole command, started afresh."""
    context = multiprocessing.get_context("spawn")
    queue: multiprocessing.Queue = context.Queue()
    process = context.Process(target=_peak, args=(str(campaign), queue))
    process.start()
    peak = float(queue.get())
    process.join()
    return peak


def main() -> None:
    """Run the benchmark and print its ratios."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--samples", type=int, default=6000)
    parser.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir()) / "towtank-speed")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--skip-plain", action="store_true", help="leave out the plain loop")
    options = parser.parse_args()
    folder = options.folder / f"{options.runs}x{options.samples}"
    campaign = write_campaign(folder, options.runs, options.samples)
    size = sum(path.stat().st_size for path in folder.glob("run_*.txt")) / 1e6
    print(f"{options.runs} runs x {options.samples} samples x {len(NAMES)} channels, {size:.0f} MB of text")

    import pandas  # noqa: F401  both sides start with pandas imported

    ours, theirs = [], []
    for _ in range(options.repeat):
        theirs.append(timed(lambda: pandas_reads(campaign)))
        ours.append(timed(lambda: towtank(campaign)))
        print(
            f"  pandas reads {theirs[-1]:6.2f} s   towtank run {ours[-1]:6.2f} s   ratio {ours[-1] / theirs[-1]:.2f}"
        )
    ratio = statistics.median(a / b for a, b in zip(ours, theirs))
    print(f"total over pandas reading, median: {ratio:.2f} (wanted: at most 1.5)")

    some = options.runs // 2
    half = write_campaign(options.folder / f"{some}x{options.samples}", some, options.samples)
    small, large = peak_memory(half), peak_memory(campaign)
    print(f"peak memory: {small:.0f} MB for {some} runs, {large:.0f} MB for {options.runs}")

    if not options.skip_plain:
        reading, both, fitting = reading_and_reducing(campaign)
        own_after = max(both - reading, 1e-9) + fitting
        _, after = plain_loop(campaign)
        print(
            f"  after reading: plain loop {after:.2f} s, towtank {own_after:.2f} s (reduction {both - reading:.2f} s "
            f"beside {reading:.2f} s of reading, fit {fitting:.2f} s)"
        )
        print(f"plain loop over towtank after reading: {after / own_after:.1f} (wanted: at least 10)")


if __name__ == "__main__":
    main()
