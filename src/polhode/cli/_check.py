"""Check a published equation against the exact model of a system."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from polhode.base import NumericError, Tell, within
from polhode.claims import Answer, CheckRequest, Verdict, uncorrected
from polhode.cli._exit import flag
from polhode.cli._parser import Parser
from polhode.cli._printing import document, printed
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.derive import derive

#: Exit code, and what is printed.
Said = tuple[int, str]

_LONGEST = 60.0  # s of computing
_ADVICE = "judge its members one by one, or restrict it with --given"
_CODES = {
    Answer.FAILS: 1,
    Answer.UNREAD: 2,
    Answer.AMBIGUOUS: 2,
    Answer.DEFINITION: 2,
}


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=NAME_HELP)
    parser.add_argument("latex", metavar="LATEX", help="the equation, as printed")
    parser.add_argument(
        "--context",
        default="motion",
        metavar="C",
        help="identity, motion, steady, threshold, limit, launch or number",
    )
    for option, example in (
        ("--let", "a new symbol: --let 'epsilon = theta - pi/2'"),
        ("--given", "a restriction: --given 'theta = pi/2'"),
        ("--small", "a small quantity and the order kept: --small epsilon:1"),
        ("--read", "a letter of several meanings: --read 'L = about pivot'"),
        ("--positive", "a quantity that is positive: --positive 'sin(alpha)'"),
    ):
        parser.add_argument(option, action="append", default=[], help=example)
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Judge one equation and print the verdict; 0 where it holds, 1 where it fails, else 2."""
    system = entry_of(options.name).build()
    said_besides = (options.let, options.given, options.small, options.read, options.positive)
    extra = map(tuple, said_besides)
    enquiry = CheckRequest(options.latex, options.context, *extra)

    said = _in_json if options.json else _in_words
    told: list[Said] = []

    def judged(tell: Tell[Said]) -> Said:
        def tell_failure(failure: Verdict) -> None:
            tell(said(uncorrected(failure, _LONGEST)))

        return said(enquiry.judged(derive(system), tell_failure))

    try:
        code, text = within(_LONGEST, judged, advice=_ADVICE, heard=told.append)
    except NumericError:
        if not told:
            raise
        code, text = told[-1]
    print(text)
    return code


def _in_json(verdict: Verdict) -> Said:
    return _CODES.get(verdict.answer, 0), document(_document(verdict))


def _in_words(verdict: Verdict) -> Said:
    return _CODES.get(verdict.answer, 0), "\n".join(_told(verdict))


def _document(verdict: Verdict) -> dict[str, Any]:
    return {
        "verdict": verdict.answer.value,
        "context": verdict.context,
        "correction": verdict.correction and verdict.correction.to_json(),
        "alternatives": [other.to_json() for other in verdict.alternatives],
        "counterexample": _counterexample(verdict),
        "confirmation": _confirmation(verdict),
        "order": verdict.order,
        "dropped": None if verdict.dropped is None else printed(verdict.dropped),
        "residual": [
            {"member": r.member + 1, "component": r.component, **printed(r.expression)}
            for r in verdict.residuals
        ],
        "reason": verdict.reason,
        "remarks": list(verdict.remarks),
        "readings": [reading.to_json() for reading in verdict.readings],
    }


def _counterexample(verdict: Verdict) -> dict[str, Any] | None:
    found = verdict.counterexample
    if found is None:
        return None
    return {"values": dict(found.values), "left": str(found.left), "right": str(found.right)}


def _confirmation(verdict: Verdict) -> dict[str, Any] | None:
    found = verdict.confirmation
    if found is None:
        return None
    return {"left": found.left, "right": found.right, "agrees": found.agrees}


def _told(verdict: Verdict) -> Iterator[str]:
    yield verdict.answer.value
    if verdict.reason:
        yield f"  {verdict.reason}{flag(verdict.option)}"
    if verdict.correction is not None:
        yield f"  {verdict.correction.what}; it holds as"
        yield f"    {verdict.correction.latex}"
    for other in verdict.alternatives:
        yield f"  or, {other.what}: {other.latex}"
    for residual in verdict.residuals:
        yield f"  left less right, {residual}"
    if (found := verdict.counterexample) is not None:
        state = ", ".join(f"{name} = {value}" for name, value in found.values.items())
        yield f"  for example at {state}:"
        yield f"    left {found.left}, right {found.right}"
    if (second := verdict.confirmation) is not None:
        said = "the same" if second.agrees else "otherwise"
        yield f"  numeric Newton-Euler says {said}: {second.left:.9g} and {second.right:.9g}"
    if verdict.dropped is not None:
        yield f"  left out: {verdict.dropped}"
    yield from (f"  {note}" for note in verdict.notes)
