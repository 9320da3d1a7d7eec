"""The question which of four equations is wrong, one of them by a slip that was planted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from polhode.algebra import Expr, Symbol
from polhode.exercise._answers import ChoiceAnswer
from polhode.exercise._draws import Draws
from polhode.exercise._question import LETTERS, Occasion, Passage, Question
from polhode.exercise._slips import slips
from polhode.exercise._subject import Subject
from polhode.solution import Solution, breaks

_OPTIONS = 4
_LONGEST = 190
_CONTEXTS = ("identity", "motion")


def wrong_equation(occasion: Occasion) -> Iterator[Question]:
    """Four equations about the system, three of which hold."""
    subject = occasion.subject
    lines = occasion.layout.shuffled("equations", _lines(subject))
    taken = _different(lines)
    if len(taken) < _OPTIONS:
        return
    own = occasion.own.about("wrong")
    for place in own.shuffled("place", range(_OPTIONS)):
        slipped = _slipped(subject, taken[place], own)
        if slipped:
            break
    else:
        return
    shown = [slipped if i == place else line for i, line in enumerate(taken)]
    order = own.shuffled("order", range(_OPTIONS))
    letters = tuple(LETTERS[:_OPTIONS])
    right = letters[order.index(place)]
    yield Question(
        "wrong",
        (Passage("One of these four equations is wrong, the others hold on every motion. Which?"),),
        (ChoiceAnswer("wrong:", frozenset({right}), letters),),
        (Passage(f"Equation ({right}) is wrong. It holds as", taken[place]),),
        tuple(f"${shown[i]}$" for i in order),
    )


def _different(lines: Sequence[_Stated]) -> list[str]:
    """Equations from as many sections as there are, none of which is another times a factor."""
    by_section = {line.section: line for line in reversed(lines)}
    first = [line for line in lines if by_section[line.section] is line]
    taken: list[str] = []
    for line in (*first, *(x for x in lines if x not in first)):
        left = _sides(line.latex)
        if not any(left & _sides(t) or _contains(line.latex, t) for t in taken):
            taken.append(line.latex)
    return taken[:_OPTIONS]


def _sides(text: str) -> set[str]:
    return {side for side in text.split(" = ") if side != "0"}


def _contains(one: str, other: str) -> bool:
    """Whether the long side of either equation occurs in the other."""
    pairs = ((one, other), (other, one))
    return any(max(_sides(a), key=len, default="") in b for a, b in pairs)


class _Stated(NamedTuple):
    """An equation and the section of the worked solution that it stands in."""

    section: str
    latex: str


def _lines(subject: Subject) -> list[_Stated]:
    """Equations of the worked solution that hold by themselves; rows and forces without one."""
    if isinstance(subject.worked, Solution):
        steps = subject.worked.steps
        found = [_Stated(s.section, s.latex) for s in steps if s.latex and s.context in _CONTEXTS]
    else:
        components = subject.equations.components
        letters = (Expr.generator(Symbol(name)).latex() for name in components)
        pairs = zip(letters, components.values(), strict=True)
        found = [_Stated("motion", f"{row.latex()} = 0") for row in subject.equations.motion]
        found += [_Stated("forces", f"{name} = {value.latex()}") for name, value in pairs]
    return [
        line for line in dict.fromkeys(found) if _is_fit(line.latex) and subject.holds(line.latex)
    ]


def _is_fit(text: str) -> bool:
    """Whether an equation is short, and long enough for a slip to hide in it."""
    single = text.count(" = ") == 1 and len(text) <= _LONGEST
    return single and _says_something(text) and bool(next(slips(text), ""))


def _says_something(text: str) -> bool:
    """Whether a side is long enough for a slip to hide in it."""
    return len(breaks(text)) > 1 or r"\frac" in text or r"\sin" in text or r"\cos" in text


def _slipped(subject: Subject, text: str, draws: Draws) -> str:
    """The equation with one change by which it fails; empty if none is refuted."""
    for changed in draws.shuffled(text, dict.fromkeys(slips(text))):
        if subject.fails(changed):
            return changed
    return ""
