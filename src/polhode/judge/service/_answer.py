"""An answer marked: its lines, and whether it gives what was asked for."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

from polhode.base import PolhodeError, Tell
from polhode.derive import Equations, derive
from polhode.judge._review import review
from polhode.judge._review_worker import ReviewRecord, prepare_process, record_of
from polhode.judge._reviewed import Mark, Review, ReviewedLine
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._keyboard import keyboard_latex
from polhode.judge.latex._tree import Node, Relation
from polhode.judge.output._hints import Hints, with_hints
from polhode.judge.service._asked import Asked, letters_in
from polhode.judge.source import SourceRelation, read_source
from polhode.model import System

_DELIMITED = re.compile(r"(?<!\\)\$|\\\(|\\\[|\\begin\s*\{")
_RELATES = re.compile(
    r"[=<>≤≥≈]|\\(?:leq?|geq?|approx|simeq|propto|equiv|to|neq?|ll|gg)(?![a-zA-Z])"
)
_WRONG = (Mark.ERROR, Mark.FOLLOWS, Mark.UNLINKED, Mark.NEEDS)


@dataclass(frozen=True)
class AnswerTask:
    """An answer to be marked.

    Attributes:
        text: of the answer: a derivation, a relation, or the right side of one.
        asked: the quantity asked for, or a relation whose left side it is; empty for none.
        given: what the problem states, before the answer: definitions, assumptions.
        letters: those in which the answer is to be given; empty for any.
        format: the ending that a file of the text would have.
        hints: how much is shown.
        correcting: s of processor time in which a correction of a wrong line is sought.
    """

    text: str
    asked: str = ""
    given: str = ""
    letters: tuple[str, ...] = ()
    format: str = ".tex"
    hints: Hints = Hints.WHERE
    correcting: float = 0.0


@dataclass(frozen=True)
class MarkedAnswer:
    """What is said of an answer.

    Attributes:
        record: its lines with their marks.
        is_correct: whether nothing in it is wrong and, where a quantity was asked for, a relation
            that is true by itself gives it.
        is_judged: whether anything in it could be judged.
        asked: what is said of the quantity asked for; empty where it was given, or none was.
    """

    record: ReviewRecord
    is_correct: bool = False
    is_judged: bool = False
    asked: str = ""


def answer_worker(system: System) -> Callable[[AnswerTask, Tell[MarkedAnswer]], MarkedAnswer]:
    """The function that marks answers in a worker, which derives the system once."""
    prepare_process()
    equations = derive(system)

    def mark(task: AnswerTask, tell: Tell[MarkedAnswer]) -> MarkedAnswer:
        try:
            return marked_answer(task, equations)
        except PolhodeError as error:
            return MarkedAnswer(ReviewRecord(problem=str(error)))
        except (MemoryError, RecursionError):
            return MarkedAnswer(ReviewRecord(problem="it is too large or too deeply nested"))
        except Exception as error:  # report a bug of the program, and go on with other answers
            return MarkedAnswer(
                ReviewRecord(problem=f"unexpected {type(error).__name__}: {error}"[:300])
            )

    return mark


def marked_answer(task: AnswerTask, equations: Equations) -> MarkedAnswer:
    """An answer marked against a model."""
    quantity = Asked.read(task.asked).quantity if task.asked else ""
    text = as_document(task.text, quantity)
    given = f"{task.given}\n\n" if task.given else ""
    before = len(read_source(given, task.format)) if given else 0
    whole = review(given + text, equations, format=task.format, seconds=task.correcting)
    relations = read_source(given + text, task.format)[before:]
    found = _without_first(whole, before, given.count("\n"))
    # What is asked for is closed by who asks: an answer that does not hold is wrong.
    unsettled = {Mark.NOT_JUDGED} if task.asked else {Mark.NOT_JUDGED, Mark.DOUBT}
    judged = [line for line in found.lines if line.mark not in unsettled]
    wrong = any(line.mark in _WRONG for line in judged)
    true = [
        (line, relation)
        for line, relation in zip(found.lines, relations, strict=True)
        if line.mark is Mark.TRUE
    ]
    record = record_of(with_hints(found, task.hints))
    if not task.asked:
        is_read = all(line in judged or line.is_stated for line in found.lines)
        return MarkedAnswer(record, bool(true) and is_read and not wrong, bool(judged))
    said = _said_of_asked(task, true, given, equations)
    return MarkedAnswer(record, not said and not wrong, bool(judged), said)


def as_document(text: str, asked: str = "") -> str:
    """An answer as a document: without delimiters, each of its lines is a formula, typed or LaTeX.

    A line that relates nothing is taken as the value of the quantity asked for.
    """
    if _DELIMITED.search(text):
        return text
    rows = [keyboard_latex(row) for row in text.splitlines() if row.strip()]
    full = (row if _RELATES.search(row) or not asked else f"{asked} = {row}" for row in rows)
    return "\n".join(rf"\[ {row} \]" for row in full)


def _without_first(found: Review, count: int, rows: int) -> Review:
    """A review without the lines of what the problem states; places count from the answer on."""

    def placed(line: ReviewedLine) -> ReviewedLine:
        of = None if line.of is None or line.of < count else line.of - count
        return replace(line, line=line.line - rows, of=of)

    return replace(found, lines=tuple(map(placed, found.lines[count:])))


# -- what was asked for ----------------------------------------------------------------------------

_MOST_TRIED = 6  # values that are judged by themselves


def _said_of_asked(
    task: AnswerTask,
    true: Sequence[tuple[ReviewedLine, SourceRelation]],
    given: str,
    equations: Equations,
) -> str:
    """Why the answer does not give what was asked for; empty if it does.

    The relation that gives it has to hold by itself: what the answer assumes on the way is no part
    of the problem.
    """
    asked = Asked.read(task.asked)
    allowed = frozenset[str]().union(
        *(letters_in(read_latex(letter).relations[0].sides[0]) for letter in task.letters)
    )

    def holds_alone(printed: str) -> bool:
        alone = review(f"{given}\\[ {printed} \\]", equations, format=".tex", seconds=0)
        return alone.lines[-1].mark is Mark.TRUE

    reason = f"no true line gives {asked.quantity} by other quantities"
    for line, found in reversed(true):
        values = asked.set_equal_to(found.relation) if found.relation is not None else ()
        if not values:
            continue
        beyond = frozenset[str]().union(*map(letters_in, values)) - allowed if allowed else ()
        if beyond:
            others = ", ".join(sorted(beyond))
            where = f"line {line.line} gives {asked.quantity}"
            reason = f"{where} in letters that were not asked for: {others}"
            continue
        if holds_alone(found.printed):
            return ""
        reason = f"line {line.line} gives {asked.quantity} only with what the answer itself "
        reason += "assumes or defines"
    relations = [found.relation for _, found in reversed(true) if found.relation is not None]
    tried = dict.fromkeys(write_latex(v) for v in _implied_values(asked, relations, allowed))
    values_tried = islice(tried, _MOST_TRIED)
    return "" if any(holds_alone(f"{asked.quantity} = {v}") for v in values_tried) else reason


def _implied_values(
    asked: Asked, relations: Sequence[Relation], allowed: frozenset[str]
) -> Iterator[Node]:
    """What the quantity may be by relations that do not have it alone on a side.

    Terms may have been moved, or the quantity may stand under another name, such as F_y for F·ŷ:
    then a side in the letters that are allowed is equal to it. Where all letters are allowed there
    is none: E = T + V would give V.
    """
    if not allowed or asked.sign != "=":
        return
    for relation in relations:
        sides = relation.sides if relation.signs else ()
        for value in (*asked.solved_from(relation), *sides):
            if not asked.is_in(value) and letters_in(value) <= allowed:
                yield value
