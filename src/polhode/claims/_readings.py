"""A claim judged in every reading of its letters.

Texts write **L** for the angular momentum about the centre of mass and about a fixed point. Every
reading that fits is judged: if all lead to the same answer the verdict stands, if they differ it is
ambiguous.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod

from polhode.base import ParseError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims._notation import Notation
from polhode.claims._verdict import Answer, Read, Verdict, VerdictInReading
from polhode.claims.latex._names import name_latex, spelled
from polhode.claims.latex._tree import Name, Piece
from polhode.claims.meaning._vocabulary import Reading, Vocabulary
from polhode.claims.states._bound_claim import BoundClaim

#: Letters of several meanings, each with the one that is taken.
Chosen = Mapping[Name, str]

_MOST = 16  # readings of a claim that are judged: four letters of two meanings each


@dataclass(frozen=True)
class JudgedReading:
    """A claim under one choice of what its letters mean.

    Attributes:
        chosen: that choice, of letters with more than one meaning.
        notation: with it.
        claim: bound to the system; None where it cannot be, or is a definition.
        verdict: on it, before any correction.
    """

    chosen: Chosen
    notation: Notation
    claim: BoundClaim | None
    verdict: Verdict

    @property
    def fits(self) -> bool:
        """Whether the claim makes sense in this reading: it is bound and, if false, homogeneous."""
        return self.claim is not None and not (
            self.verdict.answer is Answer.FAILS and dimensions_at_odds(self.claim)
        )

    @property
    def told(self) -> VerdictInReading:
        """Its verdict, with the choice as readers are told of it."""
        chosen = {n: Read(name_latex(n), p, _plain(n)) for n, p in self.chosen.items()}
        return VerdictInReading(chosen, self.verdict)


def choices(vocabulary: Vocabulary, pieces: Iterable[Piece]) -> tuple[Chosen, ...]:
    """Every reading of the letters of some pieces of text, the likeliest first.

    Raises `ParseError` for more readings than are judged.
    """
    groups = _joint([r for r in vocabulary.readings(pieces) if len(r.phrases) > 1])
    count = prod(len(ways) for ways in groups)
    if count > _MOST:
        named = [letter for ways in groups for letter in ways[0]]
        raise ParseError(
            f"{', '.join(map(_plain, named))}, which together can be read in {count} ways",
            expected="letters that say of which body, about which point or along which axis",
            advice=f"choose, as in read {_typed(named[0], groups[0][0][named[0]])}",
        )
    return tuple({n: p for way in ways for n, p in way.items()} for ways in product(*groups))


def _joint(readings: Sequence[Reading]) -> list[list[dict[Name, str]]]:
    """Choices for each letter; **L** and τ are chosen jointly, about the same point.

    Euler's second law dL/dt = τ holds about one common point, so mixed choices mean nothing.
    """
    groups: dict[tuple[str, ...], list[Reading]] = {}
    for reading in readings:
        points = tuple(phrase.partition(" about ")[2] for phrase in reading.phrases)
        groups.setdefault(points if all(points) else (_plain(reading.letter),), []).append(reading)
    return [
        [{r.letter: r.phrases[i] for r in group} for i in range(len(group[0].phrases))]
        for group in groups.values()
    ]


def judged_in_every_reading(
    readings: Sequence[Chosen], judge: Callable[[Chosen], JudgedReading]
) -> JudgedReading | Verdict:
    """The reading whose verdict stands; an ambiguous verdict where readings that fit differ."""
    ways = [judge(chosen) for chosen in readings]
    if len(ways) == 1:
        return ways[0]
    fitting = [way for way in ways if way.fits] or ways
    answers = dict.fromkeys(way.verdict.answer for way in fitting)
    by_reading = tuple(way.told for way in fitting)
    if len(answers) == 1:
        return replace(fitting[0], verdict=replace(fitting[0].verdict, by_reading=by_reading))
    # One reading for each answer, and the letters in which these readings differ.
    first, *others = (next(w for w in fitting if w.verdict.answer is a) for a in answers)
    differing = [n for n in first.chosen if any(w.chosen[n] != first.chosen[n] for w in others)]
    answered = []
    for way in (first, *others):
        meant = " and ".join(f"{_plain(letter)} is {way.chosen[letter]}" for letter in differing)
        answered.append(f"{way.verdict.answer.value} if {meant}")
    example = _typed(differing[0], first.chosen[differing[0]])
    reason = f"{'; '.join(answered)}; to choose, state the reading {example}"
    context = first.verdict.context
    return Verdict(Answer.AMBIGUOUS, context, reason=reason, option="read", by_reading=by_reading)


def with_readings(verdict: Verdict, vocabulary: Vocabulary, pieces: Iterable[Piece]) -> Verdict:
    """The verdict with the meanings that the letters of the claim were given.

    An ambiguous verdict lists only the letters that have a single meaning.
    """
    every = vocabulary.readings(pieces)
    found = [r for r in every if verdict.answer is not Answer.AMBIGUOUS or len(r.phrases) == 1]
    read = (Read(name_latex(r.letter), r.phrase, _plain(r.letter)) for r in found)
    return replace(verdict, readings=tuple(read))


def _typed(letter: Name, phrase: str) -> str:
    """A choice as it is typed: 'L = angular momentum about pivot'."""
    return f"'{_plain(letter)} = {phrase}'"


def _plain(letter: Name) -> str:
    """A letter in ASCII without hat or boldness."""
    return spelled(replace(letter, decoration=""))
