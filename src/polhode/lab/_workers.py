"""Worker processes of the lab, kept for recent systems; tasks in them can be called off."""

from __future__ import annotations

import asyncio
import json
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Protocol

from polhode.base import (
    PolhodeError,
    StartMethod,
    Tell,
    Worker,
    WorkerEndedError,
    preload,
    shared_flag,
)
from polhode.lab._offer import Own

if TYPE_CHECKING:
    from polhode.lab._task_handler import TaskHandler

DONE, REFUSED, CALLED_OFF = b"D", b"R", b"C"  # first byte of a reply

_MOST = 4  # workers, each with its own compiled systems in memory
_GRACE = 0.7  # s for a task that is called off to end by itself


class GoneError(Exception):
    """The reply is no longer wanted."""


class BusyError(Exception):
    """A task waited for its turn as long as it may."""


class TooLongError(Exception):
    """A task took longer than it may."""


class BrokenError(Exception):
    """A worker ended without a reply."""


class LabWorker:
    """A process that does one task at a time; one that will not stop is replaced."""

    def __init__(self, own: Own | None) -> None:
        self._own = own
        self._turn = asyncio.Lock()
        self._start()

    @property
    def busy(self) -> bool:
        """Whether it is working on a task."""
        return self._turn.locked()

    @property
    def pid(self) -> int:
        """Number of its process."""
        return self._process.pid

    async def ask(
        self, request: bytes, seconds: float, gone: asyncio.Event, longest_wait: float = 60.0
    ) -> bytes:
        """The reply to a request.

        Args:
            request: a task and its JSON, separated by a line break.
            seconds: that it may take, once it is its turn.
            gone: set where the reply is no longer wanted.
            longest_wait: s that it may wait for its turn.

        Raises:
            GoneError, BusyError, TooLongError, BrokenError: where there is no reply.
        """
        await self._take_turn(gone, longest_wait)
        try:
            return await self._answer(request, seconds, gone)
        finally:
            self._turn.release()

    async def _take_turn(self, gone: asyncio.Event, longest_wait: float) -> None:
        """Wait for the turn of a request, no longer than its reply is wanted."""
        turn = asyncio.create_task(self._turn.acquire())
        left = asyncio.create_task(gone.wait())
        try:
            await asyncio.wait({turn, left}, timeout=longest_wait, return_when="FIRST_COMPLETED")
            if gone.is_set():
                raise GoneError
            if not turn.done():
                raise BusyError
        except BaseException:
            if turn.done():
                self._turn.release()
            turn.cancel()
            raise
        finally:
            left.cancel()

    async def _answer(self, request: bytes, seconds: float, gone: asyncio.Event) -> bytes:
        self._unwanted.value = 0
        reply = asyncio.create_task(asyncio.to_thread(self._exchange, request))
        left = asyncio.create_task(gone.wait())
        await asyncio.wait({reply, left}, timeout=seconds, return_when="FIRST_COMPLETED")
        left.cancel()
        if not reply.done():
            await self._call_off(reply)
            raise GoneError if gone.is_set() else TooLongError
        found = await reply
        if found is None:
            self._replace()
            raise BrokenError
        if found == CALLED_OFF:
            raise GoneError
        return found

    def _exchange(self, request: bytes) -> bytes | None:
        try:
            return self._process.ask(request)
        except WorkerEndedError:
            return None

    async def _call_off(self, reply: asyncio.Task[bytes | None]) -> None:
        """A simulation sees the flag at its next step; a process that does not is killed."""
        self._unwanted.value = 1
        await asyncio.wait({reply}, timeout=_GRACE)
        if not reply.done():
            self._process.kill()
            await reply
        if reply.result() is None:
            self._replace()

    def _replace(self) -> None:
        self.end()
        with suppress(EOFError, OSError):  # no new process while the lab itself is ending
            self._start()

    def _start(self) -> None:
        self._unwanted: Flag = shared_flag()
        self._process = Worker[bytes, bytes](
            partial(_task_worker, self._unwanted, self._own), StartMethod.SERVER
        )

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.close()


class WorkerPool:
    """Workers by purpose; the least recently used one makes room for a new one.

    Args:
        own: the user's own system.
    """

    def __init__(self, own: Own | None) -> None:
        self._own = own
        preload(["polhode.lab._task_handler", __name__])
        self._workers: OrderedDict[str, LabWorker] = OrderedDict()
        self._spare: asyncio.Task[LabWorker] | None = None
        self._assigning = asyncio.Lock()

    def begin(self) -> None:
        """Start a spare worker, since a process takes a while to be ready."""
        self._spare = asyncio.create_task(asyncio.to_thread(LabWorker, self._own))

    async def worker(self, purpose: str) -> LabWorker:
        """The worker for a purpose, such as the motions of one system."""
        async with self._assigning:
            if purpose not in self._workers:
                idle = [known for known, worker in self._workers.items() if not worker.busy]
                for known in idle[: max(len(self._workers) - _MOST + 1, 0)]:
                    self._workers.pop(known).end()
                if self._spare is None:
                    self.begin()
                assert self._spare is not None
                self._workers[purpose] = await self._spare
                self.begin()
            self._workers.move_to_end(purpose)
            return self._workers[purpose]

    async def end(self) -> None:
        """End all of them."""
        spare = [await self._spare] if self._spare else []
        for worker in (*self._workers.values(), *spare):
            worker.end()
        self._workers.clear()
        self._spare = None


# -- in a worker -----------------------------------------------------------------------------------


class Flag(Protocol):
    """A number that two processes see."""

    value: int


class CalledOffError(Exception):
    """The task is no longer wanted."""


class CallOff:
    """Progress of a simulation, which stops it once it is no longer wanted."""

    def __init__(self, unwanted: Flag) -> None:
        self._unwanted = unwanted

    def begin(self, task: str, total: int | None = None) -> None:
        """Stop before the simulation begins, if it was called off."""
        self.advance()

    def advance(self, steps: int = 1) -> None:
        """Stop the simulation if it was called off.

        Raises:
            CalledOffError: if the task is no longer wanted.
        """
        if self._unwanted.value:
            raise CalledOffError

    def finish(self) -> None:
        """Nothing is left to stop."""


def _task_worker(unwanted: Flag, own: Own | None) -> Callable[[bytes, Tell[bytes]], bytes]:
    """The function that does tasks in a worker; `unwanted` is set to 1 to call off a task."""
    from polhode.lab._task_handler import (
        TaskHandler,  # slow to import; the server has no use for it
    )

    handler = TaskHandler(own, CallOff(unwanted))
    return lambda request, tell: _reply(handler, request)


def _reply(handler: TaskHandler, request: bytes) -> bytes:
    task, _, body = request.partition(b"\n")
    try:
        return DONE + handler.do(task.decode("ascii"), body)
    except CalledOffError:
        return CALLED_OFF
    except PolhodeError as error:
        refused = {"given": error.given, "expected": error.expected, "advice": error.advice}
    except Exception as error:  # a bug of polhode's: reported, and the worker continues
        fault = f"unexpected {type(error).__name__}: {error}"[:500]
        refused = {"given": fault, "expected": "", "advice": "please report it"}
    return REFUSED + json.dumps(refused).encode()
