"""Draws in batches: the same to the last bit however they are shared; nothing is lost or counted twice."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.simulate import sailed_batches
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.parameter_scatter import scatter_of
from towtank.simulate.sailed_batches import COMPLETED, NO_RATE, Voyage, sail_batches, sail_rows
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")
SCATTER = scatter_of(KVLCC2, percent=5)
VOYAGE = Voyage(KVLCC2, (turning(35, 180), zigzag(10, overshoots=2)), SCATTER.names)
ROWS = SCATTER.draws(60, seed=9)


def same(one, other):
    """True when two results are equal to the last bit."""
    return (
        all(
            np.array_equal(value, other.values[manoeuvre][index], equal_nan=True)
            for manoeuvre, values in one.values.items()
            for index, value in values.items()
        )
        and all(np.array_equal(ending, other.endings[manoeuvre]) for manoeuvre, ending in one.endings.items())
        and np.array_equal(one.rates, other.rates)
    )


@pytest.fixture(scope="module")
def whole():
    return sail_rows(VOYAGE, ROWS)


@pytest.mark.parametrize(("workers", "batch"), [(1, 7), (1, 60), (2, 1), (2, 25), (3, 1000)])
def test_threads_and_sizes_of_batches_do_not_matter(whole, workers, batch):
    assert same(sail_batches(VOYAGE, ROWS, workers=workers, batch=batch), whole)


def test_the_backend_in_force_is_used(whole, monkeypatch):
    from joblib import parallel_config

    asked = []
    pool = sailed_batches._pool
    monkeypatch.setattr(sailed_batches, "_pool", lambda *given: asked.append(given) or pool(*given))
    with parallel_config("threading", n_jobs=2):
        assert same(sail_batches(VOYAGE, ROWS, batch=20), whole)
    assert asked == [(1, None)]
    sail_batches(VOYAGE, ROWS[:10])
    assert len(asked) == 1


def test_progress_is_told_in_draws():
    told = []
    sail_batches(VOYAGE, ROWS[:25], batch=10, progress=lambda *item: told.append(item))
    assert told == [("sailing", 10, 25), ("sailing", 20, 25), ("sailing", 25, 25)]


def test_batches_that_get_lost_or_come_twice_are_put_right(whole, monkeypatch):
    rounds = []

    def unreliable(batches, workers, backend):
        rounds.append(len(batches))
        done = [sailed_batches._sail_batch(batch) for batch in batches]
        yield from (done[1], done[1], *done[2:]) if len(rounds) == 1 else done

    told = []
    monkeypatch.setattr(sailed_batches, "_in_parallel", unreliable)
    found = sail_batches(VOYAGE, ROWS, batch=20, progress=lambda what, done, total: told.append(done))
    assert same(found, whole)
    assert rounds == [3, 1]
    assert told == [20, 40, 60]


def test_batches_of_a_worker_that_is_killed_are_sailed_again(whole, monkeypatch):
    from joblib.externals.loky.process_executor import TerminatedWorkerError

    rounds = []

    def killed(batches, workers, backend):
        rounds.append([batch.first for batch in batches])
        yield sailed_batches._sail_batch(batches[-1])
        if len(rounds) < 3:
            raise TerminatedWorkerError("a worker was killed")
        yield from map(sailed_batches._sail_batch, batches[:-1])

    monkeypatch.setattr(sailed_batches, "_in_parallel", killed)
    assert same(sail_batches(VOYAGE, ROWS, batch=15), whole)
    assert rounds == [[0, 15, 30, 45], [0, 15, 30], [0, 15]]


def test_draws_that_never_come_back_are_an_error_with_their_number(monkeypatch):
    monkeypatch.setattr(sailed_batches, "_in_parallel", lambda batches, *more: iter(()))
    with pytest.raises(SimulationError, match="60 of 60 draws did not come back from the workers: they were lost"):
        sail_batches(VOYAGE, ROWS)


def test_faults_of_the_ship_are_not_sailed_again(monkeypatch):
    rounds = []

    def faulty(batch):
        rounds.append(batch.first)
        raise SimulationError("no such ship")

    monkeypatch.setattr(sailed_batches, "_sail_batch", faulty)
    with pytest.raises(SimulationError, match="no such ship"):
        sail_batches(VOYAGE, ROWS)
    assert rounds == [0]


@pytest.mark.parametrize(("backend", "message"), [("dask", "dask.distributed.Client"), ("pigeons", "pigeons")])
def test_a_backend_that_is_not_there_is_named(backend, message):
    if backend == "dask":
        pytest.importorskip("distributed")
    with pytest.raises(SimulationError, match=rf"backend '{backend}' cannot be used.*{message}"):
        sail_batches(VOYAGE, ROWS[:10], backend=backend)


def test_draws_that_fail_are_told_apart_by_reason():
    rows = ROWS[:4].copy()
    column = {name: SCATTER.names.index(name) for name in ("R0", "Nrrr")}
    rows[1, column["R0"]] = -0.02  # driven by its resistance
    rows[2, column["Nrrr"]] = 1.0  # yaw accelerates itself
    sailed = sail_rows(VOYAGE, rows)
    endings = sailed.endings["turning +35"].tolist()
    assert endings[0] == endings[3] == COMPLETED
    assert endings[1] == NO_RATE
    assert endings[2] == "the motion diverges"
    advance = sailed.values["turning +35"]["advance"]
    np.testing.assert_array_equal(np.isfinite(advance), [True, False, False, True])
    np.testing.assert_array_equal(np.isnan(sailed.rates), [False, True, False, False])
