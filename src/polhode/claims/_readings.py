"""A claim judged in every way that its letters can be read.

The field writes **L** about the centre of mass and about a fixed point. Every reading that fits is
judged: where all say the same the verdict stands, where they differ it is ambiguous and says so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod

from polhode.base import ParseError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims._notation import Notation
from polhode.claims._verdict import Answer, Read, Verdict
from polhode.claims.latex._names import name_latex, spelled
from polhode.claims.latex._tree import Name, Piece
from polhode.claims.meaning._vocabulary import Reading, Vocabulary
from polhode.claims.states._bound_claim import BoundClaim

#: Letters of several meanings, each with the one that is taken.
Chosen = Mapping[Name, str]

_MOST = 16  # ways of reading a claim that are judged


@dataclass(frozen=True)
class JudgedReading:
    """A claim under one choice of what its letters mean.

    Attributes:
        chosen: that choice, of letters with more than one meaning.
        notation: with it.
        asked: the claim, as far as it could be bound.
        verdict: on it, before any correction.
    """

    chosen: Chosen
    notation: Notation
    asked: BoundClaim | None
    verdict: Verdict

    @property
    def fits(self) -> bool:
        """Whether the claim makes sense with these meanings: it is bound, of one dimension."""
        return self.asked is not None and not (
            self.verdict.answer is Answer.FAILS and dimensions_at_odds(self.asked)
        )


def choices(vocabulary: Vocabulary, pieces: Iterable[Piece]) -> tuple[Chosen, ...]:
    """Every way of reading the letters of some pieces of text, the likeliest first.

    Raises `ParseError` for more ways than are judged.
    """
    groups = _together([r for r in vocabulary.readings(pieces) if len(r.phrases) > 1])
    count = prod(len(ways) for ways in groups)
    if count > _MOST:
        named = [letter for ways in groups for letter in ways[0]]
        raise ParseError(
            f"{', '.join(map(plain, named))}, which can be read in {count} ways together",
            expected="letters that say of which body, about which point or along which axis",
            advice=f"choose, as in read {said(named[0], groups[0][0][named[0]])}",
        )
    return tuple({n: p for way in ways for n, p in way.items()} for ways in product(*groups))


def _together(readings: Sequence[Reading]) -> list[list[dict[Name, str]]]:
    """Choices for each letter, those of moments jointly: **L** and τ are about the same point."""
    groups: dict[tuple[str, ...], list[Reading]] = {}
    for reading in readings:
        points = tuple(phrase.partition(" about ")[2] for phrase in reading.phrases)
        groups.setdefault(points if all(points) else (plain(reading.letter),), []).append(reading)
    return [
        [{r.letter: r.phrases[i] for r in group} for i in range(len(group[0].phrases))]
        for group in groups.values()
    ]


def settled(ways: Sequence[JudgedReading]) -> JudgedReading | Verdict:
    """The reading whose verdict stands; an ambiguous verdict where readings that fit differ."""
    fitting = [way for way in ways if way.fits] or ways
    answers = dict.fromkeys(way.verdict.answer for way in fitting)
    if len(answers) == 1:
        return fitting[0]
    first, *others = (next(w for w in fitting if w.verdict.answer is a) for a in answers)
    differing = [n for n in first.chosen if any(w.chosen[n] != first.chosen[n] for w in others)]
    told = "; ".join(
        f"{w.verdict.answer.value} if {_meant(w, differing)}" for w in (first, *others)
    )
    letter = differing[0]
    reason = f"{told}; to choose, state the reading {said(letter, first.chosen[letter])}"
    return Verdict(Answer.AMBIGUOUS, first.verdict.context, reason=reason, option="read")


def with_readings(verdict: Verdict, vocabulary: Vocabulary, pieces: Iterable[Piece]) -> Verdict:
    """The verdict with what the letters of the claim were taken to mean, where that is settled."""
    every = vocabulary.readings(pieces)
    found = [r for r in every if verdict.answer is not Answer.AMBIGUOUS or len(r.phrases) == 1]
    read = (Read(name_latex(r.letter), r.phrase, plain(r.letter)) for r in found)
    return replace(verdict, readings=tuple(read))


def judged_in_every_reading(
    ways: Sequence[Chosen], judge: Callable[[Chosen], JudgedReading]
) -> JudgedReading | Verdict:
    """The reading whose verdict stands, or an ambiguous verdict."""
    first = judge(ways[0])
    return settled([first, *map(judge, ways[1:])]) if len(ways) > 1 else first


def _meant(way: JudgedReading, letters: Iterable[Name]) -> str:
    return " and ".join(f"{plain(letter)} is {way.chosen[letter]}" for letter in letters)


def said(letter: Name, phrase: str) -> str:
    """A choice as it is typed: 'L = angular momentum about pivot'."""
    return f"'{plain(letter)} = {phrase}'"


def plain(letter: Name) -> str:
    """A letter in ASCII without hat or boldness."""
    return spelled(replace(letter, decoration=""))
