"""Ensembles in processes and on a Dask cluster whose workers are killed and come back: each draw counts once."""

from __future__ import annotations

import os
import signal

import joblib
import numpy as np
import pytest

from towtank.simulate.ensembles import Ensemble, ensemble
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.parameter_scatter import HULL, MMG_COEFFICIENTS
from towtank.simulate.sailed_batches import BATCH, Voyage, _Batch
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")
DRAWS = 8 * BATCH


def sailed(**more) -> Ensemble:
    """KVLCC2 with 31 uncertain parameters, in eight batches."""
    manoeuvres = [turning(35, 180), zigzag(10, overshoots=2)]
    return ensemble(KVLCC2, manoeuvres, n=DRAWS, seed=3, percent=5, names=(HULL, *MMG_COEFFICIENTS), **more)


@pytest.fixture(scope="module")
def serial() -> Ensemble:
    return sailed()


def assert_same(found: Ensemble, serial: Ensemble) -> None:
    """Equal to the last bit, draw by draw."""
    np.testing.assert_array_equal(found.parameters, serial.parameters)
    np.testing.assert_array_equal(found.rates, serial.rates)
    for manoeuvre, indices in serial.values.items():
        np.testing.assert_array_equal(found.endings[manoeuvre], serial.endings[manoeuvre])
        for index, values in indices.items():
            np.testing.assert_array_equal(found.values[manoeuvre][index], values, err_msg=f"{manoeuvre}, {index}")


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    import dask

    # the nannies start a worker again that was killed; the cluster must not take one that is killed again, while it
    # counts how long the first stays away, for lost
    with (
        dask.config.set({"distributed.deploy.lost-worker-timeout": "1h"}),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
        ) as local,
        distributed.Client(local) as client,
    ):
        yield client


def worker_processes(client) -> list[int]:
    return list(client.run(os.getpid).values())


def test_processes(serial):
    assert_same(sailed(workers=2, backend="loky"), serial)


def test_batches_are_not_scattered(cluster):
    """What the backend puts on one worker as data is lost with it; a batch travels with its task instead."""
    from dask.sizeof import sizeof

    batch = _Batch(Voyage(KVLCC2, (turning(35),), ("Yv",)), 0, np.zeros((BATCH, 1)))
    assert sizeof(batch) < 1000


def test_a_cluster_gives_the_same_by_name_and_by_context(cluster, serial):
    assert_same(sailed(backend="dask"), serial)
    with joblib.parallel_config("dask"):
        assert_same(sailed(), serial)


@pytest.mark.slow
@pytest.mark.parametrize("killed", [1, 2])
def test_workers_that_are_killed_in_the_middle_and_restarted_lose_no_draw(cluster, serial, killed):
    before = worker_processes(cluster)
    assert len(before) == 2
    told: list[int] = []

    def kill_in_the_middle(what: str, done: int, total: int) -> None:
        if not told or told[-1] < DRAWS // 3 <= done:
            for process in before[:killed] if told else ():
                os.kill(process, signal.SIGKILL)
        told.append(done)

    found = sailed(backend="dask", progress=kill_in_the_middle)
    assert_same(found, serial)
    # a batch that was sailed twice is counted once
    assert told == list(range(BATCH, DRAWS + 1, BATCH))
    cluster.wait_for_workers(2, timeout=20)
    assert len(set(worker_processes(cluster)) - set(before)) == killed
