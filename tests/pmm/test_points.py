"""Tables of reduced points: any scaling, sign and origin gives the same runs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.core.conventions import HOME, Conventions
from towtank.core.errors import CampaignError, DatasetError, ReadError
from towtank.core.scales import force_unit
from towtank.pmm.campaign_file import Fit, Points, Reduction
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.points import read_points
from towtank.pmm.run_types import Run

CASES = [(-0.2, 0.0), (-0.1, 0.0), (0.0, 0.0), (0.1, 0.0), (0.2, 0.0)]
CASES += [(0.0, 0.2), (0.0, 0.4), (-0.1, 0.2), (-0.1, 0.4), (0.1, 0.2), (0.1, 0.3), (0.15, 0.4)]


def true_forces(hull, v: float, r: float, speed: float, reference: float = 0.0) -> dict[str, float]:
    """Forces in N about midship at v' = v/U and r' = r L/U of the reference point."""
    run = Run("x", "static_drift", speed, drift_angle=-math.asin(v), yaw_rate=r * speed / hull.ship.L)
    motion = prescribed_motion(run, reference).at(np.zeros(1))
    return {name: float(force[0]) for name, force in hull.forces(motion, approach_speed=speed).items()}


@pytest.fixture
def read(tmp_path, hull):
    """Runs of a table given as a frame."""

    def make(frame: pd.DataFrame, conventions: Conventions = HOME, reduction: Reduction | None = None, **points):
        frame.to_csv(tmp_path / "points.csv", index=False)
        wanted = Points(file="points.csv", **points)
        campaign = tmp_path / "campaign.toml"
        return read_points(wanted, hull.ship, conventions, tmp_path, campaign, reduction or Reduction())

    return make


def fitted(runs, hull):
    steady = [term for term in hull.terms if not {"vdot", "rdot"} & set(term.variables)]
    return fit_hull(runs, Fit(estimator="ols"), hull.ship, name="points", terms=steady).derivatives


def worst(derivatives, hull) -> float:
    return max(abs(derivatives[name] - hull[name]) for name in derivatives.names)


@pytest.mark.parametrize("scaling", ["LT", "L2", "dimensional"])
def test_points_of_any_scaling_give_the_derivatives_back(read, hull, scaling):
    rows = []
    for speed in (0.8, 1.6):
        for v, r in CASES:
            unit = {name: force_unit(name, scaling, hull.ship, speed) for name in "XYN"}
            forces = true_forces(hull, v, r, speed)
            row = {name: value / unit[name] for name, value in forces.items()}
            if scaling == "dimensional":
                row |= {"v": v * speed, "r": r * speed / hull.ship.L}
            else:
                row |= {"v": v, "r": r}
            rows.append(row | {"speed": speed})
    table = read(pd.DataFrame(rows), scaling=scaling)
    assert {run.run.kind for run in table.runs} == {"static_drift", "steady_yaw", "steady_yaw_drift"}
    assert worst(fitted(table.runs, hull), hull) < 1e-10
    first = true_forces(hull, *CASES[0], 0.8)
    assert table.runs[0].forces["Y"][0] == pytest.approx(first["Y"])
    assert len(table.sha256) == 64


def test_signs_angles_and_primes_of_another_laboratory(read, hull):
    rows = []
    for v, r in CASES:
        forces = true_forces(hull, v, r, 1.0)
        scaled = {name: -value / force_unit(name, "LT", hull.ship, 1.0) for name, value in forces.items()}
        # y to port turns Y and N once more; beta = atan(v/u) with v to port is atan(-v/u) at home
        rows.append(
            {
                "beta": math.degrees(-math.asin(v)),
                "rprime": -r,
                "X": scaled["X"],
                "Y": -scaled["Y"],
                "N": -scaled["N"],
            }
        )
    odd = HOME.but(axes="forward-port-up", force_sign="by-ship", angle_unit="deg", drift_sign="+v")
    table = read(pd.DataFrame(rows), odd)
    assert worst(fitted(table.runs, hull), hull) < 1e-10


@pytest.mark.parametrize("speed_scale", ["instantaneous"])
def test_moment_and_motion_about_another_point(read, hull, speed_scale):
    place, lever = 0.4, -0.3
    rows = []
    for v, r in CASES:
        forces = true_forces(hull, v, r, 1.2, place)
        forces["N"] -= lever * forces["Y"]
        scaled = {name: value / force_unit(name, "LT", hull.ship, 1.2) for name, value in forces.items()}
        rows.append({"v": v, "r": r, "speed": 1.2} | scaled)
    settings = Reduction(moment_x=lever, position_x=place, nondimensional_speed=speed_scale)
    table = read(pd.DataFrame(rows), HOME, settings)
    assert worst(fitted(table.runs, hull), hull) < 1e-10
    with pytest.raises(CampaignError, match="moving the moment to midship needs Y"):
        read(pd.DataFrame(rows).drop(columns="Y"), HOME, settings)


def test_further_columns_set_the_run(read):
    frame = pd.DataFrame(
        {
            "drift_angle": [3.0, -3.0],
            "rudder_angle": [10.0, -10.0],
            "heel": [5.0, 0.0],
            "depth": [0.2, 0.3],
            "bank_position": [0.5, 0.0],
            "Y": [0.01, 0.02],
        }
    )
    table = read(frame, HOME.but(angle_unit="deg", rudder_sign="port"))
    first = table.runs[0]
    assert [run.name for run in table.runs] == ["points 1", "points 2"]
    assert first.run.drift_angle == pytest.approx(math.radians(3))
    assert first.run.rudder_angle == pytest.approx(math.radians(-10))
    assert first.run.heel == pytest.approx(math.radians(5))
    assert (first.run.bank_position, first.ship.depth) == (0.5, 0.2)


def test_uncertainty_of_a_row_then_of_a_force_then_as_a_share(read):
    frame = pd.DataFrame({"v": [0.1, 0.2], "Y": [-0.03, -0.07], "N": [-0.02, -0.03]})
    both = {"relative_sd": 0.1, "sd": {"N": 0.004}}
    (first, _) = read(frame, **both).runs
    assert first.scaled_sd["Y"][0] == pytest.approx(0.003)
    assert first.scaled_sd["N"][0] == 0.004
    own = read(frame.assign(Y_sd=[0.001, 0.002]), **both).runs[1]
    assert own.scaled_sd["Y"][0] == 0.002
    assert math.isnan(read(frame).runs[0].scaled_sd["Y"][0])


def test_a_published_table(hull):
    points = Points(table="dtc-drift-points-63", columns={"X": "X_EFD", "Y": "Y_EFD", "N": "N_EFD"})
    table = read_points(points, hull.ship, HOME, Path("."), Path("campaign.toml"), Reduction())
    assert len(table.runs) == 5
    assert (table.sha256, table.findings) == ("", ())


def test_findings_of_the_reader_are_passed_on(tmp_path, hull):
    (tmp_path / "points.csv").write_text("# rho: 1025\nv;Y\n0,1;-0,03\n\n0,2;-0,07\n", encoding="utf-8")
    table = read_points(
        Points(file="points.csv"), hull.ship, HOME, tmp_path, tmp_path / "campaign.toml", Reduction()
    )
    assert {item.rule for item in table.findings} == {"decimal-comma", "blank-rows", "density"}
    assert table.runs[1].scaled["Y"][0] == -0.07


GOOD = {"v": [0.1], "Y": [-0.03]}
MISTAKES = {
    "no force": ({"v": [0.1]}, {}, "the table of points has no force column X, Y or N"),
    "no motion": ({"Y": [0.1]}, {}, "the table of points has no v, beta or r"),
    "mapped column missing": (GOOD, {"columns": {"N": "Mz"}}, "the table of points has no column 'Mz'"),
    "missing value": ({"v": [0.1, 0.2], "Y": [0.1, math.nan]}, {}, "points.csv, row 2: Y is missing"),
    "v above U": ({"v": [3.4], "Y": [0.1]}, {}, "points.csv, row 1: the sway velocity is 3.4 times the speed"),
    "no speed": (GOOD | {"speed": [0.0]}, {}, "speed 0.0 m/s is not positive"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_names_the_row_the_cause_and_the_cure(mistake, read, tmp_path):
    frame, points, said = MISTAKES[mistake]
    with pytest.raises(CampaignError) as caught:
        read(pd.DataFrame(frame), **points)
    line = str(caught.value)
    assert line.startswith(str(tmp_path / "campaign.toml"))
    assert said in line
    assert " -> " in line


def test_tables_that_are_not_there(tmp_path, hull):
    def read(points: Points):
        return read_points(points, hull.ship, HOME, tmp_path, tmp_path / "campaign.toml", Reduction())

    with pytest.raises(ReadError, match=r"none\.csv: file not found"):
        read(Points(file="none.csv"))
    with pytest.raises(DatasetError, match="dtc-drift"):
        read(Points(table="dtc-drift-pionts"))
    for points in (Points(), Points(file="a.csv", table="b")):
        with pytest.raises(CampaignError, match="give the file of a table, or the key"):
            read(points)
