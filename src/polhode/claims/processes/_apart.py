"""Claims judged in processes of their own, which end where they take too long."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing.connection import Connection, wait
from subprocess import DEVNULL, PIPE, Popen
from time import monotonic, perf_counter

from polhode.base import DeclarationError, PolhodeError, Progress, SilentProgress, StopRequested
from polhode.claims._audit import asked_for, reported
from polhode.claims._verdict import Answer, Verdict
from polhode.claims.document._document import Claim, Document
from polhode.claims.document._report import Report
from polhode.claims.processes._worker import ClaimSubject, Reply, Request
from polhode.model import System

Declared = Callable[[str], System]

_PATIENCE = 6.0  # times the processor time that a claim may take, on a machine that has others
_OUT_OF_TIME = (-27, -9)  # ended by its own clock (SIGPROF), or by us
_ALONE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}  # workers share the cores


@dataclass(frozen=True)
class ClaimLimits:
    """What one claim may cost.

    Attributes:
        seconds: of processor time.
        memory: bytes, where the operating system has such a bound.
    """

    seconds: float = 30.0
    memory: int = 4 << 30


def audit_apart(
    document: Document,
    declared: Declared,
    *,
    only: Iterable[str] = (),
    workers: int = 2,
    limits: ClaimLimits | None = None,
    progress: Progress | None = None,
) -> Report:
    """Judge every claim of a document, or those with some ids, in processes of their own.

    A claim that takes too long or too much memory is unread, with that as its reason; the others
    go on. An interruption keeps what is judged by then, and names what is left.

    Args:
        document: what a text states, and how its symbols are meant.
        declared: gives a system by its name.
        only: ids of the claims to judge; all of them if empty.
        workers: number of processes.
        limits: what one claim may cost.
        progress: told of every claim.

    Raises:
        ParseError: for an id that the document does not have.
        DeclarationError: for fewer workers than one.
    """
    if workers < 1:
        raise DeclarationError(f"{workers} workers", expected="one or more")
    began, told = perf_counter(), progress or SilentProgress()
    asked, bounds = asked_for(document, only), limits or ClaimLimits()
    cases, verdicts = _cases(document, asked, cache(declared))
    told.begin("audit", len(cases))
    try:
        with closing(_judged(cases, workers, bounds)) as judged:
            for claim, verdict in judged:
                verdicts[claim.id] = verdict
                told.advance()
    except (KeyboardInterrupt, StopRequested):
        pass  # the report names what is left
    finally:
        told.finish()
    return reported(document, asked, verdicts, perf_counter() - began)


@dataclass(frozen=True)
class _Case:
    """A claim to be judged, and what it is about."""

    claim: Claim
    subject: ClaimSubject

    @property
    def system(self) -> str:
        """Name of the system that it is about."""
        return self.subject.part.system


def _cases(
    document: Document, asked: Iterable[Claim], declared: Declared
) -> tuple[list[_Case], dict[str, Verdict]]:
    """What workers are to judge, and the verdicts on claims whose system is not there."""
    cases: list[_Case] = []
    unread: dict[str, Verdict] = {}
    for claim in asked:
        part = document.part_of(claim)
        try:
            system = declared(part.system)
        except PolhodeError as error:
            unread[claim.id] = Verdict(Answer.UNREAD, claim.context, reason=str(error))
        else:
            cases.append(_Case(claim, ClaimSubject(part, system)))
    return cases, unread


def _judged(
    cases: Sequence[_Case], workers: int, limits: ClaimLimits
) -> Generator[tuple[Claim, Verdict]]:
    queue = _Queue(cases)
    with ExitStack() as crew:
        busy = [_Worker(limits) for _ in range(min(workers, len(cases)))]
        for worker in busy:
            crew.callback(worker.end)
        while busy:
            wait([worker.replies for worker in busy], min(worker.left for worker in busy))
            for worker in busy:
                yield from worker.collected()
                worker.take(queue)
            busy = [worker for worker in busy if not worker.idle]


class _Queue:
    """Cases by system, so that a worker derives few of them."""

    def __init__(self, cases: Iterable[_Case]) -> None:
        self._waiting: dict[str, list[_Case]] = {}
        for case in cases:
            self._waiting.setdefault(case.system, []).insert(0, case)

    def next(self, system: str) -> _Case | None:
        """One about this system, or else about that of which most are waiting."""
        if not self._waiting.get(system):
            system = max(self._waiting, key=lambda name: len(self._waiting[name]))
        waiting = self._waiting[system]
        return waiting.pop() if waiting else None


class _Worker:
    """A process that judges one claim at a time; one that does not come back is replaced."""

    def __init__(self, limits: ClaimLimits) -> None:
        self._limits = limits
        self._begin()

    def _begin(self) -> None:
        self._process = Popen(
            [sys.executable, "-m", "polhode.claims.processes._worker", str(self._limits.memory)],
            stdin=PIPE,
            stdout=PIPE,
            stderr=DEVNULL,
            env={**os.environ, **_ALONE},
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._requests = Connection(os.dup(self._process.stdin.fileno()), readable=False)
        self.replies = Connection(os.dup(self._process.stdout.fileno()), writable=False)
        self._process.stdin.close()
        self._process.stdout.close()
        self._case: _Case | None = None
        self._known: set[str] = set()  # parts that it was asked about
        self._failure: Verdict | None = None
        self._system = ""
        self._deadline = monotonic() + _PATIENCE * self._limits.seconds
        self.idle = False

    @property
    def left(self) -> float:
        """Seconds that it may still take."""
        return max(self._deadline - monotonic(), 0.0)

    def collected(self) -> Iterator[tuple[Claim, Verdict]]:
        """The verdict, if it is there or overdue."""
        if self.replies.poll():
            yield from self._reply()
        elif not self.left:
            yield from self._lost()

    def _reply(self) -> Iterator[tuple[Claim, Verdict]]:
        try:
            reply: Reply | None = self.replies.recv()
        except (EOFError, OSError):
            yield from self._lost()
            return
        if self._case is None or reply is None:  # it is ready
            self.idle = True
            return
        verdict, self.idle = reply
        if self.idle:
            yield self._case.claim, verdict
        else:
            self._failure = verdict

    def _lost(self) -> Iterator[tuple[Claim, Verdict]]:
        """Begin again without the claim at hand."""
        self.end()
        if self._case is None:
            raise DeclarationError(
                "a worker process that does not start",
                expected=f"{sys.executable} to import polhode",
                advice="judge in this process, with polhode.claims.audit",
            )
        yield self._case.claim, self._last_word(self._case.claim)
        self._begin()

    def _last_word(self, claim: Claim) -> Verdict:
        """What is known of a claim whose process ended."""
        if self._failure is not None:
            return replace(self._failure, remarks=(*self._failure.remarks, self._why))
        why = f"it was read, but not decided: {self._why}"
        return Verdict(Answer.UNREAD, claim.context, reason=why)

    @property
    def _why(self) -> str:
        if self._process.returncode in _OUT_OF_TIME:
            return f"looking further took more than {self._limits.seconds:g} s of processor time"
        return "the process that looked further ended, for lack of memory perhaps"

    def take(self, queue: _Queue) -> None:
        """Begin the next claim, if there is one."""
        if not self.idle:
            return
        self._case = queue.next(self._system)
        if self._case is not None:
            self._failure = None
            self._system = self._case.system
            self._deadline = monotonic() + _PATIENCE * self._limits.seconds
            with suppress(BrokenPipeError):  # its replies will tell that it has ended
                self._requests.send(self._request(self._case))
            self.idle = False

    def _request(self, case: _Case) -> Request:
        """The claim, with what it is about where the process was not asked about that before."""
        is_known = case.claim.part in self._known
        self._known.add(case.claim.part)
        return Request(case.claim, None if is_known else case.subject, self._limits.seconds)

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        self._requests.close()
        self.replies.close()
