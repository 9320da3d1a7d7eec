"""Worker processes: they answer questions one after another, within limits, and end with us.

Everything that polhode computes in another process of this machine goes through `Worker`, one
process, or `answers`, which distributes tasks among several:

- a question may have a limit on processor time, which the operating system enforces even deep in
  compiled code, and on wall time, six times as long; a worker may have one on memory;
- a worker that ends for any reason is noticed by its closed pipe, and reported;
- Ctrl-C reaches this process alone, which ends its workers; answers received are kept;
- a worker ends by itself when this process ends, even by SIGKILL: by the signal of a pipe that is
  open as long as this process lives, or, where pipes send none, at its next read.

Is it safe to fork while other threads run? Not in general, and Python 3.12 warns about it: the
copy has only one thread, and a lock that another thread held stays locked in it for ever. So a
process starts in one of three ways (`StartMethod`):

- FRESH, a new interpreter, is the rule: audits, ensembles, sweeps and the tour. It shares nothing
  with our threads, whether of BLAS, heyoka (TBB, LLVM), asyncio or the caller.
- SERVER, for the workers of the lab, which must be ready within milliseconds although the lab runs
  asyncio and threads. They are forks of a server process that has imported modules and done nothing
  else; its only threads are those of OpenBLAS, which ends them before a fork and restarts them when
  they are needed.
- COPY, a fork of this process, serves to check a claim (`ph.check`, `polhode check`) and to derive
  the equations of a file that is being loaded (`ph.load`): what it needs, such as equations that
  may have taken seconds to derive, is already there. The copy keeps none of our files open and
  never returns to our stack. Python, the C library and OpenBLAS renew their own locks at a fork,
  and the copy uses neither heyoka nor asyncio. If it did meet a lock that stays locked, its time
  limit would end it, and the claim would be reported as undecided or the file as not loaded: the
  caller never hangs. On macOS, whose own libraries do not survive a fork, it is not used.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Collection, Generator, Iterator, Mapping
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from threading import RLock, current_thread, main_thread
from time import monotonic
from typing import Any, Generic

from polhode.base._errors import NumericError
from polhode.base._processes import (
    Message,
    Pipes,
    Question,
    Reply,
    Setup,
    StartMethod,
    Tell,
    begin_process,
    send_setup,
)

COPY_MEMORY = 4 << 30
"""Bytes that a copy may take beyond what this process holds."""

_PATIENCE = 6.0  # wall time over processor time, for a machine that has other work


class WorkerEndedError(Exception):
    """A worker process ended without an answer.

    Attributes:
        out_of_time: whether its time limit ended it.
        was_ready: whether it had been ready to answer.
    """

    def __init__(self, *, out_of_time: bool, was_ready: bool) -> None:
        super().__init__("a worker process ended without an answer")
        self.out_of_time = out_of_time
        self.was_ready = was_ready

    def explained(self, seconds: float, advice: str) -> NumericError:
        """The error of a computation that had some seconds of processor time."""
        if self.out_of_time:
            return _too_long(seconds, advice)
        return NumericError(
            "the computing process ended unexpectedly, perhaps for lack of memory",
            expected="something that can be decided with less memory",
            advice=advice,
        )


class Worker(Generic[Question, Reply]):
    """A process that answers questions, one after another.

    Args:
        setup: run in the process; gives the function that answers, whose second argument reports
            something before the answer. It is pickled, except for a copy.
        start: how the process begins.
        memory: bytes that it may hold, a copy beyond what this process holds; None for no limit.
        environment: variables added to those of this process, for a new interpreter.
        ready_within: seconds that it may take to get ready; None for no limit.
    """

    def __init__(
        self,
        setup: Setup[Question, Reply],
        start: StartMethod = StartMethod.FRESH,
        *,
        memory: int | None = None,
        environment: Mapping[str, str] | None = None,
        ready_within: float | None = None,
    ) -> None:
        from multiprocessing.connection import Pipe  # needed by few, and slow to load

        questions, self._questions = Pipe(duplex=False)
        self.replies, replies = Pipe(duplex=False)
        parent, self._parent = Pipe(duplex=False)
        self._is_ready = False
        self._exit_code: int | None = None
        self._closing = RLock()
        self._deadline = None if ready_within is None else monotonic() + ready_within
        with closing(Pipes(questions, replies, parent)) as theirs:
            self._process = begin_process(start, setup, theirs, memory, environment or {})
        with suppress(BrokenPipeError):  # its end is noticed once a message is waited for
            send_setup(self._process, setup, self._questions)

    @property
    def pid(self) -> int:
        """Its process id."""
        return self._process.pid

    @property
    def is_open(self) -> bool:
        """Whether it can take another question; its process may have been ended from outside."""
        return self._exit_code is None and not self.replies.poll()

    @property
    def left(self) -> float | None:
        """Seconds until it is out of time; None where it has no limit."""
        return None if self._deadline is None else max(self._deadline - monotonic(), 0.0)

    def ask(
        self,
        question: Question,
        seconds: float | None = None,
        heard: Tell[Reply] = lambda report: None,
    ) -> Reply:
        """The answer to a question. A worker interrupted while computing it is closed.

        Args:
            question: is pickled.
            seconds: of processor time that it may take; None for no limit.
            heard: called with each report of the worker before its answer.

        Raises:
            WorkerEndedError: where the process ended, or ran out of time; the worker is closed.
            Exception: whatever was raised instead of an answer.
        """
        try:
            ready: tuple[Message, Any] = (Message.READY, None)
            kind, content = ready if self._is_ready else self.receive()
            while kind in (Message.READY, Message.TOLD):
                if kind is Message.READY:
                    self.send(question, seconds)
                else:
                    heard(content)
                kind, content = self.receive()
        except BaseException:
            self.close()
            raise
        if kind is Message.ERROR:
            raise content
        return content  # type: ignore[no-any-return]

    def send(self, question: Question, seconds: float | None = None) -> None:
        """Ask a worker that is ready; its messages are to be received."""
        self._deadline = None if seconds is None else monotonic() + _PATIENCE * seconds
        with suppress(OSError):  # its end is noticed once a message is waited for
            self._questions.send((question, seconds or 0.0))

    def receive(self) -> tuple[Message, Any]:
        """The next message, awaited until the time limit.

        Raises:
            WorkerEndedError: where the process ended, or ran out of time; the worker is closed.
        """
        overdue = False
        with suppress(EOFError, OSError):
            if self.replies.poll(self.left):
                kind, content = self.replies.recv()
                self._is_ready = self._is_ready or kind is Message.READY
                return kind, content
            overdue = True
        ended_by = -self.close()
        out_of_time = overdue or ended_by == getattr(signal, "SIGPROF", None)
        raise WorkerEndedError(out_of_time=out_of_time, was_ready=self._is_ready)

    def kill(self) -> None:
        """End the process; code that waits for its messages then notices."""
        self._process.kill()

    def close(self) -> int:
        """End the process, whatever it is doing; its exit code, or minus the signal number."""
        with self._closing:  # threads may notice the end at the same time
            if self._exit_code is None:
                self._process.kill()
                self._exit_code = self._process.exit_code()
                for pipe in (self._questions, self.replies, self._parent):
                    pipe.close()
            return self._exit_code


# -- several workers -------------------------------------------------------------------------------


@dataclass(frozen=True)
class Outcome(Generic[Question, Reply]):
    """The outcome of a task.

    Attributes:
        task: given to a worker.
        reply: its answer; None if there is none.
        told: reports before the answer.
        lost: how its worker ended; None if there is an answer.
    """

    task: Question
    reply: Reply | None
    told: tuple[Reply, ...]
    lost: WorkerEndedError | None = None


def answers(
    begin: Callable[[], Worker[Question, Reply]],
    workers: int,
    following: Callable[[Question | None], Question | None],
    *,
    seconds: float | None = None,
    retries: int = 0,
) -> Generator[Outcome[Question, Reply]]:
    """Tasks done by several workers, in the order in which they are finished.

    A worker that ends is replaced. All are ended with the generator, so it must be closed. Outcomes
    yielded before an interruption are complete.

    Args:
        begin: starts a worker.
        workers: their greatest number.
        following: gives the next task for a worker, by its last task or None for a new worker; None
            if no task is left.
        seconds: of processor time that a task may take; None for no limit.
        retries: how often a task whose worker ended is repeated.

    Raises:
        WorkerEndedError: where a worker ends before it is ready.
        Exception: whatever a worker raised instead of an answer.
    """
    seats: list[_Seat[Question, Reply]] = []
    try:
        while len(seats) < workers and (task := following(None)) is not None:
            seats.append(_Seat(begin, task, seconds, retries))
        while seats:
            for seat in _due(seats):
                outcome = seat.collected()
                if outcome is None:
                    continue
                task = following(seat.task)
                if task is None:
                    seats.remove(seat)
                    seat.worker.close()
                else:  # before the yield, so that the worker need not wait for the consumer
                    seat.take(task)
                yield outcome
    finally:
        for seat in seats:
            seat.worker.close()


def _due(seats: Collection[_Seat[Question, Reply]]) -> list[_Seat[Question, Reply]]:
    """Seats whose worker has sent something, has ended, or is out of time."""
    from multiprocessing.connection import wait

    left = [seat.worker.left for seat in seats]
    ready = wait(
        [seat.worker.replies for seat in seats],
        min((seconds for seconds in left if seconds is not None), default=None),
    )
    return [seat for seat in seats if seat.worker.replies in ready or seat.worker.left == 0]


class _Seat(Generic[Question, Reply]):
    """A task, and the worker that computes it or starts on it once ready."""

    def __init__(
        self,
        begin: Callable[[], Worker[Question, Reply]],
        task: Question,
        seconds: float | None,
        retries: int,
    ) -> None:
        self._begin, self._seconds, self._retries = begin, seconds, retries
        self.task = task
        self._told: list[Reply] = []
        self._losses = 0
        self.worker = begin()

    def collected(self) -> Outcome[Question, Reply] | None:
        """The outcome of the task; None if there is none yet."""
        try:
            kind, content = self.worker.receive()
        except WorkerEndedError as ended:
            if not ended.was_ready:
                raise
            if self._losses == self._retries:
                return Outcome(self.task, None, tuple(self._told), ended)
            self._losses += 1
            self._told.clear()
            self.worker = self._begin()
            return None
        match kind:
            case Message.READY:
                self.worker.send(self.task, self._seconds)
            case Message.TOLD:
                self._told.append(content)
            case Message.ERROR:
                raise content
            case Message.ANSWER:
                return Outcome(self.task, content, tuple(self._told))
        return None

    def take(self, task: Question) -> None:
        """Start the next task, with another worker if this one has ended."""
        self.task, self._told, self._losses = task, [], 0
        if self.worker.is_open:
            self.worker.send(task, self._seconds)
        else:
            self.worker.close()
            self.worker = self._begin()


# -- one task with a time limit --------------------------------------------------------------------


def within(
    seconds: float,
    task: Callable[[Tell[Reply]], Reply],
    *,
    advice: str,
    heard: Tell[Reply] = lambda report: None,
) -> Reply:
    """The result of a task with a limit on its processor time.

    It is computed in a copy of this process, which the operating system ends even deep in compiled
    code. A copy that ends without an answer before its time is over is replaced once, so that the
    task may report something twice. If no copy can be made the task is interrupted instead, between
    Python instructions.

    Args:
        seconds: of processor time.
        task: may report something before it is done.
        advice: for the error, if the task takes longer.
        heard: called with each report of the task.

    Raises:
        NumericError: once the time is over.
        Exception: whatever the task raised.
    """
    if not can_copy():
        with interrupted(seconds, advice=advice):
            return task(heard)
    try:
        return _in_copy(seconds, task, heard)
    except WorkerEndedError as ended:
        if ended.out_of_time:
            raise ended.explained(seconds, advice) from None
    try:  # once more: what ended it may have been a lock or memory of that moment
        return _in_copy(seconds, task, heard)
    except WorkerEndedError as ended:
        raise ended.explained(seconds, advice) from None


def _in_copy(seconds: float, task: Callable[[Tell[Reply]], Reply], heard: Tell[Reply]) -> Reply:
    with closing(
        Worker[None, Reply](
            lambda: lambda _, tell: task(tell), StartMethod.COPY, memory=COPY_MEMORY
        )
    ) as worker:
        return worker.ask(None, seconds, heard)


def can_copy() -> bool:
    """Whether a copy of this process may be made."""
    debugged = os.environ.get("POLHODE_DEBUG") == "1"  # a copy would lose the traceback
    # in a browser os.fork is there and fails
    return hasattr(os, "fork") and sys.platform not in ("darwin", "emscripten") and not debugged


class _TimeOver(BaseException):
    """Raised where a block is interrupted; no code in it takes it for a failed attempt."""


@contextmanager
def interrupted(seconds: float, *, advice: str) -> Iterator[None]:
    """Interrupt a block after this processor time, between Python instructions.

    Only the main thread is interrupted, where the system has a timer for it.

    Raises:
        NumericError: once the time is over.
    """
    if not hasattr(signal, "setitimer") or current_thread() is not main_thread():
        yield
        return

    def stop(*_: Any) -> None:
        raise _TimeOver

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    except _TimeOver:
        raise _too_long(seconds, advice) from None
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


def _too_long(seconds: float, advice: str) -> NumericError:
    return NumericError(
        f"more than {seconds:g} s of computing",
        expected="something that can be decided sooner",
        advice=advice,
    )
