"""Work shared among processes: order, errors, killed processes, results that come later."""

from __future__ import annotations

import os
import signal
from time import sleep

import pytest

from towtank.core.errors import FitError, TowtankError
from towtank.core.processes import Later, can_fork, in_processes

forked = pytest.mark.skipif(not can_fork(), reason="processes are not forked on this system")


@forked
@pytest.mark.parametrize(("items", "batch"), [(0, 1), (1, 3), (50, 1), (50, 8)])
def test_results_come_in_order_from_other_processes(items, batch):
    own = os.getpid()
    found = list(in_processes(lambda n: (n * n, os.getpid()), range(items), 2, batch=batch))
    assert [value for value, _ in found] == [n * n for n in range(items)]
    assert own not in {process for _, process in found}


@forked
def test_an_error_arrives_as_it_was_raised():
    def work(number):
        if number == 3:
            raise FitError("does not converge", cure="look at it", file="run_3.txt")
        return number

    seen = []
    with pytest.raises(FitError, match=r"^run_3.txt: does not converge -> look at it$"):
        seen.extend(in_processes(work, range(10), 2))
    assert seen == [0, 1, 2]


@forked
def test_a_killed_process_is_told():
    def work(number):
        if number == 5:
            os.kill(os.getpid(), signal.SIGKILL)
        return number

    with pytest.raises(TowtankError, match=r"was killed -> free memory, or use one worker"):
        list(in_processes(work, range(10), 2))


@forked
def test_later_computes_meanwhile_and_waits_when_looked_at(tmp_path):
    started, asked = tmp_path / "started", tmp_path / "asked"

    def wait_for(path):
        for _ in range(2000):
            if path.exists():
                return
            sleep(0.005)
        raise AssertionError(f"{path.name} did not come")

    def work():
        started.touch()
        wait_for(asked)
        return {"a": 1, "process": os.getpid()}

    later = Later(work)
    # The other process is at work before anybody looked, and this one goes on meanwhile.
    wait_for(started)
    asked.touch()
    assert later["a"] == 1
    assert later["process"] != os.getpid()
    assert sorted(later) == ["a", "process"]
    assert len(later) == 2
    assert later.get("b") is None


@forked
def test_later_raises_what_was_raised():
    def work():
        raise FitError("one run is too few")

    later = Later(work)
    with pytest.raises(FitError, match="one run is too few"):
        len(later)
