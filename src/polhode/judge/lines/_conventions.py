"""Conventions of a text other than those of the declaration: another zero or sense of an angle.

A text seldom says how it counts an angle. Lines that fail as the declaration counts, and hold
together under a change of convention by which none that holds is lost, are in need of it: that they
are wrong is not proved, nor that they are right. For a single line the sense of a coordinate is in
question, and nothing else, as a slip explains it as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from polhode.algebra import PI, Expr, Symbol
from polhode.base import PURE, PolhodeError
from polhode.derive import Equations
from polhode.judge._verdict import Answer
from polhode.judge.latex._names import name_of
from polhode.judge.lines._judge_line import judged_line
from polhode.judge.lines._judged_line import JudgedLine, may_hold_in
from polhode.judge.lines._weaker_meanings import weaker_meanings
from polhode.judge.text._text_line import TextLine

_SHOWN = 3  # lines that speak for a convention; a slip, carried on once, makes two


@dataclass(frozen=True)
class Convention:
    """Another way to count a coordinate.

    Attributes:
        coordinate: of the declaration.
        value: what its letter stands for in the text.
    """

    coordinate: Symbol
    value: Expr

    @property
    def is_of_sense(self) -> bool:
        """Whether it is counted in the other sense, from the same zero."""
        return self.value == -Expr.generator(self.coordinate)

    @property
    def words(self) -> str:
        """As LaTeX within words."""
        letter = Expr.generator(self.coordinate).latex()
        return f"{letter} counted as {self.value.latex()} is here"

    def judged(self, judged: JudgedLine, equations: Equations) -> JudgedLine:
        """A line under it."""
        return judged_line(self._applied(judged.line), equations, {})

    def may_hold(self, judged: JudgedLine, equations: Equations) -> bool:
        """Whether a line may hold under it, in one of the contexts in which it may be meant."""
        line = self._applied(judged.line)
        meanings = ((line, "motion"), (line, "steady"), *weaker_meanings(line, equations))
        return any(may_hold_in(meant, equations, {}, context) for meant, context in meanings)

    def _applied(self, line: TextLine) -> TextLine:
        letter = name_of(self.coordinate.published)
        return replace(line, in_force=line.in_force.defining({letter: self.value}))


def in_conventions(lines: Sequence[JudgedLine], equations: Equations) -> dict[int, JudgedLine]:
    """The lines of a part that would hold in another convention, each by its place.

    Args:
        lines: of the part.
        equations: of the system.
    """
    failing = [i for i, line in enumerate(lines) if _fails(line)]
    found: dict[int, JudgedLine] = {}
    for convention in _conventions(lines, failing, equations):
        left = [i for i in failing if i not in found]
        if len(left) < _SHOWN and not convention.is_of_sense:
            continue
        gained = dict(_gained(lines, left, convention, equations))
        if gained and not _loses(lines, convention, equations):
            are_several = len(gained) >= _SHOWN
            for place, line in gained.items():
                if are_several:
                    found[place] = replace(line, needs=convention.words)
                elif convention.is_of_sense:
                    found[place] = replace(lines[place], otherwise=convention.words)
    return found


def _fails(line: JudgedLine) -> bool:
    return line.verdict.answer is Answer.FAILS and not (line.stated or line.needs)


def _conventions(
    lines: Sequence[JudgedLine], failing: Sequence[int], equations: Equations
) -> Iterator[Convention]:
    used = {letter for i in failing for letter in lines[i].line.letters}
    for q in equations.coordinates:
        if name_of(q.published) not in used:
            continue
        value, turn = Expr.generator(q), Expr.generator(PI)
        if equations.dimensions.get(q) == PURE:
            yield Convention(q, -value)
            for other in (turn - value, turn / 2 - value, value + turn / 2, value + turn):
                yield Convention(q, other)


def _gained(
    lines: Sequence[JudgedLine],
    failing: Sequence[int],
    convention: Convention,
    equations: Equations,
) -> Iterator[tuple[int, JudgedLine]]:
    for i in failing:
        if name_of(convention.coordinate.published) in set(lines[i].line.letters):
            with suppress(PolhodeError, ArithmeticError):
                if not convention.may_hold(lines[i], equations):
                    continue
                found = convention.judged(lines[i], equations)
                if found.verdict.holds and not found.needs:
                    yield i, found


def _loses(lines: Sequence[JudgedLine], convention: Convention, equations: Equations) -> bool:
    """Whether a line that holds as the declaration counts would fail."""
    letter = name_of(convention.coordinate.published)
    for line in lines:
        is_true = line.verdict.holds and not (line.stated or line.needs)
        if is_true and letter in set(line.line.letters):
            with suppress(PolhodeError, ArithmeticError):
                if convention.judged(line, equations).verdict.answer is Answer.FAILS:
                    return True
    return False
