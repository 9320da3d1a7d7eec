"""Marks in words: the sentence that editors, checks and learning platforms show for a line."""

from __future__ import annotations

from polhode.claims import Correction, Counterexample
from polhode.review._reviewed import Mark, Review, ReviewedLine

#: A mark in two or three words, as a margin or the title of a message shows it.
TITLES = {
    Mark.TRUE: "true",
    Mark.FIRST_ERROR: "first error",
    Mark.FOLLOWS: "follows from an error",
    Mark.UNLINKED: "true, but does not follow",
    Mark.NEEDS: "needs a condition",
    Mark.NOT_JUDGED: "not judged",
}

#: The sign of each mark, which says the same as its words and its colour.
SIGNS = {
    Mark.TRUE: "✓",
    Mark.FIRST_ERROR: "✗",
    Mark.FOLLOWS: "↳",
    Mark.UNLINKED: "?",
    Mark.NEEDS: "!",
    Mark.NOT_JUDGED: "·",
}


def message(line: ReviewedLine, review: Review) -> str:
    """What is said of a line, with its correction and a state that refutes it, in plain text."""
    parts = [sentence(line, review)]
    verdict = line.verdict
    if verdict is not None and line.is_wrong:
        if verdict.correction is not None:
            parts.append(corrected(verdict.correction))
        if verdict.counterexample is not None:
            parts.append(refuted(verdict.counterexample))
    return ". ".join(part.rstrip(".") for part in parts if part) + "."


def sentence(line: ReviewedLine, review: Review) -> str:
    """A mark as a sentence, with the reason for it."""
    explained = (Mark.FIRST_ERROR, Mark.NEEDS, Mark.NOT_JUDGED)
    reason = f": {line.reason}" if line.reason and line.mark in explained else ""
    return f"{told(line, review)}{reason}"


def told(line: ReviewedLine, review: Review) -> str:
    """A mark as a sentence, by itself."""
    match line.mark:
        case Mark.TRUE:
            return f"This holds in the context {line.context!r}" if line.context else "This holds"
        case Mark.FIRST_ERROR:
            return "This does not hold on the model"
        case Mark.FOLLOWS:
            return f"This is wrong only because {place_of(line, review)} is"
        case Mark.UNLINKED:
            wrong = place_of(line, review)
            return f"This is true, but does not follow from {wrong}, which is wrong"
        case Mark.NEEDS if line.needs:
            return f"This needs {line.needs}"
        case Mark.NEEDS:
            return "This is true only under a condition, or in a reading, that is not stated"
        case Mark.NOT_JUDGED:
            return "This was not judged"


def place_of(line: ReviewedLine, review: Review) -> str:
    """The line that a mark refers to, by its place in the source."""
    if line.of is None:
        return "an earlier line"
    other = review.lines[line.of]
    where = "" if other.file == line.file else f" of {other.file}"
    return f"line {other.line}{where}"


def corrected(correction: Correction) -> str:
    """A correction; without its formula where that is withheld."""
    holds = f"; it holds as {correction.latex}" if correction.latex else ""
    return f"{correction.what[:1].upper()}{correction.what[1:]}{holds}"


def refuted(example: Counterexample) -> str:
    """A state that refutes a line, with the values of its sides there."""
    left, right = example.sides
    return f"At {example.state} (SI) the left side is {left} and the right side {right}"
