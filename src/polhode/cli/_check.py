"""Check a published equation against the exact model of a system."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from polhode.algebra import symbol
from polhode.base import NumericError, ParseError, Tell, within
from polhode.cli._contact_options import add_slipping_options, exactly_declared
from polhode.cli._exit import flag
from polhode.cli._parser import Parser
from polhode.cli._printing import document, printed
from polhode.cli._systems import entry_of
from polhode.derive import derive
from polhode.judge import Answer, CheckRequest, Verdict, uncorrected

#: Exit code and text of an answer.
Result = tuple[int, str]

# Exact simplification has no bound on its cost: a command must still answer in a minute.
_LONGEST = 60.0  # s of computing
_ADVICE = "judge its members one by one, or restrict it with --given"
_EPILOG = """\
Every verdict says what the letters were taken to mean. The answers, with the exit code:
  holds        true (0)
  approximate  true to the order that --small or the text states (0)
  fails        false, with a state that shows it and, where one is found, a correction (1)
  ambiguous    readings of a letter lead to different verdicts; choose one with --read (2)
  definition   only defines a new letter; not judged (2)
  unread       could not be read or decided, for the reason given (2)

Contexts: identity (for every state), motion (on every true motion), steady (on steady motions),
threshold (a condition of stability or existence), limit (to an order; give --small),
launch (from a start), number (to the printed digits)."""
_CODES = {
    Answer.FAILS: 1,
    Answer.UNREAD: 2,
    Answer.AMBIGUOUS: 2,
    Answer.DEFINITION: 2,
}


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_system()
    parser.add_argument(
        "latex", metavar="LATEX", help="the equation as printed, in single quotes: 'E = T + V'"
    )
    parser.add_option(
        "--context C",
        "kind of statement: identity, motion (default), steady, threshold, limit, launch or number",
        default="motion",
    )
    parser.add_list("--let 'SYMBOL = VALUE'", "define a new symbol: --let 'epsilon = theta - pi/2'")
    parser.add_list("--given 'A = B'", "restrict the motion: --given 'theta = pi/2'")
    parser.add_list(
        "--small SYMBOL:ORDER", "expand in a small quantity, to this order: --small epsilon:1"
    )
    parser.add_list(
        "--read 'LETTER = MEANING'",
        "choose what a letter means that books use for several quantities, where the verdict is "
        "ambiguous: --read 'L = about pivot'. For any other meaning, the error lists the choices",
    )
    parser.add_list(
        "--positive QUANTITY",
        "state that a quantity is positive where the text relies on it, as in |F| = F: "
        "--positive 'sin(alpha)', --positive v_x",
    )
    add_slipping_options(parser)
    parser.epilog = _EPILOG
    parser.add_json()


def run(options: Namespace) -> int:
    """Judge one equation and print the verdict; exit 0 if it holds, 1 if it fails, else 2."""
    if not options.latex.strip():
        raise ParseError(
            "an empty equation",
            expected="LaTeX in single quotes",
            advice=f"for instance polhode check {options.name} 'E = T + V'",
        )
    entry = entry_of(options.name)
    equations = derive(exactly_declared(entry, options))
    known = {symbol.published for symbol in equations.parameters}
    further = tuple(symbol(name).latex() for name in entry.defaults if name not in known)
    request = CheckRequest(
        options.latex,
        options.context,
        tuple(options.let),
        tuple(options.given),
        tuple(options.small),
        tuple(options.read),
        tuple(options.positive),
        further,
    )
    interim: list[Result] = []

    slipping = ("while the contacts slip",) if options.mu else ()

    def result(verdict: Verdict) -> Result:
        verdict = replace(verdict, remarks=(*verdict.remarks, *slipping))
        text = document(_document(verdict)) if options.json else "\n".join(_lines(verdict))
        return _CODES.get(verdict.answer, 0), text

    def judged(tell: Tell[Result]) -> Result:
        def tell_failure(failure: Verdict) -> None:
            tell(result(uncorrected(failure, _LONGEST)))

        return result(request.judged(equations, tell_failure))

    try:
        code, text = within(_LONGEST, judged, advice=_ADVICE, heard=interim.append)
    except NumericError:  # out of time; a failure already found is reported without a correction
        if not interim:
            raise
        code, text = interim[-1]
    print(text)
    return code


def _document(verdict: Verdict) -> dict[str, Any]:
    example, confirmation = verdict.counterexample, verdict.confirmation
    return {
        "verdict": verdict.answer.value,
        "context": verdict.context,
        "correction": verdict.correction and verdict.correction.to_json(),
        "alternatives": [other.to_json() for other in verdict.alternatives],
        "counterexample": example and example.to_json(),
        "confirmation": confirmation
        and {
            "left": confirmation.left,
            "right": confirmation.right,
            "agrees": confirmation.agrees,
        },
        "order": verdict.order,
        "dropped": None if verdict.dropped is None else printed(verdict.dropped),
        "residual": [
            {"member": r.member + 1, "component": r.component, **printed(r.expression)}
            for r in verdict.residuals
        ],
        "reason": verdict.reason,
        "remarks": list(verdict.remarks),
        "readings": [reading.to_json() for reading in verdict.readings],
        "error_bound": verdict.error_bound,
    }


def _lines(verdict: Verdict) -> Iterator[str]:
    yield verdict.answer.value
    if verdict.reason:
        yield f"  {verdict.reason}{flag(verdict.option)}"
    if verdict.correction is not None:
        yield f"  {verdict.correction.what}; it holds as"
        yield f"    {verdict.correction.latex}"
    for other in verdict.alternatives:
        yield f"  or, {other.what}: {other.latex}"
    for residual in verdict.residuals:
        yield f"  left minus right, {residual}"
    if (example := verdict.counterexample) is not None:
        yield f"  for example, at {example.state}:"
        yield "    left {}, right {}".format(*example.sides)
    if (second := verdict.confirmation) is not None:
        agreement = "agrees" if second.agrees else "disagrees"
        yield f"  numerical Newton-Euler {agreement}: {second.left:.9g} and {second.right:.9g}"
    if verdict.dropped is not None:
        yield f"  neglected: {verdict.dropped}"
    yield from (f"  {note}" for note in verdict.notes)
