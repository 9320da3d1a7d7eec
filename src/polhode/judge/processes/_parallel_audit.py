"""The claims of a document judged by several processes, each claim within limits."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cache, partial
from time import perf_counter

from polhode.base import (
    DeclarationError,
    Outcome,
    PolhodeError,
    Progress,
    SilentProgress,
    StopRequested,
    Tell,
    Worker,
    WorkerEndedError,
    answers,
    print_nothing,
)
from polhode.derive import Equations, derive
from polhode.judge._audit import (
    ClaimChecker,
    Line,
    in_part_readings,
    reported,
    selected_claims,
)
from polhode.judge._readings import Chosen
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.document._document import Claim, Document, Part
from polhode.judge.document._report import Report
from polhode.model import System

Declared = Callable[[str], System]

_READY_WITHIN = 6.0  # time to start, in units of the limit on the processor time of a claim
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}  # workers share the cores
# Objects allocated between two runs of the garbage collector: nearly all expressions are freed by
# reference counts, so the far lower default only spends time on scanning them.
_COLLECT_AFTER = 50_000


@dataclass(frozen=True)
class ClaimLimits:
    """What one claim may cost.

    Attributes:
        seconds: of processor time.
        memory: bytes, where the operating system has such a limit.
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
    """Judge every claim of a document, or those with the given ids, in worker processes.

    A claim that takes too long or too much memory is reported as unread for that reason, and the
    others go on. After an interruption, the report has the verdicts so far and names the rest.

    Args:
        document: the claims of a text, and the meaning of its symbols.
        declared: gives a system by its name.
        only: ids of the claims to judge; all of them if empty.
        workers: number of processes.
        limits: what one claim may cost.
        progress: advanced by one with every claim.

    Raises:
        ParseError: for an id that the document does not have.
        DeclarationError: for fewer workers than one.
    """
    if workers < 1:
        raise DeclarationError(f"{workers} workers", expected="one or more")
    began, shown = perf_counter(), progress or SilentProgress()
    claims, limits = selected_claims(document, only), limits or ClaimLimits()
    found = cache(declared)

    def judge(lines: Sequence[Line]) -> dict[str, Verdict]:
        tasks, verdicts = _tasks(document, lines, found)
        shown.begin("audit", len(tasks))
        try:
            with closing(_judged(tasks, workers, limits)) as judged:
                for outcome in judged:
                    verdicts[outcome.task.claim.id] = _verdict(outcome, limits)
                    shown.advance()
        except (KeyboardInterrupt, StopRequested):
            pass  # the report names the claims not reached
        except WorkerEndedError:
            raise DeclarationError(
                "a worker process that does not start",
                expected=f"{sys.executable} to import polhode",
                advice="judge in this process, with polhode.judge.audit",
            ) from None
        finally:
            shown.finish()
        return verdicts

    verdicts, readings = in_part_readings(document, claims, judge)
    return reported(document, claims, verdicts, readings, perf_counter() - began)


@dataclass(frozen=True)
class _Task:
    """A claim to be judged, with its part of the text, its system and the readings chosen."""

    claim: Claim
    part: Part
    system: System
    chosen: Chosen


def _tasks(
    document: Document, lines: Iterable[Line], declared: Declared
) -> tuple[list[_Task], dict[str, Verdict]]:
    """The claims that workers are to judge, and verdicts on those whose system is unavailable."""
    tasks: list[_Task] = []
    unread: dict[str, Verdict] = {}
    for line in lines:
        claim, part = line.claim, document.part_of(line.claim)
        try:
            tasks.append(_Task(claim, part, declared(part.system), line.chosen))
        except PolhodeError as error:
            unread[claim.id] = Verdict(Answer.UNREAD, claim.context, reason=str(error))
    return tasks, unread


def _judged(
    tasks: Iterable[_Task], workers: int, limits: ClaimLimits
) -> Generator[Outcome[_Task, Verdict]]:
    queues: dict[str, list[_Task]] = {}
    for task in tasks:
        queues.setdefault(task.part.system, []).insert(0, task)

    def following(last: _Task | None) -> _Task | None:
        """A claim on the system that this worker has derived, else on the one with most left."""
        same = queues.get(last.part.system) if last is not None else None
        queue = same or max(queues.values(), key=len, default=[])
        return queue.pop() if queue else None

    begin = partial(
        Worker[_Task, Verdict],
        _claim_checker,
        memory=limits.memory,
        environment=_ONE_THREAD,
        ready_within=_READY_WITHIN * limits.seconds,
    )
    return answers(begin, workers, following, seconds=limits.seconds)


def _verdict(outcome: Outcome[_Task, Verdict], limits: ClaimLimits) -> Verdict:
    """The verdict of a worker; where it was ended, the last failure it reported, or unread."""
    if outcome.lost is None:
        assert outcome.reply is not None
        return outcome.reply
    why = "the worker process ended before it was done, perhaps for lack of memory"
    if outcome.lost.out_of_time:
        why = f"judging took more than {limits.seconds:g} s of processor time"
    if outcome.told:
        return _remarked(outcome.told[-1], why)
    why = f"it was read, but not decided: {why}"
    return Verdict(Answer.UNREAD, outcome.task.claim.context, reason=why)


def _remarked(failure: Verdict, remark: str) -> Verdict:
    return replace(failure, remarks=(*failure.remarks, remark))


# -- in a worker -----------------------------------------------------------------------------------


def _claim_checker() -> Callable[[_Task, Tell[Verdict]], Verdict]:
    """Judges claims in a worker, which keeps the equations it has derived."""
    gc.set_threshold(_COLLECT_AFTER)
    print_nothing()
    systems: dict[str, System] = {}
    equations: dict[str, Equations] = {}

    def resolved(name: str) -> Equations:
        if name not in equations:
            equations[name] = derive(systems[name])
        return equations[name]

    checker = ClaimChecker(resolved)

    def judge(task: _Task, tell: Tell[Verdict]) -> Verdict:
        systems[task.part.system] = task.system
        failures: list[Verdict] = []

        def failed(failure: Verdict) -> None:
            failures.append(failure)
            tell(failure)

        try:
            return checker.verdict(task.part, task.claim, task.chosen, failed)
        except MemoryError:
            why = "it was read, but not decided: it needs more memory than a claim is allowed"
        except Exception as error:  # report a bug of the program, and go on with other claims
            why = f"unexpected {type(error).__name__}: {error}"[:500]
        if failures:
            return _remarked(failures[-1], why)
        return Verdict(Answer.UNREAD, task.claim.context, reason=why)

    return judge
