"""What a review says: a mark for every relation of a document, with the evidence for it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from polhode.base import Shown
from polhode.judge._verdict import Answer, Read, Verdict


class Mark(Enum):
    """What is said of one relation of a derivation.

    `ERROR` is a proof: every letter of the line is closed, and there is positive evidence of a
    slip. What fails without such a proof is a `DOUBT`.
    """

    TRUE = "true"
    ERROR = "error"
    DOUBT = "doubt"
    FOLLOWS = "follows"
    UNLINKED = "unlinked"
    NEEDS = "needs"
    NOT_JUDGED = "not-judged"


@dataclass(frozen=True)
class ReviewedLine:
    """One relation of a document, with its mark.

    Attributes:
        file: the file, by the name it was given or included under.
        line: where it begins, counted from 1.
        column: likewise.
        latex: what stands there, with the macros of its text.
        mark: what is said of it.
        is_first: for `ERROR`, whether it is the first one of its document.
        of: for `FOLLOWS` and `UNLINKED`, the index in the review of the wrong line it refers to;
            for a `DOUBT` that is drawn from another one, that of the other.
        needs: for `NEEDS`, the condition or the choice of a reading under which it is true.
        context: the context in which it was judged; empty where it was not.
        reason: the mark explained in a sentence, or why it was not judged.
        part: the part of the text that it belongs to, such as "Problem 2 (b)".
        is_display: whether it stands on lines of its own.
        is_final: whether it is the boxed or named final answer of its part.
        verdict: the judgement on it, with the correction and a state that refutes it.
        read_as: how a slash in it, or what words say of it, was read: "read as" and its LaTeX.
        tried: for `DOUBT`, the hypotheses under which it fails too, in words.
    """

    file: str
    line: int
    column: int
    latex: str
    mark: Mark
    of: int | None = None
    needs: str = ""
    context: str = ""
    reason: str = ""
    part: str = ""
    is_display: bool = True
    is_final: bool = False
    verdict: Verdict | None = None
    read_as: str = ""
    is_first: bool = False
    tried: tuple[str, ...] = ()

    @property
    def readings(self) -> tuple[Read, ...]:
        """The meanings that its letters were given."""
        return self.verdict.readings if self.verdict else ()

    @property
    def is_wrong(self) -> bool:
        """Whether it does not hold on the model."""
        return self.mark in (Mark.ERROR, Mark.FOLLOWS)

    @property
    def is_stated(self) -> bool:
        """Whether it was read, but claims nothing: a definition, an assumption."""
        is_unread = self.verdict is None or self.verdict.answer is Answer.UNREAD
        return self.mark is Mark.NOT_JUDGED and not is_unread

    def to_json(self) -> dict[str, object]:
        """Plain data, by the names of the contract."""
        verdict = self.verdict
        example = verdict.counterexample if verdict else None
        correction = verdict.correction if verdict else None
        return {
            "file": self.file,
            "line": self.line,
            "column": self.column,
            "latex": self.latex,
            "mark": self.mark.value,
            "first": self.is_first,
            "of": self.of,
            "needs": self.needs or None,
            "context": self.context or None,
            "readings": [reading.to_json() for reading in self.readings],
            "correction": correction and correction.to_json(),
            "counterexample": example and example.to_json(),
            "reason": "; ".join(filter(None, (self.read_as, self.reason))) or None,
            "tried": list(self.tried),
        }


@dataclass(frozen=True)
class Review(Shown):
    """A derivation reviewed against the model of a system.

    Attributes:
        system: the name of the system.
        files: the names of the files, in the order they were given.
        lines: one for each relation, in order.
        seconds: the wall time that it took.
        notes: what holds for the whole document, such as a system that was proposed.
        texts: the whole text of each file, by its name; pages show the words between the formulas.
    """

    system: str
    files: tuple[str, ...]
    lines: tuple[ReviewedLine, ...]
    seconds: float = 0.0
    notes: tuple[str, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict, repr=False)

    @property
    def summary(self) -> dict[Mark, int]:
        """How many lines got each mark."""
        count = Counter(line.mark for line in self.lines)
        return {mark: count[mark] for mark in Mark}

    @property
    def errors(self) -> tuple[ReviewedLine, ...]:
        """The lines that are proved to be wrong by themselves."""
        return tuple(line for line in self.lines if line.mark is Mark.ERROR)

    @property
    def judged(self) -> float:
        """The share of the relations of which it was found out whether they hold; 0 to 1."""
        found = (Mark.TRUE, Mark.ERROR, Mark.FOLLOWS, Mark.UNLINKED)
        return sum(line.mark in found for line in self.lines) / max(len(self.lines), 1)

    @property
    def finals(self) -> tuple[ReviewedLine, ...]:
        """The final answers that the text boxes or names; one part or problem may have its own."""
        return tuple(line for line in self.lines if line.is_final)

    @property
    def final(self) -> ReviewedLine | None:
        """The last of the final answers."""
        return next(reversed(self.finals), None)

    def to_json(self) -> dict[str, object]:
        """Plain data, by the names of the contract."""
        final = self.final
        return {
            "system": self.system,
            "lines": [line.to_json() for line in self.lines],
            "summary": {mark.value: count for mark, count in self.summary.items()},
            "judged": round(self.judged, 4),
            "final": None if final is None else self.lines.index(final),
            "notes": list(self.notes),
            "seconds": self.seconds,
        }
