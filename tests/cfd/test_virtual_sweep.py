from __future__ import annotations

import json

import numpy as np
import pytest

from towtank.cfd.case_loads import case_loads
from towtank.cfd.virtual_sweep import (
    GridErrorLaw,
    Histories,
    case_name,
    virtual_choices,
    virtual_experiment,
    virtual_truth,
    write_virtual_sweep,
)
from towtank.formats import read_solver_case

QUIET = Histories(noise=0.0, transient=0.0, duration=10.0)
STRAIGHT, OBLIQUE, INTERRUPTED = (0.0, 0.0), (-4.0, 0.2), (8.0, 0.0)


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    law = GridErrorLaw(size=(0.0, 0.0), grids=1)
    motions = (STRAIGHT, OBLIQUE, INTERRUPTED)
    return write_virtual_sweep(tmp_path_factory.mktemp("quiet"), law=law, histories=QUIET, motions=motions)


@pytest.mark.parametrize("motion", [STRAIGHT, OBLIQUE])
def test_files_hold_the_forces_of_the_truth(cases, motion):
    truth = virtual_truth()
    loads = case_loads(read_solver_case(cases / case_name(motion, "1")), virtual_choices(truth))
    beta, speed = np.radians(motion[0]), 0.76
    state = {"surge": speed * np.cos(beta), "v": -speed * np.sin(beta), "r": motion[1] * speed / truth.ship.L}
    expected = truth.forces(state)
    for name in ("X", "Y", "N"):
        assert loads.channels[name].mean() == pytest.approx(float(expected[name]), rel=1e-5, abs=1e-4)
    np.testing.assert_allclose(loads.channels["K"], 0.0, atol=1e-3)


def test_restarted_case_overlaps(cases):
    case = read_solver_case(cases / case_name(INTERRUPTED, "1"))
    log = case.log("forces")
    assert len(log.restarts) >= 1
    assert log.restarts[0].rows_dropped > 0
    assert len(log) == 50


def test_files_and_folder_say_that_they_are_virtual(cases):
    text = next(cases.glob("*/postProcessing/forces/0/force.dat")).read_text()
    assert "virtual" in text.splitlines()[1]
    told = json.loads((cases.parent / "virtual.json").read_text())
    assert told["virtual"] is True
    assert told["refinement ratio"] == pytest.approx(2**0.5)
    assert (cases / "truth.json").is_file()


def test_error_law_has_its_order_on_every_derivative():
    truth, law = virtual_truth(), GridErrorLaw(order=1.7, ratio=1.5)
    errors = np.array([law.on_grid(truth, grid).values - truth.values for grid in (1, 2, 3)])
    order = np.log((errors[2] - errors[1]) / (errors[1] - errors[0])) / np.log(1.5)
    np.testing.assert_allclose(order, 1.7)
    assert law.cells["1"] / law.cells["2"] == pytest.approx(1.5**3, rel=1e-6)


def test_experiment_states_its_own_error():
    truth = virtual_truth()
    efd = virtual_experiment(truth)
    z = (efd.values - truth.values) / efd.bse.to_numpy()
    assert np.abs(z).max() < 3.5
    assert 0.6 < z.std() < 1.5
