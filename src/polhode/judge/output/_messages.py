"""Marks in words: the sentence that editors, checks and learning platforms show for a line."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.judge._reviewed import Mark, Review, ReviewedLine

_WIDEST = 40  # characters of a formula that another line refers to
_ALIGNMENT = re.compile(r"(?<!\\)& ?")
#: A mark in two or three words, as a margin or the title of a message shows it.
TITLES = {
    Mark.TRUE: "true",
    Mark.ERROR: "error",
    Mark.DOUBT: "doubt",
    Mark.FOLLOWS: "follows from an error",
    Mark.UNLINKED: "true, but does not follow",
    Mark.NEEDS: "needs a condition",
    Mark.NOT_JUDGED: "not judged",
}

#: The sign of each mark, which says the same as its words and its colour.
SIGNS = {
    Mark.TRUE: "✓",
    Mark.ERROR: "✗",
    Mark.DOUBT: "≟",
    Mark.FOLLOWS: "↳",
    Mark.UNLINKED: "?",
    Mark.NEEDS: "!",
    Mark.NOT_JUDGED: "·",
}


def message(line: ReviewedLine, review: Review) -> str:
    """What is said of a line, with its correction and a state that refutes it, in plain text."""
    return ". ".join(part.rstrip(".") for part in message_parts(line, review)) + "."


def message_parts(line: ReviewedLine, review: Review) -> Iterator[str]:
    """The mark as a sentence; for an error the correction, and a state that refutes it."""
    yield sentence(line, review)
    if line.verdict is not None and line.mark is Mark.ERROR:
        if (correction := line.verdict.correction) is not None:
            holds = f"; it holds as {_aligned_nowhere(correction.latex)}"
            holds = holds if correction.latex else ""  # it may be withheld
            yield f"{correction.what[:1].upper()}{correction.what[1:]}{holds}"
        if (example := line.verdict.counterexample) is not None:
            left, right = example.sides
            yield f"At {example.state} (SI) the left side is {left} and the right side {right}"
    elif line.verdict is not None and line.mark is Mark.DOUBT and line.verdict.correction:
        found = line.verdict.correction
        would = f": it would hold as {_aligned_nowhere(found.latex)}" if found.latex else ""
        yield f"Perhaps {found.what}{would}"


def _aligned_nowhere(latex: str) -> str:
    """A relation without signs of alignment, which stand for nothing outside of its display."""
    return latex if r"\begin" in latex else _ALIGNMENT.sub("", latex)


def sentence(line: ReviewedLine, review: Review) -> str:
    """A mark as a sentence, with the reason for it."""
    explained = (Mark.ERROR, Mark.DOUBT, Mark.NEEDS, Mark.NOT_JUDGED)
    reason = f": {line.reason}" if line.reason and line.mark in explained else ""
    read = f", {line.read_as}" if line.read_as else ""
    return f"{_told(line, review)}{read}{reason}"


def _told(line: ReviewedLine, review: Review) -> str:
    match line.mark:
        case Mark.TRUE:
            usual = line.context in ("", "identity", "motion")
            return "This holds" if usual else f"This holds in the context {line.context!r}"
        case Mark.ERROR:
            return "This does not hold on the model"
        case Mark.DOUBT:
            return "This does not hold as it was read, but it is not proved to be a slip"
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
    """The line that a mark refers to, by its place in the source, and its formula among several."""
    if line.of is None:
        return "an earlier line"
    other = review.lines[line.of]
    place = (other.file, other.line)
    are_several = sum((each.file, each.line) == place for each in review.lines) > 1
    where = f" ({_shortened(other.latex)})" if are_several else ""
    return f"line {other.line}{where}" + ("" if other.file == line.file else f" of {other.file}")


def _shortened(latex: str) -> str:
    text = " ".join(_aligned_nowhere(latex).split())
    return text if len(text) <= _WIDEST else f"{text[:_WIDEST]}..."
