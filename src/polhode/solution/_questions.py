"""Questions that a text asks about a system, each with what answers it.

A question says what is asked in words, and names the computations that answer it; the answers
themselves are derived when the solution is built, and judged like every other line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from polhode.base import look_up
from polhode.solution._lines import SolutionLine
from polhode.solution._remarks import Remark, remark_lines
from polhode.solution._setting import Setting


@dataclass(frozen=True)
class Derivation:
    """What an answer is made of.

    Attributes:
        setting: the system.
        sections: lines of the general solution by the headings of its sections.
        routes: ways to the equations of motion, by name.
        route: heading of the section of the one that was taken; empty for none.
    """

    setting: Setting
    sections: Mapping[str, tuple[SolutionLine, ...]]
    routes: Mapping[str, Callable[[Setting], Iterator[SolutionLine]]]
    route: str


class Answering(Protocol):
    """A computation that answers a question, or a part of it."""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """The paragraphs and formulas of the answer."""


@dataclass(frozen=True)
class FromSection:
    """A section of the general solution, which then stands in the answer instead.

    Attributes:
        section: its heading.
    """

    section: str

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """All its lines."""
        yield from look_up(self.section, found.sections, "section of the solution")


@dataclass(frozen=True)
class RouteTaken:
    """The section of the general solution that leads to the equations of motion."""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """All its lines."""
        yield from found.sections[found.route]


@dataclass(frozen=True)
class ByRoute:
    """Another way to the equations of motion than that of the general solution.

    Attributes:
        route: newton, contact, lagrange or integrals.
    """

    route: str

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """All its lines."""
        yield from look_up(self.route, found.routes, "route")(found.setting)


@dataclass(frozen=True)
class TextQuestion:
    """A question about a system.

    Attributes:
        title: a few words, for the heading.
        asked: the question, with `$…$` around formulas.
        answers: what answers it, in order.
        part: as the text counts, such as "(a)"; empty if it does not.
        convention: of axes and angles, where that of the text differs from the solution's.
        claims: ids of the text's claims about it, with which the answer is compared.
    """

    title: str
    asked: str
    answers: tuple[Answering, ...]
    part: str = ""
    convention: str = ""
    claims: tuple[str, ...] = ()

    @property
    def heading(self) -> str:
        """Of its section."""
        return f"{self.part} {self.title}".strip()

    def to_json(self) -> dict[str, Any]:
        """As it stands in a JSON document; its steps have its heading as their section."""
        return {
            "part": self.part,
            "title": self.title,
            "asked": self.asked,
            "convention": self.convention,
            "section": self.heading,
            "claims": list(self.claims),
        }

    def sections(self, route: str) -> frozenset[str]:
        """Headings of the general solution's sections that stand in its answer."""
        named = {a.section for a in self.answers if isinstance(a, FromSection)}
        return frozenset(named | {route for a in self.answers if isinstance(a, RouteTaken)})


def answered(
    questions: Sequence[TextQuestion], found: Derivation, remarks: Mapping[str, Remark]
) -> Iterator[tuple[str, tuple[SolutionLine, ...]]]:
    """The heading of every question with its lines: what is asked, the answer, remarks."""
    for question in questions:
        yield question.heading, tuple(_lines(question, found, remarks))


def _lines(
    question: TextQuestion, found: Derivation, remarks: Mapping[str, Remark]
) -> Iterator[SolutionLine]:
    yield SolutionLine(f"Asked: {question.asked}")
    if question.convention:
        yield SolutionLine(f"Convention: {question.convention}")
    for answer in question.answers:
        yield from answer.lines(found)
    yield from remark_lines(remarks[id] for id in question.claims if id in remarks)
