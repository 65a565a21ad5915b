from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.cfd.case_loads import AXES, LoadChoices, case_loads
from towtank.core.errors import ConventionError, ReadError
from towtank.formats import read_solver_case


def loads_of(folder, choices=None, **more):
    return case_loads(read_solver_case(folder), choices, **more)


def means(loads) -> dict[str, float]:
    return {name: float(values.mean()) for name, values in loads.channels.items()}


@pytest.mark.parametrize(
    ("axes", "expected"),
    [
        ("x-forward-z-down", {"X": 10, "Y": 2, "Z": 30, "K": 0.5, "M": 0.25, "N": 4}),
        ("x-aft-z-up", {"X": -10, "Y": 2, "Z": -30, "K": -0.5, "M": 0.25, "N": -4}),
        ("x-forward-z-up", {"X": 10, "Y": -2, "Z": -30, "K": 0.5, "M": -0.25, "N": -4}),
        ("x-aft-z-down", {"X": -10, "Y": -2, "Z": 30, "K": -0.5, "M": -0.25, "N": 4}),
    ],
)
def test_axes_to_home(case, axes, expected):
    found = means(loads_of(case(), LoadChoices(axes=axes)))
    assert {name: pytest.approx(value) for name, value in expected.items()} == {n: found[n] for n in expected}


def test_every_choice_of_axes_is_a_rotation():
    assert all(math.prod(signs) == 1 for signs in AXES.values())


def test_parts_are_kept_and_add_up(case):
    loads = loads_of(case())
    for name in loads.loads:
        both = loads.channels[f"{name}_pressure"] + loads.channels[f"{name}_viscous"]
        np.testing.assert_allclose(both, loads.channels[name])
    assert loads.conventions.force_scaling == "dimensional"
    assert "X_viscous [N]" in loads.to_frame().columns
    assert "N_pressure [N m]" in loads.to_frame().columns


def test_density_of_an_incompressible_solver(case):
    folder = case()
    plain, dense = means(loads_of(folder)), means(loads_of(folder, LoadChoices(density=998.8)))
    assert dense == {name: pytest.approx(998.8 * value) for name, value in plain.items()}


def test_half_model_doubles_what_a_half_can_tell(case):
    folder = case()
    whole, half = means(loads_of(folder)), loads_of(folder, LoadChoices(half_model=True))
    assert half.loads == ("X", "Z", "M")
    assert means(half) == {name: pytest.approx(2.0 * whole[name]) for name in half.channels}
    assert any("half model" in step for step in half.steps)


def test_moment_is_moved_to_midship(case):
    # Y = 2 N (solver) at the point of the moments; midship 3 m further aft along x: N grows by the lever.
    folder = case(cofr="(1.0 0 0.5)")
    found = means(loads_of(folder, LoadChoices(axes="x-forward-z-down", midship=(-2.0, 0.0, 0.5))))
    assert found["N"] == pytest.approx(4.0 + 3.0 * 2.0)
    assert found["M"] == pytest.approx(0.25 - 3.0 * 30.0)
    assert found["K"] == pytest.approx(0.5)
    given = LoadChoices(axes="x-forward-z-down", moment_point=(1.0, 0.0, 0.0), midship=(1.0, 0.0, 0.0))
    assert means(loads_of(folder, given))["N"] == pytest.approx(4.0)


def test_hull_turned_in_the_mesh(case):
    # Axes along the track; the hull heads 30 deg to starboard of it (beta > 0).
    beta = math.radians(30.0)
    folder = case()
    track = LoadChoices(axes="x-forward-z-down", hull_turned=True)
    found = means(loads_of(folder, track, drift_angle=beta))
    assert found["X"] == pytest.approx(10.0 * math.cos(beta) + 2.0 * math.sin(beta))
    assert found["Y"] == pytest.approx(-10.0 * math.sin(beta) + 2.0 * math.cos(beta))
    assert found["N"] == pytest.approx(4.0)
    assert math.hypot(found["X"], found["Y"]) == pytest.approx(math.hypot(10.0, 2.0))


def test_missing_viscous_part_is_told(case):
    loads = loads_of(case(viscous=None))
    assert "X_viscous" not in loads.channels
    assert any("viscous" in note for note in loads.notes)


def test_missing_moments_leave_the_forces(case):
    assert loads_of(case(moments=None)).loads == ("X", "Y", "Z")


def test_monitor_columns_by_name(tmp_path):
    file = tmp_path / "monitors.csv"
    rows = "\n".join(f"{0.1 * k:.1f},5.0,1.5,2.0" for k in range(60))
    file.write_text(f'"Time (s)","Drag (N)","Side (N)","Yaw (N-m)"\n{rows}\n')
    with pytest.raises(ReadError, match="which of its columns are forces") as raised:
        case_loads(read_solver_case(file))
    assert "Drag" in raised.value.cure
    columns = {"Fx_total": "Drag", "Fy_total": "Side", "Mz_total": "Yaw"}
    loads = case_loads(read_solver_case(file, channels=columns), LoadChoices(columns=columns))
    assert means(loads) == {"X": -5.0, "Y": 1.5, "N": -2.0}
    with pytest.raises(ReadError, match="without all three forces"):
        case_loads(
            read_solver_case(file, channels=columns),
            LoadChoices(moment_point=(1.0, 0.0, 0.0), columns=columns),
        )


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ({"axes": "x-left"}, "are not a choice"),
        ({"density": 0.0}, "not positive"),
        ({"columns": {"Fq": "a"}}, "not a load of a solver"),
    ],
)
def test_choices_that_mean_nothing(choice, message):
    with pytest.raises(ConventionError, match=message):
        LoadChoices(**choice)
