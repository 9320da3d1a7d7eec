"""The process that judges claims for another: one at a time, within bounds of time and memory."""

from __future__ import annotations

import gc
import os
import signal
import sys
from contextlib import suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection

from polhode.base import bound_memory, bound_time, ended_with
from polhode.claims._audit import ClaimChecker
from polhode.claims._verdict import Answer, Verdict
from polhode.claims.document._document import Claim, Part
from polhode.derive import Equations, derive
from polhode.model import System

_RARELY = 50_000  # objects that wait for the collector; nearly all are freed without it

#: A verdict, and whether it is the last word on its claim.
Reply = tuple[Verdict, bool]


@dataclass(frozen=True)
class ClaimSubject:
    """What claims are about.

    Attributes:
        part: of the document that they stand in.
        system: that it treats.
    """

    part: Part
    system: System


@dataclass(frozen=True)
class Request:
    """A claim to be judged.

    Attributes:
        claim: itself.
        subject: that it is about; None for one that this process was asked about before.
        seconds: of processor time, after which the process ends itself.
    """

    claim: Claim
    subject: ClaimSubject | None
    seconds: float


def work(requests: Connection, replies: Connection) -> None:
    """Send None when ready, then verdicts for every request, until no more come."""
    systems: dict[str, System] = {}
    parts: dict[str, Part] = {}
    equations: dict[str, Equations] = {}

    def resolved(name: str) -> Equations:
        if name not in equations:
            equations[name] = derive(systems[name])
        return equations[name]

    desk = ClaimChecker(resolved)
    replies.send(None)
    while True:
        try:
            request: Request = requests.recv()
        except EOFError:
            return
        if request.subject is not None:
            part = parts[request.claim.part] = request.subject.part
            systems[part.system] = request.subject.system
        bound_time(request.seconds)
        with ended_with(requests.fileno()):
            verdict = _verdict(desk, parts[request.claim.part], request.claim, replies)
        replies.send((verdict, True))
        bound_time(0)


def _verdict(desk: ClaimChecker, part: Part, claim: Claim, replies: Connection) -> Verdict:
    failures: list[Verdict] = []

    def tell(failure: Verdict) -> None:
        failures.append(failure)
        replies.send((failure, False))

    try:
        return desk.verdict(part, claim, tell)
    except MemoryError:
        why = "it was read, but not decided: it needs more memory than a claim is allowed"
    except Exception as error:  # a fault of the program's is told, and the others go on
        why = f"unexpected {type(error).__name__}: {error}"[:500]
    if failures:
        return replace(failures[-1], remarks=(*failures[-1].remarks, why))
    return Verdict(Answer.UNREAD, claim.context, reason=why)


def _own_output() -> int:
    """The pipe to whoever asks, out of reach of anything that prints."""
    pipe = os.dup(sys.stdout.fileno())
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return pipe


def main() -> None:
    """Work for the process at the other end of standard input and output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who asks ends us
    gc.set_threshold(_RARELY)
    bound_memory(int(sys.argv[1]))
    replies = Connection(_own_output(), readable=False)
    with suppress(BrokenPipeError):
        work(Connection(os.dup(sys.stdin.fileno()), writable=False), replies)


if __name__ == "__main__":
    main()
