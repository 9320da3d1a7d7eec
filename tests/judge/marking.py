"""How a review of a made-up derivation compares with how it was made."""

from dataclasses import dataclass
from functools import cached_property

from judge.derivations import Derivation
from polhode import Mark, Review, ReviewedLine, review


def blamed(line: ReviewedLine) -> Mark:
    """The mark of a line, as if whatever fails by itself were proved to be a slip.

    Texts that try which line is blamed for another are reviewed without corrections, and so
    without the evidence that tells an error from a doubt.
    """
    if line.mark is not Mark.DOUBT:
        return line.mark
    return Mark.ERROR if line.of is None else Mark.FOLLOWS


@dataclass(frozen=True)
class Marking:
    """A derivation with its review."""

    derivation: Derivation
    review: Review

    @cached_property
    def displayed(self) -> tuple[ReviewedLine, ...]:
        """The lines of the derivation, without formulas in the words between them."""
        return tuple(line for line in self.review.lines if line.is_display)

    @property
    def is_named(self) -> bool:
        """Whether the line with the slip is the first that is called wrong by itself."""
        errors = [i for i, line in enumerate(self.displayed) if blamed(line) is Mark.ERROR]
        return errors[:1] == [self.derivation.slip]

    @property
    def drawn(self) -> tuple[int, ...]:
        """Later lines that differ from those without a slip."""
        return tuple(i for i in self.derivation.changed if i != self.derivation.slip)

    @property
    def following(self) -> int:
        """How many of them are said to follow."""
        return sum(blamed(self.displayed[i]) is Mark.FOLLOWS for i in self.drawn)

    @property
    def false_marks(self) -> tuple[int, ...]:
        """Lines that are as they should be, and are marked as wrong or doubtful."""
        sound = (Mark.TRUE, Mark.NOT_JUDGED)
        return tuple(
            i
            for i, line in enumerate(self.displayed)
            if i not in self.derivation.changed and line.mark not in sound
        )


def marked(derivation: Derivation) -> Marking:
    """The review of a derivation; corrections, which take longest, are not sought."""
    text, format = derivation.text, derivation.format
    return Marking(derivation, review(text, derivation.equations, format=format, seconds=0.0))
