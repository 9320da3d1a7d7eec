"""Worker processes that can be called off, kept warm for the systems last asked about."""

from __future__ import annotations

import asyncio
from collections import OrderedDict
from contextlib import suppress
from dataclasses import astuple
from multiprocessing import get_all_start_methods, get_context
from multiprocessing.context import BaseContext
from typing import Any

from polhode.lab._offer import Own
from polhode.lab._work import CALLED_OFF, work

_MOST = 4  # workers
_GRACE = 0.7  # s in which a task that is called off may end by itself
_METHOD = "forkserver" if "forkserver" in get_all_start_methods() else "spawn"


class GoneError(Exception):
    """The one who asked has left."""


class TooLongError(Exception):
    """A task took longer than it may."""


class BrokenError(Exception):
    """A worker ended without a reply."""


class Worker:
    """A process that does one task at a time; one that will not stop is replaced."""

    def __init__(self, context: BaseContext, own: Own | None) -> None:
        self._context: Any = context
        self._own = own
        self._turn = asyncio.Lock()
        self._start()

    @property
    def busy(self) -> bool:
        """Whether it is at work."""
        return self._turn.locked()

    @property
    def pid(self) -> int:
        """Number of its process."""
        return int(self._process.pid)

    async def ask(self, request: bytes, seconds: float, gone: asyncio.Event) -> bytes:
        """The reply to a request.

        Args:
            request: a task and its JSON, separated by a line break.
            seconds: that it may take, once it is its turn.
            gone: set where the reply is no longer wanted.

        Raises:
            GoneError, TooLongError, BrokenError: where there is no reply.
        """
        async with self._turn:
            if gone.is_set():
                raise GoneError
            self._unwanted.value = 0
            reply = asyncio.create_task(asyncio.to_thread(self._exchange, request))
            left = asyncio.create_task(gone.wait())
            await asyncio.wait({reply, left}, timeout=seconds, return_when="FIRST_COMPLETED")
            left.cancel()
            if not reply.done():
                await self._call_off(reply)
                raise GoneError if gone.is_set() else TooLongError
            return self._whole(await reply)

    def _exchange(self, request: bytes) -> bytes:
        try:
            self._connection.send_bytes(request)
            return bytes(self._connection.recv_bytes())
        except (EOFError, OSError):
            return b""

    def _whole(self, reply: bytes) -> bytes:
        if not reply:
            self._replace()
            raise BrokenError
        if reply == CALLED_OFF:
            raise GoneError
        return reply

    async def _call_off(self, reply: asyncio.Task[bytes]) -> None:
        """The simulation sees the flag at its next step; what does not is ended."""
        self._unwanted.value = 1
        await asyncio.wait({reply}, timeout=_GRACE)
        if not reply.done():
            self._process.kill()
            await reply
        if not reply.result():
            self._replace()

    def _replace(self) -> None:
        self.end()
        with suppress(EOFError, OSError):  # no new process while the server itself is ending
            self._start()

    def _start(self) -> None:
        self._connection, other = self._context.Pipe()
        self._unwanted = self._context.RawValue("i", 0)
        own = astuple(self._own) if self._own else None
        self._process = self._context.Process(
            target=work, args=(other, self._unwanted, own), daemon=True
        )
        self._process.start()
        other.close()

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.join()
        with suppress(OSError):
            self._connection.close()


class WorkerPool:
    """Workers by what they are for; those not asked for longest make room.

    Args:
        own: a system of the user's own.
    """

    def __init__(self, own: Own | None) -> None:
        self._own = own
        self._context = get_context(_METHOD)
        if _METHOD == "forkserver":
            self._context.set_forkserver_preload(["polhode.lab._task_handler"])
        self._workers: OrderedDict[str, Worker] = OrderedDict()
        self._spare: asyncio.Task[Worker] | None = None
        self._door = asyncio.Lock()

    def begin(self) -> None:
        """Have a worker ready before anyone asks."""
        self._spare = asyncio.create_task(asyncio.to_thread(self._made))

    async def worker(self, purpose: str) -> Worker:
        """The worker for a purpose, such as the motions of one system."""
        async with self._door:
            if purpose not in self._workers:
                self._make_room()
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

    def _made(self) -> Worker:
        return Worker(self._context, self._own)

    def _make_room(self) -> None:
        idle = [purpose for purpose, worker in self._workers.items() if not worker.busy]
        for purpose in idle[: max(len(self._workers) - _MOST + 1, 0)]:
            self._workers.pop(purpose).end()
