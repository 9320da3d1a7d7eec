"""One claim checked against a model, in a process that ends where it takes too long."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from math import inf

from polhode.base import ForkedWorker, NumericError, ParseError, Tell, can_part, within
from polhode.claims._check import CheckRequest
from polhode.claims._verdict import Verdict
from polhode.claims.meaning._mechanics import EquationsKey
from polhode.derive import Equations, equations_only

LONGEST = 60.0  # s of processor time

_ADVICE = "judge its members one by one, restrict it with given, or allow more seconds"
_KEPT = 2


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

    It is judged in a copy of this process, which is kept for the next claim on the same equations
    and ended where it takes too long. On macOS and Windows, where a process cannot be copied, the
    judgement is interrupted instead, between steps of Python and in the main thread alone.

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
        seconds: of processor time that it may take; None for as long as it takes, in this process.
        tell: called with a failure as soon as it is found; a correction may take longer.

    Returns:
        The verdict with its evidence and with what its letters were taken to mean; ``unread`` for
        what cannot be read or bound, ``ambiguous`` where readings that the field allows lead to
        different verdicts. A failure for which no correction was found in time says so.

    Raises:
        ParseError: for an unknown context, a `let` of a known symbol, and unreadable restrictions.
        NumericError: for what cannot be decided in time, or takes too much memory.
    """
    if not isinstance(latex, str):
        raise ParseError(f"an equation of type {type(latex).__name__}", expected="LaTeX, as a str")
    equations_only(equations, "a claim about the motion")
    said = map(_several, (let, given, small, read, positive))
    enquiry = CheckRequest(latex, context, *said)
    if seconds is None:
        return enquiry.judged(equations, tell)
    if not isinstance(seconds, int | float) or not 0 < seconds < inf:
        raise NumericError(f"{seconds!r} s to judge in", expected="some time, or None for no bound")
    ask = _asked if can_part() else _interruptible
    told: list[Verdict] = []

    def heard(failure: Verdict) -> None:
        told.append(failure)
        tell(failure)

    try:
        return ask(enquiry, equations, seconds, heard)
    except NumericError:
        if not told:
            raise
        return uncorrected(told[-1], seconds)


def _several(texts: Iterable[str]) -> tuple[str, ...]:
    """Several texts, or one by itself."""
    return (texts,) if isinstance(texts, str) else tuple(texts)


def uncorrected(failure: Verdict, seconds: float) -> Verdict:
    """A failure for which no correction was found in some seconds."""
    remark = f"looking for a correction took more than {seconds:g} s of computing"
    return replace(failure, remarks=(*failure.remarks, remark))


def _interruptible(
    enquiry: CheckRequest, equations: Equations, seconds: float, heard: Tell[Verdict]
) -> Verdict:
    return within(seconds, partial(enquiry.judged, equations), advice=_ADVICE, heard=heard)


_sittings: dict[EquationsKey, ForkedWorker[CheckRequest, Verdict]] = {}
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_sittings.clear)  # they answer the process that began them


def _asked(
    enquiry: CheckRequest, equations: Equations, seconds: float, heard: Tell[Verdict]
) -> Verdict:
    """Ask the process that judges claims on these equations, which nobody else asks meanwhile."""
    sitting = _sittings.pop(EquationsKey(equations), None)
    if sitting is None or not sitting.is_open:
        sitting = ForkedWorker(lambda asked, tell: asked.judged(equations, tell))
    try:
        return sitting.ask(enquiry, seconds, _ADVICE, heard)
    finally:
        _keep(EquationsKey(equations), sitting)


def _keep(the: EquationsKey, sitting: ForkedWorker[CheckRequest, Verdict]) -> None:
    """Keep it for the next claim, and few of its like."""
    if not sitting.is_open:
        return
    other, _sittings[the] = _sittings.get(the), sitting
    surplus = [_sittings.pop(old) for old in list(_sittings)[:-_KEPT]]
    for old in filter(None, [other, *surplus]):
        old.close()
