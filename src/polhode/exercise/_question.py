"""A question: what it says, what it asks for, and how its answers are found."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from polhode.algebra import Symbol
from polhode.exercise._answers import ExpectedAnswer
from polhode.exercise._context import SheetContext, context_of
from polhode.exercise._draws import Draws
from polhode.exercise._numbers import DrawnNumbers
from polhode.exercise._quantities import Amount
from polhode.exercise._subject import ExerciseSubject
from polhode.solution import inline

LETTERS = "abcdefgh"


@dataclass(frozen=True)
class Passage:
    """A paragraph, and a formula displayed below it.

    Attributes:
        words: with `$…$` around formulas.
        latex: the formula; empty for none.
    """

    words: str
    latex: str = ""


@dataclass(frozen=True)
class ExerciseQuestion:
    """A question with its answers.

    Attributes:
        kind: name of its kind.
        statement: what is said and asked.
        answers: one for each blank.
        worked: how the answers are found.
        options: to choose from, as formulas or words with `$…$`, named (a), (b), ...
    """

    kind: str
    statement: tuple[Passage, ...]
    answers: tuple[ExpectedAnswer, ...]
    worked: tuple[Passage, ...]
    options: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """Without the ids of its answers."""
        return {
            "kind": self.kind,
            "statement": [{"words": p.words, "latex": p.latex} for p in self.statement],
            "options": list(self.options),
            "answers": [answer.to_json() for answer in self.answers],
            "worked": [{"words": p.words, "latex": p.latex} for p in self.worked],
        }


@dataclass(frozen=True)
class Occasion:
    """What a question is made for.

    Attributes:
        subject: the system.
        layout: draws that are the same for all students: which formula is asked for.
        own: draws of one student.
        drawn: the numbers of that student.
    """

    subject: ExerciseSubject
    layout: Draws
    own: Draws
    drawn: DrawnNumbers

    @cached_property
    def sheet(self) -> SheetContext:
        """What the sheet introduces, from which its formulas are built."""
        return context_of(self.subject, self.drawn.formulas)

    def values(self, state: Mapping[Symbol, Amount]) -> dict[Symbol, float]:
        """The values of a state and of all parameters, SI."""
        return {s: a.si for s, a in state.items()} | dict(self.drawn.values)


#: Makes the questions of a kind, the first of which is taken; none where a system offers none.
Maker = Callable[[Occasion], Iterator[ExerciseQuestion]]


def stated(amounts: Mapping[Symbol, Amount]) -> str:
    """Values in words: θ = 60° and ω₃ = 12 rad/s."""
    parts = [equality(symbol, amount) for symbol, amount in amounts.items()]
    return f"{', '.join(parts[:-1])} and {parts[-1]}" if len(parts) > 1 else "".join(parts)


def equality(symbol: Symbol, amount: Amount) -> str:
    """$a = 28$ mm."""
    return f"${inline(symbol)[1:-1]} = {amount.printed[1:]}"
