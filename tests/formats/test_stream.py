import gc
import threading
import time

import pytest

from towtank.core.errors import FitError, ReadError
from towtank.formats.stream import iter_records


@pytest.mark.parametrize("workers", [0, 1, 2, 5])
def test_order_and_progress(workers):
    told = []

    def read(number):
        time.sleep(0.002 * (number % 3))
        return number * number

    results = list(iter_records(range(20), read, workers=workers, progress=lambda *state: told.append(state)))
    assert results == [number * number for number in range(20)]
    assert told == [(done, 20) for done in range(1, 21)]


class Run:
    alive = 0
    most = 0
    lock = threading.Lock()

    def __init__(self, number):
        self.number = number
        with self.lock:
            Run.alive += 1
            Run.most = max(Run.most, Run.alive)

    def __del__(self):
        with self.lock:
            Run.alive -= 1


@pytest.mark.parametrize("workers", [1, 2])
def test_number_of_runs_in_memory_is_bounded(workers):
    Run.alive = Run.most = 0
    for _ in iter_records(range(200), Run, workers=workers):
        gc.collect(0)
    assert Run.most <= 2 * workers + 2


@pytest.mark.parametrize("workers", [1, 2])
def test_errors_carry_the_file_and_come_in_order(workers):
    def read(path):
        if path == "b.csv":
            raise FitError("does not converge", cure="look at it")
        if path == "c.csv":
            raise ZeroDivisionError("division by zero")
        return path

    seen = []
    with pytest.raises(FitError, match=r"^b.csv: does not converge -> look at it$"):
        seen.extend(iter_records(["a.csv", "b.csv", "c.csv"], read, workers=workers))
    with pytest.raises(ReadError, match=r"^c.csv: cannot be read \(ZeroDivisionError: division by zero\)"):
        list(iter_records(["c.csv"], read, workers=workers))


def test_file_of_the_error_is_not_overwritten():
    def read(path):
        raise ReadError("bad", file="condition.txt")

    with pytest.raises(ReadError, match=r"^condition.txt: bad"):
        list(iter_records(["a.csv"], read))


def test_closing_drops_what_was_not_started():
    started = []

    def read(number):
        started.append(number)
        time.sleep(0.005)
        return number

    records = iter_records(range(1000), read, workers=2)
    assert next(records) == 0
    records.close()
    assert len(started) < 10
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("towtank-read")]
