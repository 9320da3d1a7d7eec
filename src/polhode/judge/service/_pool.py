"""Workers that mark answers, a fixed number of them; one that takes too long is replaced."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any, TypeVar

from polhode.base import Worker, WorkerEndedError
from polhode.judge._review_worker import MEMORY, ONE_THREAD, ReviewRecord
from polhode.judge.service._answer import AnswerTask, MarkedAnswer, answer_worker
from polhode.judge.service._settings import ServiceSettings
from polhode.model import System

Result = TypeVar("Result")
AnswerWorker = Worker[AnswerTask, MarkedAnswer]

#: A relation that holds on every model; a worker that has marked it is ready.
TRIAL = AnswerTask(r"\[ T = T \]")
_READY_WITHIN = 300.0  # s in which a worker has to derive the system
_AGAIN = 1.0  # s until a worker that could not be started is tried again
_MOST = 2000  # answers of one worker, which keeps a little of each in its caches


class BusyError(Exception):
    """As many answers wait as may wait, or one has waited as long as it may."""


class MarksPool:
    """Worker processes for one system.

    Args:
        system: that answers are about.
        settings: limits.
    """

    def __init__(self, system: System, settings: ServiceSettings) -> None:
        self._system = system
        self._settings = settings
        self._idle: asyncio.Queue[_AnsweringSeat] = asyncio.Queue()
        self._threads = ThreadPoolExecutor(settings.workers, thread_name_prefix="marks")
        self._seats: list[_AnsweringSeat] = []
        self._tasks: set[asyncio.Task[Any]] = set()
        self.waiting = 0
        self.has_begun = False  # whether a worker has derived the system

    def begin(self) -> None:
        """Start the workers; each takes answers once it has derived the system."""
        self._seats = [_AnsweringSeat(self._system) for _ in range(self._settings.workers)]
        for seat in self._seats:
            self._started(self._take_back(seat))

    async def marked(self, task: AnswerTask) -> MarkedAnswer:
        """An answer marked within the time limit; one that is cancelled waits no longer.

        Raises:
            BusyError: where too many wait already, or a worker is not free in time.
        """
        if self.waiting >= self._settings.waiting + self._settings.workers:
            raise BusyError
        self.waiting += 1
        try:
            async with asyncio.timeout(self._settings.longest_wait):
                seat = await self._idle.get()
        except TimeoutError:
            raise BusyError from None
        finally:
            self.waiting -= 1
        # A platform that hangs up must not leave a worker that answers into the void: it goes on,
        # within its limits, and only then takes the next answer.
        return await asyncio.shield(self._started(self._by(seat, task)))

    def _started(self, work: Coroutine[Any, Any, Result]) -> asyncio.Task[Result]:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    async def _by(self, seat: _AnsweringSeat, task: AnswerTask) -> MarkedAnswer:
        seconds = self._settings.seconds
        loop = asyncio.get_running_loop()
        reply = loop.run_in_executor(self._threads, seat.ask, task, seconds)
        done, _ = await asyncio.wait({reply}, timeout=seconds)
        if not done:  # its processor time is not over, but the wall time is
            seat.kill()
        try:
            return await reply or MarkedAnswer(_out_of(seconds))
        finally:
            self._started(self._take_back(seat))

    async def _take_back(self, seat: _AnsweringSeat) -> None:
        """Let a worker take answers again, once it is ready."""
        loop = asyncio.get_running_loop()
        while not await loop.run_in_executor(self._threads, seat.is_ready):
            await asyncio.sleep(_AGAIN)
        self.has_begun = True
        self._idle.put_nowait(seat)

    @property
    def pids(self) -> list[int]:
        """Numbers of the worker processes."""
        return [seat.pid for seat in self._seats]

    def end(self) -> None:
        """End all workers, whatever they do."""
        for seat in self._seats:
            seat.end()
        self._threads.shutdown(wait=False, cancel_futures=True)


class _AnsweringSeat:
    """A worker, replaced when it ends, and after many answers."""

    def __init__(self, system: System) -> None:
        self._begin = partial(
            AnswerWorker,
            partial(answer_worker, system),
            memory=MEMORY,
            environment=ONE_THREAD,
            ready_within=_READY_WITHIN,
        )
        self._worker = self._begin()
        self._marked = 0
        self._is_over = False

    @property
    def pid(self) -> int:
        return self._worker.pid

    def ask(self, task: AnswerTask, seconds: float) -> MarkedAnswer | None:
        """The marked answer; None where the worker ended."""
        self._marked += 1
        try:
            return self._worker.ask(task, seconds)
        except WorkerEndedError:
            return None

    def is_ready(self) -> bool:
        """Wait until the worker, or another in its place, has derived the system."""
        try:
            if not self._is_over and (self._marked >= _MOST or not self._worker.is_open):
                self._worker.close()
                self._worker, self._marked = self._begin(), 0
            if not self._marked:
                self._worker.ask(TRIAL)
                self._marked = 1
        except WorkerEndedError:
            return self._is_over
        return True

    def kill(self) -> None:
        self._worker.kill()

    def end(self) -> None:
        self._is_over = True
        self._worker.close()


def _out_of(seconds: float) -> ReviewRecord:
    return ReviewRecord(
        problem=f"it took more than the {seconds:g} s, or the memory, that an answer has"
    )
