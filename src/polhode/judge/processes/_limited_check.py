"""One claim checked against a model, in a worker process with a limit on its time."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from math import inf
from typing import TypeAlias

from polhode.base import (
    COPY_MEMORY,
    ByIdentity,
    NumericError,
    ParseError,
    StartMethod,
    Tell,
    Worker,
    WorkerEndedError,
    can_copy,
    within,
)
from polhode.derive import Equations, equations_only
from polhode.judge._check import CheckRequest
from polhode.judge._verdict import Verdict

LONGEST = 60.0  # s of processor time

_ADVICE = "judge its members one by one, restrict it with given, or allow more seconds"
_KEPT = 2  # idle workers, each of which holds a copy of the memory that it has changed

_ClaimWorker: TypeAlias = Worker[CheckRequest, Verdict]


def check(
    latex: str,
    equations: Equations,
    *,
    context: str = "motion",
    let: Iterable[str] = (),
    given: Iterable[str] = (),
    small: Iterable[str] = (),
    read: Iterable[str] = (),
    positive: Iterable[str] = (),
    seconds: float | None = LONGEST,
    tell: Callable[[Verdict], object] = lambda verdict: None,
) -> Verdict:
    r"""Judge a published equation against a model.

    The claim is judged in a forked copy of this process, which is kept for the next claim on the
    same equations and ended if it takes too long. On macOS and Windows, where processes cannot be
    forked, the claim is judged here and interrupted between steps of Python, in the main thread
    only.

    Args:
        latex: the equation, as printed.
        equations: of the system.
        context: where it is to hold: identity, motion, steady, threshold, limit, launch, number.
        let: new symbols of the text, in published names or LaTeX: ``epsilon = theta - pi/2``.
        given: restrictions, such as ``theta = pi/2``.
        small: small quantities with the order to be kept, such as ``epsilon:1``.
        read: letters that the field uses for several quantities, each with the one that is meant:
            ``L = about pivot``.
        positive: quantities that are positive, such as ``sin(alpha)``.
        seconds: limit on the processor time; None to judge in this process without a limit.
        tell: called with a failure as soon as it is found; the search for a correction may take
            longer.

    Returns:
        The verdict with its evidence and the meanings its letters were given; ``unread`` for an
        equation that cannot be read or bound, ``ambiguous`` where readings that the field allows
        lead to different verdicts. If no correction was found in time, the failure says so.

    Raises:
        ParseError: for an unknown context, a `let` of a known symbol, and unreadable restrictions.
        NumericError: for a claim that is not decided in time, or takes too much memory.
    """
    if not isinstance(latex, str):
        raise ParseError(f"an equation of type {type(latex).__name__}", expected="LaTeX, as a str")
    equations_only(equations, "a claim about the motion")
    texts = ((t,) if isinstance(t, str) else tuple(t) for t in (let, given, small, read, positive))
    request = CheckRequest(latex, context, *texts)
    if seconds is None:
        return request.judged(equations, tell)
    if not isinstance(seconds, int | float) or not 0 < seconds < inf:
        raise NumericError(
            f"a time limit of {seconds!r} s", expected="a positive number, or None for no limit"
        )
    failures: list[Verdict] = []

    def failed(failure: Verdict) -> None:
        failures.append(failure)
        tell(failure)

    try:
        if can_copy():
            return _by_worker(request, equations, seconds, failed)
        return within(seconds, partial(request.judged, equations), advice=_ADVICE, heard=failed)
    except NumericError:
        if not failures:
            raise
        return uncorrected(failures[-1], seconds)


def uncorrected(failure: Verdict, seconds: float) -> Verdict:
    """A failure with the remark that no correction was found within these seconds."""
    remark = f"looking for a correction took more than {seconds:g} s of computing"
    return replace(failure, remarks=(*failure.remarks, remark))


# Idle workers by the equations that they judge claims on; one that is busy is not among them.
_idle: dict[ByIdentity[Equations], _ClaimWorker] = {}
if hasattr(os, "register_at_fork"):
    # A worker answers only the process that started it; a fork must not write into its pipe.
    os.register_at_fork(after_in_child=_idle.clear)


def _by_worker(
    request: CheckRequest, equations: Equations, seconds: float, failed: Tell[Verdict]
) -> Verdict:
    """The verdict of the idle worker for these equations, or of a new one."""
    worker = _idle.pop(ByIdentity(equations), None)
    if worker is None or not worker.is_open:
        worker = _ClaimWorker(
            lambda: lambda task, tell: task.judged(equations, tell),
            StartMethod.COPY,
            memory=COPY_MEMORY,
        )
    try:
        return worker.ask(request, seconds, failed)
    except WorkerEndedError as ended:
        raise ended.explained(seconds, _ADVICE) from None
    finally:
        if worker.is_open:
            # Another thread may have put back one for the same equations in the meantime.
            other, _idle[ByIdentity(equations)] = _idle.get(ByIdentity(equations)), worker
            # Dictionaries keep the order of insertion: those unused for longest come first.
            surplus = [_idle.pop(old) for old in list(_idle)[:-_KEPT]]
            for old in filter(None, [other, *surplus]):
                old.close()
