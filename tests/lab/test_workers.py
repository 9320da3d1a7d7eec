"""Workers: called off, out of time, ended from outside, and there again."""

import asyncio
import json
import os
import signal
from concurrent.futures import ThreadPoolExecutor

import pytest

from polhode.lab import _workers
from polhode.lab._workers import (
    DONE,
    REFUSED,
    BrokenError,
    BusyError,
    GoneError,
    TooLongError,
    WorkerPool,
)

QUICK = b'run\n{"system": "gyroscope", "duration": "0.1 s"}'
LONG = (
    b"run\n"
    + json.dumps(
        {
            "system": "rolling-disk",
            "start": {"theta": "80 deg", "omega_3": "9000000 rad/s", "phi_dot": "1 rad/s"},
            "duration": "900 s",
        }
    ).encode()
)
PATIENCE = 100.0


def in_a_thread(run):
    """Run a coroutine function where no event loop is: tests in a browser leave one behind."""
    with ThreadPoolExecutor(1) as thread:
        thread.submit(asyncio.run, run()).result()


def with_worker(act):
    """Run a coroutine function on one worker of a pool, which is ended afterwards."""

    async def run():
        pool = WorkerPool(None)
        pool.begin()
        try:
            await act(await pool.worker("motions"))
        finally:
            await pool.end()

    in_a_thread(run)


async def answers(worker):
    reply = await worker.ask(QUICK, PATIENCE, asyncio.Event())
    assert reply.startswith(DONE)


def test_a_motion_that_nobody_waits_for_is_stopped_and_the_worker_stays(monkeypatch):
    monkeypatch.setattr(_workers, "_GRACE", PATIENCE)  # to see its next step on a busy machine

    async def act(worker):
        await answers(worker)
        number = worker.pid
        gone = asyncio.Event()
        asking = asyncio.create_task(worker.ask(LONG, PATIENCE, gone))
        await asyncio.sleep(2.0)
        gone.set()
        with pytest.raises(GoneError):
            await asking
        await answers(worker)
        assert worker.pid == number

    with_worker(act)


def test_a_worker_that_does_not_stop_is_replaced():
    async def act(worker):
        await answers(worker)
        number = worker.pid
        os.kill(number, signal.SIGSTOP)
        with pytest.raises(TooLongError):
            await worker.ask(QUICK, 0.2, asyncio.Event())
        await answers(worker)
        assert worker.pid != number

    with_worker(act)


def test_a_worker_that_is_ended_from_outside_is_replaced():
    async def act(worker):
        await answers(worker)
        os.kill(worker.pid, signal.SIGKILL)
        with pytest.raises(BrokenError):
            await worker.ask(QUICK, PATIENCE, asyncio.Event())
        await answers(worker)

    with_worker(act)


def test_a_worker_that_cannot_be_replaced_is_told_as_broken(monkeypatch):
    """As when the whole server is ended with a request on its way."""

    def no_more_processes():
        raise EOFError("unexpected EOF")

    async def act(worker):
        await answers(worker)
        monkeypatch.setattr(worker, "_start", no_more_processes)
        os.kill(worker.pid, signal.SIGKILL)
        with pytest.raises(BrokenError):
            await worker.ask(QUICK, PATIENCE, asyncio.Event())
        with pytest.raises(BrokenError):
            await worker.ask(QUICK, PATIENCE, asyncio.Event())

    with_worker(act)


def test_one_who_left_while_waiting_is_not_worked_for():
    async def act(worker):
        gone = asyncio.Event()
        gone.set()
        with pytest.raises(GoneError):
            await worker.ask(LONG, PATIENCE, gone)

    with_worker(act)


def test_one_who_leaves_while_waiting_waits_no_longer():
    async def act(worker):
        await answers(worker)
        gone, first = asyncio.Event(), asyncio.Event()
        asking = asyncio.create_task(worker.ask(LONG, 3600.0, first))
        await asyncio.sleep(0)
        waiting = [asyncio.create_task(worker.ask(QUICK, 3600.0, gone, 3600.0)) for _ in range(5)]
        await asyncio.sleep(0)
        gone.set()
        left = await asyncio.gather(*waiting, return_exceptions=True)
        assert [type(each) for each in left] == [GoneError] * 5
        assert not asking.done()  # they have not waited for the task before theirs
        first.set()
        with pytest.raises(GoneError):
            await asking
        await answers(worker)

    with_worker(act)


def test_a_task_waits_for_its_turn_no_longer_than_it_may():
    async def act(worker):
        await answers(worker)
        first = asyncio.Event()
        asking = asyncio.create_task(worker.ask(LONG, 3600.0, first))
        await asyncio.sleep(0)
        with pytest.raises(BusyError):
            await worker.ask(QUICK, 3600.0, asyncio.Event(), 0.1)
        assert not asking.done()
        first.set()
        with pytest.raises(GoneError):
            await asking
        await answers(worker)

    with_worker(act)


def test_what_cannot_be_is_refused_in_words():
    async def act(worker):
        reply = await worker.ask(b'run\n{"system": "perpetuum mobile"}', PATIENCE, asyncio.Event())
        assert reply.startswith(REFUSED)
        assert "rolling-disk" in json.loads(reply[1:])["expected"]

    with_worker(act)


def test_workers_not_asked_for_longest_make_room():
    async def run():
        pool = WorkerPool(None)
        pool.begin()
        try:
            first = await pool.worker("0")
            for purpose in "1234":
                await pool.worker(purpose)
            assert await pool.worker("0") is not first
        finally:
            await pool.end()

    in_a_thread(run)
