"""Campaigns from files to derivatives: every hull model and every habit of a laboratory gives the truth back."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import CampaignError, FitError
from towtank.core.hull_models import hull_model
from towtank.core.terms import parse_terms
from towtank.formats.channels import rotate_to_model
from towtank.formats.read import read_table
from towtank.formats.write import write_table
from towtank.pmm.audit_rules import RULES
from towtank.pmm.campaign import Campaign
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.rigid_body import RigidBody
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import circular, pure_sway, pure_yaw, standard_matrix, static_drift
from towtank.pmm.virtual_campaign import synthesize

QUICK = Laboratory(sampling_rate=10.0, duration=8.0, cycles=2)
BODY = RigidBody(mass=92.0, xG=0.04, Izz=60.0)
SPEED = 1.5
MATRIX = [
    *static_drift((-12, -8, -4, 0, 4, 8, 12), SPEED),
    *pure_sway((0.1, 0.3), 0.9, SPEED),
    *pure_yaw((0.1, 0.2, 0.3), 0.9, SPEED),
    *pure_yaw((0.15, 0.3), 0.9, SPEED, (-8.0, 6.0)),
]


def write(folder: Path, truth, runs=MATRIX, laboratory=QUICK, **more) -> Path:
    return synthesize(truth, runs, folder / "campaign", name="twin", laboratory=laboratory, **more)


def edit(path: Path, *changes: tuple[str, str], end: str = "") -> Path:
    """Replace texts of a campaign file and add to its end."""
    text = path.read_text()
    for old, new in changes:
        assert old in text, text
        text = text.replace(old, new)
    path.write_text(text + end)
    return path


def rewrite(path: Path, change: Callable[[dict[str, np.ndarray]], None]) -> None:
    """Change the columns of every run file, the zero run included."""
    for file in sorted((path.parent / "runs").glob("*.txt")):
        table = read_table(file)
        columns = {name: values.copy() for name, values in table.columns.items()}
        change(columns)
        write_table(file, columns, table.units)


def worst(derivatives: DerivativeSet, truth: DerivativeSet) -> float:
    """Largest difference from the truth over the terms of both, which must be the same."""
    assert set(derivatives.names) == set(truth.names)
    return max(abs(derivatives[name] - truth[name]) for name in truth.names)


def run(path: Path, **more):
    return Campaign.load(path).run(compare=False, **more)


# -- models --------------------------------------------------------------------------------------------------


def invented(names, ship, **conventions) -> DerivativeSet:
    """A set whose coefficients are random, of either sign."""
    names = [term.name for term in names]
    random = np.random.default_rng(len(names))
    values = random.uniform(0.02, 0.4, len(names)) * random.choice([-1.0, 1.0], len(names))
    choices = HOME.but(added_mass_coriolis="inside", **conventions)
    return DerivativeSet.from_values("invented", ship, dict(zip(names, values, strict=True)), choices)


def heeled(ship):
    speed, angles = 0.6, (-15, -8, 0, 5, 12)
    return [
        replace(run, name=f"{run.name} heel {heel}", heel=math.radians(heel))
        for heel in (-6, 0, 5, 10)
        for run in circular(angles, [-0.3, 0, 0.15, 0.3], speed, ship.L)
    ]


MODELS = {
    "mmg": ({}, lambda ship: MATRIX),
    "abkowitz": ({"velocity_scale": "approach"}, lambda ship: standard_matrix("general", ship)),
    "modulus": ({}, lambda ship: MATRIX),
    "inland": ({"sway_variable": "beta"}, lambda ship: standard_matrix("inland", ship)),
    "heel": ({}, heeled),
    "bank": ({}, lambda ship: standard_matrix("pcc-bank", ship)),
}


@pytest.mark.parametrize("model", MODELS)
def test_a_noise_free_campaign_gives_every_coefficient_of_the_model_back(model, tmp_path, ship):
    conventions, matrix = MODELS[model]
    truth = invented(hull_model(model), ship, **conventions)
    result = run(write(tmp_path, truth, matrix(ship), fit_terms=model), accept_rules=RULES)
    assert worst(result.derivatives, truth) < 1e-8
    assert result.settings.fit.model == model
    assert result.derivatives.conventions.sway_variable == truth.conventions.sway_variable


def test_a_list_of_terms_of_the_user(tmp_path, ship):
    names = ["R0", "Xvv", "Yv", "Yv|v|", "Yr", "Yvvr", "Yvdot", "Nv", "N|v|v", "Nr|r|", "Nr", "Nrdot", "Yrdot"]
    truth = invented(parse_terms(names), ship)
    result = run(write(tmp_path, truth, fit_terms=names), accept_rules=RULES)
    assert worst(result.derivatives, truth) < 1e-8


def test_terms_are_chosen_by_the_runs_when_none_are_named(tmp_path, hull):
    path = write(tmp_path, hull)
    edit(path, ('model = "mmg"', "staged = false"))
    assert worst(run(path).derivatives, hull) < 1e-8


@pytest.mark.parametrize(
    "settings",
    ['domain = "time"', "staged = true", 'estimator = "ols"', 'estimator = "huber"', 'estimator = "constrained"'],
)
def test_every_way_to_fit_gives_the_truth_of_noise_free_data(settings, tmp_path, hull):
    path = edit(write(tmp_path, hull), ("[fit]", f"[fit]\n{settings}"))
    assert worst(run(path).derivatives, hull) < 1e-8


# -- laboratories --------------------------------------------------------------------------------------------

ODD = HOME.but(axes="forward-port-up", force_sign="by-ship", angle_unit="deg", drift_sign="+v")
LABORATORIES = {
    "inertia inside": {"inertia": BODY},
    "moment about another point": {"moment_x": 0.7},
    "path of another point": {"position_x": -0.5},
    "about the centre of gravity": {"conventions": HOME.but(origin="cog")},
    "y to port": {"conventions": HOME.but(axes="forward-port-up")},
    "forces of the ship": {"conventions": HOME.but(force_sign="by-ship")},
    "everything otherwise": {"conventions": ODD, "inertia": BODY, "moment_x": 0.3, "position_x": 0.2},
    "transients and a zero run": {
        "rest": 2.0,
        "ramp": 3.0,
        "startup_cycles": 1,
        "balance_zero": {"X": 1.0, "Y": -4.0, "N": 2.0},
    },
}


@pytest.mark.parametrize("habit", LABORATORIES)
def test_habits_of_a_laboratory_are_undone(habit, tmp_path, hull):
    truth = replace(hull, ship=replace(hull.ship, xG=-0.06))
    path = write(tmp_path, truth, laboratory=replace(QUICK, **LABORATORIES[habit]))
    result = run(path, accept_rules=["scale-label"])
    assert worst(result.derivatives, truth) < 1e-8
    errors = {item.rule for item in result.findings if item.severity == "error"}
    assert errors <= {"scale-label"}


def test_the_origin_of_the_conventions_stands_for_the_points_of_the_reduction(tmp_path, hull):
    path = write(tmp_path, hull, laboratory=replace(QUICK, conventions=HOME.but(origin=0.1)))
    edit(path, ("position_x = 0.3048", ""), ("moment_x = 0.3048", ""))
    assert worst(run(path).derivatives, hull) < 1e-8


def test_a_zero_level_from_the_rest_before_the_run(tmp_path, hull):
    zero = {"X": 3.0, "Y": -4.0, "N": 2.0}
    steady = [one for one in MATRIX if not one.harmonic]
    names = ["R0", "Xvv", "Xvvvv", "Yv", "Yvvv", "Nv", "Nvvv"]
    laboratory = replace(QUICK, rest=2.0, ramp=3.0, balance_zero=zero)
    path = write(tmp_path, hull.subset(names), steady, laboratory)
    text = path.read_text()
    path.write_text(text[: text.index("tare = ")])
    edit(path, ("[reduction]", "[reduction]\ntare_window = [0.0, 1.5]"))
    result = run(path)
    assert worst(result.derivatives, hull.subset(names)) < 1e-8
    assert "zero level of 0-1.5 s subtracted" in result.runs[0].steps


@pytest.mark.parametrize("psi", ["recorded", "prescribed"])
@pytest.mark.parametrize("axes", ["forward-starboard-down", "forward-port-up"])
def test_forces_in_the_axes_of_the_carriage(psi, axes, tmp_path, hull):
    """The balance is on the carriage; its zero is turned with the model."""
    zero = {"X": 5.0, "Y": -8.0, "N": 3.0}
    path = write(tmp_path, hull, laboratory=replace(QUICK, conventions=HOME.but(axes=axes)))
    edit(path, ("[channels]", '[channels]\nforces = "carriage-fixed"'))
    edit(path, ('matrix = "matrix.csv"', 'matrix = "matrix.csv"\ntare = "runs/zero.txt"'))

    def on_the_carriage(columns):
        columns["X"], columns["Y"] = rotate_to_model(columns["X"], columns["Y"], -columns["psi"])
        for name, level in zero.items():
            columns[name] = columns[name] + level

    rewrite(path, on_the_carriage)
    still = read_table(next((path.parent / "runs").glob("*.txt")))
    columns = {name: np.zeros(20) for name in still.columns} | {"time": np.arange(20.0)}
    columns |= {name: np.full(20, level) for name, level in zero.items()}
    write_table(path.parent / "runs" / "zero.txt", columns, still.units)
    if psi == "prescribed":
        edit(path, ('psi = { column = "psi", unit = "rad" }\n', ""))
    assert worst(run(path).derivatives, hull) < 1e-8


def test_crosstalk_gains_units_signs_and_offsets_of_the_channels(tmp_path, hull):
    """Volts and kilonewtons that disturb each other become the forces again."""
    matrix = np.array([[1.0, 0.02, -0.01], [0.03, 1.0, 0.02], [0.0, -0.01, 1.0]])
    path = write(tmp_path, hull)

    def disturbed(columns):
        x, y, n = np.linalg.solve(matrix, np.array([columns[name] for name in "XYN"]))
        columns["X"], columns["Y"], columns["N"] = (x + 3.0) / 250.0, -y / 1000.0, n

    rewrite(path, disturbed)
    edit(
        path,
        ('X = { column = "X", unit = "N" }', 'X = { column = "X", unit = "N", gain = 250.0, offset = -3.0 }'),
        ('Y = { column = "Y", unit = "N" }', 'Y = { column = "Y", unit = "kN", sign = -1 }'),
        ("[channels]", f"[channels]\ncrosstalk = {matrix.tolist()}\ncrosstalk_channels = ['X', 'Y', 'N']"),
    )
    assert worst(run(path).derivatives, hull) < 1e-8


def test_inertia_is_found_from_runs_in_air(tmp_path, hull):
    air = [
        Run("dry sway", "dry_sway", frequency=2.0, sway_amplitude=0.1),
        Run("dry yaw", "dry_yaw", frequency=2.0, yaw_amplitude=0.2),
    ]
    path = write(tmp_path, hull, [*MATRIX, *air], replace(QUICK, inertia=BODY))
    result = run(path)
    assert worst(result.derivatives, hull) < 1e-8
    assert result.rigid_body.mass == pytest.approx(BODY.mass)
    assert result.rigid_body.Izz == pytest.approx(BODY.Izz)
    assert len(result.runs) == len(MATRIX)
    assert any("dry" in name for name in result.derivatives.provenance.inputs)
    edit(path, ("dry_runs = true", "dry_runs = true"))
    pd.read_csv(path.parent / "matrix.csv").iloc[:-2].to_csv(path.parent / "matrix.csv", index=False)
    with pytest.raises(
        CampaignError, match=r"\[inertia\]: .* there is no run in air -> add runs of type dry_sway"
    ):
        run(path)


# -- groups --------------------------------------------------------------------------------------------------


def test_depths_are_fitted_by_themselves(tmp_path, hull):
    shallow = replace(hull, values=1.4 * hull.values)
    depths = {math.inf: hull, 0.2: shallow}
    runs = [
        replace(one, name=f"{one.name} {h:g}", depth=None if math.isinf(h) else h)
        for h in depths
        for one in MATRIX
    ]
    result = run(write(tmp_path, depths, runs), accept_rules=RULES)
    assert list(result.sets()) == ["h/T 1.471", "deep water"]
    assert worst(result.sets()["deep water"], hull) < 1e-8
    assert worst(result.sets()["h/T 1.471"], shallow) < 1e-8
    assert set(result.derivatives_frame()["group"]) == set(result.sets())
    with pytest.raises(Exception, match="2 derivative sets -> choose one of"):
        _ = result.derivatives


@pytest.mark.parametrize(("group_by", "groups"), [('["speed"]', 2), ("[]", 1)])
def test_speeds_are_fitted_by_themselves_or_together(group_by, groups, tmp_path, hull):
    slow = [replace(one, name=f"slow {one.name}", speed=1.0) for one in MATRIX]
    path = edit(write(tmp_path, hull, [*MATRIX, *slow]), ("[fit]", f"[fit]\ngroup_by = {group_by}"))
    sets = run(path).sets()
    assert len(sets) == groups
    assert all(worst(one, hull) < 1e-8 for one in sets.values())
    if groups == 2:
        assert list(sets) == ["Fn 0.183", "Fn 0.274"]


# -- steps of the reduction ----------------------------------------------------------------------------------


def test_measured_motion_in_place_of_the_prescribed_one(tmp_path, hull):
    """The mechanism moves 5 % too far and late: the recorded motion holds, not the matrix."""
    path = write(tmp_path, hull)
    matrix = pd.read_csv(path.parent / "matrix.csv")
    moving = matrix["sway_amplitude"].notna()
    matrix.loc[moving, "sway_amplitude"] /= 1.04
    matrix["sway_phase"] = np.where(moving, 0.03, 0.0)
    matrix.to_csv(path.parent / "matrix.csv", index=False)
    assert worst(run(path).derivatives, hull) > 1e-3
    edit(path, ("[reduction]", '[reduction]\nmotion = "measured"\nmotion_harmonics = 16'))
    result = run(path)
    assert worst(result.derivatives, hull) < 1e-7
    assert any("motion: measured" in step for one in result.runs for step in one.steps)


def test_frequency_found_from_the_record(tmp_path, hull):
    path = write(tmp_path, hull, laboratory=replace(QUICK, cycles=4))
    matrix = pd.read_csv(path.parent / "matrix.csv")
    matrix["frequency"] *= 1.01
    matrix.to_csv(path.parent / "matrix.csv", index=False)
    edit(path, ("[reduction]", '[reduction]\nfrequency = "found"\nmotion = "measured"\nmotion_harmonics = 16'))
    result = run(path, accept_rules=["frequency-mismatch", "phase-mismatch"])
    assert [one.run.frequency for one in result.runs if one.order] == pytest.approx([0.9] * 9, rel=1e-6)
    assert worst(result.derivatives, hull) < 1e-5


def test_a_low_pass_takes_noise_and_leaves_the_harmonics(tmp_path, hull):
    path = write(tmp_path, hull, noise=Noise(white=0.02), laboratory=replace(QUICK, sampling_rate=40.0, cycles=4))
    plain = run(path)
    edit(path, ("[reduction]", "[reduction]\nlowpass = 2.0"))
    passed = run(path)
    assert passed.runs[-1].residual_sd["Y"] < 0.6 * plain.runs[-1].residual_sd["Y"]
    assert any("low-pass, order 4, 2 Hz" in step for step in passed.runs[0].steps)
    np.testing.assert_allclose(passed.runs[-1].scaled["Y"][:3], plain.runs[-1].scaled["Y"][:3], atol=2e-3)
    edit(path, ("lowpass = 2.0", "lowpass = 30.0"))
    with pytest.raises(FitError, match="low-pass at 30 Hz is above half the sampling rate"):
        run(path)


@pytest.mark.parametrize(
    ("settings", "note"),
    [
        ("fraction = [0.4, 0.9]", "40-90 %"),
        ('window = "mser"', "MSER"),
        ('window = "key-times"\nstart = 5.5\nstop = 12.0', "between the given times"),
        ("start = 6.0\nstop = 11.0", "6"),
    ],
)
def test_steady_windows_leave_the_transients_out(settings, note, tmp_path, hull):
    steady = [one for one in MATRIX if not one.harmonic]
    names = ["R0", "Xvv", "Xvvvv", "Yv", "Yvvv", "Nv", "Nvvv"]
    path = write(tmp_path, hull.subset(names), steady, replace(QUICK, rest=2.0, ramp=3.0))
    result = run(edit(path, ("[reduction]", f"[reduction]\n{settings}")))
    assert worst(result.derivatives, hull.subset(names)) < 1e-8
    window = result.runs_frame().iloc[0]
    assert 5.0 <= window["window start [s]"] < window["window stop [s]"] <= 13.1
    assert note in window["window"]


def test_cycles_to_skip_and_to_use(tmp_path, hull):
    path = write(tmp_path, hull, laboratory=replace(QUICK, cycles=5))
    edit(path, ("skip_cycles = 0", "skip_cycles = 2\nmax_cycles = 1"))
    result = run(path)
    assert worst(result.derivatives, hull) < 1e-8
    harmonic = [one for one in result.runs if one.order]
    assert {one.window.count for one in harmonic} == {70}
    assert harmonic[0].window.start == pytest.approx(2 * 2 * math.pi / 0.9, abs=0.11)


# -- the result ----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def noisy(tmp_path_factory, hull) -> Path:
    """A campaign with noise, a zero run and a density that its audit refuses."""
    laboratory = replace(
        QUICK, sampling_rate=20.0, duration=20.0, rest=1.0, ramp=2.0, startup_cycles=1, balance_zero={"Y": 4.0}
    )
    path = write(tmp_path_factory.mktemp("noisy"), hull, laboratory=laboratory, noise=Noise(ar1=0.02, seed=4))
    return edit(path, ("scale = 1.0", "scale = 46.6"))


def test_one_worker_and_two_give_the_same_numbers(noisy):
    one, two = (Campaign.load(noisy).run(workers=workers, compare=False) for workers in (1, 2))
    np.testing.assert_array_equal(one.derivatives.values, two.derivatives.values)
    np.testing.assert_array_equal(one.derivatives.covariance, two.derivatives.covariance)
    assert one.derivatives.provenance.inputs == two.derivatives.provenance.inputs
    assert list(one.derivatives.provenance.inputs) == list(two.derivatives.provenance.inputs)


def test_progress_is_told(noisy):
    told: list[tuple[str, int, int]] = []
    Campaign.load(noisy).run(progress=lambda *said: told.append(said))
    for what, total in (("reading runs", len(MATRIX)), ("fitting", 1), ("comparing", 1)):
        done = [count for name, count, _ in told if name == what]
        assert done == sorted(done)
        assert done[-1] == total
        assert {size for name, _, size in told if name == what} == {total}


def test_comparisons_are_made_when_asked(noisy, tmp_path):
    path = noisy.with_name("compared.toml")
    path.write_text(noisy.read_text())
    edit(path, ("[fit]", "[fit]\ncandidates = ['modulus']\nrange_limits = [0.12]"))
    result = Campaign.load(path).run()
    assert set(result.comparisons) == {"three ways|", "candidates|", "range|"}
    assert result.comparison("candidates") is not None
    assert result.comparison("candidates", "h/T 9") is None
    assert not Campaign.load(path).run(compare=False).comparisons


def test_provenance_names_every_file_and_choice(noisy):
    provenance = run(noisy).derivatives.provenance
    files = {"campaign.toml", "matrix.csv", "runs/zero.txt"}
    assert files <= set(provenance.inputs)
    assert len(provenance.inputs) == len(files) + len(MATRIX)
    assert all(len(digest) == 64 for digest in provenance.inputs.values())
    assert provenance.choices["reduction"]["fraction"] == (0.30, 0.95)
    assert provenance.choices["fit"]["estimator"] == "wls"
    assert "zero level of 'runs/zero.txt' subtracted" in provenance.choices["steps seen"]
    assert provenance.choices["accepted rules"] == []
    assert "towtank" in provenance.versions


def test_accepted_rules_are_recorded(noisy):
    path = noisy.with_name("waived.toml")
    path.write_text('accept = ["force-unit"]\n' + noisy.read_text().replace("rho = 1000.0", "rho = 1025.0"))
    edit(path, ("mass = 86.0", "mass = 86.0\nvolume = 0.086"))
    result = run(path, accept_rules=["density"])
    (waived,) = result.findings
    assert (waived.rule, waived.accepted, waived.file) == ("density", True, str(path))
    assert result.derivatives.provenance.findings == result.findings
    assert result.derivatives.provenance.choices["accepted rules"] == ["density", "force-unit"]


def test_frames_of_the_result(noisy):
    result = run(noisy)
    assert list(result.derivatives_frame()) == ["name", "value", "std", "lower95", "upper95", "scaling"]
    runs = result.runs_frame()
    assert list(runs["run"]) == [one.name for one in MATRIX]
    assert set(runs["quality"]) == {"good"}
    harmonics = result.harmonics_frame()
    assert len(harmonics) == 3 * (7 + 9 * 4)
    assert result.findings_frame().empty
    assert "Yv" in result.summary()


def test_the_result_is_written_in_the_scaling_that_is_asked_for(noisy):
    path = noisy.with_name("prime.toml")
    path.write_text(noisy.read_text() + '\n[output]\nscaling = "prime"\n')
    prime, plain = run(path).derivatives, run(noisy).derivatives
    assert prime.conventions.force_scaling == "L2"
    assert prime["Yv"] == pytest.approx(plain["Yv"] * plain.ship.T / plain.ship.L)


def test_runs_and_points_in_one_campaign(tmp_path, hull):
    moving = [one for one in MATRIX if one.harmonic]
    path = write(tmp_path, hull, moving)
    rows = ["v,X,Y,N"]
    for v in (-0.2, -0.1, 0.0, 0.1, 0.15, 0.2):
        motion = dict.fromkeys(("r", "udot", "vdot", "rdot"), np.zeros(1))
        motion |= {"surge": np.array([SPEED * math.sqrt(1 - v * v)]), "v": np.array([SPEED * v])}
        forces = hull.forces(motion, approach_speed=SPEED)
        area = 0.5 * 1000.0 * 3.048 * 0.136 * SPEED**2
        rows.append(f"{v},{forces['X'][0] / area},{forces['Y'][0] / area},{forces['N'][0] / area / 3.048}")
    (path.parent / "points.csv").write_text("\n".join(rows))
    edit(path, end='\n[points]\nfile = "points.csv"\n')
    result = run(path)
    assert len(result.runs) == len(moving) + 6
    assert worst(result.derivatives, hull) < 1e-8
    assert "points.csv" in result.derivatives.provenance.inputs
