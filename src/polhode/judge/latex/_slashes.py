"""Slashes of which writers differ in what they divide: 1/2 m v², g/l sin θ, sin θ/2."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from polhode.base import ParseError
from polhode.judge.latex._tokens import refusal
from polhode.judge.latex._tree import Call, Node, Number, Power, Product, Span, Sum

_LOOSE = re.compile(r"[\s~(\[]|\\[,;:! {]")  # what does not tie a factor to the one before it
_SIZE = re.compile(r"\\(?:left|[bB]igg?l?)\s*\Z")  # of an opening bracket


class UnclearSlashError(ParseError):
    """A slash that may divide by all behind it or only by a part.

    Attributes:
        ways: the whole source in each of its readings, with a fraction in place of the slash.
        is_of_numbers: whether it stands between two numbers, as in 1/2 m v²; the first of three
            readings is then the fraction of these alone.
    """

    ways: tuple[str, ...] = ()
    is_of_numbers: bool = False


@dataclass(frozen=True)
class Slash:
    """A slash in a formula in text style.

    Attributes:
        source: LaTeX.
        start: where what it divides begins.
        place: where it stands.
        above: the factors before it.
        below: the factors behind it.
        ends: where each of these ends.
    """

    source: str
    start: int
    place: int
    above: Sequence[Node]
    below: Sequence[Node]
    ends: Sequence[int]

    def refuse_unclear(self) -> None:
        """Raises `UnclearSlashError` where writers differ in what the slash divides."""
        is_of_numbers = isinstance(self.below[0], Number) and len(self.below) > 1
        is_of_numbers = is_of_numbers and all(isinstance(f, Number) for f in self.above)
        parts = self._of_numbers() if is_of_numbers else [*self._arguments(), *self._quotients()]
        if len(parts) == 1:
            return
        problem = "a slash that may divide by all behind it or only by a part"
        span = (self.place, self.ends[-1])
        shown = refusal(self.source, span, problem, r"\frac, or brackets")
        error = UnclearSlashError(shown.given, expected=shown.expected, advice=shown.advice)
        error.ways = tuple(self._with_fraction(*part) for part in parts)
        error.is_of_numbers = is_of_numbers
        raise error

    def _of_numbers(self) -> list[Span]:
        """The part that is a quotient if it ends at the number, at a space, or at the end."""
        places = range(1, len(self.below))
        tied = next((place for place in places if self._is_loose(place)), len(self.below))
        return [(self.start, self.ends[count - 1]) for count in (1, tied, len(self.below))]

    def _arguments(self) -> list[Span]:
        """The part of the source that is a quotient in sin θ/2 for the sine of θ/2."""
        before, below = self.above[-1], self.below[0]
        call = before.base if isinstance(before, Power) else before
        if not isinstance(call, Call):
            return []
        angle = call.argument.span[0]
        is_bracketed = self.source[:angle].rstrip().endswith(("(", "[", "{"))
        if is_bracketed or not (isinstance(below, Number) or isinstance(call.argument, Product)):
            return []
        return [(angle, self.ends[0])]

    def _quotients(self) -> list[Span]:
        """The part that is a quotient if the slash divides by all behind it, or by less of it."""
        places = range(1, len(self.below))
        loose = [place for place in places if self._is_loose(place)]
        calls = [place for place in places if _is_call(self.below[place])]
        are_new = bool(calls) and not any(map(_is_call, self.above))
        is_unclear = loose or are_new or isinstance(self.above[-1], Sum)
        counts = {1, *loose, *calls} if is_unclear else set()
        # By all behind it first, since texts print g/3a for g over 3a.
        ends = dict.fromkeys((len(self.below), *sorted(counts)))
        return [(self.start, self.ends[count - 1]) for count in ends]

    def _is_loose(self, place: int) -> bool:
        """Whether a factor behind the slash is not tied to the one before it, as letters are."""
        between = (self.ends[place - 1], self.below[place].span[0])
        return _LOOSE.search(self.source, *between) is not None

    def _with_fraction(self, start: int, end: int) -> str:
        """The source with a fraction of what stands around the slash between two places."""
        start = len(_SIZE.sub("", self.source[:start]))
        above, below = self.source[start : self.place], self.source[self.place + 1 : end]
        return rf"{self.source[:start]}\frac{{{above}}}{{{below}}}{self.source[end:]}"


def _is_call(node: Node) -> bool:
    """Whether a factor is a function, or a power of one."""
    return isinstance(node.base if isinstance(node, Power) else node, Call)
